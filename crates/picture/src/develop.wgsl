// Twin of develop.rs, with what it needs of tone.rs and srgb.rs: a film on a graphics card becomes a texture.

struct Development {
    // The factor of the exposure.
    scale: f32,
    // 0 clamps, 1 is Reinhard's curve, 2 the filmic one, 3 gives codes in proportion to light.
    curve: u32,
    // Width and height, pixels.
    size: vec2<u32>,
}

struct Pixel {
    light: vec3<f32>,
    body: u32,
}

struct Film {
    head: array<u32, 8>,
    pixels: array<Pixel>,
}

@group(0) @binding(0) var<uniform> development: Development;
@group(0) @binding(1) var<storage, read> film: Film;
@group(0) @binding(2) var shown: texture_storage_2d<rgba8unorm, write>;

@compute @workgroup_size(8, 8)
fn develop(@builtin(global_invocation_id) at: vec3<u32>) {
    if any(at.xy >= development.size) {
        return;
    }
    let light = film.pixels[at.y * development.size.x + at.x].light * development.scale;
    let code = floor(255.0 * encode(tone(light)) + 0.5);
    textureStore(shown, at.xy, vec4(code / 255.0, 1.0));
}

fn tone(light: vec3<f32>) -> vec3<f32> {
    switch development.curve {
        case 1u: {
            let x = clamp(light, vec3(0.0), vec3(1e30));
            return x / (1.0 + x);
        }
        case 2u: {
            let x = clamp(light, vec3(0.0), vec3(100.0));
            return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3(0.0), vec3(1.0));
        }
        case 3u: {
            return decode(clamp(light, vec3(0.0), vec3(1.0)));
        }
        default: {
            return clamp(light, vec3(0.0), vec3(1.0));
        }
    }
}

// The inverse of the sRGB function.
fn decode(x: vec3<f32>) -> vec3<f32> {
    let curved = pow((max(x, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4));
    return select(curved, x / 12.92, x <= vec3(0.04045));
}

// The sRGB function (IEC 61966-2-1:1999).
fn encode(x: vec3<f32>) -> vec3<f32> {
    let curved = 1.055 * pow(max(x, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return select(curved, 12.92 * x, x <= vec3(0.0031308));
}
