//! The part of the viewport that a rendered picture shows.
//!
//! A viewport is rarely as wide for its height as the picture to be made. What the scene's camera sees of the picture
//! is always shown whole, and what lies beside it is dimmed.

use catoptric_scene::{Camera, Projection};
use egui::{Color32, Painter, Rect, Stroke, StrokeKind, vec2};

/// Widths over heights that differ less are taken as equal: a frame a pixel inside the border would only disturb.
const NEARLY: f64 = 0.005;

/// `camera` with its window made higher where the viewport (width over height `viewport`) is too narrow for the picture
/// (width over height `picture`).
pub(crate) fn fitted(camera: &Camera, viewport: f64, picture: f64) -> Camera {
    let factor = picture / viewport;
    if !(factor.is_finite() && factor > 1.0) {
        return *camera;
    }
    let projection = match camera.projection {
        Projection::Perspective { fov_degrees } => {
            let window = factor * (0.5 * fov_degrees.to_radians()).tan();
            // The widest angle that a scene may have.
            Projection::Perspective { fov_degrees: (2.0 * window.atan().to_degrees()).min(179.9) }
        }
        Projection::Parallel { height } => Projection::Parallel { height: factor * height },
    };
    Camera { projection, ..*camera }
}

/// Where the picture lies in the viewport.
pub(crate) fn frame(viewport: Rect, picture: f64) -> Rect {
    let size = viewport.size();
    let own = f64::from(size.x) / f64::from(size.y.max(1.0));
    let size = if own > picture {
        vec2((f64::from(size.y) * picture) as f32, size.y)
    } else {
        vec2(size.x, (f64::from(size.x) / picture) as f32)
    };
    Rect::from_center_size(viewport.center(), size)
}

/// Dims what lies beside the picture.
pub(crate) fn paint(painter: &Painter, viewport: Rect, picture: f64) {
    let own = f64::from(viewport.width()) / f64::from(viewport.height().max(1.0));
    if (own / picture - 1.0).abs() < NEARLY || !picture.is_finite() {
        return;
    }
    let frame = frame(viewport, picture);
    let sides = [
        Rect::from_min_max(viewport.min, egui::pos2(viewport.max.x, frame.min.y)),
        Rect::from_min_max(egui::pos2(viewport.min.x, frame.max.y), viewport.max),
        Rect::from_min_max(viewport.min, egui::pos2(frame.min.x, viewport.max.y)),
        Rect::from_min_max(egui::pos2(frame.max.x, viewport.min.y), viewport.max),
    ];
    for side in sides.into_iter().filter(Rect::is_positive) {
        painter.rect_filled(side, 0.0, Color32::from_black_alpha(72));
    }
    painter.rect_stroke(frame, 0.0, Stroke::new(1.0, Color32::from_white_alpha(70)), StrokeKind::Middle);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_viewport_gets_a_higher_window() {
        let camera =
            Camera { projection: Projection::Perspective { fov_degrees: 90.0 }, ..Camera::default() };
        let Projection::Perspective { fov_degrees } = fitted(&camera, 1.0, 2.0).projection else { panic!() };
        assert!((fov_degrees - 2.0 * 2.0_f64.atan().to_degrees()).abs() < 1e-12);
        let parallel = Camera { projection: Projection::Parallel { height: 3.0 }, ..Camera::default() };
        assert_eq!(fitted(&parallel, 1.0, 2.0).projection, Projection::Parallel { height: 6.0 });
        assert_eq!(fitted(&camera, 2.0, 2.0), camera);
        assert_eq!(fitted(&camera, 3.0, 2.0), camera);
        assert_eq!(fitted(&camera, 0.0, 2.0), camera, "a viewport without width");
    }

    #[test]
    fn the_frame_lies_in_the_middle() {
        let viewport = Rect::from_min_size(egui::pos2(10.0, 20.0), vec2(400.0, 400.0));
        assert_eq!(frame(viewport, 2.0), Rect::from_min_size(egui::pos2(10.0, 120.0), vec2(400.0, 200.0)));
        assert_eq!(frame(viewport, 0.5), Rect::from_min_size(egui::pos2(110.0, 20.0), vec2(200.0, 400.0)));
    }
}
