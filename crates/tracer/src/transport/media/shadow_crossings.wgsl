// Twin of shadow_crossings.rs: what passes cemented contacts on the way to a light.

// Where a shadow ray crosses the surface of a clear body that may be cemented.
struct ShadowCrossing {
    t: f32,
    body: u32,
    leaving: bool,
    // Whether another body was left here, which took its share.
    is_behind: bool,
}

// Those of one shadow ray, in order. A ray that needs more room is told of, and the picture is not used.
var<private> crossings: array<ShadowCrossing, MOST_CROSSINGS>;
var<private> crossing_count: u32 = 0u;

fn forget_crossings() {
    crossing_count = 0u;
}

fn is_crossed_before(a: ShadowCrossing, b: ShadowCrossing) -> bool {
    if a.t != b.t {
        return a.t < b.t;
    }
    if a.leaving != b.leaving {
        return a.leaving;
    }
    return comes_before(a.body, b.body);
}

fn note_crossing(t: f32, body: u32, leaving: bool) {
    if crossing_count == MOST_CROSSINGS {
        media_overflowed = true;
        return;
    }
    let crossing = ShadowCrossing(t, body, leaving, false);
    var place = crossing_count;
    for (; place > 0u; place--) {
        if !is_crossed_before(crossing, crossings[place - 1u]) {
            break;
        }
        crossings[place] = crossings[place - 1u];
    }
    crossings[place] = crossing;
    crossing_count += 1u;
}

// The place of the crossing that is cemented to where a body is left, or that of none.
fn contact_of(left: u32, t: f32, ray: Ray) -> u32 {
    let slack = bodies[left].slack;
    let own_cosine = crossing_cosine(left, ray, turned(left, true));
    let window = GRAZING * error_bound_at(ray, t, frame.largest_slack);
    var found = MOST_CROSSINGS;
    for (var place = 0u; place < crossing_count; place++) {
        let other = crossings[place];
        if other.leaving || other.is_behind || abs(other.t - t) > window || !are_cemented(left, other.body) {
            continue;
        }
        if found < MOST_CROSSINGS && comes_before(crossings[found].body, other.body) {
            continue;
        }
        let cosine = max(crossing_cosine(other.body, ray, turned(other.body, false)), own_cosine);
        if abs(other.t - t) * cosine <= error_bound_at(ray, t, max(slack, bodies[other.body].slack)) {
            found = place;
        }
    }
    if found < MOST_CROSSINGS {
        crossings[found].is_behind = true;
    }
    return found;
}

// What all that was noted lets through of the light. A ray has come through the surface that it starts from if it leaves a
// body that it is in.
fn left_at_contacts(ray: Ray, media: ptr<function, Media>) -> vec3<f32> {
    var share = vec3(1.0);
    let start = whole_of(ray.start);
    let is_through = ray.start != NO_START && (start & INWARDS) == 0u && media_contains(media, start & NO_START);
    // In one loop with the start, since shaders are compiled with all calls unfolded.
    for (var step = select(1u, 0u, is_through); step <= crossing_count; step++) {
        var crossing = ShadowCrossing(0.0, ray.start & NO_START, true, false);
        if step > 0u {
            crossing = crossings[step - 1u];
        }
        var contact = MOST_CROSSINGS;
        if crossing.leaving {
            contact = contact_of(crossing.body, crossing.t, ray);
        }
        if step == 0u {
            continue;
        }
        if contact < MOST_CROSSINGS {
            share *= contact_filter(crossing.body, crossings[contact].body);
        } else if crossing.leaving {
            share *= filter_of(crossing.body);
        }
    }
    for (var place = 0u; place < crossing_count; place++) {
        let crossing = crossings[place];
        if !crossing.leaving && !crossing.is_behind {
            share *= filter_of(crossing.body);
        }
    }
    return bounded(share);
}

// What the contact of two bodies lets through.
fn contact_filter(left: u32, entered: u32) -> vec3<f32> {
    let own = whole_of(left) & NO_START;
    let other = whole_of(entered) & NO_START;
    let own_ior = ior_of(own, 0u);
    let other_ior = ior_of(other, 0u);
    if own_ior == other_ior && material_of(own).indices == material_of(other).indices {
        return vec3(1.0);
    }
    let surface = select(left, entered, comes_before(entered, left));
    if material_of(surface).law != LAW_DIELECTRIC {
        return filter_of(surface);
    }
    // What is not reflected of light that falls in straight.
    let root = (own_ior - other_ior) / (own_ior + other_ior);
    return vec3(1.0 - root * root);
}
