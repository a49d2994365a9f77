//! The angle under which the point under the pointer is seen, told beside the curve of its material.

use catoptric_editor::{Action, Label};
use catoptric_scene::{
    Conductor, Dielectric, Material, MaterialChoice, MetalOptics, RefractiveIndex, ScenePart,
};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::*;

impl Hand {
    /// Over a sphere of this material, which is selected.
    fn over(material: Material) -> Self {
        let mut hand = Self::new();
        hand.select(&[ScenePart::Body(SPHERE)]);
        let choice = MaterialChoice::Inline(Box::new(material));
        hand.harness.state_mut().editor_mut().apply(Action::AssignMaterial(choice)).unwrap();
        hand.settle();
        hand
    }

    /// What is told of the point under the pointer.
    fn told(&mut self) -> Option<String> {
        self.harness.run_steps(2);
        let node = self.harness.query_by_label_contains("Under the pointer")?;
        let node = node.accesskit_node();
        node.label().or_else(|| node.value())
    }
}

fn glass() -> Material {
    Material::Dielectric(Dielectric { index: 1.5.into(), ..Dielectric::default() })
}

#[test]
fn the_middle_of_a_ball_is_seen_straight_and_its_rim_under_a_right_angle() {
    let mut hand = Hand::over(glass());
    let middle = hand.place(position(hand.scene(), SPHERE));
    assert_eq!(hand.told(), None);
    hand.go(middle);
    let straight = "Under the pointer θ = 0.0°: reflects 0.04 of red, green and blue alike.";
    assert_eq!(hand.told().as_deref(), Some(straight));
    // A point of the surface towards the eye and 30° to the side.
    let (center, camera) = (position(hand.scene(), SPHERE), hand.scene().camera);
    let out = (camera.position - center).normalize();
    let side = out.any_orthonormal_vector();
    for angle in [30.0_f64, 60.0] {
        let normal = out * angle.to_radians().cos() + side * angle.to_radians().sin();
        let point = center + normal;
        let seen = (camera.position - point).normalize().dot(normal).acos().to_degrees();
        hand.go(hand.place(point));
        let told = hand.told().unwrap();
        let number = told.split(['=', '°']).nth(1).unwrap().trim();
        assert!((number.parse::<f64>().unwrap() - seen).abs() < 0.15, "{told}: {seen}");
    }
    // Another body, and nothing at all.
    hand.go(hand.place(position(hand.scene(), CUBE)));
    assert_eq!(hand.told(), None);
    hand.go(middle);
    assert!(hand.told().is_some());
    hand.go(Pos2::new(4.0, 400.0));
    assert_eq!(hand.told(), None);
}

#[test]
fn metals_have_a_share_for_each_color_and_no_inside() {
    let conductor = MetalOptics::Index { n: DVec3::new(1.0, 2.0, 3.0), k: DVec3::new(2.0, 2.0, 2.0) };
    let mut hand = Hand::over(Material::Conductor(Conductor { metal: conductor, ..Conductor::default() }));
    hand.go(hand.place(position(hand.scene(), SPHERE)));
    // ((n − 1)² + k²) / ((n + 1)² + k²)
    let known = "Under the pointer θ = 0.0°: reflects 0.5 of red, 0.3846 of green, 0.4 of blue.";
    assert_eq!(hand.told().as_deref(), Some(known));
}

#[test]
fn colors_that_are_bent_differently_have_shares_of_their_own() {
    let mut hand = Hand::over(Material::Dielectric(Dielectric {
        index: RefractiveIndex::Own { ior: 1.5, abbe: 20.0 },
        dispersion: true,
        ..Dielectric::default()
    }));
    hand.go(hand.place(position(hand.scene(), SPHERE)));
    let told = hand.told().unwrap();
    let shares: Vec<f64> = told.split(' ').filter_map(|word| word.parse().ok()).collect();
    let [red, green, blue] = shares[..] else { panic!("{told}") };
    assert!(red < 0.04 && 0.04 < green && green < blue && blue < 0.05, "{told}");
}

#[test]
fn within_a_glass_the_side_towards_the_eye_counts() {
    let mut hand = Hand::over(glass());
    let center = position(hand.scene(), SPHERE);
    let editor = hand.harness.state_mut().editor_mut();
    editor
        .change(Label::new("edit-view", ""), |scene| {
            scene.camera.position = center;
            scene.camera.target = center + DVec3::new(0.0, 0.3, -1.0);
        })
        .unwrap();
    editor.settle();
    hand.settle();
    let rect = hand.harness.state().viewport_rect().unwrap();
    hand.go(rect.center() + Vec2::new(60.0, 80.0));
    let known = "Under the pointer, from within, θ = 0.0°: reflects 0.04 of red, green and blue alike.";
    assert_eq!(hand.told().as_deref(), Some(known));
}
