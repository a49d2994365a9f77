// Twin of camera.rs: the rays of a tile.

// One ray computed in double precision, as sums of two numbers in single, and what changes from pixel to pixel.
struct CameraRays {
    start: vec3<f32>,
    // How far the starts lie along the rays from the eye, meters.
    way: f32,
    start_rest: vec3<f32>,
    is_parallel: u32,
    direction: vec3<f32>,
    unused_1: u32,
    direction_rest: vec3<f32>,
    unused_2: u32,
    across: vec3<f32>,
    unused_3: u32,
    down: vec3<f32>,
    unused_4: u32,
}

// The ray through the point so many pixels right of and below the middle.
fn ray_near(near: CameraRays, x: f32, y: f32) -> Ray {
    let delta = vec3(x) * near.across + vec3(y) * near.down;
    if near.is_parallel != 0u {
        let origin = delta + near.start_rest + near.start;
        return ray_from(origin, near.direction_rest + near.direction, NO_START);
    }
    // D = direction + δ, and 1/|D| = 1 + c.
    let more = dot(delta, near.direction + near.direction + delta);
    let root = sqrt(more + 1.0);
    let c = -more / (root * (root + 1.0));
    let small = delta * (c + 1.0) + near.direction * c;
    let origin = small * near.way + near.start_rest + near.start;
    return ray_from(origin, small + near.direction_rest + near.direction, NO_START);
}
