//! Scenes that hold a bit of everything.

use catoptric_scene::{Color, Falloff, Material, Phong, Scene, Shape, Tracing};
use catoptric_tracer::RenderSettings;
use glam::DVec3;

use crate::proof::common::{ball, camera, glass, light, plane, scene, turned, v};

/// All shapes, opaque, mirroring and of glass, on a plain reflecting floor, under two lights without falloff.
pub(crate) fn gallery() -> Scene {
    let shiny = |r: f64, g: f64, b: f64| {
        Material::Phong(Phong {
            pattern: Color::new(r, g, b).into(),
            specular: 0.4,
            diffuse: 0.6,
            reflection: Some(0.35),
            ..Phong::default()
        })
    };
    let clear = Phong {
        tint: Color::new(0.9, 1.0, 0.95),
        transmission: 0.9,
        reflection: Some(0.1),
        specular: 0.3,
        ..glass(1.5)
    };
    let frustum = Shape::Cone { radius: 0.6, top_radius: 0.3, height: 1.2 };
    let mut scene = scene(vec![
        plane(DVec3::ZERO, 0.0, Material::Phong(Phong { reflection: Some(0.2), ..Phong::default() })),
        ball(0.9, v(-1.9, 0.95, -0.3), shiny(0.9, 0.2, 0.2)),
        turned(Shape::CUBE, v(0.1, 0.8, -1.6), v(10.0, 30.0, 5.0), shiny(0.2, 0.8, 0.3)),
        turned(Shape::CYLINDER, v(1.9, 0.1, -0.6), v(0.0, 0.0, 12.0), shiny(0.2, 0.4, 0.9)),
        turned(Shape::CONE, v(1.0, 0.05, 0.9), v(5.0, 0.0, -8.0), shiny(0.9, 0.8, 0.2)),
        ball(0.6, v(-0.4, 0.7, 0.9), clear.clone()),
        turned(frustum, v(-2.2, 0.03, 1.4), v(3.0, 0.0, 2.0), clear.clone()),
        turned(Shape::CUBE, v(2.2, 0.55, 1.3), v(0.0, 25.0, 0.0), clear),
    ]);
    scene.camera = camera(v(0.4, 2.4, 7.5), v(0.0, 0.8, 0.0), 34.0);
    scene.environment.background = Color::new(0.2, 0.35, 0.6);
    scene.tracing = Tracing { generations: 6, threshold: 0.0 };
    scene.lights =
        vec![light(v(-5.0, 8.0, 6.0), 0.8, Falloff::None), light(v(6.0, 5.0, 3.0), 0.4, Falloff::None)];
    scene
}

/// A picture that threads take by groups of tiles if there are many bodies.
pub(crate) const LARGE: RenderSettings = RenderSettings { width: 1100, height: 601, samples: 1 };

/// The same with so many small balls in front of it that there is a hierarchy.
pub(crate) fn crowd() -> Scene {
    let mut scene = gallery();
    let clear = Phong { transmission: 0.8, ..glass(1.3) };
    let mirror = Phong { reflection: Some(0.7), ..Phong::default() };
    scene.bodies.extend((0..96_u32).map(|k| {
        let (i, j) = (f64::from(k % 16), f64::from(k / 16));
        let material = if k % 3 == 0 { &clear } else { &mirror };
        ball(0.1, v(0.4 * i - 3.0, 0.1 + 0.3 * j, 2.2 + 0.2 * (i * j).sin()), material.clone())
    }));
    scene
}
