//! The state of the view, which is neither part of the scene nor saved.

use catoptric_editor::Item;
use catoptric_editor::navigate::CachedCameraRange;
use catoptric_live::DisplayContent;
use catoptric_picture::Development;
use catoptric_scene::Camera;

use crate::state::command::Tool;

/// The state of the view: tool, camera, display.
#[derive(Clone, Debug, Default)]
pub(crate) struct ViewState {
    /// Whether the picture is all there is, as on somebody's page.
    pub(crate) is_alone: bool,
    /// What the gizmo does.
    pub(crate) tool: Tool,
    /// Whether clicks in the picture pin pixels for the audit, instead of selecting.
    pub(crate) is_auditing: bool,
    /// Whether drags in the picture move a light by its highlight or its shadow, instead of bodies.
    pub(crate) is_aiming: bool,
    /// Gizmo along the body's own axes instead of the world's.
    pub(crate) is_gizmo_local: bool,
    /// The camera of the free view; `None` looks through the scene's camera, which navigation then moves.
    pub(crate) free_camera: Option<Camera>,
    /// The eye on its way after a jump of the camera: what the picture shows meanwhile. No part of the document.
    pub(crate) eased: Option<Camera>,
    /// How near and how far navigation brings the camera.
    pub(crate) range: CachedCameraRange,
    /// Whether the keys fly the camera.
    pub(crate) is_flying: bool,
    /// What of the drawing is seen.
    pub(crate) shows: DisplayContent,
    /// Exposure and tone curve of the viewport.
    pub(crate) development: Development,
    /// The body under the pointer, in the picture or in the outliner.
    pub(crate) hovered_body: Option<Item>,
    /// The point of a body under the pointer in the picture.
    pub(crate) seen: Option<ProjectedPoint>,
    /// Set by whatever is being dragged, flown or turned in this frame: the picture is then traced coarsely, and the
    /// gesture stays open. Cleared at the start of each frame.
    pub(crate) is_moving: bool,
    /// Whether a final picture is being rendered; the viewport then does not refine.
    pub(crate) is_rendering: bool,
    /// Whether times are being measured; the viewport then waits.
    pub(crate) is_measuring: bool,
}

/// The point of a body under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProjectedPoint {
    /// The place of the body in the scene.
    pub(crate) body: usize,
    /// The angle between the ray and the normal, degrees.
    pub(crate) degrees: f64,
    /// Whether the eye is within the body.
    pub(crate) is_from_inside: bool,
}

impl ViewState {
    /// The camera through which the viewport looks.
    pub(crate) fn camera(&self, scene: &catoptric_scene::Scene) -> Camera {
        self.free_camera.unwrap_or(scene.camera)
    }

    /// Chooses what the gizmo does, and lets the pointer hold things again.
    pub(crate) fn take_tool(&mut self, tool: Tool) {
        self.tool = tool;
        (self.is_auditing, self.is_aiming) = (false, false);
    }

    /// Lets drags aim lights, or no longer.
    pub(crate) fn toggle_aiming(&mut self) {
        self.is_aiming = !self.is_aiming;
        self.is_auditing = false;
    }

    /// Leaves the scene's camera where it is and looks around freely from there, or looks through it again.
    pub(crate) fn toggle_free(&mut self, scene: &catoptric_scene::Scene) {
        self.free_camera = match self.free_camera {
            Some(_) => None,
            None => Some(scene.camera),
        };
    }
}
