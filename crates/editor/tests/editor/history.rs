//! Any edits, all undone and all done again.

use catoptric_editor::Editor;
use catoptric_scene::{MaterialChoice, Scene};
use glam::DVec3;
use proptest::prelude::*;

use crate::common::{ball, bodies, label, lamp, named, scene};

#[derive(Clone, Debug)]
enum Edit {
    Insert(usize),
    Remove(usize),
    Swap(usize, usize),
    Move(usize, f64),
    Several(Vec<usize>),
    Lights(usize),
    Materials(usize),
    Camera(f64),
    Everything(u32),
    Select(usize),
    Undo,
    Settle,
}

fn edit() -> impl Strategy<Value = Edit> {
    let place = 0usize..8;
    prop_oneof![
        place.clone().prop_map(Edit::Insert),
        place.clone().prop_map(Edit::Remove),
        (place.clone(), 0usize..8).prop_map(|(a, b)| Edit::Swap(a, b)),
        (place.clone(), -9.0..9.0f64).prop_map(|(index, x)| Edit::Move(index, x)),
        proptest::collection::vec(0usize..8, 0..4).prop_map(Edit::Several),
        place.clone().prop_map(Edit::Lights),
        place.clone().prop_map(Edit::Materials),
        (-9.0..9.0f64).prop_map(Edit::Camera),
        (1u32..64).prop_map(Edit::Everything),
        place.prop_map(Edit::Select),
        Just(Edit::Undo),
        Just(Edit::Settle),
    ]
}

fn list<T>(list: &mut Vec<T>, place: usize, new: T) {
    if place.is_multiple_of(2) {
        list.insert(place.min(list.len()), new);
    } else if place < list.len() {
        list.remove(place);
    }
}

fn perform(scene: &mut Scene, edit: &Edit) {
    let count = scene.bodies.len();
    match *edit {
        Edit::Insert(place) => scene.bodies.insert(place.min(count), ball("", place as f64)),
        Edit::Remove(place) if place < count => _ = scene.bodies.remove(place),
        Edit::Swap(a, b) if a < count && b < count => scene.bodies.swap(a, b),
        Edit::Lights(place) => list(&mut scene.lights, place, lamp("")),
        Edit::Materials(place) => {
            for body in &mut scene.bodies {
                body.material = MaterialChoice::default();
            }
            let name = format!("m{}", scene.materials.len());
            scene.materials.retain(|named| named.name != name);
            list(&mut scene.materials, place, named(&name, 2.0));
        }
        Edit::Everything(generations) => {
            scene.tracing.generations = generations;
            scene.environment.ambient.r = f64::from(generations);
            scene.bodies.change(|bodies| bodies.reverse());
            scene.bodies.truncate(generations as usize);
        }
        _ => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn everything_can_be_undone_and_done_again(edits in proptest::collection::vec(edit(), 0..40)) {
        let original = scene();
        let mut editor = Editor::new(original.clone());
        for (index, edit) in edits.iter().enumerate() {
            let label = label(["edit-a", "edit-b", "edit-c"][index / 2 % 3]);
            match edit {
                Edit::Move(at, x) => {
                    _ = editor.change_body(*at, label, |body| body.placement = body.placement.moved_by(DVec3::X * *x));
                }
                Edit::Several(places) => {
                    _ = editor.change_bodies(places.iter().copied(), label, |index, body| body.hidden = index % 2 == 0);
                }
                Edit::Camera(x) => _ = editor.change_camera(label, |camera| camera.position.x = *x),
                Edit::Select(index) => editor.select_parts(bodies([*index])),
                Edit::Undo => _ = editor.undo(),
                Edit::Settle => _ = editor.settle(),
                _ => _ = editor.change(label, |scene| perform(scene, edit)),
            }
            prop_assert_eq!(editor.check_invariants(), Ok(()));
        }
        editor.settle();
        editor.go_to_step(usize::MAX);
        let last = editor.scene().clone();
        let mut states = vec![last.clone()];
        while editor.undo() {
            states.push(editor.scene().clone());
        }
        prop_assert_eq!(editor.scene().as_ref(), &original);
        prop_assert_eq!(states.len(), editor.steps().len() + 1);
        prop_assert!(!editor.is_changed());
        states.pop();
        while editor.redo() {
            let state = states.pop();
            prop_assert_eq!(Some(editor.scene()), state.as_ref());
        }
        prop_assert_eq!(editor.scene(), &last);
    }
}
