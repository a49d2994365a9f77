//! The tree of rays behind one pixel, ray by ray.

use glam::Vec3;

use super::{Branch, Whitted};
use crate::pick::SurfaceHit;
use crate::ray::Ray;
use crate::search::Flight;

/// Why a ray was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye, or wherever the tree begins.
    Primary,
    /// Mirrored, total internal reflection included.
    Reflected,
    /// Bent into or out of a transparent body.
    Refracted,
}

/// One ray of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedRay {
    /// The ray itself.
    pub ray: Ray,
    /// Why it was sent.
    pub kind: RayKind,
    /// The place in the tree of the ray at whose end it starts; `None` for the first.
    pub parent: Option<usize>,
    /// Its generation; the first ray is generation 1.
    pub generation: u32,
    /// Product of the coefficients on the way from the eye.
    pub weight: Vec3,
    /// What this ray alone adds to the pixel: the local terms at its end, or the background, times its weight.
    pub light: Vec3,
    /// What it meets.
    pub hit: Option<SurfaceHit>,
}

impl Whitted<'_> {
    /// The tree of rays that grows from `primary`, at most `limit` of them: each ray after its parent, the reflected
    /// branch of a hit before the refracted one. The sum of all [`TracedRay::light`] is what reaches the start.
    ///
    /// A tree of glass bodies doubles with every generation, hence the limit.
    pub fn tree(&mut self, primary: Ray, limit: usize) -> Vec<TracedRay> {
        let mut branch = self.root(primary, None);
        let mut node = (RayKind::Primary, None);
        // The parents of the pending branches.
        let mut parents = Vec::new();
        let mut tree = Vec::new();
        while tree.len() < limit {
            let Branch { ray, weight, generation, media, .. } = branch;
            let flight = Flight { stage: self.stage, arena: &self.arena, ray, media };
            let hit = flight.nearest(&mut self.parts).and_then(|hit| SurfaceHit::new(self.stage, &ray, hit));
            let (kind, parent) = node;
            let (light, goes_on) = self.follow(&mut branch);
            let (weight, light) = (weight.into(), light.into());
            tree.push(TracedRay { ray, kind, parent, generation, weight, light, hit });
            let own = Some(tree.len() - 1);
            parents.resize(self.pending.len(), own);
            if goes_on {
                node = (RayKind::Reflected, own);
            } else {
                let (Some(next), Some(parent)) = (self.pending.pop(), parents.pop()) else {
                    break;
                };
                self.arena.rewind(next.mark);
                branch = next;
                node = (RayKind::Refracted, parent);
            }
        }
        tree
    }
}
