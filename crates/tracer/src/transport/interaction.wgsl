// Twin of interaction.rs: the point that a ray met, with all that shading needs.

struct SurfaceInteraction {
    t: f32,
    body: u32,
    // The body, and INWARDS where the ray came from within: the start of rays on this side.
    start: u32,
    position: vec3<f32>,
    // Unit normal facing the ray.
    normal: vec3<f32>,
    // k_a·C·I_a.
    ambient: vec3<f32>,
    // k_d·C.
    diffuse: vec3<f32>,
    // k_r, or what is reflected under this angle; of what is clear, only the crossing tells.
    reflected: vec3<f32>,
    material: Material,
}

fn interaction(ray: Ray, hit: HitRecord) -> SurfaceInteraction {
    let point = surface_point(hit.body, ray, hit.t, hit.leaving);
    let material = material_of(hit.body);
    let color = checkered(color_at(material.color, hit.body, point.in_body), hit.body, point.in_body);
    var at: SurfaceInteraction;
    at.t = hit.t;
    at.body = hit.body;
    at.start = hit.body | select(0u, INWARDS, hit.leaving);
    at.position = point.in_world;
    at.normal = point.normal;
    at.ambient = color * (frame.ambient * material.ambient);
    at.diffuse = color * material.diffuse;
    at.reflected = vec3(material.reflection);
    at.material = material;
    add_lobes(&at, color, ray.direction);
    return at;
}

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
    }
}

// What is reflected under another angle: the normal of a rough surface was turned.
fn set_microfacet_normal(at: ptr<function, SurfaceInteraction>, direction: vec3<f32>) {
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

fn is_clear(at: ptr<function, SurfaceInteraction>) -> bool {
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
    return is_rough(at) && is_clear(at) && ((*at).start & INWARDS) != 0u;
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
