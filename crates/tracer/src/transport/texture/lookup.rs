//! Pictures that the tracer looks light and colors up in.

use std::sync::Arc;

use catoptric_picture::Picture;
use catoptric_scene::Image;

/// A picture, interpolated between the four pixels around a place. Equal only to itself.
#[derive(Clone, Debug)]
pub(crate) struct ImageLookup(Arc<Picture>);

impl PartialEq for ImageLookup {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// What lies beside a picture along one of its axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AddressMode {
    /// Its other edge.
    Repeats,
    /// More of its edge.
    Ends,
}

impl AddressMode {
    /// The column or row, of so many, that stands for a whole number of them.
    fn index(self, at: f32, count: u32) -> u32 {
        let index = match self {
            Self::Repeats => at.rem_euclid(count as f32) as u32,
            Self::Ends => at.max(0.0) as u32,
        };
        index.min(count - 1)
    }
}

impl ImageLookup {
    /// `None` while the pixels are not known.
    pub(crate) fn new(image: &Image) -> Option<Self> {
        image.pixels().map(|pixels| Self(Arc::clone(pixels)))
    }

    pub(crate) fn width(&self) -> u32 {
        self.0.width()
    }

    pub(crate) fn height(&self) -> u32 {
        self.0.height()
    }

    /// Row by row from the top.
    pub(crate) fn pixels(&self) -> &[[f32; 3]] {
        self.0.pixels()
    }

    /// A number that no other picture has while this one is kept.
    pub(crate) fn number(&self) -> u64 {
        Arc::as_ptr(&self.0) as usize as u64
    }

    /// The color at a place, from the upper left corner (0, 0) to the lower right one (1, 1), where this lies to the left and
    /// right of the picture, and above and below it. A place that is no number is the corner.
    pub(crate) fn at(&self, u: f32, v: f32, [beside, above]: [AddressMode; 2]) -> [f32; 3] {
        let (width, height) = (self.0.width(), self.0.height());
        // Pixels have their values at their centers.
        let (x, y) = (u * width as f32 - 0.5, v * height as f32 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let columns = [left, left + 1.0].map(|column| beside.index(column, width));
        let rows = [top, top + 1.0].map(|row| above.index(row, height));
        let [across, down] = [x - left, y - top];
        let pixel = |column: usize, row: usize| self.0.pixel(columns[column], rows[row]).unwrap_or_default();
        let corners = [pixel(0, 0), pixel(1, 0), pixel(0, 1), pixel(1, 1)];
        std::array::from_fn(|channel| {
            let [a, b, c, d] = corners.map(|corner| corner[channel]);
            let (upper, lower) = (a + (b - a) * across, c + (d - c) * across);
            upper + (lower - upper) * down
        })
    }
}

#[cfg(test)]
impl ImageLookup {
    /// From rows of gray pixels.
    pub(crate) fn of_grays<const W: usize>(rows: &[[f32; W]]) -> Self {
        let pixels = rows.iter().flatten().map(|gray| [*gray; 3]).collect();
        Self(Arc::new(Picture::from_pixels(W as u32, rows.len() as u32, pixels).unwrap()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_between_the_centers_of_pixels() {
        let image = ImageLookup::of_grays(&[[0.0, 1.0, 2.0, 3.0], [4.0, 5.0, 6.0, 7.0]]);
        let at = |u: f32, v: f32, beyond| image.at(u, v, beyond)[0];
        let both = [AddressMode::Repeats, AddressMode::Ends].map(|beside| [beside, AddressMode::Ends]);
        for beyond in both {
            assert_eq!(at(0.125, 0.25, beyond), 0.0);
            assert_eq!(at(0.875, 0.75, beyond), 7.0);
            assert_eq!(at(0.5, 0.5, beyond), 3.5);
            assert_eq!(at(0.5, 0.0, beyond), 1.5, "above there is more of the edge");
            assert_eq!(at(0.5, 9.0, beyond), 5.5);
        }
        assert_eq!(both.map(|beyond| at(0.0, 0.25, beyond)), [1.5, 0.0]);
        assert_eq!(both.map(|beyond| at(1.0, 0.25, beyond)), [1.5, 3.0]);
        let around = [AddressMode::Repeats; 2];
        assert_eq!(at(-3.875, 0.25, around), 0.0);
        assert_eq!([-1.75, 0.25, 7.25].map(|v| at(0.125, v, around)), [0.0; 3]);
        assert_eq!(
            [-2.0, 0.0, 1.0].map(|v| at(0.125, v, around)),
            [2.0; 3],
            "the last row lies above the first"
        );
        assert_eq!(at(0.125, 0.0, [AddressMode::Ends, AddressMode::Repeats]), 2.0);
        for place in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
            for beyond in both.into_iter().chain([around]) {
                let _ = (at(place, 0.3, beyond), at(0.3, place, beyond));
            }
        }
    }
}
