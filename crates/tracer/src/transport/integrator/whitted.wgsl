// Twin of whitted.rs: the tree of one primary ray. What is here all stages have in common.

// Rays so far.
struct Counts {
    shadow: u32,
    reflected: u32,
    refracted: u32,
}

var<private> counts: Counts = Counts(0u, 0u, 0u);

// Whether a tree was cut off, so that the picture is not used: it had more than MOST_RAYS rays, since no dispatch may take
// long; or the driver ended the loop (Mesa's llvmpipe does, silently, after 65,535 turns of all loops of a thread).
var<private> tree_overflowed: bool = false;

// Whether rays of this weight are traced.
fn is_above_threshold(weight: vec3<f32>) -> bool {
    let strongest = largest(weight);
    return strongest > 0.0 && strongest >= frame.threshold;
}
