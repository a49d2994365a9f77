// Twin of paraboloid.rs.

fn paraboloid_span(origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let shift = dot(vec3(0.0, 1.0, 0.0) - origin, direction) / dot(direction, direction);
    let near = origin + direction * shift;
    var span = paraboloid_side(near, direction);
    span.enter = span.enter + shift;
    span.exit = span.exit + shift;
    return intersect(span, slab_closed(origin.y, direction.y, -INFINITY, SIDE, 1.0, UPPER_CAP));
}

fn paraboloid_side(origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let a = direction.x * direction.x + direction.z * direction.z;
    let b = origin.x * direction.x + origin.z * direction.z - direction.y * 0.5;
    let c = origin.x * origin.x + origin.z * origin.z - origin.y;
    let discriminant = b * b - a * c;
    let root = sqrt(max(discriminant, 0.0));
    let b_rises = b > 0.0;
    let q = select(root - b, -(b + root), b_rises);
    let is_along = a == 0.0;
    let first = q / select(a, 1.0, is_along);
    let second = c / select(q, 1.0, q == 0.0);
    if discriminant < 0.0 {
        return Span(first, first, SIDE, SIDE, false);
    }
    var enter = min(first, second);
    var exit = max(first, second);
    if is_along {
        enter = select(second, -INFINITY, b_rises);
        exit = select(INFINITY, second, b_rises);
    }
    return Span(enter, exit, SIDE, SIDE, enter <= exit);
}

fn paraboloid_pull_to_surface(face: u32, point: vec3<f32>) -> vec3<f32> {
    if face == SIDE {
        let around = point.x * point.x + point.z * point.z;
        let shrink = 1.0 / sqrt(max(around, 1.0));
        return vec3(point.x * shrink, min(around, 1.0), point.z * shrink);
    }
    return vec3(point.x, 1.0, point.z);
}

fn paraboloid_normal(face: u32, point: vec3<f32>) -> vec3<f32> {
    return select(vec3(0.0, 1.0, 0.0), vec3(2.0 * point.x, -1.0, 2.0 * point.z), face == SIDE);
}

fn paraboloid_contains(point: vec3<f32>) -> bool {
    return point.x * point.x + point.z * point.z <= point.y && point.y <= 1.0;
}
