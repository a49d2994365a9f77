// Twin of interaction.rs for scenes without physical materials: surfaces reflect a constant share.

struct SurfaceInteraction {
    // The body, and INWARDS where the ray came from within: the start of rays on this side.
    start: u32,
    position: vec3<f32>,
    // Unit normal facing the ray.
    normal: vec3<f32>,
    // k_a·C·I_a.
    ambient: vec3<f32>,
    // k_d·C.
    diffuse: vec3<f32>,
    material: Material,
}

fn interaction(ray: Ray, hit: HitRecord) -> SurfaceInteraction {
    let point = surface_point(hit.body, ray, hit.t, hit.leaving);
    let material = materials[bodies[hit.body].material];
    let color = patterned(color_at(material.color, hit.body, point.in_body), hit.body, point.in_body);
    let start = hit.body | select(0u, INWARDS, hit.leaving);
    let ambient = color * (frame.ambient * material.ambient);
    return SurfaceInteraction(start, point.in_world, point.normal, ambient, color * material.diffuse, material);
}

// Whether it answers a light.
fn answers(at: ptr<function, SurfaceInteraction>) -> bool {
    return (*at).material.diffuse != 0.0 || (*at).material.specular != 0.0;
}

// Whether light from behind shines through it: never.
fn rough_interior(at: ptr<function, SurfaceInteraction>) -> bool {
    return false;
}

// What the surface sends on towards the viewer of light that falls in under an angle of this cosine.
fn eval_bsdf(
    at: ptr<function, SurfaceInteraction>,
    direction: vec3<f32>,
    to_light: vec3<f32>,
    cos: f32,
    media: ptr<function, Media>,
) -> vec3<f32> {
    return (*at).diffuse * cos + eval_highlight(at, direction, to_light);
}
