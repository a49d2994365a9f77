//! Which points of a part's faces lie on the surface of the whole.
//!
//! The faces of all parts are drawn whole, and what does not bound the joined body is left out pixel by pixel: beneath the
//! face and above it, membership in the whole has to be different; of a surface, the point itself has to lie in the other
//! parts. So no meshes are cut into each other. Faces lie beside
//! the surfaces that they stand for; so that no gap is seen between those of two parts, they reach that much further.

use std::f64::consts::FRAC_PI_4;

use glam::{DMat3, DVec3};

use crate::geometry::joined::JoinedBody;
use crate::geometry::ray::RayOrigin;
use crate::raster::rasterizer::{CoveredRun, ScreenTriangle, TriangleCorner};
use crate::simd::vector::Vector;
use crate::transport::scene::RenderScene;

/// A face of a part.
pub(crate) struct PartFace<'a> {
    scene: &'a RenderScene,
    body: &'a JoinedBody,
    /// The bit of the part.
    part: u64,
    world_from_values: Option<(DMat3, DVec3)>,
    /// From a point of the face to where it is surely outside of the part.
    above: DVec3,
    /// From such a point to others of its plane, as far as faces lie beside surfaces.
    beside: [DVec3; 5],
    corners: [DVec3; 3],
}

/// Of the size of the largest part: far more than rounding.
const LEAST_STEP: f64 = 1e-4;

impl<'a> PartFace<'a> {
    /// The face of a triangle, if it belongs to a part; `all` are the corners of its batch.
    pub(crate) fn of(
        scene: &'a RenderScene,
        triangle: &ScreenTriangle,
        all: &[TriangleCorner],
        fineness: u32,
    ) -> Option<Self> {
        let outward = triangle.outward?;
        let index = RayOrigin::of_word(triangle.start).body;
        let whole = scene.geometry.joined.whole_of(index, false).body;
        let body = scene.geometry.joined(whole)?;
        let part = scene.geometry.body(index);
        let rows = part.world_from_body.map(|row| row.map(f64::from));
        let linear = DMat3::from_cols_array_2d(&rows).transpose();
        let sizes = body.parts().map(|part| scene.geometry.body(part).extent());
        // Chords of a quarter of a circle in so many parts.
        let sagitta = 1.0 - (FRAC_PI_4 / f64::from(fineness.max(1))).cos();
        let step = 1.1 * sizes.fold(0.0, f64::max) * sagitta.max(LEAST_STEP);
        let (right, up) = outward.any_orthonormal_pair();
        let origin = DVec3::from(part.origin.map(f64::from));
        let [a, b, c] = triangle.corners().map(|corner| all.get(corner as usize));
        let corners = [a?, b?, c?].map(|corner| DVec3::from(corner.values[2].map(f64::from)));
        Some(Self {
            scene,
            body,
            part: 1 << (index - body.first),
            // Of bodies with patterns in double precision the values are places already.
            world_from_values: (!part.sees_solid_in_world()).then_some((linear, origin)),
            above: outward * step,
            beside: [DVec3::ZERO, right, -right, up, -up].map(|way| way * step),
            corners,
        })
    }

    /// The pixels of a run, of these, in which the face bounds the whole.
    pub(crate) fn kept(&self, run: &CoveredRun, pixels: u32) -> u32 {
        let mut kept = 0;
        let mut left = pixels;
        while left != 0 {
            let lane = left.trailing_zeros();
            left &= left - 1;
            let [a, b, c] = run.shares(lane as usize);
            let at = self.corners[0] * a + self.corners[1] * b + self.corners[2] * c;
            let at = self.world_from_values.map_or(at, |(linear, origin)| linear * at + origin);
            let is_kept = self.beside.iter().any(|beside| self.bounds_whole(at + *beside));
            kept |= u32::from(is_kept) << lane;
        }
        kept
    }

    fn bounds_whole(&self, at: DVec3) -> bool {
        if self.body.tree.is_surface() {
            return self.body.tree.shows(self.parts_around(at));
        }
        let (below, above) = (self.parts_around(at - self.above), self.parts_around(at + self.above));
        let tree = &self.body.tree;
        tree.holds(below | self.part) != tree.holds(above & !self.part)
    }

    fn parts_around(&self, at: DVec3) -> u64 {
        let at = at.as_vec3();
        self.scene.geometry.parts_around(self.body, Vector::new(at.x, at.y, at.z))
    }
}
