// Twin of cylinder.rs.

fn cylinder_span(origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let caps = slab_closed(origin.y, direction.y, 0.0, LOWER_CAP, 1.0, UPPER_CAP);
    return intersect(cylinder_side(origin.xz, direction.xz), caps);
}

fn cylinder_side(origin: vec2<f32>, direction: vec2<f32>) -> Span {
    let dd = dot(direction, direction);
    let is_along = dd < LEAST_NORMAL;
    let inverse_dd = 1.0 / select(dd, 1.0, is_along);
    let closest = -dot(origin, direction) * inverse_dd;
    let offset = origin + direction * closest;
    var span = chord(closest, 1.0, dot(offset, offset), inverse_dd);
    span.enter = select(span.enter, -INFINITY, is_along);
    span.exit = select(span.exit, INFINITY, is_along);
    return span;
}
