// Twin of shading.rs: what lights send to a point of a surface, and what it sends on of that.

// The ambient, diffuse and highlight terms.
fn direct_light(
    ray: Ray,
    at: ptr<function, SurfaceInteraction>,
    generation: u32,
    media: ptr<function, Media>,
) -> vec3<f32> {
    var sum = (*at).ambient;
    if !answers(at) {
        return sum;
    }
    // The body's own surface lies between its inner side and a light; what it lets through from there is seen where the
    // viewer's ray leaves it.
    let within = rough_interior(at);
    let start = (*at).start ^ select(0u, INWARDS, within);
    for (var index = 0u; index < frame.lights; index++) {
        if all(lights[index].power == vec3(0.0)) {
            continue;
        }
        let lit = sample_light(index, at, generation);
        let cos = dot((*at).normal, lit.to_light);
        if !(lit.distance > 0.0 && select(cos, -cos, within) > 0.0) {
            continue;
        }
        counts.shadow += 1u;
        let passed = transmittance(ray_from((*at).position, lit.to_light, start), media, lit.distance);
        if all(passed == vec3(0.0)) {
            continue;
        }
        sum += lit.power * eval_bsdf(at, ray.direction, lit.to_light, cos, media) * passed;
    }
    return bounded(sum);
}

// The highlight of Phong's model.
fn eval_highlight(at: ptr<function, SurfaceInteraction>, direction: vec3<f32>, to_light: vec3<f32>) -> f32 {
    let specular = (*at).material.specular;
    if specular == 0.0 {
        return 0.0;
    }
    return specular * phong_highlight(-direction, to_light, (*at).normal, (*at).material.shininess);
}
