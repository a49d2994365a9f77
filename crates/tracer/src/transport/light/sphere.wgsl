// Twin of light.rs for scenes in which lights may be balls.

struct Light {
    position: vec3<f32>,
    falloff: u32,
    power: vec3<f32>,
    // K of the linear falloff, meters.
    constant: f32,
    // Of the ball that shines, meters; 0 is a point.
    radius: f32,
    unused_1: f32,
    unused_2: f32,
    unused_3: f32,
}

struct SphereSample {
    // To the point, of length 1.
    direction: vec3<f32>,
    distance: f32,
    // What its light is multiplied with.
    share: f32,
}

// A point of the ball as it is seen from a distance `d` > 0 in a direction; all directions to the ball are as likely
// (P. Shirley, C. Wang, K. Zimmerman 1996).
fn sample_sphere(light: Light, to_middle: vec3<f32>, d: f32, thrown: Sample2D) -> SphereSample {
    let square = light.radius * light.radius;
    let least = sqrt(max(1.0 - min(square / max(d * d, LEAST_NORMAL), 1.0), 0.0));
    let cos = 1.0 - thrown.second * (1.0 - least);
    let sin = sqrt(max((1.0 - cos) * (1.0 + cos), 0.0));
    let across = frame_of(to_middle);
    let direction = to_middle * cos + across.right * (sin * thrown.cos) + across.up * (sin * thrown.sin);
    let before = d * cos - sqrt(max(square - d * d * sin * sin, 0.0));
    return SphereSample(mend_unit(direction), max(before, 0.0), 2.0 / (1.0 + least));
}

// The light of the scene with this number at a point; none at the distance 0.
fn sample_light(index: u32, at: ptr<function, SurfaceInteraction>, generation: u32) -> LightSample {
    let light = lights[index];
    let center = light_center(light, (*at).position);
    if HAS_BALLS && light.radius > 0.0 && center.distance > 0.0 {
        let thrown = sample_2d(generation, (*at).body, FOR_LIGHT + index);
        let point = sample_sphere(light, center.to_light, center.distance, thrown);
        return LightSample(point.direction, point.distance, center.power * point.share);
    }
    return center;
}
