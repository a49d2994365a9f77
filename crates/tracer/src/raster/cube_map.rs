//! A picture of all that surrounds a point, on the six faces of a cube (Greene 1986, Environment Mapping and Other
//! Applications of World Projections).

pub(crate) mod active;
pub(crate) mod cache;
pub(crate) mod proxy;

use catoptric_picture::{Picture, SizeError};
use catoptric_scene::{Camera, Projection};
use glam::{DVec3, Vec3};

use crate::raster::error::MethodError;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::{RenderSettings, render_through};
use crate::transport::scene::RenderScene;

/// A face: where it looks, and what is right and up in it.
#[derive(Clone, Copy, Debug)]
struct CubeFaceAxes {
    forward: DVec3,
    right: DVec3,
    up: DVec3,
}

const fn axes(forward: DVec3, right: DVec3, up: DVec3) -> CubeFaceAxes {
    CubeFaceAxes { forward, right, up }
}

/// The faces towards +X, -X, +Y, -Y, +Z, -Z, turned so that they join in the unfolded cube.
const FACES: [CubeFaceAxes; 6] = [
    axes(DVec3::X, DVec3::Z, DVec3::Y),
    axes(DVec3::NEG_X, DVec3::NEG_Z, DVec3::Y),
    axes(DVec3::Y, DVec3::X, DVec3::Z),
    axes(DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z),
    axes(DVec3::Z, DVec3::NEG_X, DVec3::Y),
    axes(DVec3::NEG_Z, DVec3::X, DVec3::Y),
];

/// Where a direction meets the cube: a face, and there the numbers of pixels from its upper left corner.
struct CubeMapPoint {
    face: usize,
    x: f32,
    y: f32,
}

/// The light that comes to a point from all directions, in linear light.
///
/// Each face is rendered one pixel wider on every side than the cube's, so that light is interpolated up to the edges and
/// corners of the cube as within a face.
#[derive(Clone, Debug, PartialEq)]
pub struct CubeMap {
    center: DVec3,
    size: usize,
    /// Six faces of (size + 2)² pixels, row by row.
    pixels: Vec<[f32; 3]>,
}

impl CubeMap {
    /// Renders what surrounds `center`, in the space of the rays, in `scene`, in faces of `size`² pixels.
    ///
    /// # Errors
    /// When the size is 0 or too large, memory is short, or the work is cancelled.
    pub fn render(
        scene: &RenderScene,
        center: DVec3,
        size: u32,
        control: &RenderControl,
    ) -> Result<(Self, RayCounts), MethodError> {
        let mut map = Self::empty(center, size)?;
        let mut counts = RayCounts::default();
        let side = size + 2;
        let half_angle = (f64::from(side) / f64::from(size)).atan();
        let projection = Projection::Perspective { fov_degrees: 2.0 * half_angle.to_degrees() };
        let settings = RenderSettings { width: side, height: side, samples: 1 };
        for (face, pixels) in FACES.iter().zip(map.pixels.chunks_mut((side * side) as usize)) {
            let position = scene.geometry.space.origin + center;
            let camera = Camera { position, target: position + face.forward, up: face.up, projection };
            let rendering = render_through(scene, &scene.camera_for(&camera), settings, control)?;
            counts += rendering.counts;
            pixels.iter_mut().zip(rendering.picture.pixels()).for_each(|(to, from)| *to = *from);
        }
        Ok((map, counts))
    }

    fn empty(center: DVec3, size: u32) -> Result<Self, SizeError> {
        Picture::check_size(size, size)?;
        Picture::check_size(size.saturating_add(2), size.saturating_add(2))?;
        let count = Self::pixels_of(size);
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| SizeError::Memory {
            width: size,
            height: size,
            bytes: Self::bytes_of(size) as u64,
        })?;
        pixels.resize(count, [0.0; 3]);
        Ok(Self { center, size: size as usize, pixels })
    }

    /// The bytes of a map with faces of `size`² pixels.
    pub fn bytes_of(size: u32) -> usize {
        Self::pixels_of(size) * size_of::<[f32; 3]>()
    }

    /// The pixels that are rendered for it.
    fn pixels_of(size: u32) -> usize {
        let side = size as usize + 2;
        6 * side * side
    }

    /// The point that is surrounded, in the space of the rays, meters.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// The edge of a face, pixels.
    pub fn size(&self) -> u32 {
        self.size as u32
    }

    /// The light that comes from this direction (of any length above 0), interpolated between the four pixels around.
    pub fn light(&self, direction: Vec3) -> Vec3 {
        let CubeMapPoint { face, x, y } = self.spot(direction);
        // Pixels have their values at their centers.
        let (x, y) = (x - 0.5, y - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let pixel = |dx: isize, dy: isize| self.pixel(face, left as isize + dx, top as isize + dy);
        let upper = pixel(0, 0).lerp(pixel(1, 0), x - left);
        let lower = pixel(0, 1).lerp(pixel(1, 1), x - left);
        upper.lerp(lower, y - top)
    }

    /// The unfolded cube, a cross four faces wide and three high: in the middle row the faces towards -X, -Z, +X and +Z,
    /// +Y above and -Y below the one towards -Z. The rest is black.
    ///
    /// # Errors
    /// When the picture is too large or memory is short.
    pub fn unfolded(&self) -> Result<Picture, SizeError> {
        const CROSS: [[Option<usize>; 4]; 3] =
            [[None, Some(2), None, None], [Some(1), Some(5), Some(0), Some(4)], [None, Some(3), None, None]];
        let size = self.size as u32;
        Picture::from_fn(4 * size, 3 * size, |x, y| {
            let face = CROSS.get((y / size) as usize).and_then(|row| row.get((x / size) as usize));
            let pixel = |face: &usize| self.pixel(*face, (x % size) as isize, (y % size) as isize).to_array();
            face.and_then(Option::as_ref).map_or([0.0; 3], pixel)
        })
    }

    /// Where a direction meets the cube: on the face of its largest component.
    fn spot(&self, direction: Vec3) -> CubeMapPoint {
        let sides = direction.abs();
        let axis = if sides.x >= sides.y.max(sides.z) {
            0
        } else if sides.z >= sides.y {
            2
        } else {
            1
        };
        let face = 2 * axis + usize::from(direction[axis] < 0.0);
        let axes = FACES[face];
        let along = |unit: DVec3| direction.dot(unit.as_vec3());
        let depth = along(axes.forward);
        let place = |side: f32| 0.5 * self.size as f32 * (side / depth + 1.0);
        let within = |place: f32| if place >= 0.0 { place.min(self.size as f32) } else { 0.0 };
        CubeMapPoint { face, x: within(place(along(axes.right))), y: within(place(-along(axes.up))) }
    }

    /// The place of a pixel; those of the border are -1 and `size`.
    fn index(&self, face: usize, x: isize, y: isize) -> usize {
        let side = self.size + 2;
        let within = |at: isize| (at + 1).clamp(0, side as isize - 1) as usize;
        (face * side + within(y)) * side + within(x)
    }

    fn pixel(&self, face: usize, x: isize, y: isize) -> Vec3 {
        self.pixels.get(self.index(face, x, y)).copied().unwrap_or_default().into()
    }
}

#[cfg(test)]
mod tests;
