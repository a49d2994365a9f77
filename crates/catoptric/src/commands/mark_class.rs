//! `catoptric compare --class`: points for the pictures of a class.

mod roster;

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use catoptric_lab::detective::{Detective, Mistake, Orientation, Verdict};
use catoptric_lab::marking::{
    ClassMarks, Evidence, ExactPicture, Rubric, Submission, SubmissionCheck, SubmissionOutcome, class_page,
};
use catoptric_lab::report::Language;
use catoptric_scene::{Scene, visible};
use catoptric_store::LoadError;
use catoptric_tracer::{RenderControl, RenderScene, render};

use super::checking::{CheckKey, ExactScene, PictureFile, PictureHead, exact_settings};
use super::compare::{METRICS, REPORT};
use super::{CommandOutcome, in_words, report};
use crate::arguments::CompareArguments;
use crate::backend::threads;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::layers::LayerReader;
use crate::progress::Progress;

use roster::{ClassScene, Roster};

const PICTURES: &str = "pictures.csv";
const STUDENTS: &str = "students.csv";
const JUNIT: &str = "junit.xml";
const GRADESCOPE: &str = "gradescope";
const SUBMITTY: &str = "submitty";
/// The directory of the marks if none is given.
const OUTPUT: &str = "marked";

pub(super) fn run(class: &Path, arguments: &CompareArguments) -> Result<CommandOutcome> {
    let mut files = CommandFiles::default();
    let output = arguments.output.as_deref().unwrap_or(Path::new(OUTPUT));
    let roster = Roster::read(class, arguments, output, &mut files)?;
    let rubric = rubric(arguments, &roster, &mut files)?;
    files.add_directory(output, [REPORT, METRICS, PICTURES, STUDENTS, JUNIT].map(str::to_owned))?;
    let names = roster.students();
    for (folder, _) in forms() {
        files.add_directory(&output.join(folder), names.iter().map(|name| format!("{name}.json")))?;
    }
    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let scenes =
        roster.scenes.iter().map(|scene| exact_scene(scene, arguments, &mut files)).collect::<Vec<_>>();
    let outcomes = Progress::new(arguments.quiet).of_steps(roster.submissions.len(), |tell| {
        let mut marker = Marker { roster: &roster, arguments, files: &mut files, done: 0, tell };
        pool.install(|| marker.outcomes(&scenes))
    })?;
    let is_whole = !outcomes.iter().any(|outcome| matches!(outcome, SubmissionOutcome::Unmarked(_)));
    let marks = ClassMarks::new(roster.submissions.into_iter().zip(outcomes), &rubric, arguments.language);
    let progress = Progress::new(arguments.quiet);
    progress.of_writing(&output.to_string_lossy(), || {
        write(&marks, &roster.left_over, arguments, output, &files)
    })?;
    if arguments.json {
        print(&json_text(&marks.to_json()))?;
    } else if !arguments.quiet {
        print(&summary(&marks, arguments.language, &output.join(REPORT)))?;
    }
    Ok(match (is_whole, marks.are_right()) {
        (false, _) => CommandOutcome::WrongInput,
        (true, true) => CommandOutcome::Done,
        (true, false) => CommandOutcome::Failed,
    })
}

type FormOfStudent = fn(&catoptric_lab::marking::StudentMarks, Language) -> serde_json::Value;

/// What other programs read of each student, by the folder.
fn forms() -> [(&'static str, FormOfStudent); 2] {
    use catoptric_lab::marking::StudentMarks;
    [(GRADESCOPE, StudentMarks::gradescope), (SUBMITTY, StudentMarks::submitty)]
}

fn rubric(arguments: &CompareArguments, roster: &Roster, files: &mut CommandFiles) -> Result<Rubric> {
    let Some(path) = &arguments.rubric else { return Ok(Rubric::default()) };
    let text = roster::read_text(path, files)?;
    let scenes: Vec<&str> = roster.scenes.iter().map(|scene| scene.name.as_str()).collect();
    Rubric::read(&text, &scenes)
        .map_err(|diagnostics| LoadError::Diagnostics { path: path.clone(), text, diagnostics }.into())
}

/// Reads a scene and shows what is to be said of it. Pictures of one that cannot be used count for nobody; those of others
/// do.
fn exact_scene<'a>(
    scene: &'a ClassScene,
    arguments: &'a CompareArguments,
    files: &mut CommandFiles,
) -> Result<ExactScene<'a>, String> {
    match ExactScene::read(&scene.path, arguments, files) {
        Ok(exact) => {
            if !arguments.quiet {
                exact.warn();
            }
            Ok(exact)
        }
        Err(error) => {
            report(&error);
            Err(in_words(&error))
        }
    }
}

/// Checks the pictures of a class, one after the other: of large ones there is one in memory.
struct Marker<'a, 't> {
    roster: &'a Roster,
    arguments: &'a CompareArguments,
    files: &'a mut CommandFiles,
    done: usize,
    tell: &'t mut (dyn FnMut(usize, Option<std::time::Duration>) + Send),
}

/// A picture that can be read, and its place in the roster.
struct Readable {
    place: usize,
    path: PathBuf,
    key: CheckKey,
}

impl Marker<'_, '_> {
    /// What became of each picture of the roster; `scenes` are those of the roster, or why they cannot be used.
    fn outcomes(&mut self, scenes: &[Result<ExactScene<'_>, String>]) -> Result<Vec<SubmissionOutcome>> {
        let mut outcomes = vec![SubmissionOutcome::Missing; self.roster.submissions.len()];
        for (scene, exact) in self.roster.scenes.iter().zip(scenes) {
            let own = |(_, submission): &(usize, &Submission)| submission.scene == scene.name;
            let places: Vec<usize> =
                self.roster.submissions.iter().enumerate().filter(own).map(|(place, _)| place).collect();
            match exact {
                Ok(exact) => self.of_scene(exact, &places, &mut outcomes)?,
                Err(reason) => {
                    for place in places {
                        put(&mut outcomes, place, SubmissionOutcome::Unmarked(reason.clone()));
                        self.step();
                    }
                }
            }
        }
        Ok(outcomes)
    }

    /// What became of the pictures at these places, which are all of one scene.
    fn of_scene(
        &mut self,
        exact: &ExactScene<'_>,
        places: &[usize],
        outcomes: &mut [SubmissionOutcome],
    ) -> Result<()> {
        let mut readable = self.readable(exact, places, outcomes)?;
        // Pictures that share a preparation of the scene follow each other; apart from that they stay in their order.
        let mut keys: Vec<CheckKey> = Vec::new();
        for file in &readable {
            if !keys.contains(&file.key) {
                keys.push(file.key);
            }
        }
        readable.sort_by_key(|file| keys.iter().position(|key| *key == file.key));
        for group in readable.chunk_by(|one, other| one.key == other.key) {
            let Some(first) = group.first() else { continue };
            let own = exact.scene(&first.key, self.files)?;
            let checker = Checker::new(&own, first.key, self.arguments)?;
            self.of_group(checker, group, outcomes)?;
        }
        Ok(())
    }

    /// The pictures at these places that can be read; what became of the others is put into `outcomes`.
    fn readable(
        &mut self,
        exact: &ExactScene<'_>,
        places: &[usize],
        outcomes: &mut [SubmissionOutcome],
    ) -> Result<Vec<Readable>> {
        let mut readable = Vec::new();
        for &place in places {
            let listed =
                self.roster.submissions.get(place).and_then(|submission| submission.picture.as_ref());
            let Some(listed) = listed else {
                self.step();
                continue;
            };
            let path = self.roster.folder.join(listed);
            self.files.add_input(&path)?;
            match self.head(&path) {
                Ok(head) => readable.push(Readable { place, key: exact.key(head)?, path }),
                Err(outcome) => {
                    put(outcomes, place, outcome);
                    self.step();
                }
            }
        }
        Ok(readable)
    }

    /// The size and format of a picture, which is not kept.
    fn head(&self, path: &Path) -> Result<PictureHead, SubmissionOutcome> {
        if !path.exists() {
            return Err(SubmissionOutcome::Missing);
        }
        Ok(self.read(path)?.head)
    }

    fn read(&self, path: &Path) -> Result<PictureFile, SubmissionOutcome> {
        let mut layers = LayerReader::new(self.arguments.layer.as_deref());
        PictureFile::read(path.to_owned(), &mut layers).map_err(|error| {
            // Where the file lies is said beside.
            let error = anyhow::Error::new(error);
            SubmissionOutcome::Unreadable(error.root_cause().to_string())
        })
    }

    fn of_group(
        &mut self,
        mut checker: Checker<'_>,
        group: &[Readable],
        outcomes: &mut [SubmissionOutcome],
    ) -> Result<()> {
        for file in group {
            let outcome = match self.read(&file.path) {
                Ok(picture) => checker.check(&picture).with_context(|| file.path.display().to_string())?,
                Err(outcome) => outcome,
            };
            put(outcomes, file.place, outcome);
            self.step();
        }
        Ok(())
    }

    fn step(&mut self) {
        self.done += 1;
        (self.tell)(self.done, None);
    }
}

fn put(outcomes: &mut [SubmissionOutcome], place: usize, outcome: SubmissionOutcome) {
    if let Some(own) = outcomes.get_mut(place) {
        *own = outcome;
    }
}

/// Holds pictures against a scene that is prepared once.
struct Checker<'a> {
    scene: &'a Scene,
    render_scene: RenderScene,
    detective: Detective<'a>,
    key: CheckKey,
    arguments: &'a CompareArguments,
    /// The exact picture of the last size.
    exact: Option<([u32; 2], ExactPicture)>,
}

impl<'a> Checker<'a> {
    fn new(scene: &'a Scene, key: CheckKey, arguments: &'a CompareArguments) -> Result<Self> {
        let detective = Detective::new(scene, key.settings)?;
        Ok(Self { scene, render_scene: RenderScene::build(scene)?, detective, key, arguments, exact: None })
    }

    fn check(&mut self, file: &PictureFile) -> Result<SubmissionOutcome> {
        let verdict = self.detective.check(&file.observed(), &RenderControl::default())?;
        let evidence = self.evidence(file, &verdict)?;
        let (allowed, language) = (self.arguments.allow, self.arguments.language);
        let check = SubmissionCheck::new(&verdict, self.scene, allowed, evidence, language);
        Ok(SubmissionOutcome::Checked(Box::new(check)))
    }

    fn evidence(&mut self, file: &PictureFile, verdict: &Verdict) -> Result<Evidence> {
        let settings = &self.key.settings;
        let size = verdict.scene_size;
        let exact = match self.exact.take() {
            Some((of, exact)) if of == size => exact,
            _ => {
                let traced = render(&self.render_scene, exact_settings(verdict), &RenderControl::default())?;
                ExactPicture::new(&traced.picture, &settings.development(), ExactPicture::LONGEST_SIDE)?
            }
        };
        let orientation = verdict.mistakes.iter().find_map(|mistake| match mistake {
            Mistake::Orientation(orientation) => Some(*orientation),
            _ => None,
        });
        let orientation = orientation.unwrap_or(Orientation::Upright);
        let evidence = Evidence::new(&file.picture, &file.development(settings), orientation, &exact)?;
        self.exact = Some((size, exact));
        Ok(evidence)
    }
}

fn write(
    marks: &ClassMarks,
    left_over: &[String],
    arguments: &CompareArguments,
    output: &Path,
    files: &CommandFiles,
) -> Result<()> {
    let language = arguments.language;
    let page = class_page(marks, left_over, language);
    let json = json_text(&marks.to_json());
    let (pictures, students, junit) = (marks.pictures_csv(), marks.students_csv(), marks.junit_xml());
    for (name, text) in
        [(REPORT, page), (METRICS, json), (PICTURES, pictures), (STUDENTS, students), (JUNIT, junit)]
    {
        files.write(&output.join(name), text.as_bytes())?;
    }
    for (name, student) in marks.file_names().iter().zip(&marks.students) {
        for (folder, form) in forms() {
            let text = json_text(&form(student, language));
            files.write(&output.join(folder).join(format!("{name}.json")), text.as_bytes())?;
        }
    }
    Ok(())
}

/// A line for each student.
fn summary(marks: &ClassMarks, language: Language, report: &Path) -> String {
    let width = marks.students.iter().map(|own| visible(&own.student).chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for student in &marks.students {
        text += &format!("{:width$}  {}\n", visible(&student.student), student.summary(language));
    }
    format!("{text}report: {}\n", report.display())
}
