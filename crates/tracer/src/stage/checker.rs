//! The checkerboard of the world's axes, seen from a body.

use catoptric_scene::{Body, Checker};
use glam::{Mat3A, Vec3A};

use super::body::world_from_canonical;
use super::vec3;

/// A checkerboard in a body's frame.
///
/// Only the parity of the cells counts, so the whole cells between the world's origin and the body's are counted once
/// in double precision; what is left for single precision is the part within the body, and a face that lies on a
/// border of cells keeps to one side of it wherever the body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StageChecker {
    /// From the body's frame to cells, without the origin's whole cells.
    cells_from_body: Mat3A,
    offset: Vec3A,
    /// Parity of the origin's whole cells.
    odd_origin: bool,
    /// Color of odd cells.
    pub color: Vec3A,
}

impl StageChecker {
    /// A point on the border of two cells (a floor at y = 0) belongs to the one above.
    const BORDER: f32 = 1e-6;

    pub(super) fn new(checker: &Checker, body: &Body) -> Self {
        let transform = world_from_canonical(body);
        let origin = transform.translation / checker.size;
        let whole = origin.floor();
        Self {
            cells_from_body: (transform.matrix3 * checker.size.recip()).as_mat3().into(),
            offset: (origin - whole).as_vec3a(),
            odd_origin: whole.element_sum().rem_euclid(2.0) == 1.0,
            color: vec3(checker.color),
        }
    }

    /// Whether a point of the body's frame lies in an odd cell.
    pub(crate) fn is_odd(&self, in_body: Vec3A) -> bool {
        let cells = self.cells_from_body * in_body + self.offset + Self::BORDER;
        let odd = |cell: f32| floor(cell) & 1 == 1;
        odd(cells.x) ^ odd(cells.y) ^ odd(cells.z) ^ self.odd_origin
    }
}

/// The largest whole number not above `x`, for |x| < 2³¹; beyond, single precision knows no odd numbers anyway.
fn floor(x: f32) -> i32 {
    let whole = x as i32;
    whole.wrapping_sub(i32::from(whole as f32 > x))
}
