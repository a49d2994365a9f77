//! Mistakes that explain how a picture differs from the exact one.

use catoptric_scene::{Anchor, Material, Scene, ShapeKind};
use glam::DVec3;

use super::codes::{CodeCurve, CodeStage};
use super::faults::{Fault, FaultSet};
use super::observed::Orientation;
use super::places::{Offset, OffsetKind, Window};

/// A change of the scene that a program makes by mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SceneMistake {
    /// Rays go straight through clear bodies.
    StraightRefraction,
    /// The indices of refraction are exchanged.
    InvertedRefraction,
    /// Radii are twice as large: diameters are taken for them.
    DoubledRadius,
    /// Radii are half as large.
    HalvedRadius,
    /// Patterns and textures are left out.
    NoPattern,
    /// The middles of cylinders are taken for the centers of their bases.
    CylindersUp,
    /// The centers of the bases of cylinders are taken for their middles.
    CylindersDown,
    /// Apex and base of cones are exchanged.
    TurnedCones,
}

impl SceneMistake {
    pub(super) const ALL: [Self; 8] = [
        Self::StraightRefraction,
        Self::InvertedRefraction,
        Self::DoubledRadius,
        Self::HalvedRadius,
        Self::NoPattern,
        Self::CylindersUp,
        Self::CylindersDown,
        Self::TurnedCones,
    ];

    /// The scene with the mistake.
    pub(super) fn applied(self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let radius = |factor: f64, scene: &mut Scene| {
            for body in scene.bodies.iter_mut().filter(|body| body.shape.kind() != ShapeKind::Paraboloid) {
                for key in ["radius", "top_radius"] {
                    if let Some(own) = body.shape.number(key) {
                        body.shape.set_number(key, own * factor);
                    }
                }
            }
        };
        match self {
            Self::DoubledRadius => radius(2.0, &mut scene),
            Self::HalvedRadius => radius(0.5, &mut scene),
            Self::StraightRefraction => each_material(&mut scene, |material| {
                if let Some(ior) = material.ior_mut() {
                    *ior = 1.0;
                }
            }),
            Self::InvertedRefraction => each_material(&mut scene, |material| {
                if let Some(ior) = material.ior_mut() {
                    *ior = ior.max(1e-3).recip();
                }
            }),
            Self::CylindersUp => move_cylinders(&mut scene, 0.5),
            Self::CylindersDown => move_cylinders(&mut scene, -0.5),
            Self::TurnedCones => {
                for body in scene.bodies.iter_mut().filter(|body| body.shape.kind() == ShapeKind::Cone) {
                    if let Anchor::Axis { base, top } = &mut body.placement.anchor {
                        std::mem::swap(base, top);
                    }
                }
            }
            Self::NoPattern => each_material(&mut scene, |material| {
                if let Some(pattern) = material.pattern_mut() {
                    pattern.solid = None;
                    pattern.texture = None;
                }
            }),
        }
        scene
    }
}

/// Moves cylinders along their axes by a part of their height.
fn move_cylinders(scene: &mut Scene, part: f64) {
    for body in scene.bodies.iter_mut().filter(|body| body.shape.kind() == ShapeKind::Cylinder) {
        let height = body.height().unwrap_or_default();
        let axis = body.placement.world_from_body().transform_vector3(DVec3::Y * height);
        body.placement = body.placement.moved_by(part * axis);
    }
}

fn each_material(scene: &mut Scene, change: impl Fn(&mut Material)) {
    scene.materials.iter_mut().for_each(|named| change(&mut named.material));
    for body in &mut scene.bodies {
        body.each_material_mut(&mut |choice| {
            if let catoptric_scene::MaterialChoice::Inline(material) = choice {
                change(material);
            }
        });
    }
}

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
            Self::Scene(SceneMistake::StraightRefraction) => "refraction-without-bending",
            Self::Scene(SceneMistake::InvertedRefraction) => "refraction-indices-exchanged",
            Self::Scene(SceneMistake::DoubledRadius) => "diameter-taken-as-radius",
            Self::Scene(SceneMistake::HalvedRadius) => "radius-taken-as-diameter",
            Self::Scene(SceneMistake::NoPattern) => "no-pattern",
            Self::Scene(SceneMistake::CylindersUp | SceneMistake::CylindersDown) => {
                "middle-and-base-of-cylinders"
            }
            Self::Scene(SceneMistake::TurnedCones) => "apex-and-base-of-cones",
            Self::Fault(fault) => fault.key(),
            Self::Acne => "acne",
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
    pub(super) scene: Option<SceneMistake>,
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
            scene: None,
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
            + usize::from(self.scene.is_some())
            + self.faults.iter().count()
            + usize::from(self.has_acne)
    }

    /// Whether another explanation has the same rays and sums of light.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let place = |own: &Self| (own.orientation, own.window, own.offset, own.scene, own.has_acne);
        place(self) == place(other) && self.faults == other.faults
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
        all.extend(self.scene.map(Mistake::Scene));
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
        if self.scene.is_some() {
            all.push(Self { scene: None, ..self.clone() });
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
