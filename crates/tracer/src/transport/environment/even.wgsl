// Twin of environment.rs for stages with the same light from everywhere.

fn sky_light(direction: vec3<f32>) -> vec3<f32> {
    return frame.background;
}
