// Twin of interaction.rs: the point that a ray met, with all that shading needs.

struct SurfaceInteraction {
    t: f32,
    body: u32,
    // The body, and INWARDS where the ray came from within: the start of rays on this side.
    start: u32,
    // Of a cemented contact, the start of a ray that is reflected at the other surface; else NO_START.
    contact: u32,
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
    let color = patterned(color_at(material.color, hit.body, point.in_body), hit.body, point.in_body);
    var at: SurfaceInteraction;
    at.t = hit.t;
    at.body = hit.body;
    at.start = hit.body | select(0u, INWARDS, hit.leaving);
    at.contact = hit.contact;
    at.position = point.in_world;
    at.normal = point.normal;
    at.ambient = color * (frame.ambient * material.ambient);
    at.diffuse = color * material.diffuse;
    at.reflected = vec3(material.reflection);
    at.material = material;
    add_lobes(&at, color, ray.direction);
    return at;
}
