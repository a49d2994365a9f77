//! The codes that an explanation expects of a picture, by their places in the file.

use std::collections::BTreeMap;

use glam::Vec3;

use super::observed::ObservedPicture;

/// The expected codes of all pixels, or of some of them.
#[derive(Debug)]
pub(super) struct ExpectedCodes {
    size: [u32; 2],
    /// Row by row; not a number where nothing is known.
    codes: Vec<Vec3>,
}

impl ExpectedCodes {
    pub(super) fn new(size: [u32; 2]) -> Self {
        let count = size.map(|side| side as usize).iter().product();
        Self { size, codes: vec![Vec3::NAN; count] }
    }

    fn place(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.size[0] as usize + x as usize
    }

    /// Notes what is expected of a pixel.
    pub(super) fn set(&mut self, pixel: [u32; 2], expected: [f32; 3]) {
        let place = self.place(pixel);
        if let Some(own) = self.codes.get_mut(place) {
            *own = expected.into();
        }
    }

    /// The known pixels from one corner to before the other.
    fn known(&self, from: [u32; 2], to: [u32; 2]) -> impl Iterator<Item = ([u32; 2], Vec3)> {
        let to = [0, 1].map(|axis| to[axis].min(self.size[axis]));
        let all = (from[1]..to[1]).flat_map(move |y| (from[0]..to[0]).map(move |x| [x, y]));
        let code = |pixel| self.codes.get(self.place(pixel)).copied().filter(|code| !code.is_nan());
        all.filter_map(move |pixel| Some((pixel, code(pixel)?)))
    }

    /// The least and the largest code of each channel among the known pixels up to a distance around a block.
    fn bounds(&self, from: [u32; 2], to: [u32; 2], reach: u32) -> [Vec3; 2] {
        let around = self.known(from.map(|at| at.saturating_sub(reach)), to.map(|at| at + reach));
        around.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], (_, code)| {
            [low.min(code), high.max(code)]
        })
    }

    /// Whether the expected codes of a pixel and its neighbors enclose a code.
    pub(super) fn enclose(&self, pixel: [u32; 2], code: [f32; 3], tolerance: f32) -> bool {
        let [low, high] = self.bounds(pixel, pixel.map(|at| at + 1), 1);
        let code = Vec3::from(code);
        code.cmpge(low - tolerance).all() && code.cmple(high + tolerance).all()
    }
}

/// What blocks of a picture that was compressed with loss may be off by.
///
/// JPEG keeps the mean of a block well, and details the worse the finer they are: an edge disturbs all pixels of its
/// block. Colors are kept with half the resolution, and are interpolated beyond the borders of blocks.
pub(super) struct BlockLosses<'a> {
    side: u32,
    tolerance: f32,
    picture: &'a ObservedPicture,
    expected: &'a ExpectedCodes,
    known: BTreeMap<[u32; 2], BlockLoss>,
}

/// What a block may have lost.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockLoss {
    /// The largest difference of a channel that an edge in the block explains.
    pub(super) most: f32,
    /// Whether the block as a whole is as it should be, but for an edge in it.
    pub(super) is_kept: bool,
}

impl<'a> BlockLosses<'a> {
    /// Pixels beyond a block that change it by interpolation.
    const MARGIN: u32 = 2;

    /// The losses in blocks of this side, 0 for a picture without loss.
    pub(super) fn new(
        side: u32,
        tolerance: f32,
        picture: &'a ObservedPicture,
        expected: &'a ExpectedCodes,
    ) -> Self {
        Self { side, tolerance, picture, expected, known: BTreeMap::new() }
    }

    /// The loss of the block of a pixel.
    pub(super) fn at(&mut self, pixel: [u32; 2]) -> BlockLoss {
        if self.side == 0 {
            return BlockLoss { most: 0.0, is_kept: false };
        }
        let block = pixel.map(|at| at / self.side);
        if let Some(known) = self.known.get(&block) {
            return *known;
        }
        let loss = self.of_block(block.map(|at| at * self.side));
        self.known.insert(block, loss);
        loss
    }

    /// Whether an edge in its block explains the difference of a pixel.
    pub(super) fn explain(&mut self, pixel: [u32; 2]) -> bool {
        let [low, high] = self.expected.bounds(pixel, pixel.map(|at| at + 1), 0);
        let found = Vec3::from(self.picture.value(pixel));
        (found - low).abs().max((found - high).abs()).max_element() <= self.at(pixel).most
    }

    fn of_block(&self, start: [u32; 2]) -> BlockLoss {
        let end = start.map(|at| at + self.side);
        let [low, high] = self.expected.bounds(start, end, Self::MARGIN);
        // Colors are mixed: what one channel has, others feel.
        let contrast = (high - low).max_element().max(0.0);
        let (mut count, mut sum, mut square) = (0.0_f32, Vec3::ZERO, Vec3::ZERO);
        for (pixel, expected) in self.expected.known(start, end) {
            let difference = Vec3::from(self.picture.value(pixel)) - expected;
            count += 1.0;
            sum += difference;
            square += difference * difference;
        }
        let [mean, square] = [sum, square].map(|sum| (sum / count.max(1.0)).abs().max_element());
        let is_kept = contrast > 4.0 * self.tolerance
            && mean <= 0.25 * self.tolerance + contrast / 32.0
            && square.sqrt() <= 0.5 * self.tolerance + contrast / 8.0;
        BlockLoss { most: self.tolerance + 0.5 * contrast, is_kept }
    }
}
