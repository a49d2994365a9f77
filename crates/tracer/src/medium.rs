//! The transparent bodies a ray is inside of.

use glam::Vec3A;

use crate::stage::{Hierarchy, Stage};

/// The end of every list.
const END: u32 = u32::MAX;

/// A list of the transparent bodies that a ray is inside of, in the order entered; lives in a [`MediaArena`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Media(u32);

impl Media {
    /// In no body: in air.
    pub(crate) const AIR: Self = Self(END);

    /// Whether the ray is in air.
    #[inline]
    pub(crate) fn is_air(self) -> bool {
        self == Self::AIR
    }
}

/// The lists of all rays of one pixel's tree. Rays share the tails of their lists, so that a ray costs at most one
/// link, and nesting is not limited.
#[derive(Clone, Debug, Default)]
pub(crate) struct MediaArena {
    /// Each link: a body and the rest of the list.
    links: Vec<(u32, u32)>,
}

impl MediaArena {
    /// A mark to which [`Self::rewind`] can return.
    pub(crate) fn mark(&self) -> usize {
        self.links.len()
    }

    /// Forgets all lists made since `mark`.
    pub(crate) fn rewind(&mut self, mark: usize) {
        self.links.truncate(mark);
    }

    /// The body entered last.
    pub(crate) fn innermost(&self, media: Media) -> Option<u32> {
        self.links.get(media.0 as usize).map(|link| link.0)
    }

    /// Whether the ray is inside `body`.
    #[inline]
    pub(crate) fn contains(&self, media: Media, body: u32) -> bool {
        let mut at = media.0;
        while let Some(&(entered, rest)) = self.links.get(at as usize) {
            if entered == body {
                return true;
            }
            at = rest;
        }
        false
    }

    /// The list after entering `body`.
    pub(crate) fn entered(&mut self, media: Media, body: u32) -> Media {
        self.links.push((body, media.0));
        Media(self.links.len() as u32 - 1)
    }

    /// The list after leaving `body`; unchanged if the ray was not inside it.
    pub(crate) fn left(&mut self, media: Media, body: u32) -> Media {
        let mut outside = Vec::new();
        let mut at = media.0;
        while let Some(&(entered, rest)) = self.links.get(at as usize) {
            if entered == body {
                let below = Media(rest);
                return outside.iter().rev().fold(below, |list, &later| self.entered(list, later));
            }
            outside.push(entered);
            at = rest;
        }
        media
    }

    /// The media at a point of space, such as the eye: every transparent body that contains it, the largest outermost.
    pub(crate) fn at_point(&mut self, stage: &Stage, point: Vec3A) -> Media {
        if !stage.has_transparency {
            return Media::AIR;
        }
        let mut around = Vec::new();
        let mut test = |index: u32| {
            let body = stage.body(index);
            if body.is_transparent() && body.contains(point) {
                around.push(index);
            }
        };
        match &stage.hierarchy {
            Hierarchy::Few(_) => (0..stage.bounded).for_each(&mut test),
            Hierarchy::Many(bvh) => bvh.visit_at(point, |leaf| leaf.for_each(&mut test)),
        }
        stage.planes().for_each(&mut test);
        around.sort_by(|&a, &b| {
            stage.body(b).volume.total_cmp(&stage.body(a).volume).then_with(|| stage.scene_order(a, b))
        });
        around.into_iter().fold(Media::AIR, |media, body| self.entered(media, body))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaving_the_innermost_returns_to_the_one_around() {
        let mut arena = MediaArena::default();
        let outer = arena.entered(Media::AIR, 7);
        let inner = arena.entered(outer, 3);
        assert_eq!(arena.innermost(inner), Some(3));
        assert_eq!(arena.left(inner, 3), outer);
        assert!(arena.contains(inner, 7) && !arena.contains(outer, 3));
    }

    #[test]
    fn leaving_an_outer_body_keeps_the_inner_ones_in_order() {
        let mut arena = MediaArena::default();
        let mut media = Media::AIR;
        for body in [1, 2, 3] {
            media = arena.entered(media, body);
        }
        let media = arena.left(media, 1);
        assert_eq!(arena.innermost(media), Some(3));
        let media = arena.left(media, 3);
        assert_eq!(arena.innermost(media), Some(2));
        assert!(arena.left(media, 2).is_air());
        assert_eq!(arena.left(media, 99), media, "leaving a body that was never entered changes nothing");
    }

    #[test]
    fn rewinding_frees_the_links() {
        let mut arena = MediaArena::default();
        let outer = arena.entered(Media::AIR, 1);
        let mark = arena.mark();
        arena.entered(outer, 2);
        arena.rewind(mark);
        assert_eq!(arena.mark(), 1);
        assert_eq!(arena.innermost(outer), Some(1));
    }
}
