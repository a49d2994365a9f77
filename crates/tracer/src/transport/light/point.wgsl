// Twin of light.rs for stages whose lights are points.

struct Light {
    position: vec3<f32>,
    falloff: u32,
    power: vec3<f32>,
    // K of the linear falloff, meters.
    constant: f32,
}

// The light of the scene with this number at a point; none at the distance 0.
fn sample_light(index: u32, at: ptr<function, SurfaceInteraction>, generation: u32) -> LightSample {
    let light = lights[index];
    let offset = light.position - (*at).position;
    let distance = sqrt(dot(offset, offset));
    // A light that stands exactly here has no direction.
    if !(distance > 0.0) {
        return LightSample(vec3(0.0), 0.0, vec3(0.0));
    }
    let to_light = offset * (1.0 / distance);
    let power = power_at(light, distance);
    return LightSample(to_light, distance, power);
}
