// Twin of cube.rs.

fn cube_span(origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let x = slab_half_open(origin.x, direction.x, -1.0, 0u, 1.0, 1u);
    let y = slab_half_open(origin.y, direction.y, -1.0, 2u, 1.0, 3u);
    let z = slab_half_open(origin.z, direction.z, -1.0, 4u, 1.0, 5u);
    return intersect(intersect(x, y), z);
}

fn cube_pull_to_surface(face: u32, point: vec3<f32>) -> vec3<f32> {
    let normal = cube_normal(face);
    return select(normal, clamp(point, vec3(-1.0), vec3(1.0)), normal == vec3(0.0));
}

fn cube_normal(face: u32) -> vec3<f32> {
    let axis = face / 2u;
    let sign = f32(face % 2u) * 2.0 - 1.0;
    return select(vec3(0.0), vec3(sign), vec3(axis) == vec3(0u, 1u, 2u));
}
