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
    AddCommand, AuditCommand, CameraCommand, Command, CommandGroup, CommandStyle, CompareCommand,
    DisplayCommand, FileCommand, HelpCommand, MeasureCommand, PictureCommand, SelectionCommand, Tool,
    ToolCommand, WindowCommand, ZoomStep, join,
};
use crate::base::texts::Language;
use crate::base::theme::Theme;
use crate::state::layout::Pane;

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

/// One command a line: its name, what it is, its message, its icon, its shortcuts.
macro_rules! rows {
    ($($group:ident: { $($name:literal: $sum:ident($act:expr) => $key:literal, $icon:ident $(, $shortcut:expr)*;)+ })+) => {
        &[$($(
            CommandRow {
                command: Command::$sum($act),
                look: CommandStyle {
                    name: $name,
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
        "file.new": File(FileCommand::New) => "command-new", ICON_NOTE_ADD, ctrl(Key::N);
        "file.open": File(FileCommand::Open) => "command-open", ICON_FOLDER_OPEN, ctrl(Key::O);
        "file.examples": File(FileCommand::Examples) => "command-examples", ICON_PHOTO_LIBRARY, ctrl(Key::E);
        "file.save": File(FileCommand::Save) => "command-save", ICON_SAVE, ctrl(Key::S);
        "file.save-as": File(FileCommand::SaveAs) => "command-save-as", ICON_SAVE_AS, ctrl_shift(Key::S);
        "file.read-otherwise": File(FileCommand::ReadOtherwise) => "command-read-otherwise", ICON_TRANSLATE;
        "file.revert": File(FileCommand::Revert) => "command-revert", ICON_SETTINGS_BACKUP_RESTORE;
        "file.copy-link": File(FileCommand::CopyLink) => "command-copy-link", ICON_SHARE;
        "picture.render": Picture(PictureCommand::Render) => "command-render", ICON_PHOTO_CAMERA, ctrl(Key::R), plain(Key::F12);
        "picture.render-shown": Picture(PictureCommand::RenderShown) => "command-render-shown", ICON_PHOTO_CAMERA_BACK;
        "picture.copy": Picture(PictureCommand::Copy) => "command-copy-picture", ICON_PHOTO_PRINTS, ctrl_shift(Key::C);
        "file.quit": File(FileCommand::Quit) => "command-quit", ICON_LOGOUT, ctrl(Key::Q);
    }
    Edit: {
        "edit.undo": Edit(Action::Undo) => "command-undo", ICON_UNDO, ctrl(Key::Z);
        "edit.redo": Edit(Action::Redo) => "command-redo", ICON_REDO, ctrl_shift(Key::Z), ctrl(Key::Y);
        "edit.cut": Selection(SelectionCommand::Cut) => "command-cut", ICON_CONTENT_CUT, ctrl(Key::X);
        "edit.copy": Selection(SelectionCommand::Copy) => "command-copy", ICON_CONTENT_COPY, ctrl(Key::C);
        "edit.paste": Selection(SelectionCommand::Paste) => "command-paste", ICON_CONTENT_PASTE, ctrl(Key::V);
        "edit.duplicate": Edit(Action::Duplicate) => "command-duplicate", ICON_TAB_DUPLICATE, ctrl(Key::D);
        "edit.delete": Edit(Action::Delete) => "command-delete", ICON_DELETE, plain(Key::Delete), plain(Key::Backspace);
        "edit.rename": Selection(SelectionCommand::Rename) => "command-rename", ICON_EDIT, plain(Key::F2);
        "edit.toggle-hidden": Edit(Action::ToggleHidden) => "command-toggle-hidden", ICON_VISIBILITY_OFF, plain(Key::H);
        "edit.show-all": Edit(Action::ShowAll) => "command-show-all", ICON_VISIBILITY, alt(Key::H);
        "edit.toggle-locked": Edit(Action::ToggleLocked) => "command-toggle-locked", ICON_LOCK, plain(Key::L);
        "edit.unlock-all": Edit(Action::UnlockAll) => "command-unlock-all", ICON_LOCK_OPEN, alt(Key::L);
        "edit.move-up": Edit(Action::MoveUp) => "command-move-up", ICON_ARROW_UPWARD, alt(Key::ArrowUp);
        "edit.move-down": Edit(Action::MoveDown) => "command-move-down", ICON_ARROW_DOWNWARD, alt(Key::ArrowDown);
        "edit.drop-to-ground": Edit(Action::DropToGround) => "command-drop-to-ground", ICON_VERTICAL_ALIGN_BOTTOM, plain(Key::End);
        "edit.reset-placement": Edit(Action::ResetPlacement) => "command-reset-placement", ICON_RESTART_ALT;
        "edit.join-union": Edit(join(ShapeKind::Union)) => "command-join-union", ICON_JOIN_FULL;
        "edit.join-intersection": Edit(join(ShapeKind::Intersection)) => "command-join-intersection", ICON_JOIN_INNER;
        "edit.join-difference": Edit(join(ShapeKind::Difference)) => "command-join-difference", ICON_JOIN_LEFT;
        "edit.join-surface": Edit(join(ShapeKind::Surface)) => "command-join-surface", ICON_LINE_CURVE;
        "edit.join-group": Edit(join(ShapeKind::Group)) => "command-join-group", ICON_GROUP_WORK;
        "edit.take-apart": Edit(Action::TakeApart) => "command-take-apart", ICON_CALL_SPLIT;
        "edit.duplicate-as-instance": Edit(Action::DuplicateAsInstance) => "command-duplicate-as-instance", ICON_LINKED_SERVICES, alt(Key::D);
        "edit.make-own": Edit(Action::MakeOwn) => "command-make-own", ICON_LINK_OFF;
        "edit.nest": Edit(Action::Nest(None)) => "command-nest", ICON_SUBDIRECTORY_ARROW_RIGHT;
        "edit.take-out": Edit(Action::TakeOut(None)) => "command-take-out", ICON_MOVE_ITEM;
        "edit.material-of-whole": Edit(Action::MaterialOfWhole) => "command-material-of-whole", ICON_IMAGESEARCH_ROLLER;
        "edit.share-material": Edit(Action::ShareMaterial) => "command-share-material", ICON_LINK;
        "edit.make-material-unique": Edit(Action::MakeMaterialUnique) => "command-make-material-unique", ICON_FORMAT_PAINT;
        "edit.remove-unused-materials": Edit(Action::RemoveUnusedMaterials) => "command-remove-unused-materials", ICON_CLEANING_SERVICES;
    }
    Select: {
        "select.all": Edit(Action::SelectAll) => "command-select-all", ICON_SELECT_ALL, ctrl(Key::A);
        "select.none": Edit(Action::SelectNone) => "command-select-none", ICON_DESELECT, ctrl_shift(Key::A);
        "select.invert": Edit(Action::InvertSelection) => "command-invert-selection", ICON_INVERT_COLORS, ctrl(Key::I);
        "select.next": Edit(Action::SelectNext) => "command-select-next", ICON_ARROW_FORWARD, plain(Key::CloseBracket);
        "select.previous": Edit(Action::SelectPrevious) => "command-select-previous", ICON_ARROW_BACK, plain(Key::OpenBracket);
        "select.part": Edit(Action::SelectPart) => "command-select-part", ICON_CHEVRON_RIGHT;
        "select.whole": Edit(Action::SelectWhole) => "command-select-whole", ICON_CHEVRON_LEFT;
    }
    Add: {
        "add.sphere": Add(AddCommand::Body(ShapeKind::Sphere)) => "command-add-sphere", ICON_CIRCLE;
        "add.cube": Add(AddCommand::Body(ShapeKind::Cube)) => "command-add-cube", ICON_DEPLOYED_CODE;
        "add.cylinder": Add(AddCommand::Body(ShapeKind::Cylinder)) => "command-add-cylinder", ICON_DATABASE;
        "add.cone": Add(AddCommand::Body(ShapeKind::Cone)) => "command-add-cone", ICON_CHANGE_HISTORY;
        "add.paraboloid": Add(AddCommand::Body(ShapeKind::Paraboloid)) => "command-add-paraboloid", ICON_SHIELD;
        "add.plane": Add(AddCommand::Body(ShapeKind::Plane)) => "command-add-plane", ICON_GRID_ON;
        "add.lens": Add(AddCommand::Body(ShapeKind::Lens)) => "command-add-lens", ICON_EYEGLASSES;
        "add.mirror-dish": Add(AddCommand::Body(ShapeKind::MirrorDish)) => "command-add-mirror-dish", ICON_SATELLITE_ALT;
        "add.tube": Add(AddCommand::Body(ShapeKind::Tube)) => "command-add-tube", ICON_TOLL;
        "add.ring": Add(AddCommand::Body(ShapeKind::Ring)) => "command-add-ring", ICON_TRIP_ORIGIN;
        "add.bowl": Add(AddCommand::Body(ShapeKind::Bowl)) => "command-add-bowl", ICON_RICE_BOWL;
        "add.prism": Add(AddCommand::Body(ShapeKind::Prism)) => "command-add-prism", ICON_HEXAGON;
        "add.wedge": Add(AddCommand::Body(ShapeKind::Wedge)) => "command-add-wedge", ICON_SIGNAL_CELLULAR_0_BAR;
        "add.open-cylinder": Add(AddCommand::Body(ShapeKind::OpenCylinder)) => "command-add-open-cylinder", ICON_DATA_ARRAY;
        "add.open-cone": Add(AddCommand::Body(ShapeKind::OpenCone)) => "command-add-open-cone", ICON_FILTER_ALT;
        "add.disc": Add(AddCommand::Body(ShapeKind::Disc)) => "command-add-disc", ICON_ALBUM;
        "add.rectangle": Add(AddCommand::Body(ShapeKind::Rectangle)) => "command-add-rectangle", ICON_RECTANGLE;
        "add.triangle": Add(AddCommand::Body(ShapeKind::Triangle)) => "command-add-triangle", ICON_DETAILS;
        "add.light": Add(AddCommand::Light) => "command-add-light", ICON_LIGHTBULB;
        "add.material": Add(AddCommand::Material) => "command-add-material", ICON_PALETTE;
    }
    View: {
        "view.frame-selection": Camera(CameraCommand::FrameSelection) => "command-frame-selection", ICON_CENTER_FOCUS_STRONG, plain(Key::F);
        "view.frame-all": Camera(CameraCommand::FrameAll) => "command-frame-all", ICON_FIT_SCREEN, plain(Key::Home);
        "view.look.front": Camera(CameraCommand::LookAlong(ViewSide::Front)) => "command-look-front", ICON_VIEW_IN_AR, plain(Key::Num1);
        "view.look.back": Camera(CameraCommand::LookAlong(ViewSide::Back)) => "command-look-back", ICON_VIEW_IN_AR, shift(Key::Num1);
        "view.look.right": Camera(CameraCommand::LookAlong(ViewSide::Right)) => "command-look-right", ICON_VIEW_IN_AR, plain(Key::Num3);
        "view.look.left": Camera(CameraCommand::LookAlong(ViewSide::Left)) => "command-look-left", ICON_VIEW_IN_AR, shift(Key::Num3);
        "view.look.top": Camera(CameraCommand::LookAlong(ViewSide::Top)) => "command-look-top", ICON_VIEW_IN_AR, plain(Key::Num7);
        "view.look.bottom": Camera(CameraCommand::LookAlong(ViewSide::Bottom)) => "command-look-bottom", ICON_VIEW_IN_AR, shift(Key::Num7);
        "view.projection": Camera(CameraCommand::ToggleProjection) => "command-toggle-projection", ICON_CAMERASWITCH, plain(Key::Num5);
        "view.free-view": Camera(CameraCommand::ToggleFreeView) => "command-toggle-free-view", ICON_360, plain(Key::Num0);
        "view.camera-from-view": Camera(CameraCommand::FromView) => "command-camera-from-view", ICON_VIDEOCAM, ctrl_alt(Key::Num0);
        "view.fly": Camera(CameraCommand::ToggleFly) => "command-toggle-fly", ICON_FLIGHT, shift(Key::F);
        "view.method.whitted": Display(DisplayCommand::Method(MethodKind::Whitted)) => "command-method-whitted", ICON_FLARE, ctrl(Key::Num1);
        "view.method.ssr": Display(DisplayCommand::Method(MethodKind::Ssr)) => "command-method-ssr", ICON_SCREENSHOT_MONITOR, ctrl(Key::Num2);
        "view.method.cube-map": Display(DisplayCommand::Method(MethodKind::CubeMap)) => "command-method-cube-map", ICON_VRPANO, ctrl(Key::Num3);
        "view.method.phong": Display(DisplayCommand::Method(MethodKind::Phong)) => "command-method-phong", ICON_BLUR_LINEAR, ctrl(Key::Num4);
        "view.method.gouraud": Display(DisplayCommand::Method(MethodKind::Gouraud)) => "command-method-gouraud", ICON_GRADIENT, ctrl(Key::Num5);
        "view.method.flat": Display(DisplayCommand::Method(MethodKind::Flat)) => "command-method-flat", ICON_CATEGORY, ctrl(Key::Num6);
        "view.show.picture": Display(DisplayCommand::Show(DisplayContent::Picture)) => "command-show-picture", ICON_LAYERS;
        "view.show.depth": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Depth))) => "command-show-depth", ICON_LAYERS;
        "view.show.normal": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Normal))) => "command-show-normal", ICON_LAYERS;
        "view.show.body": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Body))) => "command-show-body", ICON_LAYERS;
        "view.show.color": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Color))) => "command-show-color", ICON_LAYERS;
        "view.show.coefficients": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Coefficients))) => "command-show-coefficients", ICON_LAYERS;
        "view.show.lit": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Lit))) => "command-show-lit", ICON_LAYERS;
        "view.show.reflected": Display(DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Reflected))) => "command-show-reflected", ICON_LAYERS;
        "view.show.unfolded": Display(DisplayCommand::Show(DisplayContent::UnfoldedCube(None))) => "command-show-unfolded", ICON_LAYERS;
    }
    Tool: {
        "tool.move": Tool(ToolCommand::Take(Tool::Move)) => "command-tool-move", ICON_OPEN_WITH, plain(Key::W);
        "tool.rotate": Tool(ToolCommand::Take(Tool::Rotate)) => "command-tool-rotate", ICON_AUTORENEW, plain(Key::E);
        "tool.scale": Tool(ToolCommand::Take(Tool::Scale)) => "command-tool-scale", ICON_ZOOM_OUT_MAP, plain(Key::R);
        "tool.aim-light": Tool(ToolCommand::AimLight) => "command-aim-light", ICON_HIGHLIGHT, shift(Key::L);
        "tool.gizmo-space": Tool(ToolCommand::ToggleGizmoSpace) => "command-toggle-gizmo-space", ICON_PUBLIC, plain(Key::X);
        "view.grid": Display(DisplayCommand::ToggleGrid) => "command-toggle-grid", ICON_GRID_4X4, plain(Key::G);
        "view.card": Display(DisplayCommand::ToggleCard) => "command-toggle-card", ICON_MEMORY;
        "view.handles": Display(DisplayCommand::ToggleHandles) => "command-toggle-handles", ICON_TOUCH_APP, shift(Key::G);
    }
    Lab: {
        "audit.tool": Audit(AuditCommand::Tool) => "command-audit", ICON_COLORIZE, plain(Key::A);
        "audit.view": Audit(AuditCommand::View) => "command-audit-view", ICON_CENTER_FOCUS_WEAK, shift(Key::A);
        "audit.previous": Audit(AuditCommand::Previous) => "command-audit-previous", ICON_SKIP_PREVIOUS, plain(Key::Comma);
        "audit.next": Audit(AuditCommand::Next) => "command-audit-next", ICON_SKIP_NEXT, plain(Key::Period);
        "audit.all": Audit(AuditCommand::All) => "command-audit-all", ICON_DONE_ALL;
        "audit.play": Audit(AuditCommand::Play) => "command-audit-play", ICON_SLOW_MOTION_VIDEO, plain(Key::P);
        "audit.copy": Audit(AuditCommand::Copy) => "command-audit-copy", ICON_CONTENT_COPY;
        "audit.save": Audit(AuditCommand::Save) => "command-audit-save", ICON_SAVE;
        "audit.release": Audit(AuditCommand::Release) => "command-audit-release", ICON_CLOSE;
        "view.exact": Display(DisplayCommand::ToggleExact) => "command-exact", ICON_ADJUST, alt(Key::E);
        "view.map.none": Display(DisplayCommand::Map(None)) => "command-map-none", ICON_WALLPAPER, alt(Key::Num0);
        "view.map.generations": Display(DisplayCommand::Map(Some(MapKind::Generations))) => "command-map-generations", ICON_STACKS, alt(Key::Num1);
        "view.map.rays": Display(DisplayCommand::Map(Some(MapKind::Rays))) => "command-map-rays", ICON_NETWORK_NODE, alt(Key::Num2);
        "view.map.limit-loss": Display(DisplayCommand::Map(Some(MapKind::LimitLoss))) => "command-map-limit-loss", ICON_LAYERS_CLEAR, alt(Key::Num3);
        "view.map.threshold-loss": Display(DisplayCommand::Map(Some(MapKind::ThresholdLoss))) => "command-map-threshold-loss", ICON_DATA_THRESHOLDING, alt(Key::Num4);
        "view.map.clipped": Display(DisplayCommand::Map(Some(MapKind::Clipped))) => "command-map-clipped", ICON_BRIGHTNESS_ALERT, alt(Key::Num5);
        "compare.swap": Compare(CompareCommand::Swap) => "command-compare-swap", ICON_SWAP_HORIZ;
        "compare.file-a": Compare(CompareCommand::FileA) => "command-compare-file-a", ICON_LOOKS_ONE;
        "compare.file-b": Compare(CompareCommand::FileB) => "command-compare-file-b", ICON_LOOKS_TWO;
        "compare.save": Compare(CompareCommand::Save) => "command-compare-save", ICON_SAVE;
        "measure.vary": Measure(MeasureCommand::Vary(None)) => "command-measure-vary", ICON_SSID_CHART;
        "measure.start": Measure(MeasureCommand::Start) => "command-measure-start", ICON_PLAY_ARROW;
        "measure.stop": Measure(MeasureCommand::Stop) => "command-measure-stop", ICON_STOP;
        "measure.copy": Measure(MeasureCommand::Copy) => "command-measure-copy", ICON_CONTENT_COPY;
        "measure.save": Measure(MeasureCommand::Save) => "command-measure-save", ICON_SAVE;
    }
    Window: {
        "window.pane.outliner": Window(WindowCommand::TogglePane(Pane::Outliner)) => "command-pane-outliner", ICON_ACCOUNT_TREE;
        "window.pane.inspector": Window(WindowCommand::TogglePane(Pane::Inspector)) => "command-pane-inspector", ICON_TUNE;
        "window.pane.history": Window(WindowCommand::TogglePane(Pane::History)) => "command-pane-history", ICON_HISTORY;
        "window.pane.problems": Window(WindowCommand::TogglePane(Pane::Problems)) => "command-pane-problems", ICON_REPORT;
        "window.pane.audit": Window(WindowCommand::TogglePane(Pane::Audit)) => "command-pane-audit", ICON_FUNCTIONS;
        "window.pane.compare": Window(WindowCommand::TogglePane(Pane::Compare)) => "command-pane-compare", ICON_COMPARE, plain(Key::F6);
        "window.pane.measure": Window(WindowCommand::TogglePane(Pane::Measure)) => "command-pane-measure", ICON_TIMER, plain(Key::F7);
        "window.pane.materials": Window(WindowCommand::TogglePane(Pane::Materials)) => "command-pane-materials", ICON_GRID_VIEW,
            plain(Key::M), plain(Key::F8);
        "window.pane.viewport": Window(WindowCommand::TogglePane(Pane::Viewport)) => "command-pane-viewport", ICON_IMAGE;
        "window.reset-layout": Window(WindowCommand::ResetLayout) => "command-reset-layout", ICON_DASHBOARD;
        "window.theme.dark": Window(WindowCommand::Theme(Theme::Dark)) => "command-theme-dark", ICON_DARK_MODE;
        "window.theme.light": Window(WindowCommand::Theme(Theme::Light)) => "command-theme-light", ICON_LIGHT_MODE;
        "window.theme.system": Window(WindowCommand::Theme(Theme::System)) => "command-theme-system", ICON_CONTRAST;
        "window.language.english": Window(WindowCommand::Language(Language::English)) => "command-language-english", ICON_LANGUAGE;
        "window.language.russian": Window(WindowCommand::Language(Language::Russian)) => "command-language-russian", ICON_LANGUAGE;
        "window.zoom.in": Window(WindowCommand::Zoom(ZoomStep::In)) => "command-zoom-in", ICON_ZOOM_IN,
            ctrl(Key::Plus), ctrl(Key::Equals), ctrl_shift(Key::Plus);
        "window.zoom.out": Window(WindowCommand::Zoom(ZoomStep::Out)) => "command-zoom-out", ICON_ZOOM_OUT, ctrl(Key::Minus);
        "window.zoom.normal": Window(WindowCommand::Zoom(ZoomStep::Normal)) => "command-zoom-normal", ICON_SEARCH, ctrl(Key::Num0);
    }
    Help: {
        "window.palette": Window(WindowCommand::Palette) => "command-palette", ICON_TERMINAL, ctrl(Key::P), ctrl_shift(Key::P);
        "help.manual": Help(HelpCommand::Manual) => "command-manual", ICON_MENU_BOOK, shift(Key::F1);
        "help.example-note": Help(HelpCommand::ExampleNote) => "command-example-note", ICON_TIPS_AND_UPDATES;
        "window.focus-menu": Window(WindowCommand::FocusMenu) => "command-focus-menu", ICON_TOOLBAR, plain(Key::F10);
        "help.shortcuts": Help(HelpCommand::Shortcuts) => "command-shortcuts", ICON_KEYBOARD, plain(Key::F1);
        "help.terms": Help(HelpCommand::Terms) => "command-terms", ICON_DICTIONARY;
        "help.first-steps": Help(HelpCommand::FirstSteps) => "command-first-steps", ICON_SCHOOL;
        "help.about": Help(HelpCommand::About) => "command-about", ICON_INFO;
    }
};

#[cfg(test)]
mod tests {
    use std::collections::{HashMap, HashSet};

    use super::*;
    use crate::state::command::JOINS;

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
        let mut expected: Vec<Command> = Vec::new();
        expected.extend(Pane::ALL.map(|pane| WindowCommand::TogglePane(pane).into()));
        let shapes = [ShapeKind::SIMPLE.as_slice(), &ShapeKind::PARAMETRIC].concat();
        expected.extend(shapes.into_iter().map(|shape| AddCommand::Body(shape).into()));
        expected.extend(JOINS.map(Command::Edit));
        expected.extend(ViewSide::ALL.map(|side| CameraCommand::LookAlong(side).into()));
        expected.extend(Language::ALL.map(|language| WindowCommand::Language(language).into()));
        expected.extend(MapKind::ALL.map(|kind| DisplayCommand::Map(Some(kind)).into()));
        let themes = [Theme::Dark, Theme::Light, Theme::System];
        expected.extend(themes.map(|theme| WindowCommand::Theme(theme).into()));
        expected.extend([Tool::Move, Tool::Rotate, Tool::Scale].map(|tool| ToolCommand::Take(tool).into()));
        expected.extend(MethodKind::ALL.map(|kind| DisplayCommand::Method(kind).into()));
        expected.extend(crate::state::methods::ALL_SHOWN.map(|shows| DisplayCommand::Show(shows).into()));
        let steps = [ZoomStep::In, ZoomStep::Out, ZoomStep::Normal];
        expected.extend(steps.map(|step| WindowCommand::Zoom(step).into()));
        for command in expected {
            assert!(all.contains(&&command), "{command:?}");
        }
    }

    #[test]
    fn names_are_unique_and_lead_back_to_their_commands() {
        let mut names = HashSet::new();
        for command in Command::all() {
            let name = command.name().unwrap();
            assert!(names.insert(name), "{name} twice");
            assert_eq!(Command::from_name(name), Some(command));
            let is_word = |word: &str| {
                !word.is_empty() && word.chars().all(|letter| letter.is_ascii_lowercase() || letter == '-')
            };
            assert!(name.contains('.') && name.split('.').all(is_word), "{name}");
        }
        for unknown in ["", "file", "file.", "file.new ", "File.new", "command-new"] {
            assert_eq!(Command::from_name(unknown), None, "{unknown}");
        }
        assert_eq!(Command::from(FileCommand::OpenExample("whitted")).name(), None);
    }

    #[test]
    fn groups_stand_together() {
        let mut groups: Vec<CommandGroup> = ROWS.iter().map(|row| row.look.group).collect();
        groups.dedup();
        assert_eq!(groups, CommandGroup::ALL);
    }
}
