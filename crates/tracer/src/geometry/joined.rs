//! Bodies joined of simple ones: unions, intersections and differences.
//!
//! Every part stays convex, so that a line lies in it along one [`ShapeSpan`](crate::shape::ShapeSpan), and the whole is
//! a boolean function of the bits that tell which parts a point of the line lies in (Roth 1982, Ray Casting for Modeling
//! Solids). Of a surface the first part is met, wherever the function holds, from the sides that are seen; it has no
//! inside. A ray remembers the part that it starts from and the side of that part's surface, as for any other body.

use std::ops::Range;

use catoptric_scene::{Form, Shape, VisibleSide};
use smallvec::SmallVec;

use crate::geometry::body::RenderBody;
use crate::geometry::bounds::Bounds;
use crate::geometry::ray::{NO_BODY, RayOrigin};
use crate::simd::{MOST_LANES, Mask as _, Width, Word as _};

/// How parts are joined.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct JoinTree {
    /// In postfix order.
    steps: Vec<JoinStep>,
    /// The joining as unions and intersections alone, of parts or of what lies outside of them; each after those that it
    /// joins.
    gates: Vec<JoinGate>,
    /// Number of parts.
    pub(crate) parts: u32,
    /// A bit for each part: whether the whole lies outside of it, as it does of what is cut away.
    inverted: u64,
    /// Of the surface of the first part, as far as it lies in all others, the sides that rays meet.
    side: Option<VisibleSide>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum JoinStep {
    /// Whether a point lies in the next part.
    Part,
    /// In nothing.
    Nothing,
    /// The last two in one.
    Union,
    Intersection,
    Difference,
}

/// Parts of which a point has to be on the right side: in them, or outside of what is cut away. A complement is brought
/// down to the parts by De Morgan's laws, and gates of one kind within one another are one: most wholes have a single
/// gate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct JoinGate {
    /// A bit for each part.
    pub(crate) parts: u64,
    /// It looks at the gates before it that are one deeper and that no other has looked at.
    pub(crate) depth: u32,
    /// Whether a point has to be on the right side of all of these, or of any.
    pub(crate) needs_all: bool,
}

impl JoinTree {
    /// Of a union, an intersection, a difference or a surface; the parts are in the order of [`Form::each_simple`], at most
    /// [`Shape::MAX_PARTS`].
    pub(crate) fn of(form: &Form<'_>) -> Self {
        let side = match form.shape {
            Shape::Surface { side } => Some(side),
            _ => None,
        };
        let mut tree = Self { side, ..Self::default() };
        tree.add(form, false, None);
        tree
    }

    /// Adds what a gate looks at; returns the parts that it looks at itself.
    fn add(&mut self, form: &Form<'_>, is_inverted: bool, gate: Option<JoinGate>) -> u64 {
        let step = match form.shape {
            Shape::Union | Shape::Group => JoinStep::Union,
            Shape::Intersection | Shape::Surface { .. } => JoinStep::Intersection,
            Shape::Difference => JoinStep::Difference,
            _ => {
                let bit = 1_u64.checked_shl(self.parts).unwrap_or_default();
                self.inverted |= if is_inverted { bit } else { 0 };
                self.parts += 1;
                self.steps.push(JoinStep::Part);
                return bit;
            }
        };
        let is_any = step == JoinStep::Union || form.parts.is_empty();
        let own = JoinGate {
            parts: 0,
            depth: gate.map_or(0, |around| around.depth + 1),
            needs_all: is_any == is_inverted,
        };
        let around = gate.filter(|around| around.needs_all == own.needs_all);
        let inner = around.unwrap_or(own);
        let mut parts = 0;
        if form.parts.is_empty() {
            self.steps.push(JoinStep::Nothing);
        }
        for (number, part) in form.parts.iter().enumerate() {
            let is_cut = step == JoinStep::Difference && number > 0;
            parts |= self.add(&part.form(), is_inverted ^ is_cut, Some(inner));
            if number > 0 {
                self.steps.push(step);
            }
        }
        if around.is_some() {
            return parts;
        }
        self.gates.push(JoinGate { parts, ..own });
        0
    }

    /// Whether a point has to lie in all parts, so that what these have in common is convex: an intersection of simple parts,
    /// or a surface within one.
    pub(crate) fn is_convex(&self) -> bool {
        let all = u64::MAX.checked_shr(u64::BITS.saturating_sub(self.parts)).unwrap_or_default();
        let [gate] = self.gates.as_slice() else { return false };
        gate.needs_all && gate.parts == all && self.inverted == 0
    }

    /// Whether it is a surface without inside.
    pub(crate) fn is_surface(&self) -> bool {
        self.side.is_some()
    }

    /// The sides of a surface that rays meet.
    pub(crate) fn visible_side(&self) -> VisibleSide {
        self.side.unwrap_or_default()
    }

    /// Whether a surface is there at a point of that of its first part; `around` has a bit for each part that the point
    /// lies in.
    pub(crate) fn shows(&self, around: u64) -> bool {
        self.holds(around | 1)
    }

    /// A bit for each part that the whole lies outside of.
    pub(crate) fn inverted(&self) -> u64 {
        self.inverted
    }

    pub(crate) fn gates(&self) -> &[JoinGate] {
        &self.gates
    }

    /// Whether the whole lies outside of a part.
    pub(crate) fn is_inverted(&self, part: u32) -> bool {
        self.inverted.checked_shr(part).unwrap_or_default() & 1 == 1
    }

    /// Whether a point lies in the whole that lies in the parts of these bits.
    pub(crate) fn holds(&self, parts: u64) -> bool {
        let right = parts ^ self.inverted;
        // A bit for each depth: whether a gate there is open, or shut.
        let (mut open, mut shut) = (0_u32, 0_u32);
        for gate in &self.gates {
            let (own, below) = (1_u32.wrapping_shl(gate.depth), 2_u32.wrapping_shl(gate.depth));
            let is_open = match gate.needs_all {
                true => right & gate.parts == gate.parts && shut & below == 0,
                false => right & gate.parts != 0 || open & below != 0,
            };
            (open, shut) = (open & !below, shut & !below);
            *(if is_open { &mut open } else { &mut shut }) |= own;
        }
        open & 1 == 1
    }

    /// The value of the whole from values of its parts.
    fn evaluate<T: Copy>(
        &self,
        nothing: T,
        mut part: impl FnMut(u32) -> T,
        join: impl Fn(JoinStep, T, T) -> T,
    ) -> T {
        let mut stack: SmallVec<[T; 8]> = SmallVec::new();
        let mut parts = 0..;
        for step in &self.steps {
            let value = match step {
                JoinStep::Part => parts.next().map_or(nothing, &mut part),
                JoinStep::Nothing => nothing,
                JoinStep::Union | JoinStep::Intersection | JoinStep::Difference => {
                    let last = stack.pop().unwrap_or(nothing);
                    join(*step, stack.pop().unwrap_or(nothing), last)
                }
            };
            stack.push(value);
        }
        stack.pop().unwrap_or(nothing)
    }

    /// The lines, a bit for each, that may come through the whole: `met` tells those that come through a part.
    pub(crate) fn possible(&self, met: impl Fn(u32) -> u32) -> u32 {
        self.evaluate(0, met, |step, a, b| match step {
            JoinStep::Union => a | b,
            JoinStep::Intersection => a & b,
            // How much is cut away is not known yet.
            _ => a,
        })
    }

    /// A box around the whole, given boxes around the parts.
    pub(crate) fn bounds(&self, part: impl FnMut(u32) -> Bounds) -> Bounds {
        self.evaluate(Bounds::EMPTY, part, |step, a, b| match step {
            JoinStep::Union if a.is_empty() => b,
            JoinStep::Union if b.is_empty() => a,
            JoinStep::Union => a.union(b),
            JoinStep::Intersection => a.common(b),
            _ => a,
        })
    }
}

/// A body that is joined of others.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JoinedBody {
    /// The place of its first part in the scene's bodies.
    pub(crate) first: u32,
    pub(crate) tree: JoinTree,
}

/// A part of a joined body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct JoinedPart {
    /// The place of the whole in the scene's bodies.
    pub(crate) whole: u32,
    /// Whether the whole lies outside of the part.
    pub(crate) is_inverted: bool,
}

impl JoinedBody {
    /// The places of its parts in the scene's bodies.
    pub(crate) fn parts(&self) -> Range<u32> {
        self.first..self.first + self.tree.parts
    }
}

/// The joined bodies of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct JoinedBodies {
    /// A [`RenderBody`] that is joined has its place here as its parameter.
    pub(crate) bodies: Vec<JoinedBody>,
    /// All parts, which are the last of the scene's bodies.
    pub(crate) parts: Vec<JoinedPart>,
    /// The place of the first part among the bodies.
    pub(crate) first_part: u32,
}

impl JoinedBodies {
    /// The joined ones of these bodies, whose trees these are in the order of their numbers; the parts of all, in that
    /// order, begin at `first_part`.
    pub(crate) fn new(bodies: &[RenderBody], first_part: u32, trees: impl Iterator<Item = JoinTree>) -> Self {
        let mut first = first_part;
        let joined: Vec<JoinedBody> = trees
            .map(|tree| {
                let body = JoinedBody { first, tree };
                first = body.parts().end;
                body
            })
            .collect();
        let mut wholes = vec![NO_BODY; joined.len()];
        for (body, index) in bodies.iter().zip(0..first_part).filter(|(body, _)| body.is_joined()) {
            if let Some(whole) = wholes.get_mut(body.joined_number()) {
                *whole = index;
            }
        }
        let parts = joined.iter().zip(wholes).flat_map(|(body, whole)| {
            (0..body.tree.parts)
                .map(move |part| JoinedPart { whole, is_inverted: body.tree.is_inverted(part) })
        });
        Self { parts: parts.collect(), bodies: joined, first_part }
    }

    /// Those among some of `bodies`, which are in this order; the places of their parts are added to that.
    pub(crate) fn only(&self, bodies: &[RenderBody], order: &mut Vec<u32>) -> Self {
        let first_part = order.len() as u32;
        let mut wholes: Vec<(usize, u32)> = order
            .iter()
            .zip(0..)
            .filter_map(|(&index, place)| {
                let body = bodies.get(index as usize)?;
                body.is_joined().then(|| (body.joined_number(), place))
            })
            .collect();
        wholes.sort_unstable();
        // Numbers stay: what is left out has no parts.
        let mut kept = Self { bodies: Vec::new(), parts: Vec::new(), first_part };
        for (number, body) in self.bodies.iter().enumerate() {
            let first = order.len() as u32;
            match wholes.binary_search_by_key(&number, |whole| whole.0) {
                Ok(at) => {
                    let whole = wholes[at].1;
                    order.extend(body.parts());
                    kept.parts.extend(
                        (0..body.tree.parts)
                            .map(|part| JoinedPart { whole, is_inverted: body.tree.is_inverted(part) }),
                    );
                    kept.bodies.push(JoinedBody { first, tree: body.tree.clone() });
                }
                Err(_) => kept.bodies.push(JoinedBody { first, tree: JoinTree::default() }),
            }
        }
        kept
    }

    /// The whole that body `index` is a part of, or the body itself, and whether `inwards` of the part is into the whole.
    pub(crate) fn whole_of(&self, index: u32, inwards: bool) -> RayOrigin {
        match self.part(index) {
            Some(part) => RayOrigin { body: part.whole, inwards: inwards ^ part.is_inverted },
            None => RayOrigin { body: index, inwards },
        }
    }

    /// What the body at this place is a part of, if it is.
    fn part(&self, index: u32) -> Option<&JoinedPart> {
        self.parts.get(index.checked_sub(self.first_part)? as usize)
    }

    /// The rays within bodies, given those within the surfaces that they met; or the other way round.
    #[inline(always)]
    pub(crate) fn turned<W: Width>(&self, w: W, bodies: W::W, within: W::M) -> W::M {
        if self.parts.is_empty() { within } else { self.turned_at_parts(w, bodies, within) }
    }

    #[cold]
    #[inline(never)]
    fn turned_at_parts<W: Width>(&self, w: W, bodies: W::W, within: W::M) -> W::M {
        let mut indices = [0; MOST_LANES];
        bodies.store(&mut indices);
        let inverted = indices.iter().take(W::LANES).zip(0..).fold(0, |bits, (&index, lane)| {
            let is_inverted = self.part(index).is_some_and(|part| part.is_inverted);
            bits | u32::from(is_inverted) << lane
        });
        w.mask(within.bits() ^ inverted)
    }
}

#[cfg(test)]
mod tests;
