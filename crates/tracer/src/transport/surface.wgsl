// Twin of surface.rs.

fn reflect_about(direction: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return direction - normal * (dot(normal, direction) * 2.0);
}

fn mend_unit(vector: vec3<f32>) -> vec3<f32> {
    return vector * (1.5 - dot(vector, vector) * 0.5);
}

struct RefractedDirection {
    direction: vec3<f32>,
    passes: bool,
}

fn refract_through(direction: vec3<f32>, normal: vec3<f32>, ratio: f32) -> RefractedDirection {
    if ratio == 1.0 {
        return RefractedDirection(direction, true);
    }
    let cos_in = -dot(direction, normal);
    let cos_out_squared = 1.0 - ratio * ratio * (1.0 - cos_in * cos_in);
    let cos_out = sqrt(max(cos_out_squared, 0.0));
    let bent = mend_unit(direction * ratio + normal * (ratio * cos_in - cos_out));
    return RefractedDirection(bent, !(cos_out_squared < 0.0));
}

// The share of unpolarized light that the smooth boundary of a clear body reflects (A. Fresnel 1823; Born, Wolf 1999,
// eq. 1.5.32).
fn fresnel(cos: f32, ratio: f32) -> f32 {
    if ratio == 1.0 {
        return 0.0;
    }
    let shares = fresnel_polarized(cos, ratio);
    return min((shares.x + shares.y) * 0.5, 1.0);
}

// Its shares of light that swings across and along the plane of incidence; both are 1 at total reflection.
fn fresnel_polarized(cos: f32, ratio: f32) -> vec2<f32> {
    // 1 - ratio²·sin², without a difference of near numbers where the indices are nearly equal.
    let cos_out_squared = (1.0 - ratio) * (1.0 + ratio) + ratio * ratio * cos * cos;
    if cos_out_squared < 0.0 || cos <= 0.0 {
        return vec2(1.0);
    }
    let cos_out = sqrt(cos_out_squared);
    let across = (ratio * cos - cos_out) / max(ratio * cos + cos_out, LEAST_NORMAL);
    let along = (cos - ratio * cos_out) / max(cos + ratio * cos_out, LEAST_NORMAL);
    return vec2(across * across, along * along);
}

// Schlick's estimate of it, with the cosine on the side of the smaller index; 1 at total reflection.
fn schlick(cos: f32, ratio: f32) -> f32 {
    let cos_out_squared = (1.0 - ratio) * (1.0 + ratio) + ratio * ratio * cos * cos;
    let rest = max(1.0 - select(cos, sqrt(max(cos_out_squared, 0.0)), ratio > 1.0), 0.0);
    let root = (ratio - 1.0) / (ratio + 1.0);
    let straight = root * root;
    let square = rest * rest;
    return straight + (1.0 - straight) * (square * square * rest);
}

// e⁻³⁰ of the brightest light that a scene may have is nothing in single precision.
const INVISIBLE: f32 = 30.0;
// The bits of √½.
const SQRT_HALF: u32 = 0x3f3504f3u;

fn phong_highlight(to_viewer: vec3<f32>, to_light: vec3<f32>, normal: vec3<f32>, shininess: f32) -> f32 {
    let cos = min(2.0 * dot(normal, to_light) * dot(normal, to_viewer) - dot(to_light, to_viewer), 1.0);
    if cos > 0.0 && shininess * (1.0 - cos) < INVISIBLE {
        if shininess > NARROW_HIGHLIGHT {
            return narrow_highlight(to_viewer, to_light, normal, shininess);
        }
        return exponential(logarithm(cos) * shininess);
    }
    return 0.0;
}

// Of large exponents: the cosine is 1 - s with s = |R̂ - Ŝ|²/2.
fn narrow_highlight(to_viewer: vec3<f32>, to_light: vec3<f32>, normal: vec3<f32>, shininess: f32) -> f32 {
    let apart = normal * (2.0 * dot(normal, to_light)) - (to_light + to_viewer);
    let s = dot(apart, apart) * 0.5;
    return exponential(-s * (1.0 + s * (0.5 + s / 3.0)) * shininess);
}

// ln x for normal x > 0.
fn logarithm(x: f32) -> f32 {
    let word = bitcast<u32>(x) - SQRT_HALF;
    let exponent = f32(bitcast<i32>(word) >> 23u);
    let f = bitcast<f32>((word & 0x007fffffu) + SQRT_HALF) - 1.0;
    let square = f * f;
    var sum = f * 7.0376836e-2 - 1.151461e-1;
    sum = sum * f + 1.1676999e-1;
    sum = sum * f - 1.2420141e-1;
    sum = sum * f + 1.4249323e-1;
    sum = sum * f - 1.6668057e-1;
    sum = sum * f + 2.0000715e-1;
    sum = sum * f - 2.4999994e-1;
    sum = sum * f + 3.333333e-1;
    let tail = sum * f * square - exponent * 2.1219444e-4 - square * 0.5;
    return tail + f + exponent * 0.6933594;
}

// eˣ for x ≤ 0.
fn exponential(x: f32) -> f32 {
    if x < -87.0 {
        return 0.0;
    }
    let n = round(x * 1.442695);
    let r = x - n * 0.6933594 + n * 2.1219444e-4;
    var sum = r * 1.9875691e-4 + 1.3981999e-3;
    sum = sum * r + 8.333452e-3;
    sum = sum * r + 4.1665796e-2;
    sum = sum * r + 1.6666665e-1;
    sum = sum * r + 0.5;
    let value = sum * r * r + r + 1.0;
    return value * bitcast<f32>(u32(i32(n) + 127) << 23u);
}
