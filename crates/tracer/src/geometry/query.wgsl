// Twin of query.rs: what a ray meets.

struct HitRecord {
    t: f32,
    body: u32,
    leaving: bool,
    hit: bool,
    // Of a cemented contact, the start of a ray that is reflected at the other of its two surfaces; else NO_START.
    contact: u32,
}

struct BodyIntersection {
    entering: bool,
    enter: f32,
    leaving: bool,
    exit: f32,
}

struct ClosestHit {
    t: f32,
    body: u32,
    slack: f32,
    // The least parameter of any other hit, less the slack there as far as it may count along the ray.
    others: f32,
}

struct ClosestHits {
    leaving: ClosestHit,
    entering: ClosestHit,
    // No body beyond this parameter can change the outcome any more.
    reach: f32,
}

const NO_MEETING: BodyIntersection = BodyIntersection(false, 0.0, false, 0.0);

// Where a ray meets a body first, if it does.
fn meeting(index: u32, ray: Ray, media: ptr<function, Media>) -> BodyIntersection {
    let own = (ray.start & NO_START) == index;
    let heads_in = (ray.start & INWARDS) != 0u;
    if own && !heads_in {
        return NO_MEETING;
    }
    var inside = own;
    if body_is_transparent(index) && !own {
        inside = media_contains(media, index);
    }
    let span = body_span(index, ray.origin, ray.direction);
    if inside {
        return BodyIntersection(false, 0.0, true, max(span.exit, 0.0));
    }
    if !span.hit || !(span.exit > 0.0) {
        return NO_MEETING;
    }
    if span.enter > 0.0 {
        return BodyIntersection(true, span.enter, false, span.exit);
    }
    return start_within(index, ray, span);
}

// Where a ray meets a body first, and what makes the surface there: the body itself, or one of its parts.
fn first_meeting(index: u32, ray: Ray, media: ptr<function, Media>, part: ptr<function, u32>) -> BodyIntersection {
    if is_joined(index) {
        return joined_meeting(index, ray, media, part);
    }
    *part = index;
    return meeting(index, ray, media);
}

// Which of two bodies comes first in the scene.
fn comes_before(one: u32, other: u32) -> bool {
    let number = scene_order[one].x;
    let other_number = scene_order[other].x;
    if HAS_MEMBERS {
        let place = place_in_scene(number);
        let other_place = place_in_scene(other_number);
        if place != other_place {
            return place < other_place;
        }
    }
    return number < other_number;
}

// The place in the scene of the body with a number, or of what it belongs to.
fn place_in_scene(number: u32) -> u32 {
    if number < frame.scene_bodies {
        return number;
    }
    return scene_order[frame.members + number].x;
}

// Whether a ray leaves a body that makes the surface where it leaves the whole, or enters it; or the other way round.
fn turned(body: u32, leaving: bool) -> bool {
    return (whole_of(body | select(0u, INWARDS, leaving)) & INWARDS) != 0u;
}

// What is true of a ray that starts within a body by the numbers, but perhaps only by their rounding.
fn start_within(index: u32, ray: Ray, span: Span) -> BodyIntersection {
    let slack = ray.slack + bodies[index].slack;
    let enter_cosine = body_cosine(index, ray.origin, ray.direction, span.enter, span.enter_face);
    let exit_cosine = body_cosine(index, ray.origin, ray.direction, span.exit, span.exit_face);
    let behind_entry = -span.enter * enter_cosine;
    let before_exit = span.exit * exit_cosine;
    let at_entry = behind_entry <= slack && behind_entry <= before_exit;
    let inside = !at_entry && !(before_exit <= slack);
    return BodyIntersection(at_entry, 0.0, inside, max(span.exit, 0.0));
}

// How far apart by rounding two hits at about `t` can lie that should coincide.
fn error_bound_at(ray: Ray, t: f32, larger: f32) -> f32 {
    return ray.slack + larger + t * POINT_ROUNDING;
}

fn is_closer(t: f32, index: u32, than: ClosestHit) -> bool {
    if t == than.t && t < INFINITY {
        return comes_before(index, than.body);
    }
    return t < than.t;
}

// The nearer one of a hit with a body and the nearest so far.
fn nearer(t: f32, index: u32, than: ClosestHit) -> ClosestHit {
    let slack = bodies[index].slack;
    if is_closer(t, index, than) {
        return ClosestHit(t, index, slack, min(than.others, than.t - GRAZING * than.slack));
    }
    return ClosestHit(than.t, than.body, than.slack, min(than.others, t - GRAZING * slack));
}

fn offer(met: BodyIntersection, body: u32, ray: Ray, best: ptr<function, ClosestHits>) {
    if met.entering {
        (*best).entering = nearer(met.enter, body, (*best).entering);
        (*best).reach = min((*best).reach, reach_of(ray, (*best).entering.t));
    }
    if met.leaving {
        (*best).leaving = nearer(met.exit, body, (*best).leaving);
        (*best).reach = min((*best).reach, reach_of(ray, (*best).leaving.t));
    }
}

// No body beyond this parameter may coincide with a hit at `t`.
fn reach_of(ray: Ray, t: f32) -> f32 {
    return t + GRAZING * error_bound_at(ray, t, frame.largest_slack);
}

// Whether the nearest hit may coincide with another.
fn is_contested(ray: Ray, nearest: ClosestHit) -> bool {
    let t = nearest.t;
    return t < INFINITY && nearest.others <= t + GRAZING * error_bound_at(ray, t, nearest.slack);
}

// Whether a body is left before another is entered: of hits that coincide within rounding, the one that leads out comes
// before the one that leads in.
fn is_left_first(best: ClosestHits, ray: Ray) -> bool {
    let larger = max(best.entering.slack, best.leaving.slack);
    let bound = error_bound_at(ray, best.entering.t, larger);
    return best.leaving.t < INFINITY && best.leaving.t <= best.entering.t + bound;
}

fn first_of(best: ClosestHits, ray: Ray) -> HitRecord {
    let entering = best.entering;
    let leaving = best.leaving;
    if is_left_first(best, ray) {
        return HitRecord(leaving.t, leaving.body, turned(leaving.body, true), true, NO_START);
    }
    let hit = entering.t < INFINITY;
    return HitRecord(entering.t, entering.body, turned(entering.body, false), hit, NO_START);
}

// Hits that are contested: those that enter a body, those that leave one, and those that may be cemented contacts.
const ENTERING: u32 = 1u;
const LEAVING: u32 = 2u;
const TOUCHING: u32 = 4u;

// The nearest body that a ray meets. A walk finds it, and where hits are contested, which is rare, another one settles them:
// through the same code, since shaders are compiled with all calls unfolded.
fn closest_hit(ray: Ray, media: ptr<function, Media>) -> HitRecord {
    let none = ClosestHit(INFINITY, 0u, 0.0, INFINITY);
    var best = ClosestHits(none, none, INFINITY);
    var contested = 0u;
    // What is settled by the present walk; nothing in the first.
    var settled = 0u;
    var nearest = none;
    var nearest_cosine = 0.0;
    var first = none;
    var first_leaves = false;
    var entry_touches = false;
    loop {
        var walk = traversal_from(ray);
        loop {
            let leaf = traversal_next(&walk, ray, best.reach);
            if leaf.count == 0u {
                break;
            }
            for (var index = leaf.first; index < leaf.first + leaf.count; index++) {
                let is_ordered = settled == ENTERING || settled == LEAVING;
                if is_ordered && !is_joined(index) && !comes_before(index, first.body) {
                    continue;
                }
                var body: u32;
                let met = first_meeting(index, ray, media, &body);
                if settled == 0u {
                    offer(met, body, ray, &best);
                } else if CEMENTED && settled == TOUCHING {
                    let touches =
                        cemented_of_two(met, body, ray, nearest, nearest_cosine, &first, &first_leaves);
                    entry_touches |= touches && body == best.entering.body;
                } else {
                    first = first_of_two(met, body, ray, nearest, nearest_cosine, first, settled == LEAVING);
                }
            }
        }
        if settled == 0u {
            contested = select(0u, ENTERING, is_contested(ray, best.entering))
                | select(0u, LEAVING, is_contested(ray, best.leaving))
                | select(0u, TOUCHING, CEMENTED && may_touch(best, ray, media));
        } else if settled == ENTERING {
            best.entering = first;
        } else if settled == LEAVING {
            best.leaving = first;
        } else if first.t < INFINITY && (entry_touches || is_left_first(best, ray)) {
            // By more than rounding along the ray another body may come before, and yet touch this one across the surfaces.
            return cemented_hit(nearest, first, first_leaves);
        }
        contested &= ~settled;
        if contested == 0u {
            break;
        }
        nearest = best.entering;
        settled = ENTERING;
        if (contested & ENTERING) == 0u {
            nearest = best.leaving;
            settled = select(TOUCHING, LEAVING, (contested & LEAVING) != 0u);
        }
        first = nearest;
        if CEMENTED && settled == TOUCHING {
            first = none;
        }
        nearest_cosine = crossing_cosine(nearest.body, ray, turned(nearest.body, settled != ENTERING));
        best.reach = reach_of(ray, nearest.t);
    }
    return first_of(best, ray);
}

// Twin of query/coincident.rs: of the bodies that are entered, or left, where the nearest one is, the one that comes first
// in the scene: `first`, or the surface that was met.
fn first_of_two(
    met: BodyIntersection,
    body: u32,
    ray: Ray,
    nearest: ClosestHit,
    nearest_cosine: f32,
    first: ClosestHit,
    leaving: bool,
) -> ClosestHit {
    if body == nearest.body || comes_before(first.body, body) {
        return first;
    }
    let is_met = select(met.entering, met.leaving, leaving);
    let t = select(met.enter, met.exit, leaving);
    let slack = bodies[body].slack;
    let cosine = max(crossing_cosine(body, ray, turned(body, leaving)), nearest_cosine);
    let across = (t - nearest.t) * cosine;
    if !is_met || across > error_bound_at(ray, nearest.t, max(slack, nearest.slack)) {
        return first;
    }
    return ClosestHit(t, body, slack, nearest.others);
}

// |cos| of the angle between the ray and the normal where it enters or leaves a body.
fn crossing_cosine(index: u32, ray: Ray, leaving: bool) -> f32 {
    let span = body_span(index, ray.origin, ray.direction);
    let t = select(span.enter, span.exit, leaving);
    return body_cosine(index, ray.origin, ray.direction, t, select(span.enter_face, span.exit_face, leaving));
}

// What the surface of one body lets through on the way to a light at `distance`.
fn filter_through(index: u32, ray: Ray, media: ptr<function, Media>, distance: f32) -> vec3<f32> {
    if body_is_shadowless(index) {
        return vec3(1.0);
    }
    if is_joined(index) {
        return filter_through_joined(index, ray, media, distance);
    }
    let met = meeting(index, ray, media);
    let in_front = met.entering && met.enter < distance;
    let behind = met.leaving && met.exit < distance;
    let both = in_front && met.exit < distance;
    if ABSORBS && body_is_transparent(index) {
        note_interval(index, met, distance, media);
    }
    if !in_front && !behind {
        return vec3(1.0);
    }
    if body_stops_light(index) {
        return vec3(0.0);
    }
    if CEMENTED && body_is_cementable(index) {
        if in_front {
            note_crossing(met.enter, index, false);
        }
        if behind || both {
            note_crossing(met.exit, index, true);
        }
        return vec3(1.0);
    }
    let once = filter_of(index);
    return select(once, once * once, both);
}

// What reaches the ray's start from a light at `to_light` along it: the product of the filters of all surfaces
// crossed and of what the media leave, 0 if any body between is opaque.
fn transmittance(ray: Ray, media: ptr<function, Media>, to_light: f32) -> vec3<f32> {
    // A body that touches the light does not hide it.
    let distance = to_light * (1.0 - POINT_ROUNDING);
    var share = vec3(1.0);
    if ABSORBS {
        forget_intervals();
    }
    if CEMENTED {
        forget_crossings();
    }
    var walk = traversal_from(ray);
    loop {
        let leaf = traversal_next(&walk, ray, distance);
        if leaf.count == 0u {
            break;
        }
        for (var index = leaf.first; index < leaf.first + leaf.count; index++) {
            share = bounded(share * filter_through(index, ray, media, distance));
        }
        if all(share == vec3(0.0)) {
            return share;
        }
    }
    if ABSORBS {
        share *= left_in_intervals();
    }
    if CEMENTED {
        share = bounded(share * left_at_contacts(ray, media));
    }
    return share;
}
