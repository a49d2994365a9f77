// Twin of spectrum.rs: the colors that white light is split into.

// Of each sample of the dispatch its waves: linear light, and nanometers in vacuum.
@group(0) @binding(9) var<uniform> sample_waves: array<vec4<f32>, SAMPLE_WAVES>;

// The place of the sample's first wave among them.
var<private> first_wave: u32 = 0u;

fn wave_color(wave: u32) -> vec3<f32> {
    return sample_waves[first_wave + wave].xyz;
}

// The index of refraction for a wave: of those at even steps, which begin at a row, what lies between the nearest two.
fn index_at(first: u32, wave: u32) -> f32 {
    let place = clamp((sample_waves[first_wave + wave].w - INDEX_START) * INDEX_RATE, 0.0, f32(INDEX_STEPS));
    let before = min(u32(place), INDEX_STEPS - 1u);
    let next = before + 1u;
    let low = bitcast<f32>(materials[first + before / 4u][before % 4u]);
    let high = bitcast<f32>(materials[first + next / 4u][next % 4u]);
    return low + (high - low) * (place - f32(before));
}

// Whether the light in these media has not been split yet.
fn is_white(media: ptr<function, Media>) -> bool {
    return (*media).count == 0u || (*media).bodies[0] < WAVES;
}

// Makes the media those of light of one wave, which stands before the outermost body.
fn media_colored(media: ptr<function, Media>, wave: u32) {
    if (*media).count == MEDIA {
        media_overflowed = true;
        return;
    }
    for (var at = (*media).count; at > 0u; at--) {
        (*media).bodies[at] = (*media).bodies[at - 1u];
    }
    (*media).bodies[0] = WAVES + wave;
    (*media).count += 1u;
}
