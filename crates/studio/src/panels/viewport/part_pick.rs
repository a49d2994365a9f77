//! Which part of a joined body a point of its surface belongs to.

use catoptric_editor::PartPath;
use catoptric_scene::{Body, Form, Shape};
use glam::{DAffine3, DVec2, DVec3};

use super::gizmo::distance_to;

/// The innermost part on whose surface a point of a body lies, meters: where the body is cut, the part that cuts it.
/// Found as the part whose surface is nearest.
pub(crate) fn part_at(body: &Body, point: DVec3) -> Option<PartPath> {
    let mut nearest = None;
    search(body, PartPath::WHOLE, point, &mut nearest);
    nearest.map(|(path, _)| path)
}

fn search(body: &Body, path: PartPath, point: DVec3, nearest: &mut Option<(PartPath, f64)>) {
    if let Some(parts) = path.parts(body) {
        let inner = (0..parts.len()).filter_map(|place| path.child(place));
        inner.for_each(|inner| search(body, inner, point, nearest));
        return;
    }
    let Some(form) = path.form(body) else { return };
    let distance = distance(&form, path.frame_around(body), point);
    if !path.is_whole() && nearest.is_none_or(|(_, least)| distance < least) {
        *nearest = Some((path, distance));
    }
}

/// About how far a point is from the surfaces that a form is made of.
fn distance(form: &Form<'_>, around: DAffine3, point: DVec3) -> f64 {
    let mut least = f64::INFINITY;
    form.each_simple(around, &mut |part| {
        let axes = [part.frame.x_axis, part.frame.y_axis, part.frame.z_axis].map(DVec3::length);
        let scale = axes.into_iter().fold(f64::INFINITY, f64::min);
        least = least.min(scale * to_surface(&part.shape, part.frame.inverse().transform_point3(point)));
    });
    least
}

/// The distance from a shape's surface in its own frame.
fn to_surface(shape: &Shape, point: DVec3) -> f64 {
    // Round shapes in the half-plane through their axis.
    let across = DVec2::new(point.x.hypot(point.z), point.y);
    match *shape {
        Shape::Sphere { radius } => (point.length() - radius).abs(),
        Shape::Cube { size } => {
            let beyond = point.abs() - 0.5 * size;
            (beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)).abs()
        }
        Shape::Cylinder { radius, height } => to_frustum([radius, radius], height, across),
        Shape::Cone { radius, top_radius, height } => to_frustum([radius, top_radius], height, across),
        Shape::Paraboloid { radius, .. } => {
            let height = shape.height().unwrap_or_default();
            let lid = distance_to([DVec2::new(0.0, height), DVec2::new(radius, height)], across);
            // y = h (r / R)²; the gap along y, by its slope the distance to first order.
            let slope = 2.0 * height * across.x / (radius * radius);
            let gap = across.y - height * (across.x / radius).powi(2);
            lid.min(gap.abs() / slope.hypot(1.0))
        }
        Shape::Plane => point.y.abs(),
        Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } | Shape::Group => {
            f64::INFINITY
        }
    }
}

fn to_frustum([bottom, top]: [f64; 2], height: f64, at: DVec2) -> f64 {
    let corners = [DVec2::ZERO, DVec2::new(bottom, 0.0), DVec2::new(top, height), DVec2::new(0.0, height)];
    let sides = corners.windows(2).filter_map(|side| <[DVec2; 2]>::try_from(side).ok());
    sides.map(|side| distance_to(side, at)).fold(f64::INFINITY, f64::min)
}

/// The part that a click selects on a body of which `meant` is selected: one step deeper than what is selected and what
/// was met have in common, so that clicks go from the whole to its parts, from there to theirs, and from part to part.
pub(crate) fn next_part(meant: PartPath, met: PartPath) -> PartPath {
    met.up_to(meant.common(met) + 1)
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{BodyPart, Placement};

    use super::*;

    fn path(places: &[usize]) -> PartPath {
        PartPath::by(places.iter().copied()).unwrap()
    }

    #[test]
    fn points_belong_to_the_part_whose_surface_they_are_on() {
        let part =
            |shape, x: f64| BodyPart { shape, placement: Placement::at(DVec3::X * x), ..BodyPart::default() };
        let drill = part(Shape::Cylinder { radius: 0.25, height: 2.0 }, 0.2);
        let inner = BodyPart { parts: vec![drill, part(Shape::SPHERE, 9.0)], ..part(Shape::Union, 0.0) };
        let body = Body {
            shape: Shape::Difference,
            parts: vec![part(Shape::CUBE, 0.0), inner],
            placement: Placement { scale: DVec3::splat(2.0), ..Placement::at(DVec3::Z) },
            ..Body::default()
        };
        let at = |x: f64, y: f64, z: f64| part_at(&body, DVec3::new(2.0 * x, 2.0 * y, 1.0 + 2.0 * z));
        assert_eq!(at(0.5, 0.1, 0.2), Some(path(&[0])));
        assert_eq!(at(0.45, 0.2, 0.0), Some(path(&[1, 0])));
        assert_eq!(at(8.0, 0.0, 0.0), Some(path(&[1, 1])));
        assert_eq!(part_at(&Body::default(), DVec3::X), None);
    }

    #[test]
    fn surfaces_of_all_shapes_are_at_no_distance() {
        for (shape, on, off) in [
            (Shape::SPHERE, DVec3::X, DVec3::ZERO),
            (Shape::CUBE, DVec3::new(0.5, 0.1, 0.2), DVec3::new(0.3, 0.0, 0.0)),
            (Shape::CYLINDER, DVec3::new(0.3, 0.5, 0.4), DVec3::Y * 0.5),
            (Shape::CONE, DVec3::new(0.25, 0.5, 0.0), DVec3::Y * 0.4),
            (Shape::PARABOLOID, DVec3::new(0.0, 0.25, 0.25), DVec3::Y * 0.5),
            (Shape::Plane, DVec3::X * 7.0, DVec3::Y),
        ] {
            assert!(to_surface(&shape, on).abs() < 1e-12, "{shape:?}");
            assert!(to_surface(&shape, off) > 0.1, "{shape:?}");
        }
    }

    #[test]
    fn clicks_go_deeper_and_from_part_to_part() {
        for (meant, met, next) in [
            (vec![], vec![1, 0], vec![1]),
            (vec![1], vec![1, 0], vec![1, 0]),
            (vec![1, 0], vec![1, 0], vec![1, 0]),
            (vec![1, 0], vec![1, 2], vec![1, 2]),
            (vec![1, 0], vec![0, 3], vec![0]),
        ] {
            assert_eq!(next_part(path(&meant), path(&met)), path(&next));
        }
    }
}
