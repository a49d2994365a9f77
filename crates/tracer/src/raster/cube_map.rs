//! A picture of all that surrounds a point, on the six faces of a cube (Greene 1986, Environment Mapping and Other
//! Applications of World Projections).

pub(crate) mod active;
pub(crate) mod cache;
pub(crate) mod proxy;

use catoptric_picture::{Picture, SizeError};
use catoptric_scene::{Camera, Projection};
use glam::{DVec3, Vec3};

use crate::raster::error::MethodError;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Width, Word as _};
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::{RenderSettings, render_through};
use crate::transport::scene::RenderScene;

/// A face: where it looks, and what is up in it.
#[derive(Clone, Copy, Debug)]
struct CubeFaceAxes {
    forward: DVec3,
    up: DVec3,
}

const fn axes(forward: DVec3, up: DVec3) -> CubeFaceAxes {
    CubeFaceAxes { forward, up }
}

/// The faces towards +X, -X, +Y, -Y, +Z, -Z, turned so that they join in the unfolded cube.
const FACES: [CubeFaceAxes; 6] = [
    axes(DVec3::X, DVec3::Y),
    axes(DVec3::NEG_X, DVec3::Y),
    axes(DVec3::Y, DVec3::Z),
    axes(DVec3::NEG_Y, DVec3::NEG_Z),
    axes(DVec3::Z, DVec3::Y),
    axes(DVec3::NEG_Z, DVec3::Y),
];

/// Where directions meet the cube: faces, and there the numbers of pixels from the upper left corner.
struct CubeMapPoints<W: Width> {
    faces: [u32; MOST_LANES],
    x: W::R,
    y: W::R,
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
        let mut light = [Vec3::ZERO.into()];
        self.light_all(ScalarWidth, &[direction.into()], &mut light);
        light[0].into()
    }

    /// Writes the light that comes from each of these directions, at most as many as `w` has lanes.
    #[inline(always)]
    pub(crate) fn light_all<W: Width>(&self, w: W, directions: &[Vector<f32>], light: &mut [Vector<f32>]) {
        let mut rows = [[0.0; MOST_LANES]; 3];
        for (lane, direction) in directions.iter().enumerate().take(W::LANES) {
            (rows[0][lane], rows[1][lane], rows[2][lane]) = (direction.x, direction.y, direction.z);
        }
        let direction = Vector::new(w.load(&rows[0]), w.load(&rows[1]), w.load(&rows[2]));
        let CubeMapPoints { faces, x, y } = self.spots(w, direction);
        // Pixels have their values at their centers.
        let (x, y) = (x - 0.5, y - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (mut columns, mut lines) = ([0.0; MOST_LANES], [0.0; MOST_LANES]);
        left.store(&mut columns);
        top.store(&mut lines);
        let mut corners = [[[0.0; MOST_LANES]; 3]; 4];
        for lane in 0..directions.len().min(W::LANES) {
            let (column, line) = (columns[lane] as isize, lines[lane] as isize);
            let around = [(column, line), (column + 1, line), (column, line + 1), (column + 1, line + 1)];
            for (corner, (column, line)) in corners.iter_mut().zip(around) {
                let Vec3 { x, y, z } = self.pixel(faces[lane] as usize, column, line);
                (corner[0][lane], corner[1][lane], corner[2][lane]) = (x, y, z);
            }
        }
        let one = w.real(1.0);
        let (right, below) = (x - left, y - top);
        let mut parts = [[0.0; MOST_LANES]; 3];
        for part in 0..3 {
            let corner = |number: usize| w.load(&corners[number][part]);
            let upper = corner(0) * (one - right) + corner(1) * right;
            let lower = corner(2) * (one - right) + corner(3) * right;
            (upper * (one - below) + lower * below).store(&mut parts[part]);
        }
        for (lane, light) in light.iter_mut().enumerate().take(W::LANES) {
            *light = Vector::new(parts[0][lane], parts[1][lane], parts[2][lane]);
        }
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

    /// Where directions meet the cube: each on the face of its largest component, with the axes of [`FACES`].
    #[inline(always)]
    fn spots<W: Width>(&self, w: W, direction: Vector<W::R>) -> CubeMapPoints<W> {
        let Vector { x, y, z } = direction;
        let (zero, one) = (w.real(0.0), w.real(1.0));
        let is_x = x.abs().ge(y.abs().max(z.abs()));
        let is_z = !is_x & z.abs().ge(y.abs());
        let forward = W::R::select(is_x, x, W::R::select(is_z, z, y));
        let backward = forward.lt(zero);
        let sign = W::R::select(backward, -one, one);
        let right = W::R::select(is_x, z * sign, W::R::select(is_z, -x * sign, x));
        let up = W::R::select(is_x | is_z, y, z * sign);
        let size = w.real(self.size as f32);
        let place = |side: W::R| {
            let place = (side / forward.abs() + 1.0) * (0.5 * self.size as f32);
            W::R::select(place.ge(zero), place.min(size), zero)
        };
        let axis = W::W::select(is_x, w.word(0), W::W::select(is_z, w.word(4), w.word(2)));
        let mut faces = [0; MOST_LANES];
        axis.or(W::W::select(backward, w.word(1), w.word(0))).store(&mut faces);
        CubeMapPoints { faces, x: place(right), y: place(-up) }
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
