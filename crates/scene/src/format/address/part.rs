//! Addresses of the parts of a body within it.

use crate::compound::{BodyPart, Form};
use crate::format::write::key_text;

impl Form<'_> {
    /// The address within the body of a part, by its place among those of [`Self::each_simple`]: `parts.front.parts.0`.
    /// Parts that nobody gave, as those of a lens, have the address of what they make; `None` for a simple body.
    pub fn part_address(&self, place: usize) -> Option<String> {
        let (mut address, mut form, mut left) = (String::new(), *self, place);
        while form.shape.is_compound() && form.parametric().is_none() {
            let mut parts = form.parts.iter().enumerate();
            let (index, part) = parts.find(|(_, part)| {
                let count = part.form().simple_parts(left);
                let is_here = count > left;
                left = if is_here { left } else { left - count };
                is_here
            })?;
            address.push_str(&part_step(part, index, address.is_empty()));
            form = part.form();
        }
        (!address.is_empty()).then_some(address)
    }
}

/// The address of a part from that of its whole: `parts.front` by its name, else by its place.
pub(crate) fn part_step(part: &BodyPart, index: usize, is_first: bool) -> String {
    let own = if part.name.is_empty() { index.to_string() } else { key_text(&part.name) };
    format!("{}parts.{own}", if is_first { "" } else { "." })
}
