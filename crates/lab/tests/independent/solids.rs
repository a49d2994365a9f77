//! Bodies of the independent tracer: their transforms, and where rays cross their surfaces.

use catoptric_scene::{Anchor, Body, Phong, Shape};
use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::Slip;

/// A body with what a ray needs to cross it.
pub(super) struct Solid {
    pub(super) kind: SolidShape,
    pub(super) to_world: DAffine3,
    pub(super) from_world: DAffine3,
    /// From the world to the body's axes, without its scale.
    pub(super) unscaled: DAffine3,
    pub(super) phong: Phong,
}

/// The shapes in their own frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SolidShape {
    Ball(f64),
    Block(DVec3),
    /// Radius at the base and at the top, and height: a cylinder or a cone.
    Drum(f64, f64, f64),
    Floor,
}

/// A crossing of a ray with a surface, in the order of the body's own frame.
#[derive(Clone, Copy)]
pub(super) struct Crossing {
    pub(super) t: f64,
    /// Outwards in the body's own frame, as the gradient of the surface.
    pub(super) gradient: DVec3,
}

/// A turn about one axis.
fn turn(axis: char, degrees: f64) -> DMat3 {
    let (s, c) = degrees.to_radians().sin_cos();
    let rows = match axis {
        'x' => [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]],
        'y' => [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]],
        _ => [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
    };
    DMat3::from_cols_array_2d(&rows).transpose()
}

fn turns(degrees: DVec3, slips: &[Slip]) -> DMat3 {
    let has = |slip| slips.contains(&slip);
    let order = match () {
        () if has(Slip::TurnsXyz) => "xyz",
        () if has(Slip::TurnsYxz) => "yxz",
        () if has(Slip::TurnsZxy) => "zxy",
        () if has(Slip::TurnsYzx) => "yzx",
        () if has(Slip::TurnsXzy) => "xzy",
        () => "zyx",
    };
    let degrees = if has(Slip::TurnsBack) { -degrees } else { degrees };
    let of = |axis| match axis {
        'x' => degrees.x,
        'y' => degrees.y,
        _ => degrees.z,
    };
    order.chars().fold(DMat3::IDENTITY, |matrix, axis| matrix * turn(axis, of(axis)))
}

impl Solid {
    pub(super) fn new(body: &Body, phong: &Phong, slips: &[Slip]) -> Self {
        let has = |slip| slips.contains(&slip);
        let (mut place, rotation, height) = match body.placement.anchor {
            Anchor::Frame { position, rotation_degrees } => (position, turns(rotation_degrees, slips), None),
            Anchor::Axis { base, top } => {
                let axis = (top - base).normalize();
                let rotation = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, axis));
                (base, rotation, Some((top - base).length()))
            }
        };
        let rotation = if has(Slip::TurnsLeftOut) { DMat3::IDENTITY } else { rotation };
        let scale = if has(Slip::ScaleLeftOut) { DVec3::ONE } else { body.placement.scale };
        let larger = match () {
            () if has(Slip::DoubledRadius) => 2.0,
            () if has(Slip::HalvedRadius) => 0.5,
            () => 1.0,
        };
        let shorter = if has(Slip::CylindersShort) { 0.7 } else { 1.0 };
        let mut kind = match body.shape {
            Shape::Sphere { radius } => SolidShape::Ball(radius * larger),
            Shape::Cube { size } => SolidShape::Block(size * if has(Slip::CubesDoubled) { 1.0 } else { 0.5 }),
            Shape::Cylinder { radius, height: own } => {
                SolidShape::Drum(radius * larger, radius * larger, height.unwrap_or(own) * shorter)
            }
            Shape::Cone { radius, top_radius, height: own } => {
                SolidShape::Drum(radius * larger, top_radius * larger, height.unwrap_or(own))
            }
            Shape::Plane => SolidShape::Floor,
            _ => panic!("simple shapes only"),
        };
        match &mut kind {
            SolidShape::Ball(_) if has(Slip::SpheresShifted) => place += DVec3::new(0.3, 0.2, 0.0),
            SolidShape::Drum(base, top, height) if base == top && has(Slip::CylindersCentered) => {
                place -= rotation * DVec3::Y * scale.y * *height * 0.5;
            }
            SolidShape::Drum(base, top, _) if has(Slip::ConesTurned) => std::mem::swap(base, top),
            _ => {}
        }
        let (moved, turned, scaled) =
            (DAffine3::from_translation(place), DAffine3::from_mat3(rotation), DAffine3::from_scale(scale));
        let to_world = if has(Slip::ScaleAfterTurn) {
            moved * scaled * turned
        } else if has(Slip::TurnAfterMove) {
            turned * moved * scaled
        } else {
            moved * turned * scaled
        };
        let unscaled = (moved * turned).inverse();
        Self { kind, to_world, from_world: to_world.inverse(), unscaled, phong: phong.clone() }
    }

    /// Whether it is left out.
    pub(super) fn is_missing(&self, slips: &[Slip]) -> bool {
        slips.contains(&Slip::ConesMissing)
            && matches!(self.kind, SolidShape::Drum(base, top, _) if base != top)
    }

    /// All crossings with a ray, in no order; `t` counts in lengths of the direction.
    pub(super) fn crossings(&self, origin: DVec3, direction: DVec3, slips: &[Slip]) -> Vec<Crossing> {
        let has = |slip| slips.contains(&slip);
        let (o, d) = (self.from_world.transform_point3(origin), self.from_world.transform_vector3(direction));
        let mut found = Vec::new();
        let mut add = |t: f64, gradient: DVec3| {
            if t.is_finite() {
                found.push(Crossing { t, gradient });
            }
        };
        match self.kind {
            SolidShape::Floor => {
                if !(has(Slip::PlaneFromAbove) && d.y >= 0.0) {
                    add(-o.y / d.y, DVec3::Y);
                }
            }
            SolidShape::Ball(radius) => {
                for t in roots(d.dot(d), o.dot(d), o.dot(o) - radius * radius, slips) {
                    add(t, o + t * d);
                }
            }
            SolidShape::Block(half) => {
                for axis in 0..3 {
                    for side in [-1.0, 1.0] {
                        let t = (side * half[axis] - o[axis]) / d[axis];
                        let at = o + t * d;
                        let is_in = |other: usize| at[other].abs() <= half[other];
                        if is_in((axis + 1) % 3) && is_in((axis + 2) % 3) {
                            add(t, side * DVec3::AXES[axis]);
                        }
                    }
                }
            }
            SolidShape::Drum(base, top, height) => {
                let slope = (top - base) / height;
                let width = |y: f64| base + slope * y;
                let flat = DVec3::new(1.0, 0.0, 1.0);
                let (w, dw) = (width(o.y), slope * d.y);
                let a = (d * flat).dot(d) - dw * dw;
                let b = (o * flat).dot(d) - w * dw;
                let c = (o * flat).dot(o) - w * w;
                let [low, high] = if has(Slip::OtherNappe) && slope != 0.0 {
                    let apex = -base / slope;
                    [2.0 * apex - height.max(apex), 2.0 * apex]
                } else {
                    [0.0, height]
                };
                let mut sides = roots(a, b, c, slips);
                if has(Slip::NoCapsSeenThrough) {
                    sides = sides.into_iter().reduce(f64::min).into_iter().collect();
                }
                for t in sides {
                    let at = o + t * d;
                    // Beyond the apex lies the other half of the double cone.
                    let is_here = has(Slip::OtherNappe) || width(at.y) >= 0.0;
                    if is_here && (has(Slip::NoEnds) || (low..=high).contains(&at.y)) {
                        let rise = if has(Slip::LevelConeNormals) { 0.0 } else { -slope * width(at.y) };
                        add(t, DVec3::new(at.x, rise, at.z));
                    }
                }
                if !has(Slip::NoCaps) && !has(Slip::NoCapsSeenThrough) && !has(Slip::NoEnds) {
                    for (y, outward) in [(low, -DVec3::Y), (high, DVec3::Y)] {
                        let t = (y - o.y) / d.y;
                        let at = o + t * d;
                        if at.x.hypot(at.z) <= width(y).abs() {
                            let radial = DVec3::new(at.x, 0.0, at.z);
                            add(t, if has(Slip::CapNormals) { radial } else { outward });
                        }
                    }
                }
            }
        }
        if has(Slip::OwnDistance) {
            found.iter_mut().for_each(|crossing| crossing.t *= d.length());
        }
        found
    }

    /// The normal in the world of a crossing.
    pub(super) fn normal(&self, gradient: DVec3, slips: &[Slip]) -> DVec3 {
        let has = |slip| slips.contains(&slip);
        let turned = |own: DVec3| self.from_world.matrix3.transpose() * own;
        if has(Slip::RawNormals) {
            return turned(gradient);
        }
        let own = gradient.normalize();
        if has(Slip::OwnNormals) {
            return own;
        }
        if has(Slip::LongNormals) {
            turned(own)
        } else if has(Slip::MatrixNormals) {
            (self.to_world.matrix3 * own).normalize()
        } else {
            turned(own).normalize()
        }
    }
}

/// The roots of a·t² + 2·b·t + c = 0.
fn roots(a: f64, b: f64, c: f64, slips: &[Slip]) -> Vec<f64> {
    if a.abs() < 1e-14 {
        return vec![-0.5 * c / b];
    }
    let b = 2.0 * b;
    let four = if slips.contains(&Slip::LostFour) { 1.0 } else { 4.0 };
    let discriminant = b * b - four * a * c;
    if discriminant < 0.0 {
        return Vec::new();
    }
    let below = if slips.contains(&Slip::LostLength) { 2.0 } else { 2.0 * a };
    let signs: &[f64] = match () {
        () if slips.contains(&Slip::FarRoot) => &[1.0],
        () if slips.contains(&Slip::NearRoot) => &[-1.0],
        () => &[-1.0, 1.0],
    };
    signs.iter().map(|sign| (-b + sign * discriminant.sqrt()) / below).collect()
}
