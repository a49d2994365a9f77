//! What the page and the studio tell each other, as JSON.

use catoptric_studio::host::LinkOutcome;
use egui::{
    CursorIcon, Event, ImeEvent, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2,
    TouchDeviceId, TouchId, TouchPhase, Vec2,
};
use serde::{Deserialize, Serialize};

/// How the page starts the studio.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct StartOptions {
    /// A number that no other page has.
    pub(crate) page: u32,
    /// The language that the browser asks for, such as `ru-RU`.
    pub(crate) language: String,
    /// Whether the picture stands alone on somebody's page.
    pub(crate) is_embedded: bool,
    /// Whether every frame is drawn as a whole, whatever draws it.
    pub(crate) is_whole: bool,
    /// A built-in example to open.
    pub(crate) example: Option<String>,
    /// What a link holds, instead.
    pub(crate) link: Option<String>,
}

/// What happened on the page. Places are in CSS pixels from the canvas's upper left.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "camelCase", rename_all_fields = "camelCase", deny_unknown_fields)]
pub(crate) enum PageEvent {
    /// The canvas has this size, CSS pixels, with so many pixels of the device in each.
    Size { width: f32, height: f32, ratio: f32 },
    /// The page has the keyboard, or has it no more.
    Focus { focused: bool },
    /// The pointer moved.
    Move { x: f32, y: f32 },
    /// The pointer left the canvas.
    Leave {},
    /// A button was pressed or released, numbered as browsers do.
    Button { x: f32, y: f32, button: u8, pressed: bool, keys: HeldModifiers },
    /// The wheel turned, or fingers scrolled; `mode` as browsers number it.
    Wheel { dx: f32, dy: f32, mode: u8, keys: HeldModifiers },
    /// A finger touched, moved, or was lifted.
    Touch { id: u64, phase: FingerPhase, x: f32, y: f32, is_first: bool },
    /// A key, by what it types and by its place on the keyboard.
    Key { key: String, code: String, pressed: bool, keys: HeldModifiers },
    /// Text was typed.
    Text { text: String },
    /// Text of an input method that may still change.
    Composing { text: String },
    /// Text of an input method.
    Composed { text: String },
    /// The person copied.
    Copy {},
    /// The person cut.
    Cut {},
    /// The person pasted text.
    Paste { text: String },
    /// Files were dropped, which are in the studio's store by now.
    Dropped { paths: Vec<String> },
    /// Files are held over the page, or no more.
    Hovering { count: usize },
    /// The answer to [`PageCommand::AskFile`].
    File { id: u32, path: Option<String> },
    /// The answer to [`PageCommand::Link`].
    Link { outcome: LinkReport },
    /// A command by its name, such as `edit.undo`, from a script of the page.
    Run { command: String },
    /// The browser's colors became dark or light.
    Theme { is_dark: bool },
}

/// What became of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) enum LinkReport {
    Copied,
    TooLong,
    Refused,
}

impl From<LinkReport> for LinkOutcome {
    fn from(report: LinkReport) -> Self {
        match report {
            LinkReport::Copied => Self::Copied,
            LinkReport::TooLong => Self::TooLong,
            LinkReport::Refused => Self::Refused,
        }
    }
}

/// The modifier keys that are held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct HeldModifiers {
    alt: bool,
    ctrl: bool,
    shift: bool,
    meta: bool,
}

/// What became of a finger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) enum FingerPhase {
    Start,
    Move,
    End,
    Cancel,
}

/// What the page is to do.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub(crate) enum PageCommand {
    /// Show this pointer, a value of CSS's `cursor`.
    Cursor { css: &'static str },
    /// Put text into the clipboard.
    Copy { text: String },
    /// Bring the text of the clipboard.
    Paste {},
    /// Open a page.
    Open { url: String, in_new_tab: bool },
    /// Name the page.
    Title { text: String },
    /// Ask the person for a file.
    AskFile(FileRequest),
    /// Put a link to this view of a scene into the clipboard.
    Link { view: String },
    /// Text is typed at this place, CSS pixels, or nowhere.
    TypeAt { place: Option<[f32; 2]> },
}

/// A question for a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct FileRequest {
    /// The number of the question.
    pub(crate) id: u32,
    /// Whether the file is to be written.
    pub(crate) is_saving: bool,
    /// What the question is.
    pub(crate) title: String,
    /// The name to start with.
    pub(crate) name: String,
    /// The usual extensions.
    pub(crate) extensions: Vec<&'static str>,
}

impl HeldModifiers {
    fn modifiers(self) -> Modifiers {
        let Self { alt, ctrl, shift, meta } = self;
        Modifiers { alt, ctrl, shift, mac_cmd: meta, command: ctrl || meta }
    }
}

impl PageEvent {
    /// The modifier keys at the time, where they are known.
    pub(crate) fn modifiers(&self) -> Option<Modifiers> {
        match self {
            Self::Button { keys, .. } | Self::Wheel { keys, .. } | Self::Key { keys, .. } => {
                Some(keys.modifiers())
            }
            _ => None,
        }
    }

    /// What the toolkit is told, in points of so many CSS pixels each.
    pub(crate) fn into_events(self, zoom: f32) -> Vec<Event> {
        let point = |x: f32, y: f32| Pos2::new(x, y) / zoom;
        match self {
            Self::Focus { focused } => vec![Event::WindowFocused(focused)],
            Self::Move { x, y } => vec![Event::PointerMoved(point(x, y))],
            Self::Leave {} => vec![Event::PointerGone],
            Self::Button { x, y, button, pressed, keys } => {
                let event = |button| Event::PointerButton {
                    pos: point(x, y),
                    button,
                    pressed,
                    modifiers: keys.modifiers(),
                };
                pointer_button(button).map(event).into_iter().collect()
            }
            Self::Wheel { dx, dy, mode, keys } => {
                let unit = match mode {
                    1 => MouseWheelUnit::Line,
                    2 => MouseWheelUnit::Page,
                    _ => MouseWheelUnit::Point,
                };
                let zoom = if unit == MouseWheelUnit::Point { zoom } else { 1.0 };
                vec![Event::MouseWheel {
                    unit,
                    // Browsers say where the window goes, the toolkit wants to know where its content does.
                    delta: -Vec2::new(dx, dy) / zoom,
                    phase: TouchPhase::Move,
                    source: MouseWheelSource::Unknown,
                    modifiers: keys.modifiers(),
                }]
            }
            Self::Touch { id, phase, x, y, is_first } => touch(id, phase, point(x, y), is_first),
            Self::Key { key, code, pressed, keys } => {
                let physical_key = Key::from_name(&code);
                let event = |key| Event::Key {
                    key,
                    physical_key,
                    pressed,
                    repeat: false,
                    modifiers: keys.modifiers(),
                };
                // Of other alphabets the place on the keyboard counts.
                Key::from_name(&key).or(physical_key).map(event).into_iter().collect()
            }
            Self::Text { text } => vec![Event::Text(text)],
            Self::Composing { text } => {
                vec![Event::Ime(ImeEvent::Preedit { text, active_range_chars: None })]
            }
            Self::Composed { text } => vec![Event::Ime(ImeEvent::Commit(text))],
            Self::Copy {} => vec![Event::Copy],
            Self::Cut {} => vec![Event::Cut],
            Self::Paste { text } => vec![Event::Paste(text)],
            Self::Size { .. }
            | Self::Dropped { .. }
            | Self::Hovering { .. }
            | Self::File { .. }
            | Self::Link { .. }
            | Self::Run { .. }
            | Self::Theme { .. } => Vec::new(),
        }
    }
}

/// The button that browsers number so.
fn pointer_button(number: u8) -> Option<PointerButton> {
    match number {
        0 => Some(PointerButton::Primary),
        1 => Some(PointerButton::Middle),
        2 => Some(PointerButton::Secondary),
        3 => Some(PointerButton::Extra1),
        4 => Some(PointerButton::Extra2),
        _ => None,
    }
}

/// What the toolkit is told of a finger; the first one is a pointer, too.
fn touch(id: u64, phase: FingerPhase, pos: Pos2, is_first: bool) -> Vec<Event> {
    let button = |pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let (phase, pointer) = match phase {
        FingerPhase::Start => (TouchPhase::Start, vec![Event::PointerMoved(pos), button(true)]),
        FingerPhase::Move => (TouchPhase::Move, vec![Event::PointerMoved(pos)]),
        FingerPhase::End => (TouchPhase::End, vec![button(false), Event::PointerGone]),
        FingerPhase::Cancel => (TouchPhase::Cancel, vec![Event::PointerGone]),
    };
    let mut events = if is_first { pointer } else { Vec::new() };
    events.push(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(id), phase, pos, force: None });
    events
}

/// The value of CSS's `cursor` for a pointer.
pub(crate) const fn css_cursor(icon: CursorIcon) -> &'static str {
    match icon {
        CursorIcon::Default => "default",
        CursorIcon::None => "none",
        CursorIcon::ContextMenu => "context-menu",
        CursorIcon::Help => "help",
        CursorIcon::PointingHand => "pointer",
        CursorIcon::Progress => "progress",
        CursorIcon::Wait => "wait",
        CursorIcon::Cell => "cell",
        CursorIcon::Crosshair => "crosshair",
        CursorIcon::Text => "text",
        CursorIcon::VerticalText => "vertical-text",
        CursorIcon::Alias => "alias",
        CursorIcon::Copy => "copy",
        CursorIcon::Move => "move",
        CursorIcon::NoDrop => "no-drop",
        CursorIcon::NotAllowed => "not-allowed",
        CursorIcon::Grab => "grab",
        CursorIcon::Grabbing => "grabbing",
        CursorIcon::AllScroll => "all-scroll",
        CursorIcon::ResizeHorizontal => "ew-resize",
        CursorIcon::ResizeNeSw => "nesw-resize",
        CursorIcon::ResizeNwSe => "nwse-resize",
        CursorIcon::ResizeVertical => "ns-resize",
        CursorIcon::ResizeEast => "e-resize",
        CursorIcon::ResizeSouthEast => "se-resize",
        CursorIcon::ResizeSouth => "s-resize",
        CursorIcon::ResizeSouthWest => "sw-resize",
        CursorIcon::ResizeWest => "w-resize",
        CursorIcon::ResizeNorthWest => "nw-resize",
        CursorIcon::ResizeNorth => "n-resize",
        CursorIcon::ResizeNorthEast => "ne-resize",
        CursorIcon::ResizeColumn => "col-resize",
        CursorIcon::ResizeRow => "row-resize",
        CursorIcon::ZoomIn => "zoom-in",
        CursorIcon::ZoomOut => "zoom-out",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn events(json: &str, zoom: f32) -> Vec<Event> {
        serde_json::from_str::<PageEvent>(json).unwrap().into_events(zoom)
    }

    #[test]
    fn places_are_in_points() {
        let moved = events(r#"{"type": "move", "x": 30, "y": 15}"#, 1.5);
        assert_eq!(moved, [Event::PointerMoved(Pos2::new(20.0, 10.0))]);
    }

    #[test]
    fn keys_of_other_alphabets_are_those_of_their_places() {
        let json = r#"{"type": "key", "key": "я", "code": "KeyZ", "pressed": true, "keys": {"ctrl": true}}"#;
        let [Event::Key { key: Key::Z, modifiers, .. }] = events(json, 1.0)[..] else { panic!() };
        assert!(modifiers.command && modifiers.ctrl && !modifiers.shift);
        assert_eq!(
            events(r#"{"type": "key", "key": "Dead", "code": "", "pressed": true, "keys": {}}"#, 1.0),
            []
        );
    }

    #[test]
    fn the_wheel_moves_the_content_the_other_way() {
        let json = r#"{"type": "wheel", "dx": 0, "dy": 120, "mode": 0, "keys": {}}"#;
        let [Event::MouseWheel { delta, unit: MouseWheelUnit::Point, .. }] = events(json, 2.0)[..] else {
            panic!()
        };
        assert_eq!(delta, Vec2::new(0.0, -60.0));
    }

    #[test]
    fn the_first_finger_is_a_pointer_and_the_second_is_not() {
        let json = |is_first: bool| {
            format!(r#"{{"type": "touch", "id": 7, "phase": "end", "x": 1, "y": 2, "isFirst": {is_first}}}"#)
        };
        assert_eq!(events(&json(true), 1.0).len(), 3);
        assert!(matches!(events(&json(false), 1.0)[..], [Event::Touch { id: TouchId(7), .. }]));
    }

    #[test]
    fn what_is_no_event_is_refused() {
        for json in ["", "{}", r#"{"type": "move"}"#, r#"{"type": "move", "x": 1, "y": 2, "z": 3}"#] {
            assert!(serde_json::from_str::<PageEvent>(json).is_err(), "{json}");
        }
    }

    #[test]
    fn commands_are_told_as_the_page_reads_them() {
        let told = |command: &PageCommand| serde_json::to_string(command).unwrap();
        let request = FileRequest {
            id: 3,
            is_saving: true,
            title: "Save as".to_owned(),
            name: "a.toml".to_owned(),
            extensions: vec!["toml"],
        };
        let json = r#"{"type":"askFile","id":3,"isSaving":true,"title":"Save as","name":"a.toml","extensions":["toml"]}"#;
        assert_eq!(told(&PageCommand::AskFile(request)), json);
        assert_eq!(told(&PageCommand::TypeAt { place: None }), r#"{"type":"typeAt","place":null}"#);
    }
}
