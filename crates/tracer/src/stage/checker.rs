//! The checkerboard of the world's axes, seen from a body.

use catoptric_scene::{Body, Checker};
use glam::{Mat3, Vec3};

use super::body::world_from_canonical;
use super::vec3;

/// A checkerboard in a body's frame.
///
/// Only the parity of the cells counts, so the whole cells between the world's origin and the body's are counted once
/// in double precision; what is left for single precision is the part within the body, and a face that lies on a
/// border of cells keeps to one side of it wherever the body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageChecker {
    /// From the body's frame to cells, without the origin's whole cells.
    cells_from_body: Mat3,
    offset: Vec3,
    /// Parity of the origin's whole cells.
    odd_origin: bool,
    /// Color of odd cells.
    pub color: Vec3,
}

impl StageChecker {
    /// A point on the border of two cells (a floor at y = 0) belongs to the one above.
    const BORDER: f32 = 1e-6;

    pub(super) fn new(checker: &Checker, body: &Body) -> Self {
        let transform = world_from_canonical(body);
        let origin = transform.translation / checker.size;
        let whole = origin.floor();
        Self {
            cells_from_body: (transform.matrix3 * checker.size.recip()).as_mat3(),
            offset: (origin - whole).as_vec3(),
            odd_origin: whole.element_sum().rem_euclid(2.0) == 1.0,
            color: vec3(checker.color),
        }
    }

    /// Whether a point of the body's frame lies in an odd cell.
    pub fn is_odd(&self, in_body: Vec3) -> bool {
        let cells = (self.cells_from_body * in_body + self.offset + Self::BORDER).floor();
        // Each parity by itself: the sum of large cell numbers would not be exact.
        let odd = |cell: f32| (cell * 0.5).fract() != 0.0;
        odd(cells.x) ^ odd(cells.y) ^ odd(cells.z) ^ self.odd_origin
    }
}
