// Cutters flush with what they cut: a channel, a step and a bore leave no film at their common faces
// Here the cutters reach beyond the faces with which they are flush in the scene.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 5 adc_bailout 0 ambient_light rgb <1,1,1> max_intersections 256 }
camera { perspective location <240,300,-500> direction z*1.9333565474493692 right x*image_width/image_height up y sky <0,1,0> look_at <0,75,0> }
background { rgb <0.2,0.35,0.6> }
light_source { <-300,700,-500> rgb <1,1,1> }
plane { y, 0 texture { pigment { checker rgb <0.7,0.7,0.75> rgb <0.45,0.4,0.35> scale 0.5 scale <1,1,-1> } finish { ambient 0.1 diffuse 0.7 phong 0 phong_size 32 reflection { rgb 0 } } } scale 100 }
difference {
  box { <-1.5,-0.75,-1>, <1.5,0.75,1> }
  box { <-0.35,-0.8,-1.5>, <0.35,0.8,1.5> translate <-0.6,0.95,0> texture { pigment { rgb <0.2,0.4,0.75> } finish { ambient 0.1 diffuse 0.7 phong 0.4 phong_size 32 reflection { rgb 0.2 } } } }
  box { <-1,-0.875,-1>, <1,0.875,1> translate <1.5,0.875,-1> texture { pigment { rgb <0.8,0.25,0.2> } finish { ambient 0.1 diffuse 0.8 phong 0 phong_size 32 reflection { rgb 0 } } } }
  cylinder { 0, <0,3.5,0>, 0.3 translate <0.13,-1.75,-0.5> texture { pigment { rgb <0.3,0.7,0.3> } finish { ambient 0.1 diffuse 0.8 phong 0 phong_size 32 reflection { rgb 0 } } } }
  rotate <0,-15,0> translate <-0.2,0.75,0> texture { pigment { rgb <0.75,0.5,0.25> } finish { ambient 0.1 diffuse 0.75 phong 0 phong_size 32 reflection { rgb 0 } } } scale 100 }
difference {
  cylinder { 0, <0,0.5,0>, 0.45 }
  cylinder { 0, <0,1.5,0>, 0.3 translate <0,-0.5,0> }
  translate <0.9,0,-1.9> texture { pigment { rgb <0.8,0.7,0.2> } finish { ambient 0.1 diffuse 0.7 phong 0.3 phong_size 32 reflection { rgb 0.2 } } } scale 100 }
