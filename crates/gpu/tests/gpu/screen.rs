//! What a card develops is what the processor does.

use std::sync::Arc;

use catoptric_gpu::{GpuFilm, GpuScene, GpuScreen, wait};
use catoptric_picture::{Development, ToneCurve};
use catoptric_tracer::RenderControl;

use crate::common::{card, reference, stage_of};

#[test]
fn a_developed_film_has_the_codes_of_the_processor() {
    let Some(gpu) = card("a_developed_film_has_the_codes_of_the_processor") else { return };
    let render_scene = stage_of(&reference("whitted"));
    let mut on_card = wait(GpuScene::new(&gpu)).unwrap();
    wait(on_card.follow(&gpu, &render_scene, render_scene.camera())).unwrap();
    let mut film = wait(GpuFilm::new(&gpu, 150, 70)).unwrap();
    wait(film.add_samples(
        &gpu,
        (&render_scene, &on_card),
        render_scene.camera(),
        1,
        &RenderControl::default(),
    ))
    .unwrap();
    let light = wait(film.picture(&gpu)).unwrap();
    let mut screen = wait(GpuScreen::new(&gpu)).unwrap();
    for tone_curve in ToneCurve::ALL {
        for exposure_stops in [0.0, 1.5, -3.0] {
            let development = Development { exposure_stops, tone_curve };
            let mut expected = vec![[0; 4]; 150 * 70];
            development.develop_rgba8(light.pixels(), &mut expected);
            let picture = wait(screen.develop(&gpu, &film, &development)).unwrap();
            let found = wait(picture.read()).unwrap();
            let pairs = expected.as_flattened().iter().zip(&found);
            let apart = pairs.map(|(one, other)| one.abs_diff(*other)).filter(|apart| *apart > 0);
            let apart: Vec<u8> = apart.collect();
            assert_eq!(found.len(), 4 * 150 * 70);
            assert!(apart.len() < found.len() / 500, "{development:?}: {} codes", apart.len());
            assert!(apart.iter().all(|apart| *apart == 1), "{development:?}");
        }
    }
}

#[test]
fn a_picture_that_is_shown_is_left_alone_and_others_are_used_again() {
    let Some(gpu) = card("a_picture_that_is_shown_is_left_alone_and_others_are_used_again") else { return };
    let film = wait(GpuFilm::new(&gpu, 20, 10)).unwrap();
    let mut screen = wait(GpuScreen::new(&gpu)).unwrap();
    let mut develop = || wait(screen.develop(&gpu, &film, &Development::default())).unwrap();
    let shown = develop();
    let next = develop();
    assert!(shown.number() != next.number() && !Arc::ptr_eq(&shown, &next));
    let number = next.number();
    drop(next);
    assert_eq!(develop().number(), number);
    drop(shown);
    // Of two that are free one is kept.
    let one = develop().number();
    let other = develop().number();
    assert!(one <= 2 && other == one, "{one}, {other}");
}
