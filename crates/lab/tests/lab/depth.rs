//! How deep scenes need to be traced, against their series.

use catoptric_lab::depth::{ALLOWED_LOSS, DepthBound, DepthMeasure, ExcessKind, excess_of, excesses};
use catoptric_scene::{
    Color, Example, Image, Material, MaterialChoice, Matte, NamedMaterial, Pattern, Phong, Scene, Shape,
    SolidTexture,
};
use catoptric_tracer::{RenderControl, RenderError, RenderScene, RenderSettings, render};
use glam::{DVec3, UVec2};

use crate::scenes::{ball, body};

fn mirror(reflection: f64) -> Material {
    Material::Phong(Phong {
        pattern: Color::WHITE.into(),
        ambient: 1.0,
        diffuse: 0.0,
        reflection: Some(reflection),
        ..Phong::default()
    })
}

fn between_mirrors(first: f64, second: f64) -> Scene {
    let wall =
        |x: f64, k: f64| body(Shape::Cube { size: DVec3::new(1.0, 90.0, 90.0) }, DVec3::X * x, mirror(k));
    let mut scene =
        Scene { bodies: [wall(-2.0, first), wall(2.0, second)].into_iter().collect(), ..Scene::default() };
    scene.camera.position = DVec3::ZERO;
    scene.camera.target = DVec3::X;
    scene
}

fn bound(scene: &Scene) -> DepthBound {
    DepthBound::of(scene, &RenderScene::build(scene).unwrap())
}

fn measure(scene: &Scene) -> DepthMeasure {
    let render_scene = RenderScene::build(scene).unwrap();
    DepthMeasure::of(&render_scene, render_scene.camera(), UVec2::new(40, 30), &RenderControl::default())
        .unwrap()
}

#[test]
fn two_mirrors_are_a_series_of_their_product() {
    let scene = between_mirrors(0.5, 0.5);
    let found = bound(&scene);
    // 2⁻ᴳ/(1 − 1/2) < 1/512 from G = 11 on.
    assert_eq!((found.factor, found.cycle, found.generations), (0.5, vec![0, 1], Some(11)));
    let found = bound(&between_mirrors(0.9, 0.1));
    assert!((found.factor - 0.3).abs() < 1e-12);
    // 0.9·0.1·0.9 … : after six factors 0.09³ = 7.3e-4 of 1, and the rest of the series 1.9/0.91 times that.
    assert_eq!(found.generations, Some(6));
    assert_eq!(bound(&between_mirrors(1.0, 1.0)).generations, None);
    // One mirror alone is seen once, one around the eye again and again.
    let mut alone = between_mirrors(0.5, 0.0);
    assert_eq!(bound(&alone).generations, Some(2));
    alone.bodies = std::iter::once(ball(9.0, DVec3::ZERO, mirror(0.5))).collect();
    assert_eq!(bound(&alone).generations, Some(11));
    alone.bodies = Scene::default().bodies;
    assert_eq!((bound(&alone).factor, bound(&alone).generations), (0.0, Some(1)));
}

#[test]
fn glass_may_keep_all_light_inside() {
    let glass = Material::Phong(Phong { transmission: 0.5, reflection: Some(0.1), ..Phong::default() });
    let scene = Scene { bodies: std::iter::once(ball(1.0, DVec3::Y, glass)).collect(), ..Scene::default() };
    assert_eq!((bound(&scene).factor, bound(&scene).generations), (1.0, None));
}

#[test]
fn measured_depths_are_those_of_the_series_and_below_the_bound() {
    for k in [0.2, 0.5, 0.7] {
        let scene = between_mirrors(k, k);
        let (found, bound) = (measure(&scene), bound(&scene));
        for (limit, loss) in (1..).zip(&found.losses).take(6) {
            let rest = f64::powi(k, limit) / (1.0 - k);
            assert!((loss - rest).abs() < 2e-3, "{k}, {limit} generations: {loss}, not {rest}");
        }
        let series = (1..).find(|&limit| f64::powi(k, limit) / (1.0 - k) < ALLOWED_LOSS).unwrap() as u32;
        // Rays lighter than 2⁻¹² are not looked at.
        assert!(found.generations.abs_diff(series) <= 1, "{k}: {} and {series}", found.generations);
        assert!(found.generations <= bound.generations.unwrap());
        assert!(found.is_complete && found.pixels == 40 * 30);
    }
}

/// The advice holds for a picture: with so many generations no pixel that was tried changes by 1/512 any more.
#[test]
fn the_advice_is_enough() {
    for name in ["ring-of-images", "concave-mirror", "whitted"] {
        let scene = Example::find(name).unwrap().load().unwrap().scene;
        let found = measure(&scene);
        let render_scene = RenderScene::build(&scene).unwrap();
        let picture = |generations: u32| {
            let settings = RenderSettings { width: 40, height: 30, samples: 1 };
            let render_scene = render_scene.clone().with_generations(generations);
            render(&render_scene, settings, &RenderControl::default()).unwrap().picture
        };
        let loss = |generations: u32| {
            let (less, all) = (picture(generations), picture(40));
            let pairs = less.pixels().iter().flatten().zip(all.pixels().iter().flatten());
            pairs.map(|(less, all)| f64::from(all - less)).fold(0.0, f64::max)
        };
        assert!(loss(found.generations) < ALLOWED_LOSS + 1e-3, "{name}");
        if found.generations > 1 {
            assert!(loss(found.generations - 1) >= ALLOWED_LOSS - 1e-3, "{name}: one less would do");
        }
    }
}

#[test]
fn a_measurement_can_be_cancelled() {
    let scene = between_mirrors(0.5, 0.5);
    let render_scene = RenderScene::build(&scene).unwrap();
    let control = RenderControl::default();
    control.cancel();
    let outcome = DepthMeasure::of(&render_scene, render_scene.camera(), UVec2::new(9, 9), &control);
    assert!(matches!(outcome, Err(RenderError::Cancelled)));
}

#[test]
fn materials_that_give_more_than_they_get_are_named_with_the_number() {
    let material = Material::Phong(Phong {
        pattern: Color::new(0.5, 1.0, 0.2).into(),
        diffuse: 0.8,
        reflection: Some(0.3),
        transmission: 0.2,
        tint: Color::new(1.0, 0.5, 1.0),
        specular: 3.0,
        shininess: 1.0,
        ..Phong::default()
    });
    let found: Vec<(ExcessKind, f64)> = excess_of(&material).collect();
    let [(surface, amount), (highlight, share)] = found[..] else { panic!("{found:?}") };
    let ExcessKind::Surface { channel, diffuse, reflection, transmission } = surface else { panic!() };
    assert_eq!((channel, diffuse, reflection, transmission), (1, 0.8, 0.3, 0.1));
    assert!((amount - 1.2).abs() < 1e-12);
    assert_eq!((highlight, share), (ExcessKind::Highlight, 2.0));
    // As much as it gets is no excess, and a checker's second color counts.
    let fair =
        |pattern| Material::Phong(Phong { pattern, diffuse: 0.9, reflection: Some(0.1), ..Phong::default() });
    assert_eq!(excess_of(&fair(Color::WHITE.into())).count(), 0);
    let checker = Some(SolidTexture { color: Color::gray(1.2), size: 1.0, ..SolidTexture::default() });
    assert_eq!(excess_of(&fair(Pattern { solid: checker, ..Color::WHITE.into() })).count(), 1);
    // A color under a picture is not seen; the brightest pixel counts.
    let under = |texture| {
        let pattern = Pattern { texture, ..Color::gray(2.0).into() };
        Material::Matte(Matte { pattern, ..Matte::default() })
    };
    assert_eq!(excess_of(&under(None)).count(), 1);
    for (name, count) in [("grid", 0), ("evening", 1)] {
        let texture = Some(Image::built_in(name).unwrap());
        assert_eq!(excess_of(&under(texture)).count(), count, "{name}");
    }

    let materials = vec![NamedMaterial { name: "lamp".to_owned(), material }];
    let mut scene = Scene { materials, ..Scene::default() };
    let plain = ball(1.0, DVec3::ZERO, fair(Color::WHITE.into()));
    let mut shining = plain.clone();
    shining.material = MaterialChoice::Named("lamp".to_owned());
    scene.bodies = [plain, shining.clone(), shining].into_iter().collect();
    let found = excesses(&scene);
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|excess| excess.name.as_deref() == Some("lamp") && excess.body == Some(1)));
}

/// The energy of a highlight, by adding up the renderer's light over the half-space.
#[test]
fn the_energy_of_a_highlight_is_that_of_its_integral() {
    for shininess in [1.0, 5.0, 40.0] {
        let steps = 20_000;
        let slice = |step: i32| {
            let theta = (f64::from(step) + 0.5) / f64::from(steps) * std::f64::consts::FRAC_PI_2;
            theta.cos().powf(shininess) * theta.cos() * theta.sin()
        };
        let width = std::f64::consts::FRAC_PI_2 / f64::from(steps);
        let integral: f64 = 2.0 * std::f64::consts::PI * (0..steps).map(slice).sum::<f64>() * width;
        let specular = 10.0;
        let material = Material::Phong(Phong {
            diffuse: 0.0,
            reflection: Some(0.0),
            specular,
            shininess,
            ..Phong::default()
        });
        let wanted = specular * integral / std::f64::consts::PI;
        match excess_of(&material).next() {
            Some((ExcessKind::Highlight, share)) => assert!((share - wanted).abs() < 1e-6),
            other => assert!(wanted <= 1.0 && other.is_none(), "{shininess}: {other:?}"),
        }
    }
}
