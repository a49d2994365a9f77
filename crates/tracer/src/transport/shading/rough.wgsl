// Twin of rough.rs: rough surfaces in the tree. One facet of each is looked at in every sample.

// The surface that facets make up; α is 0 where there are none.
struct Macrosurface {
    normal: vec3<f32>,
    alpha: f32,
}

// What is left of rays, and whether they fly.
struct Masking {
    weight: vec3<f32>,
    flies: bool,
}

// What is left of the weight of a ray that a facet sends this way, and whether it flies: not into the surface that it should
// leave, or out of the one that it should enter.
fn masking(ground: Macrosurface, direction: vec3<f32>, is_beyond: bool, weight: vec3<f32>) -> Masking {
    if !HAS_FACETS || !(ground.alpha > 0.0) {
        return Masking(weight, true);
    }
    let cos = dot(ground.normal, direction) * select(1.0, -1.0, is_beyond);
    return Masking(weight * smith_g1(cos, ground.alpha), cos > 0.0);
}

// Turns a point on a rough surface to the facet that the ray meets there; returns what the facets make up.
fn sample_microfacet(at: ptr<function, SurfaceInteraction>, direction: vec3<f32>, generation: u32) -> Macrosurface {
    let ground = Macrosurface((*at).normal, (*at).material.alpha);
    let thrown = sample_2d(generation, (*at).body, FOR_FACET);
    (*at).normal = sample_visible_normal(direction, ground.normal, ground.alpha, thrown);
    set_microfacet_normal(at, direction);
    return ground;
}

// What a rough surface sends on of a light in this direction, for each unit of its power.
fn eval_microfacets(
    at: ptr<function, SurfaceInteraction>,
    direction: vec3<f32>,
    to_light: vec3<f32>,
    media: ptr<function, Media>,
) -> vec3<f32> {
    let normal = (*at).normal;
    let alpha = (*at).material.alpha;
    let to_viewer = -direction;
    let half = normalize_or(to_viewer + to_light, normal);
    var facet = *at;
    facet.normal = half;
    set_microfacet_normal(&facet, direction);
    var reflected = facet.reflected;
    if is_clear(at) {
        var beyond = *media;
        let ratio = media_cross(&beyond, (*at).body);
        if rough_interior(at) {
            let through = transmitted_density(to_viewer, to_light, normal, ratio, alpha);
            return bounded(vec3(through.share * (1.0 - fresnel(through.cos, ratio))));
        }
        reflected = vec3(fresnel(clamp(dot(half, to_viewer), 0.0, 1.0), ratio));
    }
    // With the power of a light, their product is finite.
    return bounded(reflected * reflected_density(to_viewer, to_light, normal, half, alpha));
}
