// Twin of plane.rs.

fn plane_span(height: f32, rise: f32) -> Span {
    let sinks = rise < 0.0;
    let rises = rise > 0.0;
    let crossing = -height / select(rise, 1.0, rise == 0.0);
    return Span(
        select(-INFINITY, crossing, sinks),
        select(crossing, INFINITY, sinks),
        SIDE,
        SIDE,
        sinks || rises,
    );
}
