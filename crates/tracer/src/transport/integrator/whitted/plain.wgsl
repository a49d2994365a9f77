// Twin of whitted.rs for stages without physical materials: surfaces reflect a constant share, lights are points.

// A ray that waits.
struct PathState {
    ray: Ray,
    // Product of the coefficients on the way from the eye.
    weight: vec3<f32>,
    generation: u32,
    media: Media,
}

// Prepares for a sample of a pixel.
fn begin_sample(place: u32, sample: u32) {}

// The light that a primary ray brings. `first_body` becomes the body that it meets.
fn trace(primary: Ray, first_body: ptr<function, u32>) -> vec3<f32> {
    var ray = primary;
    var weight = vec3(1.0);
    var generation = 1u;
    var media: Media;
    media_at_start(primary, &media);
    // Rays that wait while a reflected one is followed. That one always is a generation further on, so that no more
    // than one waits for each generation.
    var waiting: array<PathState, STACK>;
    var waits = 0u;
    var light = vec3(0.0);
    var is_first = true;
    var is_whole = false;
    let before = counts.shadow + counts.reflected + counts.refracted;
    loop {
        let hit = closest_hit(ray, &media);
        if is_first {
            *first_body = select(NO_BODY, hit.body, hit.hit);
            is_first = false;
        }
        var goes_on = false;
        if !hit.hit {
            light += weight * sky_light(ray.direction);
        } else {
            var at = interaction(ray, hit);
            light += weight * direct_light(ray, &at, generation, &media);
            let is_clear = HAS_TRANSPARENCY && body_is_transparent(hit.body);
            // In the last generation only those go on that are the same ray still.
            let is_last = generation >= frame.generations;
            if !is_last || is_clear {
                var reflection = at.material.reflection;
                if is_clear {
                    var beyond = media;
                    let ratio = media_cross(&beyond, at.start, NO_START);
                    let bent = refract_through(ray.direction, at.normal, ratio);
                    let passing = bounded(weight * at.material.filter_color);
                    // A ray that goes straight on is the same ray still, unless it stands still.
                    let same = ratio == 1.0 && hit.t > ray.slack;
                    if !bent.passes {
                        // Total internal reflection: all of the light, and nothing twice.
                        reflection = 1.0;
                    } else if (same || !is_last) && is_above_threshold(passing) {
                        counts.refracted += 1u;
                        let on = ray_from(at.position, bent.direction, at.start ^ INWARDS);
                        waiting[waits] = PathState(on, passing, generation + select(1u, 0u, same), beyond);
                        waits += 1u;
                    }
                }
                let mirrored = bounded(weight * reflection);
                if !is_last && is_above_threshold(mirrored) {
                    counts.reflected += 1u;
                    let direction = mend_unit(reflect_about(ray.direction, at.normal));
                    ray = ray_from(at.position, direction, at.start);
                    weight = mirrored;
                    generation += 1u;
                    goes_on = true;
                }
            }
        }
        if counts.shadow + counts.reflected + counts.refracted - before > MOST_RAYS {
            break;
        }
        if !goes_on {
            if !HAS_TRANSPARENCY || waits == 0u {
                is_whole = true;
                break;
            }
            waits -= 1u;
            ray = waiting[waits].ray;
            weight = waiting[waits].weight;
            generation = waiting[waits].generation;
            media = waiting[waits].media;
        }
    }
    tree_overflowed = tree_overflowed || !is_whole;
    return light;
}
