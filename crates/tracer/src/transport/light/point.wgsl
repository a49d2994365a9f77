// Twin of light.rs for stages whose lights are points.

struct Light {
    position: vec3<f32>,
    falloff: u32,
    power: vec3<f32>,
    // K of the linear falloff, meters.
    constant: f32,
}
