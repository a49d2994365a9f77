//! The bodies of a scene, without what they are made of, and how the ones that a ray meets are found.

pub(crate) mod body;
pub(crate) mod bounds;
pub(crate) mod bvh;
pub(crate) mod canonical;
pub(crate) mod hull;
pub(crate) mod joined;
pub(crate) mod membership;
pub(crate) mod plane_frame;
pub(crate) mod prefetch;
pub(crate) mod query;
pub(crate) mod ray;
pub mod shape;
pub(crate) mod space;
pub(crate) mod sphere;
pub(crate) mod visible_bodies;

use std::ops::Range;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::geometry::body::double::{Bodies64, Body64};
use crate::geometry::body::{RenderBody, SurfacePoint};
use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::Bvh;
use crate::geometry::bvh::entry::BuildEntry;
use crate::geometry::joined::{JoinedBodies, JoinedBody};
use crate::geometry::shape::ShapeSpan;
use crate::geometry::space::RenderSpace;
use crate::geometry::sphere::BoundingSphere;
use crate::simd::Width;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;

/// The bodies of a scene.
///
/// They stand in the order of the hierarchy's leaves, then those without end, then the parts of joined bodies, which no
/// search looks for by themselves. What a search reads is plain single-precision data.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(crate) bodies: Vec<RenderBody>,
    /// A number for each body: its place in the scene, or beyond those the place in `members`.
    pub(crate) numbers: Vec<u32>,
    /// The members of groups and the parts of joined bodies.
    pub(crate) members: Arc<Members>,
    /// How many of the bodies are bounded; those without end follow them.
    pub(crate) bounded: u32,
    pub(crate) joined: JoinedBodies,
    pub(crate) hierarchy: Accelerator,
    /// Around each bounded body.
    pub(crate) spheres: Vec<BoundingSphere>,
    /// The exact numbers of bodies that do not fit single precision.
    pub(crate) doubles: Arc<Bodies64>,
    pub(crate) space: RenderSpace,
    /// The largest extent of the bodies in single precision, meters.
    pub(crate) largest_extent: f64,
    /// The largest [`RenderBody::error_bound`], or more after an edit.
    pub(crate) largest_error_bound: f32,
    /// Whether light passes through any body, or did before an edit.
    pub(crate) has_transparency: bool,
    /// Whether bodies may be cemented to what they touch.
    pub(crate) has_cemented: bool,
}

/// Bodies that a scene has only as parts of others: members of groups, and parts of joined bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Members {
    /// The number of the first one: how many bodies the scene has.
    pub(crate) first: u32,
    /// The place in the scene of the body that each belongs to.
    pub(crate) scene_indices: Vec<u32>,
    /// Which of the simple parts of that body each is, in the order of [`Form::each_simple`]; of a joined body among them
    /// its first.
    ///
    /// [`Form::each_simple`]: catoptric_scene::Form::each_simple
    pub(crate) parts: Vec<u32>,
}

/// How the bodies that a ray may meet are found among the bounded ones.
#[derive(Clone, Debug)]
pub(crate) enum Accelerator {
    /// They are few: the sphere around each is tested.
    Few,
    Many(Bvh),
}

/// Which of the bodies a ray is tested against. The picture does not depend on it, but the time does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AcceleratorChoice {
    /// What is quickest for the number of bodies: one by one when they are few, else through a hierarchy of bounding
    /// boxes. The default.
    #[default]
    Quickest,
    /// The bounding sphere of every body, one by one, however many there are: the time grows in proportion to them.
    OneByOne,
}

impl Accelerator {
    /// The hierarchy over these entries of bodies, which are put into its order.
    pub(crate) fn over(entries: &mut [BuildEntry], search: AcceleratorChoice) -> Self {
        if entries.len() <= Geometry::FEW || search == AcceleratorChoice::OneByOne {
            entries.sort_by_key(BuildEntry::leaf_key);
            Self::Few
        } else {
            Self::Many(Bvh::build(entries))
        }
    }

    /// The box of all its entries, which are these.
    pub(crate) fn bounds(&self, entries: &[BuildEntry]) -> Bounds {
        match self {
            Self::Few => entries.iter().fold(Bounds::EMPTY, |all, entry| all.union(entry.bounds())),
            Self::Many(bvh) => bvh.bounds(),
        }
    }
}

impl Members {
    /// The place in the scene of the body with a number, or of what it belongs to.
    pub(crate) fn scene_index(&self, number: u32) -> Option<usize> {
        match number.checked_sub(self.first) {
            None => Some(number as usize),
            Some(member) => self.scene_indices.get(member as usize).map(|&index| index as usize),
        }
    }
}

impl Geometry {
    /// Up to this many bounded bodies, all bounding spheres are tested; from then on a hierarchy of boxes is quicker.
    pub(crate) const FEW: usize = 48;

    /// Among so many bodies even neighboring rays part before they meet one, and order counts for more than company.
    pub(crate) const VERY_MANY: u32 = 50_000;

    /// Whether the rays of a stream that run into different octants are better searched for apart.
    pub(crate) fn parts_streams(&self) -> bool {
        self.bounded >= Self::VERY_MANY
    }

    /// The place in the scene of body `index`, or of what it is a part of.
    pub(crate) fn scene_index(&self, index: u32) -> Option<usize> {
        self.members.scene_index(*self.numbers.get(index as usize)?)
    }

    /// Which of the simple parts of a body of the scene body `index` is; `None` for one that has no parts.
    pub(crate) fn part(&self, index: u32) -> Option<usize> {
        let member = self.numbers.get(index as usize)?.checked_sub(self.members.first)?;
        self.members.parts.get(member as usize).map(|&part| part as usize)
    }

    /// Which of two bodies comes first in the scene.
    pub(crate) fn scene_order(&self, a: u32, b: u32) -> std::cmp::Ordering {
        let order = |index: u32| (self.scene_index(index), self.numbers.get(index as usize));
        order(a).cmp(&order(b))
    }

    /// Whether the body at this place is a surface without inside.
    pub(crate) fn is_surface(&self, index: u32) -> bool {
        self.joined(index).is_some_and(|joined| joined.tree.is_surface())
    }

    /// The joined body at this place, if it is one.
    pub(crate) fn joined(&self, index: u32) -> Option<&JoinedBody> {
        let body = self.body(index);
        if body.is_joined() { self.joined.bodies.get(body.joined_number()) } else { None }
    }

    /// The bodies that searches look for: without the parts of joined ones.
    pub(crate) fn whole(&self) -> Range<u32> {
        0..self.joined.first_part
    }

    /// A point of render space in the world, meters.
    pub(crate) fn world_from_render(&self, point: impl Into<Vec3>) -> DVec3 {
        self.space.origin + point.into().as_dvec3()
    }

    /// Bytes held by the arrays of bodies and by the hierarchy.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.bodies)
            + size_of_val(&*self.spheres)
            + size_of_val(&*self.numbers)
            + match &self.hierarchy {
                Accelerator::Few => 0,
                Accelerator::Many(bvh) => bvh.bytes(),
            }
    }

    /// The bodies without end: planes, and joined bodies that no box holds.
    pub(crate) fn planes(&self) -> Range<u32> {
        self.bounded..self.joined.first_part
    }

    pub(crate) fn body(&self, index: u32) -> &RenderBody {
        &self.bodies[index as usize]
    }

    /// Whether some body is in double precision: then little is known of where bodies lie before they are tested.
    pub(crate) fn has_doubles(&self) -> bool {
        !self.doubles.is_empty()
    }

    /// The body at this place in double precision, if it is.
    fn double(&self, index: u32) -> Option<&Body64> {
        self.doubles.get(*self.numbers.get(index as usize)?)
    }

    /// Where lines of the space of the rays, of directions of length 1, cross a body.
    #[inline(always)]
    pub(crate) fn span<W: Width>(
        &self,
        w: W,
        (index, body): (u32, &RenderBody),
        origin: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> ShapeSpan<W::R> {
        if W::TESTS_DOUBLES
            && body.is_double()
            && let Some(double) = self.double(index)
        {
            return double.span(w, origin, direction);
        }
        body.span(origin, direction)
    }

    /// Where such lines cross a face of a body at `t`, as [`RenderBody::point_on_face`].
    #[inline(always)]
    pub(crate) fn point_on_face<W: Width>(
        &self,
        w: W,
        (index, body): (u32, &RenderBody),
        line: (Vector<W::R>, Vector<W::R>),
        t: W::R,
        leaving: W::M,
        face: W::R,
    ) -> SurfacePoint<W::R> {
        if W::TESTS_DOUBLES
            && body.is_double()
            && let Some(double) = self.double(index)
        {
            return double.surface_point(w, line.0, line.1, leaving);
        }
        body.point_on_face(line, t, leaving, face)
    }

    /// Where a line crosses a body's surface at `t`, on the way out if it is `leaving`.
    pub(crate) fn surface_point(
        &self,
        index: u32,
        (origin, direction): (Vector<f32>, Vector<f32>),
        t: f32,
        leaving: bool,
    ) -> SurfacePoint<f32> {
        let body = self.body(index);
        let span = self.span(ScalarWidth, (index, body), origin, direction);
        let face = if leaving { span.exit_face } else { span.enter_face };
        self.point_on_face(ScalarWidth, (index, body), (origin, direction), t, leaving, face)
    }

    /// Where lines cross a body, and |cos| of the angles between them and the normals where they enter and leave.
    #[inline(always)]
    pub(crate) fn span_and_cosines<W: Width>(
        &self,
        w: W,
        index: u32,
        origin: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> (ShapeSpan<W::R>, [W::R; 2]) {
        let body = self.body(index);
        if W::TESTS_DOUBLES
            && body.is_double()
            && let Some(double) = self.double(index)
        {
            return (double.span(w, origin, direction), double.cosines(w, origin, direction));
        }
        let span = body.span(origin, direction);
        let cosine = |t, face| body.cosine(origin, direction, t, face);
        (span, [cosine(span.enter, span.enter_face), cosine(span.exit, span.exit_face)])
    }

    /// Whether a point of the space of the rays lies in a body.
    pub(crate) fn contains(&self, index: u32, point: Vector<f32>) -> bool {
        match self.joined(index) {
            Some(joined) => !joined.tree.is_surface() && joined.tree.holds(self.parts_around(joined, point)),
            None => self.contains_simple(index, point),
        }
    }

    /// The parts of a joined body, a bit for each, that a point lies in.
    pub(crate) fn parts_around(&self, joined: &JoinedBody, point: Vector<f32>) -> u64 {
        let is_in = |part: u32| u64::from(self.contains_simple(part, point));
        joined.parts().zip(0..).fold(0, |bits, (part, bit)| bits | is_in(part) << bit)
    }

    fn contains_simple(&self, index: u32, point: Vector<f32>) -> bool {
        match self.double(index) {
            Some(double) => double.contains(point),
            None => self.body(index).contains(point),
        }
    }

    /// The sphere around a bounded body.
    pub(crate) fn sphere(&self, index: u32) -> &BoundingSphere {
        &self.spheres[index as usize]
    }

    /// Asks for bodies of a leaf, which are probably wanted soon.
    #[inline(always)]
    pub(crate) fn fetch(&self, places: Range<u32>) {
        // Seldom there is a line of the cache between the first and the last one.
        prefetch::fetch(&self.spheres, places.start);
        prefetch::fetch(&self.spheres, places.end.saturating_sub(1));
        places.for_each(
            #[inline(always)]
            |index| prefetch::fetch(&self.bodies, index),
        );
    }
}
