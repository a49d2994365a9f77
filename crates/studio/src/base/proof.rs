//! A picture made small enough for the window, on a thread of its own.

use catoptric_picture::{Development, Picture, srgb};
use catoptric_platform::threads;
use egui::{Color32, ColorImage};
use rayon::prelude::*;

/// The settings of a proof: development and size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProofKey {
    pub(crate) development: Development,
    /// Pixels across and down.
    pub(crate) size: [u32; 2],
}

/// The size of a picture of `size` pixels that is to fit into `room`: never larger than it is, at least a pixel.
pub(crate) fn fitting(size: [u32; 2], room: [u32; 2]) -> [u32; 2] {
    let [width, height] = size.map(f64::from);
    let scale = (f64::from(room[0]) / width).min(f64::from(room[1]) / height).min(1.0);
    [width, height].map(|side| ((side * scale).round() as u32).max(1))
}

/// The size of a picture, pixels.
pub(crate) fn size_of(picture: &Picture) -> [u32; 2] {
    [picture.width(), picture.height()]
}

/// A picture as the window shows it, pixel by pixel.
pub(crate) fn proof_of(picture: &Picture, development: Development) -> ColorImage {
    proof(picture, &ProofKey { development, size: size_of(picture) })
}

/// Develops `picture` and makes it as small as wanted, each pixel the mean light of those that it covers: what a
/// person sees of the developed picture from farther away.
pub(crate) fn proof(picture: &Picture, wanted: &ProofKey) -> ColorImage {
    let [width, height] =
        [wanted.size[0].clamp(1, picture.width()), wanted.size[1].clamp(1, picture.height())];
    let size = [width as usize, height as usize];
    let mut codes = vec![[0u8; 4]; size[0] * size[1]];
    if [width, height] == [picture.width(), picture.height()] {
        wanted.development.develop_rgba8(picture.pixels(), &mut codes);
    } else {
        let scaler = Downscaler::new(picture, wanted.development, size);
        let rows = size[1].div_ceil(threads::processors());
        let bands = codes.par_chunks_mut(rows * size[0]).enumerate();
        bands.for_each(|(band, codes)| scaler.fill(band * rows, codes));
    }
    let pixels = codes.into_iter().map(|[red, green, blue, _]| Color32::from_rgb(red, green, blue)).collect();
    ColorImage::new(size, pixels)
}

/// Makes a picture smaller.
struct Downscaler<'a> {
    picture: &'a Picture,
    development: Development,
    columns: Vec<PixelCoverage>,
    rows: Vec<PixelCoverage>,
    /// The light of each code.
    light: Vec<f32>,
}

/// The pixels along one side that one pixel of the smaller picture covers.
struct PixelCoverage {
    start: usize,
    /// How much of each is covered; 1 in all.
    shares: Vec<f32>,
}

impl<'a> Downscaler<'a> {
    fn new(picture: &'a Picture, development: Development, size: [usize; 2]) -> Self {
        Self {
            picture,
            development,
            columns: spans(picture.width() as usize, size[0]),
            rows: spans(picture.height() as usize, size[1]),
            light: (0..=255).map(|code| srgb::decode(f64::from(code) / 255.0) as f32).collect(),
        }
    }

    /// Fills rows of the smaller picture from row `first` on.
    fn fill(&self, first: usize, codes: &mut [[u8; 4]]) {
        let width = self.picture.width() as usize;
        let mut developed = vec![[0u8; 4]; width];
        let mut sums = vec![[0f32; 3]; self.columns.len()];
        let rows = self.rows.iter().skip(first);
        for (span, codes) in rows.zip(codes.chunks_mut(self.columns.len())) {
            sums.fill([0.0; 3]);
            let source = self.picture.pixels().chunks(width).skip(span.start);
            for (row, &share) in source.zip(&span.shares) {
                self.development.develop_rgba8(row, &mut developed);
                self.add_row(&developed, share, &mut sums);
            }
            Development::default().develop_rgba8(&sums, codes);
        }
    }

    fn add_row(&self, developed: &[[u8; 4]], share: f32, sums: &mut [[f32; 3]]) {
        let light = |code: u8| self.light.get(usize::from(code)).copied().unwrap_or(0.0);
        for (span, sum) in self.columns.iter().zip(sums) {
            for (&[red, green, blue, _], &part) in developed.iter().skip(span.start).zip(&span.shares) {
                let weight = part * share;
                sum[0] += weight * light(red);
                sum[1] += weight * light(green);
                sum[2] += weight * light(blue);
            }
        }
    }
}

/// Divides `from` pixels evenly among `to`.
fn spans(from: usize, to: usize) -> Vec<PixelCoverage> {
    let step = from as f64 / to as f64;
    let span = |index: usize| {
        let (start, end) = (index as f64 * step, (index + 1) as f64 * step);
        let pixels = start as usize..(end.ceil() as usize).min(from);
        let covered = |pixel: usize| (end.min((pixel + 1) as f64) - start.max(pixel as f64)).max(0.0);
        PixelCoverage {
            start: pixels.start,
            shares: pixels.map(|pixel| (covered(pixel) / step) as f32).collect(),
        }
    };
    (0..to).map(span).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(size: [u32; 2]) -> ProofKey {
        ProofKey { development: Development::default(), size }
    }

    #[test]
    fn a_picture_is_fitted_but_never_enlarged() {
        assert_eq!(fitting([3840, 2160], [960, 960]), [960, 540]);
        assert_eq!(fitting([100, 50], [960, 960]), [100, 50]);
        assert_eq!(fitting([1 << 20, 1], [960, 960]), [960, 1]);
        assert_eq!(fitting([10, 10], [0, 0]), [1, 1]);
    }

    #[test]
    fn a_proof_of_the_same_size_is_the_developed_picture() {
        let picture = Picture::from_fn(7, 5, |x, y| [x as f32 / 6.0, y as f32 / 4.0, 2.0]).unwrap();
        let wanted = ProofKey {
            development: Development { exposure_stops: -1.0, ..Development::default() },
            size: [7, 5],
        };
        let proof = proof(&picture, &wanted);
        let mut codes = vec![[0; 4]; 35];
        wanted.development.develop_rgba8(picture.pixels(), &mut codes);
        let found: Vec<[u8; 4]> = proof.pixels.iter().map(Color32::to_array).collect();
        assert_eq!(found, codes);
    }

    #[test]
    fn every_pixel_of_the_picture_counts_alike() {
        for (from, to) in [(10, 3), (7, 7), (1000, 999), (5, 1), (1 << 20, 3)] {
            let mut weights = vec![0.0; from];
            for span in spans(from, to) {
                assert!((span.shares.iter().sum::<f32>() - 1.0).abs() < 1e-4, "{from} to {to}");
                for (weight, share) in weights.iter_mut().skip(span.start).zip(&span.shares) {
                    *weight += f64::from(*share);
                }
            }
            let even = to as f64 / from as f64;
            assert!(weights.iter().all(|weight| (weight / even - 1.0).abs() < 1e-3), "{from} to {to}");
        }
    }

    #[test]
    fn light_is_averaged_and_not_codes() {
        // Black and white in turn have half of the light: code 188, not 128.
        let picture = Picture::from_fn(64, 64, |x, y| [((x + y) % 2) as f32; 3]).unwrap();
        let proof = proof(&picture, &wanted([16, 16]));
        assert_eq!(proof.size, [16, 16]);
        assert!(proof.pixels.iter().all(|pixel| *pixel == Color32::from_gray(188)));
    }

    #[test]
    fn lights_brighter_than_white_do_not_spread() {
        // One pixel of a thousand times white among four: developed it is white, a quarter of the light.
        let picture = Picture::from_fn(2, 2, |x, y| if x + y == 0 { [1000.0; 3] } else { [0.0; 3] }).unwrap();
        assert_eq!(proof(&picture, &wanted([1, 1])).pixels, [Color32::from_gray(137)]);
    }
}
