//! Cones, of which programs give different numbers.

use catoptric_scene::{Anchor, BodyShape, Placement, Shape};
use glam::DVec3;

use crate::draft::{Draft, FAR};
use crate::minirt::arguments::Arguments;
use crate::minirt::read::MiniRtReader;
use crate::phrase::Argument;

/// What other programs call `co`.
pub(super) const CONES: [&str; 4] = ["co", "cn", "con", "cone"];

/// The degrees that half the angle at an apex may have.
const HALF_ANGLE: [f64; 2] = [0.001, 89.999];

/// The size of a cone, meters.
struct ConeSize {
    radius: f64,
    height: f64,
    is_endless: bool,
}

impl ConeSize {
    /// Reads the numbers of a cone; one alone is half the angle at the apex of a cone without end.
    fn read(arguments: &mut Arguments<'_>, draft: &mut Draft) -> Option<Self> {
        let numbers = draft.options.dialect.cone_numbers();
        let half_angle = |arguments: &mut Arguments<'_>, draft: &mut Draft| {
            Some(arguments.number(Argument::HalfAngle, HALF_ANGLE, draft)?.value.to_radians())
        };
        let size = |argument, arguments: &mut Arguments<'_>, draft: &mut Draft| {
            Some(arguments.size(argument, draft)?.value)
        };
        if arguments.numbers_left().len() == 1 {
            let (sine, cosine) = half_angle(arguments, draft)?.sin_cos();
            return Some(Self { radius: FAR * sine, height: FAR * cosine, is_endless: true });
        }
        // All numbers are read, for their errors.
        let first = numbers.is_height_first.then(|| size(Argument::Height, arguments, draft));
        let width = if numbers.has_angle {
            half_angle(arguments, draft)
        } else {
            let diameter = size(Argument::Diameter, arguments, draft);
            diameter.map(|diameter| draft.options.dialect.radius(diameter))
        };
        let height = first.unwrap_or_else(|| size(Argument::Height, arguments, draft))?;
        let radius = if numbers.has_angle { width?.tan() * height } else { width? };
        Some(Self { radius, height, is_endless: false })
    }
}

impl MiniRtReader {
    /// Reads a cone.
    pub(super) fn cone(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let position = arguments.point(Argument::Position, draft);
        let axis = arguments.direction(Argument::Axis, draft);
        let size = ConeSize::read(arguments, draft);
        let is_endless = size.as_ref().is_some_and(|size| size.is_endless);
        let color = arguments.color(draft);
        let is_at_base = draft.options.dialect.is_cone_at_base && !is_endless;
        let geometry = position.zip(axis).zip(size).map(|((position, axis), size)| {
            let ConeSize { radius, height, .. } = size;
            let (here, there) = (position.value, position.value + height * axis.value);
            let (base, top) = if is_at_base { (here, there) } else { (there, here) };
            let shape = Shape::Cone { radius, top_radius: 0.0, height };
            (BodyShape::Plain(shape), about(base, top))
        });
        if geometry.is_some() {
            let place = if is_endless { &mut self.places.endless_cone } else { &mut self.places.cone };
            place.get_or_insert(arguments.span.clone());
        }
        let other_half = geometry.as_ref().filter(|_| is_endless).map(|(_, placement)| opposite(placement));
        self.open_body(geometry, other_half, color, arguments);
    }
}

fn about(base: DVec3, top: DVec3) -> Placement {
    Placement { anchor: Anchor::Axis { base, top }, scale: DVec3::ONE }
}

/// The placement of the other half of a double cone.
fn opposite(placement: &Placement) -> Placement {
    match placement.anchor {
        Anchor::Axis { base, top } => about(2.0 * top - base, top),
        Anchor::Frame { .. } => *placement,
    }
}
