//! Where points lie in a picture, in homogeneous coordinates.

use glam::{DVec2, DVec3};

use crate::simd::double::Float64;
use crate::simd::vector::Vector;
use crate::transport::camera::RenderCamera;

/// A point or direction as a picture has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HomogeneousPoint {
    /// x·w, y·w (pixels from the upper left corner) and w.
    pub(crate) at: DVec3,
    /// Along the view, meters.
    pub(crate) depth: f64,
}

/// The way from the space of the rays to a picture of so many pixels. All four numbers of a point are linear, before the eye
/// and behind it; w is the depth for a perspective, and 1 for a parallel projection.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenProjection {
    position: DVec3,
    /// To the right, up and forward.
    axes: [DVec3; 3],
    scale: f64,
    size: DVec2,
    is_parallel: bool,
}

impl ScreenProjection {
    pub(crate) fn new(camera: &RenderCamera, size: DVec2) -> Self {
        Self {
            position: camera.position(),
            axes: camera.axes(),
            scale: camera.magnification() * size.y,
            size,
            is_parallel: camera.parallel_height().is_some(),
        }
    }

    /// A point.
    pub(crate) fn point(&self, point: DVec3) -> HomogeneousPoint {
        let offset = point - self.position;
        let [right, up, depth] = self.axes.map(|axis| offset.dot(axis));
        let w = if self.is_parallel { 1.0 } else { depth };
        let x = self.scale * right + 0.5 * w * self.size.x;
        let y = self.scale * -up + 0.5 * w * self.size.y;
        HomogeneousPoint { at: DVec3::new(x, y, w), depth }
    }
}

/// Vectors side by side.
#[inline(always)]
pub(crate) fn vector64<const N: usize>(vectors: [DVec3; N]) -> Vector<Float64<N>> {
    let mut rows = [[0.0; N]; 3];
    for lane in 0..N {
        (rows[0][lane], rows[1][lane], rows[2][lane]) = (vectors[lane].x, vectors[lane].y, vectors[lane].z);
    }
    let [x, y, z] = rows;
    Vector::new(Float64(x), Float64(y), Float64(z))
}
