//! What a canonical shape is asked for besides where rays meet it: nothing here is in the innermost loops.

use std::f64::consts::TAU;

use glam::{DAffine3, DMat3, DVec2, DVec3};

/// The answers of a canonical shape. A `ratio` is its [`cone_ratio`](crate::shape::CanonicalShape::cone_ratio).
pub(crate) trait Solid {
    /// The least and the greatest coordinates of the shape that `frame` carries to the world; `None` for a plane.
    ///
    /// With m_i the rows of the transform's linear part, an ellipsoid reaches |m_i| from its center along axis i, a box
    /// the sum of |m_ij|, and a disc across the frame's Y axis √(m_ix² + m_iz²) from its own center.
    fn bounds(&self, frame: &DAffine3, ratio: f64) -> Option<[DVec3; 2]>;

    /// The smallest sphere around the shape that `linear` carries to the world: its center from the frame's origin, and
    /// its radius; that of a plane is infinite. The axes of the frame are perpendicular in the world.
    fn bounding_sphere(&self, linear: &DMat3, ratio: f64) -> (DVec3, f64);

    /// Points in the world and a radius: the shape that `frame` carries there lies no further than the radius from the
    /// convex hull of the points. `None` for a plane.
    fn hull(&self, frame: &DAffine3, ratio: f64) -> Option<(Vec<DVec3>, f64)>;

    /// The volume in its own frame; infinite for a plane.
    fn volume(&self, ratio: f64) -> f64;

    /// The middle in its own frame; `None` for a plane.
    fn middle(&self) -> Option<DVec3>;

    /// How many times as long as thick the shape is, by the axes that its curved surface depends on; `axes` are their
    /// lengths in the world.
    fn flatness(&self, axes: DVec3) -> f64;

    /// About how far a point is from the surface, meters. `at` is the point in meters along the axes of the frame, and
    /// `axes` are the lengths of these.
    fn distance(&self, ratio: f64, axes: DVec3, at: DVec3) -> f64;

    /// Where a point of the surface lies in a picture on it.
    fn picture_place(&self, ratio: f32, point: [f32; 3]) -> PicturePlace;

    /// The curves that make the surface when they turn about the Y axis, a quarter of a circle or a straight part in
    /// `fineness` parts. `None` for what is no solid of revolution, and for a plane.
    fn profile(&self, ratio: f64, fineness: u32) -> Option<Vec<Vec<RevolutionRing>>>;
}

/// A place in a picture, the upper left corner being 0, 0, the lower right one 1, 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PicturePlace {
    pub(crate) u: f32,
    pub(crate) v: f32,
    /// Whether the picture goes on from its other edge beside it, and above and below it.
    pub(crate) repeats: [bool; 2],
}

impl PicturePlace {
    /// In a square as wide as 2, seen from its front.
    pub(crate) fn flat(right: f32, down: f32) -> Self {
        Self { u: 0.5 + 0.5 * right, v: 0.5 + 0.5 * down, repeats: [false, false] }
    }

    /// In a picture wrapped around the Y axis, its middle where z is largest.
    pub(crate) fn around([x, _, z]: [f32; 3], v: f32) -> Self {
        Self { u: 0.5 + x.atan2(z) / std::f32::consts::TAU, v, repeats: [true, false] }
    }
}

/// Points of a cap may be this far from its level by rounding.
pub(crate) const CAP_LEVEL: f32 = 1e-6;

/// A circle about the Y axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RevolutionRing {
    pub(crate) y: f64,
    /// 0: the circle is a point.
    pub(crate) radius: f64,
    /// The normal's components away from the axis and along it.
    pub(crate) normal: DVec2,
}

impl RevolutionRing {
    /// The rings of a disc, from its middle to its edge.
    pub(crate) fn disc(y: f64, radius: f64, normal: f64, fineness: u32) -> Vec<Self> {
        let ring = |part: f64| Self { y, radius: radius * part, normal: DVec2::new(0.0, normal) };
        steps(fineness).map(ring).collect()
    }
}

/// From 0 to 1 in so many steps, the ends exactly.
pub(crate) fn steps(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |step| f64::from(step) / f64::from(count))
}

/// The box around two discs of these radii across the frame's Y axis, at y = 0 and y = 1.
pub(crate) fn bounds_of_discs(frame: &DAffine3, [low, high]: [f64; 2]) -> [DVec3; 2] {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = frame.matrix3;
    let disc = (x * x + z * z).map(f64::sqrt);
    let (low_center, high_center) = (frame.translation, frame.translation + y);
    let (low_disc, high_disc) = (low * disc, high * disc);
    [
        (low_center - low_disc).min(high_center - high_disc),
        (low_center + low_disc).max(high_center + high_disc),
    ]
}

/// Corners of polygons around discs about the frame's Y axis, given by their y and radius, in the world.
pub(crate) fn hull_of_discs(frame: &DAffine3, discs: &[(f64, f64)]) -> Vec<DVec3> {
    /// A disc lies in a regular polygon of so many corners around it.
    const CORNERS: u32 = 12;
    let around = 1.0 / (0.5 * TAU / f64::from(CORNERS)).cos();
    let mut points = Vec::new();
    for &(y, radius) in discs {
        let corners = if radius == 0.0 { 1 } else { CORNERS };
        points.extend((0..corners).map(|corner| {
            let (sin, cos) = (TAU / f64::from(CORNERS) * f64::from(corner)).sin_cos();
            let [x, z] = [cos, sin].map(|at| radius * around * at);
            frame.transform_point3(DVec3::new(x, y, z))
        }));
    }
    points
}

/// Whether the axes of a frame are not perpendicular, but for the rounding of single precision: those of a part may be so
/// that is turned within what is stretched.
pub(crate) fn is_oblique(linear: &DMat3) -> bool {
    /// A few roundings; a body reaches no further for them than by its own bound of rounding.
    const ROUNDING: f64 = 1e-6;
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *linear;
    let is_square = |a: DVec3, b: DVec3| a.dot(b).abs() <= ROUNDING * a.length() * b.length();
    !(is_square(x, y) && is_square(y, z) && is_square(z, x))
}

/// About how far a point is outside of an ellipsoid about the origin, negative inside (I. Quilez 2008, distance to an
/// ellipsoid).
pub(crate) fn to_ellipsoid(at: DVec3, radii: DVec3) -> f64 {
    let level = (at / radii).length();
    let slope = (at / (radii * radii)).length();
    if slope > 0.0 { level * (level - 1.0) / slope } else { -radii.min_element() }
}

/// How far a point is outside of a box, negative inside, from how far it is beyond each pair of faces.
pub(crate) fn to_box(beyond: DVec3) -> f64 {
    beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)
}

/// About how far a point is from the surface of a layer of the height `axes.y` above the origin, cut by an elliptic
/// cylinder whose radii, at the point's height, are `share` of the axes x and z.
pub(crate) fn to_layer_of_cylinder(axes: DVec3, share: f64, at: DVec3) -> f64 {
    let radii = axes * share;
    let flat = DVec3::new(at.x, 0.0, at.z);
    let beside = if radii.x.min(radii.z) > 0.0 { to_ellipsoid(flat, radii) } else { flat.length() };
    to_box(DVec3::new(beside, (at.y - 0.5 * axes.y).abs() - 0.5 * axes.y, f64::NEG_INFINITY)).abs()
}
