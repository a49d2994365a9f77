// Twin of texture.rs.

struct Place {
    u: f32,
    v: f32,
    // Whether the picture goes on from its other edge beside it, and above and below it.
    repeats: vec2<bool>,
}

// The color of a body, but for its pattern, at a point of its own frame: below 0 stands a picture.
fn color_at(color: vec3<f32>, body: u32, in_body: vec3<f32>) -> vec3<f32> {
    if color.x >= 0.0 {
        return color;
    }
    let place = texture_place(body_kind(body), bodies[body].parameter, in_body);
    return image_at(u32(-1.0 - color.x), place.u, place.v, place.repeats);
}

// A square as wide as 2, seen from its front.
fn flat_place(right: f32, down: f32) -> Place {
    return Place(0.5 + 0.5 * right, 0.5 + 0.5 * down, vec2(false));
}

// Where a point of a body's surface lies in the picture: its middle is where z is largest, seen upright from outside.
fn texture_place(kind: u32, ratio: f32, point: vec3<f32>) -> Place {
    if HAS_PLANES && kind == PLANE {
        return Place(point.x, fract(point.z), vec2(true));
    }
    if HAS_CUBES && kind == CUBE {
        let far = abs(point);
        // A number is at least 0, or below.
        if far.x > max(far.y, far.z) {
            return flat_place(-point.z * select(1.0, -1.0, point.x < 0.0), -point.y);
        }
        if far.y > far.z {
            return flat_place(point.x, point.z * select(1.0, -1.0, point.y < 0.0));
        }
        return flat_place(point.x * select(1.0, -1.0, point.z < 0.0), -point.y);
    }
    let around = 0.5 + angle_of(point.x, point.z) / (2.0 * PI);
    let is_cone = HAS_CONES && kind == CONE;
    if is_cone || (HAS_CYLINDERS && kind == CYLINDER) {
        if point.y >= 1.0 - TEXTURE_LEVEL {
            let radius = max(select(1.0, ratio, is_cone), TEXTURE_LEVEL);
            return flat_place(point.x / radius, point.z / radius);
        }
        if point.y <= TEXTURE_LEVEL {
            return flat_place(point.x, -point.z);
        }
        return Place(around, 1.0 - point.y, vec2(true, false));
    }
    if HAS_PARABOLOIDS && kind == PARABOLOID {
        if point.y >= 1.0 - TEXTURE_LEVEL {
            return flat_place(point.x, point.z);
        }
        return Place(around, 1.0 - sqrt(max(point.y, 0.0)), vec2(true, false));
    }
    return Place(around, 0.5 - angle_of(point.y, length(point.xz)) / PI, vec2(true, false));
}
