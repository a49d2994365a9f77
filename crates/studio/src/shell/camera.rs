//! The camera moves of commands.

use catoptric_editor::navigate::{self, ViewSide};
use catoptric_editor::{Label, bounds};
use catoptric_scene::{Camera, ScenePart};

use crate::shell::studio::Studio;

/// Moves the camera of the view, as far as the scene's range goes: the free one, or else the scene's as one step of the
/// history.
pub(crate) fn set_camera(studio: &mut Studio, key: &'static str, camera: Camera) {
    let before = studio.view.camera(studio.editor.scene());
    let camera = studio.view.range.of_scene(studio.editor.scene()).limit(&before, camera);
    match &mut studio.view.free_camera {
        Some(free) => *free = camera,
        None => {
            studio.editor.settle();
            // A camera that navigation made is valid.
            let _ = studio.editor.navigate(Label::new(key, ""), camera);
            studio.editor.settle();
        }
    }
    glide_from(studio, before);
}

/// Moves the scene's camera as one step of the history.
pub(crate) fn set_scene_camera(studio: &mut Studio, key: &'static str, camera: Camera) {
    studio.editor.settle();
    // A camera that navigation made is valid.
    let _ = studio.editor.change_camera(Label::new(key, ""), |own| *own = camera);
    studio.editor.settle();
}

/// Lets the eye follow a jump of the camera.
fn glide_from(studio: &mut Studio, before: Camera) {
    let now = studio.view.camera(studio.editor.scene());
    studio.view.eased = studio.panes.viewport.glide(before, now).then_some(before);
}

/// Brings the selected or all bodies into view.
pub(crate) fn frame(studio: &mut Studio, all: bool) {
    let scene = studio.editor.scene();
    let parts: Vec<ScenePart> = studio.editor.selected_parts().collect();
    let meant = || {
        let (body, part) = studio.editor.selected_part()?;
        bounds::ball_of_part(scene.bodies.get(body)?, part)
    };
    let selected = if all { None } else { meant().or_else(|| bounds::ball_of_parts(scene, &parts)) };
    let Some(ball) = selected.or_else(|| bounds::ball_of_scene(scene)) else { return };
    let camera = studio.view.camera(scene);
    let camera = navigate::frame(&camera, ball.center, ball.radius, studio.settings.picture_aspect());
    set_camera(studio, "edit-frame", camera);
    // What is brought into view must not lie under a panel.
    studio.panes.viewport.fit();
}

/// Looks along an axis, in the free view: the scene's camera stays.
pub(crate) fn look_along(studio: &mut Studio, axis: ViewSide) {
    let camera = studio.view.camera(studio.editor.scene());
    studio.view.free_camera = Some(navigate::look_along(&camera, axis, camera.target));
    glide_from(studio, camera);
}

/// Looks in the free view as `camera` does: the scene's camera stays.
pub(crate) fn look_through(studio: &mut Studio, camera: Camera) {
    let before = studio.view.camera(studio.editor.scene());
    studio.view.free_camera = Some(camera);
    glide_from(studio, before);
}

/// Looks around without moving the scene's camera, or through it again.
pub(crate) fn toggle_free(studio: &mut Studio) {
    studio.editor.settle();
    let before = studio.view.camera(studio.editor.scene());
    studio.view.toggle_free(studio.editor.scene());
    glide_from(studio, before);
}
