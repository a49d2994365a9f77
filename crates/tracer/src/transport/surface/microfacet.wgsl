// Twin of microfacet.rs: rough surfaces.

struct AcrossInterface {
    right: vec3<f32>,
    up: vec3<f32>,
}

// Two unit vectors across a third, those of a fixed pole mirrored so that it comes to lie opposite the axis (A. S.
// Householder 1958). They turn continuously with the axis, but where that is opposite the pole.
fn frame_of(axis: vec3<f32>) -> AcrossInterface {
    let pole_right = vec3(14.0, -5.0, 2.0) / 15.0;
    let pole_up = vec3(5.0, 10.0, -10.0) / 15.0;
    let half = axis + vec3(2.0, 10.0, 11.0) / 15.0;
    let scale = -2.0 / max(dot(half, half), LEAST_NORMAL);
    return AcrossInterface(
        pole_right + half * (dot(half, pole_right) * scale),
        pole_up + half * (dot(half, pole_up) * scale),
    );
}

// A facet that is seen along `-direction`, chosen as often as it is seen (J. Dupuy, A. Benyoub 2023, Sampling visible GGX
// normals with spherical caps): its unit normal.
fn sample_visible_normal(direction: vec3<f32>, normal: vec3<f32>, alpha: f32, thrown: Sample2D) -> vec3<f32> {
    let across = frame_of(normal);
    let to_viewer = -direction;
    // The facets stretched to a half-sphere.
    let stretched = vec3(dot(across.right, to_viewer) * alpha, dot(across.up, to_viewer) * alpha, dot(normal, to_viewer));
    let view = normalize_or(stretched, vec3(0.0, 0.0, 1.0));
    // A point of the cap has the height lift - view.z.
    let from_pole = max(1.0 + view.z, 0.0);
    let lift = (1.0 - thrown.second) * from_pole;
    let wide = sqrt(thrown.second * (dot(view.xy, view.xy) + from_pole * lift));
    let cap = vec3(wide * thrown.cos + view.x, wide * thrown.sin + view.y, lift);
    let facet = across.right * (cap.x * alpha) + across.up * (cap.y * alpha) + normal * cap.z;
    return normalize_or(facet, normal);
}

// The share of facets that is seen under an angle to the normal of this cosine, G₁ (Walter et al. 2007, eq. 34).
fn smith_g1(cos: f32, alpha: f32) -> f32 {
    let square = max(cos * cos, LEAST_NORMAL);
    let slope = max(1.0 - square, 0.0) / square;
    return 2.0 / (1.0 + sqrt(1.0 + alpha * alpha * slope));
}

// π times the density of facets with this normal (Walter et al. 2007, eq. 33).
fn ggx_density(normal: vec3<f32>, half: vec3<f32>, alpha: f32) -> f32 {
    let cos = dot(normal, half);
    // sin² + α²·cos², without a difference of squares near 1.
    let across = half - normal * cos;
    let square = alpha * alpha;
    let spread = dot(across, across) + square * cos * cos;
    return square / (spread * spread);
}

// What facets send on to the viewer of light from a direction, but for what each reflects: π·D·G/(4·(n̂·Ŝ)) (Walter et al.
// 2007, eq. 20).
fn reflected_density(to_viewer: vec3<f32>, to_light: vec3<f32>, normal: vec3<f32>, half: vec3<f32>, alpha: f32) -> f32 {
    let cos_viewer = max(dot(normal, to_viewer), 1e-6);
    let cos_light = max(dot(normal, to_light), 1e-6);
    let seen = smith_g1(cos_viewer, alpha) * smith_g1(cos_light, alpha);
    return ggx_density(normal, half, alpha) * seen / (cos_viewer * 4.0);
}

struct TransmittedDensity {
    share: f32,
    // Under which the viewer sees the facet.
    cos: f32,
}

// What facets send through to a viewer inside of light from outside (Walter et al. 2007, eq. 21), but for what each
// reflects. `ratio` is the index on the viewer's side divided by that on the light's.
fn transmitted_density(
    to_viewer: vec3<f32>,
    to_light: vec3<f32>,
    normal: vec3<f32>,
    ratio: f32,
    alpha: f32,
) -> TransmittedDensity {
    var half = normalize_or(to_viewer * ratio + to_light, normal);
    half *= select(1.0, -1.0, dot(normal, half) < 0.0);
    let viewer = dot(half, to_viewer);
    let light = -dot(half, to_light);
    let cos_viewer = max(dot(normal, to_viewer), 1e-6);
    let cos_light = max(-dot(normal, to_light), 1e-6);
    let seen = smith_g1(cos_viewer, alpha) * smith_g1(cos_light, alpha);
    let width = ratio * viewer - light;
    let sent = ggx_density(normal, half, alpha) * seen * viewer * light / (cos_viewer * max(width * width, 1e-6));
    return TransmittedDensity(select(0.0, sent, viewer > 0.0 && light > 0.0), clamp(viewer, 0.0, 1.0));
}
