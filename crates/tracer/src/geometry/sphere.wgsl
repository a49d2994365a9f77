// Twin of sphere.rs: a walk over the bounding spheres of a handful of bodies.

// Center and radius.
alias Box = vec4<f32>;

struct Traversal {
    next: u32,
    // Whether what has no end is still to come, as a leaf.
    has_endless: bool,
}

// Some bodies, one after another; none at the end of a walk.
struct Leaf {
    first: u32,
    count: u32,
}

fn traversal_from(ray: Ray) -> Traversal {
    return Traversal(0u, HAS_PLANES);
}

// The next bodies that the ray may meet before `reach`.
fn traversal_next(walk: ptr<function, Traversal>, ray: Ray, reach: f32) -> Leaf {
    if (*walk).has_endless {
        (*walk).has_endless = false;
        if frame.bounded < frame.bodies {
            return Leaf(frame.bounded, frame.bodies - frame.bounded);
        }
    }
    while (*walk).next < frame.bounded {
        let index = (*walk).next;
        (*walk).next = index + 1u;
        if body_kind(index) == SPHERE || sphere_is_met(boxes[index], ray, reach) {
            return Leaf(index, 1u);
        }
    }
    return Leaf(0u, 0u);
}

fn sphere_is_met(sphere: vec4<f32>, ray: Ray, reach: f32) -> bool {
    let to_center = sphere.xyz - ray.origin;
    let along = dot(to_center, ray.direction);
    let within = along * along + sphere.w * sphere.w * (1.0 + SPHERE_ROUNDING);
    let radius = sphere.w * (1.0 + SPHERE_ROUNDING);
    return within >= dot(to_center, to_center) * (1.0 - SPHERE_ROUNDING)
        && along >= -radius
        && along * (1.0 - POINT_ROUNDING) - radius <= reach;
}
