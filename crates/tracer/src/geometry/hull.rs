//! What surely contains a body, for exact questions about a handful of them.

use glam::{DAffine3, DVec3};

use crate::geometry::shape::ShapeKind;

/// All points no further than a radius from the convex hull of some others.
#[derive(Clone, Debug)]
pub(crate) struct BoundingHull {
    pub(crate) points: Vec<DVec3>,
    pub(crate) radius: f64,
}

impl BoundingHull {
    /// Around the canonical shape that `transform` carries to the world; `None` for a plane.
    pub(crate) fn of_canonical(transform: &DAffine3, kind: ShapeKind, ratio: f64) -> Option<Self> {
        let (points, radius) = kind.solid().hull(transform, ratio)?;
        Some(Self { points, radius })
    }

    /// How far it reaches down along a direction of length 1: the least product of it with one of the points.
    pub(crate) fn lowest(&self, up: DVec3) -> f64 {
        self.points.iter().map(|&point| up.dot(point)).fold(f64::INFINITY, f64::min) - self.radius
    }

    fn middle(&self) -> DVec3 {
        self.points.iter().sum::<DVec3>() / self.points.len() as f64
    }

    /// The largest coordinate.
    pub(crate) fn extent(&self) -> f64 {
        self.points.iter().map(|point| point.abs().max_element()).fold(0.0, f64::max) + self.radius
    }

    /// A narrow cone of directions in which it is seen from a point that lies apart from it by more than `margin`: its
    /// axis of length 1, and the cosine of the angle between the axis and the cone. `None` where it may lie in any
    /// direction.
    pub(crate) fn cone_from(&self, point: DVec3, margin: f64) -> Option<(DVec3, f64)> {
        let radius = self.radius + margin;
        // The cosine of the angle up to a ball around one of the points is that of a sum of two angles.
        let widest = |axis: DVec3| {
            let cosines = self.points.iter().map(|&at| {
                let offset = at - point;
                let distance = offset.length();
                let (cos, sin_ball) = (axis.dot(offset) / distance, radius / distance);
                let [sin, cos_ball] = [cos, sin_ball].map(|part| (1.0 - part * part).max(0.0).sqrt());
                let is_apart = sin_ball < 1.0;
                (if is_apart { cos * cos_ball - sin * sin_ball } else { -1.0 }, offset / distance)
            });
            cosines.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        /// A wider cone spares nothing.
        const LEAST_COSINE: f64 = 0.02;
        let mut axis = (self.middle() - point).try_normalize()?;
        let mut best = (axis, -1.0);
        // Steps to the farthest direction, ever shorter: Bădoiu and Clarkson 2003, Smaller core-sets for balls.
        for step in 2..10 {
            let (cos, farthest) = widest(axis)?;
            if cos > best.1 {
                best = (axis, cos);
            }
            axis = (axis + (farthest - axis) / f64::from(step)).try_normalize()?;
        }
        (best.1 > LEAST_COSINE).then_some(best)
    }
}
