// Twin of body.rs; a body's bytes are those of `RenderBody`.

struct Body {
    body_from_world: array<f32, 9>,
    world_from_body: array<f32, 9>,
    origin: array<f32, 3>,
    slack: f32,
    parameter: f32,
    material: u32,
    solid: u32,
    // The kind of shape in the lowest byte, whether light passes through in the upper half.
    kind_and_passage: u32,
}

struct SurfacePoint {
    in_body: vec3<f32>,
    in_world: vec3<f32>,
    normal: vec3<f32>,
}

fn body_kind(index: u32) -> u32 {
    return bodies[index].kind_and_passage & 0xffu;
}

fn body_is_transparent(index: u32) -> bool {
    return HAS_TRANSPARENCY && (bodies[index].kind_and_passage & (TRANSPARENT << 16u)) != 0u;
}

// Whether light on its way to other bodies ends at this one.
fn body_stops_light(index: u32) -> bool {
    let passage = bodies[index].kind_and_passage & ((SHADOWLESS | FILTERS) << 16u);
    return !(HAS_TRANSPARENCY || HAS_SHADOWLESS) || passage == 0u;
}

// Whether it passes as if this one were not there.
fn body_is_shadowless(index: u32) -> bool {
    return HAS_SHADOWLESS && (bodies[index].kind_and_passage & (SHADOWLESS << 16u)) != 0u;
}

// Whether it may be cemented to what it touches.
fn body_is_cementable(index: u32) -> bool {
    return (bodies[index].kind_and_passage & (CEMENTABLE << 16u)) != 0u;
}

fn body_origin(index: u32) -> vec3<f32> {
    return vec3(bodies[index].origin[0], bodies[index].origin[1], bodies[index].origin[2]);
}

// The second row of the transform to the body's frame.
fn body_up(index: u32) -> vec3<f32> {
    return vec3(
        bodies[index].body_from_world[3],
        bodies[index].body_from_world[4],
        bodies[index].body_from_world[5],
    );
}

fn to_body(index: u32, v: vec3<f32>) -> vec3<f32> {
    let a = vec3(bodies[index].body_from_world[0], bodies[index].body_from_world[1], bodies[index].body_from_world[2]);
    let c = vec3(bodies[index].body_from_world[6], bodies[index].body_from_world[7], bodies[index].body_from_world[8]);
    return vec3(dot(v, a), dot(v, body_up(index)), dot(v, c));
}

// The product with the transpose of the same matrix.
fn normal_to_world(index: u32, v: vec3<f32>) -> vec3<f32> {
    let a = vec3(bodies[index].body_from_world[0], bodies[index].body_from_world[1], bodies[index].body_from_world[2]);
    let c = vec3(bodies[index].body_from_world[6], bodies[index].body_from_world[7], bodies[index].body_from_world[8]);
    return a * v.x + body_up(index) * v.y + c * v.z;
}

fn to_world(index: u32, v: vec3<f32>) -> vec3<f32> {
    let a = vec3(bodies[index].world_from_body[0], bodies[index].world_from_body[1], bodies[index].world_from_body[2]);
    let b = vec3(bodies[index].world_from_body[3], bodies[index].world_from_body[4], bodies[index].world_from_body[5]);
    let c = vec3(bodies[index].world_from_body[6], bodies[index].world_from_body[7], bodies[index].world_from_body[8]);
    return vec3(dot(v, a), dot(v, b), dot(v, c));
}

fn body_span(index: u32, origin: vec3<f32>, direction: vec3<f32>) -> Span {
    let kind = body_kind(index);
    let local = origin - body_origin(index);
    if HAS_SPHERES && kind == SPHERE {
        return sphere_world_span(bodies[index].parameter, local, direction);
    }
    if HAS_PLANES && kind == PLANE {
        let up = body_up(index);
        return plane_span(dot(up, local), dot(up, direction));
    }
    return canonical_span(kind, bodies[index].parameter, to_body(index, local), to_body(index, direction));
}

// |cos| of the angle between a line and the normal of the face that it crosses at `t`.
fn body_cosine(index: u32, origin: vec3<f32>, direction: vec3<f32>, t: f32, face: u32) -> f32 {
    let kind = body_kind(index);
    if kind == PLANE {
        return abs(dot(normalize_or(body_up(index), vec3(0.0)), direction));
    }
    let point = to_body(index, origin - body_origin(index)) + to_body(index, direction) * t;
    let normal = normal_to_world(index, canonical_normal(kind, bodies[index].parameter, face, point));
    return abs(dot(normalize_or(normal, vec3(0.0)), direction));
}

fn body_contains(index: u32, point: vec3<f32>) -> bool {
    let local = to_body(index, point - body_origin(index));
    return canonical_contains(body_kind(index), bodies[index].parameter, local);
}

fn surface_point(index: u32, ray: Ray, t: f32, leaving: bool) -> SurfacePoint {
    let kind = body_kind(index);
    let local = ray.origin - body_origin(index);
    let side = select(1.0, -1.0, leaving);
    if HAS_SPHERES && kind == SPHERE {
        let normal = normalize_or(local + ray.direction * t, vec3(0.0, 1.0, 0.0));
        let around = normal * bodies[index].parameter;
        return SurfacePoint(to_body(index, around), around + body_origin(index), normal * side);
    }
    let origin = to_body(index, local);
    let direction = to_body(index, ray.direction);
    if HAS_PLANES && kind == PLANE {
        let at = origin + direction * t;
        let in_body = vec3(at.x, 0.0, at.z);
        let normal = normalize_or(body_up(index), vec3(0.0, 1.0, 0.0));
        return SurfacePoint(in_body, to_world(index, in_body) + body_origin(index), normal * side);
    }
    let ratio = bodies[index].parameter;
    let span = canonical_span(kind, ratio, origin, direction);
    let face = select(span.enter_face, span.exit_face, leaving);
    let in_body = pull_to_surface(kind, ratio, face, origin + direction * t);
    let in_world = to_world(index, in_body) + body_origin(index);
    let normal = normal_to_world(index, canonical_normal(kind, ratio, face, in_body));
    return SurfacePoint(in_body, in_world, normalize_or(normal, vec3(0.0, 1.0, 0.0)) * side);
}
