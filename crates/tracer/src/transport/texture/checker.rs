//! Checkerboards, seen from a body.

use catoptric_scene::{Checker, CheckerSpace};
use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::body::{inverse_linear, is_diagonal, mul, rows, scale_plus};
use crate::geometry::canonical::CanonicalBody;
use crate::geometry::space::RenderSpace;
use crate::simd::vector::Vector;
use crate::simd::{Float32, Word as _};
use crate::transport::color::linear_rgb;

/// A checkerboard in a body's frame.
///
/// Only the parity of the cells counts, so the whole cells between the world's origin and the body's are counted once
/// in double precision; what is left for single precision is the part within the body, and a face that lies on a
/// border of cells keeps to one side of it wherever the body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CheckerTexture {
    /// From the body's frame to cells, without the origin's whole cells.
    cells_from_body: [[f32; 3]; 3],
    /// Whether the cells lie along the axes of that frame.
    aligned: bool,
    offset: [f32; 3],
    /// Parity of the origin's whole cells.
    odd_origin: bool,
    /// Color of odd cells.
    pub color: [f32; 3],
}

impl CheckerTexture {
    /// A point on the border of two cells (a floor at y = 0) belongs to the one above.
    const BORDER: f32 = 1e-6;

    /// The checkerboard of a body in a scene's space of rays; whether the body is there [in double
    /// precision](crate::geometry::body::RenderBody::is_double).
    pub(crate) fn new(checker: &Checker, body: &CanonicalBody, space: &RenderSpace, is_double: bool) -> Self {
        let transform = pattern_from(checker.space, body, space, is_double);
        let origin = transform.translation / checker.size;
        let whole = origin.floor();
        let cells_from_body = rows(&(transform.matrix3 * checker.size.recip()));
        Self {
            cells_from_body,
            aligned: is_diagonal(&cells_from_body),
            offset: (origin - whole).as_vec3().to_array(),
            odd_origin: whole.element_sum().rem_euclid(2.0) == 1.0,
            color: linear_rgb(checker.color),
        }
    }

    /// As the shaders read it: three rows with their offsets, the color, and the parity of the origin's whole cells.
    pub(crate) fn rows(&self) -> [[f32; 4]; 4] {
        let Self { cells_from_body: [x, y, z], offset, odd_origin, color, .. } = *self;
        let row = |[a, b, c]: [f32; 3], axis: usize| [a, b, c, offset[axis] + Self::BORDER];
        let [red, green, blue] = color;
        [row(x, 0), row(y, 1), row(z, 2), [red, green, blue, f32::from(odd_origin)]]
    }

    /// Whether a point lies in an odd cell, given in the body's frame, or for a body in double precision in the space of the
    /// rays; beyond 2²² cells, what single precision makes of that.
    #[inline(always)]
    pub(crate) fn is_odd<R: Float32>(&self, point: Vector<R>) -> R::Mask {
        /// 1.5·2²³ leaves no room for a fraction: what is added to it stands in the low bits of the sum.
        const ROUND: f32 = 12_582_912.0;
        let offset = self.offset.map(|offset| offset + Self::BORDER);
        let cells = if self.aligned {
            let [a, b, c] = self.cells_from_body;
            scale_plus([a[0], b[1], c[2]], point, offset)
        } else {
            mul(&self.cells_from_body, point).plus_all(offset)
        };
        let cells = cells.map(R::floor);
        let x = (cells.x + (ROUND + f32::from(self.odd_origin))).to_word();
        let y = (cells.y + ROUND).to_word();
        let z = (cells.z + ROUND).to_word();
        x.plus(y).plus(z).has(1)
    }
}

/// From where points are known to the space of the checkerboard, meters.
fn pattern_from(
    of: CheckerSpace,
    canonical: &CanonicalBody,
    space: &RenderSpace,
    is_double: bool,
) -> DAffine3 {
    let world_from_canonical = canonical.world_from_canonical;
    if is_double {
        // In the body's own frame single precision is too rough; in the space of the rays it is not.
        let world_from_render = DAffine3::from_translation(space.origin);
        return match of {
            CheckerSpace::World => world_from_render,
            CheckerSpace::Body => {
                let canonical_from_world = DAffine3::from_mat3(inverse_linear(&world_from_canonical.matrix3))
                    * DAffine3::from_translation(-world_from_canonical.translation);
                meters_from_canonical(&world_from_canonical) * canonical_from_world * world_from_render
            }
        };
    }
    // The frame of a plane may have been moved within it.
    let moved = if canonical.is_plane() { space.frame_near(canonical) } else { None };
    let (frame, shift) = moved.unwrap_or((world_from_canonical, DVec3::ZERO));
    match of {
        CheckerSpace::World => frame,
        CheckerSpace::Body => {
            meters_from_canonical(&world_from_canonical) * DAffine3::from_translation(shift)
        }
    }
}

/// From a body's frame to one in its place, along its axes, but in meters: what is left of its transform without rotation.
fn meters_from_canonical(world_from_canonical: &DAffine3) -> DAffine3 {
    let linear = world_from_canonical.matrix3;
    let sizes = DVec3::new(linear.x_axis.length(), linear.y_axis.length(), linear.z_axis.length());
    DAffine3::from_mat3(DMat3::from_diagonal(sizes))
}
