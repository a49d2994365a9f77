// Twin of whitted.rs for stages without physical materials: surfaces reflect a constant share, lights are points.

// A ray that waits.
struct PathState {
    ray: Ray,
    // Product of the coefficients on the way from the eye.
    weight: vec3<f32>,
    generation: u32,
    media: Media,
}

// The points that a ray met, with all that shading needs.
struct SurfaceInteraction {
    position: vec3<f32>,
    normal: vec3<f32>,
    color: vec3<f32>,
}

fn interaction(ray: Ray, hit: HitRecord) -> SurfaceInteraction {
    let point = surface_point(hit.body, ray, hit.t, hit.leaving);
    var color = color_at(materials[bodies[hit.body].material].color, hit.body, point.in_body);
    if HAS_CHECKERS && bodies[hit.body].checker != NO_BODY {
        let checker = checkers[bodies[hit.body].checker];
        if checker_is_odd(checker, point.in_body) {
            color = checker.color;
        }
    }
    return SurfaceInteraction(point.in_world, point.normal, color);
}

// Prepares for a sample of a pixel.
fn begin_sample(place: u32, sample: u32) {}

// The ambient, diffuse and highlight terms.
fn local_light(
    ray: Ray,
    at: SurfaceInteraction,
    start: u32,
    material: Material,
    media: ptr<function, Media>,
) -> vec3<f32> {
    var sum = at.color * (frame.ambient * material.ambient);
    if material.diffuse == 0.0 && material.specular == 0.0 {
        return sum;
    }
    for (var index = 0u; index < frame.lights; index++) {
        let light = lights[index];
        if all(light.power == vec3(0.0)) {
            continue;
        }
        let offset = light.position - at.position;
        let distance = sqrt(dot(offset, offset));
        let to_light = offset * (1.0 / distance);
        let cos = dot(at.normal, to_light);
        // A light that stands exactly here has no direction.
        if !(distance > 0.0 && cos > 0.0) {
            continue;
        }
        counts.shadow += 1u;
        let passed = transmittance(ray_from(at.position, to_light, start), media, distance);
        if all(passed == vec3(0.0)) {
            continue;
        }
        var answer = at.color * material.diffuse * cos;
        if material.specular != 0.0 {
            answer += material.specular * phong_highlight(-ray.direction, to_light, at.normal, material.shininess);
        }
        sum += power_at(light, distance) * answer * passed;
    }
    return bounded(sum);
}

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
            let at = interaction(ray, hit);
            let material = materials[bodies[hit.body].material];
            let start = hit.body | select(0u, INWARDS, hit.leaving);
            light += weight * local_light(ray, at, start, material, &media);
            let is_clear = HAS_TRANSPARENCY && body_is_transparent(hit.body);
            // In the last generation only those go on that are the same ray still.
            let is_last = generation >= frame.generations;
            if !is_last || is_clear {
                var reflection = material.reflection;
                if is_clear {
                    var beyond = media;
                    let ratio = media_cross(&beyond, hit.body);
                    let bent = refract_through(ray.direction, at.normal, ratio);
                    let passing = bounded(weight * material.filter_color);
                    // A ray that goes straight on is the same ray still, unless it stands still.
                    let same = ratio == 1.0 && hit.t > ray.slack;
                    if !bent.passes {
                        // Total internal reflection: all of the light, and nothing twice.
                        reflection = 1.0;
                    } else if (same || !is_last) && is_above_threshold(passing) {
                        counts.refracted += 1u;
                        let on = ray_from(at.position, bent.direction, start ^ INWARDS);
                        waiting[waits] = PathState(on, passing, generation + select(1u, 0u, same), beyond);
                        waits += 1u;
                    }
                }
                let mirrored = bounded(weight * reflection);
                if !is_last && is_above_threshold(mirrored) {
                    counts.reflected += 1u;
                    let direction = mend_unit(reflect_about(ray.direction, at.normal));
                    ray = ray_from(at.position, direction, start);
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
