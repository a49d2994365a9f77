//! Pictures that must not depend on where the world's origin lies, nor on how large or flat bodies are.

use catoptric_picture::Picture;
use catoptric_scene::{
    Anchor, Body, Camera, Color, Falloff, Material, MaterialChoice, Pattern, PatternSpace, Phong, Placement,
    Projection, Scene, Shape, SolidKind, SolidTexture,
};
use glam::DVec3;

use crate::proof::common::oracle::Oracle;
use crate::proof::common::*;

const SIZE: (u32, u32) = (240, 160);

/// A surface that shades, mirrors a little and has a pattern of meters.
fn ground() -> Phong {
    let checker = SolidTexture {
        color: Color::new(0.2, 0.3, 0.5),
        size: 1.0,
        space: PatternSpace::World,
        ..SolidTexture::default()
    };
    Phong {
        pattern: Pattern { color: Color::new(0.8, 0.8, 0.1), solid: Some(checker), ..Pattern::default() },
        diffuse: 0.7,
        reflection: Some(0.3),
        ..Phong::default()
    }
}

/// What stands on the ground y = -0.5, seen from near by.
fn on_ground(ground: Body) -> Scene {
    let red = Material::Phong(Phong {
        pattern: Color::new(0.7, 0.3, 0.3).into(),
        specular: 0.4,
        ..Phong::default()
    });
    let mirror = Material::Phong(Phong { reflection: Some(0.8), diffuse: 0.1, ..Phong::default() });
    let bodies = vec![
        ground,
        ball(0.5, v(0.0, 0.0, -1.0), red.clone()),
        ball(0.1, v(0.55, -0.4, -0.6), mirror),
        turned(Shape::CUBE, v(-1.6, 0.3, -2.5), v(20.0, 40.0, 10.0), red),
    ];
    Scene {
        camera: camera(v(0.0, 0.3, 1.3), v(0.0, 0.0, -1.0), 55.0),
        lights: vec![light(v(3.0, 5.0, 2.0), 1.0, Falloff::None)],
        ..scene(bodies)
    }
}

fn drawn(scene: &Scene) -> Picture {
    picture(scene, SIZE.0, SIZE.1)
}

/// Bodies of this size that have the ground as a part of their surface, of all shapes and both ways up.
fn huge(size: f64) -> Vec<Body> {
    let (below, ground) = (v(0.0, -0.5 - size, 0.0), ground());
    let long = Shape::Cylinder { radius: size, height: 2.0 * size };
    let disc = Shape::Cylinder { radius: size, height: size };
    let mountain = Shape::Cone { radius: size, top_radius: 0.25 * size, height: size };
    let tilted = |shape, placement: Placement| placed(shape, placement, ground.clone());
    // A ball half as high as wide, turned: its lowest and highest points stay where they were.
    let lentil = Placement { scale: v(1.0, 0.5, 1.0), ..Placement::at(v(0.0, -0.5 - 0.5 * size, 0.0)) };
    vec![
        ball(size, below, ground.clone()),
        tilted(Shape::Sphere { radius: size }, lentil),
        block(DVec3::splat(2.0 * size), below, ground.clone()),
        turned(Shape::Cube { size: DVec3::splat(2.0 * size) }, below, v(0.0, 33.0, 0.0), ground.clone()),
        body(disc, below, ground.clone()),
        turned(long, v(-size, -0.5 - size, 0.0), v(0.0, 0.0, -90.0), ground.clone()),
        body(mountain, below, ground.clone()),
        turned(mountain, v(0.0, -0.5, 0.0), v(180.0, 0.0, 0.0), ground.clone()),
    ]
}

#[test]
fn huge_bodies_are_as_exact_as_small_ones() {
    for size in [20.0, 1e3, 1e5, 6_371_000.0, 1e8, 1e9] {
        for body in huge(size) {
            let shape = body.shape;
            let scene = on_ground(body);
            let (ours, exact) = (drawn(&scene), Oracle::new(&scene, 2e4).picture(SIZE.0, SIZE.1));
            println!("{shape:?}");
            assert_same_picture(&ours, &exact, 0.001);
        }
    }
}

/// A huge ball that reflects and bends light, seen from outside and from within.
#[test]
fn huge_bodies_reflect_and_refract() {
    for size in [1e5, 1e8] {
        let mut glass = glass(1.3);
        glass.reflection = Some(0.2);
        let mut scene = on_ground(ball(size, v(0.0, -0.5 - size, 0.0), glass));
        scene.tracing.generations = 5;
        scene.bodies.push(ball(0.3, v(0.3, -1.5, -1.0), chalk()));
        assert_same_picture(&drawn(&scene), &Oracle::new(&scene, 2e4).picture(SIZE.0, SIZE.1), 0.001);
        scene.camera = camera(v(0.0, -1.0, 1.3), v(0.0, -0.6, -1.0), 55.0);
        assert_same_picture(&drawn(&scene), &Oracle::new(&scene, 2e4).picture(SIZE.0, SIZE.1), 0.001);
    }
}

#[test]
fn details_are_exact_beside_huge_bodies() {
    let small = |scene: Scene, factor: f64| {
        let mut scaled = scene.clone();
        scaled.camera.position *= factor;
        scaled.camera.target *= factor;
        scaled.lights[0].position *= factor;
        scaled.bodies = scene
            .bodies
            .iter()
            .map(|body| {
                let mut body = body.clone();
                if let Anchor::Frame { position, .. } = &mut body.placement.anchor {
                    *position *= factor;
                }
                body.placement.scale *= factor;
                body
            })
            .collect();
        scaled
    };
    // The same picture, a thousand times smaller: the largest bodies are 10⁹ times as large as the smallest.
    let mut plain = ground();
    plain.pattern.solid = None;
    let scene = on_ground(ball(1e8, v(0.0, -0.5 - 1e8, 0.0), plain));
    let (large, small) = (drawn(&scene), drawn(&small(scene.clone(), 1e-3)));
    assert_same_picture(&large, &small, 0.001);
}

#[test]
fn a_plane_is_the_same_wherever_its_anchor_lies_and_however_it_turns() {
    for tilt in [DVec3::ZERO, v(0.0, 0.0, 7.0), v(-4.0, 0.0, 3.0)] {
        let plane = |position: DVec3, about: f64, material: Phong| {
            // Turned about its own normal first.
            let own = glam::DQuat::from_rotation_y(about.to_radians());
            let turn = glam::DMat3::from_rotation_z(tilt.z.to_radians())
                * glam::DMat3::from_rotation_x(tilt.x.to_radians());
            let (z, y, x) =
                glam::DQuat::from_mat3(&(turn * glam::DMat3::from_quat(own))).to_euler(glam::EulerRot::ZYX);
            let turn_degrees = v(x.to_degrees(), y.to_degrees(), z.to_degrees());
            let within = turn * v(position.x, 0.0, position.z);
            turned(Shape::Plane, v(0.0, -0.5, 0.0) + within, turn_degrees, material)
        };
        let reference = drawn(&on_ground(plane(DVec3::ZERO, 0.0, ground())));
        for far in [v(3.0, 0.0, -7.5), v(1e5, 0.0, 1e5), v(1e7, 0.0, 1e7), v(-3e8, 0.0, 9e8)] {
            for about in [0.0, 90.0, 37.0] {
                let scene = on_ground(plane(far, about, ground()));
                // A tilt in double precision is 10⁻¹⁶ of the way off.
                let allowed = if tilt == DVec3::ZERO && far.length() < 1e8 { 2e-4 } else { 1e-3 };
                assert_same_picture(&drawn(&scene), &reference, allowed);
            }
        }
    }
}

/// Checkers that turn with the body do not move when the plane is anchored elsewhere by whole pairs of cells.
#[test]
fn patterns_of_a_plane_stay_where_they_were() {
    let checker =
        SolidTexture { color: Color::BLACK, size: 0.5, space: PatternSpace::Body, ..SolidTexture::default() };
    let material = Phong { pattern: Pattern { solid: Some(checker), ..ground().pattern }, ..ground() };
    let plane = |x: f64| turned(Shape::Plane, v(x, -0.5, -x), v(0.0, 90.0, 0.0), material.clone());
    let reference = drawn(&on_ground(plane(0.0)));
    for x in [2.0, 65_536.0, 1e7] {
        assert_same_picture(&drawn(&on_ground(plane(x))), &reference, 2e-4);
    }
}

fn moved(scene: &Scene, by: DVec3) -> Scene {
    let mut moved = scene.clone();
    moved.camera.position += by;
    moved.camera.target += by;
    moved.lights.iter_mut().for_each(|light| light.position += by);
    moved.bodies = scene
        .bodies
        .iter()
        .map(|body| Body { placement: body.placement.moved_by(by), ..body.clone() })
        .collect();
    moved
}

#[test]
fn a_scene_far_from_the_origin_is_the_same_scene() {
    let floor = block(v(8.0, 0.5, 8.0), v(0.0, -0.75, 0.0), ground());
    let near = on_ground(floor);
    let mut parallel = near.clone();
    parallel.camera.projection = Projection::Parallel { height: 3.0 };
    for near in [near, parallel] {
        let reference = drawn(&near);
        // Whole pairs of cells, so that the world's checkers are the same.
        for by in [v(1e5, 0.0, 0.0), v(-1e6, 0.0, 3e6), v(0.0, 2e7, 0.0), v(1e8, 1e8, -1e8)] {
            assert_same_picture(&drawn(&moved(&near, by)), &reference, 0.001);
        }
    }
}

#[test]
fn flat_bodies_are_whole() {
    // Seen from above and from the side, lit: a coin of any thickness is a disc.
    let scene_of = |shape: Shape, scale: DVec3| {
        let placement = Placement {
            anchor: Anchor::Frame { position: v(0.3, 0.0, 0.1), rotation_degrees: v(10.0, 20.0, -5.0) },
            scale,
        };
        let coin = placed(shape, placement, Phong { reflection: Some(0.5), ..chalk() });
        Scene {
            camera: camera(v(0.0, 1.0, 5.0), DVec3::ZERO, 27.0),
            lights: vec![light(v(2.0, 6.0, 5.0), 1.0, Falloff::None)],
            ..scene(vec![coin, ball(0.3, v(-0.2, 0.7, 0.0), chalk())])
        }
    };
    for shape in [Shape::SPHERE, Shape::CONE, Shape::PARABOLOID, Shape::CYLINDER, Shape::CUBE] {
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let thin = |thickness: f64| scene_of(shape, DVec3::ONE - axis * (1.0 - thickness));
            let reference = drawn(&thin(1e-5));
            for thickness in [1e-7, 1e-8, 1e-9] {
                assert_same_picture(&drawn(&thin(thickness)), &reference, 0.001);
            }
        }
    }
}

/// A ground with a pattern of cells as large as a fifth of the picture, through a window as high as `height`.
fn seen_from_afar(kind: SolidKind, ground: &Body, (target, way): (DVec3, DVec3), view: Projection) -> Scene {
    let height = match view {
        Projection::Parallel { height } => height,
        Projection::Perspective { fov_degrees } => way.length() * fov_degrees.to_radians(),
    };
    let solid = SolidTexture { size: 0.2 * height, ..SolidTexture::new(kind, Color::BLACK) };
    let pattern = Pattern { solid: Some(solid), ..Pattern::default() };
    let material = Phong { pattern, ..glow(Color::WHITE) };
    let ground = Body { material: MaterialChoice::own(material), ..ground.clone() };
    let mut scene = scene(vec![ground]);
    scene.camera = Camera { position: target + way, target, up: DVec3::Y, projection: view };
    scene
}

#[test]
fn patterns_of_planes_are_exact_through_a_camera_far_away() {
    let level = body(Shape::Plane, DVec3::ZERO, chalk());
    let tilted = turned(Shape::Plane, v(0.3, -0.2, 0.1), v(20.0, 30.0, -10.0), chalk());
    let away = v(0.25, 0.3, 1.0).normalize();
    for kind in [SolidKind::Checker, SolidKind::Stripes, SolidKind::Rings] {
        for ground in [&level, &tilted] {
            for far in [10.0, 1e5, 1e6, 1e7, 1e8, 9e8] {
                let parallel = Projection::Parallel { height: 4.0 };
                let narrow = Projection::Perspective { fov_degrees: 0.001 };
                for view in [parallel, narrow] {
                    // Numbers are exact beside the target of such a view.
                    let aim = (ground.placement.origin(), far * away);
                    let mut scene = seen_from_afar(kind, ground, aim, view);
                    let exact = |scene: &Scene| Oracle::new(scene, 1e-3 * far).picture(60, 40);
                    assert_same_picture(&picture(&scene, 60, 40), &exact(&scene), 0.002);
                    // Something that has an end is no help.
                    scene.bodies.push(block(DVec3::splat(0.2), v(0.0, 0.5, 0.0), chalk()));
                    assert_same_picture(&picture(&scene, 60, 40), &exact(&scene), 0.004);
                }
            }
        }
    }
}

#[test]
fn patterns_of_planes_are_exact_far_from_the_origin() {
    let level = body(Shape::Plane, DVec3::ZERO, chalk());
    for kind in [SolidKind::Checker, SolidKind::Stripes, SolidKind::Rings, SolidKind::Gradient] {
        for target in
            [v(1e3, 0.0, 2e3), v(1e5, 0.0, -3e5), v(-1e6, 0.0, 4e5), v(1e7, 0.0, 0.0), v(7e8, 0.0, 6e8)]
        {
            for way in [v(0.5, 3.0, 2.0), v(0.0, 5.0, 0.1)] {
                for view in
                    [Projection::Parallel { height: 4.0 }, Projection::Perspective { fov_degrees: 27.0 }]
                {
                    let scene = seen_from_afar(kind, &level, (target, way), view);
                    let exact = Oracle::new(&scene, 1.0).picture(60, 40);
                    assert_same_picture(&picture(&scene, 60, 40), &exact, 0.003);
                }
            }
        }
    }
}

/// The nearest point of a plane may lie in the middle of a tile, and what has an end far behind it.
#[test]
fn rays_never_start_beyond_a_plane() {
    for fov_degrees in [40.0, 90.0, 140.0] {
        for aside in [0.0, 0.7] {
            let red = glow(Color::new(1.0, 0.0, 0.0));
            let mut scene = scene(vec![
                plane(DVec3::ZERO, 0.0, glow(Color::WHITE)),
                ball(1.0, v(0.0, -5000.0, 0.0), red),
            ]);
            scene.camera = camera(v(0.0, 6.0, 0.0), v(6.0 * aside, 0.0, 0.0), fov_degrees);
            scene.camera.up = DVec3::NEG_Z;
            for bodies in [2, 1] {
                scene.bodies.truncate(bodies);
                let exact = Oracle::new(&scene, 1.0).picture(40, 30);
                assert_same_picture(&picture(&scene, 40, 30), &exact, 0.0);
            }
        }
    }
}
