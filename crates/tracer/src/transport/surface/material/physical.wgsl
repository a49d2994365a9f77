// Twin of material.rs for stages with physical materials. A material is some rows of four words; behind all of them lie
// the curves of metals and the indices of bodies that split light.

struct CoatedMaterial {
    // Index of air divided by that of the coat.
    ratio: f32,
    // 1/η².
    spread: f32,
    // What the coat lets out of light scattered evenly below it.
    lets_out: f32,
    // What the coat lets in of light that comes evenly from all sides.
    lets_in: f32,
}

struct Material {
    color: vec3<f32>,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    reflection: f32,
    // How much it reflects under which angle: one of LAW_….
    law: u32,
    // Width of the slopes of its facets; 0 is smooth.
    alpha: f32,
    // The row where its curve begins, if it is a metal.
    curve: u32,
    // The row where its indices by wavelength begin, or NO_ROWS.
    indices: u32,
    coat: CoatedMaterial,
}

// What is left of light that goes through a thin sheet, whose numbers stand in the place of a coat's.
fn tint_of(material: Material) -> vec3<f32> {
    return vec3(material.coat.spread, material.coat.lets_out, material.coat.lets_in);
}

@group(0) @binding(4) var<storage, read> materials: array<vec4<u32>>;

fn row_of(row: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(materials[row]);
}

fn first_row(body: u32) -> u32 {
    return bodies[body].material * MATERIAL_ROWS;
}

fn material_of(body: u32) -> Material {
    let first = first_row(body);
    let color = row_of(first);
    let phong = row_of(first + 2u);
    let law = materials[first + 3u];
    let coat = row_of(first + 5u);
    return Material(
        color.xyz, color.w, phong.x, phong.y, phong.z, phong.w,
        law.x, bitcast<f32>(law.y), law.z, law.w,
        CoatedMaterial(coat.x, coat.y, coat.z, coat.w),
    );
}

// What one crossing of a body's surface lets through.
fn filter_of(body: u32) -> vec3<f32> {
    return row_of(first_row(body) + 1u).xyz;
}

// The index of refraction within a body for the light of a ray whose outermost medium this is.
fn ior_of(body: u32, outermost: u32) -> f32 {
    // A wave that stands alone is in air.
    if DISPERSES && body >= WAVES {
        return 1.0;
    }
    let first = first_row(body);
    if DISPERSES && outermost >= WAVES {
        let indices = materials[first + 3u].w;
        if indices != NO_ROWS {
            return index_at(indices, outermost - WAVES);
        }
    }
    return row_of(first + 1u).w;
}

// The share of light that is left after a way of this length in a body, meters (P. Bouguer 1729, J. H. Lambert 1760,
// A. Beer 1852).
fn left_after(body: u32, way: f32) -> vec3<f32> {
    // A way without end through a clear body loses nothing.
    let lost = row_of(first_row(body) + 4u).xyz * min(way, 1e30);
    return vec3(exponential(-lost.x), exponential(-lost.y), exponential(-lost.z));
}
