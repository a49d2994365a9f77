//! Lenses with two spherical or flat faces.

use glam::DVec3;

use super::{BrokenSize, Expansion, MARGIN, Parametric, SizeFault, cylinder, part, round_extent};
use crate::compound::BodyPart;
use crate::shape::Shape;

/// A lens about the origin; its axis is Y, its front at −Y and its back at +Y.
///
/// ```toml
/// [[bodies]]
/// shape = "lens"
/// material = "glass"
/// radius = 0.5
/// thickness = 0.2
/// focal_length = 2.0
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Of the rim: half the diameter. Default 0.5.
    pub radius: f64,
    /// Between the faces, on the axis. Default 0.3.
    pub thickness: f64,
    /// The faces. Default a front of 1 and a back of −1.
    pub curvature: LensCurvature,
}

/// What says the radii of curvature of a lens. A radius is above 0 if the center of its ball lies behind the face, towards
/// +Y, and 0 if the face is flat: the front of a biconvex lens has one above 0, its back one below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LensCurvature {
    /// The radii of both faces.
    Radii {
        /// Of the face at −Y.
        front: f64,
        /// Of the face at +Y.
        back: f64,
    },
    /// The focal length of the lens in air.
    FocalLength {
        /// Below 0 for a lens that spreads light.
        focal_length: f64,
        /// The index of refraction that it holds for. Default 1.5.
        ior: f64,
        /// Radius of the front; `None`, the default, is the opposite of the back's.
        front: Option<f64>,
    },
}

impl Default for Lens {
    fn default() -> Self {
        Self { radius: 0.5, thickness: 0.3, curvature: LensCurvature::Radii { front: 1.0, back: -1.0 } }
    }
}

/// The curvature of a face: the inverse of its radius, 0 if it is flat.
fn curvature(radius: f64) -> f64 {
    if radius == 0.0 { 0.0 } else { radius.recip() }
}

/// A face, seen from the outside.
#[derive(Clone, Copy)]
struct Face {
    /// Of its radius and of messages about it.
    key: &'static str,
    /// Above 0 if it bulges.
    bulge: f64,
    /// −1 for the front, 1 for the back.
    side: f64,
}

impl Face {
    /// How far the rim lies behind the vertex, or before it where the face is hollow; R − √(R² − r²) without
    /// cancellation. NaN if the ball is smaller than the rim.
    fn sag(&self, rim: f64) -> f64 {
        if self.bulge == 0.0 {
            return 0.0;
        }
        let depth = (self.bulge * self.bulge - rim * rim).sqrt();
        rim * rim / (self.bulge.abs() + depth) * self.bulge.signum()
    }
}

impl Lens {
    /// The index of refraction that a focal length holds for unless another is given.
    pub const DEFAULT_IOR: f64 = 1.5;

    /// The radii of curvature of front and back, 0 where a face is flat. `None` if no lens of this thickness and index has
    /// the focal length.
    ///
    /// The lensmaker's equation (Hecht, Optics, 5th ed., eq. 6.2): 1/f = (n − 1) (1/R₁ − 1/R₂ + (n − 1) d / (n R₁ R₂)).
    /// For R₁ = R = −R₂ it is R² − 2 (n − 1) f R + (n − 1)² f d / n = 0, whose larger root becomes the thin lens.
    pub fn radii(&self) -> Option<(f64, f64)> {
        let (focal_length, ior, front) = match self.curvature {
            LensCurvature::Radii { front, back } => return Some((front, back)),
            LensCurvature::FocalLength { focal_length, ior, front } => (focal_length, ior, front),
        };
        let bending = ior - 1.0;
        let (front, back) = match front {
            None => {
                let radius =
                    bending * focal_length * (1.0 + (1.0 - self.thickness / (ior * focal_length)).sqrt());
                (radius, -radius)
            }
            Some(front) => {
                let thick = 1.0 - bending * self.thickness * curvature(front) / ior;
                let back = (curvature(front) - (bending * focal_length).recip()) / thick;
                (front, curvature(back))
            }
        };
        // What is larger is no size of a part.
        let is_face = |radius: f64| radius.abs() <= 1e9;
        (bending != 0.0 && focal_length != 0.0 && is_face(front) && is_face(back)).then_some((front, back))
    }

    /// The focal length in air of a lens of this index of refraction, meters; infinite if it does not bend light.
    pub fn focal_length(&self, ior: f64) -> f64 {
        let (front, back) = self.radii().unwrap_or_default();
        let (front, back) = (curvature(front), curvature(back));
        let bending = ior - 1.0;
        (bending * (front - back + bending * self.thickness * front * back / ior)).recip()
    }

    fn faces(&self) -> [Face; 2] {
        let (front, back) = self.radii().unwrap_or_default();
        [
            Face { key: "front_radius", bulge: front, side: -1.0 },
            Face { key: "back_radius", bulge: -back, side: 1.0 },
        ]
    }

    /// The key that a rule about a face is reported at.
    fn key_of(&self, face: &Face) -> &'static str {
        match self.curvature {
            LensCurvature::FocalLength { front: Some(_), .. } if face.side < 0.0 => face.key,
            LensCurvature::FocalLength { .. } => "focal_length",
            LensCurvature::Radii { .. } => face.key,
        }
    }

    fn broken_focal_length(&self) -> Option<BrokenSize> {
        let LensCurvature::FocalLength { ior, .. } = self.curvature else { return None };
        if ior == 1.0 {
            return Some(SizeFault::NoRefraction.at("ior"));
        }
        let fault = || {
            let at_least = self.thickness / ior;
            SizeFault::NoSuchLens { at_least }.at("focal_length")
        };
        self.radii().is_none().then(fault)
    }

    /// Heights of the rim's ends on the front and on the back.
    fn rim(&self) -> [f64; 2] {
        let [front, back] = self.faces().map(|face| face.sag(self.radius));
        [front - 0.5 * self.thickness, 0.5 * self.thickness - back]
    }
}

impl Parametric for Lens {
    fn number(&self, key: &str) -> Option<f64> {
        match (key, self.curvature) {
            ("radius", _) => Some(self.radius),
            ("thickness", _) => Some(self.thickness),
            ("front_radius", LensCurvature::Radii { front, .. }) => Some(front),
            ("front_radius", LensCurvature::FocalLength { front, .. }) => front,
            ("back_radius", LensCurvature::Radii { back, .. }) => Some(back),
            ("focal_length", LensCurvature::FocalLength { focal_length, .. }) => Some(focal_length),
            ("ior", LensCurvature::FocalLength { ior, .. }) => Some(ior),
            _ => None,
        }
    }

    /// A lens that bends no light has no focal length.
    fn derived_number(&self, key: &str) -> Option<f64> {
        match key {
            "front_radius" => self.radii().map(|radii| radii.0),
            "back_radius" => self.radii().map(|radii| radii.1),
            "focal_length" => Some(self.focal_length(Self::DEFAULT_IOR)).filter(|length| length.abs() < 1e9),
            _ => None,
        }
    }

    /// A radius of the back takes the place of a focal length, and the other way round; what the lens was stays as far as
    /// it can.
    fn set_number(&mut self, key: &str, value: f64) {
        let radii = self.radii().unwrap_or_default();
        match (key, &mut self.curvature) {
            ("radius", _) => self.radius = value,
            ("thickness", _) => self.thickness = value,
            ("front_radius", LensCurvature::Radii { front, .. }) => *front = value,
            ("front_radius", LensCurvature::FocalLength { front, .. }) => *front = Some(value),
            ("back_radius", LensCurvature::Radii { back, .. }) => *back = value,
            ("back_radius", curvature) => *curvature = LensCurvature::Radii { front: radii.0, back: value },
            ("focal_length", LensCurvature::FocalLength { focal_length, .. }) => *focal_length = value,
            ("focal_length", curvature) => {
                let front = (radii.0 != -radii.1).then_some(radii.0);
                let ior = Self::DEFAULT_IOR;
                *curvature = LensCurvature::FocalLength { focal_length: value, ior, front };
            }
            ("ior", LensCurvature::FocalLength { ior, .. }) => *ior = value,
            _ => {}
        }
    }

    fn broken_size(&self) -> Option<BrokenSize> {
        if let Some(broken) = self.broken_focal_length() {
            return Some(broken);
        }
        let (faces, rim, thickness) = (self.faces(), self.radius, self.thickness);
        let is_narrow = |face: &&Face| face.bulge != 0.0 && face.bulge.abs() <= rim;
        if let Some(face) = faces.iter().find(is_narrow) {
            let fault = SizeFault::FaceTooNarrow { radius: face.bulge.abs() };
            return Some(fault.at(self.key_of(face)));
        }
        let sags = faces.map(|face| face.sag(rim));
        let least = sags[0] + sags[1];
        if thickness <= least {
            return Some(SizeFault::LensTooThin { least }.at("thickness"));
        }
        // A bulging face is a part of a ball, whose far side must lie beyond the other face, from axis to rim.
        let beyond = |[face, sag, other]: [f64; 3]| {
            if face > 0.0 { (2.0 * face).min(2.0 * face - sag + other) } else { f64::INFINITY }
        };
        let most = beyond([faces[0].bulge, sags[0], sags[1]]).min(beyond([faces[1].bulge, sags[1], sags[0]]));
        let too_thick = SizeFault::LensTooThick { most };
        (thickness >= most).then(|| too_thick.at("thickness"))
    }

    fn extent(&self) -> [DVec3; 2] {
        let [front, back] = self.rim();
        let half = 0.5 * self.thickness;
        round_extent(self.radius, front.min(-half), back.max(half))
    }

    /// A cylinder within the balls of bulging faces, without those of hollow ones. Where a face is not flat, it reaches
    /// past that face, but not past the middle of a ball that ends it.
    fn expansion(&self) -> Expansion {
        let [bottom, top] = self.rim();
        let half = 0.5 * self.thickness;
        let end = |face: Face, rim: f64| {
            let room = (face.bulge * face.bulge - self.radius * self.radius).max(0.0).sqrt();
            let past = MARGIN * (self.radius + self.thickness);
            match face.bulge {
                0.0 => half,
                bulge if bulge > 0.0 => half + past,
                _ => face.side * rim + past.min(0.5 * room),
            }
        };
        let faces = self.faces();
        let body = cylinder(self.radius, -end(faces[0], bottom), end(faces[1], top));
        let ball = |face: &Face| -> BodyPart {
            part(Shape::Sphere { radius: face.bulge.abs() }, face.side * (half - face.bulge))
        };
        let within = faces.iter().filter(|face| face.bulge > 0.0).map(ball);
        let mut without = faces.iter().filter(|face| face.bulge < 0.0).map(ball).peekable();
        let inner = Expansion::intersection([body.clone()].into_iter().chain(within).collect());
        match (without.peek().is_some(), inner.parts.len()) {
            (false, _) => inner,
            (true, 1) => Expansion::difference(body, without),
            (true, _) => Expansion::difference(inner.into_part(), without),
        }
    }
}
