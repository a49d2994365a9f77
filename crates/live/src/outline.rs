//! Outlines of bodies, found by tracing them: exact for every shape, wherever the view cuts it.

mod area;
mod contour;
#[cfg(test)]
mod tests;

use catoptric_scene::Scene;
use catoptric_tracer::{RenderCamera, RenderScene};
use glam::{DVec2, Vec2};
use rayon::prelude::*;

use crate::frame::Polyline;
use area::Area;
use contour::{BorderPoint, Contour};

/// Up to this many bodies have an outline each; more have one around all of them.
const MOST_OUTLINES: usize = 32;

/// The scenes of the bodies to outline.
pub(crate) struct OutlineTracer {
    groups: Vec<OutlineGroup>,
}

/// Bodies that share one outline.
struct OutlineGroup {
    bodies: Vec<usize>,
    render_scene: RenderScene,
}

impl OutlineTracer {
    /// Takes these bodies out of the scene; places beyond the scene's bodies are passed over.
    pub(crate) fn new(scene: &Scene, render_scene: &RenderScene, bodies: &[usize]) -> Self {
        let groups: Vec<Vec<usize>> = if bodies.len() <= MOST_OUTLINES {
            bodies.iter().map(|&body| vec![body]).collect()
        } else {
            vec![bodies.to_vec()]
        };
        let groups = groups
            .into_iter()
            .map(|bodies| OutlineGroup { render_scene: render_scene.only(scene, &bodies), bodies });
        Self { groups: groups.filter(|group| group.render_scene.body_count() > 0).collect() }
    }

    /// Traces the outlines, on the current rayon pool.
    pub(crate) fn trace(
        &self,
        scene: &Scene,
        render_scene: &RenderScene,
        camera: &RenderCamera,
        size: DVec2,
    ) -> Vec<Polyline> {
        self.groups.par_iter().flat_map_iter(|group| group.trace(scene, render_scene, camera, size)).collect()
    }
}

impl OutlineGroup {
    fn trace(
        &self,
        scene: &Scene,
        render_scene: &RenderScene,
        camera: &RenderCamera,
        size: DVec2,
    ) -> Vec<Polyline> {
        let bodies = self.bodies.iter().filter_map(|&body| scene.bodies.get(body));
        let Some(area) = Area::of_bodies(bodies, camera, size) else { return Vec::new() };
        let is_inside = |at: DVec2| self.render_scene.closest_hit(&camera.ray(at, size)).is_some();
        let contours = contour::contours(&area, &is_inside);
        let body = match self.bodies[..] {
            [body] => Some(body),
            _ => None,
        };
        let is_hidden = |point: &BorderPoint| self.is_hidden(render_scene, camera, point.inside, size);
        contours.iter().flat_map(|contour| by_visibility(contour, body, is_hidden)).collect()
    }

    /// Whether something stands before the bodies here.
    fn is_hidden(&self, render_scene: &RenderScene, camera: &RenderCamera, at: DVec2, size: DVec2) -> bool {
        /// What lies this much closer, as a share of the way, hides; less is a contact.
        const CONTACT: f32 = 1e-4;
        let ray = camera.ray(at, size);
        let (Some(own), Some(first)) = (self.render_scene.closest_hit(&ray), render_scene.closest_hit(&ray))
        else {
            return false;
        };
        first.body != own.body && first.hit.t < own.hit.t * (1.0 - CONTACT)
    }
}

/// Cuts a line where it goes behind another body.
fn by_visibility(
    contour: &Contour,
    body: Option<usize>,
    is_hidden: impl Fn(&BorderPoint) -> bool,
) -> Vec<Polyline> {
    let points: Vec<(Vec2, bool)> =
        contour.points.iter().map(|point| (point.at.as_vec2(), is_hidden(point))).collect();
    let changes_after = |&index: &usize| {
        points.get(index).zip(points.get((index + 1) % points.len())).is_some_and(|(a, b)| a.1 != b.1)
    };
    let first_change = (0..points.len()).find(changes_after);
    let (Some(change), true) = (first_change, contour.closed) else {
        let hidden = points.first().is_some_and(|point| point.1);
        if first_change.is_none() {
            let points: Vec<Vec2> = points.iter().map(|point| point.0).collect();
            let line = Polyline { body, points, closed: contour.closed, hidden };
            return Vec::from_iter((line.points.len() >= 2).then_some(line));
        }
        let mut pieces = runs(&points, body);
        pieces.retain(|piece| piece.points.len() >= 2);
        return pieces;
    };
    // Begin a closed line where it changes, and end it there.
    let turned: Vec<(Vec2, bool)> =
        points.iter().cycle().skip(change + 1).take(points.len()).copied().collect();
    let mut pieces = runs(&turned, body);
    if let [(first, _), .., (last, _)] = turned[..] {
        let middle = 0.5 * (first + last);
        if let Some(piece) = pieces.first_mut() {
            piece.points.insert(0, middle);
        }
        if let Some(piece) = pieces.last_mut() {
            piece.points.push(middle);
        }
    }
    pieces
}

/// The pieces of equal visibility of an open line; they meet in the middle between their last points.
fn runs(points: &[(Vec2, bool)], body: Option<usize>) -> Vec<Polyline> {
    let mut pieces: Vec<Polyline> = Vec::new();
    let mut before: Option<Vec2> = None;
    for &(point, hidden) in points {
        match pieces.last_mut() {
            Some(piece) if piece.hidden == hidden => piece.points.push(point),
            last => {
                let middle = before.map(|before| 0.5 * (before + point));
                if let Some(piece) = last {
                    piece.points.extend(middle);
                }
                let points = middle.into_iter().chain([point]).collect();
                pieces.push(Polyline { body, points, closed: false, hidden });
            }
        }
        before = Some(point);
    }
    pieces
}
