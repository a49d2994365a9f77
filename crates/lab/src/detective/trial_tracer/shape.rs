//! Shapes of the trial tracer in their own frames, and the faults by which rays meet them.

use glam::DVec3;

use crate::detective::ray_fault::{LeavingRule, NormalLength, RayFault, RayFaults};
use crate::detective::scene_mistake::BodyKind;

/// The fault of each topic, if it is made.
#[derive(Clone, Debug, Default)]
pub(super) struct Switches {
    pub(super) order: Option<RayFault>,
    pub(super) distance: Option<RayFault>,
    pub(super) root: Option<RayFault>,
    pub(super) ends: Option<RayFault>,
    pub(super) nappe: Option<RayFault>,
    pub(super) plane: Option<RayFault>,
    pub(super) normal: Option<RayFault>,
    pub(super) lengths: Option<[NormalLength; 4]>,
    pub(super) normal_side: Option<RayFault>,
    pub(super) has_level_cones: bool,
    pub(super) has_radial_caps: bool,
    pub(super) shadow: Option<RayFault>,
    pub(super) dark_side: Option<RayFault>,
    pub(super) lamp: Option<RayFault>,
    pub(super) reflection: Option<RayFault>,
    pub(super) leaving: Option<LeavingRule>,
    pub(super) transform: Option<RayFault>,
    pub(super) checker: Option<RayFault>,
    pub(super) view: Option<RayFault>,
}

impl Switches {
    pub(super) fn new(faults: &RayFaults) -> Self {
        let of = |like: RayFault| faults.iter().find(|fault| fault.topic() == like.topic());
        Self {
            order: of(RayFault::LastHit),
            distance: of(RayFault::OwnDistance),
            root: of(RayFault::FarRoot),
            ends: of(RayFault::NoCaps),
            nappe: of(RayFault::OtherNappe),
            plane: of(RayFault::PlanesFromAbove),
            normal: of(RayFault::MatrixNormals),
            lengths: faults.iter().find_map(|fault| match fault {
                RayFault::LongNormals(lengths) => Some(lengths),
                _ => None,
            }),
            normal_side: of(RayFault::NormalsOutward),
            has_level_cones: faults.has(RayFault::LevelConeNormals),
            has_radial_caps: faults.has(RayFault::CapNormals),
            shadow: of(RayFault::ShadowsFromBeyond),
            dark_side: of(RayFault::CosineMagnitude),
            lamp: of(RayFault::LampsAsDirections),
            reflection: of(RayFault::ReflectionBackwards),
            leaving: faults.iter().find_map(|fault| match fault {
                RayFault::Leaving(rule) => Some(rule),
                _ => None,
            }),
            transform: of(RayFault::ScaledLast),
            checker: of(RayFault::CheckerTruncated),
            view: of(RayFault::UpNotOrthogonal),
        }
    }
}

/// A shape in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) enum TrialShape {
    Sphere {
        radius: f64,
    },
    Cube {
        half: DVec3,
    },
    /// A cylinder or a cone, whose radius changes from base to top.
    Frustum {
        base: f64,
        top: f64,
        height: f64,
    },
    Plane,
}

/// A hit in the body's own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) t: f64,
    /// Outwards, of length 1.
    pub(super) normal: DVec3,
    /// The length that the normal has by the rule of the fault.
    pub(super) length: f64,
}

/// The hits of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hits {
    all: [Hit; 6],
    count: usize,
}

impl Hits {
    const NONE: Self = Self { all: [Hit { t: 0.0, normal: DVec3::Y, length: 1.0 }; 6], count: 0 };

    fn add(&mut self, t: f64, normal: DVec3, length: f64) {
        if let Some(place) = self.all.get_mut(self.count).filter(|_| t.is_finite()) {
            *place = Hit { t, normal, length };
            self.count += 1;
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Hit> {
        self.all.iter().take(self.count)
    }
}

/// The roots of a·t² + 2·h·t + c = 0 by the rule of a fault, the nearer first; infinite where there is none.
fn roots(a: f64, h: f64, c: f64, fault: Option<RayFault>) -> [f64; 2] {
    if a.abs() < 1e-12 * (h.abs() + c.abs()) {
        return [-0.5 * c / h, f64::INFINITY];
    }
    let [discriminant, middle, below] = match fault {
        Some(RayFault::LostFour) => [4.0 * h * h - a * c, -2.0 * h, 2.0 * a],
        Some(RayFault::ExtraFour) => [h * h - 4.0 * a * c, -h, 2.0 * a],
        Some(RayFault::LostSquare) => [h * h - c, -h, 1.0],
        Some(RayFault::LostLength) => [h * h - a * c, -h, 1.0],
        Some(RayFault::LostTwo) => [h * h - a * c, -h, 0.5 * a],
        _ => [h * h - a * c, -h, a],
    };
    if discriminant < 0.0 {
        return [f64::INFINITY; 2];
    }
    let width = discriminant.sqrt();
    let [low, high] = [(middle - width) / below, (middle + width) / below];
    match fault {
        Some(RayFault::FarRoot) => [low.max(high), f64::INFINITY],
        Some(RayFault::NearRoot) => [low.min(high), f64::INFINITY],
        _ => [low.min(high), low.max(high)],
    }
}

impl TrialShape {
    /// All hits of the line, in lengths of its direction.
    pub(super) fn hits(&self, origin: DVec3, direction: DVec3, switches: &Switches) -> Hits {
        let mut hits = Hits::NONE;
        match *self {
            Self::Sphere { radius } => sphere(radius, origin, direction, switches, &mut hits),
            Self::Cube { half } => cube(half, origin, direction, switches, &mut hits),
            Self::Frustum { base, top, height } => {
                let frustum = Frustum { base, height, slope: (top - base) / height };
                frustum.side(origin, direction, switches, &mut hits);
                frustum.caps(origin, direction, switches, &mut hits);
            }
            Self::Plane => {
                let is_seen = match switches.plane {
                    Some(RayFault::PlanesFromAbove) => direction.y < 0.0,
                    Some(_) => direction.y > 0.0,
                    None => true,
                };
                if is_seen {
                    hits.add(-origin.y / direction.y, DVec3::Y, 1.0);
                }
            }
        }
        hits
    }

    /// Whether a point of its frame lies inside.
    pub(super) fn contains(&self, at: DVec3) -> bool {
        match *self {
            Self::Sphere { radius } => at.length() < radius,
            Self::Cube { half } => at.abs().cmplt(half).all(),
            Self::Frustum { base, top, height } => {
                (0.0..height).contains(&at.y) && at.x.hypot(at.z) < base + (top - base) * at.y / height
            }
            Self::Plane => at.y < 0.0,
        }
    }
}

fn sphere(radius: f64, origin: DVec3, direction: DVec3, switches: &Switches, hits: &mut Hits) {
    let square = if switches.root == Some(RayFault::LostRadius) { radius } else { radius * radius };
    let c = origin.length_squared() - square;
    let length = match switches.lengths {
        Some([NormalLength::Gradient, ..]) => radius,
        Some([NormalLength::UnitRadius, ..]) => radius.recip(),
        Some([NormalLength::UnitShape, ..]) => 0.5 / radius,
        _ => 1.0,
    };
    for t in roots(direction.length_squared(), origin.dot(direction), c, switches.root) {
        hits.add(t, (origin + t * direction).normalize_or(DVec3::Y), length);
    }
}

fn cube(half: DVec3, origin: DVec3, direction: DVec3, switches: &Switches, hits: &mut Hits) {
    let inverse = direction.recip();
    let (low, high) = ((-half - origin) * inverse, (half - origin) * inverse);
    let (near, far) = (low.min(high), low.max(high));
    let (enter, leave) = (near.max_element(), far.min_element());
    // A direction along a face makes infinities of the right signs; within the face itself, it misses.
    if enter.is_nan() || leave.is_nan() || enter > leave {
        return;
    }
    for (t, each, sign) in [(enter, near, -1.0), (leave, far, 1.0)] {
        let axis = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().zip(each.to_array()).find(|(_, own)| *own == t);
        let axis = axis.map_or(DVec3::Y, |(axis, _)| axis);
        let size = axis.dot(half);
        let length = match switches.lengths {
            Some([_, NormalLength::Gradient, ..]) => size,
            Some([_, NormalLength::UnitRadius, ..]) => size.recip(),
            Some([_, NormalLength::UnitShape, ..]) => 0.5 / size,
            _ => 1.0,
        };
        hits.add(t, axis * sign * direction.dot(axis).signum(), length);
    }
}

/// A cylinder or a cone.
struct Frustum {
    base: f64,
    height: f64,
    /// How the radius changes with the height.
    slope: f64,
}

impl Frustum {
    fn radius(&self, y: f64) -> f64 {
        self.base + self.slope * y
    }

    fn is_cone(&self) -> bool {
        self.slope != 0.0
    }

    /// The heights of the other nappe: mirrored at the apex.
    fn mirrored(&self) -> [f64; 2] {
        let apex = -self.base / self.slope;
        [2.0 * apex - self.height, 2.0 * apex]
    }

    /// Whether the side is there at a height.
    fn has_side(&self, y: f64, switches: &Switches) -> bool {
        let is_own = (0.0..=self.height).contains(&y);
        let is_mirrored = || {
            let [low, high] = self.mirrored();
            (low..=high).contains(&y)
        };
        match (switches.ends, switches.nappe) {
            (Some(RayFault::NoEndsOfDoubleCones), _) => true,
            (Some(RayFault::NoEnds), _) => self.radius(y) >= 0.0,
            (_, Some(RayFault::OtherNappe)) if self.is_cone() => is_mirrored(),
            (_, Some(_)) if self.is_cone() => is_own || is_mirrored(),
            _ => is_own,
        }
    }

    fn side(&self, origin: DVec3, direction: DVec3, switches: &Switches, hits: &mut Hits) {
        let flat = |vector: DVec3| DVec3::new(vector.x, 0.0, vector.z);
        let (radius, change) = (self.radius(origin.y), self.slope * direction.y);
        let a = flat(direction).length_squared() - change * change;
        let h = flat(origin).dot(flat(direction)) - radius * change;
        let c = flat(origin).length_squared() - radius * radius;
        let steepness = (1.0 + self.slope * self.slope).sqrt();
        let is_near = switches.ends == Some(RayFault::NoCapsSeenThrough);
        for t in roots(a, h, c, switches.root).into_iter().take(if is_near { 1 } else { 2 }) {
            let at = origin + t * direction;
            if !t.is_finite() || !self.has_side(at.y, switches) {
                continue;
            }
            let radius = self.radius(at.y);
            let rise = if switches.has_level_cones { 0.0 } else { -self.slope * radius };
            let gradient = DVec3::new(at.x, rise, at.z);
            let lengths = switches.lengths;
            let own = lengths.map(|[_, _, cylinder, cone]| if self.is_cone() { cone } else { cylinder });
            let length = match own {
                Some(NormalLength::Gradient) => radius.abs() * steepness,
                Some(NormalLength::UnitRadius) => self.base.max(radius).recip(),
                Some(NormalLength::UnitShape) => 0.5 / self.base.max(radius),
                _ => 1.0,
            };
            hits.add(t, gradient.normalize_or(DVec3::Y), length);
        }
    }

    fn caps(&self, origin: DVec3, direction: DVec3, switches: &Switches, hits: &mut Hits) {
        let [has_base, has_top] = match switches.ends {
            Some(RayFault::WithoutCaps(kind)) => [(kind == BodyKind::Cones) != self.is_cone(); 2],
            Some(RayFault::NoBaseCap) => [false, true],
            Some(RayFault::NoTopCap) => [true, false],
            Some(_) => [false; 2],
            None => [true; 2],
        };
        let own = [(0.0, -1.0, has_base), (self.height, 1.0, has_top)];
        let is_turned = self.is_cone() && switches.nappe.is_some();
        let mirrored = if is_turned {
            let [top, base] = self.mirrored();
            [(top, -1.0, has_top), (base, 1.0, has_base)]
        } else {
            [(0.0, -1.0, false); 2]
        };
        let is_moved = self.is_cone() && switches.nappe == Some(RayFault::OtherNappe);
        for (y, sign, _) in own.into_iter().filter(|_| !is_moved).chain(mirrored).filter(|(_, _, has)| *has) {
            let t = (y - origin.y) / direction.y;
            let at = origin + t * direction;
            let (across, radius) = (at.x.hypot(at.z), self.radius(y).abs());
            if across <= radius && radius > 0.0 {
                let radial = DVec3::new(at.x, 0.0, at.z).normalize_or(DVec3::X);
                let normal = if switches.has_radial_caps { radial } else { sign * DVec3::Y };
                let lengths = switches.lengths;
                let own = lengths.map(|[_, _, cylinder, cone]| if self.is_cone() { cone } else { cylinder });
                let length = match own {
                    Some(NormalLength::UnitShape | NormalLength::UnitRadius) => self.height.recip(),
                    _ => 1.0,
                };
                hits.add(t, normal, length);
            }
        }
    }
}
