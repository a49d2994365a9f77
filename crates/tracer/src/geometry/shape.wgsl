// Twin of shape.rs.

struct Span {
    enter: f32,
    exit: f32,
    enter_face: u32,
    exit_face: u32,
    hit: bool,
}

fn chord(closest: f32, radius_squared: f32, offset_squared: f32, inverse_dd: f32) -> Span {
    let half_squared = (radius_squared - offset_squared) * inverse_dd;
    let half = sqrt(max(half_squared, 0.0));
    return Span(closest - half, closest + half, SIDE, SIDE, half_squared >= 0.0);
}

fn intersect(one: Span, other: Span) -> Span {
    let later = other.enter > one.enter;
    let earlier = other.exit < one.exit;
    let enter = select(one.enter, other.enter, later);
    let exit = select(one.exit, other.exit, earlier);
    return Span(
        enter,
        exit,
        select(one.enter_face, other.enter_face, later),
        select(one.exit_face, other.exit_face, earlier),
        one.hit && other.hit && enter <= exit,
    );
}

// Where a line crosses a canonical shape in its own frame.
fn canonical_span(kind: u32, ratio: f32, origin: vec3<f32>, direction: vec3<f32>) -> Span {
    if HAS_CUBES && kind == CUBE {
        return cube_span(origin, direction);
    }
    if HAS_CYLINDERS && kind == CYLINDER {
        return cylinder_span(origin, direction);
    }
    if HAS_CONES && kind == CONE {
        return cone_span(ratio, origin, direction);
    }
    if HAS_PARABOLOIDS && kind == PARABOLOID {
        return paraboloid_span(origin, direction);
    }
    return sphere_span(origin, direction);
}

fn pull_to_surface(kind: u32, ratio: f32, face: u32, point: vec3<f32>) -> vec3<f32> {
    if HAS_CUBES && kind == CUBE {
        return cube_pull_to_surface(face, point);
    }
    if HAS_CYLINDERS && kind == CYLINDER {
        return cone_pull_to_surface(1.0, face, point);
    }
    if HAS_CONES && kind == CONE {
        return cone_pull_to_surface(ratio, face, point);
    }
    if HAS_PARABOLOIDS && kind == PARABOLOID {
        return paraboloid_pull_to_surface(face, point);
    }
    return normalize_or(point, vec3(0.0, 1.0, 0.0));
}

fn canonical_normal(kind: u32, ratio: f32, face: u32, point: vec3<f32>) -> vec3<f32> {
    if HAS_CUBES && kind == CUBE {
        return cube_normal(face);
    }
    if HAS_CYLINDERS && kind == CYLINDER {
        return cone_normal(1.0, face, point);
    }
    if HAS_CONES && kind == CONE {
        return cone_normal(ratio, face, point);
    }
    if HAS_PARABOLOIDS && kind == PARABOLOID {
        return paraboloid_normal(face, point);
    }
    return point;
}

fn canonical_contains(kind: u32, ratio: f32, point: vec3<f32>) -> bool {
    switch kind {
        case CUBE: {
            return largest(abs(point)) <= 1.0;
        }
        case CYLINDER: {
            return cone_contains(1.0, point);
        }
        case CONE: {
            return cone_contains(ratio, point);
        }
        case PARABOLOID: {
            return paraboloid_contains(point);
        }
        case PLANE: {
            return point.y <= 0.0;
        }
        default: {
            return dot(point, point) <= 1.0;
        }
    }
}
