//! Surfaces that coincide: the body that comes first in the scene is seen, in every pixel.

use catoptric_scene::{Anchor, Body, Color, Placement, Scene, Shape};
use glam::{DMat3, DVec2, DVec3};

use crate::proof::common::*;

const SIZE: (u32, u32) = (240, 180);

/// A rigid motion with an even scale.
#[derive(Clone, Copy)]
struct Motion {
    turn_degrees: DVec3,
    scale: f64,
    offset: DVec3,
}

impl Motion {
    fn turn(&self) -> DMat3 {
        let [x, y, z] = self.turn_degrees.to_array().map(f64::to_radians);
        DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
    }

    fn point(&self, point: DVec3) -> DVec3 {
        self.turn() * (self.scale * point) + self.offset
    }

    fn inverse(&self, point: DVec3) -> DVec3 {
        self.turn().transpose() * (point - self.offset) / self.scale
    }

    fn body(&self, shape: Shape, position: DVec3, color: Color) -> Body {
        let anchor = Anchor::Frame { position: self.point(position), rotation_degrees: self.turn_degrees };
        placed(shape, Placement { anchor, scale: DVec3::splat(self.scale) }, glow(color))
    }
}

fn motions() -> Vec<Motion> {
    let motion = |turn_degrees, scale, offset| Motion { turn_degrees, scale, offset };
    vec![
        motion(DVec3::ZERO, 1.0, DVec3::ZERO),
        motion(v(0.0, 30.0, 0.0), 1.0, v(0.1, -0.3, 0.2)),
        motion(v(17.0, -42.0, 11.0), 1.0, v(7.3, 2.1, -5.9)),
        motion(v(-61.0, 12.0, 140.0), 0.01, v(0.7, 0.1, 0.3)),
        motion(v(5.0, 77.0, -9.0), 1000.0, v(-300.0, 9000.0, 1234.5)),
    ]
}

/// Two bodies, and whether a point of both surfaces lies where they coincide.
struct Pair {
    one: (Shape, DVec3),
    other: (Shape, DVec3),
    coincide: fn(DVec3) -> bool,
}

fn pairs() -> Vec<Pair> {
    let pair = |one, other, coincide| Pair { one, other, coincide };
    let cylinder = Shape::Cylinder { radius: 0.7, height: 0.9 };
    let frustum = Shape::Cone { radius: 0.5, top_radius: 0.9, height: 0.9 };
    let block = |x: f64, y: f64, z: f64| Shape::Cube { size: v(x, y, z) };
    let under = v(0.1, -0.9, 0.2);
    vec![
        // Flush with the floor.
        pair((cylinder, under), (Shape::Plane, DVec3::ZERO), |p| {
            p.y.abs() < 1e-3 && (p - v(0.1, 0.0, 0.2)).length() < 0.699
        }),
        pair((block(1.3, 1.0, 0.8), v(0.2, -0.5, 0.1)), (Shape::Plane, DVec3::ZERO), |p| {
            p.y.abs() < 1e-3 && (p.x - 0.2).abs() < 0.649 && (p.z - 0.1).abs() < 0.399
        }),
        pair((frustum, under), (Shape::Plane, DVec3::ZERO), |p| {
            p.y.abs() < 1e-3 && (p - v(0.1, 0.0, 0.2)).length() < 0.899
        }),
        // A cap in the face of a block, and one block in another.
        pair((cylinder, v(0.1, 0.1, 0.2)), (block(3.0, 2.0, 3.0), DVec3::ZERO), |p| {
            (p.y - 1.0).abs() < 1e-3 && (p - v(0.1, 1.0, 0.2)).length() < 0.699
        }),
        pair((block(1.0, 1.0, 1.0), v(0.5, 0.5, 0.5)), (block(2.0, 2.0, 2.0), DVec3::ZERO), |p| {
            let within = |a: f64, b: f64| a > 1e-3 && b > 1e-3;
            let on = |a: f64| (a - 1.0).abs() < 1e-3;
            on(p.x) && within(p.y, p.z) || on(p.y) && within(p.x, p.z) || on(p.z) && within(p.x, p.y)
        }),
        // Curved surfaces in one another.
        pair(
            (cylinder, DVec3::ZERO),
            (Shape::Cylinder { radius: 0.7, height: 2.0 }, v(0.0, -0.5, 0.0)),
            |p| p.y > 1e-3 && p.y < 0.899,
        ),
        pair((Shape::SPHERE, v(0.2, 0.3, 0.1)), (Shape::SPHERE, v(0.2, 0.3, 0.1)), |_| true),
    ]
}

fn scene_of(bodies: Vec<Body>, motion: &Motion) -> Scene {
    Scene {
        camera: catoptric_scene::Camera {
            up: motion.turn() * DVec3::Y,
            ..camera(motion.point(v(3.0, 2.5, 5.0)), motion.point(v(0.0, 0.3, 0.0)), 35.0)
        },
        ..scene(bodies)
    }
}

/// Every pixel of a pair shows the first body where both surfaces are; how many do.
fn check(pair: &Pair, motion: &Motion, swapped: bool, more: &[Body]) -> usize {
    let colors = [Color::new(1.0, 0.0, 0.0), Color::new(0.0, 1.0, 0.0)];
    let mut bodies = vec![
        motion.body(pair.one.0, pair.one.1, colors[0]),
        motion.body(pair.other.0, pair.other.1, colors[1]),
    ];
    if swapped {
        bodies.swap(0, 1);
    }
    bodies.extend(more.iter().cloned());
    let scene = scene_of(bodies, motion);
    let render_scene = render_scene(&scene);
    let picture = picture(&scene, SIZE.0, SIZE.1);
    let size = DVec2::new(f64::from(SIZE.0), f64::from(SIZE.1));
    let expected = colors[usize::from(swapped)].to_array().map(|part| part as f32);
    let mut count = 0;
    for (x, y) in (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y))) {
        let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let Some(hit) = render_scene.closest_hit(&render_scene.camera().ray(at, size)) else { continue };
        if hit.body < 2 && (pair.coincide)(motion.inverse(hit.position)) {
            assert_eq!(picture.pixel(x, y), Some(expected), "at ({x}, {y})");
            assert_eq!(hit.body, 0, "at ({x}, {y})");
            count += 1;
        }
    }
    count
}

#[test]
fn of_coincident_surfaces_the_first_in_the_scene_is_seen() {
    for (number, pair) in pairs().iter().enumerate() {
        for motion in motions() {
            for swapped in [false, true] {
                let count = check(pair, &motion, swapped, &[]);
                assert!(count > 300, "pair {number}: {count} pixels");
            }
        }
    }
}

/// With a hierarchy, and with streams of rays, the rule is the same.
#[test]
fn of_coincident_surfaces_among_many_bodies_the_first_is_seen() {
    let motion = motions()[2];
    let more: Vec<Body> = (0..200)
        .map(|k| {
            let at = v(f64::from(k % 20) - 10.0, -3.0, f64::from(k / 20) - 5.0);
            motion.body(Shape::Sphere { radius: 0.2 }, at, Color::WHITE)
        })
        .collect();
    for pair in pairs().iter().filter(|pair| pair.other.0 != Shape::Plane) {
        for swapped in [false, true] {
            assert!(check(pair, &motion, swapped, &more) > 300);
        }
    }
}
