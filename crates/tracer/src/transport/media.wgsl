// Twin of media.rs: the transparent bodies that a ray is inside of, in the order entered. A list has room for MEDIA
// bodies; one that needed more is told of, and the picture is not used.

struct Media {
    count: u32,
    bodies: array<u32, MEDIA>,
}

// Whether a list had no room.
var<private> media_overflowed: bool = false;

fn media_contains(media: ptr<function, Media>, body: u32) -> bool {
    for (var at = 0u; at < (*media).count; at++) {
        if (*media).bodies[at] == body {
            return true;
        }
    }
    return false;
}

// The index of refraction in these media: that of the body entered last, or of air.
fn media_ior(media: ptr<function, Media>) -> f32 {
    if (*media).count == 0u {
        return 1.0;
    }
    return ior_of((*media).bodies[(*media).count - 1u], (*media).bodies[0]);
}

fn media_enter(media: ptr<function, Media>, body: u32) {
    if (*media).count == MEDIA {
        media_overflowed = true;
        return;
    }
    (*media).bodies[(*media).count] = body;
    (*media).count += 1u;
}

fn media_leave(media: ptr<function, Media>, body: u32) {
    var kept = 0u;
    for (var at = 0u; at < (*media).count; at++) {
        let other = (*media).bodies[at];
        if other != body {
            (*media).bodies[kept] = other;
            kept += 1u;
        }
    }
    (*media).count = kept;
}

// Crosses a surface; returns the index of refraction before it divided by that beyond. `start` is the word of a ray that is
// reflected there, `contact` that of one at the other surface of a cemented contact, or NO_START.
fn media_cross(media: ptr<function, Media>, start: u32, contact: u32) -> f32 {
    let before = media_ior(media);
    if CEMENTED && contact != NO_START {
        // The one body is left before the other is entered.
        let is_left = (whole_of(start) & INWARDS) != 0u;
        media_pass(media, select(contact, start, is_left));
        media_pass(media, select(start, contact, is_left));
    } else {
        media_pass(media, start);
    }
    let beyond = media_ior(media);
    // A quotient of equal numbers need not be 1 on every card.
    return select(before / beyond, 1.0, before == beyond);
}

// To leave a body that was never entered, as may be where surfaces coincide, changes nothing; nor does what is a surface
// only.
fn media_pass(media: ptr<function, Media>, start: u32) {
    // A joined body is one medium, whatever its parts.
    let whole = whole_of(start);
    let body = whole & NO_START;
    if has_no_inside(body) {
        return;
    }
    if (whole & INWARDS) != 0u {
        media_leave(media, body);
    } else if !media_contains(media, body) {
        media_enter(media, body);
    }
}

// The media where a primary ray starts.
fn media_at_start(ray: Ray, media: ptr<function, Media>) {
    (*media).count = 0u;
    if ASKS_EACH_START {
        media_at_point(ray, media);
    } else if HAS_TRANSPARENCY {
        for (var at = 0u; at < frame.eye_media_count; at++) {
            media_enter(media, frame.eye_media[at / 4u][at % 4u]);
        }
    }
}

// Every transparent body that contains the ray's start, the largest outermost.
fn media_at_point(ray: Ray, media: ptr<function, Media>) {
    var walk = traversal_from(ray);
    loop {
        // What a ray meets at once is what contains its start.
        let leaf = traversal_next(&walk, ray, 0.0);
        if leaf.count == 0u {
            break;
        }
        for (var index = leaf.first; index < leaf.first + leaf.count; index++) {
            media_enter_if_inside(ray, index, media);
        }
    }
}

fn media_enter_if_inside(ray: Ray, index: u32, media: ptr<function, Media>) {
    if !body_is_transparent(index) || !is_around(index, ray.origin) {
        return;
    }
    media_enter(media, index);
    // The list is kept in the order of the bodies' volumes.
    for (var at = (*media).count - 1u; at > 0u; at--) {
        let outer = (*media).bodies[at - 1u];
        let inner = (*media).bodies[at];
        if volume_order(outer) < volume_order(inner) {
            break;
        }
        (*media).bodies[at - 1u] = inner;
        (*media).bodies[at] = outer;
    }
}

fn is_around(index: u32, point: vec3<f32>) -> bool {
    if is_joined(index) {
        return joined_contains(index, point);
    }
    return body_contains(index, point);
}
