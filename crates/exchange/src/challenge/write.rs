//! Writing scenes of the book.

use catoptric_scene::{Camera, Color, Scene};
use glam::DVec3;

use crate::camera::horizontal_from_vertical;
use crate::challenge::object::ObjectWriter;
use crate::challenge::shape::MIRROR;
use crate::message::Message;
use crate::options::DEFAULT_SIZE;
use crate::scene_text::{ExportOptions, SceneText, components, decimal, seen_bodies, three, times};

/// Writes a scene.
pub(crate) fn write(scene: &Scene, options: &ExportOptions) -> SceneText {
    let mut out = SceneText::default();
    out.environment(scene);
    if scene.environment.background != Color::BLACK {
        out.lose(Message::LosesBackground);
    }
    camera(&scene.camera, options.size.unwrap_or(DEFAULT_SIZE), &mut out);
    let mut sum = DVec3::ZERO;
    for (_, light) in out.lights(scene) {
        let intensity = times(light.color, light.intensity);
        sum += DVec3::from_array(intensity.to_array());
        out.line("\n- add: light");
        out.line(&format!("  at: [{}]", three(MIRROR * light.position, ", ")));
        out.line(&format!("  intensity: [{}]", components(intensity, ", ")));
    }
    let share = ambient_share(scene.environment.ambient, sum);
    let mut writer = ObjectWriter { scene, ambient_share: share.unwrap_or(1.0), has_ambient: false, out };
    for (title, body) in seen_bodies(scene) {
        writer.body(&title, body);
    }
    let ObjectWriter { has_ambient, mut out, .. } = writer;
    if has_ambient && share.is_none() {
        out.lose(Message::LosesAmbientColor);
    }
    out
}

/// Ambient light as a share of the sum of all lights, which is the book's ambient light.
fn ambient_share(ambient: Color, sum: DVec3) -> Option<f64> {
    let ambient = DVec3::from_array(ambient.to_array());
    if ambient == DVec3::ZERO {
        return Some(0.0);
    }
    let share = ambient.dot(sum) / sum.length_squared();
    (share.is_finite() && (ambient - share * sum).length() <= 1e-9 * ambient.length()).then_some(share)
}

fn camera(camera: &Camera, size @ [width, height]: [u32; 2], out: &mut SceneText) {
    let vertical = out.fov(camera);
    let fov = if width >= height { horizontal_from_vertical(vertical, size) } else { vertical };
    out.line("- add: camera");
    out.line(&format!("  width: {width}"));
    out.line(&format!("  height: {height}"));
    out.line(&format!("  field-of-view: {}", decimal(fov.to_radians())));
    // Across the view: the book's picture shows more for every other one.
    let view = (camera.target - camera.position).normalize_or_zero();
    let up = (camera.up - view * camera.up.dot(view)).normalize_or(camera.up);
    for (key, point) in [("from", camera.position), ("to", camera.target), ("up", up)] {
        out.line(&format!("  {key}: [{}]", three(MIRROR * point, ", ")));
    }
}
