//! Runs commands.

use catoptric_editor::{Action, ActionError, navigate};
use egui::{Context, OutputCommand, ViewportCommand};

use crate::app::Studio;
use crate::command::{Command, ZoomStep};
use crate::first_steps::FirstSteps;
use crate::help::{HelpTopic, HelpWindow};
use crate::layout::Pane;
use crate::manual::ManualWindow;
use crate::palette::CommandPalette;
use crate::shapes::shape_name;
use crate::texts::Texts;
use crate::{documents, images, inspector, layout, methods, theme, viewport};

/// Does `command`.
pub(crate) fn run(context: &Context, studio: &mut Studio, command: Command) {
    match command {
        Command::New
        | Command::Open
        | Command::OpenFile(_)
        | Command::OpenExample(_)
        | Command::Revert
        | Command::Save
        | Command::SaveAs
        | Command::Quit => documents::run(context, studio, command),
        Command::AddBody(_) | Command::AddLight | Command::AddMaterial => add(studio, &command),
        Command::ChooseImage(usage) => images::ask(studio, usage),
        Command::Edit(action) => apply(studio, action),
        Command::Copy => copy(context, studio),
        Command::Cut => {
            copy(context, studio);
            apply(studio, Action::Cut);
        }
        // The text comes with a later event; see `shortcuts`.
        Command::Paste => {
            studio.keys.is_paste_asked = true;
            context.send_viewport_cmd(ViewportCommand::RequestPaste);
        }
        Command::ToggleFreeView
        | Command::CameraFromView
        | Command::FrameSelection
        | Command::FrameAll
        | Command::LookAlong(_)
        | Command::ToggleProjection
        | Command::ToggleFly => look(context, studio, &command),
        Command::Method(kind) => studio.settings.methods.choose(kind),
        Command::Show(shows) => {
            if methods::has(&studio.settings.methods.method(), shows) {
                studio.view.shows = shows;
            }
        }
        Command::Tool(tool) => studio.view.take_tool(tool),
        Command::AimLight => studio.view.toggle_aiming(),
        Command::Audit(_)
        | Command::Map(_)
        | Command::ToggleExact
        | Command::Compare(_)
        | Command::Measure(_) => experiment(context, studio, &command),
        Command::ToggleGizmoSpace | Command::ToggleGrid | Command::ToggleHandles => switch(studio, &command),
        Command::ToggleCard => crate::card::toggle(studio),
        Command::TogglePane(pane) => toggle(studio, pane),
        Command::ResetLayout => studio.layout = layout::default_layout(),
        Command::Zoom(step) => zoom(context, studio, step),
        Command::Theme(theme) => {
            studio.settings.theme = theme;
            theme::choose(context, theme);
        }
        Command::Language(language) => {
            studio.settings.language = language;
            studio.texts = Texts::new(language);
        }
        Command::Rename => rename(studio),
        Command::Palette => CommandPalette::open(context, studio),
        Command::FocusMenu => studio.menu_focus.toggle(context),
        Command::Manual
        | Command::ExampleNote
        | Command::Shortcuts
        | Command::Terms
        | Command::About
        | Command::FirstSteps => explain(context, studio, &command),
        Command::Examples | Command::Render => crate::dialogs::run(studio, &command),
        Command::RenderShown => crate::pictures::start_shown(studio),
        Command::CopyPicture => crate::pictures::copy_viewport(context, studio),
    }
}

/// Adds something to the scene where it is seen, with a name in the language of the window.
fn add(studio: &mut Studio, command: &Command) {
    let named = |key: &str| studio.texts.get(key).to_owned();
    let action = match *command {
        Command::AddBody(shape) => {
            let (placement, name) = (viewport::placement_for_body(studio, shape), named(shape_name(shape)));
            Action::AddBody { shape, placement, name }
        }
        Command::AddLight => {
            Action::AddLight { at: viewport::place_for_light(studio), name: named("name-light") }
        }
        _ => Action::AddMaterial { name: named("name-material") },
    };
    apply(studio, action);
}

/// Opens what explains the studio or the scene.
fn explain(context: &Context, studio: &mut Studio, command: &Command) {
    match command {
        Command::Manual => ManualWindow::open(context, studio),
        Command::ExampleNote => crate::example_note::toggle(studio),
        Command::Shortcuts => HelpWindow::open(context, studio, HelpTopic::Shortcuts),
        Command::Terms => HelpWindow::open(context, studio, HelpTopic::Terms),
        Command::About => HelpWindow::open(context, studio, HelpTopic::About),
        Command::FirstSteps => FirstSteps::open(studio),
        _ => {}
    }
}

/// Looks into the picture with the laboratory.
fn experiment(context: &Context, studio: &mut Studio, command: &Command) {
    match *command {
        Command::Audit(act) => crate::audit::run(context, studio, act),
        Command::Map(kind) => studio.maps.kind = kind,
        Command::ToggleExact => studio.exact.is_on = !studio.exact.is_on,
        Command::Compare(act) => crate::compare::run(studio, act),
        Command::Measure(act) => crate::measure::run(context, studio, act),
        _ => {}
    }
}

/// Does what concerns the camera.
fn look(context: &Context, studio: &mut Studio, command: &Command) {
    match command {
        Command::ToggleFreeView => viewport::toggle_free(studio),
        Command::CameraFromView => {
            if let Some(camera) = studio.view.free_camera.take() {
                viewport::set_scene_camera(studio, "edit-camera-from-view", camera);
            }
        }
        Command::FrameSelection => viewport::frame(studio, false),
        Command::FrameAll => viewport::frame(studio, true),
        Command::LookAlong(axis) => viewport::look_along(studio, *axis),
        Command::ToggleProjection => {
            let camera = studio.view.camera(studio.editor.scene());
            viewport::set_camera(studio, "edit-projection", navigate::toggle_projection(&camera));
        }
        Command::ToggleFly => {
            studio.view.is_flying = !studio.view.is_flying;
            // The keys of flight must not choose rows of a list.
            context.memory_mut(egui::Memory::stop_text_input);
        }
        _ => {}
    }
}

/// Shows or hides what lies over the picture.
fn switch(studio: &mut Studio, command: &Command) {
    let is_on = match command {
        Command::ToggleGizmoSpace => &mut studio.view.is_gizmo_local,
        Command::ToggleGrid => &mut studio.settings.shows_grid,
        Command::ToggleHandles => &mut studio.settings.shows_handles,
        _ => return,
    };
    *is_on = !*is_on;
}

/// Shows or hides a panel.
fn toggle(studio: &mut Studio, pane: Pane) {
    let is_in_front = layout::is_in_front(&studio.layout, pane);
    layout::set_visible(&mut studio.layout, pane, !is_in_front);
    if pane == Pane::Materials && !is_in_front {
        studio.panes.materials.take_focus();
    }
}

/// Begins to type another name for the primary thing, in the outliner.
fn rename(studio: &mut Studio) {
    let Some(item) = studio.editor.selection().primary() else { return };
    layout::set_visible(&mut studio.layout, Pane::Outliner, true);
    studio.panes.outliner.rename(studio.editor.scene(), item);
}

/// Does an action; a notice gives the reason if it cannot be done.
fn apply(studio: &mut Studio, action: Action) {
    let is_of_material = matches!(action, Action::AssignMaterial(_));
    let Err(error) = studio.editor.apply(action) else { return };
    let key = match &error {
        ActionError::NothingSelected if is_of_material => "refused-no-body-selected",
        ActionError::NothingSelected => "refused-nothing-selected",
        ActionError::Locked => "refused-locked",
        ActionError::NothingToDo => return,
        ActionError::NoSuchItem => "refused-no-such-item",
        ActionError::EmptyName => "refused-empty-name",
        ActionError::BadText(_) => "refused-bad-text",
        ActionError::NothingToPaste => "refused-nothing-to-paste",
        ActionError::Refused(refused) => {
            let text = inspector::explain(&studio.texts, refused);
            studio.toasts.warning(text);
            return;
        }
    };
    studio.toasts.warning(studio.texts.get(key));
}

fn copy(context: &Context, studio: &mut Studio) {
    if let Some(text) = studio.editor.copy() {
        context.output_mut(|output| output.commands.push(OutputCommand::CopyText(text)));
    }
}

fn zoom(context: &Context, studio: &mut Studio, step: ZoomStep) {
    let zoom = match step {
        ZoomStep::In => studio.settings.zoom * 1.1,
        ZoomStep::Out => studio.settings.zoom / 1.1,
        ZoomStep::Normal => 1.0,
    };
    studio.settings.zoom = zoom.clamp(0.5, 3.0);
    context.set_zoom_factor(studio.settings.zoom);
}
