// Twin of query/joined.rs: where a ray crosses the surface of a joined body, one crossing after the other.

struct JoinedCrossing {
    t: f32,
    // The part that makes the surface there.
    part: u32,
    // Whether the ray enters the whole, whatever it does to the part; of a surface, the part.
    enters: bool,
    hit: bool,
}

// Where a ray crosses the surface of a part.
struct PartCrossing {
    t: f32,
    part: u32,
    enters: bool,
    hit: bool,
}

// A ray on its way through a joined body.
struct JoinedWalk {
    record: u32,
    first: u32,
    // The parts that the whole lies outside of.
    inverted: vec2<u32>,
    // The parts that are entered ahead, and those that are left.
    enters: vec2<u32>,
    exits: vec2<u32>,
    // The parts that the ray is in, and whether it is in the whole.
    parts: vec2<u32>,
    is_inside: bool,
}

// Where the ray enters each part and leaves it, and the faces that it crosses there.
var<private> part_spans: array<vec2<f32>, PARTS>;
var<private> part_faces: array<vec2<u32>, PARTS>;

// Of a ray that may start on one of the parts, or in the whole.
fn joined_walk(index: u32, ray: Ray, media: ptr<function, Media>) -> JoinedWalk {
    let record = scene_order[index].y;
    let first = scene_order[record].x;
    let count = min(scene_order[record].y, PARTS);
    let inverted = scene_order[record + 1u];
    var walk = JoinedWalk(record, first, inverted, vec2(0u), vec2(0u), vec2(0u), false);
    let own = (ray.start & NO_START) - first;
    let is_own = own < count;
    let heads_in = (ray.start & INWARDS) != 0u;
    var is_known = is_own;
    var known = heads_in != has_bit(inverted, own);
    if !is_own && body_is_transparent(index) {
        is_known = true;
        known = media_contains(media, index);
    }
    // Crossings at the start itself, within rounding.
    var at_enter = vec2(0u);
    var at_exit = vec2(0u);
    var met = vec2(0u);
    for (var part = 0u; part < count; part++) {
        let bit = bit_of(part);
        var span = body_span(first + part, ray.origin, ray.direction);
        if HAS_PLANES && !span.hit && body_kind(first + part) == PLANE {
            // A line along the surface of a half-space never leaves it.
            let up = body_up(first + part);
            let is_within = dot(up, ray.direction) == 0.0 && dot(up, ray.origin - body_origin(first + part)) <= 0.0;
            if is_within {
                span = Span(-INFINITY, INFINITY, SIDE, SIDE, true);
            }
        }
        if span.hit || (is_own && part == own && heads_in) {
            met |= bit;
        }
        part_faces[part] = vec2(span.enter_face, span.exit_face);
        if is_own && part == own {
            // It is met once more from within, and never from outside.
            if heads_in {
                walk.parts |= bit;
                walk.exits |= bit;
                part_spans[part].y = max(span.exit, 0.0);
            }
            continue;
        }
        if !span.hit {
            continue;
        }
        part_spans[part] = vec2(span.enter, span.exit);
        let starts = at_start(first + part, ray, span);
        if starts.x {
            at_enter |= bit;
        } else if span.enter > 0.0 {
            walk.enters |= bit;
        } else {
            walk.parts ^= bit;
        }
        if starts.y {
            at_exit |= bit;
        } else if span.exit > 0.0 {
            walk.exits |= bit;
        } else {
            walk.parts ^= bit;
        }
    }
    if is_surface(record) {
        // Of the other parts it only counts what lies in them. A ray from an opaque body is going back.
        is_known = false;
        let start = ray.start & NO_START;
        let goes_back = start != NO_START && !body_is_transparent(start);
        let of_first = vec2(select(1u, 0u, goes_back), 0u);
        at_enter &= of_first;
        at_exit &= of_first;
    }
    if !join_is_possible(record, met) {
        walk.enters = vec2(0u);
        walk.exits = vec2(0u);
        return walk;
    }
    settle_start(&walk, at_enter, at_exit, vec2(is_known, known), is_own);
    if is_surface(record) {
        keep_surface(&walk, count, met);
    }
    return walk;
}

// Of the crossings ahead keeps those of the first part's surface that are seen and lie in the other parts, of which the
// line comes through those `met`.
fn keep_surface(walk: ptr<function, JoinedWalk>, count: u32, met: vec2<u32>) {
    let kind = body_kind((*walk).first);
    let has_caps = kind == CYLINDER || kind == CONE || kind == PARABOLOID;
    var shown = vec2(false);
    for (var side = 0u; side < 2u; side++) {
        let t = part_spans[0][side];
        var around = vec2(1u, 0u);
        for (var part = 1u; part < count; part++) {
            let span = part_spans[part];
            if has_bit(met, part) && span.x <= t && t <= span.y {
                around |= bit_of(part);
            }
        }
        let hides = select(HIDES_OUTER, HIDES_INNER, side == 1u);
        let is_seen = (scene_order[(*walk).record + 2u].y & hides) == 0u;
        let is_shown = is_seen && (!has_caps || part_faces[0][side] == SIDE) && join_holds((*walk).record, around);
        shown |= vec2(is_shown) & (vec2(0u, 1u) == vec2(side));
    }
    (*walk).enters &= vec2(u32(shown.x), 0u);
    (*walk).exits &= vec2(u32(shown.y), 0u);
    (*walk).is_inside = false;
}

// Decides which of the crossings at the ray's start are behind it and which ahead. `known` tells whether it is known that
// the ray starts inside, and whether it does.
fn settle_start(
    walk: ptr<function, JoinedWalk>,
    at_enter: vec2<u32>,
    at_exit: vec2<u32>,
    known: vec2<bool>,
    is_own: bool,
) {
    // From a surface of the body all are behind, else those that lead out of it.
    var enters = at_enter & select((*walk).inverted, vec2(0xffffffffu), is_own);
    var exits = at_exit & select(~(*walk).inverted, vec2(0xffffffffu), is_own);
    var parts = (*walk).parts ^ enters ^ exits;
    var is_inside = join_holds((*walk).record, parts);
    if known.x && is_inside != known.y && any((at_enter | at_exit) != vec2(0u)) {
        // If that is not right, it is the other way round.
        let turned = (*walk).parts ^ (at_enter & ~enters) ^ (at_exit & ~exits);
        if join_holds((*walk).record, turned) == known.y {
            parts = turned;
            enters = at_enter & ~enters;
            exits = at_exit & ~exits;
        }
    }
    (*walk).parts = parts;
    (*walk).is_inside = select(is_inside, known.y, known.x);
    let enters_ahead = at_enter & ~enters;
    let exits_ahead = at_exit & ~exits;
    (*walk).enters |= enters_ahead;
    (*walk).exits |= exits_ahead;
    for (var left = enters_ahead | exits_ahead; any(left != vec2(0u)); left &= ~bit_of(first_bit(left))) {
        let part = first_bit(left);
        if has_bit(enters_ahead, part) {
            part_spans[part].x = 0.0;
        }
        if has_bit(exits_ahead, part) {
            part_spans[part].y = 0.0;
        }
    }
}

fn first_bit(bits: vec2<u32>) -> u32 {
    return select(32u + firstTrailingBit(bits.y), firstTrailingBit(bits.x), bits.x != 0u);
}

// Whether the crossings of a part may lie at the start but for rounding, measured across the surface.
fn at_start(body: u32, ray: Ray, span: Span) -> vec2<bool> {
    let bound = ray.slack + bodies[body].slack;
    var is_at_start = abs(vec2(span.enter, span.exit)) <= vec2(bound * GRAZING);
    if any(is_at_start) {
        // In a loop, since shaders are compiled with all calls unfolded.
        for (var side = 0u; side < 2u; side++) {
            let leaves = side == 1u;
            let t = select(span.enter, span.exit, leaves);
            let face = select(span.enter_face, span.exit_face, leaves);
            let is_far = abs(t) * body_cosine(body, ray.origin, ray.direction, t, face) > bound;
            is_at_start &= vec2(!is_far) | (vec2(0u, 1u) != vec2(side));
        }
    }
    return is_at_start;
}

// The nearest crossing of these parts; of equal ones the first of those that lead in, so that no part is left before it is
// entered.
fn nearest_crossing(enters: vec2<u32>, exits: vec2<u32>) -> PartCrossing {
    var enter = PartCrossing(INFINITY, 0u, true, false);
    var exit = PartCrossing(INFINITY, 0u, false, false);
    for (var left = enters | exits; any(left != vec2(0u)); left &= ~bit_of(first_bit(left))) {
        let part = first_bit(left);
        let span = part_spans[part];
        if has_bit(enters, part) && span.x < enter.t {
            enter = PartCrossing(span.x, part, true, true);
        }
        if has_bit(exits, part) && span.y < exit.t {
            exit = PartCrossing(span.y, part, false, true);
        }
    }
    if exit.t < enter.t {
        return exit;
    }
    return enter;
}

// The next crossing of the surface of the whole.
fn joined_next(walk: ptr<function, JoinedWalk>, ray: Ray) -> JoinedCrossing {
    // Each crossing of a surface counts, and leads into nothing.
    let is_only = is_surface((*walk).record);
    while any(((*walk).enters | (*walk).exits) != vec2(0u)) {
        var first = PartCrossing(0.0, 0u, false, false);
        // Those that coincide with the first one.
        var entered = vec2(0u);
        var left = vec2(0u);
        loop {
            let other = nearest_crossing((*walk).enters, (*walk).exits);
            let is_next = !first.hit || (!is_only && coincides((*walk).first, ray, first, other));
            if !other.hit || !is_next {
                break;
            }
            if !first.hit {
                first = other;
            }
            let bit = bit_of(other.part);
            if other.enters {
                entered |= bit;
                (*walk).enters &= ~bit;
            } else {
                left |= bit;
                (*walk).exits &= ~bit;
            }
        }
        if !first.hit {
            break;
        }
        if is_only {
            return JoinedCrossing(first.t, (*walk).first, first.enters, true);
        }
        let before = (*walk).parts;
        let parts = before ^ entered ^ left;
        let is_inside = join_holds((*walk).record, parts);
        (*walk).parts = parts;
        if is_inside != (*walk).is_inside {
            (*walk).is_inside = is_inside;
            let leading = (entered & select((*walk).inverted, ~(*walk).inverted, is_inside))
                | (left & select(~(*walk).inverted, (*walk).inverted, is_inside));
            var part = first.part;
            var t = first.t;
            if any((entered ^ left) != bit_of(part)) && any(leading != vec2(0u)) {
                part = deciding_part((*walk).record, before, parts, leading, is_inside);
                t = select(part_spans[part].x, part_spans[part].y, is_inside == has_bit((*walk).inverted, part));
            }
            return JoinedCrossing(t, (*walk).first + part, is_inside, true);
        }
    }
    return JoinedCrossing(INFINITY, 0u, false, false);
}

// Of crossings that coincide and lead where the ray comes to, the first in the scene makes the surface: of those without
// which the ray would not be through, or which alone bring it through.
fn deciding_part(record: u32, before: vec2<u32>, parts: vec2<u32>, leading: vec2<u32>, is_inside: bool) -> u32 {
    for (var left = leading; any(left != vec2(0u)); left &= ~bit_of(first_bit(left))) {
        let bit = bit_of(first_bit(left));
        var decides = false;
        for (var side = 0u; side < 2u; side++) {
            let is_beyond = side == 1u;
            let holds = join_holds(record, select(before, parts, is_beyond) ^ bit);
            decides |= (holds == is_inside) != is_beyond;
        }
        if decides {
            return first_bit(left);
        }
    }
    return first_bit(leading);
}

// Whether a crossing is where the first one is, but for rounding, measured across the surfaces.
fn coincides(first_part: u32, ray: Ray, first: PartCrossing, other: PartCrossing) -> bool {
    let one = first_part + first.part;
    let two = first_part + other.part;
    let bound = error_bound_at(ray, first.t, max(bodies[one].slack, bodies[two].slack));
    let apart = other.t - first.t;
    if apart > bound * GRAZING {
        return false;
    }
    var cosine = 0.0;
    var crossing = first;
    // In a loop, since shaders are compiled with all calls unfolded.
    for (var which = 0u; which < 2u; which++) {
        let faces = part_faces[crossing.part];
        let face = select(faces.y, faces.x, crossing.enters);
        let own_cosine =
            body_cosine(first_part + crossing.part, ray.origin, ray.direction, crossing.t, face);
        cosine = max(cosine, own_cosine);
        crossing = other;
    }
    return apart * cosine <= bound;
}

// Where a ray first crosses the surface of a joined body, and the part that makes it there.
fn joined_meeting(index: u32, ray: Ray, media: ptr<function, Media>, part: ptr<function, u32>) -> BodyIntersection {
    var walk = joined_walk(index, ray, media);
    let crossing = joined_next(&walk, ray);
    *part = crossing.part;
    let enters = crossing.hit && crossing.enters;
    return BodyIntersection(enters, crossing.t, crossing.hit && !enters, crossing.t);
}

// What the surfaces of a joined body let through on the way to a light at `distance`.
fn filter_through_joined(index: u32, ray: Ray, media: ptr<function, Media>, distance: f32) -> vec3<f32> {
    var walk = joined_walk(index, ray, media);
    var share = vec3(1.0);
    // The part of the way that the ray is in the body.
    var is_in = walk.is_inside;
    var is_within = is_in;
    var enter = 0.0;
    loop {
        let crossing = joined_next(&walk, ray);
        let is_met = crossing.hit && crossing.t < distance;
        if ABSORBS && is_in && body_is_transparent(index) {
            let exit = select(distance, crossing.t, is_met);
            note_interval(index, BodyIntersection(!is_within, enter, is_within, exit), distance, media);
        }
        if !is_met {
            break;
        }
        if body_stops_light(crossing.part) {
            share = vec3(0.0);
            break;
        }
        if CEMENTED && body_is_cementable(index) {
            note_crossing(crossing.t, crossing.part, !crossing.enters);
        } else {
            share *= filter_of(crossing.part);
        }
        is_in = crossing.enters && !is_surface(walk.record);
        is_within = false;
        enter = crossing.t;
    }
    return share;
}
