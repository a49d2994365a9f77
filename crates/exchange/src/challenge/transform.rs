//! Lists of transforms, applied one after another.

use std::rc::Rc;

use glam::{DAffine3, DMat3, DVec3};

use crate::challenge::read::ChallengeReader;
use crate::challenge::table::list;
use crate::challenge::yaml::{MOST_DEEP, Node};
use crate::message::Message;

impl ChallengeReader {
    /// The map that a list of transforms makes, the first of which is applied first.
    pub(super) fn transform(&mut self, node: &Node) -> Option<DAffine3> {
        self.transform_at_depth(node, 0)
    }

    fn transform_at_depth(&mut self, node: &Node, depth: usize) -> Option<DAffine3> {
        let items = list(node, "transform", &mut self.draft)?;
        // One transform without a list of its own.
        let has_numbers = items.len() > 1 && items.iter().skip(1).all(|item| item.number().is_some());
        if has_numbers && items.first().is_some_and(|item| item.text().is_some()) {
            return self.single(items, node);
        }
        let mut whole = DAffine3::IDENTITY;
        for item in items {
            self.part(&item.span)?;
            whole = self.transform_item(item, depth)? * whole;
        }
        Some(whole)
    }

    /// `[translate, 0, 1, 0]`, or the name of a defined list.
    fn transform_item(&mut self, item: &Rc<Node>, depth: usize) -> Option<DAffine3> {
        if let Some(name) = item.text() {
            let Some(defined) = self.definition(name) else {
                let message = Message::Undefined { name: name.to_owned() };
                self.draft.refuse(&item.span, message, Some(Message::DefinedBelow));
                return None;
            };
            if depth >= MOST_DEEP {
                return self.too_deep(&item.span);
            }
            return self.transform_at_depth(&defined, depth + 1);
        }
        let items = list(item, "transform", &mut self.draft)?;
        self.single(items, item)
    }

    fn single(&mut self, items: &[Rc<Node>], whole: &Node) -> Option<DAffine3> {
        let name = items.first().and_then(|first| first.text()).unwrap_or_default().replace('_', "-");
        let Some(counts) = counts(&name) else {
            let message = Message::UnknownTransform { name };
            self.draft.refuse(&whole.span, message, Some(Message::TransformsAre));
            return None;
        };
        let numbers: Option<Vec<f64>> = items.iter().skip(1).take(7).map(|item| item.number()).collect();
        let Some(numbers) = numbers.filter(|numbers| counts.contains(&numbers.len())) else {
            let count = counts.iter().map(usize::to_string).collect::<Vec<_>>().join(" / ");
            self.draft.refuse(&whole.span, Message::TransformNumbers { name, count }, None);
            return None;
        };
        Some(map(&name, &numbers))
    }
}

/// How many numbers a transform has.
fn counts(name: &str) -> Option<&'static [usize]> {
    Some(match name {
        "translate" => &[3],
        "scale" => &[1, 3],
        "rotate-x" | "rotate-y" | "rotate-z" => &[1],
        "shear" => &[6],
        _ => return None,
    })
}

/// The maps of Buck 2019, chapter 4.
fn map(name: &str, numbers: &[f64]) -> DAffine3 {
    match (name, numbers) {
        ("translate", &[x, y, z]) => DAffine3::from_translation(DVec3::new(x, y, z)),
        ("scale", &[x, y, z]) => DAffine3::from_scale(DVec3::new(x, y, z)),
        ("scale", &[all]) => DAffine3::from_scale(DVec3::splat(all)),
        ("rotate-x", &[angle]) => DAffine3::from_rotation_x(angle),
        ("rotate-y", &[angle]) => DAffine3::from_rotation_y(angle),
        ("rotate-z", &[angle]) => DAffine3::from_rotation_z(angle),
        // x in proportion to y, x to z, y to x, y to z, z to x, z to y.
        ("shear", &[xy, xz, yx, yz, zx, zy]) => DAffine3::from_mat3(DMat3::from_cols(
            DVec3::new(1.0, yx, zx),
            DVec3::new(xy, 1.0, zy),
            DVec3::new(xz, yz, 1.0),
        )),
        _ => DAffine3::IDENTITY,
    }
}
