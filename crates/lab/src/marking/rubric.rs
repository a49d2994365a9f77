//! What a picture is worth and what mistakes cost: a TOML file of the teacher.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use catoptric_scene::format::spec::{KeySpec, Kind, Limits, TableSpec};
use catoptric_scene::{Diagnostic, Diagnostics, Document, Sentence, Severity, nearest};

use crate::detective::{Mistake, MistakeGroup};

/// What pictures are worth and mistakes cost, points.
#[derive(Clone, Debug, PartialEq)]
pub struct Rubric {
    /// What a picture is worth. Default 10.
    pub points: f64,
    /// The least that a picture gets which can be read. Default 0.
    pub floor: f64,
    /// What a picture gets that is not there. Default 0.
    pub missing: f64,
    /// What a file gets that cannot be read. Default 0.
    pub unreadable: f64,
    /// The part of its cost that a mistake costs again in the further pictures of a student, 0 to 1. Default 1.
    pub repeated: f64,
    /// What a picture costs of which every pixel differs without a known mistake; in proportion for less. `None` (the
    /// default) for twice what the picture is worth.
    pub unexplained: Option<f64>,
    groups: BTreeMap<MistakeGroup, f64>,
    mistakes: BTreeMap<String, f64>,
    scenes: BTreeMap<String, f64>,
}

impl Default for Rubric {
    fn default() -> Self {
        Self {
            points: 10.0,
            floor: 0.0,
            missing: 0.0,
            unreadable: 0.0,
            repeated: 1.0,
            unexplained: None,
            groups: BTreeMap::new(),
            mistakes: BTreeMap::new(),
            scenes: BTreeMap::new(),
        }
    }
}

/// Points.
const POINTS: Kind = Kind::Number(Limits::new(0.0, 1e6));
/// A part of the whole.
const PART: Kind = Kind::Number(Limits::new(0.0, 1.0));

static GROUP_KEYS: LazyLock<Vec<KeySpec>> =
    LazyLock::new(|| MistakeGroup::ALL.map(|group| KeySpec::new(group.key(), POINTS, COST)).into());
static GROUPS: LazyLock<TableSpec> = LazyLock::new(|| TableSpec {
    name: "`[groups]`",
    doc: "what a mistake of each group costs",
    keys: &GROUP_KEYS,
});
static MISTAKE_KEYS: LazyLock<Vec<KeySpec>> =
    LazyLock::new(|| Mistake::kinds().into_iter().map(|(key, _)| KeySpec::new(key, POINTS, COST)).collect());
static MISTAKES: LazyLock<TableSpec> =
    LazyLock::new(|| TableSpec { name: "`[mistakes]`", doc: "what each mistake costs", keys: &MISTAKE_KEYS });
static SCENE: TableSpec = TableSpec {
    name: "a scene of the rubric",
    doc: "what is different about the pictures of a scene",
    keys: &[KeySpec::new("points", POINTS, "what a picture of the scene is worth, points")],
};
static ROOT_KEYS: LazyLock<[KeySpec; 9]> = LazyLock::new(|| {
    [
        KeySpec::new("points", POINTS, "what a picture is worth, points"),
        KeySpec::new("floor", POINTS, "the least that a picture gets which can be read, points"),
        KeySpec::new("missing", POINTS, "what a picture gets that is not there, points"),
        KeySpec::new("unreadable", POINTS, "what a file gets that cannot be read, points"),
        KeySpec::new("repeated", PART, "the part of its cost that a mistake costs again in further pictures"),
        KeySpec::new(
            "unexplained",
            POINTS,
            "what a picture costs that differs everywhere for no known reason, points",
        ),
        KeySpec::new("groups", Kind::Table(&GROUPS), "what a mistake of each group costs"),
        KeySpec::new("mistakes", Kind::Table(&MISTAKES), "what each mistake costs"),
        KeySpec::new("scenes", Kind::Named(&SCENE), "what pictures of a scene are worth"),
    ]
});
static ROOT: LazyLock<TableSpec> =
    LazyLock::new(|| TableSpec { name: "the rubric", doc: "what mistakes cost", keys: ROOT_KEYS.as_slice() });

const COST: &str = "what it costs, points";

impl Rubric {
    /// Reads a rubric; `scenes` are the names that it may speak of. What is absent has its default.
    ///
    /// # Errors
    /// All that is wrong with it, with places.
    pub fn read(text: &str, scenes: &[&str]) -> Result<Self, Diagnostics> {
        let mut file = Document::read(text, &ROOT);
        let mut rubric = Self::default();
        let own = [
            ("points", &mut rubric.points),
            ("floor", &mut rubric.floor),
            ("missing", &mut rubric.missing),
            ("unreadable", &mut rubric.unreadable),
            ("repeated", &mut rubric.repeated),
        ];
        for (key, value) in own {
            *value = file.number(&[key]).unwrap_or(*value);
        }
        rubric.unexplained = file.number(&["unexplained"]);
        for group in MistakeGroup::ALL {
            if let Some(cost) = file.number(&["groups", group.key()]) {
                rubric.groups.insert(group, cost);
            }
        }
        for key in file.keys(&["mistakes"]) {
            if let Some(cost) = file.number(&["mistakes", key.as_str()]) {
                rubric.mistakes.insert(key, cost);
            }
        }
        for name in file.keys(&["scenes"]) {
            if !scenes.contains(&name.as_str()) {
                let place = file.place(&["scenes", name.as_str()]).unwrap_or_default();
                file.report(no_such_scene(&name, place, scenes));
            } else if let Some(points) = file.number(&["scenes", name.as_str(), "points"]) {
                rubric.scenes.insert(name, points);
            }
        }
        let found = file.into_findings();
        if found.has_errors() { Err(found) } else { Ok(rubric) }
    }

    /// What a picture of a scene is worth.
    pub fn worth(&self, scene: &str) -> f64 {
        self.scenes.get(scene).copied().unwrap_or(self.points)
    }

    /// What a mistake costs in a picture of this worth: that of its key, else of its group, else a part of the worth.
    pub fn cost(&self, key: &str, group: MistakeGroup, worth: f64) -> f64 {
        let own = self.mistakes.get(key).or_else(|| self.groups.get(&group)).copied();
        own.unwrap_or_else(|| Self::usual_part(group) * worth)
    }

    /// What a share of pixels costs that differ without a known mistake, in a picture of this worth.
    pub fn unexplained_cost(&self, share: f64, worth: f64) -> f64 {
        share * self.unexplained.unwrap_or(2.0 * worth)
    }

    /// The part of a picture's worth that a mistake of the group costs if the rubric does not say.
    pub const fn usual_part(group: MistakeGroup) -> f64 {
        match group {
            MistakeGroup::Pixel | MistakeGroup::Clamping | MistakeGroup::Rounding => 0.1,
            MistakeGroup::Size | MistakeGroup::Order | MistakeGroup::Codes | MistakeGroup::Highlights => 0.2,
            MistakeGroup::View
            | MistakeGroup::Light
            | MistakeGroup::Rays
            | MistakeGroup::ClearBodies
            | MistakeGroup::Bodies => 0.3,
        }
    }
}

fn no_such_scene(name: &str, place: std::ops::Range<usize>, scenes: &[&str]) -> Diagnostic {
    let name = catoptric_scene::quoted_name(name);
    let said = Sentence::new(|language| match language {
        catoptric_scene::Language::English => format!("the class has no scene {name}"),
        catoptric_scene::Language::Russian => format!("у группы нет сцены {name}"),
    });
    let finding = Diagnostic::said(Severity::Error, place, said);
    match nearest(name.trim_matches('"'), scenes.iter().copied()) {
        Some(near) => {
            let near = catoptric_scene::quoted_name(near);
            finding.labeled(Sentence::new(|language| match language {
                catoptric_scene::Language::English => format!("did you mean {near}?"),
                catoptric_scene::Language::Russian => format!("возможно, {near}?"),
            }))
        }
        None => finding,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_rubric_says_counts_and_the_rest_has_its_default() {
        let text = "points = 4\nrepeated = 0.5\n[groups]\nlight = 2\n[mistakes]\nno-shadows = 3\nhalf-pixel = 0\n\
                    [scenes.12-glass]\npoints = 20\n";
        let rubric = Rubric::read(text, &["12-glass"]).unwrap();
        assert_eq!((rubric.worth("06-shadow"), rubric.worth("12-glass"), rubric.repeated), (4.0, 20.0, 0.5));
        assert_eq!(rubric.cost("no-shadows", MistakeGroup::Light, 4.0), 3.0, "by its key");
        assert_eq!(rubric.cost("no-ambient", MistakeGroup::Light, 4.0), 2.0, "by its group");
        assert_eq!(rubric.cost("half-pixel", MistakeGroup::Pixel, 4.0), 0.0, "at no cost");
        assert_eq!(rubric.cost("acne", MistakeGroup::Rounding, 20.0), 2.0, "a tenth of the worth");
        assert_eq!(rubric.unexplained_cost(0.25, 4.0), 2.0, "twice the worth for all pixels");
        assert_eq!(Rubric::read("", &[]).unwrap(), Rubric::default());
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let said = |text: &str| Rubric::read(text, &["06-shadow"]).unwrap_err();
        let text =
            "points = 10\n[mistakes]\nno-shadow = 1\nacne = -2\n[groups]\nlights = 3\n[scenes.06-shadows]\n";
        let found = said(text);
        let lines: Vec<String> = found.iter().map(ToString::to_string).collect();
        assert!(lines[0].starts_with("3:1: error: `[mistakes]` has no key `no-shadow`"), "{lines:?}");
        assert!(lines[1].starts_with("4:8: error: `acne` is `-2`, but must be 0 or more"), "{lines:?}");
        assert!(lines[2].starts_with("6:1: error: `[groups]` has no key `lights`"), "{lines:?}");
        assert!(lines[3].starts_with("7:9: error: the class has no scene \"06-shadows\""), "{lines:?}");
        let labels: Vec<_> =
            found.iter().filter_map(|finding| finding.label(catoptric_scene::Language::English)).collect();
        assert_eq!(
            labels,
            ["did you mean `no-shadows`?", "did you mean `light`?", "did you mean \"06-shadow\"?"]
        );
        assert!(said("repeated = 2").to_string().contains("at most 1"));
        assert!(said("mistakes = 3").to_string().starts_with("1:12"));
    }
}
