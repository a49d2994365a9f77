//! What the hierarchy is built over: boxes, and parts of their list.

use glam::{Vec3A, Vec4};

use crate::geometry::bounds::Bounds;

/// A body to be sorted into the hierarchy: its box, its place and its shape, in two vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BuildEntry {
    /// Least coordinates, and the place; see [`Self::PLACE`].
    low: Vec4,
    /// Greatest coordinates, and the kind of shape.
    high: Vec4,
}

impl BuildEntry {
    /// Added to a place, so that its bits are those of an ordinary number, which sums over all four components do not
    /// mind: places are below 2³⁰.
    const PLACE: u32 = 0x0080_0000;

    pub(crate) fn new(bounds: Bounds, place: u32, kind: u32) -> Self {
        debug_assert!(place < 1 << 30, "the place's bits stand for an ordinary number");
        Self {
            low: bounds.min.extend(f32::from_bits(place + Self::PLACE)),
            high: bounds.max.extend(kind as f32),
        }
    }

    pub(crate) fn bounds(&self) -> Bounds {
        Bounds { min: self.low.truncate(), max: self.high.truncate() }
    }

    /// The body's place in what the entries were made from.
    pub(crate) fn place(&self) -> u32 {
        self.low.w.to_bits() - Self::PLACE
    }

    /// Twice the middle of the box.
    fn center(&self) -> Vec4 {
        self.low + self.high
    }

    /// Order in a leaf: by shape, then by place.
    pub(crate) fn leaf_key(&self) -> (u32, u32) {
        (self.high.w as u32, self.place())
    }

    /// A total order of entries along an axis.
    pub(crate) fn compare(&self, other: &Self, axis: usize) -> std::cmp::Ordering {
        let along = self.center()[axis].total_cmp(&other.center()[axis]);
        along.then_with(|| self.place().cmp(&other.place()))
    }
}

/// A box that grows; the fourth components mean nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundsAccumulator {
    low: Vec4,
    high: Vec4,
}

impl BoundsAccumulator {
    pub(crate) const EMPTY: Self = Self { low: Vec4::INFINITY, high: Vec4::NEG_INFINITY };

    #[inline]
    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// With the entry's box.
    #[inline]
    pub(crate) fn with(self, entry: &BuildEntry) -> Self {
        self.union(Self { low: entry.low, high: entry.high })
    }

    /// With twice the middle of the entry's box.
    #[inline]
    pub(crate) fn with_center(self, entry: &BuildEntry) -> Self {
        let center = entry.center();
        self.union(Self { low: center, high: center })
    }

    #[inline]
    pub(crate) fn half_area(&self) -> f32 {
        let size = Vec3A::from_vec4((self.high - self.low).max(Vec4::ZERO));
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    pub(crate) fn bounds(&self) -> Bounds {
        Bounds { min: self.low.truncate(), max: self.high.truncate() }
    }

    /// The axis along which it is longest.
    pub(crate) fn longest_axis(&self) -> usize {
        (self.high - self.low).truncate().max_position()
    }
}

/// Equal intervals between the least and the greatest center, along all three axes.
#[derive(Clone, Copy)]
pub(crate) struct BinGrid {
    low: Vec4,
    per_unit: Vec4,
    last: Vec4,
}

impl BinGrid {
    /// Adding this to a small number leaves its nearest whole number in the lowest bits.
    const WHOLE: f32 = 8_388_608.0;

    /// `count` intervals between the centers' limits; along an axis on which all centers agree there is just one.
    pub(crate) fn new(centers: &BoundsAccumulator, count: usize) -> Self {
        let per_unit = count as f32 / (centers.high - centers.low);
        let per_unit = Vec4::select(per_unit.is_finite_mask(), per_unit, Vec4::ZERO);
        Self { low: centers.low, per_unit, last: Vec4::splat(count as f32 - 1.0) }
    }

    /// Whether there is an axis along which centers differ.
    pub(crate) fn is_any(&self) -> bool {
        self.per_unit.truncate() != glam::Vec3::ZERO
    }

    /// The entry's interval along each axis.
    #[inline]
    pub(crate) fn of(&self, entry: &BuildEntry) -> [usize; 3] {
        let at = (entry.center() - self.low) * self.per_unit - 0.5;
        let whole = at.max(Vec4::ZERO).min(self.last) + Self::WHOLE;
        let [x, y, z, _] = whole.to_array().map(|whole| (whole.to_bits() & 0xff) as usize);
        [x, y, z]
    }

    /// The entry's interval along one axis, by the same operations.
    #[inline]
    pub(crate) fn along(&self, axis: usize, entry: &BuildEntry) -> usize {
        let at = (entry.low[axis] + entry.high[axis] - self.low[axis]) * self.per_unit[axis] - 0.5;
        let whole = at.max(0.0).min(self.last[axis]) + Self::WHOLE;
        (whole.to_bits() & 0xff) as usize
    }
}
