// Twin of environment.rs for stages with light that changes with the height.

fn sky_light(direction: vec3<f32>) -> vec3<f32> {
    let end = select(frame.background, frame.nadir, direction.y < 0.0);
    return frame.horizon + (end - frame.horizon) * min(abs(direction.y), 1.0);
}
