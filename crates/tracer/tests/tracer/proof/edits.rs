//! A scene that follows edits is that of the edited scene.

use std::cell::Cell;

use catoptric_scene::{Body, Falloff, Image, Scene, Shadow, Shape, Sky, Surroundings};
use catoptric_tracer::{Ray, RayIntersection, RenderControl, RenderScene, RenderSettings, render};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::proof::common::{
    ball, camera, cases, chalk, glass, glow, light, plane, ray, render_scene, scene, v,
};
use crate::proof::random::{body, material};

/// Something a person does to a scene.
#[derive(Clone, Debug)]
enum Edit {
    Move(usize, DVec3),
    Replace(usize, Body),
    /// Gives a body the shape of another, but not its place.
    Reshape(usize, Body),
    Recolor(usize, Body),
    Two(usize, usize, DVec3),
    Hide(usize),
    Shade(usize),
    Remove(usize),
    Surroundings(f64),
    Rename(usize),
}

fn edit() -> impl Strategy<Value = Edit> {
    let near = prop::array::uniform3(-0.5..0.5_f64).prop_map(DVec3::from);
    let far = prop::array::uniform3(-9.0..9.0_f64).prop_map(DVec3::from);
    let at = || any::<prop::sample::Index>().prop_map(|index| index.index(1000));
    prop_oneof![
        8 => (at(), near.clone()).prop_map(|(at, offset)| Edit::Move(at, offset)),
        2 => (at(), far).prop_map(|(at, offset)| Edit::Move(at, offset)),
        3 => (at(), body()).prop_map(|(at, body)| Edit::Replace(at, body)),
        3 => (at(), body()).prop_map(|(at, body)| Edit::Reshape(at, body)),
        3 => (at(), body()).prop_map(|(at, body)| Edit::Recolor(at, body)),
        3 => (at(), at(), near).prop_map(|(one, other, offset)| Edit::Two(one, other, offset)),
        1 => at().prop_map(Edit::Hide),
        1 => at().prop_map(Edit::Shade),
        1 => at().prop_map(Edit::Remove),
        1 => (0.1..1.0_f64).prop_map(Edit::Surroundings),
        1 => at().prop_map(Edit::Rename),
    ]
}

impl Edit {
    /// Edits a scene and tells which bodies are different now.
    fn make(&self, scene: &mut Scene) -> Vec<usize> {
        let count = scene.bodies.len();
        let shift = |scene: &mut Scene, at: usize, offset: DVec3| {
            let placement = &mut scene.bodies[at].placement;
            *placement = placement.moved_by(offset);
        };
        match self.clone() {
            Self::Move(at, offset) => shift(scene, at % count, offset),
            Self::Replace(at, body) => scene.bodies[at % count] = body,
            Self::Reshape(at, body) => scene.bodies[at % count].shape = body.shape,
            Self::Recolor(at, body) => scene.bodies[at % count].material = body.material,
            Self::Two(one, other, offset) => {
                shift(scene, one % count, offset);
                shift(scene, other % count, -offset);
                return vec![one % count, other % count];
            }
            Self::Hide(at) => scene.bodies[at % count].hidden ^= true,
            Self::Shade(at) => scene.bodies[at % count].shadow = Shadow::ALL[at % 3],
            Self::Remove(at) => {
                scene.bodies.remove(at % count);
                return Vec::new();
            }
            Self::Surroundings(share) => {
                scene.environment.background = [share, 0.5, 1.0 - share].into();
                scene.environment.surroundings = match (4.0 * share) as u32 {
                    0 => Surroundings::Even,
                    1 => Surroundings::Sky(Sky::default()),
                    _ => Surroundings::Picture(Image::built_in("grid").unwrap()),
                };
                scene.environment.rotation_degrees = 300.0 * share;
                scene.lights[0].intensity = share;
                scene.tracing.generations = 2 + (6.0 * share) as u32;
                return Vec::new();
            }
            Self::Rename(at) => {
                scene.bodies[at % count].name = "new".to_owned();
                scene.bodies[at % count].locked ^= true;
            }
        }
        let (Self::Move(at, _)
        | Self::Replace(at, _)
        | Self::Reshape(at, _)
        | Self::Recolor(at, _)
        | Self::Hide(at)
        | Self::Shade(at)
        | Self::Rename(at)) = self
        else {
            return Vec::new();
        };
        vec![at % count]
    }
}

fn crowd() -> impl Strategy<Value = Scene> {
    (prop::collection::vec(body(), 66..120), prop::option::of(material())).prop_map(|(mut bodies, floor)| {
        bodies.extend(floor.map(|material| plane(DVec3::ZERO, 0.0, material)));
        let mut scene = scene(bodies);
        scene.lights = vec![light(v(3.0, 6.0, 4.0), 1.0, Falloff::None)];
        scene.camera = camera(v(1.0, 2.0, 9.0), v(0.0, 0.9, 0.0), 35.0);
        scene.tracing.generations = 5;
        scene
    })
}

/// Follows an edit in a scene; whether it could, or the scene was prepared anew.
fn follow(render_scene: &mut RenderScene, before: &Scene, after: &Scene, changed: &[usize]) -> bool {
    match render_scene.edit(before, after, changed) {
        Some(edit) => {
            render_scene.apply(edit, after);
            true
        }
        None => {
            *render_scene = RenderScene::build(after).unwrap();
            false
        }
    }
}

/// All of a hit but the body's place in the scene.
fn told(hit: RayIntersection) -> impl PartialEq + std::fmt::Debug {
    (hit.body, hit.hit.t.to_bits(), hit.hit.leaving, hit.position, hit.normal)
}

#[track_caller]
fn assert_same_hits(followed: &RenderScene, fresh: &RenderScene) {
    let size = DVec2::new(16.0, 12.0);
    let eye = (0..16 * 12).map(|at| {
        let at = DVec2::new(f64::from(at % 16) + 0.5, f64::from(at / 16) + 0.5);
        let rays = [followed, fresh].map(|render_scene| render_scene.camera().ray(at, size));
        assert_eq!(rays[0], rays[1]);
        rays[0]
    });
    let within: [Ray; 3] =
        [v(1.0, 0.2, 0.3), v(-0.5, 0.4, -0.6), v(0.1, -1.0, 0.2)].map(|to| ray(v(0.1, 1.1, 0.2), to));
    for ray in eye.chain(within) {
        assert_eq!(followed.closest_hit(&ray).map(told), fresh.closest_hit(&ray).map(told), "{ray:?}");
        let all = |render_scene: &RenderScene| {
            render_scene.hits_along(&ray).into_iter().map(told).collect::<Vec<_>>()
        };
        assert_eq!(all(followed), all(fresh), "{ray:?}");
    }
}

/// The order in which filters are multiplied may be another one, no more.
#[track_caller]
fn assert_same_pictures(followed: &RenderScene, fresh: &RenderScene) {
    let settings = RenderSettings { width: 48, height: 36, samples: 1 };
    let [one, other] = [followed, fresh]
        .map(|render_scene| render(render_scene, settings, &RenderControl::default()).unwrap());
    assert_eq!(one.counts, other.counts);
    for (one, other) in one.picture.pixels().iter().zip(other.picture.pixels()) {
        let is_close = |(a, b): (&f32, &f32)| (a - b).abs() <= 1e-5 * b.abs();
        assert!(one.iter().zip(other).all(is_close), "{one:?} is not {other:?}");
    }
}

#[test]
fn a_stage_that_followed_edits_is_the_edited_scenes() {
    let (followed, edits) = (Cell::new(0), Cell::new(0));
    let chains = (crowd(), prop::collection::vec(edit(), 1..16));
    let result = TestRunner::new(cases(40)).run(&chains, |(mut scene, chain)| {
        let mut render_scene = render_scene(&scene);
        for edit in chain {
            let before = scene.clone();
            let changed = edit.make(&mut scene);
            edits.set(edits.get() + 1);
            followed.set(followed.get() + u32::from(follow(&mut render_scene, &before, &scene, &changed)));
            assert_same_hits(&render_scene, &RenderScene::build(&scene).unwrap());
        }
        assert_same_pictures(&render_scene, &RenderScene::build(&scene).unwrap());
        Ok(())
    });
    result.unwrap();
    assert!(2 * followed.get() > edits.get(), "only {} of {} edits", followed.get(), edits.get());
}

/// Balls in rows, one meter apart, over a floor.
fn rows() -> Scene {
    let balls = (0..200).map(|at| ball(0.3, v(f64::from(at % 20), 0.5, f64::from(at / 20)), chalk()));
    let mut scene = scene(balls.collect());
    scene.bodies.push(plane(DVec3::ZERO, 0.0, glow([0.5; 3].into())));
    scene
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let before = rows();
    let render_scene = render_scene(&before);
    let is_followed = |edit: &dyn Fn(&mut Scene), changed: &[usize]| {
        let mut after = before.clone();
        edit(&mut after);
        render_scene.edit(&before, &after, changed).is_some()
    };
    assert!(is_followed(&|_| (), &[]));
    assert!(is_followed(&|scene| scene.bodies[7].placement.scale *= 2.0, &[7]));
    assert!(is_followed(
        &|scene| scene.bodies[200].placement = ball(1.0, v(0.0, -1.0, 0.0), chalk()).placement,
        &[200]
    ));
    assert!(!is_followed(&|scene| scene.bodies[7].hidden = true, &[7]));
    assert!(!is_followed(&|scene| scene.bodies[7].shape = Shape::Plane, &[7]));
    assert!(!is_followed(&|scene| drop(scene.bodies.pop()), &[]));
    assert!(!is_followed(
        &|scene| scene.bodies[7].material = catoptric_scene::MaterialChoice::Named("none".to_owned()),
        &[7]
    ));
    assert!(!is_followed(&|_| (), &[0, 1, 2, 3, 4, 5]), "many bodies are quicker prepared anew");
    assert!(!is_followed(&|_| (), &[300]));
}

#[test]
fn a_hierarchy_that_would_get_poor_is_built_anew() {
    let (mut scene, mut times) = (rows(), 0);
    let mut render_scene = render_scene(&scene);
    for at in 0..100 {
        let before = scene.clone();
        // Everyone goes to the other end of the room.
        let place = 199 - at;
        scene.bodies[at].placement =
            ball(1.0, v((place % 20) as f64, 2.5, (place / 20) as f64), chalk()).placement;
        times += u32::from(!follow(&mut render_scene, &before, &scene, &[at]));
    }
    assert!((1..100).contains(&times), "built anew {times} times");
    assert_same_hits(&render_scene, &RenderScene::build(&scene).unwrap());
}

#[test]
fn a_new_glass_is_seen_through_and_tints_alike() {
    let before = rows();
    let mut render_scene = render_scene(&before);
    let mut after = before.clone();
    after.bodies[7] = ball(0.4, v(7.0, 0.6, 0.0), glass(1.4));
    assert!(follow(&mut render_scene, &before, &after, &[7]));
    assert_same_pictures(&render_scene, &RenderScene::build(&after).unwrap());
}
