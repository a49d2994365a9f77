//! The tree of rays behind one pixel, ray by ray.

use glam::Vec3;

use super::{Beams, Offspring, Origin, Whitted};
use crate::lanes::One;
use crate::pick::SurfaceHit;
use crate::ray::Ray;
use crate::search::found_in;

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

/// A ray that waits, and why.
struct Waiting {
    beam: Beams<One>,
    kind: RayKind,
    parent: Option<usize>,
}

/// The rays that grow from the one at `parent`.
struct Children<'a> {
    waiting: &'a mut Vec<Waiting>,
    parent: Option<usize>,
}

impl Offspring<One> for Children<'_> {
    fn reflected(&mut self, beam: Beams<One>) {
        self.waiting.push(Waiting { beam, kind: RayKind::Reflected, parent: self.parent });
    }

    fn refracted(&mut self, beam: Beams<One>) {
        self.waiting.push(Waiting { beam, kind: RayKind::Refracted, parent: self.parent });
    }
}

impl Whitted<'_> {
    /// The tree of rays that grows from `primary`, at most `limit` of them: each ray after its parent, the reflected
    /// branch of a hit before the refracted one. The sum of all [`TracedRay::light`] is what reaches the start.
    ///
    /// A tree of glass bodies doubles with every generation, hence the limit.
    pub fn tree(&mut self, primary: Ray, limit: usize) -> Vec<TracedRay> {
        let mut waiting = vec![Waiting { beam: self.root(&primary), kind: RayKind::Primary, parent: None }];
        let mut tree = Vec::new();
        while let Some(Waiting { beam, kind, parent }) = waiting.pop()
            && tree.len() < limit
        {
            let mut children = Children { waiting: &mut waiting, parent: Some(tree.len()) };
            let followed = self.follow(One, &beam, Origin::Anywhere, &mut children);
            let ray = beam.rays.ray();
            tree.push(TracedRay {
                ray,
                kind,
                parent,
                generation: beam.generation,
                weight: beam.weight.into(),
                light: followed.light.into(),
                hit: found_in(&followed.hits).and_then(|hit| SurfaceHit::new(self.stage, &ray, hit)),
            });
        }
        tree
    }
}
