//! The independent tracer without mistakes against the exact one.

use catoptric_picture::srgb;
use catoptric_scene::{FresnelTerm, Scene, read};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};

use crate::detective::scenes;
use crate::independent_tracer::{Encoding, IndependentTracer, share_of_differences};

const SIZE: [u32; 2] = [96, 54];

/// The codes of the exact tracer, row by row.
pub(crate) fn exact_codes(scene: &Scene, [width, height]: [u32; 2], encoding: Encoding) -> Vec<[u8; 3]> {
    let prepared = RenderScene::build(scene).unwrap();
    let settings = RenderSettings { width, height, samples: 1 };
    let picture = render(&prepared, settings, &RenderControl::default()).unwrap().picture;
    let code = |light: f32| {
        let light = f64::from(light).clamp(0.0, 1.0);
        let value = if encoding == Encoding::Srgb { srgb::encode(light) } else { light };
        (value * 255.0).round() as u8
    };
    picture.pixels().iter().map(|light| light.map(code)).collect()
}

#[test]
fn without_mistakes_it_draws_the_exact_picture() {
    let mut all: Vec<Scene> = scenes::scenes();
    all.extend(scenes::cases());
    // Glass weighed by the angle.
    let glass = scenes::text_of(1).replace("ior = 1.5", "ior = 1.5, fresnel = 'schlick'");
    let glass = read(&glass).into_result().unwrap().value;
    let is_weighed = |scene: &Scene| {
        let phong = |body: &catoptric_scene::Body| scene.material(&body.material)?.as_phong().cloned();
        scene.bodies.iter().filter_map(phong).any(|phong| phong.fresnel == FresnelTerm::Schlick)
    };
    assert!(is_weighed(&glass));
    all.push(glass);
    for (index, scene) in all.iter().enumerate() {
        let codes = IndependentTracer::new(scene, &[]).codes(SIZE, Encoding::Srgb);
        let share = share_of_differences(&codes, &exact_codes(scene, SIZE, Encoding::Srgb), 1);
        // Cells of a checker near the horizon are narrower than a pixel: rounding decides some.
        assert!(share <= 0.002, "{index}: {share}");
    }
}
