//! The rows of the tree, as a flat list: only the visible ones are drawn.

use catoptric_editor::{EditedScene, Editor, Item, PartPath, Selection};
use catoptric_scene::Scene;

use super::tree::UnfoldedParts;
use super::{body_of, item_name, part_title};
use crate::base::texts::{Language, Texts};

/// A part of the tree that can be folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum OutlinerSection {
    Lights,
    Bodies,
    Materials,
}

impl OutlinerSection {
    const ALL: [Self; 3] = [Self::Lights, Self::Bodies, Self::Materials];

    /// The message that names it.
    pub(super) const fn key(self) -> &'static str {
        match self {
            Self::Lights => "outliner-lights",
            Self::Bodies => "outliner-bodies",
            Self::Materials => "outliner-materials",
        }
    }

    /// The section in which a thing stands.
    pub(super) const fn of(item: Item) -> Option<Self> {
        match item {
            Item::Light(_) => Some(Self::Lights),
            Item::Body(_) => Some(Self::Bodies),
            Item::Material(_) => Some(Self::Materials),
            Item::Camera | Item::Environment | Item::Tracing => None,
        }
    }

    fn items(self, edited: &EditedScene) -> Box<dyn Iterator<Item = Item> + '_> {
        match self {
            Self::Lights => Box::new(edited.lights()),
            Self::Bodies => Box::new(edited.bodies()),
            Self::Materials => Box::new(edited.materials()),
        }
    }
}

/// A row of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutlinerRow {
    /// The head of a section, with how many things are in it.
    Head(OutlinerSection, usize),
    /// A thing.
    Item(Item),
    /// A part of a joined body.
    Part(Item, PartPath),
}

impl OutlinerRow {
    /// The thing of a row, with the way to its part.
    pub(super) const fn place(self) -> Option<(Item, PartPath)> {
        match self {
            Self::Head(..) => None,
            Self::Item(item) => Some((item, PartPath::WHOLE)),
            Self::Part(item, path) => Some((item, path)),
        }
    }
}

/// The rows, rebuilt when something has changed.
#[derive(Default)]
pub(super) struct OutlinerRows {
    rows: Vec<OutlinerRow>,
    folded: Vec<OutlinerSection>,
    unfolded: UnfoldedParts,
    /// What the rows were found for.
    made_for: Option<(*const Scene, u64, String, Language, Vec<OutlinerSection>)>,
}

impl OutlinerRows {
    pub(super) fn all(&self) -> &[OutlinerRow] {
        &self.rows
    }

    pub(super) fn is_folded(&self, section: OutlinerSection) -> bool {
        self.folded.contains(&section)
    }

    /// Folds a section, or unfolds it.
    pub(super) fn fold(&mut self, section: OutlinerSection, folded: bool) {
        self.folded.retain(|other| *other != section);
        if folded {
            self.folded.push(section);
        }
    }

    /// Whether the parts of a joined body or part are shown.
    pub(super) fn shows_parts(&self, item: Item, path: PartPath) -> bool {
        self.unfolded.contains(item, path)
    }

    /// Shows the parts of a joined body or part, or no longer does.
    pub(super) fn show_parts(&mut self, edited: &EditedScene, place: (Item, PartPath), is_unfolded: bool) {
        self.unfolded.set(edited, place, is_unfolded);
        self.made_for = None;
    }

    /// Unfolds all that is around a part.
    pub(super) fn reveal(&mut self, edited: &EditedScene, item: Item, path: PartPath) {
        self.unfold(item);
        if !path.is_whole() {
            self.unfolded.reveal(edited, item, path);
            self.made_for = None;
        }
    }

    /// Unfolds the section of a thing.
    pub(super) fn unfold(&mut self, item: Item) {
        if let Some(section) = OutlinerSection::of(item) {
            self.fold(section, false);
        }
    }

    /// Finds the rows, if anything has changed. With a filter only things whose name has it are shown, folded or not.
    pub(super) fn update(&mut self, texts: &Texts, editor: &Editor, filter: &str) {
        let edited = editor.edited();
        let key = (
            std::sync::Arc::as_ptr(edited.scene()),
            editor.revision(),
            filter.to_owned(),
            texts.language(),
            self.folded.clone(),
        );
        if self.made_for.as_ref() == Some(&key) {
            return;
        }
        self.unfolded.follow(edited);
        let filter = filter.trim().to_lowercase();
        let fits = |item: &Item| {
            filter.is_empty() || item_name(texts, edited, *item).to_lowercase().contains(&filter)
        };
        self.rows.clear();
        let fixed = [Item::Camera, Item::Environment, Item::Tracing];
        self.rows.extend(fixed.into_iter().filter(fits).map(OutlinerRow::Item));
        for section in OutlinerSection::ALL {
            let head = self.rows.len();
            self.rows.push(OutlinerRow::Head(section, 0));
            let mut count = 0;
            for item in section.items(edited) {
                let row = self.rows.len();
                self.rows.push(OutlinerRow::Item(item));
                self.push_parts(texts, edited, (item, PartPath::WHOLE), &filter);
                // A body with a part that is looked for is shown around it.
                if fits(&item) || self.rows.len() > row + 1 {
                    count += 1;
                } else {
                    self.rows.truncate(row);
                }
            }
            if let Some(row) = self.rows.get_mut(head) {
                *row = OutlinerRow::Head(section, count);
            }
            if filter.is_empty() && self.folded.contains(&section) {
                self.rows.truncate(head + 1);
            }
        }
        self.made_for = Some(key);
    }

    /// Adds the rows of the parts of a joined body or part: those that are unfolded, with a filter those it finds.
    fn push_parts(
        &mut self,
        texts: &Texts,
        edited: &EditedScene,
        (item, path): (Item, PartPath),
        filter: &str,
    ) {
        let Some(body) = body_of(edited, item) else { return };
        let Some(parts) = path.parts(body) else { return };
        if filter.is_empty() && !self.shows_parts(item, path) {
            return;
        }
        for (place, part) in parts.iter().enumerate() {
            let Some(own) = path.child(place) else { return };
            let row = self.rows.len();
            self.rows.push(OutlinerRow::Part(item, own));
            self.push_parts(texts, edited, (item, own), filter);
            let fits = || part_title(texts, part, place).to_lowercase().contains(filter);
            if self.rows.len() == row + 1 && !fits() {
                self.rows.truncate(row);
            }
        }
    }

    /// The things and parts in the order of their rows.
    pub(super) fn places(&self) -> impl DoubleEndedIterator<Item = (Item, PartPath)> {
        self.rows.iter().filter_map(|row| row.place())
    }

    /// The row of a thing.
    pub(super) fn place_of(&self, item: Item) -> Option<usize> {
        self.rows.iter().position(|row| *row == OutlinerRow::Item(item))
    }

    /// The row of a thing or of a part of it.
    pub(super) fn row_of(&self, (item, path): (Item, PartPath)) -> Option<usize> {
        self.rows.iter().position(|row| row.place() == Some((item, path)))
    }

    /// Everything from one row to another, the latter being the primary thing. What is there only once is not taken
    /// along.
    pub(super) fn range(&self, from: Item, to: Item) -> Selection {
        let (Some(start), Some(end)) = (self.place_of(from), self.place_of(to)) else {
            return Selection::one(to);
        };
        let (low, high) = (start.min(end), start.max(end));
        let mut items: Vec<Item> = self
            .rows
            .get(low..=high)
            .unwrap_or_default()
            .iter()
            .filter_map(|row| if let OutlinerRow::Item(item) = row { Some(*item) } else { None })
            .filter(|item| *item == to || OutlinerSection::of(*item).is_some())
            .collect();
        if end < start {
            items.reverse();
        }
        items.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Body, Light, Scene};

    use super::*;

    fn editor() -> Editor {
        let named = |name: &str| Body { name: name.to_owned(), ..Body::default() };
        let scene = Scene {
            bodies: ["ball", "mirror ball", "floor"].map(named).into(),
            lights: vec![Light::default()],
            ..Scene::default()
        };
        Editor::new(scene)
    }

    fn bodies(editor: &Editor) -> [Item; 3] {
        editor.edited().bodies().collect::<Vec<_>>().try_into().unwrap()
    }

    #[test]
    fn folding_hides_rows_and_a_filter_finds_them_again() {
        let (texts, editor) = (Texts::new(Language::English), editor());
        let mut rows = OutlinerRows::default();
        rows.update(&texts, &editor, "");
        assert_eq!(rows.all().len(), 3 + 3 + 1 + 3);
        rows.fold(OutlinerSection::Bodies, true);
        rows.update(&texts, &editor, "");
        let [ball, mirror, floor] = bodies(&editor);
        assert_eq!(rows.place_of(mirror), None);
        assert!(rows.all().contains(&OutlinerRow::Head(OutlinerSection::Bodies, 3)));
        rows.update(&texts, &editor, "BALL");
        assert_eq!(rows.places().map(|place| place.0).collect::<Vec<_>>(), [ball, mirror]);
        assert!(rows.all().contains(&OutlinerRow::Head(OutlinerSection::Bodies, 2)));
        rows.unfold(floor);
        rows.update(&texts, &editor, "");
        assert!(rows.place_of(floor).is_some());
    }

    #[test]
    fn a_range_ends_with_the_primary_and_leaves_out_what_is_there_once() {
        let (texts, editor) = (Texts::new(Language::English), editor());
        let mut rows = OutlinerRows::default();
        rows.update(&texts, &editor, "");
        let [ball, mirror, floor] = bodies(&editor);
        let up = rows.range(floor, ball);
        assert_eq!(up.iter().collect::<Vec<_>>(), [floor, mirror, ball]);
        let across = rows.range(Item::Camera, ball);
        let light = editor.edited().lights().next().unwrap();
        assert_eq!(across.iter().collect::<Vec<_>>(), [light, ball]);
    }
}
