// Twin of absorption.rs: what the media on the way to a light leave of it.

// The part of a ray that lies within a transparent body.
struct MediumInterval {
    enter: f32,
    // Not beyond the light.
    exit: f32,
    body: u32,
    // Whether the ray starts in the body.
    is_within: bool,
}

// Those of one shadow ray, in the order of entry. A ray that needs more room is told of, and the picture is not used.
var<private> intervals: array<MediumInterval, MOST_INTERVALS>;
var<private> interval_count: u32 = 0u;

fn forget_intervals() {
    interval_count = 0u;
}

// The place of a body in a list of media, the outermost first; who is in a body by rounding only has come there last.
fn place_in_media(media: ptr<function, Media>, body: u32) -> u32 {
    for (var at = 0u; at < (*media).count; at++) {
        if (*media).bodies[at] == body {
            return at;
        }
    }
    return (*media).count;
}

fn is_entered_before(a: MediumInterval, b: MediumInterval, media: ptr<function, Media>) -> bool {
    if a.is_within != b.is_within {
        return a.is_within;
    }
    if a.is_within {
        let place = place_in_media(media, a.body);
        let other = place_in_media(media, b.body);
        if place != other {
            return place < other;
        }
    } else if a.enter != b.enter {
        return a.enter < b.enter;
    }
    return comes_before(a.body, b.body);
}

// Notes the part of the way to a light at `distance` that lies within a transparent body.
fn note_interval(body: u32, met: BodyIntersection, distance: f32, media: ptr<function, Media>) {
    if !met.leaving && !(met.entering && met.enter < distance) {
        return;
    }
    if interval_count == MOST_INTERVALS {
        media_overflowed = true;
        return;
    }
    let enter = select(met.enter, 0.0, met.leaving);
    let interval = MediumInterval(enter, min(met.exit, distance), body, met.leaving);
    var place = interval_count;
    for (; place > 0u; place--) {
        if !is_entered_before(interval, intervals[place - 1u], media) {
            break;
        }
        intervals[place] = intervals[place - 1u];
    }
    intervals[place] = interval;
    interval_count += 1u;
}

// What is left of the light: in each place, the body entered last takes its share.
fn left_in_intervals() -> vec3<f32> {
    var left = vec3(1.0);
    var at = 0.0;
    // Those that the ray is in, the one entered last at the end.
    var open: array<u32, MOST_INTERVALS>;
    var opened = 0u;
    for (var next = 0u; next < interval_count; next++) {
        at = max(at, intervals[next].enter);
        open[opened] = next;
        opened += 1u;
        var end = INFINITY;
        if next + 1u < interval_count {
            end = intervals[next + 1u].enter;
        }
        for (; opened > 0u; opened--) {
            let last = intervals[open[opened - 1u]];
            let until = min(last.exit, end);
            if until > at {
                left *= left_after(last.body, until - at);
                at = until;
            }
            if last.exit > end {
                break;
            }
        }
    }
    return left;
}
