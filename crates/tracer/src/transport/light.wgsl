// Twin of light.rs: what all lights have in common.

// A(d)·I_j at the distance `d` > 0.
fn power_at(light: Light, d: f32) -> vec3<f32> {
    if light.falloff == FALLOFF_NONE {
        return light.power;
    }
    let divisor = select(d * d, d + light.constant, light.falloff == FALLOFF_LINEAR);
    return min(light.power / divisor, vec3(MOST_LIGHT));
}

// What a light gives to a point, and from where.
struct LightSample {
    to_light: vec3<f32>,
    distance: f32,
    power: vec3<f32>,
}

// What the center of a light gives to a point; none at the distance 0.
fn light_center(light: Light, position: vec3<f32>) -> LightSample {
    let offset = light.position - position;
    let distance = sqrt(dot(offset, offset));
    // A light that stands exactly here has no direction.
    if !(distance > 0.0) {
        return LightSample(vec3(0.0), 0.0, vec3(0.0));
    }
    return LightSample(offset * (1.0 / distance), distance, power_at(light, distance));
}
