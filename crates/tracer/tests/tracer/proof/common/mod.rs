//! Short ways to build scenes and to follow rays, shared by all tests.

pub(crate) mod oracle;
pub(crate) mod textbook;

use std::sync::atomic::AtomicBool;

use catoptric_picture::{Difference, Picture};
use catoptric_scene::{
    Anchor, Body, Camera, Color, Environment, Falloff, Light, Material, MaterialChoice, Phong, Placement,
    Projection, Scene, Shape, Tracing,
};
use catoptric_tracer::{
    Ray, RayIntersection, RayOrigin, RayRecord, RenderControl, RenderScene, RenderSettings,
    WhittedIntegrator, render,
};
use glam::{DVec2, DVec3, Vec3};
use proptest::test_runner::{Config, RngSeed};

pub(crate) fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A property test's settings: the same cases every time. `PROPTEST_RNG_SEED` and `PROPTEST_CASES` explore others.
pub(crate) fn cases(count: u32) -> Config {
    let mut config = Config::default();
    if config.rng_seed == RngSeed::Random {
        config.rng_seed = RngSeed::Fixed(0x0CA7_0971C);
    }
    if std::env::var_os("PROPTEST_CASES").is_none() {
        config.cases = count;
    }
    config.failure_persistence = None;
    config.max_global_rejects = 20 * config.cases;
    config
}

// ---- materials ----

/// Reflects everything and nothing else.
pub(crate) fn mirror() -> Phong {
    Phong { ambient: 0.0, diffuse: 0.0, reflection: Some(1.0), ..Phong::default() }
}

/// Lets everything pass and nothing else.
pub(crate) fn glass(ior: f64) -> Phong {
    Phong { ambient: 0.0, diffuse: 0.0, reflection: Some(0.0), transmission: 1.0, ior, ..Phong::default() }
}

/// Has this color however it is lit, in a scene made by [`scene`].
pub(crate) fn glow(color: Color) -> Phong {
    Phong { pattern: color.into(), ambient: 1.0, diffuse: 0.0, ..Phong::default() }
}

/// Diffuse white and nothing else.
pub(crate) fn chalk() -> Phong {
    Phong { pattern: Color::WHITE.into(), ambient: 0.0, diffuse: 1.0, ..Phong::default() }
}

// ---- bodies ----

pub(crate) fn body(shape: Shape, position: DVec3, material: impl Into<Material>) -> Body {
    placed(shape, Placement::at(position), material)
}

pub(crate) fn turned(
    shape: Shape,
    position: DVec3,
    rotation_degrees: DVec3,
    material: impl Into<Material>,
) -> Body {
    placed(
        shape,
        Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE },
        material,
    )
}

pub(crate) fn placed(shape: Shape, placement: Placement, material: impl Into<Material>) -> Body {
    let material = MaterialChoice::own(material);
    Body { shape, placement, material, ..Body::default() }
}

pub(crate) fn ball(radius: f64, position: DVec3, material: impl Into<Material>) -> Body {
    body(Shape::Sphere { radius }, position, material)
}

pub(crate) fn block(size: DVec3, position: DVec3, material: impl Into<Material>) -> Body {
    body(Shape::Cube { size }, position, material)
}

/// The plane through `point` whose outward normal lies in the xy-plane, `degrees` from +Y towards -X.
pub(crate) fn plane(point: DVec3, degrees: f64, material: impl Into<Material>) -> Body {
    turned(Shape::Plane, point, v(0.0, 0.0, degrees), material)
}

// ---- scenes ----

/// A scene without lights, in black surroundings with white ambient light, followed to 64 generations.
pub(crate) fn scene(bodies: Vec<Body>) -> Scene {
    Scene {
        environment: Environment {
            background: Color::BLACK,
            ambient: Color::WHITE,
            ..Environment::default()
        },
        tracing: Tracing { generations: 64, threshold: 0.0 },
        bodies: bodies.into(),
        ..Scene::default()
    }
}

pub(crate) fn camera(position: DVec3, target: DVec3, fov_degrees: f64) -> Camera {
    Camera { position, target, up: DVec3::Y, projection: Projection::Perspective { fov_degrees } }
}

pub(crate) fn light(position: DVec3, intensity: f64, falloff: Falloff) -> Light {
    Light { position, intensity, falloff, ..Light::default() }
}

pub(crate) fn render_scene(scene: &Scene) -> RenderScene {
    RenderScene::build(scene).unwrap()
}

pub(crate) fn stage_of(bodies: Vec<Body>) -> RenderScene {
    render_scene(&scene(bodies))
}

/// A scene of which a single pixel takes longer than the universe is old: 2⁶³ rays between reflecting panes of glass.
pub(crate) fn endless() -> RenderScene {
    let mut pane = glass(1.5);
    (pane.reflection, pane.transmission) = (Some(0.5), 0.5);
    let panes: Vec<Body> =
        (0..4).map(|k| block(v(1e4, 1e4, 0.1), v(0.0, 0.0, -f64::from(k)), pane.clone())).collect();
    render_scene(&scene(panes))
}

// ---- rays ----

pub(crate) fn ray(from: DVec3, direction: DVec3) -> Ray {
    Ray::from_point(from.as_vec3(), direction.normalize().as_vec3().normalize())
}

/// A ray that has left the surface of `hit` in some direction on the side it came from.
pub(crate) fn ray_from_hit(hit: &RayIntersection, direction: Vec3) -> Ray {
    let start = RayOrigin { body: hit.hit.body, inwards: hit.hit.leaving };
    Ray { origin: hit.position.as_vec3a(), direction: direction.into(), start }
}

/// All rays of the tree, however many.
pub(crate) fn tree(render_scene: &RenderScene, primary: Ray) -> Vec<RayRecord> {
    let cancel = AtomicBool::new(false);
    WhittedIntegrator::new(render_scene, &cancel).tree(primary, 100_000)
}

/// The rays of a tree that does not branch.
pub(crate) fn chain(render_scene: &RenderScene, primary: Ray) -> Vec<RayRecord> {
    let rays = tree(render_scene, primary);
    for (index, ray) in rays.iter().enumerate().skip(1) {
        assert_eq!(ray.parent, Some(index - 1), "the path branches");
    }
    rays
}

/// The light that comes along a ray.
pub(crate) fn light_along(render_scene: &RenderScene, primary: Ray) -> Vec3 {
    tree(render_scene, primary).iter().map(|ray| ray.light).sum()
}

/// The light in the middle of the picture.
pub(crate) fn center(scene: &Scene) -> Vec3 {
    let cancel = AtomicBool::new(false);
    WhittedIntegrator::new(&render_scene(scene), &cancel).trace(DVec2::splat(0.5), DVec2::ONE).into()
}

pub(crate) fn direction(ray: &RayRecord) -> DVec3 {
    ray.ray.direction.as_dvec3()
}

// ---- pictures ----

pub(crate) fn picture(scene: &Scene, width: u32, height: u32) -> Picture {
    let settings = RenderSettings { width, height, samples: 1 };
    render(&render_scene(scene), settings, &RenderControl::default()).unwrap().picture
}

/// Asserts that at most `share` of the pixels differ by more than 1/255 in linear light, without clamping.
#[track_caller]
pub(crate) fn assert_same_picture(a: &Picture, b: &Picture, share: f64) {
    let comparison = catoptric_picture::Comparison { clamp: false, ..Default::default() };
    let Difference { above, share_above, max, worst, .. } = comparison.compare(a, b).unwrap();
    assert!(
        share_above <= share,
        "{above} pixels ({:.3} %) are off, the worst at {worst:?} by {max}",
        100.0 * share_above
    );
}

// ---- numbers ----

#[track_caller]
pub(crate) fn assert_close(actual: f64, expected: f64, tolerance: f64) {
    let error = (actual - expected).abs();
    assert!(error <= tolerance, "{actual} instead of {expected}: off by {error:e}, allowed {tolerance:e}");
}

#[track_caller]
pub(crate) fn assert_vec_close(actual: DVec3, expected: DVec3, tolerance: f64) {
    let error = (actual - expected).length();
    assert!(error <= tolerance, "{actual} instead of {expected}: off by {error:e}, allowed {tolerance:e}");
}

#[track_caller]
pub(crate) fn assert_light(actual: Vec3, expected: [f64; 3]) {
    let expected = DVec3::from_array(expected);
    assert_vec_close(actual.as_dvec3(), expected, 1e-5 * expected.length().max(1e-3));
}
