// Twin of solid.rs for scenes where patterns are checkerboards alone.

// The color of a body at a point of its frame; `own` is that of its material.
fn patterned(own: vec3<f32>, body: u32, in_body: vec3<f32>) -> vec3<f32> {
    let outermost = bodies[body].solid;
    if !HAS_SOLIDS || outermost == NO_BODY {
        return own;
    }
    return select(own, solids[outermost].color, solid_is_odd_cell(solids[outermost], in_body));
}
