// Twin of slab.rs.

fn slab_half_open(origin: f32, direction: f32, low: f32, low_face: u32, high: f32, high_face: u32) -> Span {
    let is_along = abs(direction) < SLAB_TINY;
    let inverse = 1.0 / select(direction, select(SLAB_TINY, -SLAB_TINY, direction < 0.0), is_along);
    let at_low = (low - origin) * inverse;
    let at_high = (high - origin) * inverse;
    let rises = inverse > 0.0;
    let enter = select(at_high, at_low, rises);
    let exit = select(at_low, at_high, rises);
    return Span(
        enter,
        exit,
        select(high_face, low_face, rises),
        select(low_face, high_face, rises),
        enter <= exit,
    );
}

fn slab_closed(origin: f32, direction: f32, low: f32, low_face: u32, high: f32, high_face: u32) -> Span {
    var span = slab_half_open(origin, direction, low, low_face, high, high_face);
    if abs(direction) < SLAB_TINY {
        let within = origin >= low && origin <= high;
        span.enter = select(span.enter, -INFINITY, within);
        span.exit = select(span.exit, INFINITY, within);
        span.hit = within;
    }
    return span;
}
