//! New things appear in view, clear of others, at a size that suits the picture.

use catoptric_editor::bounds;
use catoptric_scene::{Body, Placement, ScenePart, Shape, ShapeKind};
use catoptric_studio::{AddCommand, StartDocument};

use super::*;
use crate::kit::{TestHost, studio_with};

const SHAPES: [ShapeKind; 5] =
    [ShapeKind::Sphere, ShapeKind::Cube, ShapeKind::Cylinder, ShapeKind::Cone, ShapeKind::Paraboloid];

impl Hand {
    fn on(start: StartDocument) -> Self {
        let mut harness = studio_with(TestHost::new(), start);
        harness.run_steps(2);
        let mut hand = Self { harness, pos: Pos2::ZERO, modifiers: Modifiers::NONE };
        hand.settle();
        hand
    }

    fn example(name: &str) -> Self {
        Self::on(StartDocument::Example(name.to_owned()))
    }

    /// Where a point is in the window, if it is in the picture.
    fn seen(&self, point: DVec3) -> Option<Pos2> {
        let studio = self.harness.state();
        let (_, render_scene) = studio.live().render_scene().unwrap();
        let rect = studio.viewport_rect().unwrap();
        let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        let (at, _) =
            render_scene.camera_for(&studio.live().latest().unwrap().camera).project(point, size)?;
        let pos = rect.min + Vec2::new(at.x as f32, at.y as f32);
        rect.contains(pos).then_some(pos)
    }

    /// Asserts that the body added last is whole in the picture, hidden by nothing in its middle, of a size that can be
    /// seen, and inside no other.
    #[track_caller]
    fn assert_added_well(&self, of: &str) {
        let scene = self.scene();
        let index = scene.bodies.len() - 1;
        let body = &scene.bodies[index];
        let own = bounds::of_body(body).unwrap();
        let corners = (0..8).map(|corner| {
            let part = |bit: usize| f64::from(u8::from(corner & (1 << bit) != 0));
            self.seen(own.min + own.size() * DVec3::new(part(0), part(1), part(2)))
        });
        let corners: Option<Vec<Pos2>> = corners.collect();
        let corners = corners.unwrap_or_else(|| panic!("{of}: {own:?} is out of the picture"));
        let [least, most] =
            [f32::min, f32::max].map(|pick| corners.iter().map(|at| at.y).reduce(pick).unwrap());
        assert!(most - least > 10.0, "{of}: {} points high", most - least);
        assert_eq!(self.selected(), [ScenePart::Body(index)], "{of}");
        let eye = self.harness.state().live().latest().unwrap().camera.position;
        let others =
            scene.bodies.iter().take(index).filter(|other| !other.hidden && other.shape != Shape::Plane);
        for other in others {
            let around = bounds::of_body(other).unwrap();
            let is_room = eye.cmpgt(around.min).all() && eye.cmplt(around.max).all();
            assert!(is_room || bounds::are_apart(body, other), "{of}: inside {}", other.name);
        }
        let studio = self.harness.state();
        let (_, render_scene) = studio.live().render_scene().unwrap();
        let rect = studio.viewport_rect().unwrap();
        let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        let camera = render_scene.camera_for(&studio.live().latest().unwrap().camera);
        let (at, _) = camera.project(own.center(), size).unwrap();
        assert_eq!(
            render_scene.closest_hit(&camera.ray(at, size)).map(|hit| hit.body),
            Some(index),
            "{of} is hidden"
        );
    }
}

#[test]
fn four_bodies_and_a_light_are_seen_in_every_kind_of_scene() {
    for name in ["four-bodies", "whitted", "sky-room", "mirror-box", "prism", "still-life", "wada-basins"] {
        let mut hand = Hand::example(name);
        for shape in SHAPES {
            hand.run(AddCommand::Body(shape));
            hand.assert_added_well(&format!("{name}, {shape:?}"));
        }
        hand.run(AddCommand::Light);
        let light = hand.scene().lights.last().unwrap().position;
        assert!(hand.seen(light).is_some(), "{name}: the light at {light} is out of view");
        hand.undo();
        assert_eq!(hand.selected().len(), 1, "{name}");
    }
}

#[test]
fn sizes_suit_scenes_of_any_scale() {
    for scale in [1e-3, 1.0, 1e5] {
        let mut hand = Hand::new();
        let editor = hand.harness.state_mut().editor_mut();
        let mut scene = Scene::default();
        let camera = &mut scene.camera;
        (camera.position, camera.target) = (scale * camera.position, scale * camera.target);
        scene.bodies.push(Body {
            shape: Shape::Plane,
            placement: Placement::at(DVec3::ZERO),
            ..Body::default()
        });
        *editor = catoptric_editor::Editor::new(scene).succeeding(editor);
        hand.harness.run_steps(3);
        hand.settle();
        for shape in SHAPES {
            hand.run(AddCommand::Body(shape));
            hand.assert_added_well(&format!("{scale}, {shape:?}"));
            let size = bounds::of_body(hand.scene().bodies.last().unwrap()).unwrap().size().max_element();
            assert!(size > 0.2 * scale && size < 3.0 * scale, "{scale}, {shape:?}: {size}");
        }
    }
}

#[test]
fn a_body_stands_on_the_top_that_the_middle_shows() {
    let mut hand = Hand::new();
    let editor = hand.harness.state_mut().editor_mut();
    let table = Body {
        shape: Shape::Cube { size: DVec3::new(8.0, 0.5, 8.0) },
        placement: Placement::at(DVec3::Y * 0.6),
        ..Body::default()
    };
    let mut scene = Scene { bodies: [table].into(), ..Scene::default() };
    scene.camera.target = DVec3::Y * 0.85;
    *editor = catoptric_editor::Editor::new(scene).succeeding(editor);
    hand.harness.run_steps(3);
    hand.settle();
    hand.run(AddCommand::Body(ShapeKind::Sphere));
    let bounds = bounds::of_body(&hand.scene().bodies[1]).unwrap();
    assert!((bounds.min.y - 0.85).abs() < 1e-9, "{bounds:?}");
}

#[test]
fn a_second_plane_is_a_wall_in_view() {
    let mut hand = Hand::new();
    hand.run(AddCommand::Body(ShapeKind::Plane));
    let scene = hand.scene();
    let wall = scene.bodies.last().unwrap();
    let frame = wall.placement.world_from_body();
    let (origin, normal) = (frame.translation, frame.matrix3.y_axis);
    assert!(normal.y.abs() < 1e-9, "{normal}");
    assert!(normal.dot(scene.camera.position - origin) > 0.0, "it faces the eye");
    for light in &scene.lights {
        assert!(normal.dot(light.position - origin) > 0.0, "{} is behind the wall", light.name);
    }
    let index = scene.bodies.len() - 1;
    let studio = hand.harness.state();
    let (_, render_scene) = studio.live().render_scene().unwrap();
    let camera = render_scene.camera_for(&scene.camera);
    let size = DVec2::new(100.0, 100.0);
    let is_seen = (0..100).any(|row| {
        let hit = render_scene.closest_hit(&camera.ray(DVec2::new(50.0, f64::from(row)), size));
        hit.is_some_and(|hit| hit.body == index)
    });
    assert!(is_seen);
}

#[test]
fn an_arrow_at_the_edge_leads_to_a_light_out_of_view() {
    let mut hand = Hand::new();
    let studio = hand.harness.state();
    let light = studio.editor().scene().lights[0].position;
    assert_eq!(hand.seen(light), None);
    let (_, render_scene) = studio.live().render_scene().unwrap();
    let rect = studio.viewport_rect().unwrap();
    let camera = studio.live().latest().unwrap().camera;
    let [right, up, _] = render_scene.camera_for(&camera).axes();
    let offset = light - camera.position;
    let direction = Vec2::new(offset.dot(right) as f32, -offset.dot(up) as f32).normalized();
    // Somewhere on the line from the middle to the edge.
    let mut steps = (10..rect.width() as i32).step_by(6).map(|step| rect.center() + step as f32 * direction);
    let found = steps.find(|pos| {
        if rect.contains(*pos) {
            hand.select(&[]);
            hand.click(*pos);
            hand.harness.step();
        }
        hand.selected() == [ScenePart::Light(0)]
    });
    let found = found.expect("an arrow on the way");
    // At the top, the bar over the picture takes 20 points more.
    let inner = rect.shrink(70.0).with_min_y(rect.top() + 90.0);
    assert!(!inner.contains(found), "{found:?} is not at the edge of {rect:?}");
}
