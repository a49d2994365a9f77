// Twin of cone.rs.

fn cone_span(ratio: f32, origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let shift = dot(vec3(0.0, 1.0, 0.0) - origin, direction) / dot(direction, direction);
    let near = origin + direction * shift;
    var span = cone_nappe(ratio - 1.0, near, direction);
    span.enter = span.enter + shift;
    span.exit = span.exit + shift;
    return intersect(span, slab_closed(origin.y, direction.y, 0.0, LOWER_CAP, 1.0, UPPER_CAP));
}

fn cone_nappe(slope: f32, origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let radius = origin.y * slope + 1.0;
    let radius_change = direction.y * slope;
    let a = direction.x * direction.x + direction.z * direction.z - radius_change * radius_change;
    let b = origin.x * direction.x + origin.z * direction.z - radius * radius_change;
    let c = origin.x * origin.x + origin.z * origin.z - radius * radius;
    let discriminant = b * b - a * c;
    let root = sqrt(max(discriminant, 0.0));
    let b_rises = b > 0.0;
    let q = select(root - b, -(b + root), b_rises);
    let is_line = a == 0.0;
    let is_between = a > 0.0;
    let misses = is_between && discriminant < 0.0;
    let is_flat = q == 0.0 && !misses;
    let first = q / select(a, 1.0, is_line);
    let second = c / select(q, 1.0, q == 0.0);
    let low = min(first, second);
    let high = max(first, second);
    var enter: f32;
    var exit: f32;
    if is_between {
        enter = low;
        exit = high;
    } else if is_line {
        enter = select(second, -INFINITY, b_rises);
        exit = select(INFINITY, second, b_rises);
    } else {
        let widens = radius_change > 0.0;
        enter = select(-INFINITY, high, widens);
        exit = select(low, INFINITY, widens);
    }
    var hit = enter <= exit;
    if misses {
        enter = first;
        exit = first;
        hit = false;
    }
    if is_flat {
        enter = select(-INFINITY, 0.0, is_between);
        exit = select(INFINITY, 0.0, is_between);
        hit = is_between || c <= 0.0;
    }
    return Span(enter, exit, SIDE, SIDE, hit);
}

// A vector in the xz-plane made of length 1, or 0 if it has none.
fn cone_around(point: vec3<f32>) -> vec3<f32> {
    return normalize_or(vec3(point.x, 0.0, point.z), vec3(0.0));
}

fn cone_pull_to_surface(ratio: f32, face: u32, point: vec3<f32>) -> vec3<f32> {
    if face == SIDE {
        let y = clamp(point.y, 0.0, 1.0);
        let side = cone_around(point) * (y * (ratio - 1.0) + 1.0);
        return vec3(side.x, y, side.z);
    }
    return vec3(point.x, select(1.0, 0.0, face == LOWER_CAP), point.z);
}

fn cone_normal(ratio: f32, face: u32, point: vec3<f32>) -> vec3<f32> {
    if face == SIDE {
        let around = cone_around(point);
        let side = vec3(around.x, 1.0 - ratio, around.z);
        return select(side, vec3(0.0, 1.0, 0.0), all(side == vec3(0.0)));
    }
    return vec3(0.0, select(1.0, -1.0, face == LOWER_CAP), 0.0);
}

fn cone_contains(ratio: f32, point: vec3<f32>) -> bool {
    let radius = 1.0 + (ratio - 1.0) * point.y;
    return point.y >= 0.0 && point.y <= 1.0 && point.x * point.x + point.z * point.z <= radius * radius;
}
