// Twin of solid.rs.

struct Solid {
    // Rows from the body's frame to cells; the last number of each is the offset.
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    // The second color.
    color: vec3<f32>,
    odd_origin: f32,
    kind: f32,
    // How many patterns there are in the row, from the outermost on.
    count: f32,
    // The places in the row of the patterns that stand for the first and the second color; 0 for none.
    first: f32,
    second: f32,
    // Whose second color its first one is, by the place plus 1; 0 if it is the material's color.
    first_of: f32,
    // How far the middle of rings lies away along -x, in cells, if far, else 0.
    far: f32,
}

fn solid_rest(cell: f32) -> f32 {
    return cell - floor(cell * 0.5) * 2.0;
}

fn solid_is_odd_cell(solid: Solid, in_body: vec3<f32>) -> bool {
    let x = floor(dot(in_body, solid.x.xyz) + solid.x.w);
    let y = floor(dot(in_body, solid.y.xyz) + solid.y.w);
    let z = floor(dot(in_body, solid.z.xyz) + solid.z.w);
    let sum = solid_rest(x) + solid_rest(y) + solid_rest(z) + solid.odd_origin;
    return solid_rest(sum) == 1.0;
}
