//! The segments of an audit's rays in space, and the optical path along them.

use catoptric_lab::audit::{Node, NodeKind, RayTree};
use catoptric_scene::{Camera, Light, Scene};
use glam::{DVec2, DVec3};

use super::PinnedPixel;
use crate::base::projector::Projector;

/// The most segments that are drawn: those of the greatest weight.
const MOST: usize = 1500;

/// The kind of a segment: a ray, a shadow ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SegmentKind {
    /// A ray of the tree.
    Ray(NodeKind),
    /// A shadow ray that arrives at its light.
    Lit,
    /// A shadow ray that ends at an opaque body.
    Blocked,
}

/// A straight segment of a ray in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RaySegment {
    /// The ray of the tree that it is, or at whose end it starts.
    pub(crate) node: usize,
    pub(crate) kind: SegmentKind,
    pub(crate) from: DVec3,
    pub(crate) to: DVec3,
    /// The largest channel of its weight.
    pub(crate) weight: f32,
    pub(crate) generation: u32,
    /// Optical path from the eye to its start and its end: meters times the index of refraction.
    pub(crate) path: [f64; 2],
    /// Whether it meets nothing and goes on for ever.
    pub(crate) is_open: bool,
}

impl RaySegment {
    /// Whether it is a ray of the tree, no shadow ray.
    pub(crate) fn is_ray(&self) -> bool {
        matches!(self.kind, SegmentKind::Ray(_))
    }
}

/// The ways of a tree, the heaviest ones if there are very many, and how many are not there.
pub(super) fn of_tree(tree: &RayTree, scene: &Scene, pin: &PinnedPixel) -> (Vec<RaySegment>, usize) {
    let projector = Projector::new(&pin.camera, pin.size.as_dvec2());
    let eye = projector.ray(pin.pixel.as_dvec2() + tree.offset).origin;
    let far = 0.5 * reach(&pin.camera);
    let lights: Vec<&Light> = scene.lights.iter().filter(|light| !light.hidden).collect();
    let mut ends: Vec<f64> = Vec::with_capacity(tree.nodes.len());
    let mut ways = Vec::new();
    for (place, node) in tree.nodes.iter().enumerate() {
        let origin = node.ray.parent.map_or(eye, |_| node.ray.origin);
        let direction = node.ray.ray.direction.as_dvec3();
        let end = match node.ray.hit {
            Some(hit) => hit.position,
            // A primary ray begins near the bodies, wherever the eye is.
            None => node.ray.origin + far * direction,
        };
        let start = node.ray.parent.and_then(|parent| ends.get(parent)).copied().unwrap_or(0.0);
        let path = [start, start + f64::from(node.ray.ior) * origin.distance(end)];
        ends.push(path[1]);
        ways.push(RaySegment {
            node: place,
            kind: SegmentKind::Ray(node.kind),
            from: origin,
            to: end,
            weight: node.largest_weight(),
            generation: node.ray.generation,
            path,
            is_open: node.ray.hit.is_none(),
        });
        shadows(&mut ways, node, place, &lights, path[1]);
    }
    let left_out = ways.len().saturating_sub(MOST);
    // The heaviest last: they are drawn over the others.
    ways.sort_by(|a, b| {
        (a.is_ray(), a.weight).partial_cmp(&(b.is_ray(), b.weight)).unwrap_or(std::cmp::Ordering::Equal)
    });
    ways.drain(..left_out);
    (ways, left_out)
}

fn shadows(ways: &mut Vec<RaySegment>, node: &Node, place: usize, lights: &[&Light], start: f64) {
    let (Some(hit), Some(answer)) = (node.ray.hit, node.answer()) else { return };
    let from = hit.position;
    for term in &answer.lights {
        let (Some(shadow), Some(light)) = (&term.shadow, lights.get(term.light)) else { continue };
        let opaque = shadow.crossings.iter().find(|crossing| crossing.filter.is_none());
        let (kind, to) = match opaque {
            Some(crossing) => {
                let way = term.direction.as_dvec3() * f64::from(crossing.distance);
                (SegmentKind::Blocked, from + way)
            }
            None => (SegmentKind::Lit, light.position),
        };
        ways.push(RaySegment {
            node: place,
            kind,
            from,
            to,
            weight: node.largest_weight(),
            generation: node.ray.generation,
            path: [start, start + from.distance(to)],
            is_open: false,
        });
    }
}

/// How far a camera looks.
fn reach(camera: &Camera) -> f64 {
    camera.position.distance(camera.target)
}

/// The ray through a pixel's middle, from the eye on: where the audited pixel lies in space.
pub(crate) fn pixel_at(pin: &PinnedPixel, projector: &Projector) -> Option<DVec2> {
    let seen = Projector::new(&pin.camera, pin.size.as_dvec2()).ray(pin.pixel.as_dvec2() + DVec2::splat(0.5));
    projector.project(seen.at(reach(&pin.camera)))
}
