// Opaque bodies that are clear where a part of glass makes their surface: windows into joined bodies
// The textures stand at the parts, the interior at the whole.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 adc_bailout 0 ambient_light rgb <1,1,1> max_intersections 256 }
camera { perspective location <40,240,-600> direction z*2.1657379371420777 right x*image_width/image_height up y sky <0,1,0> look_at <0,90,0> }
background { rgb <0.3,0.4,0.55> }
light_source { <-400,600,-500> rgb <1,1,1> }
plane { y, 0 texture { pigment { rgb <0.75,0.75,0.7> } finish { ambient 0.1 diffuse 0.6 phong 0 phong_size 32 reflection { rgb 0 } } } scale 100 }
difference {
  sphere { 0, 1 texture { pigment { rgb <0.75,0.4,0.25> } finish { ambient 0.2 diffuse 0.7 phong 0 phong_size 32 reflection { rgb 0 } } } }
  plane { y, 0 rotate <90,0,0> translate <0,0,-0.6> texture { pigment { rgbt <0.8,0.8,0.8,0.85> } finish { ambient 0 diffuse 0 phong 0.3 phong_size 80 reflection { rgb 0.1 } } } }
  plane { y, 0 rotate <-180,0,0> translate <0,0.75,0> texture { pigment { rgbf <1,0.7,0.3,0.9> } finish { ambient 0 diffuse 0 phong 0 phong_size 32 reflection { rgb 0.1 } } } }
  sphere { 0, 0.3 translate <0.2,-0.2,0.2> texture { pigment { rgb <0.25,0.4,0.7> } finish { ambient 0.2 diffuse 0.7 phong 0.3 phong_size 32 reflection { rgb 0.2 } } } }
  rotate <0,-15,0> translate <-1.4,1,0> interior { ior 1.2 } scale 100 }
merge {
  intersection {
    box { <-0.7,-0.7,-0.7>, <0.7,0.7,0.7> texture { pigment { rgb <0.25,0.4,0.7> } finish { ambient 0.2 diffuse 0.7 phong 0.3 phong_size 32 reflection { rgb 0.2 } } } }
    plane { y, 0 rotate <-25,0,0> translate <0,0.3,0> texture { pigment { rgbf <1,0.7,0.3,0.9> } finish { ambient 0 diffuse 0 phong 0 phong_size 32 reflection { rgb 0.1 } } } }
    }
  sphere { 0, 0.5 translate <-0.1,-0.1,-0.5> texture { pigment { rgbt <0.8,0.8,0.8,0.85> } finish { ambient 0 diffuse 0 phong 0.3 phong_size 80 reflection { rgb 0.1 } } } }
  cylinder { <0.2,0,0.3>, <0.4,1.1,0.3>, 0.12 texture { pigment { rgb <0.75,0.4,0.25> } finish { ambient 0.2 diffuse 0.7 phong 0 phong_size 32 reflection { rgb 0 } } } }
  rotate <0,20,0> translate <1.2,0.75,0> interior { ior 1.4 } scale 100 }
