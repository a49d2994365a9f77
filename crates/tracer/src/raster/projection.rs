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

/// Points or directions side by side as a picture has them: the numbers of a [`HomogeneousPoint`] each.
#[derive(Clone, Copy)]
pub(crate) struct HomogeneousPoints<const N: usize> {
    pub(crate) at: Vector<Float64<N>>,
    pub(crate) depth: Float64<N>,
}

/// The way from the space of the rays to a picture of so many pixels. All four numbers of a point are linear, before the eye
/// and behind it; w is the depth for a perspective, and for a parallel projection 1 for points and 0 for directions.
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
        let HomogeneousPoints { at, depth } = self.points(vector64([point; 1]));
        HomogeneousPoint { at: DVec3::new(at.x.0[0], at.y.0[0], at.z.0[0]), depth: depth.0[0] }
    }

    /// Points side by side.
    #[inline(always)]
    pub(crate) fn points<const N: usize>(&self, points: Vector<Float64<N>>) -> HomogeneousPoints<N> {
        self.offsets(points - vector64([self.position; N]), 1.0)
    }

    /// Directions side by side.
    #[inline(always)]
    pub(crate) fn directions<const N: usize>(&self, directions: Vector<Float64<N>>) -> HomogeneousPoints<N> {
        self.offsets(directions, 0.0)
    }

    /// The unit directions from points towards the viewer.
    #[inline(always)]
    pub(crate) fn toward_viewer<const N: usize>(&self, points: Vector<Float64<N>>) -> Vector<Float64<N>> {
        let backward = vector64([-self.axes[2]; N]);
        if self.is_parallel {
            backward
        } else {
            (vector64([self.position; N]) - points).normalize_or(backward)
        }
    }

    #[inline(always)]
    fn offsets<const N: usize>(&self, offset: Vector<Float64<N>>, w: f64) -> HomogeneousPoints<N> {
        let [right, up, forward] = self.axes;
        let right = offset.dot(vector64([right; N]));
        let up = offset.dot(vector64([up; N]));
        let depth = offset.dot(vector64([forward; N]));
        let w = if self.is_parallel { Float64([w; N]) } else { depth };
        let half = w * 0.5;
        let x = Float64([self.scale; N]) * right + half * Float64([self.size.x; N]);
        let y = Float64([self.scale; N]) * -up + half * Float64([self.size.y; N]);
        HomogeneousPoints { at: Vector::new(x, y, w), depth }
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
