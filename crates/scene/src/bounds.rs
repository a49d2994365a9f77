//! Bounding boxes and spheres of bodies.

use glam::DVec3;

use crate::body::Body;
use crate::compound::Form;
use crate::shape::Shape;

/// A box along the world's axes, meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The box of a single point.
    pub const fn at(point: DVec3) -> Self {
        Self { min: point, max: point }
    }

    /// The smallest box that contains both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The middle.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// The three edge lengths.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// Whether the boxes have more than their surfaces in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmplt(other.max).all() && other.min.cmplt(self.max).all()
    }
}

/// A sphere that encloses something, meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// The center.
    pub center: DVec3,
    /// The radius.
    pub radius: f64,
}

/// How far a body reaches along a direction d: the largest d·p of its points p (its support function, times the length
/// of d). `None` for what has no end.
fn reach(body: &Body, direction: DVec3) -> Option<f64> {
    reach_of(&body.form(), direction)
}

/// How far a body or a part reaches along a direction d of the frame around it: the largest d·p of its points p, or for an
/// intersection or a difference a number that is no smaller. `None` for what has no end.
///
/// With the placement p = M·q + o it is d·o plus the support of its own frame along Mᵀ·d.
fn reach_of(form: &Form<'_>, direction: DVec3) -> Option<f64> {
    let frame = form.placement.world_from_body();
    let local = frame.matrix3.transpose() * direction;
    let mut parts = form.parts.iter().map(|part| reach_of(&part.form(), local));
    let own = match form.shape {
        Shape::Union | Shape::Group => {
            parts.try_fold(f64::NEG_INFINITY, |most, part| Some(most.max(part?)))?
        }
        Shape::Intersection | Shape::Surface { .. } => parts.flatten().reduce(f64::min)?,
        Shape::Difference => parts.next()??,
        _ => form.sized_shape().support(local)?,
    };
    // Parts of a lens or a tube may reach past what they are cut by.
    let own = form.parametric().map_or(own, |shape| {
        let [min, max] = shape.extent();
        own.min((min * local).max(max * local).element_sum())
    });
    Some(direction.dot(frame.translation) + own)
}

/// The smallest box around a body; a box around an intersection or a difference. `None` for what has no end.
pub fn of_body(body: &Body) -> Option<Bounds> {
    let max = |axis| reach(body, axis);
    let min = |axis: DVec3| reach(body, -axis).map(|reach| -reach);
    let bounds = Bounds {
        min: DVec3::new(min(DVec3::X)?, min(DVec3::Y)?, min(DVec3::Z)?),
        max: DVec3::new(max(DVec3::X)?, max(DVec3::Y)?, max(DVec3::Z)?),
    };
    // What holds nothing is where it is put.
    let is_empty = !bounds.min.cmple(bounds.max).all();
    Some(if is_empty { Bounds::at(body.placement.origin()) } else { bounds })
}

/// Whether a plane parts two bodies: they have nothing but their surfaces in common then. Tried are planes across the
/// axes of both, the products of these and the line between the middles, as for boxes (Gottschalk et al. 1996, OBBTree,
/// sec. 5); two bodies may be apart and not be found to be. Planes are apart from nothing.
pub fn are_apart(one: &Body, other: &Body) -> bool {
    /// Bodies that stand on each other overlap by rounding: this part of their sizes does not count.
    const CONTACT: f64 = 1e-9;
    let axes = |body: &Body| {
        let rotation = body.placement.rotation();
        [rotation.x_axis, rotation.y_axis, rotation.z_axis]
    };
    let (own, others) = (axes(one), axes(other));
    let crosses = own.into_iter().flat_map(|a| others.map(|b| a.cross(b)));
    let middle = |body: &Body| ball_of_body(body).map(|ball| ball.center);
    let between = middle(one).zip(middle(other)).map(|(from, to)| to - from);
    // The line between the middles parts most.
    let directions = between.into_iter().chain(own).chain(others).chain(crosses);
    let mut directions = directions.filter_map(DVec3::try_normalize).flat_map(|d| [d, -d]);
    directions.any(|direction| {
        let ends = [(one, direction), (other, -direction), (one, -direction), (other, direction)];
        let [Some(front), Some(facing), Some(back), Some(rear)] = ends.map(|(body, d)| reach(body, d)) else {
            return false;
        };
        let gap = -facing - front;
        gap >= -CONTACT * (front + back).min(facing + rear)
    })
}

/// A ball around a body, the smallest one where a round body's cross section is a circle; `None` for what has no end.
pub fn ball_of_body(body: &Body) -> Option<BoundingSphere> {
    if body.shape.is_compound() {
        let corners = body.box_corners()?;
        let center = body.middle();
        let radius = corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
        return Some(BoundingSphere { center, radius });
    }
    let (center, radius) = body.sized_shape().ball(body.placement.scale)?;
    Some(BoundingSphere { center: body.placement.world_from_body().transform_point3(center), radius })
}

/// A ball around bodies; `None` when there are none but those without end.
pub fn ball_around<'b>(bodies: impl Iterator<Item = &'b Body> + Clone) -> Option<BoundingSphere> {
    let bounds = bodies.clone().filter_map(of_body).reduce(Bounds::union)?;
    Some(around(bounds, bodies.filter_map(ball_of_body)))
}

/// A ball about the middle of `bounds` that holds all of `balls`, and is no larger than that of the whole box.
pub fn around(bounds: Bounds, balls: impl Iterator<Item = BoundingSphere>) -> BoundingSphere {
    let center = bounds.center();
    let radius = balls.map(|ball| ball.center.distance(center) + ball.radius).fold(0.0, f64::max);
    BoundingSphere { center, radius: radius.min(0.5 * bounds.size().length()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Anchor, Placement, ShapeKind};

    fn body(shape: Shape, position: DVec3, rotation_degrees: DVec3, scale: DVec3) -> Body {
        let anchor = Anchor::Frame { position, rotation_degrees };
        Body { shape, placement: Placement { anchor, scale }, ..Body::default() }
    }

    fn assert_close(bounds: Bounds, min: [f64; 3], max: [f64; 3]) {
        let off =
            (bounds.min - DVec3::from_array(min)).length() + (bounds.max - DVec3::from_array(max)).length();
        assert!(off < 1e-12, "{bounds:?} is not {min:?} … {max:?}");
    }

    #[test]
    fn boxes_are_exact() {
        let (root, half) = (2f64.sqrt(), 0.5f64.sqrt());
        let at = DVec3::new(1.0, 2.0, 3.0);
        let turn = DVec3::Z * 45.0;
        let sphere = body(Shape::SPHERE, at, turn, DVec3::ONE);
        assert_close(of_body(&sphere).unwrap(), [0.0, 1.0, 2.0], [2.0, 3.0, 4.0]);
        // The ellipse x²/9 + y² = 1 turned by 45° reaches √((9 + 1)/2).
        let egg = body(Shape::SPHERE, DVec3::ZERO, turn, DVec3::new(3.0, 1.0, 2.0));
        assert_close(
            of_body(&egg).unwrap(),
            [-(5f64.sqrt()), -(5f64.sqrt()), -2.0],
            [5f64.sqrt(), 5f64.sqrt(), 2.0],
        );
        let cube = body(Shape::Cube { size: DVec3::new(2.0, 2.0, 1.0) }, at, turn, DVec3::ONE);
        assert_close(of_body(&cube).unwrap(), [1.0 - root, 2.0 - root, 2.5], [1.0 + root, 2.0 + root, 3.5]);
        // A rod of height 2 that leans towards −X; its discs reach r·cos 45° to either side.
        let rod = body(Shape::Cylinder { radius: 0.5, height: 2.0 }, DVec3::ZERO, turn, DVec3::ONE);
        let lean = 0.5 * half;
        assert_close(of_body(&rod).unwrap(), [-root - lean, -lean, -0.5], [lean, root + lean, 0.5]);
        let cone =
            body(Shape::Cone { radius: 0.5, top_radius: 0.0, height: 2.0 }, DVec3::ZERO, turn, DVec3::ONE);
        assert_close(of_body(&cone).unwrap(), [-root, -lean, -0.5], [lean, root, 0.5]);
        let funnel = Shape::Cone { radius: 0.5, top_radius: 2.0, height: 1.0 };
        let funnel = body(funnel, at, DVec3::X * 180.0, DVec3::new(1.0, 3.0, 1.0));
        assert_close(of_body(&funnel).unwrap(), [-1.0, -1.0, 1.0], [3.0, 2.0, 5.0]);
        let anchor = Anchor::Axis { base: DVec3::X, top: DVec3::X * 4.0 };
        let mut lying = body(Shape::CYLINDER, DVec3::ZERO, DVec3::ZERO, DVec3::ONE);
        lying.placement.anchor = anchor;
        assert_close(of_body(&lying).unwrap(), [1.0, -0.5, -0.5], [4.0, 0.5, 0.5]);
        assert_eq!(of_body(&body(Shape::Plane, at, turn, DVec3::ONE)), None);
    }

    #[test]
    fn balls_hold_the_body_and_are_tight() {
        let ball =
            |shape, scale| ball_of_body(&body(shape, DVec3::X, DVec3::new(30.0, 40.0, 50.0), scale)).unwrap();
        assert_eq!(
            ball(Shape::SPHERE, DVec3::new(1.0, 3.0, 2.0)),
            BoundingSphere { center: DVec3::X, radius: 3.0 }
        );
        assert_eq!(ball(Shape::Cube { size: DVec3::new(2.0, 3.0, 6.0) }, DVec3::ONE).radius, 3.5);
        assert_eq!(ball(Shape::Cylinder { radius: 3.0, height: 8.0 }, DVec3::ONE).radius, 5.0);
        // A cone of a base of 3 and height 9: the ball through apex and rim, r = (9² + 3²)/(2·9).
        let cone = ball(Shape::Cone { radius: 3.0, top_radius: 0.0, height: 9.0 }, DVec3::ONE);
        assert!((cone.radius - 5.0).abs() < 1e-12);
        assert!((cone.center.distance(DVec3::X) - 4.0).abs() < 1e-12);
        // A flat one lies within the ball of its base.
        let flat = ball(Shape::Cone { radius: 3.0, top_radius: 1.0, height: 1.0 }, DVec3::ONE);
        assert_eq!(flat, BoundingSphere { center: DVec3::X, radius: 3.0 });
        let funnel =
            ball(Shape::Cone { radius: 1.0, top_radius: 3.0, height: 1.0 }, DVec3::new(1.0, 0.5, 1.0));
        assert_eq!(funnel.radius, 3.0);
        assert!((funnel.center.distance(DVec3::X) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn bodies_that_touch_are_apart_and_those_that_overlap_are_not() {
        let at =
            |shape, position: [f64; 3], turn: [f64; 3]| body(shape, position.into(), turn.into(), DVec3::ONE);
        let ball = at(Shape::SPHERE, [0.0; 3], [0.0; 3]);
        let wall = |x| at(Shape::Cube { size: DVec3::new(0.2, 20.0, 20.0) }, [x, x, 0.0], [0.0, 0.0, 45.0]);
        let near = (1.1) / 2f64.sqrt();
        assert!(are_apart(&ball, &wall(near)) && are_apart(&wall(near), &ball));
        assert!(!are_apart(&ball, &wall(near - 1e-3)));
        // Along the diagonal, where the boxes of both overlap.
        let step = (4.0f64 / 3.0).sqrt();
        assert!(are_apart(&ball, &at(Shape::SPHERE, [step; 3], [10.0, 20.0, 30.0])));
        assert!(!are_apart(&ball, &at(Shape::SPHERE, [0.99 * step; 3], [0.0; 3])));
        let rod = |y| at(Shape::CYLINDER, [0.0, y, 0.0], [0.0; 3]);
        assert!(are_apart(&rod(0.0), &rod(1.0)) && !are_apart(&rod(0.0), &rod(0.99)));
        assert!(!are_apart(&ball, &at(Shape::Plane, [0.0, -9.0, 0.0], [0.0; 3])));
    }

    #[test]
    fn every_ball_holds_its_body() {
        for shape in
            ShapeKind::SIMPLE.map(ShapeKind::shape).into_iter().filter(|shape| *shape != Shape::Plane)
        {
            for scale in [DVec3::ONE, DVec3::new(2.0, 0.3, 1.0), DVec3::new(0.2, 5.0, 0.4)] {
                let body = body(shape, DVec3::Y, DVec3::new(10.0, 20.0, 30.0), scale);
                let ball = ball_of_body(&body).unwrap();
                for step in 0..200 {
                    let (turn, tilt) = (f64::from(step), f64::from(step) / 200.0 * std::f64::consts::PI);
                    let direction = DVec3::new(tilt.sin() * turn.cos(), tilt.cos(), tilt.sin() * turn.sin());
                    let room = direction.dot(ball.center) + ball.radius - reach(&body, direction).unwrap();
                    assert!(room > -1e-12, "{shape:?} {scale} {direction}");
                }
            }
        }
    }
}
