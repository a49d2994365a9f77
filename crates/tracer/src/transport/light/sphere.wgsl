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
    let sin_of_cone = min(light.radius / d, 1.0);
    let square = sin_of_cone * sin_of_cone;
    let least = sqrt(1.0 - square);
    // 1 - cos, of which a cosine in single precision keeps no digit below an angle of 2⋅10⁻⁴.
    let versine = thrown.second * (square / (1.0 + least));
    let cos = 1.0 - versine;
    let sin = sqrt(versine * (1.0 + cos));
    let across = frame_of(to_middle);
    let direction = to_middle * cos + across.right * (sin * thrown.cos) + across.up * (sin * thrown.sin);
    let beside = d * sin;
    let before = d * cos - sqrt(max((light.radius - beside) * (light.radius + beside), 0.0));
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
