// Twin of sampler.rs: numbers that look random. All is computed in words, so that they are the CPU's to the last bit.

// Numbers for a ray.
struct Sample2D {
    // Cosine and sine of an angle that is anything.
    cos: f32,
    sin: f32,
    // From 0 to below 1, independent of the angle.
    second: f32,
}

// The pixel, column and row, and which sample of it is traced.
var<private> dice_pixel: vec2<u32> = vec2(0u, 0u);
var<private> dice_sample: u32 = 0u;

// What numbers are for: the facet of a rough surface; and from here on the point of a light, by its place in the stage.
const FOR_FACET: u32 = 0u;
const FOR_LIGHT: u32 = 1u;

// Two numbers for a ray that met a body.
fn sample_2d(generation: u32, body: u32, what_for: u32) -> Sample2D {
    var key = hashed(hashed(0u, dice_pixel.x), dice_pixel.y);
    // The body's place in the scene: that in the stage may change with edits of others.
    key = hashed(hashed(hashed(key, generation), scene_order[body].x), what_for);
    let numbers = sampler_pair(dice_sample, key);
    let angle = cos_sin_of_turn(numbers.x);
    return Sample2D(angle.x, angle.y, numbers.y);
}

// A key with another number mixed in (the finalizer of MurmurHash3, A. Appleby 2011).
fn hashed(key: u32, number: u32) -> u32 {
    var bits = ((key << 13u) | (key >> 19u)) ^ (number * 0x9e3779b9u);
    bits = (bits ^ (bits >> 16u)) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 13u)) * 0xc2b2ae35u;
    return bits ^ (bits >> 16u);
}

// The numbers of a sample (B. Burley 2020, Practical hash-based Owen scrambling).
fn sampler_pair(sample: u32, key: u32) -> vec2<f32> {
    let index = scrambled(sample, key);
    let first = scrambled(reverseBits(index), hashed(key, 0x68bc21ebu)) >> 8u;
    let second = scrambled(second_of(index), hashed(key, 0x02e5be93u)) >> 8u;
    return vec2(f32(first), f32(second)) * 5.9604645e-8;
}

// The second coordinate of Sobol's sequence (I. M. Sobol 1967).
fn second_of(index: u32) -> u32 {
    var bits = reverseBits(index);
    bits ^= bits << 16u;
    bits ^= (bits & 0x00ff00ffu) << 8u;
    bits ^= (bits & 0x0f0f0f0fu) << 4u;
    bits ^= (bits & 0x33333333u) << 2u;
    return bits ^ ((bits & 0x55555555u) << 1u);
}

// Owen's scrambling by a hash (S. Laine, T. Karras 2011; constants by N. Vegdahl 2021).
fn scrambled(number: u32, key: u32) -> u32 {
    var bits = reverseBits(number);
    bits ^= bits * 0x3d20adeau;
    bits += key;
    bits *= (key >> 16u) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return reverseBits(bits);
}

// Cosine and sine of a part of a full turn: Taylor's series, since a card's own may be off by much more.
fn cos_sin_of_turn(part: f32) -> vec2<f32> {
    let quarters = part * 4.0;
    let quarter = floor(quarters);
    let x = (quarters - quarter) * 1.5707964;
    let s = x * x;
    let sin = x * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0
        + s * (1.0 / 362880.0 + s * (-1.0 / 39916800.0))))));
    let cos = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0
        + s * (1.0 / 40320.0 + s * (-1.0 / 3628800.0 + s * (1.0 / 479001600.0))))));
    switch u32(quarter) % 4u {
        case 0u: {
            return vec2(cos, sin);
        }
        case 1u: {
            return vec2(-sin, cos);
        }
        case 2u: {
            return vec2(-cos, -sin);
        }
        default: {
            return vec2(sin, -cos);
        }
    }
}
