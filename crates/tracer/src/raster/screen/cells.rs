//! What the picture shows at places between the samples of its pixels.

use crate::geometry::ray::NO_START;
use crate::raster::gbuffer::GBuffer;
use crate::raster::screen::to_words;
use crate::raster::screen::way::ScreenMarks;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32, MOST_LANES, Mask as _, Width, Word as _, each_lane};
use crate::transport::camera::ScreenDepth;
use crate::transport::tile::hits::SurfaceTexel;

/// The samples of a picture and the cells between them: squares with four samples at their corners.
pub(crate) struct ScreenCells<'a> {
    surfaces: &'a [SurfaceTexel],
    normals: &'a [[f32; 3]],
    /// Samples in a row.
    width: usize,
    /// Where the sample lies in its pixel.
    pub(crate) offset: [f32; 2],
    /// The last column and row of samples.
    last: [f32; 2],
}

/// The cells that rays looked at last, and whether the pixels there face them: where rays stay, nothing is read anew.
pub(crate) struct CellLookup {
    directions: [[f32; MOST_LANES]; 3],
    corners: [usize; MOST_LANES],
    /// Depth and start of the left and the right sample.
    above: [[f32; 4]; MOST_LANES],
    below: [[f32; 4]; MOST_LANES],
    /// The pixels whose normals were looked at.
    pixels: [usize; MOST_LANES],
    /// Which of these face the rays.
    facing: u32,
}

impl CellLookup {
    /// Nothing looked at as yet, for rays in these directions.
    #[inline(always)]
    pub(crate) fn new<R: Float32>(direction: Vector<R>) -> Self {
        let mut directions = [[0.0; MOST_LANES]; 3];
        let [x, y, z] = &mut directions;
        direction.x.store(x);
        direction.y.store(y);
        direction.z.store(z);
        Self {
            directions,
            corners: [usize::MAX; MOST_LANES],
            above: [[0.0; 4]; MOST_LANES],
            below: [[0.0; 4]; MOST_LANES],
            pixels: [usize::MAX; MOST_LANES],
            facing: 0,
        }
    }

    /// The upper left sample of the cell of a ray.
    #[inline(always)]
    pub(crate) fn corner(&self, lane: usize) -> usize {
        self.corners[lane]
    }
}

/// Places of rays in their cells.
pub(crate) struct CellPlaces<W: Width> {
    /// From the left sample to the right one, and from the upper to the lower, 0 to 1.
    at: [W::R; 2],
    /// Whether the nearest sample is right, and whether it is below.
    nearest: [W::M; 2],
    /// The depth there: interpolated between samples of one surface, else that of the nearest.
    pub(crate) depth: W::R,
    /// The surface of the nearest sample, [`SurfaceTexel::start`].
    pub(crate) start: W::W,
    /// Which samples show that: upper left, upper right, lower left, lower right.
    shows: [W::M; 4],
}

impl<'a> ScreenCells<'a> {
    pub(crate) fn new(buffer: &'a GBuffer) -> Self {
        Self {
            surfaces: &buffer.hits.surfaces,
            normals: &buffer.hits.normals,
            width: buffer.frame.width,
            offset: buffer.offset.as_vec2().to_array(),
            last: (buffer.frame.size() - 1.0).as_vec2().to_array(),
        }
    }

    /// Places of the picture in pixels of which the samples are the centers.
    #[inline(always)]
    pub(crate) fn pixel_places<R: Float32>(&self, marks: &ScreenMarks<R>) -> [R; 2] {
        let [x, y] = self.offset;
        [marks.x + (0.5 - x), marks.y + (0.5 - y)]
    }

    /// Places brought into the columns and rows of the picture.
    #[inline(always)]
    pub(crate) fn within_picture<W: Width>(&self, w: W, [x, y]: [W::R; 2]) -> [W::R; 2] {
        let [last_x, last_y] = self.last.map(|last| w.real(last));
        let zero = w.real(0.0);
        [x.max(zero).min(last_x), y.max(zero).min(last_y)]
    }

    /// Looks at places of the picture, pixels from its upper left corner.
    #[inline(always)]
    pub(crate) fn look<W: Width>(
        &self,
        w: W,
        lookup: &mut CellLookup,
        [x, y]: [W::R; 2],
        lanes: u32,
    ) -> CellPlaces<W> {
        let [offset_x, offset_y] = self.offset;
        let [x, y] = self.within_picture(w, [x - offset_x, y - offset_y]);
        // The last cell ends at the last sample.
        let [left, top] = [(x, self.last[0]), (y, self.last[1])]
            .map(|(place, last)| place.floor().min(w.real((last - 1.0).max(0.0))));
        let (mut columns, mut rows) = ([0; MOST_LANES], [0; MOST_LANES]);
        to_words(left).store(&mut columns);
        to_words(top).store(&mut rows);
        each_lane(lanes, |lane| {
            let corner = rows[lane] as usize * self.width + columns[lane] as usize;
            if lookup.corners[lane] != corner {
                lookup.corners[lane] = corner;
                lookup.above[lane] = self.pair(corner);
                lookup.below[lane] = self.pair(corner + self.width);
            }
        });
        let at = [x - left, y - top];
        let above = w.load_fours(&lookup.above);
        let below = w.load_fours(&lookup.below);
        self.interpolated(w, at, [above, below])
    }

    #[inline(always)]
    fn interpolated<W: Width>(&self, w: W, at: [W::R; 2], cell: [[W::R; 4]; 2]) -> CellPlaces<W> {
        let half = w.real(0.5);
        let [right, below] = at.map(|place| place.ge(half));
        let [[a, start_a, b, start_b], [c, start_c, d, start_d]] = cell;
        let nearest = |[a, b, c, d]: [W::R; 4]| {
            W::R::select(below, W::R::select(right, d, c), W::R::select(right, b, a))
        };
        let start = nearest([start_a, start_b, start_c, start_d]).to_word();
        let shows = [start_a, start_b, start_c, start_d].map(|other| other.to_word().equals(start));
        let upper = (b - a).times_plus(at[0], a);
        let lower = (d - c).times_plus(at[0], c);
        // Rounding leads to no depth that is not between those of the samples.
        let between = (lower - upper).times_plus(at[1], upper);
        let between = between.max(a.min(b).min(c.min(d))).min(a.max(b).max(c.max(d)));
        let are_one = shows[0] & shows[1] & shows[2] & shows[3];
        let depth = W::R::select(are_one, between, nearest([a, b, c, d]));
        CellPlaces { at, nearest: [right, below], depth, start, shows }
    }

    /// A sample and the one right of it.
    #[inline(always)]
    fn pair(&self, at: usize) -> [f32; 4] {
        const NOTHING: SurfaceTexel = SurfaceTexel { depth: ScreenDepth::NOTHING, start: NO_START };
        let texel = |at: usize| self.surfaces.get(at).copied().unwrap_or(NOTHING);
        bytemuck::cast([texel(at), texel(at + 1)])
    }

    /// The samples at the corners of a cell, in the order of [`CellPlaces::shares`].
    #[inline(always)]
    pub(crate) fn pixels(&self, corner: usize) -> [usize; 4] {
        [corner, corner + 1, corner + self.width, corner + self.width + 1]
    }

    /// Whether the surfaces of the nearest samples face rays of `lanes`.
    #[inline(always)]
    pub(crate) fn facing<W: Width>(
        &self,
        w: W,
        lookup: &mut CellLookup,
        places: &CellPlaces<W>,
        lanes: u32,
    ) -> W::M {
        let [right, below] = places.nearest.map(|nearest| nearest.bits() as usize);
        each_lane(lanes, |lane| {
            let pixel = lookup.corners[lane] + (right >> lane & 1) + (below >> lane & 1) * self.width;
            if lookup.pixels[lane] != pixel {
                lookup.pixels[lane] = pixel;
                let [x, y, z] = self.normals.get(pixel).copied().unwrap_or_default();
                let [along_x, along_y, along_z] = &lookup.directions;
                let cosine = x * along_x[lane] + y * along_y[lane] + z * along_z[lane];
                lookup.facing = lookup.facing & !(1 << lane) | u32::from(cosine < 0.0) << lane;
            }
        });
        w.mask(lookup.facing)
    }
}

impl<W: Width> CellPlaces<W> {
    /// The shares of the samples that show the surface of the nearest one, 0 of others; they may add up to less than 1.
    #[inline(always)]
    pub(crate) fn shares(&self, w: W) -> [W::R; 4] {
        let (zero, one) = (w.real(0.0), w.real(1.0));
        let [right, lower] = self.at;
        let [left, upper] = [one - right, one - lower];
        let shares = [left * upper, right * upper, left * lower, right * lower];
        let mut own = [zero; 4];
        for ((own, share), shows) in own.iter_mut().zip(shares).zip(self.shows) {
            *own = W::R::select(shows, share, zero);
        }
        own
    }
}
