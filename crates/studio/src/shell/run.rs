//! Runs commands.

use catoptric_editor::{Action, ActionError, PartPath, navigate};
use egui::{Context, OutputCommand, ViewportCommand};

use crate::base::shapes::shape_name;
use crate::base::texts::Texts;
use crate::base::theme;
use crate::panels::viewport;
use crate::shell::help::HelpTopic;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::MessageDialog;
use crate::shell::{
    audit, camera, card, compare, documents, images, measure, palette, pictures, render_dialog,
};
use crate::state::command::{
    AddCommand, CameraCommand, Command, DisplayCommand, HelpCommand, PictureCommand, SelectionCommand,
    ToolCommand, WindowCommand, ZoomStep,
};
use crate::state::layout::{self, Pane};
use crate::state::methods;
use crate::state::refusal;

/// Does `command`.
pub(crate) fn run(context: &Context, studio: &mut Studio, command: Command) {
    match command {
        Command::File(act) => documents::run(context, studio, act),
        Command::Picture(act) => picture(context, studio, act),
        Command::Edit(action) => apply(studio, action),
        Command::Selection(act) => selection(context, studio, act),
        Command::Add(act) => add(studio, act),
        Command::Camera(act) => look(context, studio, act),
        Command::Display(act) => display(studio, act),
        Command::Tool(act) => match act {
            ToolCommand::Take(tool) => studio.view.take_tool(tool),
            ToolCommand::AimLight => studio.view.toggle_aiming(),
            ToolCommand::ToggleGizmoSpace => studio.view.is_gizmo_local = !studio.view.is_gizmo_local,
        },
        Command::Audit(act) => audit::run(context, studio, act),
        Command::Compare(act) => compare::run(studio, act),
        Command::Measure(act) => measure::run(context, studio, act),
        Command::Window(act) => window(context, studio, act),
        Command::Help(act) => explain(context, studio, act),
    }
}

fn picture(context: &Context, studio: &mut Studio, act: PictureCommand) {
    match act {
        PictureCommand::Render => render_dialog::open(studio),
        PictureCommand::RenderShown => pictures::start_shown(studio),
        PictureCommand::Copy => pictures::copy_viewport(context, studio),
        PictureCommand::Choose(usage) => images::ask(studio, usage),
    }
}

fn selection(context: &Context, studio: &mut Studio, act: SelectionCommand) {
    match act {
        SelectionCommand::Copy => copy(context, studio),
        SelectionCommand::Cut => {
            copy(context, studio);
            apply(studio, Action::Cut);
        }
        // The text comes with a later event; see `shortcuts`.
        SelectionCommand::Paste => {
            studio.keys.is_paste_asked = true;
            context.send_viewport_cmd(ViewportCommand::RequestPaste);
        }
        SelectionCommand::Rename => rename(studio),
    }
}

/// Adds something to the scene where it is seen, with a name in the language of the window.
fn add(studio: &mut Studio, act: AddCommand) {
    let named = |key: &str| studio.texts.get(key).to_owned();
    let (scene, view, seen, live) =
        (studio.editor.scene(), &studio.view, &studio.panes.viewport, &studio.live);
    let action = match act {
        AddCommand::Body(shape) => {
            let placement = viewport::placement_for_body(scene, view, seen, live, shape);
            Action::AddBody { shape, placement, name: named(shape_name(shape)) }
        }
        AddCommand::Light => Action::AddLight {
            at: viewport::place_for_light(scene, view, seen, live),
            name: named("name-light"),
        },
        AddCommand::Material => Action::AddMaterial { name: named("name-material") },
    };
    apply(studio, action);
}

fn look(context: &Context, studio: &mut Studio, act: CameraCommand) {
    match act {
        CameraCommand::ToggleFreeView => camera::toggle_free(studio),
        CameraCommand::FromView => {
            if let Some(camera) = studio.view.free_camera.take() {
                camera::set_scene_camera(studio, "edit-camera-from-view", camera);
            }
        }
        CameraCommand::FrameSelection => camera::frame(studio, false),
        CameraCommand::FrameAll => camera::frame(studio, true),
        CameraCommand::LookAlong(axis) => camera::look_along(studio, axis),
        CameraCommand::ToggleProjection => {
            let camera = studio.view.camera(studio.editor.scene());
            camera::set_camera(studio, "edit-projection", navigate::toggle_projection(&camera));
        }
        CameraCommand::ToggleFly => {
            studio.view.is_flying = !studio.view.is_flying;
            // The keys of flight must not choose rows of a list.
            context.memory_mut(egui::Memory::stop_text_input);
        }
    }
}

fn display(studio: &mut Studio, act: DisplayCommand) {
    let settings = &mut studio.settings;
    match act {
        DisplayCommand::Method(kind) => settings.methods.choose(kind),
        DisplayCommand::Show(shows) => {
            if methods::has(&settings.methods.method(), shows) {
                studio.view.shows = shows;
            }
        }
        DisplayCommand::Map(kind) => studio.maps.kind = kind,
        DisplayCommand::ToggleExact => studio.exact.is_on = !studio.exact.is_on,
        DisplayCommand::ToggleGrid => settings.shows_grid = !settings.shows_grid,
        DisplayCommand::ToggleHandles => settings.shows_handles = !settings.shows_handles,
        DisplayCommand::ToggleCard => card::toggle(studio),
    }
}

fn window(context: &Context, studio: &mut Studio, act: WindowCommand) {
    match act {
        WindowCommand::TogglePane(pane) => toggle(studio, pane),
        WindowCommand::ResetLayout => studio.spare_layouts.reset(&mut studio.layout),
        WindowCommand::Zoom(step) => zoom(context, studio, step),
        WindowCommand::Theme(theme) => {
            studio.settings.theme = theme;
            theme::choose(context, theme);
        }
        WindowCommand::Language(language) => {
            studio.settings.language = language;
            studio.texts = Texts::new(language);
        }
        WindowCommand::Palette => open_palette(context, studio),
        WindowCommand::FocusMenu => studio.menu_focus.toggle(context),
    }
}

/// Opens what explains the studio or the scene.
fn explain(context: &Context, studio: &mut Studio, act: HelpCommand) {
    match act {
        HelpCommand::Manual => studio.manual.open(context),
        HelpCommand::ExampleNote => toggle_example_note(studio),
        HelpCommand::Shortcuts => studio.help.open(context, HelpTopic::Shortcuts),
        HelpCommand::Terms => studio.help.open(context, HelpTopic::Terms),
        HelpCommand::About => studio.help.open(context, HelpTopic::About),
        HelpCommand::FirstSteps => open_first_steps(studio),
    }
}

/// Opens the palette with everything that can be found in it.
fn open_palette(context: &Context, studio: &mut Studio) {
    let entries = palette::entries(context, studio.situation());
    studio.palette.open(entries);
}

/// Opens or closes the note about the example; where it has no room, a dialog says the same.
fn toggle_example_note(studio: &mut Studio) {
    if let Some((title, text)) = studio.panes.example_note.toggle(&studio.texts) {
        studio.dialogs.open(MessageDialog::new(title, text));
    }
}

/// Shows the hint of the first start from its beginning.
fn open_first_steps(studio: &mut Studio) {
    let mut steps = std::mem::take(&mut studio.first_steps);
    steps.open(&mut studio.cx());
    studio.first_steps = steps;
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
    let part = studio.editor.selection().part().unwrap_or(PartPath::WHOLE);
    studio.panes.outliner.rename(studio.editor.edited(), item, part);
}

/// Does an action; a notice gives the reason if it cannot be done.
fn apply(studio: &mut Studio, mut action: Action) {
    if let Action::Join { shape, name } = &mut action
        && name.is_empty()
    {
        studio.texts.get(shape_name(*shape)).clone_into(name);
    }
    let is_of_material = matches!(action, Action::AssignMaterial(_));
    let Err(error) = studio.editor.apply(action) else { return };
    let no_body = is_of_material && matches!(error, ActionError::NothingSelected);
    let refused = if no_body {
        Some(studio.texts.get("refused-no-body-selected").to_owned())
    } else {
        refusal::of_action(&studio.texts, &error)
    };
    if let Some(text) = refused {
        studio.toasts.warning(text);
    }
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
