//! How far bodies reach.

use catoptric_scene::{Body, Scene};
use glam::DVec3;

use crate::selection::Selection;

/// A box along the world's axes, meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

/// A ball around something, meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its center.
    pub center: DVec3,
    /// Its radius.
    pub radius: f64,
}

/// The smallest box around a body; `None` for a plane.
pub fn of_body(_body: &Body) -> Option<Bounds> {
    None
}

/// The smallest ball around a body; `None` for a plane.
pub fn ball_of_body(_body: &Body) -> Option<Ball> {
    None
}

/// The box around the selected bodies and lights; `None` when they have none.
pub fn of_selection(_scene: &Scene, _selection: &Selection) -> Option<Bounds> {
    None
}

/// A ball around the selected bodies and lights; `None` when they have none.
pub fn ball_of_selection(_scene: &Scene, _selection: &Selection) -> Option<Ball> {
    None
}

/// The box around all bodies that are not hidden; `None` when there are none but planes.
pub fn of_scene(_scene: &Scene) -> Option<Bounds> {
    None
}

/// A ball around all bodies that are not hidden; `None` when there are none but planes.
pub fn ball_of_scene(_scene: &Scene) -> Option<Ball> {
    None
}
