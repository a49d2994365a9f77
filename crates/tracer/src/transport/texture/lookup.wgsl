// Twin of lookup.rs. The pictures lie one behind the other in the rows of one texture of words, which hold exact numbers:
// cards need not have more storage arrays than are taken. First comes a record for each picture, then their pixels.

@group(0) @binding(10) var pictures: texture_2d<u32>;

fn texel(index: u32) -> vec4<u32> {
    return textureLoad(pictures, vec2(index % PICTURES_ACROSS, index / PICTURES_ACROSS), 0);
}

// Whole numbers of columns or rows, of so many, beyond the edges counted from the other one or the nearest. The quotient may
// be off by rounding.
fn indices(at: vec2<f32>, count: u32, repeats: bool) -> vec2<u32> {
    let size = f32(count);
    let rest = at - floor(at / size) * size;
    let repeated = select(select(rest, rest - size, rest >= vec2(size)), rest + size, rest < vec2(0.0));
    return min(vec2<u32>(max(select(at, repeated, repeats), vec2(0.0))), vec2(count - 1u));
}

// The color at a place of a picture, from the upper left corner (0, 0) to the lower right one (1, 1). To the left and
// right, and above and below, lies its other edge, or more of its edge.
fn image_at(number: u32, u: f32, v: f32, repeats: vec2<bool>) -> vec3<f32> {
    // The first pixel, width, height.
    let image = texel(number);
    let size = vec2<f32>(image.yz);
    // Pixels have their values at their centers.
    let x = u * size.x - 0.5;
    let y = v * size.y - 0.5;
    let left = floor(x);
    let top = floor(y);
    let column = indices(vec2(left, left + 1.0), image.y, repeats.x);
    let row = indices(vec2(top, top + 1.0), image.z, repeats.y);
    let first = vec2(image.x) + row * image.y;
    let a = bitcast<vec3<f32>>(texel(first.x + column.x).xyz);
    let b = bitcast<vec3<f32>>(texel(first.x + column.y).xyz);
    let c = bitcast<vec3<f32>>(texel(first.y + column.x).xyz);
    let d = bitcast<vec3<f32>>(texel(first.y + column.y).xyz);
    let upper = a + (b - a) * (x - left);
    let lower = c + (d - c) * (x - left);
    return upper + (lower - upper) * (y - top);
}

// The arc tangent of y/x in the quadrant of (x, y). What cards have of their own may be off by much of a pixel of a large
// picture; this polynomial (S. L. Moshier 1989, Cephes, `atanf`) is off by rounding.
fn angle_of(y: f32, x: f32) -> f32 {
    let long = max(abs(x), abs(y));
    if !(long > 0.0) {
        return 0.0;
    }
    let tan = min(abs(x), abs(y)) / long;
    // Above tan π/8 the angle is counted from π/4.
    let is_wide = tan > 0.41421356;
    let t = select(tan, (tan - 1.0) / (tan + 1.0), is_wide);
    let s = t * t;
    let odd = (((8.05374449538e-2 * s - 1.38776856032e-1) * s + 1.99777106478e-1) * s - 3.33329491539e-1) * s * t + t;
    var angle = odd + select(0.0, 0.25 * PI, is_wide);
    angle = select(angle, 0.5 * PI - angle, abs(y) > abs(x));
    angle = select(angle, PI - angle, x < 0.0);
    return select(angle, -angle, y < 0.0);
}
