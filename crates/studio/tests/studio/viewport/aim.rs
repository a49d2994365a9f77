//! Lights that are moved by their highlights and shadows.

use super::*;
use catoptric_scene::ScenePart;
use catoptric_studio::ToolCommand;

/// How far the shadow is dragged.
const STEP: DVec3 = DVec3::new(0.4, 0.0, 0.3);

impl Hand {
    /// The point of the body that is seen at a place of the window, its normal, and the way of the eye's ray there.
    fn surface(&self, pos: Pos2) -> (usize, DVec3, DVec3, DVec3) {
        let studio = self.harness.state();
        let (_, render_scene) = studio.live().render_scene().unwrap();
        let rect = studio.viewport_rect().unwrap();
        let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        let at = DVec2::new(f64::from(pos.x - rect.min.x), f64::from(pos.y - rect.min.y));
        let ray = render_scene.camera_for(&studio.live().latest().unwrap().camera).ray(at, size);
        let hit = render_scene.closest_hit(&ray).unwrap();
        (hit.body, hit.position, hit.normal.as_dvec3(), ray.direction.as_dvec3())
    }

    fn light(&self) -> DVec3 {
        self.scene().lights[0].position
    }

    /// Asserts that the eye's ray at a place, mirrored by the surface there, goes to the light.
    #[track_caller]
    fn assert_highlight_at(&self, pos: Pos2) {
        let (_, point, normal, incoming) = self.surface(pos);
        let mirrored = incoming.reflect(normal);
        let angle = mirrored.angle_between(self.light() - point).to_degrees();
        assert!(angle < 0.1, "{angle} degrees beside the light at {}", self.light());
    }
}

#[test]
fn the_highlight_follows_the_pointer() {
    let mut hand = Hand::new();
    hand.run(ToolCommand::AimLight);
    let before = hand.scene().clone();
    let center = position(&before, SPHERE);
    let [from, to] =
        [DVec3::new(0.2, 0.3, 0.5), DVec3::new(-0.4, 0.5, 0.5)].map(|way| hand.place(center + way));
    hand.drag(from, to);
    hand.assert_highlight_at(to);
    assert_eq!(hand.selected(), [ScenePart::Light(0)]);
    assert_eq!(hand.steps(), 1);
    // A click does it, too, on any body.
    let on_cube = hand.place(position(&before, CUBE) + DVec3::new(0.0, 0.1, 0.0));
    hand.click(on_cube);
    hand.settle();
    hand.assert_highlight_at(on_cube);
    hand.undo();
    hand.undo();
    assert_same(hand.scene(), &before);
}

#[test]
fn a_shadow_is_dragged_by_the_point_that_casts_it() {
    let mut hand = Hand::new();
    hand.run(ToolCommand::AimLight);
    let before = hand.scene().clone();
    let light = hand.light();
    let ground = |through: DVec3| light + (through - light) * (light.y / (light.y - through.y));
    // A point of a body whose shadow on the floor is seen.
    let points = [SPHERE, CUBE, CYLINDER, CONE].into_iter().flat_map(|body| {
        let middle = position(&before, body);
        (0..40).map(move |step| middle + DVec3::Y * (1.2 - 0.05 * f64::from(step)))
    });
    let (occluder, shadow) = points
        .filter(|point| point.y > 0.1)
        .find_map(|point| {
            let shadow = ground(point);
            let studio = hand.harness.state();
            let (_, render_scene) = studio.live().render_scene().unwrap();
            let ray = render_scene.ray_from_point(light, (shadow - light).normalize().as_vec3());
            let hit = render_scene.closest_hit(&ray).filter(|hit| hit.body != FLOOR)?;
            let is_seen = |at: DVec3| hand.surface(hand.place(at)).0 == FLOOR;
            (is_seen(shadow) && is_seen(shadow + STEP)).then_some((hit.position, shadow))
        })
        .expect("a shadow that is seen");
    let (from, to) = (hand.place(shadow), hand.place(shadow + STEP));
    hand.drag(from, to);
    let (body, point, ..) = hand.surface(to);
    assert_eq!(body, FLOOR);
    let now = hand.light();
    assert!((now - light).length() > 0.5, "{now}");
    let angle = (now - occluder).angle_between(occluder - point).to_degrees();
    assert!(angle < 0.2, "{angle}");
    assert!((now.distance(occluder) - light.distance(occluder)).abs() < 0.02);
    hand.undo();
    assert_same(hand.scene(), &before);
}

#[test]
fn tools_end_the_aiming_and_escape_takes_a_drag_back() {
    let mut hand = Hand::new();
    hand.run(ToolCommand::AimLight);
    let before = hand.scene().clone();
    let at = hand.place(position(&before, SPHERE));
    hand.press(at);
    hand.way(at, at + Vec2::new(20.0, -20.0));
    hand.tap(Key::Escape);
    hand.release();
    assert_same(hand.scene(), &before);
    hand.run(ToolCommand::Take(catoptric_studio::Tool::Move));
    hand.drag(at, at + Vec2::new(60.0, 0.0));
    assert_only_moved(&before, &hand.scene().clone(), &[SPHERE]);
}
