//! Where in the picture rays go, rightly and wrongly, and which pixels are looked at.

use catoptric_scene::{Projection, Scene};
use glam::DVec2;

/// The part of the view that the picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Window {
    /// As the scene says.
    #[default]
    Right,
    /// The angle that belongs to the width is taken for the height.
    AngleForHeight,
    /// The angle that belongs to the height is taken for the width.
    AngleForWidth,
    /// The window is a square as wide as it should be high, whatever the sides of the picture.
    SquareByHeight,
    /// The window is a square as high as it should be wide.
    SquareByWidth,
    /// The window has the sides of the size that is expected, and is stretched over the picture.
    Stretched,
    /// The tangent of the whole vertical angle in the place of that of its half.
    WholeAngle,
    /// The tangent of the whole horizontal angle in the place of that of its half.
    WholeAngleAcross,
    /// The tangent of a quarter of the vertical angle.
    HalvedAngle,
    /// The tangent of a quarter of the horizontal angle.
    HalvedAngleAcross,
    /// Another part of the view, by numbers.
    Fitted {
        /// Width and height, thousandths of what they should be.
        scale: [i16; 2],
        /// How far the middle lies to the right and below, thousandths of half a picture.
        shift: [i16; 2],
    },
}

impl Window {
    pub(super) const OTHERS: [Self; 9] = [
        Self::AngleForHeight,
        Self::AngleForWidth,
        Self::SquareByHeight,
        Self::SquareByWidth,
        Self::Stretched,
        Self::WholeAngle,
        Self::WholeAngleAcross,
        Self::HalvedAngle,
        Self::HalvedAngleAcross,
    ];

    /// The windows from which the search for others begins.
    pub(super) fn first_fitted(size: [u32; 2]) -> Vec<Self> {
        let aspect = f64::from(size[0]) / f64::from(size[1].max(1));
        let mut all = Vec::new();
        let mut add = |scale: [f64; 2], shift: [f64; 2]| {
            let [scale, shift] = [scale, shift].map(|pair| pair.map(|part| (1000.0 * part).round() as i16));
            all.push(Self::Fitted { scale, shift });
        };
        for other in [4.0 / 3.0, 1.5, 1.6, 16.0 / 9.0, 2.0] {
            if (other - aspect).abs() > 0.01 {
                add([other / aspect, 1.0], [0.0; 2]);
                add([1.0, aspect / other], [0.0; 2]);
            }
        }
        for part in [0.5, 0.75, 0.9, 1.1, 1.25, 1.5] {
            add([part; 2], [0.0; 2]);
            add([part, 1.0], [0.0; 2]);
            add([1.0, part], [0.0; 2]);
        }
        for part in [0.5, 0.75, 0.9] {
            let corner = 1.0 - part;
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                add([part; 2], [x * corner, y * corner]);
            }
        }
        all
    }

    /// Fitted windows whose numbers are near its own.
    pub(super) fn neighbors(self, step: i16) -> Vec<Self> {
        let Self::Fitted { scale, shift } = self else { return Vec::new() };
        let moved =
            |pair: [i16; 2], way: [i16; 2]| [pair[0].saturating_add(way[0]), pair[1].saturating_add(way[1])];
        let ways = [[step, 0], [-step, 0], [0, step], [0, -step], [step, step], [-step, -step]];
        let scales =
            ways.map(|way| Self::Fitted { scale: moved(scale, way).map(|part| part.max(20)), shift });
        let shifts = ways.map(|way| Self::Fitted { scale, shift: moved(shift, way) });
        // Cut at one side, that side moves alone.
        let sides = ways.map(|way| Self::Fitted {
            scale: moved(scale, way).map(|part| part.max(20)),
            shift: moved(shift, way),
        });
        scales.into_iter().chain(shifts).chain(sides).collect()
    }

    /// How many times as wide and high as it should be the window is, and how far its middle is moved, in halves of it;
    /// `None` where the mistake cannot be, or would show nothing.
    pub(super) fn placed(
        self,
        scene: &Scene,
        size: [u32; 2],
        expected: Option<[u32; 2]>,
    ) -> Option<[DVec2; 2]> {
        match self {
            Self::Fitted { scale, shift } => {
                Some([scale, shift].map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)) / 1000.0))
            }
            _ => self.scale(scene, size, expected).map(|scale| [scale, DVec2::ZERO]),
        }
    }

    fn scale(self, scene: &Scene, size: [u32; 2], expected: Option<[u32; 2]>) -> Option<DVec2> {
        let aspect_of = |[width, height]: [u32; 2]| f64::from(width) / f64::from(height.max(1));
        let aspect = aspect_of(size);
        let half = match scene.camera.projection {
            Projection::Perspective { fov_degrees } => Some((0.5 * fov_degrees).to_radians()),
            Projection::Parallel { .. } => None,
        };
        let across = half.map(|half| (half.tan() * aspect).atan());
        let by_tangent = |half: Option<f64>, factor: f64| {
            let (half, wrong) = (half?, half? * factor);
            (wrong < 1.5).then(|| DVec2::splat(wrong.tan() / half.tan()))
        };
        let scale = match self {
            Self::Right | Self::Fitted { .. } => DVec2::ONE,
            Self::AngleForHeight => half.map(|_| DVec2::splat(aspect))?,
            Self::AngleForWidth => half.map(|_| DVec2::splat(aspect.recip()))?,
            Self::SquareByHeight => DVec2::new(aspect.recip(), 1.0),
            Self::SquareByWidth => DVec2::new(1.0, aspect),
            Self::Stretched => DVec2::new(aspect_of(expected?) / aspect, 1.0),
            Self::WholeAngle => by_tangent(half, 2.0)?,
            Self::WholeAngleAcross => by_tangent(across, 2.0)?,
            Self::HalvedAngle => by_tangent(half, 0.5)?,
            Self::HalvedAngleAcross => by_tangent(across, 0.5)?,
        };
        let is_other = (scale - DVec2::ONE).abs().max_element() > 1e-6;
        (is_other || self == Self::Right).then_some(scale)
    }
}

/// Where in a pixel its ray goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Offset {
    /// Half pixels to the right of and below the middle.
    pub halves: [i8; 2],
    /// What the picture is made from.
    pub kind: OffsetKind,
}

/// How rays are displaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum OffsetKind {
    /// Each ray by the same way.
    #[default]
    Moved,
    /// The picture was moved afterwards: each pixel is the mean of four.
    Resampled,
    /// The first pixel looks at one edge of the window, the last at the other.
    EdgeToEdge,
}

impl Offset {
    const fn moved(x: i8, y: i8) -> Self {
        Self { halves: [x, y], kind: OffsetKind::Moved }
    }

    /// The number of usual ones among [`Self::OTHERS`], which come first.
    pub(super) const USUAL: usize = 5;

    pub(super) const OTHERS: [Self; 17] = [
        Self::moved(-1, -1),
        Self::moved(1, 1),
        Self { halves: [0, 0], kind: OffsetKind::EdgeToEdge },
        Self { halves: [-1, -1], kind: OffsetKind::Resampled },
        Self { halves: [1, 1], kind: OffsetKind::Resampled },
        Self::moved(-1, 0),
        Self::moved(1, 0),
        Self::moved(0, -1),
        Self::moved(0, 1),
        Self::moved(-1, 1),
        Self::moved(1, -1),
        Self::moved(-2, 0),
        Self::moved(2, 0),
        Self::moved(0, -2),
        Self::moved(0, 2),
        Self::moved(-2, -2),
        Self::moved(2, 2),
    ];

    /// The offsets of the rays whose codes are averaged.
    pub(super) fn rays(self) -> Vec<Self> {
        let [x, y] = self.halves;
        match self.kind {
            OffsetKind::Resampled => {
                let (x, y) = (2 * x, 2 * y);
                vec![Self::moved(0, 0), Self::moved(x, 0), Self::moved(0, y), Self::moved(x, y)]
            }
            _ => vec![self],
        }
    }

    /// Where the ray of a pixel goes in a picture of `size` pixels.
    pub(super) fn at(self, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> DVec2 {
        let pixel = DVec2::new(f64::from(x), f64::from(y));
        let size = DVec2::new(f64::from(width), f64::from(height));
        match self.kind {
            OffsetKind::EdgeToEdge => pixel * size / (size - 1.0).max(DVec2::ONE),
            _ => {
                let [x, y] = self.halves.map(f64::from);
                pixel + 0.5 + 0.5 * DVec2::new(x, y)
            }
        }
    }
}

/// The pixels of the upright picture that are looked at: all, or blocks of 2×2 spread evenly.
#[derive(Clone, Debug)]
pub(super) struct PixelChoice {
    pub(super) size: [u32; 2],
    pub(super) pixels: Vec<[u32; 2]>,
    /// Neighbors among the pixels.
    pub(super) pairs: Vec<[u32; 2]>,
}

impl PixelChoice {
    /// At most about `most` pixels of a picture of this size.
    pub(super) fn new(size: [u32; 2], most: usize) -> Self {
        let [width, height] = size;
        let count = u64::from(width) * u64::from(height);
        if count <= most as u64 || width < 4 || height < 4 {
            return Self::all(size);
        }
        let aspect = f64::from(width) / f64::from(height);
        let blocks = (most as f64 / 4.0).max(1.0);
        let columns = ((blocks * aspect).sqrt().round() as u32).clamp(1, width / 2);
        let rows = ((blocks / f64::from(columns)).round() as u32).clamp(1, height / 2);
        let start = |cell: u32, cells: u32, side: u32| {
            let at = (f64::from(cell) + 0.5) * f64::from(side) / f64::from(cells);
            (at as u32).min(side.saturating_sub(2))
        };
        let (mut pixels, mut pairs) = (Vec::new(), Vec::new());
        for row in 0..rows {
            for column in 0..columns {
                let (x, y) = (start(column, columns, width), start(row, rows, height));
                let first = pixels.len() as u32;
                pixels.extend([[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]]);
                pairs.extend([[0, 1], [2, 3], [0, 2], [1, 3]].map(|pair| pair.map(|place| first + place)));
            }
        }
        Self { size, pixels, pairs }
    }

    fn all(size: [u32; 2]) -> Self {
        let [width, height] = size;
        let pixels: Vec<_> = (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).collect();
        let mut pairs = Vec::new();
        for (place, [x, y]) in pixels.iter().enumerate() {
            let place = place as u32;
            if x + 1 < width {
                pairs.push([place, place + 1]);
            }
            if y + 1 < height {
                pairs.push([place, place + width]);
            }
        }
        Self { size, pixels, pairs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_pixels_lie_in_the_picture_and_pairs_are_neighbors() {
        for (size, most) in [([7, 5], 100), ([1920, 1080], 4096), ([5000, 4], 64), ([1, 90_000], 4096)] {
            let choice = PixelChoice::new(size, most);
            assert!(choice.pixels.iter().all(|[x, y]| *x < size[0] && *y < size[1]));
            for [a, b] in &choice.pairs {
                let ([ax, ay], [bx, by]) = (choice.pixels[*a as usize], choice.pixels[*b as usize]);
                assert_eq!(ax.abs_diff(bx) + ay.abs_diff(by), 1, "{size:?}");
            }
        }
        assert!(PixelChoice::new([1920, 1080], 4096).pixels.len() < 5000);
    }

    #[test]
    fn windows_are_those_of_the_formulas() {
        let mut scene = Scene::default();
        scene.camera.projection = Projection::Perspective { fov_degrees: 60.0 };
        let scale = |window: Window, size| window.scale(&scene, size, Some([200, 100]));
        assert_eq!(scale(Window::AngleForHeight, [200, 100]), Some(DVec2::splat(2.0)));
        assert_eq!(scale(Window::AngleForHeight, [100, 100]), None, "there is no difference");
        // tan 60° is three times tan 30°.
        assert!((scale(Window::WholeAngle, [200, 100]).unwrap() - 3.0).length() < 1e-9);
        assert_eq!(scale(Window::Stretched, [100, 100]), Some(DVec2::new(2.0, 1.0)));
        assert_eq!(scale(Window::Stretched, [400, 200]), None);
    }
}
