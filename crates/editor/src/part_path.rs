//! Ways to the parts of joined bodies.

use catoptric_scene::{Body, BodyPart, Form, MaterialChoice, Shape};
use glam::{DAffine3, DMat3};

/// The way to a part of a joined body: its place among the parts of the whole, then that among the parts of this one, and
/// so on. The way of no steps leads to the whole itself. Parts of a lens or of another shape with sizes of its own cannot
/// be reached: the shape makes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PartPath {
    /// Places beyond the depth are 0.
    places: [u32; Shape::MAX_DEPTH],
    depth: u8,
}

impl PartPath {
    /// The way to the whole itself.
    pub const WHOLE: Self = Self { places: [0; Shape::MAX_DEPTH], depth: 0 };

    /// The way by these places; `None` when it is deeper than parts can be nested.
    pub fn by(places: impl IntoIterator<Item = usize>) -> Option<Self> {
        places.into_iter().try_fold(Self::WHOLE, Self::child)
    }

    /// The way to a part of what this one leads to; `None` when that is deeper than parts can be nested.
    #[must_use]
    pub fn child(mut self, place: usize) -> Option<Self> {
        let slot = self.places.get_mut(usize::from(self.depth))?;
        *slot = u32::try_from(place).ok()?;
        self.depth += 1;
        Some(self)
    }

    /// The way to what this is a part of; `None` for the whole.
    pub fn parent(self) -> Option<Self> {
        Some(self.up_to(self.depth().checked_sub(1)?))
    }

    /// The way to another part of the same; `None` for the whole.
    pub fn sibling(self, place: usize) -> Option<Self> {
        self.parent()?.child(place)
    }

    /// The first steps of this way.
    #[must_use]
    pub fn up_to(mut self, depth: usize) -> Self {
        while self.depth() > depth {
            self.depth -= 1;
            if let Some(place) = self.places.get_mut(usize::from(self.depth)) {
                *place = 0;
            }
        }
        self
    }

    /// The number of steps.
    pub fn depth(self) -> usize {
        usize::from(self.depth)
    }

    /// Whether it leads to the whole itself.
    pub fn is_whole(self) -> bool {
        self.depth == 0
    }

    /// The steps.
    pub fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.places.iter().take(self.depth()).map(|place| *place as usize)
    }

    /// The last step; `None` for the whole.
    pub fn place(self) -> Option<usize> {
        self.places().last()
    }

    /// Whether `other` leads to the same or to something around it.
    pub fn is_within(self, other: Self) -> bool {
        self.depth() >= other.depth() && self.up_to(other.depth()) == other
    }

    /// How many first steps two ways have in common.
    pub fn common(self, other: Self) -> usize {
        self.places().zip(other.places()).take_while(|(own, other)| own == other).count()
    }

    /// The way to the same part once another has been put at `new`.
    #[must_use]
    pub(crate) fn after_insertion(self, new: Self) -> Self {
        self.shifted(new, |own, new| if own >= new { own.checked_add(1) } else { Some(own) }).unwrap_or(self)
    }

    /// The way to the same part once that at `gone` is away; `None` when it has gone, too.
    pub(crate) fn after_removal(self, gone: Self) -> Option<Self> {
        self.shifted(gone, |own, gone| if own > gone { Some(own - 1) } else { (own < gone).then_some(own) })
    }

    /// The way with the step changed that chooses among the parts where `other` ends.
    fn shifted(mut self, other: Self, shift: impl Fn(u32, u32) -> Option<u32>) -> Option<Self> {
        let parent = other.parent()?;
        if self.depth() > parent.depth() && self.is_within(parent) {
            let at = parent.depth();
            let new = shift(*self.places.get(at)?, *other.places.get(at)?)?;
            *self.places.get_mut(at)? = new;
        }
        Some(self)
    }

    /// The part that it leads to in `body`; `None` when there is none, or for the whole.
    pub fn part(self, body: &Body) -> Option<&BodyPart> {
        let mut found: Option<&BodyPart> = None;
        let mut parts = joined_parts(&body.form())?;
        for place in self.places() {
            if let Some(around) = found {
                parts = joined_parts(&around.form())?;
            }
            found = Some(parts.get(place)?);
        }
        found
    }

    /// The part that it leads to in `body`, to be changed; `None` when there is none, or for the whole.
    pub fn part_mut(self, body: &mut Body) -> Option<&mut BodyPart> {
        self.part(body)?;
        let mut places = self.places();
        let mut found = body.parts.get_mut(places.next()?)?;
        for place in places {
            found = found.parts.get_mut(place)?;
        }
        Some(found)
    }

    /// The shape, place and parts of what it leads to.
    pub fn form(self, body: &Body) -> Option<Form<'_>> {
        if self.is_whole() { Some(body.form()) } else { self.part(body).map(BodyPart::form) }
    }

    /// The parts of what it leads to, if that is joined.
    pub fn parts(self, body: &Body) -> Option<&[BodyPart]> {
        joined_parts(&self.form(body)?)
    }

    /// The parts of what it leads to, to be changed, if that is joined.
    pub(crate) fn parts_mut(self, body: &mut Body) -> Option<&mut Vec<BodyPart>> {
        self.parts(body)?;
        if self.is_whole() { Some(&mut body.parts) } else { Some(&mut self.part_mut(body)?.parts) }
    }

    /// The transform from the own frame of what it leads to to the world.
    pub fn frame(self, body: &Body) -> DAffine3 {
        let steps = (1..=self.depth()).filter_map(|depth| self.up_to(depth).part(body));
        let within = steps.map(|part| part.placement.world_from_body());
        within.fold(body.placement.world_from_body(), |frame, step| frame * step)
    }

    /// The transform from the frame in which it is placed to the world.
    pub fn frame_around(self, body: &Body) -> DAffine3 {
        self.parent().map_or(DAffine3::IDENTITY, |around| around.frame(body))
    }

    /// The turn of its own frame in the world, scales left out.
    pub fn rotation(self, body: &Body) -> DMat3 {
        let steps = (1..=self.depth()).filter_map(|depth| self.up_to(depth).part(body));
        steps.fold(body.placement.rotation(), |turn, part| turn * part.placement.rotation())
    }

    /// What it is made of: of its own, or of what is around it.
    pub fn material(self, body: &Body) -> &MaterialChoice {
        let steps = (1..=self.depth()).rev().filter_map(|depth| self.up_to(depth).part(body));
        steps.flat_map(|part| &part.material).next().unwrap_or(&body.material)
    }

    /// The part as a body in the frame in which it is placed, of the material that is seen; `None` as for
    /// [`Self::part`].
    pub fn as_body(self, body: &Body) -> Option<Body> {
        let part = self.part(body)?;
        Some(Body {
            name: part.name.clone(),
            shape: part.shape,
            placement: part.placement,
            material: self.material(body).clone(),
            hidden: body.hidden,
            shadow: body.shadow,
            contact: body.contact,
            locked: body.locked,
            parts: part.parts.clone(),
            parametric: part.parametric.clone(),
            instance: part.instance.clone(),
        })
    }
}

/// The parts of what is joined; `None` for simple shapes, for those with sizes of their own, and for instances, whose parts
/// are those of another body.
pub fn joined_parts<'a>(form: &Form<'a>) -> Option<&'a [BodyPart]> {
    let is_own = form.instance.is_none() && form.parametric().is_none();
    (form.shape.is_compound() && is_own).then_some(form.parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(places: &[usize]) -> PartPath {
        PartPath::by(places.iter().copied()).unwrap()
    }

    #[test]
    fn ways_follow_what_is_put_in_and_taken_away() {
        let own = path(&[2, 1, 0]);
        assert_eq!(own.after_insertion(path(&[2])), path(&[3, 1, 0]));
        assert_eq!(own.after_insertion(path(&[3])), own);
        assert_eq!(own.after_insertion(path(&[2, 0])), path(&[2, 2, 0]));
        assert_eq!(own.after_insertion(path(&[1, 0])), own);
        assert_eq!(own.after_removal(path(&[0])), Some(path(&[1, 1, 0])));
        assert_eq!(own.after_removal(path(&[2, 1])), None);
        assert_eq!(own.after_removal(path(&[2, 1, 0, 5])), Some(own));
        assert_eq!(own.after_removal(path(&[2, 1, 1])), Some(own));
    }

    #[test]
    fn ways_end_at_the_greatest_depth() {
        let deepest = PartPath::by([1; Shape::MAX_DEPTH]).unwrap();
        assert_eq!(deepest.child(0), None);
        assert_eq!(deepest.up_to(2), path(&[1, 1]));
        assert!(deepest.is_within(path(&[1, 1])) && !path(&[1]).is_within(path(&[1, 1])));
        assert_eq!((PartPath::WHOLE.parent(), PartPath::WHOLE.place()), (None, None));
        assert_eq!(path(&[1, 2]).common(path(&[1, 3])), 1);
    }
}
