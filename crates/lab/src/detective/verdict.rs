//! What is said of a picture: a sentence, lines, JSON.

use catoptric_scene::{Scene, ShapeKind, quoted_name};
use serde_json::{Value, json};

use super::codes::CodeCurve;
use super::faults::Fault;
use super::mistake::Mistake;
use super::observed::Orientation;
use super::places::{OffsetKind, Window};
use super::remainder::{Cluster, DifferenceKind};
use super::scene_words::scene_in_words;
use super::simplest::SimplestDifference;
use crate::report::Language;

/// What was found out about a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The mistakes that explain it, those of the place of pixels first; none if it is right, or not explained.
    pub mistakes: Vec<Mistake>,
    /// Width and height of the file, pixels.
    pub size: [u32; 2],
    /// Width and height of the picture put upright, pixels.
    pub scene_size: [u32; 2],
    /// The share of pixels that agree with the exact picture.
    pub agreed_before: f64,
    /// The share of pixels that agree with the exact picture with these mistakes.
    pub agreed: f64,
    /// The share of pixels that differ where the exact picture has no edge.
    pub strayed: f64,
    /// Whether two of those touch.
    pub has_stray_patch: bool,
    /// The number of pixels by which the shares were found.
    pub judged: usize,
    /// Where the rest lies, the largest part first.
    pub clusters: Vec<Cluster>,
    /// Where to look first, if anything differs.
    pub simplest: Option<SimplestDifference>,
}

impl Verdict {
    /// The share of pixels at edges that may differ if nothing else is asked for.
    pub const ALLOWED: f64 = 0.01;
    /// The share of pixels apart from edges that may differ, each alone: where rays graze a surface or pass between two,
    /// rounding makes right programs differ. In the reference pictures it is half of that at most.
    const MOST_STRAYED: f64 = 0.001;

    /// Whether the picture is right: no mistake, at most this share of its pixels differs, and where the exact picture
    /// has no edge only single pixels do, one in a thousand at most.
    pub fn is_right(&self, allowed: f64) -> bool {
        self.mistakes.is_empty()
            && 1.0 - self.agreed <= allowed
            && self.strayed <= Self::MOST_STRAYED
            && !self.has_stray_patch
    }

    /// The verdict in a sentence.
    pub fn sentence(&self, scene: &Scene, language: Language) -> String {
        let percent = |share: f64| share_in_words(share, language);
        let agreed = percent(self.agreed);
        let mut text = if self.mistakes.is_empty() {
            match language {
                Language::English => format!("{agreed} of the pixels agree"),
                Language::Russian => format!("совпадают {agreed} пикселей"),
            }
        } else {
            let words: Vec<String> =
                self.mistakes.iter().map(|mistake| in_words(mistake, language)).collect();
            let before = percent(self.agreed_before);
            match language {
                Language::English => format!(
                    "{}; with that undone {agreed} of the pixels agree, {before} without",
                    words.join("; ")
                ),
                Language::Russian => {
                    format!("{}; с поправкой совпадают {agreed} пикселей, без неё {before}", words.join("; "))
                }
            }
        };
        if self.mistakes.is_empty() && !self.is_right(Self::ALLOWED) {
            text += language.choose(
                "; none of the known mistakes explains the rest",
                "; ни одна из известных ошибок остального не объясняет",
            );
        }
        if let Some(cluster) = self.clusters.first().filter(|_| self.agreed < 0.9995) {
            let place = place_in_words(cluster, scene, language);
            text += &match language {
                Language::English => format!("; most of what is left: {place}"),
                Language::Russian => format!("; больше всего осталось здесь: {place}"),
            };
        }
        text
    }

    /// A line for each cluster of differences.
    pub fn lines(&self, scene: &Scene, language: Language) -> Vec<String> {
        let line = |cluster: &Cluster| {
            let place = place_in_words(cluster, scene, language);
            let share = share_in_words(cluster.share, language);
            let worst = &cluster.worst;
            let [x, y] = worst.stored;
            let [found, expected] =
                [worst.found, worst.expected].map(|codes| codes.map(|code| code.to_string()).join(","));
            match language {
                Language::English => {
                    format!("{share}  {place}; worst at pixel {x},{y}: {found} instead of {expected}")
                }
                Language::Russian => {
                    format!("{share}  {place}; хуже всего пиксель {x},{y}: {found} вместо {expected}")
                }
            }
        };
        self.clusters.iter().map(line).collect()
    }

    /// The verdict as JSON, with names that stay.
    pub fn to_json(&self, scene: &Scene, allowed: f64) -> Value {
        let mistakes: Vec<Value> = self
            .mistakes
            .iter()
            .map(|mistake| {
                let mut value = json!({
                    "key": mistake.key(),
                    "words": in_words(mistake, Language::English),
                });
                if let Some(map) = value.as_object_mut() {
                    map.extend(numbers(mistake));
                }
                value
            })
            .collect();
        let clusters: Vec<Value> = self
            .clusters
            .iter()
            .map(|cluster| {
                let worst = &cluster.worst;
                json!({
                    "share": cluster.share,
                    "kind": worst.kind.key(),
                    "body": worst.body.map(|body| body_in_words(body, scene, Language::English)),
                    "worst_pixel": worst.stored,
                    "pixel_of_scene": worst.pixel,
                    "found": worst.found,
                    "expected": worst.expected,
                })
            })
            .collect();
        json!({
            "right": self.is_right(allowed),
            "sentence": self.sentence(scene, Language::English),
            "mistakes": mistakes,
            "width": self.size[0],
            "height": self.size[1],
            "share_agreeing": self.agreed_before,
            "share_explained": self.agreed,
            "pixels_judged": self.judged,
            "share_beyond_edges": self.strayed,
            "remainder": clusters,
            "look_first": self.simplest.map(|simplest| simplest.to_json(scene)),
        })
    }
}

/// The numbers of a mistake for JSON.
fn numbers(mistake: &Mistake) -> Vec<(String, Value)> {
    let named = |name: &str, value: Value| (name.to_owned(), value);
    match mistake {
        Mistake::Size { expected, .. } => vec![named("expected_size", json!(expected))],
        Mistake::Exposure { factor } => vec![named("factor", json!(rounded(f64::from(*factor))))],
        Mistake::Curve { expected, found } => {
            vec![named("expected", json!(expected.key())), named("found", json!(found.key()))]
        }
        Mistake::Fault(Fault::Generations(generations)) => vec![named("generations", json!(generations))],
        _ => Vec::new(),
    }
}

fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// A share in percent: never 100 where something is missing.
fn share_in_words(share: f64, language: Language) -> String {
    let percent = if share < 1.0 { (100.0 * share).min(99.99) } else { 100.0 };
    let places = match percent {
        _ if share >= 1.0 => 0,
        percent if !(0.1..=99.9).contains(&percent) => 2,
        _ => 1,
    };
    format!("{}\u{a0}%", language.fixed(percent, places))
}

pub(super) fn body_in_words(body: usize, scene: &Scene, language: Language) -> String {
    let Some(found) = scene.bodies.get(body) else { return String::new() };
    if !found.name.is_empty() {
        return quoted_name(&found.name);
    }
    let shape = match (language, found.body_shape().kind()) {
        (Language::English, kind) => kind.key(),
        (Language::Russian, ShapeKind::Sphere) => "шар",
        (Language::Russian, ShapeKind::Cube) => "куб",
        (Language::Russian, ShapeKind::Cylinder) => "цилиндр",
        (Language::Russian, ShapeKind::Cone) => "конус",
        (Language::Russian, ShapeKind::Paraboloid) => "параболоид",
        (Language::Russian, ShapeKind::Plane) => "плоскость",
        (Language::Russian, ShapeKind::Lens) => "линза",
        (Language::Russian, ShapeKind::MirrorDish) => "вогнутое зеркало",
        (Language::Russian, ShapeKind::Tube) => "труба",
        (Language::Russian, ShapeKind::Ring) => "кольцо",
        (Language::Russian, ShapeKind::Bowl) => "чаша",
        (Language::Russian, ShapeKind::Prism) => "призма",
        (Language::Russian, ShapeKind::Wedge) => "клин",
        (Language::Russian, ShapeKind::OpenCylinder) => "открытый цилиндр",
        (Language::Russian, ShapeKind::OpenCone) => "открытый конус",
        (Language::Russian, ShapeKind::Disc) => "диск",
        (Language::Russian, ShapeKind::Rectangle) => "прямоугольник",
        (Language::Russian, ShapeKind::Triangle) => "треугольник",
        (Language::Russian, ShapeKind::Union) => "объединение",
        (Language::Russian, ShapeKind::Intersection) => "пересечение",
        (Language::Russian, ShapeKind::Difference) => "разность",
        (Language::Russian, ShapeKind::Surface) => "поверхность",
        (Language::Russian, ShapeKind::Group) => "группа",
    };
    format!("{shape} {}", body + 1)
}

impl Cluster {
    /// Where it lies and what it has to do with.
    pub fn place(&self, scene: &Scene, language: Language) -> String {
        place_in_words(self, scene, language)
    }

    /// Its share of the pixels, in percent.
    pub fn share_in_words(&self, language: Language) -> String {
        share_in_words(self.share, language)
    }
}

/// Where a cluster lies and what it has to do with.
fn place_in_words(cluster: &Cluster, scene: &Scene, language: Language) -> String {
    let kind = match cluster.worst.kind {
        DifferenceKind::Shadow => language.choose("light and shadow", "свет и тень"),
        DifferenceKind::Highlight => language.choose("highlight", "блик"),
        DifferenceKind::Reflection => language.choose("reflection", "отражение"),
        DifferenceKind::Refraction => language.choose("what is seen through it", "видимое насквозь"),
        DifferenceKind::Surface => language.choose("surface", "поверхность"),
        DifferenceKind::Background => language.choose("background", "фон"),
    };
    match cluster.worst.body {
        Some(body) => format!("{}, {kind}", body_in_words(body, scene, language)),
        None => kind.to_owned(),
    }
}

/// A mistake in words.
pub(super) fn in_words(mistake: &Mistake, language: Language) -> String {
    let words = match mistake {
        Mistake::Size { expected, found } => {
            let [expected, found] = [expected, found].map(|[width, height]| format!("{width}×{height}"));
            return match language {
                Language::English => format!("the picture has {found} pixels instead of {expected}"),
                Language::Russian => format!("в изображении {found} пикселей вместо {expected}"),
            };
        }
        Mistake::Exposure { factor } => {
            let factor = language.fixed(f64::from(*factor), 3);
            return match language {
                Language::English => format!("all light is {factor} times as strong (exposure)"),
                Language::Russian => format!("весь свет в {factor} раза сильнее (экспозиция)"),
            };
        }
        Mistake::Fault(Fault::Generations(generations)) => {
            return match (language, generations) {
                (Language::English, 1) => {
                    "rays are not followed at all: neither reflection nor refraction (depth 1)".to_owned()
                }
                (Language::English, _) => {
                    format!("rays are followed for {generations} generations only (depth)")
                }
                (Language::Russian, _) => {
                    format!("лучи прослежены лишь на {generations} поколения (глубина)")
                }
            };
        }
        Mistake::Orientation(orientation) => orientation_in_words(*orientation),
        Mistake::Window(window) => window_in_words(*window),
        Mistake::Offset(offset) if offset.is_whole() => {
            ["the picture is moved by a pixel", "изображение сдвинуто на пиксель"]
        }
        Mistake::Offset(offset) if offset.kind == OffsetKind::EdgeToEdge => [
            "rays are half a pixel off: they go from edge to edge instead of through the middles of pixels",
            "лучи смещены на полпикселя: идут от края до края, а не через середины пикселей",
        ],
        Mistake::Offset(_) => [
            "the picture is half a pixel off: rays go through the corners of pixels instead of their middles",
            "изображение смещено на полпикселя: лучи идут через углы пикселей, а не через середины",
        ],
        Mistake::Scene(mistake) => return scene_in_words(*mistake, language),
        Mistake::Ray(fault) => fault.words(),
        Mistake::Fault(Fault::Exponent(factor)) => {
            let factor = language.fixed(f64::from(factor.value()), 2);
            return match language {
                Language::English => {
                    format!("exponents of specular highlights are {factor} times as large")
                }
                Language::Russian => format!("показатели бликов в {factor} раза больше"),
            };
        }
        Mistake::Fault(fault) => fault.words(),
        Mistake::Acne => [
            "surfaces shadow themselves in speckles (acne): shadow rays need an offset",
            "поверхности пятнами затеняют сами себя («акне»): теневым лучам нужен отступ",
        ],
        Mistake::Curve { expected, found } => curve_in_words(*expected, *found),
        Mistake::ClampedFirst => [
            "light is clamped early: to 1 before it is weakened",
            "свет обрезан рано: до 1, прежде чем он ослаблен",
        ],
        Mistake::Overflow => [
            "codes above 255 begin again at 0 (overflow): clamp before rounding",
            "коды выше 255 начинаются снова с 0 (переполнение): обрежьте до округления",
        ],
        Mistake::BlueFirst => ["red and blue are exchanged", "красный и синий переставлены"],
    };
    language.choose(words[0], words[1]).to_owned()
}

/// Words in English and in Russian.
pub(super) type Words = [&'static str; 2];

fn orientation_in_words(orientation: Orientation) -> Words {
    match orientation {
        Orientation::Upright => ["upright", "как надо"],
        Orientation::FlippedAcross => [
            "flipped left to right (or the handedness of the camera's axes is the other one)",
            "отражено слева направо (или у осей камеры другая ориентация: левая вместо правой)",
        ],
        Orientation::FlippedDown => {
            ["flipped top to bottom", "перевёрнуто сверху вниз (строки в обратном порядке)"]
        }
        Orientation::UpsideDown => ["turned upside down (by 180°)", "повёрнуто на 180°"],
        Orientation::Transposed => {
            ["transposed: rows and columns are exchanged", "транспонировано: строки и столбцы переставлены"]
        }
        Orientation::TurnedLeft => ["turned to the left by 90°", "повёрнуто влево на 90°"],
        Orientation::TurnedRight => ["turned to the right by 90°", "повёрнуто вправо на 90°"],
        Orientation::ColumnByColumn => [
            "transposed: pixels are stored column by column instead of row by row",
            "транспонировано: пиксели записаны по столбцам, а не по строкам",
        ],
    }
}

fn window_in_words(window: Window) -> Words {
    match window {
        Window::Right => ["the right view", "верный вид"],
        Window::AngleForHeight => [
            "the field of view is taken as vertical, though it is horizontal: the picture shows too much",
            "угол обзора взят как вертикальный, а он горизонтальный: видно слишком много",
        ],
        Window::AngleForWidth => [
            "the field of view is taken as horizontal, though it is vertical: the picture shows too little",
            "угол обзора взят как горизонтальный, а он вертикальный: видно слишком мало",
        ],
        Window::SquareByHeight | Window::SquareByWidth => [
            "the aspect ratio is left out: the picture is stretched",
            "не учтено отношение сторон: изображение растянуто",
        ],
        Window::Stretched => {
            ["the picture is stretched from the expected size", "изображение растянуто из ожидаемого размера"]
        }
        Window::Fitted { .. } => [
            "the picture shows another part of the view: it is stretched, enlarged or cropped",
            "изображение показывает другую часть вида: растянуто, увеличено или обрезано",
        ],
        Window::WholeAngle | Window::WholeAngleAcross => [
            "the field of view is not halved before its tangent is taken",
            "угол обзора не разделён пополам перед тангенсом",
        ],
        Window::HalvedAngle | Window::HalvedAngleAcross => [
            "the field of view is halved twice before its tangent is taken",
            "угол обзора перед тангенсом разделён пополам дважды",
        ],
    }
}

fn curve_in_words(expected: CodeCurve, found: CodeCurve) -> Words {
    match (expected, found) {
        (_, CodeCurve::GammaTwice) => [
            "light is encoded twice: by a gamma of 2.2 and again",
            "свет закодирован дважды: гаммой 2,2 и ещё раз",
        ],
        (_, CodeCurve::SrgbTwice) => [
            "light is encoded twice: by the sRGB curve and again",
            "свет закодирован дважды: кривой sRGB и ещё раз",
        ],
        (_, CodeCurve::SrgbThenGamma | CodeCurve::GammaThenSrgb) => [
            "light is encoded twice: by the sRGB curve and by a gamma of 2.2",
            "свет закодирован дважды: кривой sRGB и гаммой 2,2",
        ],
        (_, CodeCurve::Decoded) => [
            "the sRGB curve goes the wrong way: light is decoded instead of encoded",
            "кривая sRGB не в ту сторону: свет декодирован, а не закодирован",
        ],
        (_, CodeCurve::Linear) => {
            ["codes are linear, without the sRGB curve (gamma)", "коды линейны, без кривой sRGB (гаммы)"]
        }
        (CodeCurve::Linear, CodeCurve::Srgb) => [
            "codes have the sRGB curve (gamma), though linear ones are expected",
            "коды с кривой sRGB (гаммой), а ожидались линейные",
        ],
        (CodeCurve::Linear, CodeCurve::Gamma) => [
            "codes have a gamma of 2.2, though linear ones are expected",
            "коды с гаммой 2,2, а ожидались линейные",
        ],
        (_, CodeCurve::Srgb) => ["codes have the sRGB curve (gamma)", "коды с кривой sRGB (гаммой)"],
        (_, CodeCurve::Gamma) => {
            ["codes have a gamma of 2.2 instead of the sRGB curve", "коды с гаммой 2,2 вместо кривой sRGB"]
        }
        (_, CodeCurve::SquareRoot) => {
            ["codes are square roots of light (gamma 2)", "коды — квадратные корни света (гамма 2)"]
        }
        (_, CodeCurve::Darkened) => [
            "gamma goes the wrong way: codes are light to the power 2.2",
            "гамма не в ту сторону: коды — свет в степени 2,2",
        ],
        (_, CodeCurve::Reinhard) => {
            ["light is tone-mapped by x / (1 + x)", "свет сжат тональной кривой x / (1 + x)"]
        }
    }
}
