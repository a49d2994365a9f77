//! Mistakes that explain how a picture differs from the exact one.

use super::codes::{CodeCurve, CodeStage};
use super::faults::{Fault, FaultSet};
use super::observed::Orientation;
use super::places::{Offset, OffsetKind, Window};
use super::ray_fault::{RayFault, RayFaults};
use super::scene_mistake::{SceneMistake, SceneMistakes};

/// A mistake of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mistake {
    /// Its size is another one than is expected.
    Size {
        /// Width and height that are expected, pixels.
        expected: [u32; 2],
        /// Width and height of the file, pixels.
        found: [u32; 2],
    },
    /// Its pixels are stored in another order.
    Orientation(Orientation),
    /// It shows another part of the view.
    Window(Window),
    /// Its rays go through other places of the pixels.
    Offset(Offset),
    /// The scene is another one.
    Scene(SceneMistake),
    /// Rays go elsewhere, or meet something else.
    Ray(RayFault),
    /// The light of rays is summed up in another way.
    Fault(Fault),
    /// Points of surfaces lie in their own shadow, one here, one there.
    Acne,
    /// Codes follow another curve.
    Curve {
        /// The curve that is expected.
        expected: CodeCurve,
        /// The curve of the picture.
        found: CodeCurve,
    },
    /// All light has another strength.
    Exposure {
        /// The factor.
        factor: f32,
    },
    /// Light is clamped before it is weakened.
    ClampedFirst,
    /// Codes above 255 begin again at 0.
    Overflow,
    /// Red and blue are exchanged.
    BlueFirst,
}

impl Mistake {
    /// The name in JSON.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Size { .. } => "size",
            Self::Orientation(Orientation::Upright) | Self::Window(Window::Right) => "none",
            Self::Orientation(Orientation::FlippedAcross) => "flipped-left-to-right",
            Self::Orientation(Orientation::FlippedDown) => "flipped-top-to-bottom",
            Self::Orientation(Orientation::UpsideDown) => "turned-upside-down",
            Self::Orientation(Orientation::Transposed) => "transposed",
            Self::Orientation(Orientation::TurnedLeft) => "turned-left",
            Self::Orientation(Orientation::TurnedRight) => "turned-right",
            Self::Orientation(Orientation::ColumnByColumn) => "column-by-column",
            Self::Window(Window::AngleForHeight) => "field-of-view-taken-as-vertical",
            Self::Window(Window::AngleForWidth) => "field-of-view-taken-as-horizontal",
            Self::Window(Window::SquareByHeight | Window::SquareByWidth) => "aspect-ratio-left-out",
            Self::Window(Window::Stretched) => "stretched",
            Self::Window(Window::WholeAngle | Window::WholeAngleAcross) => "field-of-view-not-halved",
            Self::Window(Window::HalvedAngle | Window::HalvedAngleAcross) => "field-of-view-halved-twice",
            Self::Offset(offset) if offset.is_whole() => "one-pixel",
            Self::Offset(_) => "half-pixel",
            Self::Window(Window::Fitted { .. }) => "view-stretched-or-cropped",
            Self::Scene(mistake) => mistake.key(),
            Self::Ray(fault) => fault.key(),
            Self::Fault(fault) => fault.key(),
            Self::Acne => "acne",
            Self::Curve { found, .. } if found.is_double() => "encoded-twice",
            Self::Curve { found: CodeCurve::Linear, .. } => "linear-instead-of-gamma",
            Self::Curve {
                expected: CodeCurve::Linear,
                found: CodeCurve::Srgb | CodeCurve::Gamma | CodeCurve::SquareRoot,
            } => "gamma-instead-of-linear",
            Self::Curve { .. } => "tone-curve",
            Self::Exposure { .. } => "exposure",
            Self::ClampedFirst => "clamped-early",
            Self::Overflow => "codes-overflow",
            Self::BlueFirst => "red-and-blue-exchanged",
        }
    }
}

impl Offset {
    /// Whether it is a whole pixel in the one direction and none in the other.
    pub(super) fn is_whole(&self) -> bool {
        self.kind == OffsetKind::Moved && self.halves.iter().all(|half| half % 2 == 0)
    }
}

/// An explanation of a picture: the place of its pixels, the rays, the sum of light and the codes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Explanation {
    pub(super) orientation: Orientation,
    pub(super) window: Window,
    pub(super) offset: Offset,
    pub(super) scene: SceneMistakes,
    pub(super) rays: RayFaults,
    pub(super) faults: FaultSet,
    pub(super) has_acne: bool,
    pub(super) stage: CodeStage,
}

impl Explanation {
    /// A picture without mistakes.
    pub(super) fn right(curve: CodeCurve) -> Self {
        Self {
            orientation: Orientation::Upright,
            window: Window::Right,
            offset: Offset::default(),
            scene: SceneMistakes::default(),
            rays: RayFaults::default(),
            faults: FaultSet::default(),
            has_acne: false,
            stage: CodeStage::plain(curve),
        }
    }

    /// The number of mistakes but those of the codes.
    pub(super) fn deviations(&self) -> usize {
        usize::from(self.orientation != Orientation::Upright)
            + usize::from(self.window != Window::Right)
            + usize::from(self.offset != Offset::default())
            + self.scene.iter().count()
            + self.rays.iter().count()
            + self.faults.iter().count()
            + usize::from(self.has_acne)
    }

    /// Whether another explanation has the same rays and sums of light.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.has_rays_of(other) && self.faults == other.faults && self.has_acne == other.has_acne
    }

    /// Whether another explanation has the same rays.
    pub(super) fn has_rays_of(&self, other: &Self) -> bool {
        let place = |own: &Self| (own.orientation, own.window, own.offset);
        place(self) == place(other) && self.scene == other.scene && self.rays == other.rays
    }

    /// The mistakes, those of the place first.
    pub(super) fn mistakes(&self, expected: CodeCurve) -> Vec<Mistake> {
        let mut all = Vec::new();
        if self.orientation != Orientation::Upright {
            all.push(Mistake::Orientation(self.orientation));
        }
        if self.window != Window::Right {
            all.push(Mistake::Window(self.window));
        }
        if self.offset != Offset::default() {
            all.push(Mistake::Offset(self.offset));
        }
        let stage = &self.stage;
        if stage.curve != expected {
            all.push(Mistake::Curve { expected, found: stage.curve });
        }
        if stage.factor != 1.0 {
            all.push(Mistake::Exposure { factor: stage.factor });
        }
        all.extend(stage.is_clamped_first.then_some(Mistake::ClampedFirst));
        all.extend(stage.overflows.then_some(Mistake::Overflow));
        all.extend(stage.is_blue_first.then_some(Mistake::BlueFirst));
        all.extend(self.scene.iter().map(Mistake::Scene));
        all.extend(self.rays.iter().map(Mistake::Ray));
        all.extend(self.faults.iter().map(Mistake::Fault));
        all.extend(self.has_acne.then_some(Mistake::Acne));
        all
    }

    /// The explanations that lack one of the mistakes each, but those of the codes.
    pub(super) fn simpler(&self) -> Vec<Self> {
        let mut all = Vec::new();
        if self.orientation != Orientation::Upright {
            all.push(Self { orientation: Orientation::Upright, ..self.clone() });
        }
        if self.window != Window::Right {
            all.push(Self { window: Window::Right, ..self.clone() });
        }
        if self.offset != Offset::default() {
            all.push(Self { offset: Offset::default(), ..self.clone() });
        }
        for mistake in self.scene.iter() {
            all.push(Self { scene: self.scene.without(mistake), ..self.clone() });
        }
        for fault in self.rays.iter() {
            all.push(Self { rays: self.rays.without(fault), ..self.clone() });
        }
        for fault in self.faults.iter() {
            all.push(Self { faults: self.faults.without(fault), ..self.clone() });
        }
        if self.has_acne {
            all.push(Self { has_acne: false, ..self.clone() });
        }
        all
    }
}
