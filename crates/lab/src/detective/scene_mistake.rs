//! Mistakes that make another scene of the one that is asked for.

use catoptric_scene::{
    Anchor, Body, Material, PatternSpace, Scene, Shadow, ShapeKind, SolidTexture, rotation_degrees,
};
use glam::{DMat3, DQuat, DVec3};

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

    fn matrix(self, degrees: DVec3) -> DMat3 {
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
                all.extend([OtherOrigin::Up, OtherOrigin::Down].map(|origin| Self::OtherOrigin(kind, origin)));
                all.extend([500, 2000].map(|size| Self::Sized(kind, SizeKind::All, size)));
            }
            if matches!(kind, BodyKind::Cylinders | BodyKind::Cones) {
                for size in [500, 2000] {
                    all.extend([SizeKind::Radius, SizeKind::Height].map(|which| Self::Sized(kind, which, size)));
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

    /// The scene with the mistake.
    pub(super) fn applied(self, scene: &Scene) -> Scene {
        let unit = distance_of_bodies(scene);
        let mut scene = scene.clone();
        match self {
            Self::DoubledRadius => change_radii(&mut scene, 2.0),
            Self::HalvedRadius => change_radii(&mut scene, 0.5),
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
            Self::CylindersUp => move_within(&mut scene, BodyKind::Cylinders, DVec3::Y),
            Self::CylindersDown => move_within(&mut scene, BodyKind::Cylinders, DVec3::NEG_Y),
            Self::OtherOrigin(kind, origin) => {
                let way = match origin {
                    OtherOrigin::Up => DVec3::Y,
                    OtherOrigin::Down => DVec3::NEG_Y,
                    OtherOrigin::LeastCorner => DVec3::ONE,
                    OtherOrigin::GreatestCorner => DVec3::NEG_ONE,
                };
                move_within(&mut scene, kind, way);
            }
            Self::TurnedCones => of_kind(&mut scene, BodyKind::Cones, turn_cone),
            Self::TurnOrder(order) => turn_bodies(&mut scene, |degrees| order.matrix(degrees)),
            Self::TurnedBack => turn_bodies(&mut scene, |degrees| {
                let radians = -degrees * std::f64::consts::PI / 180.0;
                DMat3::from_rotation_z(radians.z)
                    * DMat3::from_rotation_y(radians.y)
                    * DMat3::from_rotation_x(radians.x)
            }),
            Self::InverseTurn => turn_bodies(&mut scene, |degrees| TurnOrder::Xyz.matrix(-degrees)),
            Self::NoTurn => turn_bodies(&mut scene, |_| DMat3::IDENTITY),
            Self::NoScale => {
                scene.bodies.iter_mut().for_each(|body| body.placement.scale = DVec3::ONE);
            }
            Self::NoPattern => each_material(&mut scene, |material| {
                if let Some(pattern) = material.pattern_mut() {
                    pattern.solid = None;
                    pattern.texture = None;
                }
            }),
            Self::PatternExchanged => each_material(&mut scene, |material| {
                if let Some(pattern) = material.pattern_mut()
                    && let Some(solid) = &mut pattern.solid
                {
                    std::mem::swap(&mut pattern.color, &mut solid.color);
                }
            }),
            Self::PatternShifted => {
                each_solid(&mut scene, |solid| solid.position -= 0.5 * solid.size * solid.scale);
            }
            Self::PatternDoubled => each_solid(&mut scene, |solid| solid.size *= 2.0),
            Self::PatternHalved => each_solid(&mut scene, |solid| solid.size *= 0.5),
            Self::PatternMultiplied => {
                each_solid(&mut scene, |solid| solid.size = solid.size.max(1e-6).recip());
            }
            Self::PatternUnscaled => each_solid(&mut scene, |solid| solid.size = 1.0),
            Self::PatternSpace => each_solid(&mut scene, |solid| {
                solid.space = match solid.space {
                    PatternSpace::World => PatternSpace::Body,
                    PatternSpace::Body => PatternSpace::World,
                };
            }),
            Self::Missing(kind) => of_kind(&mut scene, kind, |body| body.hidden = true),
            Self::Shadowless(kind) => of_kind(&mut scene, kind, |body| body.shadow = Shadow::None),
            Self::Sized(kind, which, size) => {
                of_kind(&mut scene, kind, |body| resize(body, which, f64::from(size) / 1000.0));
            }
            Self::Shifted(kind, way) => {
                let way = DVec3::from_array(way.map(f64::from)) / 1000.0 * unit;
                of_kind(&mut scene, kind, |body| body.placement = body.placement.moved_by(way));
            }
            Self::TargetAsDirection => {
                let camera = &mut scene.camera;
                if camera.target.length() > 1e-9 {
                    camera.target += camera.position;
                }
            }
            Self::CameraMoved(way, is_straight) => {
                move_camera(&mut scene, way.map(|part| f64::from(part) / 1000.0 * unit), is_straight);
            }
        }
        scene
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
            Self::PatternDoubled
            | Self::PatternHalved
            | Self::PatternMultiplied
            | Self::PatternUnscaled => "checker-size",
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

/// Changes the bodies of a kind.
fn of_kind(scene: &mut Scene, kind: BodyKind, change: impl Fn(&mut Body)) {
    scene.bodies.iter_mut().filter(|body| kind.has(body)).for_each(change);
}

fn change_radii(scene: &mut Scene, factor: f64) {
    for body in scene.bodies.iter_mut().filter(|body| body.shape.kind() != ShapeKind::Paraboloid) {
        resize(body, SizeKind::Radius, factor);
    }
}

fn resize(body: &mut Body, which: SizeKind, factor: f64) {
    let mut change = |key: &str| {
        if let Some(own) = body.shape.number(key) {
            body.shape.set_number(key, own * factor);
        }
    };
    if which != SizeKind::Height {
        change("radius");
        change("top_radius");
    }
    if which != SizeKind::Radius {
        change("height");
        if let Some(size) = body.shape.vector("size") {
            body.shape.set_vector("size", size * factor);
        }
        if let Anchor::Axis { base, top } = &mut body.placement.anchor {
            *top = *base + factor * (*top - *base);
        }
    }
}

/// Moves bodies of a kind along their own axes by halves of their extents.
fn move_within(scene: &mut Scene, kind: BodyKind, way: DVec3) {
    of_kind(scene, kind, |body| {
        let radius = body.shape.number("radius").unwrap_or_default();
        let size = match (body.shape.vector("size"), body.height()) {
            (Some(size), _) => size,
            (None, Some(height)) => DVec3::new(2.0 * radius, height, 2.0 * radius),
            (None, None) => DVec3::splat(2.0 * radius),
        };
        let moved = body.placement.world_from_body().transform_vector3(0.5 * way * size);
        body.placement = body.placement.moved_by(moved);
    });
}

/// Exchanges the ends of a cone.
fn turn_cone(body: &mut Body) {
    if let Anchor::Axis { base, top } = &mut body.placement.anchor {
        std::mem::swap(base, top);
        return;
    }
    let (radius, top_radius) = (body.shape.number("radius"), body.shape.number("top_radius"));
    if let (Some(radius), Some(top_radius)) = (radius, top_radius) {
        body.shape.set_number("radius", top_radius);
        body.shape.set_number("top_radius", radius);
    }
}

/// Gives bodies that are turned about their frames' axes another rotation.
fn turn_bodies(scene: &mut Scene, rotation: impl Fn(DVec3) -> DMat3) {
    for body in scene.bodies.iter_mut() {
        if let Anchor::Frame { rotation_degrees: own, .. } = &mut body.placement.anchor
            && *own != DVec3::ZERO
        {
            *own = rotation_degrees(DQuat::from_mat3(&rotation(*own)));
        }
    }
}

/// The mean distance of bounded bodies from the eye, meters: the unit of small displacements.
fn distance_of_bodies(scene: &Scene) -> f64 {
    let camera = &scene.camera;
    let bounded = scene.bodies.iter().filter(|body| !body.hidden && !BodyKind::Planes.has(body));
    let (count, sum) = bounded.fold((0_u32, 0.0), |(count, sum), body| {
        (count + 1, sum + body.placement.origin().distance(camera.position))
    });
    if count > 0 { sum / f64::from(count) } else { camera.target.distance(camera.position) }
}

fn move_camera(scene: &mut Scene, [x, y, z]: [f64; 3], is_straight: bool) {
    let camera = &mut scene.camera;
    let ahead = (camera.target - camera.position).normalize_or(DVec3::NEG_Z);
    let right = ahead.cross(camera.up).normalize_or(DVec3::X);
    let moved = x * right + y * right.cross(ahead) + z * ahead;
    camera.position += moved;
    if is_straight {
        camera.target += moved;
    }
}

fn each_solid(scene: &mut Scene, change: impl Fn(&mut SolidTexture)) {
    each_material(scene, |material| {
        if let Some(solid) = material.pattern_mut().and_then(|pattern| pattern.solid.as_mut()) {
            change(solid);
        }
    });
}

fn each_material(scene: &mut Scene, change: impl Fn(&mut Material)) {
    scene.materials.iter_mut().for_each(|named| change(&mut named.material));
    for body in scene.bodies.iter_mut() {
        body.each_material_mut(&mut |choice| {
            if let catoptric_scene::MaterialChoice::Inline(material) = choice {
                change(material);
            }
        });
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
