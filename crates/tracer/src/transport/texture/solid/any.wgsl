// Twin of solid.rs for scenes with any patterns.

// How far from the middle of rings a point in cells is, but for the whole rings up to a far body.
fn ring_radius(far: f32, x: f32, z: f32) -> f32 {
    if far == 0.0 {
        return sqrt(x * x + z * z);
    }
    let q = x + far;
    let whole = sqrt(q * q + z * z);
    if q > 0.0 {
        return x + z * z / (whole + q);
    }
    return x + (whole - q);
}

// The share of the second color at a point.
fn solid_share(solid: Solid, in_body: vec3<f32>) -> f32 {
    let kind = u32(solid.kind);
    if kind == CHECKER {
        return select(0.0, 1.0, solid_is_odd_cell(solid, in_body));
    }
    let x = dot(in_body, solid.x.xyz) + solid.x.w;
    if kind == GRADIENT {
        return x - floor(x);
    }
    var cell = floor(x);
    if kind == RINGS {
        let z = dot(in_body, solid.z.xyz) + solid.z.w;
        cell = floor(ring_radius(solid.far, x, z) + SOLID_BORDER);
    }
    return select(0.0, 1.0, solid_rest(cell + solid.odd_origin) == 1.0);
}

// The color at a point: those of all patterns of a row by their shares.
fn nested_color(own: vec3<f32>, outermost: u32, in_body: vec3<f32>) -> vec3<f32> {
    var shares: array<f32, MOST_SOLIDS>;
    shares[0] = 1.0;
    var sum = vec3<f32>();
    let count = min(u32(solids[outermost].count), MOST_SOLIDS);
    for (var place = 0u; place < count; place += 1u) {
        let share = shares[place];
        if share == 0.0 {
            continue;
        }
        let solid = solids[outermost + place];
        let second = solid_share(solid, in_body);
        if solid.first > 0.0 {
            shares[u32(solid.first)] = share * (1.0 - second);
        } else if solid.first_of > 0.0 {
            sum += solids[outermost + u32(solid.first_of) - 1u].color * (share * (1.0 - second));
        } else {
            sum += own * (share * (1.0 - second));
        }
        if solid.second > 0.0 {
            shares[u32(solid.second)] = share * second;
        } else {
            sum += solid.color * (share * second);
        }
    }
    return sum;
}

// The color of a body at a point of its frame; `own` is that of its material.
fn patterned(own: vec3<f32>, body: u32, in_body: vec3<f32>) -> vec3<f32> {
    let outermost = bodies[body].solid;
    if !HAS_SOLIDS || outermost == NO_BODY {
        return own;
    }
    if solids[outermost].count > 1.0 {
        return nested_color(own, outermost, in_body);
    }
    return mix(own, solids[outermost].color, solid_share(solids[outermost], in_body));
}
