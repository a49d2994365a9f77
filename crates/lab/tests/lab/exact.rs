//! The laws of optics against each other, and the tracer against them.

use std::f64::consts::TAU;

use catoptric_lab::exact::{
    ExactAnswer, alhazen, answers, answers_for, ball_crossing, ball_focal_length, mirrored, ring_of_images,
    sphere_image, to_json, to_text,
};
use catoptric_scene::{Example, Scene};
use glam::DVec3;
use proptest::prelude::*;

use crate::scenes::{any_scene, cases};

fn example(name: &str) -> Scene {
    Example::find(name).unwrap().load().unwrap().scene
}

#[test]
fn two_mirrors_at_a_whole_part_of_the_circle_have_one_image_less() {
    for parts in 2..=24_u32 {
        let angle = TAU / f64::from(parts);
        let normals =
            [DVec3::Z, DVec3::new(angle.sin(), 0.0, -angle.cos())].map(|normal| (DVec3::ZERO, normal));
        for share in [0.3, 0.5, 0.71] {
            let at = share * angle;
            let object = DVec3::new(at.cos(), 0.4, at.sin());
            let images = ring_of_images(object, normals, 100);
            let is_regular = parts % 2 == 0 || share == 0.5;
            let wanted = if is_regular { parts - 1 } else { parts };
            assert_eq!(images.len() as u32, wanted, "{parts} parts, {share}");
            for (image, _) in &images {
                assert!((image.length() - object.length()).abs() < 1e-12, "they stand in a circle");
            }
        }
    }
    // Face to face there is no end.
    let walls = [(DVec3::NEG_X, DVec3::X), (DVec3::X, DVec3::NEG_X)];
    assert_eq!(ring_of_images(DVec3::ZERO, walls, 50).len(), 50);
}

#[test]
fn the_mirror_equation_in_known_cases() {
    // A far object is imaged in the focus, half a radius from the center; one at the surface where it is.
    assert!((sphere_image(2.0, 1e9) - 1.0).abs() < 1e-8);
    assert_eq!(sphere_image(2.0, 2.0), 2.0);
    // In a hollow mirror the center is its own image, and what stands in the focus has none.
    assert_eq!(sphere_image(2.0, 0.0), 0.0);
    assert!(sphere_image(2.0, 1.0).is_infinite());
    assert_eq!(mirrored(DVec3::new(1.0, 2.0, 3.0), DVec3::Y, DVec3::Y), DVec3::new(1.0, 0.0, 3.0));
}

#[test]
fn a_ball_lens_in_known_cases() {
    assert_eq!(ball_focal_length(1.0, 1.5), 1.5);
    assert_eq!(ball_focal_length(1.0, 2.0), 1.0);
    for ior in [1.2, 1.5, 1.9] {
        assert!((ball_crossing(1.0, ior, 1e-5) - ball_focal_length(1.0, ior)).abs() < 1e-8);
        // Away from the axis rays cross it sooner.
        assert!(ball_crossing(1.0, ior, 0.6) < ball_crossing(1.0, ior, 0.3));
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn alhazens_point_mirrors(
        object in prop::array::uniform3(-5.0..5.0_f64),
        eye in prop::array::uniform3(-5.0..5.0_f64),
        radius in 0.01..2.0_f64,
    ) {
        let (object, eye, center) = (DVec3::from(object), DVec3::from(eye), DVec3::new(0.1, -0.2, 0.3));
        match alhazen(center, radius, object, eye) {
            Some(point) => {
                let normal = (point - center).normalize();
                prop_assert!(((point - center).length() - radius).abs() < 1e-12 * (1.0 + radius));
                let [to_object, to_eye] = [object, eye].map(|end| (end - point).normalize());
                let mirrored = 2.0 * normal.dot(to_object) * normal - to_object;
                prop_assert!((mirrored - to_eye).length() < 1e-7, "{mirrored} {to_eye}");
                prop_assert!(normal.dot(to_object) > 0.0);
            }
            None => {
                let way = eye - object;
                let nearest = (center - object).dot(way) / way.length_squared();
                let distance = (object + nearest.clamp(0.0, 1.0) * way).distance(center);
                prop_assert!(distance <= radius, "nothing hides it");
            }
        }
    }

    #[test]
    fn no_scene_is_too_odd_for_an_answer(scene in any_scene()) {
        let found = answers(&scene);
        prop_assert!(!to_text(&found).is_empty());
        prop_assert!(to_json(&found)["answers"].is_array());
        for answer in &found.answers {
            if let ExactAnswer::PlaneImage { image, .. } = answer {
                prop_assert!(image.difference().unwrap() < 2e-3, "{answer:?}");
            }
            if let ExactAnswer::Highlight { off: Some(off), .. } = answer {
                prop_assert!(*off < 1e-4, "{answer:?}");
            }
        }
    }
}

#[test]
fn the_tracer_agrees_with_the_laws_in_the_examples() {
    let mut seen = [0; 6];
    for name in ["ring-of-images", "concave-mirror", "lens", "whitted", "hall-of-mirrors"] {
        for answer in &answers(&example(name)).answers {
            let near = |difference: Option<f64>, most: f64| {
                assert!(difference.is_none_or(|difference| difference < most), "{name}: {answer:?}");
            };
            let kind = match answer {
                ExactAnswer::PlaneImage { image, .. } => {
                    near(image.difference(), 1e-4);
                    0
                }
                ExactAnswer::Ring { images, angle, .. } => {
                    images.iter().for_each(|image| near(image.miss, 1e-5));
                    if name == "ring-of-images" {
                        assert!((angle.to_degrees() - 60.0).abs() < 1e-3 && images.len() == 5);
                    }
                    1
                }
                ExactAnswer::SphereImage { image, .. } => {
                    near(image.difference(), 1e-3);
                    2
                }
                ExactAnswer::ReflectionPoint { point, .. } => {
                    near(point.difference(), 1e-5);
                    3
                }
                ExactAnswer::Focus { paraxial, marginal, .. } => {
                    near(paraxial.difference(), 3e-4);
                    near(marginal.difference(), 1e-5);
                    4
                }
                ExactAnswer::Highlight { off, .. } => {
                    near(*off, 1e-5);
                    5
                }
            };
            seen[kind] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}

#[test]
fn one_body_can_be_asked_for() {
    let scene = example("ring-of-images");
    let cone = scene.bodies.iter().position(|body| body.name == "cone").unwrap();
    let found = answers_for(&scene, Some(cone));
    assert!(!found.answers.is_empty());
    for answer in &found.answers {
        match answer {
            ExactAnswer::PlaneImage { body, .. } | ExactAnswer::Ring { body, .. } => assert_eq!(*body, cone),
            other => panic!("{other:?}"),
        }
    }
    assert!(to_text(&found).contains("5 images of \"cone\" between \"left mirror\" and \"right mirror\""));
}
