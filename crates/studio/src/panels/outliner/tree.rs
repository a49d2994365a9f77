//! The parts of joined bodies as rows: which are unfolded, and which they are after a change.

use std::collections::HashMap;

use catoptric_editor::{EditedScene, Item, PartPath, joined_parts};
use catoptric_scene::{Body, BodyPart};

use super::body_of;

/// The joined bodies and parts that are unfolded. They are remembered by what they are: a part that has another place
/// after a change is found again by its name, else by its value, else by its place.
#[derive(Default)]
pub(super) struct UnfoldedParts(HashMap<Item, UnfoldedBody>);

/// The unfolded parts of a body, itself among them.
struct UnfoldedBody {
    paths: Vec<PartPath>,
    /// The parts that the paths lead through.
    parts: Vec<BodyPart>,
}

impl UnfoldedParts {
    /// Whether the parts of a body or of a part of it are shown.
    pub(super) fn contains(&self, item: Item, path: PartPath) -> bool {
        self.0.get(&item).is_some_and(|body| body.paths.contains(&path))
    }

    /// Shows the parts of a body or part, or no longer does.
    pub(super) fn set(&mut self, edited: &EditedScene, (item, path): (Item, PartPath), is_unfolded: bool) {
        let Some(body) = body_of(edited, item).filter(|body| path.parts(body).is_some()) else { return };
        let of_body = self.0.entry(item).or_insert_with(|| UnfoldedBody::new(body));
        of_body.follow(body);
        of_body.paths.retain(|other| *other != path);
        if is_unfolded {
            of_body.paths.push(path);
        } else if of_body.paths.is_empty() {
            self.0.remove(&item);
        }
    }

    /// Shows a part: all that is around it is unfolded.
    pub(super) fn reveal(&mut self, edited: &EditedScene, item: Item, path: PartPath) {
        for depth in 0..path.depth() {
            self.set(edited, (item, path.up_to(depth)), true);
        }
    }

    /// Follows the bodies into another version of the scene.
    pub(super) fn follow(&mut self, edited: &EditedScene) {
        self.0.retain(|item, unfolded| {
            let body = body_of(edited, *item);
            if let Some(body) = body {
                unfolded.follow(body);
            }
            // What is away may come back by undoing.
            body.is_none_or(|_| !unfolded.paths.is_empty())
        });
    }
}

impl UnfoldedBody {
    fn new(body: &Body) -> Self {
        Self { paths: Vec::new(), parts: body.parts.clone() }
    }

    fn follow(&mut self, body: &Body) {
        if self.parts == body.parts {
            return;
        }
        let found = self.paths.iter().filter_map(|path| found_again(*path, &self.parts, &body.parts));
        self.paths = found.filter(|path| path.parts(body).is_some()).collect();
        self.parts.clone_from(&body.parts);
    }
}

/// Where the part at `path` of some parts is among others.
fn found_again(path: PartPath, mut before: &[BodyPart], mut after: &[BodyPart]) -> Option<PartPath> {
    let mut found = PartPath::WHOLE;
    for place in path.places() {
        let old = before.get(place)?;
        let is_it = |new: &&BodyPart| if old.name.is_empty() { *new == old } else { new.name == old.name };
        // An unnamed one that has changed is where it was, if that is another unnamed one.
        let is_there = after.get(place).is_some_and(|new| new.name.is_empty() && old.name.is_empty());
        let at = after.iter().position(|new| is_it(&new)).or(is_there.then_some(place))?;
        let new = after.get(at)?;
        found = found.child(at)?;
        (before, after) = (&old.parts, joined_parts(&new.form())?);
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use catoptric_editor::Editor;
    use catoptric_scene::{Scene, Shape};

    use super::*;

    fn part(name: &str, parts: Vec<BodyPart>) -> BodyPart {
        let shape = if parts.is_empty() { Shape::SPHERE } else { Shape::Union };
        BodyPart { name: name.to_owned(), shape, parts, ..BodyPart::default() }
    }

    fn path(places: &[usize]) -> PartPath {
        PartPath::by(places.iter().copied()).unwrap()
    }

    #[test]
    fn what_is_unfolded_stays_so_wherever_it_goes() {
        let inner = part("inner", vec![part("", vec![part("deep", Vec::new())]), part("", Vec::new())]);
        let parts = vec![part("first", Vec::new()), inner];
        let body = Body { shape: Shape::Difference, parts, ..Body::default() };
        let mut editor = Editor::new(Scene { bodies: [body].into(), ..Scene::default() });
        let item = editor.edited().bodies().next().unwrap();
        let mut unfolded = UnfoldedParts::default();
        unfolded.reveal(editor.edited(), item, path(&[1, 0, 0]));
        unfolded.set(editor.edited(), (item, path(&[0])), true);
        let shown = |unfolded: &UnfoldedParts| {
            [vec![], vec![0], vec![1], vec![0, 0], vec![0, 1], vec![1, 0]]
                .into_iter()
                .filter(|places| unfolded.contains(item, path(places)))
                .collect::<Vec<_>>()
        };
        assert_eq!(shown(&unfolded), [vec![], vec![1], vec![1, 0]]);
        let label = catoptric_editor::Label::new("edit-a", "");
        editor
            .change_body(0, label, |body| {
                body.parts.swap(0, 1);
                body.parts[0].parts.swap(0, 1);
            })
            .unwrap();
        unfolded.follow(editor.edited());
        assert_eq!(shown(&unfolded), [vec![], vec![0], vec![0, 1]]);
        editor.undo();
        unfolded.follow(editor.edited());
        assert_eq!(shown(&unfolded), [vec![], vec![1], vec![1, 0]]);
        unfolded.set(editor.edited(), (item, path(&[1])), false);
        assert_eq!(shown(&unfolded), [vec![], vec![1, 0]]);
    }
}
