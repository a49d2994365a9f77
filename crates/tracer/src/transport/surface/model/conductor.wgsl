// Twin of conductor.rs: how much a metal reflects, by angle.

// The reflectances at a cosine from 0 to 1 of the curve that begins at a row.
fn curve_at(first: u32, cos: f32) -> vec3<f32> {
    let place = clamp(cos, 0.0, 1.0) * f32(CURVE_STEPS);
    let before = min(u32(place), CURVE_STEPS - 1u);
    let x = place - f32(before);
    // Lagrange's cubic through -1, 0, 1 and 2.
    let up = x + 1.0;
    let down = x - 1.0;
    let far = x - 2.0;
    let row = first + before;
    let sum = row_of(row).xyz * (x * down * far * (-1.0 / 6.0))
        + row_of(row + 1u).xyz * (up * down * far * 0.5)
        + row_of(row + 2u).xyz * (up * x * far * -0.5)
        + row_of(row + 3u).xyz * (up * x * down * (1.0 / 6.0));
    return max(sum, vec3(0.0));
}
