// Twin of sphere.rs.

fn sphere_span(origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let inverse_dd = 1.0 / dot(direction, direction);
    let closest = -dot(origin, direction) * inverse_dd;
    let offset = origin + direction * closest;
    return chord(closest, 1.0, dot(offset, offset), inverse_dd);
}

// The same for a sphere of any radius and a direction of length 1; `origin` is relative to the center.
fn sphere_world_span(radius: f32, origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let closest = -dot(origin, direction);
    let offset = origin + direction * closest;
    return chord(closest, radius * radius, dot(offset, offset), 1.0);
}
