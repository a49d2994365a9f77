//! The camera: where it stands, where it looks, how much it sees.

use std::sync::Arc;

use catoptric_editor::navigate;
use catoptric_scene::format::keys;
use catoptric_scene::format::spec::{KeySpec, Kind, Limits, TableSpec};
use catoptric_scene::{Camera, Projection, ScenePart};
use egui::{Id, Ui};
use glam::DVec3;

use super::sheet::{NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread};
use super::{InspectorState, header};
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::number::{shown, tidy};
use crate::base::widgets::section::section;
use crate::state::context::Cx;

static POSITION: VectorRow<Camera> = VectorRow::<Camera>::new(
    RowQuantity::new("camera-position", "edit-camera-position", &keys::CAMERA, "position")
        .in_unit(Unit::Meters),
    VectorSpread::Same,
    |camera| Some(camera.position),
    |camera, value| camera.position = value,
);

static TARGET: VectorRow<Camera> = VectorRow::<Camera>::new(
    RowQuantity::new("camera-target", "edit-camera-target", &keys::CAMERA, "target").in_unit(Unit::Meters),
    VectorSpread::Same,
    |camera| Some(camera.target),
    |camera, value| camera.target = value,
);

static UP: VectorRow<Camera> = VectorRow::<Camera>::new(
    RowQuantity::new("camera-up", "edit-camera-up", &keys::CAMERA, "up"),
    VectorSpread::Same,
    |camera| Some(camera.up),
    |camera, value| camera.up = value,
);

static FOV: NumberRow<Camera> = NumberRow::<Camera>::new(
    RowQuantity::new("fov", "edit-fov", &keys::CAMERA, "fov").in_unit(Unit::Degrees),
    SliderRail::Even(5.0, 120.0),
    |camera| match camera.projection {
        Projection::Perspective { fov_degrees } => Some(fov_degrees),
        Projection::Parallel { .. } => None,
    },
    |camera, value| camera.projection = Projection::Perspective { fov_degrees: value },
)
.tuned(0.1, 2);

static WINDOW: NumberRow<Camera> = NumberRow::<Camera>::new(
    RowQuantity::new("window-height", "edit-window-height", &keys::CAMERA, "height").in_unit(Unit::Meters),
    SliderRail::None,
    |camera| match camera.projection {
        Projection::Parallel { height } => Some(height),
        Projection::Perspective { .. } => None,
    },
    |camera, value| camera.projection = Projection::Parallel { height: value },
);

/// The direction of view in three numbers. Changing one moves the target; the camera stays.
static DISTANCE: NumberRow<Camera> = NumberRow::<Camera>::new(
    // The limits of a window's height are those of all lengths.
    RowQuantity::new("view-distance", "edit-view-direction", &keys::CAMERA, "height").in_unit(Unit::Meters),
    SliderRail::None,
    |camera| Some(tidy(camera.position.distance(camera.target))),
    |camera, value| look(camera, |view| view.distance = value),
);

static AZIMUTH: NumberRow<Camera> = NumberRow::<Camera>::new(
    RowQuantity::new("view-azimuth", "edit-view-direction", &ANGLES, "azimuth").in_unit(Unit::Degrees),
    SliderRail::Even(-180.0, 180.0),
    |camera| Some(round_angle(CameraAngles::of(camera).azimuth)),
    |camera, value| look(camera, |view| view.azimuth = value),
)
.tuned(0.2, 2);

static ELEVATION: NumberRow<Camera> = NumberRow::<Camera>::new(
    RowQuantity::new("view-elevation", "edit-view-direction", &ANGLES, "elevation").in_unit(Unit::Degrees),
    SliderRail::Even(-90.0, 90.0),
    |camera| Some(round_angle(CameraAngles::of(camera).elevation)),
    |camera, value| look(camera, |view| view.elevation = value),
)
.tuned(0.2, 2);

/// What the angles of view can be; no file has them.
static ANGLES: TableSpec = TableSpec {
    name: "the direction of view",
    doc: "",
    keys: &[
        KeySpec::new("azimuth", Kind::Number(Limits::new(-360.0, 360.0)), ""),
        KeySpec::new("elevation", Kind::Number(Limits::new(-90.0, 90.0)), ""),
    ],
};

/// The direction of a camera as angles.
struct CameraAngles {
    /// Degrees to the right of -Z.
    azimuth: f64,
    /// Degrees above the horizon.
    elevation: f64,
    /// Meters to the target.
    distance: f64,
}

impl CameraAngles {
    fn of(camera: &Camera) -> Self {
        let view = camera.target - camera.position;
        let flat = view.x.hypot(view.z);
        // Straight up or down there is no azimuth.
        let azimuth = if flat == 0.0 { 0.0 } else { view.x.atan2(-view.z).to_degrees() };
        Self { azimuth, elevation: view.y.atan2(flat).to_degrees(), distance: view.length() }
    }

    fn direction(&self) -> DVec3 {
        let (azimuth_sin, azimuth_cos) = self.azimuth.to_radians().sin_cos();
        let (elevation_sin, elevation_cos) = self.elevation.to_radians().sin_cos();
        DVec3::new(azimuth_sin * elevation_cos, elevation_sin, -azimuth_cos * elevation_cos)
    }
}

/// An angle without the noise of its computation.
fn round_angle(degrees: f64) -> f64 {
    (degrees * 1e6).round() / 1e6
}

fn look(camera: &mut Camera, change: impl FnOnce(&mut CameraAngles)) {
    let mut view = CameraAngles::of(camera);
    change(&mut view);
    camera.target = (camera.position + view.distance * view.direction()).map(tidy);
}

/// Draws the values of the camera.
pub(super) fn camera_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let scene = Arc::clone(cx.editor.scene());
    let is_free = cx.view.free_camera.is_some();
    let mut sheet = PropertySheet {
        primary: &scene.camera,
        things: vec![&scene.camera],
        place: ScenePart::Camera.into(),
        subject: String::new(),
        id: Id::unique("inspector-camera"),
        is_free: true,
        apply: &|editor, label, change| editor.change_camera(label, |own| change(0, own)),
        cx,
        memory,
    };
    let texts = sheet.texts();
    section(ui, "camera", texts.get("thing-camera"), "", true, |ui| {
        let note = if is_free { "camera-free-note" } else { "camera-view-note" };
        header::hint(ui, texts.get(note));
        sheet.vector(ui, &POSITION);
        sheet.vector(ui, &TARGET);
        sheet.vector(ui, &UP);
    });
    section(ui, "view-direction", texts.get("section-view"), "", true, |ui| {
        sheet.number(ui, &AZIMUTH, None);
        sheet.number(ui, &ELEVATION, None);
        sheet.number_or(ui, &DISTANCE, None);
    });
    section(ui, "projection", texts.get("section-projection"), "", true, |ui| {
        projection_ui(ui, &mut sheet);
        sheet.number(ui, &FOV, None);
        sheet.number(ui, &WINDOW, None);
        if let Projection::Perspective { fov_degrees } = sheet.primary.projection {
            lens_ui(ui, &mut sheet, fov_degrees);
        }
    });
}

fn projection_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Camera>) {
    let texts = sheet.texts();
    let choices = [(false, "projection-perspective"), (true, "projection-parallel")].map(|(value, key)| {
        ChoiceItem { value, text: texts.get(key), tip: texts.tip(key).unwrap_or_default(), is_enabled: true }
    });
    let chosen = matches!(sheet.primary.projection, Projection::Parallel { .. });
    let id = sheet.id.with("projection");
    let width = ui.available_width();
    let picked = choice_ui(ui, id, texts.get("section-projection"), width, &choices, Some(chosen));
    if picked.is_some() {
        sheet.change("projection", "edit-projection", |_, camera| {
            *camera = navigate::toggle_projection(camera);
        });
    }
    sheet.note(ui, "projection");
}

/// The lens that sees as much on film of 36 × 24 mm: f = 12 mm / tan(fov / 2).
fn lens_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Camera>, fov_degrees: f64) {
    let millimeters = 12.0 / (0.5 * fov_degrees).to_radians().tan();
    sheet.plain_row(ui, "lens", |sheet, ui| {
        ui.label(sheet.texts().with("lens-value", &[("value", shown(sheet.texts(), millimeters, 1).into())]));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_direction_of_view_goes_there_and_back() {
        let mut camera = Camera { position: DVec3::new(1.0, 2.0, 3.0), ..Camera::default() };
        for (azimuth, elevation) in [(0.0, 0.0), (90.0, 30.0), (-135.0, -60.0), (180.0, 10.0)] {
            look(&mut camera, |view| *view = CameraAngles { azimuth, elevation, distance: 4.0 });
            let view = CameraAngles::of(&camera);
            assert!((view.azimuth - azimuth).abs() < 1e-6, "{azimuth} {}", view.azimuth);
            assert!((view.elevation - elevation).abs() < 1e-6 && (view.distance - 4.0).abs() < 1e-9);
        }
        look(&mut camera, |view| *view = CameraAngles { azimuth: 90.0, elevation: 0.0, distance: 1.0 });
        assert!(camera.target.abs_diff_eq(DVec3::new(2.0, 2.0, 3.0), 1e-9));
    }
}
