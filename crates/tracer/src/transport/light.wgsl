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
