// Twin of scatter.rs: the rays that grow from the point that another met.

// What becomes of a ray at a transparent surface.
struct MediumTransition {
    ratio: f32,
    bent: vec3<f32>,
    // Whether it is not totally reflected.
    passes: bool,
    reflection: f32,
    filter_color: vec3<f32>,
}

// A ray in media, which become those beyond, across the surface where `starts` are those of rays that are reflected: there,
// and at the other surface of a cemented contact.
fn crossing(
    direction: vec3<f32>,
    normal: vec3<f32>,
    starts: vec2<u32>,
    material: Material,
    media: ptr<function, Media>,
) -> MediumTransition {
    let ratio = media_cross(media, starts.x, starts.y);
    let bent = refract_through(direction, normal, ratio);
    var reflection = material.reflection;
    var filter_color: vec3<f32>;
    let cos = clamp(-dot(normal, direction), 0.0, 1.0);
    if material.law == LAW_DIELECTRIC {
        reflection = fresnel(cos, ratio);
        filter_color = vec3(1.0 - reflection);
    } else if material.law == LAW_THIN_DIELECTRIC {
        reflection = sheet_reflectance(material, cos);
        filter_color = tint_of(material) * (1.0 - reflection);
    } else if material.law == LAW_NOTHING {
        reflection = 0.0;
        filter_color = vec3(1.0);
    } else {
        filter_color = filter_of(starts.x & NO_START);
    }
    // Total internal reflection: all of the light, and nothing twice.
    reflection = select(1.0, reflection, bent.passes);
    if material.law == LAW_SCHLICK {
        let share = schlick(cos, ratio);
        reflection = material.reflection * share;
        filter_color *= select(1.0, 1.0 - share, material.reflection > 0.0);
    }
    return MediumTransition(ratio, bent.direction, bent.passes, reflection, filter_color);
}

// The coefficients of a ray that crosses a surface, and whether there is one.
fn let_through(across: MediumTransition, ground: Macrosurface, filter_color: vec3<f32>) -> Masking {
    // Between equal indices there is no surface, and nothing that could be rough.
    if across.ratio == 1.0 {
        return Masking(filter_color, across.passes);
    }
    let left = masking(ground, across.bent, true, filter_color);
    return Masking(left.weight, left.flies && across.passes);
}

// Sends a ray through a surface, if it carries anything: it waits.
fn send_through(ray: Ray, weight: vec3<f32>, generation: u32, at: SurfaceInteraction, ground: Macrosurface, media: Media) -> vec3<f32> {
    var beyond = media;
    let across = crossing(ray.direction, at.normal, vec2(at.start, at.contact), at.material, &beyond);
    let through = let_through(across, ground, across.filter_color);
    let passing = bounded(weight * through.weight);
    // A ray that goes straight on is the same ray still, unless it stands still; in the last generation only that goes on.
    let same = across.ratio == 1.0 && at.t > ray.slack;
    if through.flies && (same || generation < frame.generations) && is_above_threshold(passing) {
        counts.refracted += 1u;
        let on = ray_from(at.position, across.bent, at.start ^ INWARDS);
        wait(PathState(on, passing, generation + select(1u, 0u, same), beyond));
    }
    return vec3(across.reflection);
}

// Lets each wave of a white ray wait for its turn. What is reflected of all together.
fn disperse(ray: Ray, weight: vec3<f32>, generation: u32, at: SurfaceInteraction, ground: Macrosurface, media: Media) -> vec3<f32> {
    let here = Ray(at.position, ray.slack, ray.direction, at.start);
    splits[waits] = Split(at.normal, 0u, ground.normal, at.t > ray.slack, at.contact);
    waiting[waits] = PathState(here, weight, generation, media);
    waits += 1u;
    var reflection = vec3(0.0);
    for (var wave = 0u; wave < WAVE_COUNT; wave++) {
        var beyond = media;
        media_colored(&beyond, wave);
        let across = crossing(ray.direction, at.normal, vec2(at.start, at.contact), at.material, &beyond);
        reflection += wave_color(wave) * across.reflection;
    }
    return reflection;
}

// Makes `follower` a wave of the split ray at a place of those that wait, and `media`, which are around that, what is
// beyond. Whether it carries anything.
fn send_wave(
    place: u32,
    wave: u32,
    follower: ptr<function, Follower>,
    media: ptr<function, Media>,
) -> bool {
    let ray = waiting[place].ray;
    let waits_there = splits[place];
    let material = material_of(ray.start & NO_START);
    media_colored(media, wave);
    let starts = vec2(ray.start, waits_there.contact);
    let across = crossing(ray.direction, waits_there.normal, starts, material, media);
    let ground = Macrosurface(waits_there.ground, material.alpha);
    let through = let_through(across, ground, across.filter_color * wave_color(wave));
    let passing = bounded(waiting[place].weight * through.weight);
    let same = across.ratio == 1.0 && waits_there.moves;
    let generation = waiting[place].generation + select(1u, 0u, same);
    if !through.flies || generation > frame.generations || !is_above_threshold(passing) {
        return false;
    }
    counts.refracted += 1u;
    *follower = Follower(ray_from(ray.origin, across.bent, ray.start ^ INWARDS), passing, generation);
    return true;
}
