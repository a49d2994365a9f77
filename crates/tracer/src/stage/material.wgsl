// Twin of material.rs.

struct Material {
    color: vec3<f32>,
    ambient: f32,
    filter_color: vec3<f32>,
    ior: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    reflection: f32,
}
