//! Mistakes that make another scene of the one that is asked for.

use catoptric_scene::{Body, Scene, ShapeKind};
use glam::{DMat3, DVec3};

use super::facts::SceneFacts;
use super::verdict::Words;

/// The bodies of one shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BodyKind {
    /// Spheres.
    Spheres,
    /// Cubes.
    Cubes,
    /// Cylinders.
    Cylinders,
    /// Cones and their frustums.
    Cones,
    /// Planes.
    Planes,
}

impl BodyKind {
    pub(super) const ALL: [Self; 5] =
        [Self::Spheres, Self::Cubes, Self::Cylinders, Self::Cones, Self::Planes];

    /// Whether a body is of this kind.
    pub(super) fn has(self, body: &Body) -> bool {
        let kind = match self {
            Self::Spheres => ShapeKind::Sphere,
            Self::Cubes => ShapeKind::Cube,
            Self::Cylinders => ShapeKind::Cylinder,
            Self::Cones => ShapeKind::Cone,
            Self::Planes => ShapeKind::Plane,
        };
        body.shape.kind() == kind
    }

    /// Its name in English and in Russian.
    pub(super) fn words(self) -> Words {
        match self {
            Self::Spheres => ["spheres", "шары"],
            Self::Cubes => ["cubes", "кубы"],
            Self::Cylinders => ["cylinders", "цилиндры"],
            Self::Cones => ["cones", "конусы"],
            Self::Planes => ["planes", "плоскости"],
        }
    }
}

/// The order in which three turns are multiplied, the last applied first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TurnOrder {
    /// Rx · Ry · Rz.
    Xyz,
    /// Rx · Rz · Ry.
    Xzy,
    /// Ry · Rx · Rz.
    Yxz,
    /// Ry · Rz · Rx.
    Yzx,
    /// Rz · Rx · Ry.
    Zxy,
}

impl TurnOrder {
    const ALL: [Self; 5] = [Self::Xyz, Self::Yxz, Self::Zxy, Self::Yzx, Self::Xzy];

    pub(super) fn matrix(self, degrees: DVec3) -> DMat3 {
        let radians = degrees * std::f64::consts::PI / 180.0;
        let [x, y, z] = [
            DMat3::from_rotation_x(radians.x),
            DMat3::from_rotation_y(radians.y),
            DMat3::from_rotation_z(radians.z),
        ];
        match self {
            Self::Xyz => x * y * z,
            Self::Xzy => x * z * y,
            Self::Yxz => y * x * z,
            Self::Yzx => y * z * x,
            Self::Zxy => z * x * y,
        }
    }
}

/// Where in its own frame a body stands by mistake, in halves of its extent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum OtherOrigin {
    /// Its middle is taken for its base: it stands higher.
    Up,
    /// Its base is taken for its middle: it stands lower.
    Down,
    /// Its middle is taken for its least corner.
    LeastCorner,
    /// Its middle is taken for its greatest corner.
    GreatestCorner,
}

/// Which sizes of bodies are wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SizeKind {
    /// All.
    All,
    /// Radii.
    Radius,
    /// Heights.
    Height,
}

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
    /// Turns are multiplied in another order.
    TurnOrder(TurnOrder),
    /// Bodies are turned in the other sense.
    TurnedBack,
    /// Bodies are turned by the inverse of their rotation.
    InverseTurn,
    /// Bodies are not turned.
    NoTurn,
    /// Bodies are not scaled.
    NoScale,
    /// The two colors of patterns are exchanged.
    PatternExchanged,
    /// Patterns are moved by half of a cell.
    PatternShifted,
    /// Cells of patterns are twice as large.
    PatternDoubled,
    /// Cells of patterns are half as large.
    PatternHalved,
    /// Points are multiplied by the size of cells in the place of being divided.
    PatternMultiplied,
    /// The size of cells is left out.
    PatternUnscaled,
    /// Patterns are laid out in the space of the body in the place of the world's, or the reverse.
    PatternSpace,
    /// The bodies of a kind are missing.
    Missing(BodyKind),
    /// The bodies of a kind throw no shadows.
    Shadowless(BodyKind),
    /// The bodies of a kind stand elsewhere by parts of their own size.
    OtherOrigin(BodyKind, OtherOrigin),
    /// The bodies of a kind have other sizes: by thousandths.
    Sized(BodyKind, SizeKind, u16),
    /// The bodies of a kind stand elsewhere: thousandths of the distance of the eye along the axes of the world.
    Shifted(BodyKind, [i16; 3]),
    /// The camera's target is taken for the direction of view.
    TargetAsDirection,
    /// The camera stands elsewhere: thousandths of its distance from the bodies to the right, up and ahead. The last says
    /// whether it looks in the same direction instead of at the same target.
    CameraMoved([i16; 3], bool),
}

impl SceneMistake {
    /// All without numbers that are looked for later, the likelier first.
    pub(super) fn all() -> Vec<Self> {
        let mut all = vec![
            Self::StraightRefraction,
            Self::InvertedRefraction,
            Self::DoubledRadius,
            Self::HalvedRadius,
            Self::NoPattern,
            Self::CylindersUp,
            Self::CylindersDown,
            Self::TurnedCones,
        ];
        all.extend(TurnOrder::ALL.map(Self::TurnOrder));
        all.extend([
            Self::TurnedBack,
            Self::InverseTurn,
            Self::NoTurn,
            Self::NoScale,
            Self::PatternShifted,
            Self::PatternExchanged,
            Self::PatternDoubled,
            Self::PatternHalved,
            Self::PatternMultiplied,
            Self::PatternUnscaled,
            Self::PatternSpace,
            Self::TargetAsDirection,
        ]);
        for kind in BodyKind::ALL {
            all.extend([Self::Missing(kind), Self::Shadowless(kind)]);
            if kind != BodyKind::Planes {
                all.extend(
                    [OtherOrigin::Up, OtherOrigin::Down].map(|origin| Self::OtherOrigin(kind, origin)),
                );
                all.extend([500, 2000].map(|size| Self::Sized(kind, SizeKind::All, size)));
            }
            if matches!(kind, BodyKind::Cylinders | BodyKind::Cones) {
                for size in [500, 2000] {
                    all.extend(
                        [SizeKind::Radius, SizeKind::Height].map(|which| Self::Sized(kind, which, size)),
                    );
                }
            }
        }
        all.extend(
            [OtherOrigin::LeastCorner, OtherOrigin::GreatestCorner]
                .map(|origin| Self::OtherOrigin(BodyKind::Cubes, origin)),
        );
        all
    }

    /// The numbers from which the search for others begins, for bodies that differ and cameras that stand elsewhere.
    pub(super) fn first_numbers() -> Vec<Self> {
        let mut all = Vec::new();
        let axes = |step: i16| {
            [[step, 0, 0], [-step, 0, 0], [0, step, 0], [0, -step, 0], [0, 0, step], [0, 0, -step]]
        };
        for step in [10, 30, 90] {
            all.extend(axes(step).map(|way| Self::CameraMoved(way, false)));
            all.extend(axes(step).map(|way| Self::CameraMoved(way, true)));
        }
        for kind in BodyKind::ALL {
            for step in [15, 45, 120] {
                all.extend(axes(step).map(|way| Self::Shifted(kind, way)));
            }
            if kind != BodyKind::Planes {
                let sizes = [600, 750, 850, 930, 1080, 1200, 1400, 1700];
                all.extend(sizes.map(|size| Self::Sized(kind, SizeKind::All, size)));
                if matches!(kind, BodyKind::Cylinders | BodyKind::Cones) {
                    all.extend(sizes.map(|size| Self::Sized(kind, SizeKind::Height, size)));
                    all.extend(sizes.map(|size| Self::Sized(kind, SizeKind::Radius, size)));
                }
            }
        }
        all
    }

    /// Mistakes of the kind whose numbers are near its own: at a distance of `step` of the whole.
    pub(super) fn neighbors(self, step: i16) -> Vec<Self> {
        let around = |way: [i16; 3]| {
            (0..6_usize).map(move |index| {
                let mut way = way;
                let sign = if index % 2 == 0 { 1 } else { -1 };
                if let Some(along) = way.get_mut(index / 2) {
                    *along = along.saturating_add(sign * step);
                }
                way
            })
        };
        match self {
            Self::CameraMoved(way, is_straight) => {
                around(way).map(|way| Self::CameraMoved(way, is_straight)).collect()
            }
            Self::Shifted(kind, way) => around(way).map(|way| Self::Shifted(kind, way)).collect(),
            Self::Sized(kind, which, size) => [step, -step]
                .into_iter()
                .map(|step| Self::Sized(kind, which, size.saturating_add_signed(step).max(20)))
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Whether a scene can show it.
    pub(super) fn is_possible(self, facts: &SceneFacts) -> bool {
        match self {
            Self::StraightRefraction | Self::InvertedRefraction => facts.transmits,
            Self::DoubledRadius | Self::HalvedRadius => facts.is_round,
            Self::NoPattern
            | Self::PatternExchanged
            | Self::PatternShifted
            | Self::PatternDoubled
            | Self::PatternHalved
            | Self::PatternSpace => facts.has_patterns,
            Self::PatternMultiplied | Self::PatternUnscaled => facts.has_sized_patterns,
            Self::CylindersUp | Self::CylindersDown => facts.has_cylinders,
            Self::TurnedCones => facts.has_cones,
            Self::TurnOrder(_) | Self::InverseTurn => facts.turns > 1,
            Self::TurnedBack | Self::NoTurn => facts.turns > 0,
            Self::NoScale => facts.is_stretched,
            Self::Missing(kind) | Self::Sized(kind, ..) | Self::Shifted(kind, _) => facts.has_kind(kind),
            Self::Shadowless(kind) => facts.is_lit && facts.has_kind(kind),
            // That of cylinders has a name of its own.
            Self::OtherOrigin(kind, OtherOrigin::Up | OtherOrigin::Down) => {
                kind != BodyKind::Cylinders && facts.has_kind(kind)
            }
            Self::OtherOrigin(kind, _) => facts.has_kind(kind),
            Self::TargetAsDirection | Self::CameraMoved(..) => true,
        }
    }

    /// Mistakes of one topic exclude each other.
    pub(super) fn topic(self) -> (u8, Option<BodyKind>) {
        match self {
            Self::StraightRefraction | Self::InvertedRefraction => (0, None),
            Self::DoubledRadius | Self::HalvedRadius => (1, None),
            Self::CylindersUp | Self::CylindersDown => (2, Some(BodyKind::Cylinders)),
            Self::TurnedCones => (3, None),
            Self::TurnOrder(_) | Self::TurnedBack | Self::InverseTurn | Self::NoTurn => (4, None),
            Self::NoScale => (5, None),
            Self::NoPattern
            | Self::PatternExchanged
            | Self::PatternShifted
            | Self::PatternDoubled
            | Self::PatternHalved
            | Self::PatternMultiplied
            | Self::PatternUnscaled
            | Self::PatternSpace => (6, None),
            Self::OtherOrigin(kind, _) | Self::Shifted(kind, _) => (2, Some(kind)),
            Self::Missing(kind) => (7, Some(kind)),
            Self::Shadowless(kind) => (8, Some(kind)),
            Self::Sized(kind, ..) => (9, Some(kind)),
            Self::TargetAsDirection | Self::CameraMoved(..) => (10, None),
        }
    }

    /// The name in JSON.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::StraightRefraction => "refraction-without-bending",
            Self::InvertedRefraction => "refraction-indices-exchanged",
            Self::DoubledRadius => "diameter-taken-as-radius",
            Self::HalvedRadius => "radius-taken-as-diameter",
            Self::NoPattern => "no-pattern",
            Self::CylindersUp | Self::CylindersDown => "middle-and-base-of-cylinders",
            Self::TurnedCones => "apex-and-base-of-cones",
            Self::TurnOrder(_) => "rotation-order",
            Self::TurnedBack | Self::InverseTurn => "rotation-sense",
            Self::NoTurn => "rotation-left-out",
            Self::NoScale => "scale-left-out",
            Self::PatternExchanged => "checker-colors-exchanged",
            Self::PatternShifted => "checker-shifted",
            Self::PatternDoubled | Self::PatternHalved | Self::PatternMultiplied | Self::PatternUnscaled => {
                "checker-size"
            }
            Self::PatternSpace => "checker-space",
            Self::Missing(_) => "kind-of-body-missing",
            Self::Shadowless(_) => "kind-of-body-without-shadow",
            Self::OtherOrigin(..) | Self::Shifted(..) => "kind-of-body-shifted",
            Self::Sized(..) => "kind-of-body-sized",
            Self::TargetAsDirection => "target-taken-as-direction",
            Self::CameraMoved(..) => "camera-moved",
        }
    }
}

/// Mistakes of the scene of different topics, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct SceneMistakes(Vec<SceneMistake>);

impl SceneMistakes {
    pub(super) fn iter(&self) -> impl Iterator<Item = SceneMistake> {
        self.0.iter().copied()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The set with one more; `None` if it has one of that topic.
    pub(super) fn with(&self, mistake: SceneMistake) -> Option<Self> {
        if self.0.iter().any(|own| own.topic() == mistake.topic()) {
            return None;
        }
        let mut all = self.0.clone();
        all.push(mistake);
        all.sort_unstable();
        Some(Self(all))
    }

    pub(super) fn without(&self, mistake: SceneMistake) -> Self {
        Self(self.0.iter().copied().filter(|own| *own != mistake).collect())
    }

    /// The scene with all of them.
    pub(super) fn applied(&self, scene: &Scene) -> Scene {
        self.0.iter().fold(scene.clone(), |scene, mistake| mistake.applied(&scene))
    }
}
