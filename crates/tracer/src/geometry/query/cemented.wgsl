// Twin of query/cemented.rs: where a ray leaves one body and enters another, with nothing between them.

// Whether nothing lies between two bodies, or the wholes that they are parts of, where they touch.
fn are_cemented(one: u32, other: u32) -> bool {
    let whole = whole_of(one) & NO_START;
    let other_whole = whole_of(other) & NO_START;
    let own = bodies[whole].kind_and_passage >> 16u;
    let others = bodies[other_whole].kind_and_passage >> 16u;
    return whole != other_whole && (own & others & CEMENTABLE) != 0u && ((own | others) & CEMENTS) != 0u;
}

// Whether a ray leaves a clear body that it is in, where it may meet another.
fn may_touch(best: ClosestHits, ray: Ray, media: ptr<function, Media>) -> bool {
    let left = best.leaving;
    let whole = whole_of(left.body) & NO_START;
    let is_near = abs(best.entering.t - left.t) <= reach_of(ray, left.t) - left.t || is_contested(ray, left);
    return left.t < INFINITY && is_near && body_is_transparent(left.body) && media_contains(media, whole);
}

// Whether a ray that comes out of a clear body meets something there: a body that it enters, or a surface, which is opaque
// if it is cemented.
fn leads_on(body: u32, leaving: bool) -> bool {
    return !leaving || has_no_inside(whole_of(body) & NO_START);
}

// Whether a surface that a ray meets where it leaves a clear body is cemented to that. Of such `first` becomes the one that
// comes first in the scene.
fn cemented_of_two(
    met: BodyIntersection,
    body: u32,
    ray: Ray,
    left: ClosestHit,
    left_cosine: f32,
    first: ptr<function, ClosestHit>,
    first_leaves: ptr<function, bool>,
) -> bool {
    let leaving = met.leaving;
    let is_met = met.entering || leaving;
    if !is_met || !are_cemented(left.body, body) || !leads_on(body, leaving) {
        return false;
    }
    let t = select(met.enter, met.exit, leaving);
    let slack = bodies[body].slack;
    let cosine = max(crossing_cosine(body, ray, turned(body, leaving)), left_cosine);
    if abs(t - left.t) * cosine > error_bound_at(ray, left.t, max(slack, left.slack)) {
        return false;
    }
    if (*first).t == INFINITY || comes_before(body, (*first).body) {
        *first = ClosestHit(t, body, slack, left.others);
        *first_leaves = leaving;
    }
    return true;
}

// The word of a ray that is reflected at a crossing.
fn start_at(body: u32, leaving: bool) -> u32 {
    return body | select(0u, INWARDS, turned(body, leaving));
}

// What is met at a cemented contact: what is opaque, or of two clear bodies the first in the scene.
fn cemented_hit(left: ClosestHit, other: ClosestHit, other_leaves: bool) -> HitRecord {
    let own = start_at(left.body, true);
    let others = start_at(other.body, other_leaves);
    let is_clear = body_is_transparent(other.body);
    if !is_clear || comes_before(other.body, left.body) {
        return HitRecord(other.t, other.body, (others & INWARDS) != 0u, true, select(NO_START, own, is_clear));
    }
    return HitRecord(left.t, left.body, (own & INWARDS) != 0u, true, others);
}
