//! Constructive solid geometry as joined bodies (Buck 2019, chapter 16).

use std::ops::Range;
use std::rc::Rc;

use catoptric_scene::{Body, BodyPart, MaterialChoice, Shape};

use crate::challenge::read::{ChallengeReader, ObjectContext};
use crate::challenge::table::{self, Table};
use crate::challenge::yaml::Node;
use crate::message::Message;

/// The operations of the book.
pub(super) const OPERATIONS: [(&str, Shape); 3] =
    [("union", Shape::Union), ("intersection", Shape::Intersection), ("difference", Shape::Difference)];

impl ChallengeReader {
    /// Reads a `csg`: a body, or a part of the one around it.
    pub(super) fn csg(
        &mut self,
        mut table: Table,
        context: &ObjectContext,
        span: &Range<usize>,
    ) -> Option<()> {
        let operation = table.require(&["operation", "kind", "op"], &mut self.draft);
        let sides = ["left", "right"].map(|key| table.require(&[key], &mut self.draft));
        table.end(&mut self.draft);
        let operation = operation?;
        let name = table::name(&operation, "operation", &mut self.draft)?;
        let Some((_, shape)) = OPERATIONS.into_iter().find(|(known, _)| *known == name) else {
            let message = Message::UnknownOperation { name: name.to_owned() };
            self.draft.refuse(&operation.span, message, Some(Message::OperationsAre));
            return None;
        };
        let [left, right] = sides;
        let [left, right] = [self.operand(&left?, context)?, self.operand(&right?, context)?];
        let parts = operands(shape, left, right);
        let part = BodyPart { shape, parts, ..BodyPart::default() };
        match &mut self.operand {
            Some(around) => around.push(part),
            None => self.draft.body(whole(part), span),
        }
        Some(())
    }

    /// What one side of a `csg` consists of, as one part: of several, their union.
    fn operand(&mut self, node: &Rc<Node>, context: &ObjectContext) -> Option<BodyPart> {
        let around = self.operand.replace(Vec::new());
        let node = self.resolved(node);
        let added = self.add(&node, context);
        let mut parts = std::mem::replace(&mut self.operand, around).unwrap_or_default();
        added?;
        Some(match parts.len() {
            1 => parts.swap_remove(0),
            _ => BodyPart { shape: Shape::Union, parts, ..BodyPart::default() },
        })
    }
}

/// Both operands as parts. Chains of one operation, which the book has to nest, become one list: a whole has as many parts
/// as it likes, and is not as deep.
fn operands(shape: Shape, left: BodyPart, right: BodyPart) -> Vec<BodyPart> {
    // A − (B ∪ C) = A − B − C.
    let alike = [shape, if shape == Shape::Difference { Shape::Union } else { shape }];
    let alone = |part: BodyPart, alike| if part.shape == alike { part.parts } else { vec![part] };
    [left, right].into_iter().zip(alike).flat_map(|(part, alike)| alone(part, alike)).collect()
}

/// A body of parts. What its first part is made of, the whole is.
fn whole(mut part: BodyPart) -> Body {
    let material = first_material(&part.parts).cloned().unwrap_or_default();
    take_from(&mut part.parts, &material);
    Body { shape: part.shape, parts: part.parts, material, ..Body::default() }
}

fn first_material(parts: &[BodyPart]) -> Option<&MaterialChoice> {
    parts.iter().find_map(|part| part.material.as_ref().or_else(|| first_material(&part.parts)))
}

/// Leaves out what parts have from the whole.
fn take_from(parts: &mut [BodyPart], whole: &MaterialChoice) {
    for part in parts {
        part.material.take_if(|own| own == whole);
        take_from(&mut part.parts, whole);
    }
}
