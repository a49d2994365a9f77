// Twin of whitted.rs for stages with physical materials or lights that are balls.

// A ray that waits.
struct PathState {
    ray: Ray,
    // Product of the coefficients on the way from the eye.
    weight: vec3<f32>,
    generation: u32,
    media: Media,
}

// A ray that waits as it came to a body that splits light: it is kept once, and sends a wave through whenever it is its
// turn.
struct Split {
    // Of the surface, or of the facet of it that is seen.
    normal: vec3<f32>,
    // The next wave; WAVE_COUNT of a ray that goes on as it is.
    wave: u32,
    // Of the surface that facets make up.
    ground: vec3<f32>,
    // Whether the way to the surface was no mere rounding.
    moves: bool,
    // Of a cemented contact, the start of a ray that is reflected at the other surface; else NO_START.
    contact: u32,
}

// Rays that wait while a reflected one is followed. That one always is a generation further on, so that no more than one
// waits for each generation; or one more among the waves of a split ray, the first of which may be as old as that.
var<private> waiting: array<PathState, STACK>;
var<private> splits: array<Split, SPLITS>;
var<private> waits: u32 = 0u;

fn wait(beam: PathState) {
    waiting[waits] = beam;
    if DISPERSES {
        splits[waits].wave = WAVE_COUNT;
    }
    waits += 1u;
}

// Prepares for a sample of a pixel.
fn begin_sample(place: u32, sample: u32) {
    dice_pixel = vec2(place % frame.size.x, place / frame.size.x);
    dice_sample = frame.samples_done + sample;
    first_wave = sample * WAVE_COUNT;
}

// The share of light that is left after a way in the body entered last.
fn left_in_media(media: ptr<function, Media>, way: f32) -> vec3<f32> {
    if (*media).count == 0u {
        return vec3(1.0);
    }
    let last = (*media).bodies[(*media).count - 1u];
    if last >= WAVES {
        return vec3(1.0);
    }
    return left_after(last, way);
}

// A ray that is followed.
struct Follower {
    ray: Ray,
    weight: vec3<f32>,
    generation: u32,
}

// Makes `follower` the ray that is reflected at a point, while refracted ones wait. Whether there is one. In the last
// generation only those wait that are the same ray still.
fn scatter(
    follower: ptr<function, Follower>,
    at: ptr<function, SurfaceInteraction>,
    media: ptr<function, Media>,
) -> bool {
    let is_last = (*follower).generation >= frame.generations;
    let ray = (*follower).ray;
    let weight = (*follower).weight;
    let generation = (*follower).generation;
    var ground = Macrosurface((*at).normal, 0.0);
    if is_rough(at) && !is_last {
        ground = sample_facet(at, ray.direction, generation);
    }
    var reflected = (*at).reflected;
    if HAS_TRANSPARENCY && body_is_transparent((*at).body) {
        if DISPERSES && (*at).material.indices != NO_ROWS && is_white(media) {
            reflected = disperse(ray, weight, generation, *at, ground, *media);
        } else {
            reflected = send_through(ray, weight, generation, *at, ground, *media);
        }
    }
    if is_last {
        return false;
    }
    let direction = mend_unit(reflect_about(ray.direction, (*at).normal));
    let off = masking(ground, direction, false, reflected);
    let mirrored = bounded(weight * off.weight);
    if !off.flies || !is_above_threshold(mirrored) {
        return false;
    }
    counts.reflected += 1u;
    *follower = Follower(ray_from((*at).position, direction, (*at).start), mirrored, generation + 1u);
    return true;
}

// Makes `follower` a ray that waited. Whether there is one.
fn take_waiting(follower: ptr<function, Follower>, media: ptr<function, Media>) -> bool {
    while waits > 0u {
        let last = waits - 1u;
        *media = waiting[last].media;
        if !DISPERSES || splits[last].wave == WAVE_COUNT {
            waits = last;
            *follower = Follower(waiting[last].ray, waiting[last].weight, waiting[last].generation);
            return true;
        }
        let wave = splits[last].wave;
        splits[last].wave = wave + 1u;
        if wave + 1u == WAVE_COUNT {
            waits = last;
        }
        if send_wave(last, wave, follower, media) {
            return true;
        }
    }
    return false;
}

// The light that a primary ray brings. `first_body` becomes the body that it meets.
fn trace(primary: Ray, first_body: ptr<function, u32>) -> vec3<f32> {
    var follower = Follower(primary, vec3(1.0), 1u);
    var media: Media;
    media_at_start(primary, &media);
    var light = vec3(0.0);
    var is_first = true;
    var is_whole = false;
    waits = 0u;
    let before = counts.shadow + counts.reflected + counts.refracted;
    loop {
        let hit = closest_hit(follower.ray, &media);
        if is_first {
            *first_body = select(NO_BODY, hit.body, hit.hit);
            is_first = false;
        }
        if ABSORBS {
            follower.weight *= left_in_media(&media, hit.t);
        }
        var goes_on = false;
        if !hit.hit {
            light += follower.weight * sky_light(follower.ray.direction);
        } else {
            var at = interaction(follower.ray, hit);
            if CEMENTED && at.contact != NO_START {
                cement(&at, &media);
            }
            light += follower.weight * direct_light(follower.ray, &at, follower.generation, &media);
            if follower.generation < frame.generations || (HAS_TRANSPARENCY && body_is_transparent(at.body)) {
                goes_on = scatter(&follower, &at, &media);
            }
        }
        if counts.shadow + counts.reflected + counts.refracted - before > MOST_RAYS {
            break;
        }
        if !goes_on {
            if !take_waiting(&follower, &media) {
                is_whole = true;
                break;
            }
        }
    }
    tree_overflowed = tree_overflowed || !is_whole;
    return light;
}
