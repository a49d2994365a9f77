// Twin of vector.rs. Infinity is the largest finite number here: shaders may be compiled as if there were no others.

const INFINITY: f32 = 0x1.fffffep+127f;

fn normalize_or(vector: vec3<f32>, otherwise: vec3<f32>) -> vec3<f32> {
    let length = sqrt(dot(vector, vector));
    if length > 0.0 && length < INFINITY {
        return vector * (1.0 / length);
    }
    return otherwise;
}

// Light or a weight, brought within MOST_LIGHT.
fn bounded(vector: vec3<f32>) -> vec3<f32> {
    return clamp(vector, vec3(-MOST_LIGHT), vec3(MOST_LIGHT));
}

fn largest(vector: vec3<f32>) -> f32 {
    return max(max(vector.x, vector.y), vector.z);
}
