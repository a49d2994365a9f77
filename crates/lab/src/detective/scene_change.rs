//! Scenes as mistakes change them.

use catoptric_scene::{
    Anchor, Body, Material, PatternSpace, Scene, Shadow, ShapeKind, SolidTexture, rotation_degrees,
};
use glam::{DMat3, DQuat, DVec3};

use super::scene_mistake::{BodyKind, OtherOrigin, SceneMistake, SizeKind, TurnOrder};

impl SceneMistake {
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
            Self::NoPattern
            | Self::PatternExchanged
            | Self::PatternShifted
            | Self::PatternDoubled
            | Self::PatternHalved
            | Self::PatternMultiplied
            | Self::PatternUnscaled
            | Self::PatternSpace => self.change_patterns(&mut scene),
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

    fn change_patterns(self, scene: &mut Scene) {
        match self {
            Self::NoPattern => each_material(scene, |material| {
                if let Some(pattern) = material.pattern_mut() {
                    pattern.solid = None;
                    pattern.texture = None;
                }
            }),
            Self::PatternExchanged => each_material(scene, |material| {
                if let Some(pattern) = material.pattern_mut()
                    && let Some(solid) = &mut pattern.solid
                {
                    std::mem::swap(&mut pattern.color, &mut solid.color);
                }
            }),
            Self::PatternShifted => {
                each_solid(scene, |solid| solid.position -= 0.5 * solid.size * solid.scale);
            }
            Self::PatternDoubled => each_solid(scene, |solid| solid.size *= 2.0),
            Self::PatternHalved => each_solid(scene, |solid| solid.size *= 0.5),
            Self::PatternMultiplied => {
                each_solid(scene, |solid| solid.size = solid.size.max(1e-6).recip());
            }
            Self::PatternUnscaled => each_solid(scene, |solid| solid.size = 1.0),
            Self::PatternSpace => each_solid(scene, |solid| {
                solid.space = match solid.space {
                    PatternSpace::World => PatternSpace::Body,
                    PatternSpace::Body => PatternSpace::World,
                };
            }),
            _ => {}
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
    for body in &mut scene.bodies {
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
    for body in &mut scene.bodies {
        body.each_material_mut(&mut |choice| {
            if let catoptric_scene::MaterialChoice::Inline(material) = choice {
                change(material);
            }
        });
    }
}
