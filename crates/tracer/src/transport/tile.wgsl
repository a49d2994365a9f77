// Twin of tile.rs: the samples of the pixels of some tiles.

struct Frame {
    // What comes from everywhere; of a gradient, what comes from above; what a picture is multiplied with.
    background: vec3<f32>,
    generations: u32,
    ambient: vec3<f32>,
    threshold: f32,
    // Of a gradient.
    horizon: vec3<f32>,
    // The part of a full turn by which the picture around is turned.
    turn: f32,
    nadir: vec3<f32>,
    // The numbers of bodies from here on are those of members of groups, and of parts.
    scene_bodies: u32,
    // Of the picture, pixels.
    size: vec2<u32>,
    tiles_across: u32,
    first_tile: u32,
    // How many of the bodies are bounded, and how many there are.
    bounded: u32,
    bodies: u32,
    lights: u32,
    largest_slack: f32,
    // How many samples the pixels have, and how many they get.
    samples_done: u32,
    samples: u32,
    eye_media_count: u32,
    // What has to be added to the number of a member for its place behind the order of the bodies.
    members: u32,
    // The bodies around the eye, the outermost first.
    eye_media: array<vec4<u32>, 4>,
    // Where the samples lie in their pixels; two numbers of each.
    places: array<vec4<f32>, MOST_SAMPLES>,
}

struct Pixel {
    // The mean of the samples so far.
    light: vec3<f32>,
    // The body that the last sample's primary ray met, or NO_BODY.
    body: u32,
}

struct Film {
    // Rays by kind, each in two words: shadow, reflected, refracted. Then whether a list of media had no room, and
    // whether a tree had too many rays.
    rays: array<atomic<u32>, 8>,
    pixels: array<Pixel>,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> bodies: array<Body>;
// For each body its number in the scene, and its place in the order of volumes. Of a joined body, that of its record; of a
// part, the start of a ray from its outer side as the whole has it. Behind them, the places in the scene of members, and
// the records.
@group(0) @binding(2) var<storage, read> scene_order: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> boxes: array<Box>;
// The fourth, `materials`, is declared where their form is.
@group(0) @binding(5) var<storage, read> solids: array<Solid>;
@group(0) @binding(6) var<storage, read> lights: array<Light>;
@group(0) @binding(7) var<storage, read> tiles: array<CameraRays>;
@group(0) @binding(8) var<storage, read_write> film: Film;

// Rays of a workgroup by kind.
var<workgroup> group_rays: array<atomic<u32>, 3>;

// A block of 8 × 8 pixels is a workgroup.
@compute @workgroup_size(64)
fn add_samples(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let tile = frame.first_tile + group.y;
    let corner = vec2(tile % frame.tiles_across, tile / frame.tiles_across) * TILE;
    let within = vec2(group.x % BLOCKS_ACROSS, group.x / BLOCKS_ACROSS) * 8u + vec2(local % 8u, local / 8u);
    let pixel = corner + within;
    if all(pixel < frame.size) {
        let extent = min(vec2(TILE), frame.size - corner);
        sample_pixel(tile, within, extent, pixel.y * frame.size.x + pixel.x);
    }
    atomicAdd(&group_rays[0], counts.shadow);
    atomicAdd(&group_rays[1], counts.reflected);
    atomicAdd(&group_rays[2], counts.refracted);
    if media_overflowed {
        atomicOr(&film.rays[6], 1u);
    }
    if tree_overflowed {
        atomicOr(&film.rays[7], 1u);
    }
    workgroupBarrier();
    if local < 3u {
        add_rays(local, atomicLoad(&group_rays[local]));
    }
}

fn sample_pixel(tile: u32, within: vec2<u32>, extent: vec2<u32>, place: u32) {
    let near = tiles[tile];
    var mean = film.pixels[place].light;
    var body = NO_BODY;
    var sample = 0u;
    for (; sample < frame.samples; sample++) {
        let offset = frame.places[sample].xy - 0.5 * vec2<f32>(extent);
        let at = vec2<f32>(within) + offset;
        begin_sample(place, sample);
        let light = trace(ray_near(near, at.x, at.y), &body);
        let done = frame.samples_done + sample;
        // What the first sample finds in the buffer means nothing.
        if done == 0u {
            mean = light;
        } else {
            mean += (light - mean) * (1.0 / f32(done + 1u));
        }
    }
    tree_overflowed = tree_overflowed || sample < frame.samples;
    film.pixels[place] = Pixel(mean, body);
}

// Adds to a number of two words.
fn add_rays(kind: u32, count: u32) {
    let before = atomicAdd(&film.rays[2u * kind], count);
    if before + count < before {
        atomicAdd(&film.rays[2u * kind + 1u], 1u);
    }
}
