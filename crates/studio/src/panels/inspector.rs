//! The panel of values of what is selected.

use catoptric_editor::{Label, Selection};
use catoptric_scene::ScenePart;
use egui::{Id, Key, ScrollArea, Ui};

use crate::state::context::Cx;

mod body;
mod camera;
mod curve;
mod depth;
mod energy;
mod formula;
mod header;
mod image;
mod kinds;
mod light;
mod material;
mod material_owner;
mod part;
mod parts;
mod pattern;
mod physical;
mod place;
mod replaced;
mod reshape;
mod sheet;
mod surroundings;
mod symbol;

pub(crate) use kinds::{CoefficientPreset as KindPreset, PRESETS as KINDS};
pub(crate) use material::give_texture;
pub(crate) use physical::told as model_told;
use symbol::Symbol;

/// Below this width, points, the panel scrolls sideways.
const LEAST_WIDTH: f32 = 150.0;

/// The state of the inspector.
#[derive(Default)]
pub(crate) struct Inspector {
    memory: InspectorState,
}

impl Inspector {
    /// Follows the window to another document.
    pub(crate) fn begin_document(&mut self) {
        self.memory.replaced = replaced::ReplacedMaterials::default();
    }
}

/// The state that rows keep and share.
pub(crate) struct InspectorState {
    /// The symbol that is lit, in the formula and in the rows.
    pub(crate) pointed: Option<Symbol>,
    /// The symbol of the row under the pointer in this frame.
    pub(crate) row_hovered: Option<Symbol>,
    /// The symbol in the formula under the pointer in this frame.
    pub(crate) term_hovered: Option<Symbol>,
    /// What was selected in the last frame.
    pub(crate) selection: Selection,
    /// Why the last change was refused.
    pub(crate) note: Option<RefusalNote>,
    /// The last change made here, to know which gesture Escape takes back.
    pub(crate) gesture: Option<Label>,
    /// Whether the present drag was cancelled.
    pub(crate) is_given_up: bool,
    /// Whether the three factors of a scale keep their ratios.
    pub(crate) scale_link: bool,
    /// Whether the edges of a cube do.
    pub(crate) size_link: bool,
    /// The vectors at the start of a gesture.
    pub(crate) starts: sheet::StartVectors,
    /// How many generations the scene needs.
    pub(crate) adviser: depth::DepthAdviser,
    /// The curves of the material that was shown last.
    pub(crate) curves: curve::ReflectanceCurves,
    /// What materials were before their model changed.
    pub(crate) replaced: replaced::ReplacedMaterials,
}

impl Default for InspectorState {
    fn default() -> Self {
        Self {
            pointed: None,
            row_hovered: None,
            term_hovered: None,
            selection: Selection::default(),
            note: None,
            gesture: None,
            is_given_up: false,
            // A body is scaled as a whole at first.
            scale_link: true,
            size_link: false,
            starts: sheet::StartVectors::default(),
            adviser: depth::DepthAdviser::default(),
            curves: curve::ReflectanceCurves::default(),
            replaced: replaced::ReplacedMaterials::default(),
        }
    }
}

/// The reason of a refusal, and the row it belongs to.
#[derive(Clone, Debug)]
pub(crate) struct RefusalNote {
    pub(crate) id: Id,
    pub(crate) key: &'static str,
    pub(crate) text: String,
}

/// Draws the values of what is selected; those of the scene as a whole when nothing is.
pub(crate) fn inspector_ui(ui: &mut Ui, cx: &mut Cx<'_>, inspector: &mut Inspector) {
    let memory = &mut inspector.memory;
    if memory.selection != *cx.editor.selection() {
        memory.selection = cx.editor.selection().clone();
        memory.note = None;
    }
    escape(ui, cx, memory);
    memory.row_hovered = None;
    memory.term_hovered = None;
    // The scroll bar lies over the right edge.
    let width = (ui.available_width() - 8.0).max(LEAST_WIDTH);
    ScrollArea::both().id_salt("inspector").auto_shrink([false, false]).show(ui, |ui| {
        ui.set_width(width);
        ui.spacing_mut().item_spacing.y = 4.0;
        match cx.editor.primary_part() {
            Some(ScenePart::Body(_)) => body::bodies_ui(ui, cx, memory),
            Some(ScenePart::Light(_)) => light::lights_ui(ui, cx, memory),
            Some(ScenePart::Material(index)) => material::named_ui(ui, cx, memory, index),
            Some(ScenePart::Camera) => camera::camera_ui(ui, cx, memory),
            Some(ScenePart::Environment) => surroundings::environment_ui(ui, cx, memory),
            Some(ScenePart::Tracing) => surroundings::tracing_ui(ui, cx, memory),
            None => {
                camera::camera_ui(ui, cx, memory);
                surroundings::environment_ui(ui, cx, memory);
                surroundings::tracing_ui(ui, cx, memory);
            }
        }
        ui.add_space(12.0);
    });
    let pointed = memory.row_hovered.or(memory.term_hovered);
    if pointed != memory.pointed {
        memory.pointed = pointed;
        ui.ctx().request_repaint();
    }
}

/// Escape takes back what is being dragged or typed here.
fn escape(ui: &Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let (is_escaped, is_down) = ui.input(|input| (input.key_pressed(Key::Escape), input.pointer.any_down()));
    memory.is_given_up &= is_down;
    let is_ours = memory.gesture.is_some() && cx.editor.gesture_label() == memory.gesture.as_ref();
    if is_escaped && is_ours {
        cx.editor.abandon();
        memory.gesture = None;
        memory.is_given_up = is_down;
    }
}
