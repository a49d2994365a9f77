// Twin of bsdf.rs: what surfaces of physical materials do with light.

fn cos_to(at: ptr<function, SurfaceInteraction>, direction: vec3<f32>) -> f32 {
    return clamp(-dot((*at).normal, direction), 0.0, 1.0);
}

// What is found on a surface that reflects by a law of its own.
fn add_lobes(at: ptr<function, SurfaceInteraction>, color: vec3<f32>, direction: vec3<f32>) {
    let law = (*at).material.law;
    if law == LAW_MIRROR {
        (*at).reflected = color * (*at).material.reflection;
    } else if law == LAW_CONDUCTOR {
        if HAS_METALS {
            (*at).reflected = curve_at((*at).material.curve, cos_to(at, direction));
        }
    } else if law == LAW_COAT {
        let coat = (*at).material.coat;
        let share = fresnel(cos_to(at, direction), coat.ratio);
        (*at).reflected = vec3(share);
        let ground = min(color, vec3(1.0));
        // Between ground and coat light goes to and fro, and leaves a little of itself each time.
        let again = vec3(1.0) / (vec3(1.0) - ground + ground * coat.lets_out);
        let below = ground * again * ((1.0 - share) * coat.spread);
        (*at).diffuse = below;
        (*at).ambient = below * (frame.ambient * (*at).material.ambient * coat.lets_in);
    } else if law == LAW_THIN_DIELECTRIC {
        (*at).reflected = vec3(sheet_reflectance((*at).material, cos_to(at, direction)));
    }
}

// What a thin sheet reflects under an angle of this cosine; of its numbers the first is the ratio of indices.
fn sheet_reflectance(material: Material, cos: f32) -> f32 {
    let once = fresnel_polarized(cos, material.coat.ratio);
    return min(once.x / (1.0 + once.x) + once.y / (1.0 + once.y), 1.0);
}

// What is reflected under another angle: the normal of a rough surface was turned.
fn update_reflectance(at: ptr<function, SurfaceInteraction>, direction: vec3<f32>) {
    if (*at).material.law == LAW_COAT {
        (*at).reflected = vec3(fresnel(cos_to(at, direction), (*at).material.coat.ratio));
    } else if HAS_METALS && (*at).material.law == LAW_CONDUCTOR {
        (*at).reflected = curve_at((*at).material.curve, cos_to(at, direction));
    }
}

// Whether it answers a light.
fn answers(at: ptr<function, SurfaceInteraction>) -> bool {
    return (*at).material.diffuse != 0.0 || (*at).material.specular != 0.0 || is_rough(at);
}

fn is_rough(at: ptr<function, SurfaceInteraction>) -> bool {
    return HAS_FACETS && (*at).material.alpha > 0.0;
}

fn is_dielectric(at: ptr<function, SurfaceInteraction>) -> bool {
    return (*at).material.law == LAW_DIELECTRIC;
}

// What the ground scatters of light that falls in under an angle of this cosine: k_d·C·(n̂·L̂), or what a coat leaves of it.
fn eval_diffuse(at: ptr<function, SurfaceInteraction>, cos: f32) -> vec3<f32> {
    let all = (*at).diffuse * cos;
    if (*at).material.law != LAW_COAT {
        return all;
    }
    return all * (1.0 - fresnel(clamp(cos, 0.0, 1.0), (*at).material.coat.ratio));
}

// Whether it is the surface of a rough clear body, met from within.
fn rough_interior(at: ptr<function, SurfaceInteraction>) -> bool {
    return is_rough(at) && is_dielectric(at) && (whole_of((*at).start) & INWARDS) != 0u;
}

// What the surface sends on towards the viewer of light that falls in under an angle of this cosine.
fn eval_bsdf(
    at: ptr<function, SurfaceInteraction>,
    direction: vec3<f32>,
    to_light: vec3<f32>,
    cos: f32,
    media: ptr<function, Media>,
) -> vec3<f32> {
    var answer = eval_diffuse(at, cos) + eval_highlight(at, direction, to_light);
    if is_rough(at) {
        answer += eval_microfacets(at, direction, to_light, media);
    }
    return answer;
}

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
fn sample_facet(at: ptr<function, SurfaceInteraction>, direction: vec3<f32>, generation: u32) -> Macrosurface {
    let ground = Macrosurface((*at).normal, (*at).material.alpha);
    let thrown = sample_2d(generation, (*at).body, FOR_FACET);
    (*at).normal = sample_visible_normal(direction, ground.normal, ground.alpha, thrown);
    update_reflectance(at, direction);
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
    update_reflectance(&facet, direction);
    var reflected = facet.reflected;
    if is_dielectric(at) {
        var beyond = *media;
        let ratio = media_cross(&beyond, (*at).start, (*at).contact);
        if rough_interior(at) {
            let through = transmitted_density(to_viewer, to_light, normal, ratio, alpha);
            return bounded(vec3(through.share * (1.0 - fresnel(through.cos, ratio))));
        }
        reflected = vec3(fresnel(clamp(dot(half, to_viewer), 0.0, 1.0), ratio));
    }
    // With the power of a light, their product is finite.
    return bounded(reflected * reflected_density(to_viewer, to_light, normal, half, alpha));
}
