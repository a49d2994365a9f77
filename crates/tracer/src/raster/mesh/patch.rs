//! The part of a plane that is made of faces: rings around a point, wider and wider.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use crate::geometry::body::RenderBody;
use crate::geometry::shape::solid::RevolutionRing;
use crate::raster::mesh::Mesh;
use crate::transport::camera::RenderCamera;

/// Which part of the plane y = 0 of a body's frame, and how fine.
///
/// The rings lie about the point next to the eye (of a parallel projection, the one seen in the picture's middle). Each
/// is wider than the last by as much as its faces are long, so that faces near the eye are small and those at the
/// horizon large, and all look about alike. The last ring is 10⁷ heights of the eye away: what lies beyond is lower than
/// the horizon by less than a hundredth of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlanePatch {
    center: DVec3,
    /// The height of the eye in units of the frame.
    height: f64,
}

impl PlanePatch {
    /// How many heights the last ring is away.
    const REACH: f64 = 1e7;

    /// The part of a plane that a camera sees.
    pub(crate) fn seen(body: &RenderBody, camera: &RenderCamera) -> Self {
        let in_body = |v: DVec3| {
            let rows = body.body_from_world.map(|row| DVec3::from(row.map(f64::from)));
            DVec3::from(rows.map(|row| row.dot(v)))
        };
        let eye = in_body(camera.position() - DVec3::from(body.origin.map(f64::from)));
        let mut center = DVec3::new(eye.x, 0.0, eye.z);
        let mut height = eye.y.abs();
        if let Some(window) = camera.parallel_height() {
            let [_, _, forward] = camera.axes().map(in_body);
            height = in_body(window * DVec3::ONE).abs().max_element();
            // A view along the plane meets it nowhere near.
            if (eye.y / forward.y).abs() < 1e3 * (height + eye.y.abs()) {
                center = eye - forward * (eye.y / forward.y);
                center.y = 0.0;
            }
        }
        // An eye in the plane sees nothing of it; the faces must still be of some size.
        Self { center, height: height.max(1e-6 * (1.0 + center.abs().max_element())) }
    }

    pub(crate) fn mesh(&self, fineness: u32) -> Mesh {
        let growth = 1.0 + FRAC_PI_2 / f64::from(fineness);
        let first = 0.5 * self.height * (growth - 1.0);
        let count = ((Self::REACH * self.height / first).ln() / growth.ln()).ceil() as u32;
        let radii = (0..=count).map(|step| first * growth.powi(step as i32));
        let rings: Vec<RevolutionRing> = std::iter::once(0.0)
            .chain(radii)
            .map(|radius| RevolutionRing { y: 0.0, radius, normal: DVec2::Y })
            .collect();
        let mut mesh = Mesh::default();
        mesh.revolve(&rings, 4 * fineness);
        mesh.vertices.iter_mut().for_each(|vertex| vertex.point += self.center);
        mesh
    }
}
