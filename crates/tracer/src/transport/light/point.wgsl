// Twin of light.rs for scenes whose lights are points.

struct Light {
    position: vec3<f32>,
    falloff: u32,
    power: vec3<f32>,
    // K of the linear falloff, meters.
    constant: f32,
}

// The light of the scene with this number at a point; none at the distance 0.
fn sample_light(index: u32, at: ptr<function, SurfaceInteraction>, generation: u32) -> LightSample {
    return light_center(lights[index], (*at).position);
}
