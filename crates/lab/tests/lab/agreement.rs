//! What agrees with the exact picture: right pictures however they are filtered, and no other ones.

use std::path::{Path, PathBuf};

use catoptric_lab::Random;
use catoptric_lab::detective::{CodeCurve, Detective, DetectiveSettings, ObservedPicture, Verdict};
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, srgb};
use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use rayon::prelude::*;

const SIZE: [u32; 2] = [48, 36];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

fn scene_at(path: &Path) -> Scene {
    let text = std::fs::read_to_string(path).unwrap();
    catoptric_scene::read(&text).into_result().unwrap().value
}

fn files(name: &str, extension: &str) -> Vec<PathBuf> {
    let all = std::fs::read_dir(folder(name)).unwrap().map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> =
        all.filter(|path| path.extension().is_some_and(|own| own == extension)).collect();
    all.sort();
    all
}

pub(super) fn traced(scene: &Scene, [width, height]: [u32; 2]) -> Picture {
    let prepared = RenderScene::build(scene).unwrap();
    render(&prepared, RenderSettings { width, height, samples: 1 }, &RenderControl::default())
        .unwrap()
        .picture
}

/// Codes of a picture, 0 to 255, row by row.
#[derive(Clone, Debug, PartialEq)]
struct Codes {
    size: [u32; 2],
    codes: Vec<[u8; 3]>,
}

impl Codes {
    fn from_fn(size: [u32; 2], mut code: impl FnMut(u32, u32) -> [u8; 3]) -> Self {
        let mut codes = Vec::new();
        for y in 0..size[1] {
            codes.extend((0..size[0]).map(|x| code(x, y)));
        }
        Self { size, codes }
    }

    /// The code of a pixel, of the nearest one outside.
    fn at(&self, x: i64, y: i64) -> [u8; 3] {
        let [x, y] =
            [(x, self.size[0]), (y, self.size[1])].map(|(at, side)| at.clamp(0, i64::from(side) - 1));
        self.codes[(y * i64::from(self.size[0]) + x) as usize]
    }

    fn observed(&self) -> ObservedPicture {
        let light = |code: u8| srgb::decode(f64::from(code) / 255.0) as f32;
        let pixels = self.codes.iter().map(|code| code.map(light)).collect();
        ObservedPicture::of_codes(&Picture::from_pixels(self.size[0], self.size[1], pixels).unwrap())
    }

    /// The bounds of each channel up to a distance around a pixel.
    fn bounds(&self, x: u32, y: u32, reach: i64) -> [(u8, u8); 3] {
        let [x, y] = [x, y].map(i64::from);
        let all =
            || (y - reach..=y + reach).flat_map(|y| (x - reach..=x + reach).map(move |x| self.at(x, y)));
        [0, 1, 2]
            .map(|c| (all().map(|code| code[c]).min().unwrap(), all().map(|code| code[c]).max().unwrap()))
    }

    /// The number of pixels that have codes which lie nowhere near in the other picture.
    fn strays(&self, other: &Self) -> usize {
        let is_stray = |x: u32, y: u32| {
            let (own, bounds) = (self.at(x.into(), y.into()), other.bounds(x, y, 2));
            (0..3).any(|c| own[c].saturating_add(8) < bounds[c].0 || own[c].saturating_sub(8) > bounds[c].1)
        };
        let all = (0..self.size[1]).flat_map(|y| (0..self.size[0]).map(move |x| (x, y)));
        all.filter(|(x, y)| is_stray(*x, *y)).count()
    }

    /// The number of pixels that differ by more than eight codes.
    fn differing(&self, other: &Self) -> usize {
        let differs = |(one, other): &(&[u8; 3], &[u8; 3])| (0..3).any(|c| one[c].abs_diff(other[c]) > 8);
        self.codes.iter().zip(&other.codes).filter(differs).count()
    }
}

fn code(curve: CodeCurve, light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let value = if curve == CodeCurve::Srgb { srgb::encode(light) } else { light };
    (value * 255.0).round() as u8
}

/// How the rays of a pixel are put together.
#[derive(Clone, Copy, Debug)]
enum PixelFilter {
    /// So many along each side of the pixel.
    Grid(u32),
    /// So many anywhere in the pixel.
    Anywhere(u32),
    /// Falling to 0 at the middles of the neighbors.
    Tent,
    /// A Gaussian of a standard deviation of half a pixel.
    Gaussian,
}

impl PixelFilter {
    const ALL: [Self; 8] = [
        Self::Grid(1),
        Self::Grid(2),
        Self::Grid(4),
        Self::Grid(8),
        Self::Anywhere(4),
        Self::Anywhere(16),
        Self::Tent,
        Self::Gaussian,
    ];
    /// Rays along the side of a pixel that those of others than grids are taken from.
    const FINE: u32 = 8;

    fn fine(self) -> u32 {
        if let Self::Grid(count) = self { count } else { Self::FINE }
    }

    /// The rays of a pixel among the fine ones, from its upper left corner, with their weights.
    fn rays(self, random: &mut Random) -> Vec<([i64; 2], f64)> {
        let fine = i64::from(self.fine());
        let all = |from: i64, to: i64| (from..to).flat_map(move |y| (from..to).map(move |x| [x, y]));
        let weighted = |weight: fn(f64) -> f64| {
            let own = |at: i64| weight((at as f64 + 0.5) / fine as f64 - 0.5);
            all(-fine, 2 * fine).map(|[x, y]| ([x, y], own(x) * own(y))).collect()
        };
        match self {
            Self::Grid(_) => all(0, fine).map(|at| (at, 1.0)).collect(),
            Self::Anywhere(count) => {
                (0..count).map(|_| ([0; 2].map(|_| random.below(fine as u64) as i64), 1.0)).collect()
            }
            Self::Tent => weighted(|x| (1.0 - x.abs()).max(0.0)),
            Self::Gaussian => weighted(|x| (-2.0 * x * x).exp()),
        }
    }

    /// The picture of a scene, of the mean light or of the mean codes of rays.
    fn picture(self, fine: &Picture, size: [u32; 2], curve: CodeCurve, is_of_light: bool) -> Codes {
        let mut random = Random::new(7);
        let factor = i64::from(self.fine());
        let [width, height] = size.map(|side| i64::from(side) * factor);
        Codes::from_fn(size, |x, y| {
            let (mut sum, mut whole) = ([0.0; 3], 0.0);
            for ([right, below], weight) in self.rays(&mut random) {
                let [x, y] = [i64::from(x) * factor + right, i64::from(y) * factor + below];
                let light = fine.pixel(x.clamp(0, width - 1) as u32, y.clamp(0, height - 1) as u32).unwrap();
                whole += weight;
                for (sum, light) in sum.iter_mut().zip(light) {
                    let light = f64::from(light);
                    *sum += weight * if is_of_light { light } else { f64::from(code(curve, light)) / 255.0 };
                }
            }
            sum.map(|sum| {
                let mean = sum / whole;
                if is_of_light { code(curve, mean) } else { (mean * 255.0).round() as u8 }
            })
        })
    }
}

pub(super) fn settings(curve: CodeCurve) -> DetectiveSettings {
    // What is wrong does not matter here.
    DetectiveSettings { curve, searched_pixels: 0, probed_pixels: 48, ..DetectiveSettings::default() }
}

pub(super) fn check(scene: &Scene, settings: DetectiveSettings, picture: &ObservedPicture) -> Verdict {
    Detective::new(scene, settings).unwrap().check(picture, &RenderControl::default()).unwrap()
}

#[test]
fn right_pictures_pass_however_they_are_filtered() {
    let wrong: Vec<String> = files("examples/acceptance", "toml")
        .par_iter()
        .enumerate()
        .flat_map_iter(|(number, path)| {
            let scene = scene_at(path);
            let fine = [1, 2, 4, 8].map(|factor| traced(&scene, SIZE.map(|side| side * factor)));
            let mut wrong = Vec::new();
            // Each filter meets each way in some scenes.
            for (index, filter) in PixelFilter::ALL.into_iter().enumerate().skip(number % 2).step_by(2) {
                let ways = [(CodeCurve::Linear, true), (CodeCurve::Srgb, true), (CodeCurve::Srgb, false)];
                for (curve, is_of_light) in ways.into_iter().skip((number + index) % 3).step_by(3) {
                    let fine = &fine[filter.fine().ilog2() as usize];
                    let picture = filter.picture(fine, SIZE, curve, is_of_light);
                    let verdict = check(&scene, settings(curve), &picture.observed());
                    if !verdict.is_right(Verdict::ALLOWED) {
                        wrong.push(format!(
                            "{} {filter:?} {curve:?} {is_of_light}: {} {:.4} {}",
                            path.display(),
                            verdict.sentence(&scene, Language::English),
                            verdict.strayed,
                            verdict.has_stray_patch,
                        ));
                    }
                }
            }
            wrong
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn pictures_of_another_renderer_pass() {
    let all = files("tests/reference", "exr");
    let wrong: Vec<String> = all
        .par_iter()
        .step_by(3)
        .filter_map(|path| {
            let scene = scene_at(&path.with_extension("toml"));
            let picture = catoptric_picture::read(path).unwrap();
            let verdict = check(&scene, settings(CodeCurve::Linear), &ObservedPicture::of_light(&picture));
            // What the limit of pixels apart from edges leans on.
            let is_right = verdict.is_right(Verdict::ALLOWED) && verdict.strayed <= 0.0005;
            let told = verdict.sentence(&scene, Language::English);
            (!is_right).then(|| format!("{} {told} {}", path.display(), verdict.strayed))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A picture that is wrong.
#[derive(Clone, Copy, Debug)]
enum Damage {
    /// Every pixel anything.
    Noise,
    /// A share of the pixels anything.
    Specks(f64),
    /// Each `period`-th row or column of one color, the way it lies.
    Stripes,
    /// A square of so many pixels of one color.
    Block(u32),
    /// A rectangle shows what lies some pixels beside it.
    ShiftedPart,
    /// All is moved by some pixels.
    Shifted,
    /// The mean of a square around each pixel.
    Blur,
    /// One color all over.
    Plain,
    /// Black and white cells.
    Checkerboard,
    /// Pixels at edges lie anywhere between their neighbors.
    NoisyEdges,
    /// Pixels at edges have the lightest or the darkest code of their neighbors.
    GrownEdges,
    /// Pixels at edges have the other side's code.
    SwappedEdges,
}

impl Damage {
    const ALL: [Self; 16] = [
        Self::Noise,
        Self::Specks(0.3),
        Self::Specks(0.03),
        Self::Specks(0.015),
        Self::Stripes,
        Self::Block(2),
        Self::Block(3),
        Self::Block(8),
        Self::ShiftedPart,
        Self::Shifted,
        Self::Blur,
        Self::Plain,
        Self::Checkerboard,
        Self::NoisyEdges,
        Self::GrownEdges,
        Self::SwappedEdges,
    ];

    fn done(self, right: &Codes, random: &mut Random) -> Codes {
        let size = right.size;
        let [width, height] = size.map(i64::from);
        let mut below = |limit: i64| random.below(limit.max(1) as u64) as i64;
        let color = [0; 3].map(|_| below(256) as u8);
        let color = [color, [255; 3], [0; 3], right.at(below(width), below(height))][below(4) as usize];
        let around = |x: i64, y: i64, reach: i64| {
            let all = (y - reach..=y + reach).flat_map(move |y| (x - reach..=x + reach).map(move |x| [x, y]));
            all.map(|[x, y]| right.at(x, y))
        };
        match self {
            Self::Noise => Codes::from_fn(size, |_, _| [0; 3].map(|_| below(256) as u8)),
            Self::Specks(share) => Codes::from_fn(size, |x, y| {
                let is_hit = (below(1 << 20) as f64) < share * f64::from(1 << 20);
                if is_hit { [0; 3].map(|_| below(256) as u8) } else { right.at(x.into(), y.into()) }
            }),
            Self::Stripes => {
                let (period, is_row) = (2 + below(6), below(2) == 0);
                Codes::from_fn(size, |x, y| {
                    let at = i64::from(if is_row { y } else { x });
                    if at % period == 0 { color } else { right.at(x.into(), y.into()) }
                })
            }
            Self::Block(side) => {
                let side = i64::from(side);
                let [left, top] = [below(width - side), below(height - side)];
                Codes::from_fn(size, |x, y| {
                    let [x, y] = [i64::from(x), i64::from(y)];
                    let is_inside = (left..left + side).contains(&x) && (top..top + side).contains(&y);
                    if is_inside { color } else { right.at(x, y) }
                })
            }
            Self::ShiftedPart => {
                let [left, top] = [below(width / 2), below(height / 2)];
                let [wide, high] = [width / 2, height / 2].map(|side| side / 2 + below(side / 2));
                let [right_by, down_by] = [[1, 0], [0, 1], [2, 1], [-3, 2], [-1, -1]][below(5) as usize];
                Codes::from_fn(size, |x, y| {
                    let [x, y] = [i64::from(x), i64::from(y)];
                    let is_inside = (left..left + wide).contains(&x) && (top..top + high).contains(&y);
                    if is_inside { right.at(x + right_by, y + down_by) } else { right.at(x, y) }
                })
            }
            Self::Shifted => {
                let by = [[1, 0], [0, 1], [-1, 1], [2, 0], [0, -3]][below(5) as usize];
                Codes::from_fn(size, |x, y| right.at(i64::from(x) + by[0], i64::from(y) + by[1]))
            }
            Self::Blur => {
                let reach = 1 + below(2);
                let count = (2 * reach + 1) * (2 * reach + 1);
                Codes::from_fn(size, |x, y| {
                    let sum = |c: usize| {
                        around(x.into(), y.into(), reach).map(|code| i64::from(code[c])).sum::<i64>()
                    };
                    [0, 1, 2].map(|c| (sum(c) / count) as u8)
                })
            }
            Self::Plain => Codes::from_fn(size, |_, _| color),
            Self::Checkerboard => {
                let cell = 1 + below(4) as u32;
                Codes::from_fn(size, |x, y| {
                    [if (x / cell + y / cell).is_multiple_of(2) { 0 } else { 255 }; 3]
                })
            }
            Self::NoisyEdges | Self::GrownEdges | Self::SwappedEdges => self.done_at_edges(right, random),
        }
    }

    /// The codes at edges by others that lie between those near.
    fn done_at_edges(self, right: &Codes, random: &mut Random) -> Codes {
        let size = right.size;
        let mut below = |limit: i64| random.below(limit.max(1) as u64) as i64;
        let bounds = |x: u32, y: u32| right.bounds(x, y, 1);
        let is_edge = |x: u32, y: u32| bounds(x, y).iter().any(|(low, high)| high - low > 24);
        match self {
            Self::GrownEdges => {
                let is_high = below(2) == 0;
                Codes::from_fn(size, |x, y| bounds(x, y).map(|(low, high)| if is_high { high } else { low }))
            }
            Self::SwappedEdges => Codes::from_fn(size, |x, y| {
                let own = right.at(x.into(), y.into());
                let bounds = bounds(x, y);
                [0, 1, 2].map(|c| {
                    let (low, high) = bounds[c];
                    if own[c] - low > high - own[c] { low } else { high }
                })
            }),
            _ => Codes::from_fn(size, |x, y| {
                if !is_edge(x, y) {
                    return right.at(x.into(), y.into());
                }
                let part = below(257);
                bounds(x, y).map(|(low, high)| (i64::from(low) + i64::from(high - low) * part / 256) as u8)
            }),
        }
    }

    /// Whether it made a picture wrong for certain: where it only moved what edges show, it must have changed more of
    /// them than may differ there.
    fn is_seen(self, wrong: &Codes, right: &Codes) -> bool {
        let all = right.codes.len();
        match self {
            Self::Block(_) => wrong.strays(right) > 1,
            Self::Noise | Self::Specks(_) | Self::Stripes | Self::Plain | Self::Checkerboard => {
                wrong.differing(right) > all / 75
            }
            Self::ShiftedPart | Self::Shifted | Self::Blur => wrong.differing(right) > all / 50,
            Self::NoisyEdges | Self::GrownEdges | Self::SwappedEdges => wrong.differing(right) > all / 25,
        }
    }
}

#[test]
fn no_wrong_picture_passes() {
    let scenes: Vec<(PathBuf, Scene)> = files("examples/acceptance", "toml")
        .into_iter()
        .map(|path| (path.clone(), scene_at(&path)))
        .collect();
    let filters = [PixelFilter::Grid(1), PixelFilter::Grid(4)];
    let outcomes: Vec<(usize, Vec<String>)> = scenes
        .par_iter()
        .enumerate()
        .map(|(number, (path, scene))| {
            let detective = Detective::new(scene, settings(CodeCurve::Linear)).unwrap();
            let (mut count, mut passed) = (0, Vec::new());
            let filter = filters[number % 2];
            let fine = traced(scene, SIZE.map(|side| side * filter.fine()));
            let right = filter.picture(&fine, SIZE, CodeCurve::Linear, true);
            for (kind, damage) in Damage::ALL.into_iter().enumerate() {
                let mut random = Random::new((1000 * number + kind) as u64);
                let wrong = damage.done(&right, &mut random);
                if !damage.is_seen(&wrong, &right) {
                    continue;
                }
                count += 1;
                let verdict = detective.check(&wrong.observed(), &RenderControl::default()).unwrap();
                if verdict.is_right(Verdict::ALLOWED) {
                    passed.push(format!(
                        "{} {filter:?} {damage:?} {}: {:.4}",
                        path.display(),
                        wrong.differing(&right),
                        1.0 - verdict.agreed
                    ));
                }
            }
            (count, passed)
        })
        .collect();
    let count: usize = outcomes.iter().map(|(count, _)| count).sum();
    let passed: Vec<String> = outcomes.into_iter().flat_map(|(_, passed)| passed).collect();
    println!("{count} wrong pictures");
    assert!(count >= 200, "{count}");
    assert!(passed.is_empty(), "{} of {count}:\n{}", passed.len(), passed.join("\n"));
}

fn acceptance(name: &str) -> Scene {
    scene_at(&folder("examples/acceptance").join(name).with_extension("toml"))
}

#[test]
fn what_lies_between_wrong_neighbors_is_wrong() {
    let flat =
        catoptric_scene::read("format = 'catoptric/1'\nenvironment = { background = [0.5, 0.5, 0.5] }");
    let flat = flat.into_result().unwrap().value;
    let checkerboard = Codes::from_fn([16, 12], |x, y| [if (x + y).is_multiple_of(2) { 0 } else { 255 }; 3]);
    let striped = ["06-shadow", "12-glass"].map(|name| {
        let scene = acceptance(name);
        let right = PixelFilter::Grid(1).picture(&traced(&scene, SIZE), SIZE, CodeCurve::Linear, true);
        let row = |x: u32, y: u32| if y.is_multiple_of(2) { [255; 3] } else { right.at(x.into(), y.into()) };
        (scene, Codes::from_fn(SIZE, row))
    });
    for (scene, wrong) in [(flat, checkerboard)].into_iter().chain(striped) {
        for tolerance in [0.0, 2.0 / 255.0] {
            // With all that a user has.
            let settings =
                DetectiveSettings { curve: CodeCurve::Linear, tolerance, ..DetectiveSettings::default() };
            let verdict = check(&scene, settings, &wrong.observed());
            assert!(!verdict.is_right(1.0), "{}", verdict.sentence(&scene, Language::English));
            assert!(verdict.strayed > 0.2, "{} {}", verdict.agreed, verdict.strayed);
        }
    }
}

#[test]
fn without_tolerance_codes_are_equal() {
    let scene = acceptance("10-mirror");
    for curve in [CodeCurve::Linear, CodeCurve::Srgb] {
        let exact = DetectiveSettings { tolerance: 0.0, ..settings(curve) };
        let picture = |filter: PixelFilter| {
            filter.picture(&traced(&scene, SIZE.map(|side| side * filter.fine())), SIZE, curve, true)
        };
        let right = picture(PixelFilter::Grid(1));
        let verdict = check(&scene, exact, &right.observed());
        assert!(verdict.is_right(0.0) && verdict.simplest.is_none(), "{verdict:?}");
        let mut off = right.clone();
        off.codes[700][1] ^= 1;
        let verdict = check(&scene, exact, &off.observed());
        assert!(!verdict.is_right(0.0) && verdict.agreed < 1.0, "a code more or less");
        // Antialiased pictures are right, but not equal.
        let smooth = picture(PixelFilter::Grid(4)).observed();
        assert!(check(&scene, settings(curve), &smooth).is_right(0.005));
        assert!(!check(&scene, exact, &smooth).is_right(0.02));
    }
    // Numbers of light are equal or not.
    let exact = DetectiveSettings { tolerance: 0.0, ..settings(CodeCurve::Linear) };
    let mut picture = traced(&scene, SIZE);
    assert!(check(&scene, exact, &ObservedPicture::of_light(&picture)).is_right(0.0));
    picture.pixels_mut()[700][2] += 1e-4;
    assert!(!check(&scene, exact, &ObservedPicture::of_light(&picture)).is_right(0.0));
}

/// A large picture is judged by every pixel of it, and a smooth one no less.
#[test]
fn a_block_of_four_pixels_is_found_in_a_large_picture() {
    let (scene, size) = (acceptance("01-sphere"), [320, 240]);
    for filter in [PixelFilter::Grid(1), PixelFilter::Grid(2)] {
        let fine = traced(&scene, size.map(|side| side * filter.fine()));
        let right = filter.picture(&fine, size, CodeCurve::Linear, true);
        assert!(check(&scene, settings(CodeCurve::Linear), &right.observed()).is_right(Verdict::ALLOWED));
        let is_inside = |x: u32, y: u32| (31..33).contains(&x) && (21..23).contains(&y);
        let code = |x: u32, y: u32| if is_inside(x, y) { [255; 3] } else { right.at(x.into(), y.into()) };
        let verdict = check(&scene, settings(CodeCurve::Linear), &Codes::from_fn(size, code).observed());
        assert!(!verdict.is_right(Verdict::ALLOWED) && verdict.has_stray_patch);
        let pixel = verdict.simplest.unwrap().pixel;
        assert!(is_inside(pixel.stored[0], pixel.stored[1]) && pixel.found == [255; 3], "{pixel:?}");
    }
}

#[test]
fn antialiased_pictures_are_accused_of_no_mistake() {
    let searching = DetectiveSettings { searched_pixels: 400, ..settings(CodeCurve::Linear) };
    for (name, filter) in [("06-shadow", PixelFilter::Grid(4)), ("10-mirror", PixelFilter::Gaussian)] {
        let scene = acceptance(name);
        let fine = traced(&scene, SIZE.map(|side| side * filter.fine()));
        let right = filter.picture(&fine, SIZE, CodeCurve::Linear, true);
        let verdict = check(&scene, searching, &right.observed());
        assert!(verdict.is_right(0.005), "{name}: {}", verdict.sentence(&scene, Language::English));
    }
}

#[test]
fn penumbrae_of_many_samples_are_right() {
    let mut scene = acceptance("06-shadow");
    scene.lights.iter_mut().for_each(|light| light.radius = 1.5);
    let prepared = RenderScene::build(&scene).unwrap();
    let settings_of = RenderSettings { width: SIZE[0], height: SIZE[1], samples: 64 };
    let light = render(&prepared, settings_of, &RenderControl::default()).unwrap().picture;
    let coded = |x, y| light.pixel(x, y).unwrap().map(|light| code(CodeCurve::Linear, f64::from(light)));
    let picture = Codes::from_fn(SIZE, coded);
    let verdict = check(&scene, settings(CodeCurve::Linear), &picture.observed());
    assert!(verdict.is_right(Verdict::ALLOWED), "{}", verdict.sentence(&scene, Language::English));
    let half = |x: u32, y: u32| picture.at(x.into(), y.into()).map(|code| code / 2);
    let verdict = check(&scene, settings(CodeCurve::Linear), &Codes::from_fn(SIZE, half).observed());
    assert!(!verdict.is_right(Verdict::ALLOWED));
}
