//! The ray counts of the Standard Procedural Databases (Haines 1987), published decades ago: `balls`.
//!
//! The generator's rules: 513 × 513 rays at the corners of a 512 × 512 picture, 45 degrees of view, five generations,
//! no shadow ray where the normal faces away. The spacing of rays is not stated; 2·tan(22.5°)/511 fits the published
//! counts of all its scenes best, and one 512th is up to half a percent off.

use std::sync::atomic::AtomicBool;

use catoptric_scene::{Body, Camera, Color, Falloff, Material, Phong, Projection, Scene, Tracing};
use catoptric_tracer::{RayCounts, WhittedIntegrator};
use glam::{DMat3, DQuat, DVec2, DVec3};
use rayon::prelude::*;

use crate::proof::common::{assert_close, ball, block, light, render_scene, scene, v};

/// Places of the nine balls around a ball of radius 1/2 whose own parent lies in direction -Z: three rings of three.
fn around() -> [DVec3; 9] {
    let d = 0.5_f64.sqrt();
    let first = [v(d, d, 0.0), v(d, 0.0, -d), v(0.0, d, -d)];
    // The rotation that makes the trio symmetric about Z.
    let tilt = DQuat::from_axis_angle(v(1.0, -1.0, 0.0).normalize(), (2.0 / 6.0_f64.sqrt()).asin());
    std::array::from_fn(|place| {
        let turn = DQuat::from_rotation_z((place / 3) as f64 * std::f64::consts::TAU / 3.0);
        turn * (tilt * first[place % 3])
    })
}

fn sphereflake(
    center: DVec3,
    radius: f64,
    axis: DVec3,
    depth: u32,
    material: &Material,
    bodies: &mut Vec<Body>,
) {
    bodies.push(ball(radius, center, material.clone()));
    if depth == 0 {
        return;
    }
    let turn = if axis.z >= 1.0 {
        DMat3::IDENTITY
    } else if axis.z <= -1.0 {
        DMat3::from_rotation_y(std::f64::consts::PI)
    } else {
        DMat3::from_axis_angle(DVec3::Z.cross(axis).normalize(), axis.z.acos())
    };
    for place in around() {
        let towards = turn * place;
        let child = center + radius * 4.0 / 3.0 * towards;
        sphereflake(child, radius / 3.0, towards, depth - 1, material, bodies);
    }
}

fn balls() -> Scene {
    let shiny = Material::Phong(Phong {
        pattern: Color::new(1.0, 0.9, 0.7).into(),
        diffuse: 0.5,
        specular: 0.5,
        ..Phong::default()
    });
    let floor = Material::Phong(Phong {
        pattern: Color::new(1.0, 0.75, 0.33).into(),
        diffuse: 0.8,
        ..Phong::default()
    });
    // The floor is one polygon; a sheet below it has the same upper side.
    let mut bodies = [block(v(24.0, 24.0, 1e-3), v(0.0, 0.0, -0.5005), floor)].into();
    sphereflake(DVec3::ZERO, 0.5, DVec3::Z, 4, &shiny, &mut bodies);
    let mut scene = scene(bodies);
    scene.camera = Camera {
        position: v(2.1, 1.3, 1.7),
        target: DVec3::ZERO,
        up: DVec3::Z,
        projection: Projection::Perspective { fov_degrees: 45.0 },
    };
    scene.lights = [v(4.0, 3.0, 2.0), v(1.0, -4.0, 4.0), v(-3.0, 1.0, 5.0)]
        .map(|at| light(at, 0.6, Falloff::None))
        .to_vec();
    scene.tracing = Tracing { generations: 5, threshold: 0.0 };
    scene
}

#[test]
fn the_sphereflake_is_the_published_one() {
    let bodies = balls().bodies;
    assert_eq!(bodies.len(), 7382);
    // The first lines of balls.nff.
    let expected = [
        (v(0.0, 0.0, 0.0), 0.5),
        (v(0.272166, 0.272166, 0.544331), 0.166667),
        (v(0.420314, 0.420314, 0.618405), 0.0555556),
        (v(0.470715, 0.470715, 0.598245), 0.0185185),
        (v(0.481689, 0.481689, 0.57904), 0.00617284),
        (v(0.475329, 0.45787, 0.577669), 0.00617284),
    ];
    for (body, (center, radius)) in bodies.iter().skip(1).zip(expected) {
        let catoptric_scene::Anchor::Frame { position, .. } = body.placement.anchor else { unreachable!() };
        assert!(position.distance(center) < 2e-6, "{position} instead of {center}");
        assert!(
            matches!(body.shape, catoptric_scene::Shape::Sphere { radius: r } if (r - radius).abs() < 1e-6)
        );
    }
}

#[test]
fn balls_take_the_published_number_of_rays() {
    let render_scene = render_scene(&balls());
    let cancel = AtomicBool::new(false);
    let counts = (0..513)
        .into_par_iter()
        .map(|row| {
            let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
            for column in 0..513 {
                let at = DVec2::new(f64::from(column), f64::from(row)) - 0.5;
                tracer.trace(at, DVec2::splat(511.0));
            }
            tracer.counts()
        })
        .reduce(RayCounts::default, std::ops::Add::add);
    println!("{counts:?}");
    assert_eq!((counts.primary, counts.refracted), (263_169, 0));
    // Every one of the eye's rays meets something.
    let meets = |row: u32, column: u32| {
        let at = DVec2::new(f64::from(column), f64::from(row)) - 0.5;
        render_scene.closest_hit(&render_scene.camera().ray(at, DVec2::splat(511.0))).is_some()
    };
    assert!((0..513).into_par_iter().all(|row| (0..513).all(|column| meets(row, column))));
    for (counted, published) in [(counts.reflected, 175_095), (counts.shadow, 954_368)] {
        let published = f64::from(published);
        assert_close(counted as f64, published, 0.001 * published);
    }
}
