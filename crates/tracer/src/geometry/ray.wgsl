// Twin of ray.rs.

struct Ray {
    origin: vec3<f32>,
    // How far the start may lie from its true place by rounding, meters.
    slack: f32,
    // Of length 1.
    direction: vec3<f32>,
    // The body whose surface the ray starts on, and INWARDS if it heads into that body; or NO_START.
    start: u32,
}

fn ray_from(origin: vec3<f32>, direction: vec3<f32>, start: u32) -> Ray {
    let most = max(max(abs(origin.x), abs(origin.y)), abs(origin.z));
    return Ray(origin, most * POINT_ROUNDING, direction, start);
}
