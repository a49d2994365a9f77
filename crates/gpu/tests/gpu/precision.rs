//! Where single precision is narrow, by answers that are known: small lights, planes seen from afar, edges of pictures.

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use catoptric_picture::Picture;
use catoptric_scene::{
    Body, Camera, Color, Image, Light, Material, MaterialChoice, Pattern, Phong, Placement, Projection,
    Scene, Shape, SolidKind, SolidTexture,
};
use glam::DVec3;

use crate::common::{card, stage_of};
use crate::parity::{compare, fault};

fn body(shape: Shape, at: DVec3, phong: Phong) -> Body {
    let material = MaterialChoice::Inline(Box::new(Material::Phong(phong)));
    Body { shape, placement: Placement::at(at), material, ..Body::default() }
}

/// A parallel view from a point to the origin.
fn parallel(position: DVec3, up: DVec3, height: f64) -> Camera {
    Camera { position, target: DVec3::ZERO, up, projection: Projection::Parallel { height } }
}

/// The width of the penumbra of an edge halfway up to a lamp of a radius of 2⋅10⁻⁴ of its distance.
#[test]
fn penumbras_on_a_card_are_as_wide_as_the_lamp_is_seen() {
    let Some(card) = card("penumbras_on_a_card_are_as_wide_as_the_lamp_is_seen") else { return };
    const RADIUS: f64 = 2e-4;
    let chalk = || Phong { ambient: 0.0, diffuse: 1.0, pattern: Color::WHITE.into(), ..Phong::default() };
    // Larger bodies beside so small a picture would be met in double precision, which a card leaves to the processor.
    let plate = Shape::Cube { size: DVec3::new(0.1, 1e-7, 0.1) };
    let mut scene = Scene {
        bodies: [body(Shape::Plane, DVec3::ZERO, chalk()), body(plate, DVec3::new(-0.05, 0.5, 0.0), chalk())]
            .into(),
        lights: vec![Light { position: DVec3::Y, radius: RADIUS, ..Light::default() }],
        ..Scene::default()
    };
    // The picture is 16:9; at the edges of its width, all or nothing of the lamp is seen.
    let width = 3.0 * RADIUS;
    scene.camera = parallel(0.2 * DVec3::Y, DVec3::NEG_Z, width * 9.0 / 16.0);
    let compared = compare(&card, &stage_of(&scene), 2);
    for (name, picture) in [("the CPU", &compared.cpu.0), ("the card", &compared.gpu.0)] {
        let columns = picture.width();
        let widths = (0..columns).map(|x| {
            let light: f64 = picture.rows().map(|row| f64::from(row[x as usize][0])).sum();
            let t = (width * ((f64::from(x) + 0.5) / f64::from(columns) - 0.5) / RADIUS).clamp(-1.0, 1.0);
            let exact = 0.5 + FRAC_1_PI * (t.asin() + t * (1.0 - t * t).sqrt());
            [light / f64::from(picture.height()), exact].map(|part| part * (1.0 - part))
        });
        let [found, exact] = widths.fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
        // The noise of two samples for each pixel is 1 %.
        assert!((found / exact - 1.0).abs() < 0.03, "{name}: {found}, not {exact}");
    }
}

/// The patterns of a plane through a camera that is far away, and far from the middle of rings; and a highlight there that
/// is narrower than a cosine in single precision can tell.
#[test]
fn planes_far_away_are_those_of_the_cpu() {
    let Some(card) = card("planes_far_away_are_those_of_the_cpu") else { return };
    for (kind, far) in [(SolidKind::Rings, 3e7), (SolidKind::Checker, 0.0)] {
        let solid = SolidTexture { size: 0.3, ..SolidTexture::new(kind, Color::new(0.1, 0.2, 0.6)) };
        let pattern = Pattern { solid: Some(solid), ..Pattern::default() };
        let mirror = Phong { specular: 0.8, shininess: 1e6, pattern, ..Phong::default() };
        let target = DVec3::new(far, 0.0, -0.7 * far);
        let toward = DVec3::new(0.3, 1.0, 0.8).normalize();
        let mut scene = Scene {
            bodies: [body(Shape::Plane, DVec3::ZERO, mirror)].into(),
            lights: vec![Light {
                position: target + 1e3 * DVec3::new(-toward.x, toward.y, -toward.z),
                ..Light::default()
            }],
            ..Scene::default()
        };
        let projection = Projection::Parallel { height: 4.0 };
        scene.camera = Camera { position: target + 1e7 * toward, target, up: DVec3::Y, projection };
        let compared = compare(&card, &stage_of(&scene), 1);
        assert_eq!(fault(&format!("a plane far away, {kind:?}"), &compared), None);
        let pixels = compared.gpu.0.pixels();
        assert!(pixels.iter().any(|pixel| pixel[0] > 0.9), "{kind:?}: the highlight is in view");
    }
}

/// A coarse picture on a plane goes on over its edges, both ways.
#[test]
fn a_picture_on_a_plane_has_no_seams_on_a_card() {
    let Some(card) = card("a_picture_on_a_plane_has_no_seams_on_a_card") else { return };
    let rows = [[0.0, 1.0], [0.5, 0.25], [1.0, 0.75]];
    let picture = Picture::from_fn(2, 3, |x, y| [rows[y as usize][x as usize]; 3]).unwrap();
    let texture = Some(Image::with_pixels("coarse", Arc::new(picture)));
    let pattern = Pattern { texture, ..Pattern::default() };
    let floor = Phong { ambient: 1.0, diffuse: 0.0, pattern, ..Phong::default() };
    let mut scene = Scene { bodies: [body(Shape::Plane, DVec3::ZERO, floor)].into(), ..Scene::default() };
    scene.environment.ambient = Color::WHITE;
    scene.camera = parallel(5.0 * DVec3::Y, DVec3::NEG_Z, 2.0);
    let compared = compare(&card, &stage_of(&scene), 1);
    assert_eq!(fault("a picture on a plane", &compared), None);
    // Beside the corner of four pictures lie, by equal parts, the pixels in their corners.
    let [width, height] = [compared.gpu.0.width(), compared.gpu.0.height()];
    let middle = compared.gpu.0.pixel(width / 2, height / 2).unwrap()[0];
    let exact = 0.25 * (rows[0][0] + rows[0][1] + rows[2][0] + rows[2][1]);
    assert!((middle - exact).abs() < 0.02, "{middle}, not {exact}");
}
