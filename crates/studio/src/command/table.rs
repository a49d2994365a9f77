//! The table of commands: names, icons, shortcuts.

use catoptric_editor::Action;
use catoptric_editor::navigate::ViewSide;
use catoptric_lab::maps::MapKind;
use catoptric_live::DisplayContent;
use catoptric_scene::ShapeKind;
use catoptric_tracer::raster::{GBufferLayer, MethodKind};
use egui::{Key, KeyboardShortcut, Modifiers};
use egui_material_icons::icons;

use super::{
    AuditCommand, Command, CommandGroup, CommandStyle, CompareCommand, MeasureCommand, Tool, ZoomStep,
};
use crate::layout::Pane;
use crate::settings::Theme;
use crate::texts::Language;

/// A command with its style.
pub(super) struct CommandRow {
    pub(super) command: Command,
    pub(super) look: CommandStyle,
}

/// The command key: Ctrl, or Cmd on a Mac.
const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

const fn ctrl_alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::ALT), key)
}

const fn alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::ALT, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

const fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

/// One command a line: what, its message, its icon, its shortcuts.
macro_rules! rows {
    ($($group:ident: { $($command:expr => $key:literal, $icon:ident $(, $shortcut:expr)*;)+ })+) => {
        &[$($(
            CommandRow {
                command: $command,
                look: CommandStyle {
                    key: $key,
                    icon: icons::$icon,
                    group: CommandGroup::$group,
                    shortcuts: &[$($shortcut),*],
                },
            },
        )+)+]
    };
}

/// All commands that need nothing to be said besides.
pub(super) static ROWS: &[CommandRow] = rows! {
    File: {
        Command::New => "command-new", ICON_NOTE_ADD, ctrl(Key::N);
        Command::Open => "command-open", ICON_FOLDER_OPEN, ctrl(Key::O);
        Command::Examples => "command-examples", ICON_PHOTO_LIBRARY, ctrl(Key::E);
        Command::Save => "command-save", ICON_SAVE, ctrl(Key::S);
        Command::SaveAs => "command-save-as", ICON_SAVE_AS, ctrl_shift(Key::S);
        Command::Revert => "command-revert", ICON_SETTINGS_BACKUP_RESTORE;
        Command::Render => "command-render", ICON_PHOTO_CAMERA, ctrl(Key::R), plain(Key::F12);
        Command::RenderShown => "command-render-shown", ICON_SAVE_AS;
        Command::CopyPicture => "command-copy-picture", ICON_IMAGE, ctrl_shift(Key::C);
        Command::Quit => "command-quit", ICON_LOGOUT, ctrl(Key::Q);
    }
    Edit: {
        Command::Edit(Action::Undo) => "command-undo", ICON_UNDO, ctrl(Key::Z);
        Command::Edit(Action::Redo) => "command-redo", ICON_REDO, ctrl_shift(Key::Z), ctrl(Key::Y);
        Command::Cut => "command-cut", ICON_CONTENT_CUT, ctrl(Key::X);
        Command::Copy => "command-copy", ICON_CONTENT_COPY, ctrl(Key::C);
        Command::Paste => "command-paste", ICON_CONTENT_PASTE, ctrl(Key::V);
        Command::Edit(Action::Duplicate) => "command-duplicate", ICON_TAB_DUPLICATE, ctrl(Key::D);
        Command::Edit(Action::Delete) => "command-delete", ICON_DELETE, plain(Key::Delete), plain(Key::Backspace);
        Command::Rename => "command-rename", ICON_EDIT, plain(Key::F2);
        Command::Edit(Action::ToggleHidden) => "command-toggle-hidden", ICON_VISIBILITY_OFF, plain(Key::H);
        Command::Edit(Action::ShowAll) => "command-show-all", ICON_VISIBILITY, alt(Key::H);
        Command::Edit(Action::ToggleLocked) => "command-toggle-locked", ICON_LOCK, plain(Key::L);
        Command::Edit(Action::UnlockAll) => "command-unlock-all", ICON_LOCK_OPEN, alt(Key::L);
        Command::Edit(Action::MoveUp) => "command-move-up", ICON_ARROW_UPWARD, alt(Key::ArrowUp);
        Command::Edit(Action::MoveDown) => "command-move-down", ICON_ARROW_DOWNWARD, alt(Key::ArrowDown);
        Command::Edit(Action::DropToGround) => "command-drop-to-ground", ICON_VERTICAL_ALIGN_BOTTOM, plain(Key::End);
        Command::Edit(Action::ResetPlacement) => "command-reset-placement", ICON_RESTART_ALT;
        Command::Edit(Action::ShareMaterial) => "command-share-material", ICON_LINK;
        Command::Edit(Action::MakeMaterialUnique) => "command-make-material-unique", ICON_LINK_OFF;
        Command::Edit(Action::RemoveUnusedMaterials) => "command-remove-unused-materials", ICON_CLEANING_SERVICES;
    }
    Select: {
        Command::Edit(Action::SelectAll) => "command-select-all", ICON_SELECT_ALL, ctrl(Key::A);
        Command::Edit(Action::SelectNone) => "command-select-none", ICON_DESELECT, ctrl_shift(Key::A);
        Command::Edit(Action::InvertSelection) => "command-invert-selection", ICON_INVERT_COLORS, ctrl(Key::I);
        Command::Edit(Action::SelectNext) => "command-select-next", ICON_ARROW_FORWARD, plain(Key::CloseBracket);
        Command::Edit(Action::SelectPrevious) => "command-select-previous", ICON_ARROW_BACK, plain(Key::OpenBracket);
    }
    Add: {
        Command::AddBody(ShapeKind::Sphere) => "command-add-sphere", ICON_CIRCLE;
        Command::AddBody(ShapeKind::Cube) => "command-add-cube", ICON_DEPLOYED_CODE;
        Command::AddBody(ShapeKind::Cylinder) => "command-add-cylinder", ICON_DATABASE;
        Command::AddBody(ShapeKind::Cone) => "command-add-cone", ICON_CHANGE_HISTORY;
        Command::AddBody(ShapeKind::Paraboloid) => "command-add-paraboloid", ICON_RICE_BOWL;
        Command::AddBody(ShapeKind::Plane) => "command-add-plane", ICON_CROP_LANDSCAPE;
        Command::AddLight => "command-add-light", ICON_LIGHTBULB;
        Command::AddMaterial => "command-add-material", ICON_PALETTE;
    }
    View: {
        Command::FrameSelection => "command-frame-selection", ICON_CENTER_FOCUS_STRONG, plain(Key::F);
        Command::FrameAll => "command-frame-all", ICON_FIT_SCREEN, plain(Key::Home);
        Command::LookAlong(ViewSide::Front) => "command-look-front", ICON_VIEW_IN_AR, plain(Key::Num1);
        Command::LookAlong(ViewSide::Back) => "command-look-back", ICON_VIEW_IN_AR, shift(Key::Num1);
        Command::LookAlong(ViewSide::Right) => "command-look-right", ICON_VIEW_IN_AR, plain(Key::Num3);
        Command::LookAlong(ViewSide::Left) => "command-look-left", ICON_VIEW_IN_AR, shift(Key::Num3);
        Command::LookAlong(ViewSide::Top) => "command-look-top", ICON_VIEW_IN_AR, plain(Key::Num7);
        Command::LookAlong(ViewSide::Bottom) => "command-look-bottom", ICON_VIEW_IN_AR, shift(Key::Num7);
        Command::ToggleProjection => "command-toggle-projection", ICON_CAMERASWITCH, plain(Key::Num5);
        Command::ToggleFreeView => "command-toggle-free-view", ICON_360, plain(Key::Num0);
        Command::CameraFromView => "command-camera-from-view", ICON_VIDEOCAM, ctrl_alt(Key::Num0);
        Command::ToggleFly => "command-toggle-fly", ICON_FLIGHT, shift(Key::F);
        Command::Method(MethodKind::Whitted) => "command-method-whitted", ICON_FLARE, ctrl(Key::Num1);
        Command::Method(MethodKind::Ssr) => "command-method-ssr", ICON_SCREENSHOT_MONITOR, ctrl(Key::Num2);
        Command::Method(MethodKind::CubeMap) => "command-method-cube-map", ICON_DEPLOYED_CODE, ctrl(Key::Num3);
        Command::Method(MethodKind::Phong) => "command-method-phong", ICON_BLUR_LINEAR, ctrl(Key::Num4);
        Command::Method(MethodKind::Gouraud) => "command-method-gouraud", ICON_GRADIENT, ctrl(Key::Num5);
        Command::Method(MethodKind::Flat) => "command-method-flat", ICON_CATEGORY, ctrl(Key::Num6);
        Command::Show(DisplayContent::Picture) => "command-show-picture", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Depth)) => "command-show-depth", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Normal)) => "command-show-normal", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Body)) => "command-show-body", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Color)) => "command-show-color", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Coefficients)) => "command-show-coefficients", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Lit)) => "command-show-lit", ICON_LAYERS;
        Command::Show(DisplayContent::Layer(GBufferLayer::Reflected)) => "command-show-reflected", ICON_LAYERS;
        Command::Show(DisplayContent::UnfoldedCube(None)) => "command-show-unfolded", ICON_LAYERS;
    }
    Tool: {
        Command::Tool(Tool::Move) => "command-tool-move", ICON_OPEN_WITH, plain(Key::W);
        Command::Tool(Tool::Rotate) => "command-tool-rotate", ICON_AUTORENEW, plain(Key::E);
        Command::Tool(Tool::Scale) => "command-tool-scale", ICON_ZOOM_OUT_MAP, plain(Key::R);
        Command::AimLight => "command-aim-light", ICON_HIGHLIGHT, shift(Key::L);
        Command::ToggleGizmoSpace => "command-toggle-gizmo-space", ICON_PUBLIC, plain(Key::X);
        Command::ToggleGrid => "command-toggle-grid", ICON_GRID_4X4, plain(Key::G);
        Command::ToggleCard => "command-toggle-card", ICON_MEMORY;
        Command::ToggleHandles => "command-toggle-handles", ICON_TOUCH_APP, shift(Key::G);
    }
    Lab: {
        Command::Audit(AuditCommand::Tool) => "command-audit", ICON_COLORIZE, plain(Key::A);
        Command::Audit(AuditCommand::View) => "command-audit-view", ICON_CENTER_FOCUS_WEAK, shift(Key::A);
        Command::Audit(AuditCommand::Previous) => "command-audit-previous", ICON_SKIP_PREVIOUS, plain(Key::Comma);
        Command::Audit(AuditCommand::Next) => "command-audit-next", ICON_SKIP_NEXT, plain(Key::Period);
        Command::Audit(AuditCommand::All) => "command-audit-all", ICON_DONE_ALL;
        Command::Audit(AuditCommand::Play) => "command-audit-play", ICON_PLAY_ARROW, plain(Key::P);
        Command::Audit(AuditCommand::Copy) => "command-audit-copy", ICON_CONTENT_COPY;
        Command::Audit(AuditCommand::Save) => "command-audit-save", ICON_SAVE_AS;
        Command::Audit(AuditCommand::Release) => "command-audit-release", ICON_CLOSE;
        Command::ToggleExact => "command-exact", ICON_ADJUST, alt(Key::E);
        Command::Map(None) => "command-map-none", ICON_IMAGE, alt(Key::Num0);
        Command::Map(Some(MapKind::Generations)) => "command-map-generations", ICON_STACKS, alt(Key::Num1);
        Command::Map(Some(MapKind::Rays)) => "command-map-rays", ICON_NETWORK_NODE, alt(Key::Num2);
        Command::Map(Some(MapKind::LimitLoss)) => "command-map-limit-loss", ICON_LAYERS_CLEAR, alt(Key::Num3);
        Command::Map(Some(MapKind::ThresholdLoss)) => "command-map-threshold-loss", ICON_FILTER_ALT, alt(Key::Num4);
        Command::Map(Some(MapKind::Clipped)) => "command-map-clipped", ICON_FLARE, alt(Key::Num5);
        Command::Compare(CompareCommand::Swap) => "command-compare-swap", ICON_SWAP_HORIZ;
        Command::Compare(CompareCommand::FileA) => "command-compare-file-a", ICON_IMAGE;
        Command::Compare(CompareCommand::FileB) => "command-compare-file-b", ICON_IMAGE;
        Command::Compare(CompareCommand::Save) => "command-compare-save", ICON_SAVE;
        Command::Measure(MeasureCommand::Start) => "command-measure-start", ICON_PLAY_ARROW;
        Command::Measure(MeasureCommand::Stop) => "command-measure-stop", ICON_STOP;
        Command::Measure(MeasureCommand::Save) => "command-measure-save", ICON_SAVE;
    }
    Window: {
        Command::TogglePane(Pane::Outliner) => "command-pane-outliner", ICON_ACCOUNT_TREE;
        Command::TogglePane(Pane::Inspector) => "command-pane-inspector", ICON_TUNE;
        Command::TogglePane(Pane::History) => "command-pane-history", ICON_HISTORY;
        Command::TogglePane(Pane::Problems) => "command-pane-problems", ICON_REPORT;
        Command::TogglePane(Pane::Audit) => "command-pane-audit", ICON_FUNCTIONS;
        Command::TogglePane(Pane::Compare) => "command-pane-compare", ICON_COMPARE, plain(Key::F6);
        Command::TogglePane(Pane::Measure) => "command-pane-measure", ICON_TIMER, plain(Key::F7);
        Command::TogglePane(Pane::Materials) => "command-pane-materials", ICON_GRID_VIEW,
            plain(Key::M), plain(Key::F8);
        Command::TogglePane(Pane::Viewport) => "command-pane-viewport", ICON_IMAGE;
        Command::ResetLayout => "command-reset-layout", ICON_DASHBOARD;
        Command::Theme(Theme::Dark) => "command-theme-dark", ICON_DARK_MODE;
        Command::Theme(Theme::Light) => "command-theme-light", ICON_LIGHT_MODE;
        Command::Theme(Theme::System) => "command-theme-system", ICON_CONTRAST;
        Command::Language(Language::English) => "command-language-english", ICON_LANGUAGE;
        Command::Language(Language::Russian) => "command-language-russian", ICON_LANGUAGE;
        Command::Zoom(ZoomStep::In) => "command-zoom-in", ICON_ZOOM_IN,
            ctrl(Key::Plus), ctrl(Key::Equals), ctrl_shift(Key::Plus);
        Command::Zoom(ZoomStep::Out) => "command-zoom-out", ICON_ZOOM_OUT, ctrl(Key::Minus);
        Command::Zoom(ZoomStep::Normal) => "command-zoom-normal", ICON_SEARCH, ctrl(Key::Num0);
    }
    Help: {
        Command::Palette => "command-palette", ICON_TERMINAL, ctrl(Key::P), ctrl_shift(Key::P);
        Command::Manual => "command-manual", ICON_MENU_BOOK, shift(Key::F1);
        Command::ExampleNote => "command-example-note", ICON_TIPS_AND_UPDATES;
        Command::FocusMenu => "command-focus-menu", ICON_TOOLBAR, plain(Key::F10);
        Command::Shortcuts => "command-shortcuts", ICON_KEYBOARD, plain(Key::F1);
        Command::Terms => "command-terms", ICON_DICTIONARY;
        Command::FirstSteps => "command-first-steps", ICON_SCHOOL;
        Command::About => "command-about", ICON_INFO;
    }
};

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    #[test]
    fn no_command_stands_twice_and_no_two_share_a_shortcut() {
        let mut owners: HashMap<KeyboardShortcut, &str> = HashMap::new();
        for (place, row) in ROWS.iter().enumerate() {
            let twin = ROWS[..place]
                .iter()
                .find(|other| other.command == row.command || other.look.key == row.look.key);
            assert!(twin.is_none(), "{}", row.look.key);
            for shortcut in row.look.shortcuts {
                let owner = owners.insert(*shortcut, row.look.key);
                assert_eq!(owner, None, "{} {shortcut:?}", row.look.key);
            }
        }
    }

    #[test]
    fn every_panel_shape_view_tool_theme_and_language_has_a_command() {
        let all: Vec<&Command> = Command::all().collect();
        let mut expected: Vec<Command> = Pane::ALL.into_iter().map(Command::TogglePane).collect();
        expected.extend(ShapeKind::ALL.into_iter().map(Command::AddBody));
        expected.extend(ViewSide::ALL.into_iter().map(Command::LookAlong));
        expected.extend(Language::ALL.into_iter().map(Command::Language));
        expected.extend(MapKind::ALL.map(|kind| Command::Map(Some(kind))));
        expected.extend([Theme::Dark, Theme::Light, Theme::System].map(Command::Theme));
        expected.extend([Tool::Move, Tool::Rotate, Tool::Scale].map(Command::Tool));
        expected.extend(MethodKind::ALL.map(Command::Method));
        expected.extend(crate::methods::ALL_SHOWN.map(Command::Show));
        expected.extend([ZoomStep::In, ZoomStep::Out, ZoomStep::Normal].map(Command::Zoom));
        for command in expected {
            assert!(all.contains(&&command), "{command:?}");
        }
    }

    #[test]
    fn groups_stand_together() {
        let mut groups: Vec<CommandGroup> = ROWS.iter().map(|row| row.look.group).collect();
        groups.dedup();
        assert_eq!(groups, CommandGroup::ALL);
    }
}
