//! The points of pictures, students and the class.

use serde_json::{Value, json};

use super::evidence::Evidence;
use super::rubric::Rubric;
use super::submissions::Submission;
use crate::detective::{MistakeGroup, Verdict};
use crate::report::Language;

/// A mistake that a picture has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoundMistake {
    /// Its name in files.
    pub key: &'static str,
    /// What it has to do with.
    pub group: MistakeGroup,
    /// The mistake in the language of the report.
    pub words: String,
}

/// The most places where a picture differs that are told.
const MOST_PLACES: usize = 5;

/// A picture that was held against its scene.
#[derive(Clone, Debug)]
pub struct SubmissionCheck {
    /// Whether it is right.
    pub is_right: bool,
    /// Its mistakes, each key once.
    pub mistakes: Vec<FoundMistake>,
    /// The share of pixels that differ even with the mistakes undone; 0 if no more than may differ.
    pub unexplained: f64,
    /// The verdict in a sentence.
    pub sentence: String,
    /// Where it differs still, a line each for the largest few places.
    pub places: Vec<String>,
    /// The verdict with names that stay.
    pub json: Value,
    /// What the page shows.
    pub evidence: Evidence,
}

impl SubmissionCheck {
    /// What a verdict says; `allowed` is the share of pixels that may differ.
    pub fn new(
        verdict: &Verdict,
        scene: &catoptric_scene::Scene,
        allowed: f64,
        evidence: Evidence,
        language: Language,
    ) -> Self {
        let mut mistakes: Vec<FoundMistake> = Vec::new();
        for mistake in &verdict.mistakes {
            if mistakes.iter().all(|own| own.key != mistake.key()) {
                let (key, group, words) = (mistake.key(), mistake.group(), mistake.words(language));
                mistakes.push(FoundMistake { key, group, words });
            }
        }
        let left = 1.0 - verdict.agreed;
        let is_right = verdict.is_right(allowed);
        let lines = verdict.lines(scene, language).into_iter().take(MOST_PLACES);
        // Beside mistakes, so few pixels may differ as in a right picture.
        let is_explained = is_right || (!mistakes.is_empty() && left <= allowed);
        Self {
            is_right,
            mistakes,
            unexplained: if is_explained { 0.0 } else { left },
            sentence: verdict.sentence(scene, language),
            places: if is_right { Vec::new() } else { lines.collect() },
            json: verdict.to_json(scene, allowed),
            evidence,
        }
    }
}

/// What became of a picture that a student owes.
#[derive(Clone, Debug)]
pub enum SubmissionOutcome {
    /// It was held against its scene.
    Checked(Box<SubmissionCheck>),
    /// There is none.
    Missing,
    /// Its file cannot be read, for this reason.
    Unreadable(String),
    /// Its scene cannot be used, for this reason: it counts for nobody.
    Unmarked(String),
}

impl SubmissionOutcome {
    /// The name in files.
    pub const fn key(&self) -> &'static str {
        match self {
            Self::Checked(check) if check.is_right => "right",
            Self::Checked(_) => "different",
            Self::Missing => "missing",
            Self::Unreadable(_) => "unreadable",
            Self::Unmarked(_) => "unmarked",
        }
    }

    /// What was found out about the picture, if it could be read.
    pub fn check(&self) -> Option<&SubmissionCheck> {
        match self {
            Self::Checked(check) => Some(check),
            _ => None,
        }
    }
}

/// Points that a picture loses.
#[derive(Clone, Debug, PartialEq)]
pub struct Deduction {
    /// The key of the mistake, or `unexplained`.
    pub key: &'static str,
    /// What it is for, in the language of the report.
    pub words: String,
    /// How many.
    pub points: f64,
    /// Whether another picture of the student has lost points for it already.
    pub is_repeated: bool,
}

/// The key of pixels that differ for no known reason.
pub const UNEXPLAINED: &str = "unexplained";

/// The points of a picture.
#[derive(Clone, Debug)]
pub struct PictureMark {
    /// Which picture it is.
    pub submission: Submission,
    /// What became of it.
    pub outcome: SubmissionOutcome,
    /// What it loses.
    pub deductions: Vec<Deduction>,
    /// What it gets.
    pub points: f64,
    /// What it is worth; 0 if it does not count.
    pub worth: f64,
}

/// The points of a student.
#[derive(Clone, Debug)]
pub struct StudentMarks {
    /// Whose they are.
    pub student: String,
    /// The pictures.
    pub pictures: Vec<PictureMark>,
}

impl StudentMarks {
    /// What all pictures get together.
    pub fn points(&self) -> f64 {
        rounded(self.pictures.iter().map(|mark| mark.points).sum())
    }

    /// What they are worth together.
    pub fn worth(&self) -> f64 {
        rounded(self.pictures.iter().map(|mark| mark.worth).sum())
    }

    /// How many pictures became what the key says; see [`SubmissionOutcome::key`].
    pub fn count(&self, outcome: &str) -> usize {
        self.pictures.iter().filter(|mark| mark.outcome.key() == outcome).count()
    }
}

/// The points of a class.
#[derive(Clone, Debug, Default)]
pub struct ClassMarks {
    /// The students, in the order in which their pictures were given.
    pub students: Vec<StudentMarks>,
    /// The scenes, in that order, too.
    pub scenes: Vec<String>,
}

impl ClassMarks {
    /// Gives points by a rubric. The words are in `language`.
    pub fn new(
        pictures: impl IntoIterator<Item = (Submission, SubmissionOutcome)>,
        rubric: &Rubric,
        language: Language,
    ) -> Self {
        let mut class = Self::default();
        for (submission, outcome) in pictures {
            if !class.scenes.contains(&submission.scene) {
                class.scenes.push(submission.scene.clone());
            }
            let place = class.students.iter().position(|marks| marks.student == submission.student);
            let place = place.unwrap_or_else(|| {
                class
                    .students
                    .push(StudentMarks { student: submission.student.clone(), pictures: Vec::new() });
                class.students.len() - 1
            });
            if let Some(marks) = class.students.get_mut(place) {
                let mark = mark(submission, outcome, &marks.pictures, rubric, language);
                marks.pictures.push(mark);
            }
        }
        class
    }

    /// Whether every picture is there and right.
    pub fn are_right(&self) -> bool {
        self.marks().all(|mark| mark.outcome.key() == "right")
    }

    /// All pictures, those of a student together.
    pub fn marks(&self) -> impl Iterator<Item = &PictureMark> {
        self.students.iter().flat_map(|student| &student.pictures)
    }

    /// How often each mistake was made: what it is called, in how many pictures, by how many students; the most frequent
    /// first.
    pub fn frequencies(&self) -> Vec<MistakeFrequency> {
        let mut all: Vec<MistakeFrequency> = Vec::new();
        for student in &self.students {
            let mut own: Vec<&str> = Vec::new();
            for deduction in student.pictures.iter().flat_map(|mark| &mark.deductions) {
                let place = all.iter().position(|frequency| frequency.key == deduction.key);
                let place = place.unwrap_or_else(|| {
                    let (key, words) = (deduction.key, deduction.words.clone());
                    all.push(MistakeFrequency { key, words, pictures: 0, students: 0 });
                    all.len() - 1
                });
                let Some(frequency) = all.get_mut(place) else { continue };
                frequency.pictures += 1;
                if !own.contains(&deduction.key) {
                    own.push(deduction.key);
                    frequency.students += 1;
                }
            }
        }
        // Stable: mistakes that are as frequent stay in the order in which they were met.
        all.sort_by_key(|frequency| std::cmp::Reverse(frequency.pictures));
        all
    }

    /// All of it with names that stay.
    pub fn to_json(&self) -> Value {
        let students: Vec<Value> = self
            .students
            .iter()
            .map(|student| {
                json!({
                    "student": student.student,
                    "points": student.points(),
                    "of": student.worth(),
                    "pictures": student.pictures.iter().map(PictureMark::to_json).collect::<Vec<_>>(),
                })
            })
            .collect();
        json!({ "right": self.are_right(), "students": students })
    }
}

/// How often a mistake was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MistakeFrequency {
    /// Its key.
    pub key: &'static str,
    /// What it is called, in the language of the report.
    pub words: String,
    /// In how many pictures.
    pub pictures: usize,
    /// By how many students.
    pub students: usize,
}

impl PictureMark {
    fn to_json(&self) -> Value {
        let deductions: Vec<Value> = self
            .deductions
            .iter()
            .map(|deduction| {
                json!({ "key": deduction.key, "points": deduction.points, "repeated": deduction.is_repeated })
            })
            .collect();
        let mut value = json!({
            "scene": self.submission.scene,
            "picture": self.submission.picture,
            "points": self.points,
            "of": self.worth,
            "outcome": self.outcome.key(),
            "deductions": deductions,
        });
        if let Some(map) = value.as_object_mut() {
            match &self.outcome {
                SubmissionOutcome::Checked(check) => {
                    map.insert("verdict".to_owned(), check.json.clone());
                    if let Some(worst) = check.evidence.worst.as_ref().filter(|_| !check.is_right) {
                        map.insert("worst_pixel".to_owned(), worst.to_json());
                    }
                }
                SubmissionOutcome::Unreadable(reason) | SubmissionOutcome::Unmarked(reason) => {
                    map.insert("reason".to_owned(), json!(reason));
                }
                SubmissionOutcome::Missing => {}
            }
        }
        value
    }
}

/// The points of a picture of a student who has these marks already.
fn mark(
    submission: Submission,
    outcome: SubmissionOutcome,
    earlier: &[PictureMark],
    rubric: &Rubric,
    language: Language,
) -> PictureMark {
    let worth = rubric.worth(&submission.scene);
    let (deductions, points, worth) = match &outcome {
        SubmissionOutcome::Checked(check) => {
            let deductions = deductions(check, worth, earlier, rubric, language);
            let lost: f64 = deductions.iter().map(|deduction| deduction.points).sum();
            (deductions, rounded((worth - lost).max(rubric.floor).min(worth)), worth)
        }
        SubmissionOutcome::Missing => (Vec::new(), rubric.missing.min(worth), worth),
        SubmissionOutcome::Unreadable(_) => (Vec::new(), rubric.unreadable.min(worth), worth),
        SubmissionOutcome::Unmarked(_) => (Vec::new(), 0.0, 0.0),
    };
    PictureMark { submission, outcome, deductions, points, worth }
}

fn deductions(
    check: &SubmissionCheck,
    worth: f64,
    earlier: &[PictureMark],
    rubric: &Rubric,
    language: Language,
) -> Vec<Deduction> {
    let is_repeated = |key: &str| earlier.iter().flat_map(|mark| &mark.deductions).any(|own| own.key == key);
    let of_mistake = |mistake: &FoundMistake| {
        let is_repeated = is_repeated(mistake.key);
        let part = if is_repeated { rubric.repeated } else { 1.0 };
        let points = rounded(part * rubric.cost(mistake.key, mistake.group, worth));
        Deduction { key: mistake.key, words: mistake.words.clone(), points, is_repeated }
    };
    let mut all: Vec<Deduction> = check.mistakes.iter().map(of_mistake).collect();
    if check.unexplained > 0.0 {
        all.push(Deduction {
            key: UNEXPLAINED,
            words: language.marking_unexplained().to_owned(),
            points: rounded(rubric.unexplained_cost(check.unexplained, worth)),
            is_repeated: false,
        });
    }
    all
}

/// Points to two places, so that those that are shown add up.
fn rounded(points: f64) -> f64 {
    (100.0 * points).round() / 100.0
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A picture with these mistakes of which a share differs besides.
    pub(in crate::marking) fn checked(keys: &[&'static str], unexplained: f64) -> SubmissionOutcome {
        let kinds = crate::detective::Mistake::kinds();
        let mistake = |key: &&'static str| {
            let (key, group) = kinds.iter().find(|(own, _)| own == key).copied().unwrap();
            FoundMistake { key, group, words: format!("{key} in words") }
        };
        SubmissionOutcome::Checked(Box::new(SubmissionCheck {
            is_right: keys.is_empty() && unexplained == 0.0,
            mistakes: keys.iter().map(mistake).collect(),
            unexplained,
            sentence: "a <sentence>".to_owned(),
            places: vec!["a place".to_owned()],
            json: json!({ "share_agreeing": 0.5, "share_explained": 1.0 - unexplained }),
            evidence: Evidence::for_tests(),
        }))
    }

    pub(in crate::marking) fn submission(student: &str, scene: &str) -> Submission {
        let picture = Some(format!("{student}/{scene}.png"));
        Submission { student: student.to_owned(), scene: scene.to_owned(), picture }
    }

    fn points(rubric: &str, outcomes: Vec<SubmissionOutcome>) -> Vec<f64> {
        let rubric = Rubric::read(rubric, &["0"]).unwrap();
        let pictures = outcomes
            .into_iter()
            .enumerate()
            .map(|(scene, outcome)| (submission("a", &scene.to_string()), outcome));
        let class = ClassMarks::new(pictures, &rubric, Language::English);
        class.marks().map(|mark| mark.points).collect()
    }

    #[test]
    fn points_are_those_computed_by_hand() {
        let rubric = "points = 10\nunexplained = 20\n[groups]\nlight = 3\n[mistakes]\nacne = 0.5\n";
        let all = vec![
            checked(&[], 0.0),                       // 10
            checked(&["no-shadows"], 0.0),           // 10 − 3
            checked(&["no-ambient", "acne"], 0.125), // 10 − 3 − 0.5 − 20/8
            checked(&["no-diffuse"], 0.5),           // 10 − 3 − 10, at least 0
        ];
        assert_eq!(points(rubric, all), [10.0, 7.0, 4.0, 0.0]);
    }

    #[test]
    fn floors_missing_files_and_repeats_have_their_points() {
        let rubric = "points = 8\nfloor = 1\nmissing = 0.5\nunreadable = 0.25\nrepeated = 0.5\n[mistakes]\n\
                      no-shadows = 4\nhalf-pixel = 9\n[scenes.0]\npoints = 20\n";
        let all = vec![
            checked(&["no-shadows"], 0.0), // 20 − 4
            checked(&["no-shadows"], 0.0), // 8 − 2, for it is the second time
            checked(&["half-pixel"], 0.0), // 8 − 9, at least 1
            SubmissionOutcome::Missing,
            SubmissionOutcome::Unreadable("no picture".to_owned()),
            SubmissionOutcome::Unmarked("no scene".to_owned()),
        ];
        assert_eq!(points(rubric, all), [16.0, 6.0, 1.0, 0.5, 0.25, 0.0]);
    }

    #[test]
    fn the_usual_costs_are_parts_of_the_worth() {
        let all = vec![checked(&["no-shadows"], 0.0), checked(&["half-pixel"], 0.0), checked(&[], 0.1)];
        assert_eq!(points("points = 5\n", all), [3.5, 4.5, 4.0]);
    }

    #[test]
    fn frequent_mistakes_come_first() {
        let pictures = [
            (submission("a", "s"), checked(&["acne"], 0.0)),
            (submission("a", "t"), checked(&["no-shadows"], 0.0)),
            (submission("a", "u"), checked(&["no-shadows"], 0.0)),
            (submission("b", "s"), checked(&["no-shadows"], 0.2)),
        ];
        let class = ClassMarks::new(pictures, &Rubric::default(), Language::English);
        let counts: Vec<_> =
            class.frequencies().iter().map(|own| (own.key, own.pictures, own.students)).collect();
        assert_eq!(counts, [("no-shadows", 3, 2), ("acne", 1, 1), (UNEXPLAINED, 1, 1)]);
        assert_eq!(class.scenes, ["s", "t", "u"]);
    }
}
