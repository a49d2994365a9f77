// Twin of joined.rs: bodies joined of others. The record of one stands behind the order of the bodies: the first of its
// parts and their number; those that it lies outside of; its place in the order of volumes and the number of its gates,
// with SURFACE if it is a surface without inside, of which rays may pass a side.

fn is_joined(index: u32) -> bool {
    return body_kind(index) >= JOINED;
}

// The start of a ray at the surface of a body, as the whole has it that the body is a part of.
fn whole_of(start: u32) -> u32 {
    let body = start & NO_START;
    if body < frame.bodies {
        return start;
    }
    return scene_order[body].y ^ (start & INWARDS);
}

fn is_surface(record: u32) -> bool {
    return (scene_order[record + 2u].y & SURFACE) != 0u;
}

// Whether a body is a surface.
fn has_no_inside(index: u32) -> bool {
    return is_joined(index) && is_surface(scene_order[index].y);
}

// The place of a body in the order of volumes.
fn volume_order(body: u32) -> u32 {
    let own = scene_order[body].y;
    if is_joined(body) {
        return scene_order[own + 2u].x;
    }
    return own;
}

// A bit for a part.
fn bit_of(part: u32) -> vec2<u32> {
    let bit = 1u << (part % 32u);
    return select(vec2(bit, 0u), vec2(0u, bit), part >= 32u);
}

fn has_bit(bits: vec2<u32>, part: u32) -> bool {
    return any((bits & bit_of(part)) != vec2(0u));
}

// Whether a point lies in a whole that is on the right side of these parts.
fn gates_hold(record: u32, right: vec2<u32>) -> bool {
    // A bit for each depth: whether a gate there is open, or shut.
    var open = 0u;
    var shut = 0u;
    let gates = scene_order[record + 2u].y & ~(SURFACE | HIDES_OUTER | HIDES_INNER);
    let end = record + 3u + 2u * gates;
    for (var gate = record + 3u; gate < end; gate += 2u) {
        let parts = scene_order[gate];
        let depth = scene_order[gate + 1u].x;
        let own = 1u << depth;
        let below = 2u << depth;
        let met = right & parts;
        let all_open = all(met == parts) && (shut & below) == 0u;
        let any_open = any(met != vec2(0u)) || (open & below) != 0u;
        let is_open = select(any_open, all_open, scene_order[gate + 1u].y != 0u);
        open = (open & ~below) | select(0u, own, is_open);
        shut = (shut & ~below) | select(own, 0u, is_open);
    }
    return (open & 1u) != 0u;
}

// Whether a point lies in the whole that lies in these parts.
fn join_holds(record: u32, parts: vec2<u32>) -> bool {
    return gates_hold(record, parts ^ scene_order[record + 1u]);
}

// Whether a line may come through the whole that comes through these parts: how much is cut away is not known yet.
fn join_is_possible(record: u32, met: vec2<u32>) -> bool {
    return gates_hold(record, met | scene_order[record + 1u]);
}

fn joined_contains(index: u32, point: vec3<f32>) -> bool {
    let record = scene_order[index].y;
    if is_surface(record) {
        return false;
    }
    let own = scene_order[record];
    var around = vec2(0u);
    for (var part = 0u; part < own.y; part++) {
        if body_contains(own.x + part, point) {
            around |= bit_of(part);
        }
    }
    return join_holds(record, around);
}
