// Twin of material.rs for stages without physical materials.

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

@group(0) @binding(4) var<storage, read> materials: array<Material>;

// What one crossing of a body's surface lets through.
fn filter_of(body: u32) -> vec3<f32> {
    return materials[bodies[body].material].filter_color;
}

// The index of refraction within a body.
fn ior_of(body: u32, outermost: u32) -> f32 {
    return materials[bodies[body].material].ior;
}
