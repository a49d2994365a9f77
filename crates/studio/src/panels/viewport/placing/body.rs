//! The place of a new body.

use std::f64::consts::TAU;

use catoptric_editor::{NewBodyPlacement, bounds};
use catoptric_live::Live;
use catoptric_scene::{Body, Scene, Shape, ShapeKind};
use glam::{DVec2, DVec3};

use super::{FARTHEST, PlacementView};
use crate::panels::viewport::Viewport;
use crate::panels::viewport::gizmo::steps::{decimal_below, rounded};
use crate::state::view::ViewState;

/// How many places of the picture are tried, from its middle outwards.
const PLACES: u32 = 240;

/// How many bodies are looked at for all places of one size: with a million, there is time for one place.
const MOST_TESTS: u32 = 500_000;

/// New bodies of default size take between these parts of the picture's height; other sizes are chosen if they would
/// not.
const FITTING: [f64; 2] = [0.08, 0.45];

/// The part of the picture's height that bodies of a chosen size take.
const CHOSEN: f64 = 0.2;

/// Sizes that are tried, as parts of the fitting one.
const SHARES: [f64; 3] = [1.0, 0.5, 0.2];

/// Depths at which bodies float where there is no room to stand, as parts of the subject's.
const DEPTHS: [f64; 5] = [1.0, 0.7, 0.5, 0.3, 0.15];

/// The cosine of the steepest surface to stand on: 1°.
const LEVEL: f64 = 0.9998;

/// The surface that a new body stands on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum SupportSurface {
    /// Without an end: a plane, or the ground y = 0.
    Endless,
    /// The level top of a body.
    Top(usize),
    /// Nothing: the body floats.
    Nothing,
}

/// The best place for a new body of this shape.
pub(crate) fn placement_for_body(
    scene: &Scene,
    view: &ViewState,
    viewport: &Viewport,
    live: &Live,
    shape: ShapeKind,
) -> NewBodyPlacement {
    let scenery = PlacementView::new(scene, view, viewport, live);
    if shape == ShapeKind::Plane {
        return scenery.spot_for_plane();
    }
    // Where the view is crowded, smaller bodies find a place, and others float.
    let standing = SHARES.into_iter().find_map(|share| scenery.free_spot(shape, share));
    let placement = standing.or_else(|| SHARES.into_iter().find_map(|share| scenery.free_air(shape, share)));
    placement.unwrap_or_else(|| scenery.floating(shape, scenery.subject, 1.0))
}

impl PlacementView<'_> {
    /// The free place to stand nearest to the middle of the picture, for a body of `share` of the fitting size.
    fn free_spot(&self, shape: ShapeKind, share: f64) -> Option<NewBodyPlacement> {
        self.places().find_map(|at| {
            let (placement, ground) = self.spot_at(at, shape, share)?;
            (self.holds(ground, &placement.body(shape)) && self.is_good(&placement, shape))
                .then_some(placement)
        })
    }

    /// The free place in the air nearest to the middle of the picture, for a body of `share` of the fitting size.
    fn free_air(&self, shape: ShapeKind, share: f64) -> Option<NewBodyPlacement> {
        DEPTHS.into_iter().find_map(|depth| {
            let mut spots = self.places().map(|at| self.floating(shape, self.point_at(at, depth), share));
            spots.find(|placement| self.is_good(placement, shape))
        })
    }

    /// Places of the picture from its middle outwards: Vogel's sunflower (1979), evenly spread.
    fn places(&self) -> impl Iterator<Item = DVec2> {
        let bodies = u32::try_from(self.scene.bodies.len()).unwrap_or(u32::MAX).max(1);
        let count = PLACES.min(MOST_TESTS / bodies).max(1);
        (0..count).map(move |index| {
            let (angle, radius) =
                (2.399_963 * f64::from(index), (f64::from(index) / f64::from(count)).sqrt());
            self.place(0.5 + 0.45 * radius * DVec2::from_angle(angle % TAU))
        })
    }

    /// Whether a body there is seen and apart from others.
    fn is_good(&self, placement: &NewBodyPlacement, shape: ShapeKind) -> bool {
        self.is_in_picture(&placement.body(shape)) && placement.is_free(shape, self.scene, &self.rooms)
    }

    /// The place for a body on what is seen at a place of the picture, if that is level.
    fn spot_at(&self, at: DVec2, shape: ShapeKind, share: f64) -> Option<(NewBodyPlacement, SupportSurface)> {
        let limit = FARTHEST * self.reach();
        let Some(hit) = self.scene_view.body_at(at) else {
            let ray = self.scene_view.projector.ray(at);
            let distance = -ray.origin.y / ray.direction.y;
            let foot = ray.at(distance).with_y(0.0);
            // Without any body to stand on, the ground is as good as a floor.
            if distance > 0.0 && distance < limit && foot.is_finite() {
                return Some((self.standing(shape, foot, share), SupportSurface::Endless));
            }
            return Some((self.floating(shape, self.point_at(at, 1.0), share), SupportSurface::Nothing));
        };
        let is_near = hit.position.distance(self.camera().position) < limit;
        if !is_near || f64::from(hit.normal.y) < LEVEL {
            return None;
        }
        let body = self.scene.bodies.get(hit.body)?;
        let (height, ground) = match (body.shape, bounds::of_body(body)) {
            (Shape::Plane, _) => (plane_height(body), SupportSurface::Endless),
            (_, Some(bounds)) if hit.from_within => (bounds.min.y, SupportSurface::Top(hit.body)),
            (_, Some(bounds)) => (bounds.max.y, SupportSurface::Top(hit.body)),
            (_, None) => return None,
        };
        // The top of a ball is level in one point only.
        let is_level = (height - hit.position.y).abs() < 1e-3 * self.reach();
        is_level.then(|| (self.standing(shape, hit.position.with_y(height), share), ground))
    }

    /// A body of fitting size on a point of the ground.
    fn standing(&self, shape: ShapeKind, foot: DVec3, share: f64) -> NewBodyPlacement {
        let size = self.fitting_size(shape, foot, share);
        let grid = decimal_below(0.6 * size);
        let foot = DVec3::new(rounded(foot.x, grid), foot.y, rounded(foot.z, grid));
        NewBodyPlacement { size, ..NewBodyPlacement::at(foot) }
    }

    /// A body of fitting size about a point.
    fn floating(&self, shape: ShapeKind, center: DVec3, share: f64) -> NewBodyPlacement {
        let size = self.fitting_size(shape, center, share);
        let grid = decimal_below(0.6 * size);
        let foot = center - 0.5 * extent(shape, size) * DVec3::Y;
        NewBodyPlacement { size, ..NewBodyPlacement::at(foot.map(|part| rounded(part, grid))) }
    }

    /// The size of a body at a point: the default where that suits the picture, otherwise 1, 2 or 5 times a power of
    /// ten.
    fn fitting_size(&self, shape: ShapeKind, point: DVec3, share: f64) -> f64 {
        let height = self.scene_view.projector.size().y * self.scene_view.projector.meters_per_point(point);
        let part = share * extent(shape, 1.0) / height;
        if (FITTING[0]..=FITTING[1]).contains(&part) {
            return share;
        }
        let wanted = share * CHOSEN * height / extent(shape, 1.0);
        let decade = decimal_below(3.0 * wanted);
        let digit = [5.0, 2.0, 1.0].into_iter().find(|digit| digit * decade <= wanted).unwrap_or(1.0);
        digit * decade
    }

    /// Whether a body stands with its whole base on the ground.
    fn holds(&self, ground: SupportSurface, body: &Body) -> bool {
        let SupportSurface::Top(index) = ground else { return true };
        let below = self.scene.bodies.get(index).and_then(bounds::of_body);
        below.zip(bounds::of_body(body)).is_some_and(|(below, own)| {
            own.min.x >= below.min.x
                && own.min.z >= below.min.z
                && own.max.x <= below.max.x
                && own.max.z <= below.max.z
        })
    }

    /// Whether the picture shows all of the box around a body, with its middle not hidden.
    fn is_in_picture(&self, body: &Body) -> bool {
        let Some(bounds) = bounds::of_body(body) else { return true };
        let [least, most] = self.corners();
        let mut corners = (0..8).map(|corner| {
            let is_far = glam::BVec3::new(corner & 1 != 0, corner & 2 != 0, corner & 4 != 0);
            DVec3::select(is_far, bounds.max, bounds.min)
        });
        corners.all(|corner| {
            self.scene_view.projector.project(corner).is_some_and(|at| {
                at.x > least.x + 4.0 && at.x < most.x - 4.0 && at.y > least.y && at.y < most.y - 4.0
            })
        }) && self.is_seen(bounds.center())
    }

    /// A floor; where there is one already, a wall behind what is seen.
    fn spot_for_plane(&self) -> NewBodyPlacement {
        let [_, _, forward] = self.scene_view.projector.axes();
        let floors = self.scene.bodies.iter().filter(|body| !body.hidden && is_floor(body));
        let below = floors.map(plane_height).filter(|height| *height < self.camera().position.y);
        if below.reduce(f64::max).is_none() {
            let lowest = self.scene.bodies.iter().filter(|body| !body.hidden).filter_map(bounds::of_body);
            let height = lowest.map(|bounds| bounds.min.y).reduce(f64::min).unwrap_or(0.0).min(0.0);
            return NewBodyPlacement::at(DVec3::new(0.0, height, 0.0));
        }
        // The normal looks back along the axis that the view follows most.
        let (back, rotation_degrees) = if forward.x.abs() > forward.z.abs() {
            let sign = -forward.x.signum();
            (sign * DVec3::X, DVec3::new(0.0, 0.0, -90.0 * sign))
        } else {
            let sign = -forward.z.signum();
            (sign * DVec3::Z, DVec3::new(90.0 * sign, 0.0, 0.0))
        };
        let behind = farthest(self.scene, -back).max(self.subject.dot(-back)) + 0.25 * self.reach();
        let foot = -back * rounded(behind, decimal_below(0.3 * self.reach()));
        NewBodyPlacement { rotation_degrees, ..NewBodyPlacement::at(foot) }
    }
}

/// The largest of the three extents of a body of this size, meters.
fn extent(shape: ShapeKind, size: f64) -> f64 {
    let placement = NewBodyPlacement { size, ..NewBodyPlacement::at(DVec3::ZERO) };
    bounds::of_body(&placement.body(shape)).map_or(size, |bounds| bounds.size().max_element())
}

fn is_floor(body: &Body) -> bool {
    body.shape == Shape::Plane && body.placement.rotation().y_axis.y.abs() > LEVEL
}

fn plane_height(body: &Body) -> f64 {
    body.placement.origin().y
}

/// How far the shown bodies and lights reach along a direction.
fn farthest(scene: &Scene, direction: DVec3) -> f64 {
    let bodies = scene.bodies.iter().filter(|body| !body.hidden).filter_map(bounds::of_body);
    let corners = bodies.map(|bounds| DVec3::select(direction.cmplt(DVec3::ZERO), bounds.min, bounds.max));
    let lights = scene.lights.iter().filter(|light| !light.hidden).map(|light| light.position);
    corners.chain(lights).map(|point| point.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
}
