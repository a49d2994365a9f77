// Twin of environment.rs for stages with a picture around them, which is the first of all.

fn sky_light(direction: vec3<f32>) -> vec3<f32> {
    let longitude = angle_of(direction.x, -direction.z) / (2.0 * PI);
    let latitude = angle_of(direction.y, length(direction.xz)) / PI;
    // Turned from z to x, the picture's middle, at -z, goes towards -x.
    return image_at(0u, 0.5 + longitude + frame.turn, 0.5 - latitude, vec2(true, false)) * frame.background;
}
