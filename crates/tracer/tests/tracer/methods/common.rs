//! Short ways to build scenes and to draw them.

use catoptric_picture::{Comparison, Picture};
use catoptric_scene::{
    Anchor, Body, Camera, Color, Environment, Light, Material, MaterialChoice, Phong, Placement, Projection,
    Scene, Shape, SolidTexture, Tracing,
};
use catoptric_tracer::raster::{Method, MethodOutput, draw};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use glam::DVec3;

pub(crate) fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

pub(crate) fn body(shape: Shape, position: DVec3, material: impl Into<Material>) -> Body {
    turned(shape, position, DVec3::ZERO, material)
}

pub(crate) fn turned(
    shape: Shape,
    position: DVec3,
    rotation_degrees: DVec3,
    material: impl Into<Material>,
) -> Body {
    Body {
        shape,
        placement: Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE },
        material: MaterialChoice::own(material),
        ..Body::default()
    }
}

pub(crate) fn ball(radius: f64, position: DVec3, material: impl Into<Material>) -> Body {
    body(Shape::Sphere { radius }, position, material)
}

pub(crate) fn block(size: DVec3, position: DVec3, material: impl Into<Material>) -> Body {
    body(Shape::Cube { size }, position, material)
}

pub(crate) fn mirror() -> Phong {
    Phong { ambient: 0.0, diffuse: 0.0, reflection: Some(1.0), ..Phong::default() }
}

pub(crate) fn glow(r: f64, g: f64, b: f64) -> Phong {
    Phong { pattern: Color::new(r, g, b).into(), ambient: 1.0, diffuse: 0.0, ..Phong::default() }
}

pub(crate) fn chalk(r: f64, g: f64, b: f64) -> Phong {
    Phong { pattern: Color::new(r, g, b).into(), ambient: 0.1, diffuse: 0.8, ..Phong::default() }
}

/// A material with a second color.
pub(crate) fn checkered(mut phong: Phong, checker: SolidTexture) -> Phong {
    phong.pattern.solid = Some(checker);
    phong
}

pub(crate) fn glossy() -> Phong {
    Phong {
        pattern: Color::new(0.8, 0.3, 0.2).into(),
        ambient: 0.1,
        diffuse: 0.7,
        specular: 0.6,
        shininess: 40.0,
        reflection: Some(0.0),
        ..Phong::default()
    }
}

pub(crate) fn camera(position: DVec3, target: DVec3, fov_degrees: f64) -> Camera {
    Camera { position, target, up: DVec3::Y, projection: Projection::Perspective { fov_degrees } }
}

pub(crate) fn light(position: DVec3, intensity: f64) -> Light {
    Light { position, intensity, ..Light::default() }
}

pub(crate) fn scene(bodies: Vec<Body>, camera: Camera, lights: Vec<Light>) -> Scene {
    Scene {
        environment: Environment {
            background: Color::new(0.2, 0.3, 0.5),
            ambient: Color::WHITE,
            ..Environment::default()
        },
        tracing: Tracing { generations: 4, threshold: 0.0 },
        bodies: bodies.into(),
        camera,
        lights,
        ..Scene::default()
    }
}

pub(crate) fn render_scene(scene: &Scene) -> RenderScene {
    RenderScene::build(scene).unwrap()
}

pub(crate) fn size(width: u32, height: u32) -> RenderSettings {
    RenderSettings { width, height, samples: 1 }
}

pub(crate) fn traced(render_scene: &RenderScene, settings: RenderSettings) -> Picture {
    render(render_scene, settings, &RenderControl::default()).unwrap().picture
}

pub(crate) fn drawn(render_scene: &RenderScene, method: Method, settings: RenderSettings) -> MethodOutput {
    draw(render_scene, &method, settings, &RenderControl::default()).unwrap()
}

/// The root of the mean squared difference.
pub(crate) fn rmse(a: &Picture, b: &Picture) -> f64 {
    Comparison { clamp: false, ..Comparison::default() }.compare(a, b).unwrap().rmse
}

/// Whether a channel differs by more than `bound`.
pub(crate) fn differs(a: &[f32; 3], b: &[f32; 3], bound: f32) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > bound)
}

/// For each pixel, the place in the scene of the body it shows.
pub(crate) fn bodies_seen(render_scene: &RenderScene, settings: RenderSettings) -> Vec<Option<usize>> {
    let size = glam::DVec2::new(f64::from(settings.width), f64::from(settings.height));
    let pixels = (0..settings.height).flat_map(|y| (0..settings.width).map(move |x| (x, y)));
    let center = |(x, y)| glam::DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
    pixels
        .map(|pixel| {
            render_scene.closest_hit(&render_scene.camera().ray(center(pixel), size)).map(|hit| hit.body)
        })
        .collect()
}
