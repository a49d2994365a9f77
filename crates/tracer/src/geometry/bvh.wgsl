// Twin of bvh.rs: a walk of one ray through the hierarchy of boxes, eight to a node.

// A node's bytes are those of `Node`.
struct Box {
    // Least x of the boxes, greatest x, least y, greatest y, least z, greatest z.
    sides: array<vec4<f32>, 12>,
    first: array<u32, 8>,
    count: array<u32, 8>,
}

// A node of which some boxes are still to be visited: their slots, the nearest first, three bits for each, and in the
// highest bits how many.
struct StackEntry {
    node: u32,
    slots: u32,
}

struct Traversal {
    inverse: vec3<f32>,
    depth: u32,
    // Whether what has no end is still to come, as a leaf like others: shaders are compiled with all calls unfolded, so that
    // fewer places test a body.
    has_endless: bool,
    parts: array<StackEntry, DEPTH>,
}

struct Leaf {
    first: u32,
    count: u32,
}

const COUNT_SHIFT: u32 = 24u;
const NOT_MET: u32 = 0xffffffffu;

fn box_inverse(direction: f32) -> f32 {
    let tiny = select(BOX_TINY, -BOX_TINY, direction < 0.0);
    return 1.0 / select(direction, tiny, abs(direction) < BOX_TINY);
}

fn traversal_from(ray: Ray) -> Traversal {
    var walk: Traversal;
    walk.inverse = vec3(box_inverse(ray.direction.x), box_inverse(ray.direction.y), box_inverse(ray.direction.z));
    // The root: its slots are found when it is opened.
    walk.depth = 1u;
    walk.has_endless = HAS_PLANES;
    walk.parts[0] = StackEntry(0u, slots_met(0u, ray.origin, walk.inverse, INFINITY));
    return walk;
}

// The next bodies that the ray may meet before `reach`.
fn traversal_next(walk: ptr<function, Traversal>, ray: Ray, reach: f32) -> Leaf {
    if (*walk).has_endless {
        (*walk).has_endless = false;
        if frame.bounded < frame.bodies {
            return Leaf(frame.bounded, frame.bodies - frame.bounded);
        }
    }
    while (*walk).depth > 0u {
        let depth = (*walk).depth;
        let part = (*walk).parts[depth - 1u];
        let left = part.slots >> COUNT_SHIFT;
        if left == 0u {
            (*walk).depth = depth - 1u;
            continue;
        }
        let slot = part.slots & 7u;
        (*walk).parts[depth - 1u].slots = ((part.slots & 0xffffffu) >> 3u) | ((left - 1u) << COUNT_SHIFT);
        // What was met since may have brought `reach` before this box.
        if !slot_is_met(part.node, slot, ray.origin, (*walk).inverse, reach) {
            continue;
        }
        let first = boxes[part.node].first[slot];
        let count = boxes[part.node].count[slot];
        if count > 0u {
            return Leaf(first, count);
        }
        if depth < DEPTH {
            (*walk).parts[depth] = StackEntry(first, slots_met(first, ray.origin, (*walk).inverse, reach));
            (*walk).depth = depth + 1u;
        }
    }
    return Leaf(0u, 0u);
}

fn slot_is_met(node: u32, slot: u32, origin: vec3<f32>, inverse: vec3<f32>, reach: f32) -> bool {
    let half = slot / 4u;
    let lane = slot % 4u;
    let low = vec3(boxes[node].sides[half][lane], boxes[node].sides[4u + half][lane], boxes[node].sides[8u + half][lane]);
    let high = vec3(boxes[node].sides[2u + half][lane], boxes[node].sides[6u + half][lane], boxes[node].sides[10u + half][lane]);
    let at_low = (low - origin) * inverse;
    let at_high = (high - origin) * inverse;
    let enter = max(largest(min(at_low, at_high)), 0.0);
    let far = max(at_low, at_high);
    return enter <= min(min(min(far.x, far.y), far.z) * BOX_WIDEN, reach);
}

// Where the ray enters four boxes of a node, as words that order like numbers, with the slot in the lowest bits.
fn keys_of_four(node: u32, half: u32, origin: vec3<f32>, inverse: vec3<f32>, reach: f32) -> vec4<u32> {
    let low_x = (boxes[node].sides[half] - origin.x) * inverse.x;
    let high_x = (boxes[node].sides[2u + half] - origin.x) * inverse.x;
    let low_y = (boxes[node].sides[4u + half] - origin.y) * inverse.y;
    let high_y = (boxes[node].sides[6u + half] - origin.y) * inverse.y;
    let low_z = (boxes[node].sides[8u + half] - origin.z) * inverse.z;
    let high_z = (boxes[node].sides[10u + half] - origin.z) * inverse.z;
    let near = max(max(min(low_x, high_x), min(low_y, high_y)), min(low_z, high_z));
    let far = min(min(max(low_x, high_x), max(low_y, high_y)), max(low_z, high_z));
    let enter = max(near, vec4(0.0));
    let met = enter <= min(far * BOX_WIDEN, vec4(reach));
    // An unused box is inside out, but infinite numbers are nothing to rely on.
    let used = boxes[node].sides[half] <= boxes[node].sides[2u + half];
    let slots = vec4(0u, 1u, 2u, 3u) + vec4(half * 4u);
    let keys = (bitcast<vec4<u32>>(enter) & vec4(0xfffffff8u)) | slots;
    return select(vec4(NOT_MET), keys, met & used);
}

// The slots of a node that the ray meets before `reach`, as a `StackEntry` has them: Batcher's odd-even merge sort (1968).
fn slots_met(node: u32, origin: vec3<f32>, inverse: vec3<f32>, reach: f32) -> u32 {
    let a = keys_of_four(node, 0u, origin, inverse, reach);
    let b = keys_of_four(node, 1u, origin, inverse, reach);
    let count = dot(select(vec4(1u), vec4(0u), a == vec4(NOT_MET)) + select(vec4(1u), vec4(0u), b == vec4(NOT_MET)), vec4(1u));
    // Both halves at once: exchange 0-1 and 2-3, 0-2 and 1-3, 1-2.
    let a1 = sorted_four(a);
    let b1 = sorted_four(b);
    // Merging: 0-4, 1-5, 2-6, 3-7; then 2-4, 3-5; then 1-2, 3-4, 5-6.
    let low = min(a1, b1);
    let high = max(a1, b1);
    let k2 = min(low.z, high.x);
    let k4 = max(low.z, high.x);
    let k3 = min(low.w, high.y);
    let k5 = max(low.w, high.y);
    let s1 = min(low.y, k2);
    let s2 = max(low.y, k2);
    let s3 = min(k3, k4);
    let s4 = max(k3, k4);
    let s5 = min(k5, high.z);
    let s6 = max(k5, high.z);
    return (low.x & 7u) | ((s1 & 7u) << 3u) | ((s2 & 7u) << 6u) | ((s3 & 7u) << 9u) | ((s4 & 7u) << 12u)
        | ((s5 & 7u) << 15u) | ((s6 & 7u) << 18u) | ((high.w & 7u) << 21u) | (count << COUNT_SHIFT);
}

fn sorted_four(k: vec4<u32>) -> vec4<u32> {
    let low = vec2(min(k.x, k.y), min(k.z, k.w));
    let high = vec2(max(k.x, k.y), max(k.z, k.w));
    let second = max(low.x, low.y);
    let third = min(high.x, high.y);
    return vec4(min(low.x, low.y), min(second, third), max(second, third), max(high.x, high.y));
}
