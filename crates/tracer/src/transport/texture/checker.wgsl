// Twin of checker.rs.

struct Checker {
    // Rows from the body's frame to cells; the last number of each is the offset.
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    color: vec3<f32>,
    odd_origin: f32,
}

fn checker_rest(cell: f32) -> f32 {
    return cell - floor(cell * 0.5) * 2.0;
}

fn checker_is_odd(checker: Checker, in_body: vec3<f32>) -> bool {
    let x = floor(dot(in_body, checker.x.xyz) + checker.x.w);
    let y = floor(dot(in_body, checker.y.xyz) + checker.y.w);
    let z = floor(dot(in_body, checker.z.xyz) + checker.z.w);
    let sum = checker_rest(x) + checker_rest(y) + checker_rest(z) + checker.odd_origin;
    return checker_rest(sum) == 1.0;
}

// The color of a body at a point of its frame, `own` where no checker has another.
fn checkered(own: vec3<f32>, body: u32, in_body: vec3<f32>) -> vec3<f32> {
    if HAS_CHECKERS && bodies[body].checker != NO_BODY {
        let checker = checkers[bodies[body].checker];
        if checker_is_odd(checker, in_body) {
            return checker.color;
        }
    }
    return own;
}
