//! The wireframe of a body from an eye, as lines in the world, for ghosts that no tracer sees.

use std::f64::consts::TAU;

use catoptric_scene::{Body, Shape};
use glam::{DVec3, dvec3};

/// Corners of a circle.
const CORNERS: u32 = 64;

/// The outline of `body` as an eye at `eye` sees it; nothing for a plane, which has none.
pub(crate) fn outline(body: &Body, eye: DVec3) -> Vec<Vec<DVec3>> {
    let frame = body.placement.world_from_body();
    let from = frame.inverse().transform_point3(eye);
    let lines = match body.shape {
        Shape::Sphere { radius } => vec![sphere(radius, from)],
        Shape::Cube { size } => cube(0.5 * size),
        Shape::Cylinder { radius, height } => frustum([radius; 2], body.height().unwrap_or(height), from),
        Shape::Cone { radius, top_radius, height } => {
            frustum([radius, top_radius], body.height().unwrap_or(height), from)
        }
        Shape::Plane => Vec::new(),
    };
    let to_world = |line: Vec<DVec3>| line.into_iter().map(|point| frame.transform_point3(point)).collect();
    lines.into_iter().map(to_world).collect()
}

/// The circle of the points at which rays from the eye touch the sphere.
fn sphere(radius: f64, eye: DVec3) -> Vec<DVec3> {
    let distance = eye.length();
    if distance <= radius {
        return Vec::new();
    }
    let axis = eye / distance;
    let cosine = radius / distance;
    let (right, up) = axis.any_orthonormal_pair();
    let reach = radius * (1.0 - cosine * cosine).sqrt();
    circle(radius * cosine * axis, reach * right, reach * up)
}

fn circle(center: DVec3, right: DVec3, up: DVec3) -> Vec<DVec3> {
    let corner = |corner: u32| {
        let (sine, cosine) = (TAU * f64::from(corner) / f64::from(CORNERS)).sin_cos();
        center + cosine * right + sine * up
    };
    (0..=CORNERS).map(corner).collect()
}

fn cube(half: DVec3) -> Vec<Vec<DVec3>> {
    let signs = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
    let edges = |a: f64, b: f64| {
        [
            vec![dvec3(-1.0, a, b) * half, dvec3(1.0, a, b) * half],
            vec![dvec3(a, -1.0, b) * half, dvec3(a, 1.0, b) * half],
            vec![dvec3(a, b, -1.0) * half, dvec3(a, b, 1.0) * half],
        ]
    };
    signs.into_iter().flat_map(|(a, b)| edges(a, b)).collect()
}

/// Both rims, and the two lines between them beside which the eye looks past.
fn frustum([bottom, top]: [f64; 2], height: f64, eye: DVec3) -> Vec<Vec<DVec3>> {
    let up = height * DVec3::Y;
    let rim = |radius: f64, at: DVec3| circle(at, radius * DVec3::X, radius * DVec3::Z);
    let mut lines = vec![rim(bottom, DVec3::ZERO), rim(top, up)];
    // A plane through the eye touches the mantle where normal·(eye − point) = 0: with the slope s of the radius and the
    // radius r at the eye's height, x·cos φ + z·sin φ = r there.
    let slope = (top - bottom) / height;
    let (radius, distance) = (bottom + slope * eye.y, eye.x.hypot(eye.z));
    if radius.abs() < distance {
        let (middle, away) = (eye.z.atan2(eye.x), (radius / distance).acos());
        for angle in [middle - away, middle + away] {
            let side = dvec3(angle.cos(), 0.0, angle.sin());
            lines.push(vec![bottom * side, up + top * side]);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_scene::Placement;

    fn body(shape: Shape) -> Body {
        let placement = Placement { scale: dvec3(1.0, 2.0, 0.5), ..Placement::at(dvec3(1.0, 2.0, 3.0)) };
        Body { shape, placement, ..Body::default() }
    }

    /// Rays to the outline touch: a little farther out they pass the body, a little farther in they meet it.
    #[test]
    fn the_eye_looks_past_at_the_outline_of_a_ball() {
        let ball = body(Shape::Sphere { radius: 0.7 });
        let frame = ball.placement.world_from_body().inverse();
        let eye = dvec3(5.0, 1.0, 9.0);
        let from = frame.transform_point3(eye);
        for point in outline(&ball, eye).concat() {
            let to = frame.transform_point3(point) - from;
            let nearest = from - to * (from.dot(to) / to.length_squared());
            assert!((nearest.length() - 0.7).abs() < 1e-9);
        }
    }

    #[test]
    fn the_sides_of_a_cone_are_tangents() {
        let cone = body(Shape::Cone { radius: 1.0, top_radius: 0.25, height: 2.0 });
        let frame = cone.placement.world_from_body().inverse();
        let eye = dvec3(5.0, 1.0, 9.0);
        let from = frame.transform_point3(eye);
        let sides = outline(&cone, eye).split_off(2);
        assert_eq!(sides.len(), 2);
        for side in sides {
            let ends = [side[0], side[1]].map(|end| frame.transform_point3(end));
            let around = dvec3(-ends[0].z, 0.0, ends[0].x);
            let normal = around.cross(ends[1] - ends[0]);
            assert!(normal.dot(from - ends[0]).abs() < 1e-9 * normal.length());
        }
    }

    #[test]
    fn a_cube_has_twelve_edges_and_a_plane_no_outline() {
        assert_eq!(outline(&body(Shape::Cube { size: DVec3::ONE }), DVec3::ZERO).len(), 12);
        assert!(outline(&body(Shape::Plane), DVec3::ZERO).is_empty());
    }
}
