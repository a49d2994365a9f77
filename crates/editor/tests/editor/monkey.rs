//! Anything in any order.

use std::sync::Arc;

use catoptric_editor::{
    Action, ActionError, Editor, Item, NewBodyPlacement, PartPath, PartSlot, Selection, navigate,
};
use catoptric_scene::{Example, Material, MaterialChoice, Phong, Scene, ScenePart, Shape, ShapeKind};
use glam::DVec3;

use crate::common::{items, label, save, scene};

/// Steps of the monkey; `CATOPTRIC_MONKEY_STEPS` makes it more.
const STEPS: u64 = 4000;

/// Numbers by chance: SplitMix64 (Steele, Lea, Flood 2014).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    fn flag(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Mostly a sound number, now and then one that nothing is.
    fn number(&mut self) -> f64 {
        match self.below(40) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => -1e300,
            3 => 0.0,
            _ => (self.next() % 20_001) as f64 / 1000.0 - 10.0,
        }
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// An item that there is, mostly.
    fn item(&mut self, editor: &Editor) -> Item {
        let scene = editor.scene();
        let or_more = |chance: &mut Self, count: usize| chance.below(count + 1);
        items(editor)(match self.below(8) {
            0 => [ScenePart::Camera, ScenePart::Environment, ScenePart::Tracing][self.below(3)],
            1 | 2 => ScenePart::Material(or_more(self, scene.materials.len())),
            3 | 4 => ScenePart::Light(or_more(self, scene.lights.len())),
            _ => ScenePart::Body(or_more(self, scene.bodies.len())),
        })
    }

    fn name(&mut self) -> String {
        ["", "ball", "ball 2", "a", " шар ", "2", "sphere 9"][self.below(7)].to_owned()
    }

    fn choice(&mut self, scene: &Scene) -> MaterialChoice {
        match self.below(3) {
            0 => MaterialChoice::Named(self.name()),
            1 => scene
                .materials
                .get(self.below(scene.materials.len()))
                .map_or_else(MaterialChoice::default, |named| MaterialChoice::Named(named.name.clone())),
            _ => MaterialChoice::Inline(Box::new(Material::Phong(Phong {
                ior: self.number(),
                ..Phong::default()
            }))),
        }
    }

    /// A way to a part, mostly to none.
    fn path(&mut self) -> PartPath {
        PartPath::by((0..self.below(3)).map(|_| self.below(3))).unwrap()
    }

    fn text(&mut self, editor: &Editor) -> String {
        match self.below(5) {
            0 => "format = 3".to_owned(),
            1 => Example::ALL[0].text.to_owned(),
            _ => editor.copy().unwrap_or_default(),
        }
    }

    fn action(&mut self, editor: &Editor) -> Action {
        let scene = editor.scene();
        match self.below(50) {
            0 | 1 => {
                let placement =
                    NewBodyPlacement { size: self.number(), ..NewBodyPlacement::at(self.vector()) };
                let shape = match self.below(2) {
                    0 => ShapeKind::SIMPLE[self.below(5)],
                    _ => ShapeKind::PARAMETRIC[self.below(7)],
                };
                Action::AddBody { shape, placement, name: self.name() }
            }
            2 => Action::AddLight { at: self.vector(), name: self.name() },
            3 => Action::AddMaterial { name: self.name() },
            4 => Action::Duplicate,
            5 => Action::Delete,
            6 => Action::ToggleHidden,
            7 => Action::ToggleLocked,
            8 => Action::SetHidden { item: self.item(editor), hidden: self.flag() },
            9 => Action::SetLocked { item: self.item(editor), locked: self.flag() },
            10 => Action::ShowAll,
            11 => Action::UnlockAll,
            12 => Action::MoveUp,
            13 => Action::MoveDown,
            14 => Action::MoveToIndex(self.below(scene.bodies.len() + 2)),
            15 => Action::SelectAll,
            16 => Action::SelectNone,
            17 => Action::InvertSelection,
            18 => Action::SelectNext,
            19 => Action::SelectPrevious,
            20 | 21 => Action::Rename { item: self.item(editor), name: self.name() },
            22 => Action::Cut,
            23 => Action::Paste(self.text(editor)),
            24 | 25 => Action::AssignMaterial(self.choice(scene)),
            26 | 27 => Action::ShareMaterial,
            28 => Action::MakeMaterialUnique,
            29 => Action::DropToGround,
            30 => Action::ResetPlacement,
            31 => Action::RemoveUnusedMaterials,
            32 | 33 => Action::Join { shape: ShapeKind::ALL[self.below(17)], name: self.name() },
            34 => Action::TakeApart,
            35..=38 => Action::Undo,
            45 | 46 => Action::DuplicateAsInstance,
            47 => Action::MakeOwn,
            39 => Action::SelectPart,
            40 => Action::SelectWhole,
            41 => Action::TakeOut(self.flag().then(|| self.below(scene.bodies.len() + 2))),
            42 => Action::MaterialOfWhole,
            43 => Action::RenamePart { whole: self.item(editor), part: self.path(), name: self.name() },
            44 => {
                let slot = PartSlot { whole: self.item(editor), within: self.path(), place: self.below(4) };
                Action::Nest(self.flag().then_some(slot))
            }
            _ => Action::Redo,
        }
    }

    /// A step of a gesture.
    fn change(&mut self, editor: &mut Editor) {
        let label = label(["edit-a", "edit-b"][self.below(2)]);
        let (index, number, vector, kind) = (self.below(12), self.number(), self.vector(), self.below(9));
        let revision = editor.revision();
        let result = match kind {
            0 | 1 => {
                editor.change_body(index, label, |body| body.placement = body.placement.moved_by(vector))
            }
            2 => editor
                .change_bodies([index, 1, index], label, |_, body| body.shape = Shape::Cube { size: vector }),
            3 => editor.change_light(index, label, |light| light.intensity = number),
            4 => editor.change_material(index, label, |material| {
                material.as_phong_mut().unwrap().shininess = number;
            }),
            5 => editor.change_camera(label, |camera| *camera = navigate::orbit(camera, number, vector.x)),
            6 => editor.change_environment(label, |environment| environment.background.b = number),
            7 => editor.change_tracing(label, |tracing| tracing.threshold = number / 10.0),
            _ => editor.change(label, |scene| {
                scene.bodies.truncate(index + 20);
                scene.lights.truncate(index + 4);
            }),
        };
        assert_eq!(editor.revision() > revision, result == Ok(true));
    }
}

/// The scene and its things: two equal ones may have changed places.
fn things(editor: &Editor) -> (Arc<Scene>, Vec<Item>) {
    let edited = editor.edited();
    (Arc::clone(editor.scene()), edited.materials().chain(edited.lights()).chain(edited.bodies()).collect())
}

fn act(editor: &mut Editor, action: &Action) {
    editor.settle();
    let (scene, selection, revision) =
        (editor.scene().clone(), editor.selection().clone(), editor.revision());
    let before = things(editor);
    let can = editor.can(action);
    assert!(Action::KEYS.contains(&action.key()));
    match editor.apply(action.clone()) {
        Ok(()) => {
            assert!(can, "{action:?} was gray, but works");
            let is_other = things(editor) != before || *editor.selection() != selection;
            assert!(is_other, "{action:?} did nothing");
        }
        Err(error) => {
            let is_foreseen = matches!(
                error,
                ActionError::Refused(_)
                    | ActionError::BadText(_)
                    | ActionError::NothingToPaste
                    | ActionError::Sheared { .. }
                    | ActionError::TooDeep
                    | ActionError::TooManyParts
            );
            assert!(!can || is_foreseen, "{action:?}: {error}");
            assert_eq!((editor.scene(), editor.selection()), (&scene, &selection), "{action:?}");
        }
    }
    assert_eq!(editor.revision() > revision, things(editor) != before, "{action:?}");
}

#[test]
fn nothing_breaks_whatever_is_done() {
    let steps =
        std::env::var("CATOPTRIC_MONKEY_STEPS").ok().and_then(|steps| steps.parse().ok()).unwrap_or(STEPS);
    let mut chance = Chance(7);
    let mut editor = Editor::new(scene());
    let mut saved = scene();
    for step in 0..steps {
        match chance.below(20) {
            0..=9 => {
                let action = chance.action(&editor);
                act(&mut editor, &action);
            }
            10..=14 => chance.change(&mut editor),
            15 | 16 => {
                let item = chance.item(&editor);
                let mut selection = editor.selection().clone();
                if chance.flag() {
                    selection.toggle(item);
                } else {
                    selection = Selection::one(item);
                }
                editor.select(selection);
            }
            17 => _ = editor.settle(),
            18 => _ = editor.abandon(),
            _ => match chance.below(4) {
                0 => {
                    let text = editor.writing().text();
                    saved = catoptric_scene::read(&text).into_result().unwrap().value;
                    assert_eq!(*editor.scene().as_ref(), saved);
                    save(&mut editor, "monkey.toml", &text);
                    assert!(!editor.is_changed());
                }
                1 => {
                    let text = editor.writing().text();
                    editor.revert(text, saved.clone()).unwrap();
                    assert_eq!(*editor.scene().as_ref(), saved);
                }
                2 => {
                    let count = editor.steps().len();
                    editor.go_to_step(chance.below(count + 2));
                }
                _ => editor = Editor::clone(&editor),
            },
        }
        editor.check_invariants().unwrap_or_else(|broken| panic!("step {step}: {broken}"));
    }
    editor.settle();
    let (last, done) = (editor.scene().clone(), editor.steps_done());
    editor.go_to_step(0);
    assert_eq!(*editor.scene().as_ref(), scene());
    editor.go_to_step(done);
    assert_eq!(editor.scene(), &last);
}
