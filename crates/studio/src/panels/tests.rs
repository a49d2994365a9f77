//! Panels alone, with a context of their own: no shell, no window, no other panel.

use catoptric_editor::{Action, Editor};
use catoptric_live::Live;
use catoptric_scene::{Example, ScenePart};
use egui::Ui;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::base::held_keys::HeldKeys;
use crate::base::texts::{Language, Texts};
use crate::base::theme;
use crate::panels::history::history_ui;
use crate::panels::outliner::{Outliner, outliner_ui};
use crate::state::audit::AuditState;
use crate::state::card::WindowCard;
use crate::state::command::{AddCommand, CameraCommand, Command};
use crate::state::context::Cx;
use crate::state::exact::ExactState;
use crate::state::images::DocumentImages;
use crate::state::maps::MapState;
use crate::state::settings::Settings;
use crate::state::view::ViewState;

/// What a context borrows, and the state of a panel.
struct PanelKit<P> {
    panel: P,
    /// Whether the theme with its fonts is installed, which a frame needs to begin with.
    has_theme: bool,
    editor: Editor,
    texts: Texts,
    settings: Settings,
    view: ViewState,
    held_keys: HeldKeys,
    audit: AuditState,
    maps: MapState,
    exact: ExactState,
    live: Live,
    images: DocumentImages,
    card: WindowCard,
    commands: Vec<Command>,
}

impl<P: Default> PanelKit<P> {
    /// A panel over a built-in scene.
    fn new(example: &str) -> Self {
        let scene = Example::find(example).unwrap().load().unwrap().scene;
        Self {
            panel: P::default(),
            has_theme: false,
            editor: Editor::new(scene),
            texts: Texts::new(Language::English),
            settings: Settings::default(),
            view: ViewState::default(),
            held_keys: HeldKeys::default(),
            audit: AuditState::default(),
            maps: MapState::default(),
            exact: ExactState::default(),
            live: Live::start(|| {}).unwrap(),
            images: DocumentImages::default(),
            card: WindowCard::default(),
            commands: Vec::new(),
        }
    }
}

impl<P> PanelKit<P> {
    /// Draws the panel, after the frame that installs the theme.
    fn draw(&mut self, ui: &mut Ui, draw: impl FnOnce(&mut Ui, &mut Cx<'_>, &mut P)) {
        if std::mem::replace(&mut self.has_theme, true) {
            let (panel, mut cx) = self.parts();
            draw(ui, &mut cx, panel);
        } else {
            theme::install(ui.ctx());
        }
    }

    fn parts(&mut self) -> (&mut P, Cx<'_>) {
        let cx = Cx {
            editor: &mut self.editor,
            texts: &self.texts,
            settings: &mut self.settings,
            view: &mut self.view,
            held_keys: &self.held_keys,
            audit: &mut self.audit,
            maps: &mut self.maps,
            exact: &mut self.exact,
            live: &self.live,
            images: &self.images,
            card: &mut self.card,
            commands: &mut self.commands,
        };
        (&mut self.panel, cx)
    }
}

#[test]
fn the_outliner_selects_and_asks_for_commands() {
    let draw = |ui: &mut Ui, kit: &mut PanelKit<Outliner>| kit.draw(ui, outliner_ui);
    let mut harness =
        Harness::builder().with_size([300.0, 700.0]).build_ui_state(draw, PanelKit::new("four-bodies"));
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::TreeItem, "cylinder").click();
    harness.run_steps(3);
    let editor = &harness.state().editor;
    let cylinder = editor.scene().bodies.iter().position(|body| body.name == "cylinder").unwrap();
    assert_eq!(editor.primary_part(), Some(ScenePart::Body(cylinder)));
    assert_eq!(harness.state().commands, []);
    harness.get_by_label("Add light").click();
    harness.run_steps(3);
    assert_eq!(harness.state().commands, [AddCommand::Light.into()]);
    // The menu of a row has what can be done to the thing.
    harness.get_by_role_and_label(Role::TreeItem, "cylinder").click_secondary();
    harness.run_steps(3);
    harness.get_by_label("Frame selection").click();
    harness.run_steps(3);
    assert_eq!(harness.state().commands, [AddCommand::Light.into(), CameraCommand::FrameSelection.into()]);
    assert_eq!(harness.state().texts.missing(), Vec::<String>::new());
}

#[test]
fn the_history_goes_to_the_step_that_is_clicked() {
    let draw = |ui: &mut Ui, kit: &mut PanelKit<()>| kit.draw(ui, |ui, cx, ()| history_ui(ui, cx));
    let mut kit = PanelKit::<()>::new("four-bodies");
    let bodies = kit.editor.scene().bodies.len();
    kit.editor.select_parts([ScenePart::Body(0)]);
    for _ in 0..2 {
        kit.editor.apply(Action::Duplicate).unwrap();
    }
    let mut harness = Harness::builder().with_size([300.0, 400.0]).build_ui_state(draw, kit);
    harness.run_steps(3);
    harness.get_by_label("Opened").click();
    harness.run_steps(3);
    assert_eq!((harness.state().editor.steps_done(), harness.state().editor.steps().len()), (0, 2));
    assert_eq!(harness.state().editor.scene().bodies.len(), bodies);
    assert_eq!(harness.state().commands, []);
}
