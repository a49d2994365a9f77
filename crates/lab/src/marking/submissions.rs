//! Which picture is whose, and of which scene: from a folder, or from a table.

use std::collections::BTreeMap;
use std::ops::Range;

use catoptric_scene::{Diagnostic, Diagnostics, Language, Sentence, Severity, quoted_name};

/// A picture that a student owes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Submission {
    /// Whose it is.
    pub student: String,
    /// The scene it should show: its name, or in a table what stands there.
    pub scene: String,
    /// The picture's path as it was listed; `None` if there is none.
    pub picture: Option<String>,
}

/// What a folder holds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClassFolder {
    /// For each student in the order of their names, a picture of each scene in its order.
    pub submissions: Vec<Submission>,
    /// Pictures that are of no scene, or of one that has a picture already.
    pub left_over: Vec<String>,
}

impl ClassFolder {
    /// Finds out which picture is whose. `folder` is the name of the folder, `students` are those of the folders in it, and
    /// `pictures` the paths of picture files from there, with `/` between their parts.
    ///
    /// A picture in a student's folder is of the scene whose name it has, or whose name its own ends with behind `-`, `_`, a
    /// space or a point (`alice_06-shadow.png`); if there is only one scene and one picture, of that. Of a picture in the
    /// folder itself, what stands before the name of the scene is the student; without that the student is called as the
    /// folder. Upper and lower case do not matter. Of several pictures of a scene the first counts: those called as it before
    /// others, shorter paths before longer ones.
    pub fn new(folder: &str, students: &[String], pictures: &[String], scenes: &[&str]) -> Self {
        let mut found: BTreeMap<String, Vec<PictureCandidate<'_>>> =
            students.iter().map(|student| (student.clone(), Vec::new())).collect();
        let mut left_over = Vec::new();
        for path in pictures {
            match PictureCandidate::new(path, folder, scenes) {
                Some((student, candidate)) => found.entry(student).or_default().push(candidate),
                None => left_over.push(path.clone()),
            }
        }
        let mut found: Vec<(String, Vec<PictureCandidate<'_>>)> = found.into_iter().collect();
        found.sort_by_key(|(student, _)| student.to_lowercase());
        let mut submissions = Vec::new();
        for (student, mut candidates) in found {
            candidates.sort();
            if let ([only], [candidate]) = (scenes, candidates.as_mut_slice()) {
                candidate.scene = Some(*only);
            }
            for scene in scenes {
                let at = candidates.iter().position(|candidate| candidate.scene == Some(*scene));
                let picture = at.map(|at| candidates.remove(at).path.to_owned());
                submissions.push(Submission {
                    student: student.clone(),
                    scene: (*scene).to_owned(),
                    picture,
                });
            }
            left_over.extend(candidates.iter().map(|candidate| candidate.path.to_owned()));
        }
        left_over.sort();
        Self { submissions, left_over }
    }
}

/// A picture that may be of a scene; the order says which counts.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PictureCandidate<'a> {
    /// Whether it is called otherwise than the scene.
    is_called_otherwise: bool,
    depth: usize,
    path: &'a str,
    scene: Option<&'a str>,
}

impl<'a> PictureCandidate<'a> {
    /// A picture, and whose it is; `None` for one in the folder itself that belongs to nobody.
    fn new(path: &'a str, folder: &str, scenes: &[&'a str]) -> Option<(String, Self)> {
        let (parents, file) = path.rsplit_once('/').map_or(("", path), |(parents, file)| (parents, file));
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let named = scene_of(stem, scenes);
        let (scene, before) = named.map_or((None, stem), |(scene, before)| (Some(scene), before));
        let student = match parents.split('/').next() {
            Some(first) if !first.is_empty() => first.to_owned(),
            _ if before.is_empty() => folder.to_owned(),
            _ if scene.is_some() || scenes.len() == 1 => before.to_owned(),
            _ => return None,
        };
        let is_called_otherwise = scene.is_none() || !before.is_empty();
        Some((student, Self { is_called_otherwise, depth: path.matches('/').count(), path, scene }))
    }
}

/// The scene that a picture is called after, the longest if there are several, and what stands before.
fn scene_of<'a, 's>(stem: &'s str, scenes: &[&'a str]) -> Option<(&'a str, &'s str)> {
    let lower = stem.to_lowercase();
    let called = |scene: &&str| {
        let name = scene.to_lowercase();
        lower
            .strip_suffix(&name)
            .is_some_and(|before| before.is_empty() || before.ends_with(['-', '_', ' ', '.']))
    };
    let scene = scenes.iter().copied().filter(called).max_by_key(|scene| scene.len())?;
    // Letters may have other lengths in lower case: counted in letters from the end.
    let kept = stem.chars().count().saturating_sub(scene.chars().count());
    let end = stem.char_indices().nth(kept).map_or(stem.len(), |(at, _)| at);
    let before = stem.get(..end).unwrap_or_default().trim_end_matches(['-', '_', ' ', '.']);
    Some((scene, before))
}

/// A table of pictures as text: values separated by commas, semicolons or tabs (RFC 4180), with the heads `student`, `scene`
/// and `picture`.
#[derive(Clone, Debug, Default)]
pub struct ClassTable {
    /// The rows, each student together, in the order of the table.
    pub submissions: Vec<Submission>,
    /// Rows that do not count.
    pub warnings: Diagnostics,
}

impl ClassTable {
    const HEADS: [&str; 3] = ["student", "scene", "picture"];
    /// The most rows that are read.
    const MOST_ROWS: usize = 100_000;

    /// Reads a table. A row without a picture is one that is missing.
    ///
    /// # Errors
    /// All that is wrong with it, with places.
    pub fn read(text: &str) -> Result<Self, Diagnostics> {
        let mut found = Diagnostics::default();
        let separator = separator(text);
        let mut rows = Rows { text, separator, at: if text.starts_with('\u{feff}') { 3 } else { 0 } };
        let heads = rows.next().unwrap_or_default();
        let columns =
            Self::HEADS.map(|head| heads.iter().position(|cell| cell.text.trim().eq_ignore_ascii_case(head)));
        let [Some(student), Some(scene), Some(picture)] = columns else {
            found.push(no_heads(heads.first().map_or(0..0, |cell| cell.place.clone()), separator));
            found.locate(text);
            return Err(found);
        };
        let mut order: Vec<String> = Vec::new();
        let mut of_student: BTreeMap<String, Vec<Submission>> = BTreeMap::new();
        let mut first: BTreeMap<(String, String), Range<usize>> = BTreeMap::new();
        for row in rows.take(Self::MOST_ROWS) {
            if row.iter().all(|cell| cell.text.trim().is_empty()) {
                continue;
            }
            let cell = |column: usize| row.get(column).map(|cell| cell.text.trim()).unwrap_or_default();
            let place = row.first().map_or(0..0, |cell| cell.place.clone());
            if row.len() != heads.len() {
                found.push(wrong_count(place, row.len(), heads.len()));
                continue;
            }
            let (name, scene) = (cell(student).to_owned(), cell(scene).to_owned());
            if name.is_empty() || scene.is_empty() {
                found.push(empty_cell(place, if name.is_empty() { "student" } else { "scene" }));
                continue;
            }
            let key = (name.clone(), scene.clone());
            if let Some(earlier) = first.get(&key) {
                found.push(second_row(place, &name, &scene, earlier.clone()));
                continue;
            }
            first.insert(key, place);
            if !of_student.contains_key(&name) {
                order.push(name.clone());
            }
            let picture = Some(cell(picture)).filter(|path| !path.is_empty()).map(str::to_owned);
            of_student.entry(name.clone()).or_default().push(Submission { student: name, scene, picture });
        }
        found.locate(text);
        if found.has_errors() {
            return Err(found);
        }
        let submissions = order.iter().filter_map(|student| of_student.remove(student)).flatten().collect();
        Ok(Self { submissions, warnings: found })
    }
}

/// The separator of a table: the first of those that can be in its first line.
fn separator(text: &str) -> u8 {
    let line = text.lines().next().unwrap_or_default();
    *[b',', b';', b'\t']
        .iter()
        .max_by_key(|&&mark| (line.bytes().filter(|byte| *byte == mark).count(), mark == b','))
        .unwrap_or(&b',')
}

fn said(severity: Severity, place: Range<usize>, [english, russian]: [String; 2]) -> Diagnostic {
    let sentence = Sentence::new(move |language| match language {
        Language::English => english.clone(),
        Language::Russian => russian.clone(),
    });
    Diagnostic::said(severity, place, sentence)
}

fn no_heads(place: Range<usize>, separator: u8) -> Diagnostic {
    let heads = ClassTable::HEADS.join(&char::from(separator).to_string());
    said(
        Severity::Error,
        place,
        [
            "the first line does not name the columns of the table".to_owned(),
            "первая строка не называет столбцов таблицы".to_owned(),
        ],
    )
    .helped(Sentence::new(|language| match language {
        Language::English => format!("begin the table with the line `{}`", heads.escape_default()),
        Language::Russian => format!("начните таблицу строкой `{}`", heads.escape_default()),
    }))
}

fn wrong_count(place: Range<usize>, found: usize, expected: usize) -> Diagnostic {
    said(
        Severity::Error,
        place,
        [
            format!("the row has {found} values, the first line {expected}"),
            format!("значений в строке: {found}, в первой строке: {expected}"),
        ],
    )
}

fn empty_cell(place: Range<usize>, head: &str) -> Diagnostic {
    said(
        Severity::Error,
        place,
        [format!("the row has no {head}"), format!("в строке нет значения `{head}`")],
    )
}

fn second_row(place: Range<usize>, student: &str, scene: &str, first: Range<usize>) -> Diagnostic {
    let (student, scene) = (quoted_name(student), quoted_name(scene));
    said(
        Severity::Warning,
        place,
        [
            format!("a second picture of {scene} by {student} does not count"),
            format!("второе изображение {scene} от {student} не учитывается"),
        ],
    )
    .related_to(
        first,
        Sentence::new(|language| {
            match language {
                Language::English => "the first one",
                Language::Russian => "первое",
            }
            .to_owned()
        }),
    )
}

/// A value of a table.
#[derive(Clone, Debug)]
struct Cell {
    text: String,
    place: Range<usize>,
}

/// The rows of a table.
struct Rows<'t> {
    text: &'t str,
    separator: u8,
    at: usize,
}

impl Iterator for Rows<'_> {
    type Item = Vec<Cell>;

    fn next(&mut self) -> Option<Vec<Cell>> {
        let bytes = self.text.as_bytes();
        if self.at >= bytes.len() {
            return None;
        }
        let mut row = Vec::new();
        loop {
            row.push(self.cell());
            match bytes.get(self.at) {
                Some(byte) if *byte == self.separator => self.at += 1,
                Some(b'\r') if bytes.get(self.at + 1) == Some(&b'\n') => {
                    self.at += 2;
                    return Some(row);
                }
                Some(_) => {
                    self.at += 1;
                    return Some(row);
                }
                None => return Some(row),
            }
        }
    }
}

impl Rows<'_> {
    /// The value at the present place, up to a separator or the end of the line.
    fn cell(&mut self) -> Cell {
        let start = self.at;
        let bytes = self.text.as_bytes();
        let mut text = String::new();
        if bytes.get(self.at) == Some(&b'"') {
            self.at += 1;
            loop {
                let rest = self.text.get(self.at..).unwrap_or_default();
                let Some(end) = rest.find('"') else {
                    text.push_str(rest);
                    self.at = bytes.len();
                    break;
                };
                text.push_str(rest.get(..end).unwrap_or_default());
                self.at += end + 1;
                // Two quotes in a row stand for one.
                if bytes.get(self.at) != Some(&b'"') {
                    break;
                }
                text.push('"');
                self.at += 1;
            }
        }
        let rest = self.text.get(self.at..).unwrap_or_default();
        let is_end = |letter: char| letter == '\n' || letter == '\r' || letter == char::from(self.separator);
        let end = rest.find(is_end).unwrap_or(rest.len());
        text.push_str(rest.get(..end).unwrap_or_default());
        self.at += end;
        Cell { text, place: start..self.at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Student, scene and picture.
    type Row = (String, String, Option<String>);

    fn folder(students: &[&str], pictures: &[&str], scenes: &[&str]) -> (Vec<Row>, Vec<String>) {
        let owned = |all: &[&str]| all.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let folder = ClassFolder::new("class", &owned(students), &owned(pictures), scenes);
        let rows = folder.submissions.into_iter().map(|row| (row.student, row.scene, row.picture)).collect();
        (rows, folder.left_over)
    }

    fn row(student: &str, scene: &str, picture: &str) -> Row {
        let picture = Some(picture).filter(|path| !path.is_empty());
        (student.to_owned(), scene.to_owned(), picture.map(str::to_owned))
    }

    #[test]
    fn folders_of_students_have_a_picture_of_each_scene() {
        let (rows, left_over) = folder(
            &["bob", "alice", "Eve"],
            &[
                "alice/06-SHADOW.png",
                "alice/out/01-sphere.ppm",
                "alice/alice_01-sphere.png",
                "alice/notes.png",
                "bob/01-sphere.png",
            ],
            &["01-sphere", "06-shadow"],
        );
        let expected = [
            row("alice", "01-sphere", "alice/out/01-sphere.ppm"),
            row("alice", "06-shadow", "alice/06-SHADOW.png"),
            row("bob", "01-sphere", "bob/01-sphere.png"),
            row("bob", "06-shadow", ""),
            row("Eve", "01-sphere", ""),
            row("Eve", "06-shadow", ""),
        ];
        assert_eq!(rows, expected);
        assert_eq!(left_over, ["alice/alice_01-sphere.png", "alice/notes.png"]);
    }

    #[test]
    fn files_tell_their_student_before_the_scene() {
        let scenes = ["sphere", "big-sphere"];
        let (rows, left_over) = folder(
            &[],
            &["Иванов_big-sphere.png", "ivanov-7_sphere.png", "sphere.png", "stray.png"],
            &scenes,
        );
        assert!(rows.contains(&row("Иванов", "big-sphere", "Иванов_big-sphere.png")), "{rows:?}");
        assert!(rows.contains(&row("ivanov-7", "sphere", "ivanov-7_sphere.png")));
        assert!(rows.contains(&row("class", "sphere", "sphere.png")), "called as the folder");
        assert_eq!(left_over, ["stray.png"]);
        // With one scene, the name of the file is that of the student.
        let (rows, _) = folder(&[], &["alice.png", "bob.ppm"], &["glass"]);
        assert_eq!(rows, [row("alice", "glass", "alice.png"), row("bob", "glass", "bob.ppm")]);
        let (rows, left_over) = folder(&["eve"], &["eve/final.png"], &["glass"]);
        assert_eq!((rows, left_over.len()), (vec![row("eve", "glass", "eve/final.png")], 0));
    }

    #[test]
    fn tables_are_read_as_spreadsheets_write_them() {
        let table = |text: &str| {
            let table = ClassTable::read(text).unwrap();
            assert!(table.warnings.is_empty(), "{}", table.warnings);
            table.submissions.into_iter().map(|row| (row.student, row.scene, row.picture)).collect::<Vec<_>>()
        };
        let expected = [
            row("O'Neil, \"Al\"", "a.toml", "al.png"),
            row("O'Neil, \"Al\"", "b.toml", ""),
            row("Bo", "a.toml", "bo.png"),
        ];
        let text = "student,scene,picture\r\n\"O'Neil, \"\"Al\"\"\",a.toml,al.png\r\nBo,a.toml,bo.png\r\n\r\n\"O'Neil, \"\"Al\"\"\",b.toml,\r\n";
        assert_eq!(table(text), expected);
        let text = "\u{feff}Picture;Note;Scene;Student\nal.png;x;a.toml;\"O'Neil, \"\"Al\"\"\"\n;;b.toml;\"O'Neil, \"\"Al\"\"\"\nbo.png;;a.toml;Bo";
        assert_eq!(table(text), expected);
    }

    #[test]
    fn rows_that_are_wrong_are_said_with_their_places() {
        let said = |text: &str| ClassTable::read(text).unwrap_err().to_string();
        assert!(said("name,file\na,b\n").starts_with("1:1: error: the first line does not name"));
        assert!(said("").starts_with("1:1: error"));
        let text = "student,scene,picture\na,s.toml\n,s.toml,p.png\na,,p.png\n\"open,s.toml,p.png\n";
        let lines: Vec<String> = said(text).lines().map(str::to_owned).collect();
        assert!(lines[0].starts_with("2:1: error: the row has 2 values, the first line 3"), "{lines:?}");
        assert!(lines[1].starts_with("3:1: error: the row has no student"));
        assert!(lines[2].starts_with("4:1: error: the row has no scene"));
        assert!(lines[3].starts_with("5:1: error: the row has 1 values"));
        let twice = ClassTable::read("student,scene,picture\na,s,1.png\nb,s,2.png\na,s,3.png\n").unwrap();
        assert_eq!(twice.submissions.len(), 2);
        assert!(twice.warnings.to_string().starts_with("4:1: warning: a second picture of \"s\" by \"a\""));
    }
}
