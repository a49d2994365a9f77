//! Marks for other programs: tables, JUnit's XML, and what Gradescope and Submitty read. Numbers have a decimal point in every
//! language.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use serde_json::{Value, json};

use super::marks::{ClassMarks, PictureMark, StudentMarks, SubmissionOutcome};
use crate::report::Language;
use crate::report::html::escape;
use crate::report::tables::csv_line;

impl ClassMarks {
    /// A line for each picture, values separated by commas.
    pub fn pictures_csv(&self) -> String {
        let heads = [
            "student",
            "scene",
            "picture",
            "points",
            "of",
            "outcome",
            "mistakes",
            "share_agreeing",
            "share_explained",
            "worst_x",
            "worst_y",
            "found",
            "exact",
            "cause",
        ];
        let mut text = csv_line(&heads.map(str::to_owned));
        for mark in self.marks() {
            text.push_str(&csv_line(&picture_fields(mark)));
        }
        text
    }

    /// Names of files for the students; see [`file_names`].
    pub fn file_names(&self) -> Vec<String> {
        file_names(self.students.iter().map(|own| own.student.as_str()))
    }

    /// A line for each student, values separated by commas.
    pub fn students_csv(&self) -> String {
        let heads =
            ["student", "points", "of", "percent", "right", "different", "missing", "unreadable", "unmarked"];
        let mut text = csv_line(&heads.map(str::to_owned));
        for student in &self.students {
            let (points, worth) = (student.points(), student.worth());
            let percent = if worth > 0.0 { format!("{:.1}", 100.0 * points / worth) } else { String::new() };
            let mut fields = vec![harmless(&student.student), points.to_string(), worth.to_string(), percent];
            fields.extend(heads.iter().skip(4).map(|outcome| student.count(outcome).to_string()));
            text.push_str(&csv_line(&fields));
        }
        text
    }

    /// The marks as JUnit's XML has tests: a suite for each student, a case for each picture.
    /// [Its schema](https://github.com/windyroad/JUnit-Schema) is that of Ant's reports.
    pub fn junit_xml(&self) -> String {
        let mut xml = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"catoptric\" {}>\n",
            junit_counts(self.marks())
        );
        for student in &self.students {
            let name = escape(&student.student);
            let _ = write!(
                xml,
                "<testsuite name=\"{name}\" {}>\n<properties><property name=\"points\" value=\"{}\"/><property name=\"of\" \
                 value=\"{}\"/></properties>\n",
                junit_counts(student.pictures.iter()),
                student.points(),
                student.worth()
            );
            for mark in &student.pictures {
                junit_case(&mut xml, &name, mark);
            }
            xml.push_str("</testsuite>\n");
        }
        xml.push_str("</testsuites>\n");
        xml
    }
}

fn picture_fields(mark: &PictureMark) -> Vec<String> {
    let check = mark.outcome.check();
    let number = |key: &str| {
        let number = check.and_then(|check| check.json.get(key)).and_then(Value::as_f64);
        number.map_or_else(String::new, |number| number.to_string())
    };
    let mistakes: Vec<&str> = mark.deductions.iter().map(|deduction| deduction.key).collect();
    let worst = check.filter(|check| !check.is_right).and_then(|check| check.evidence.worst.as_ref());
    let [x, y] = worst.map_or_else(Default::default, |worst| worst.stored.map(|place| place.to_string()));
    let codes = |codes: [u8; 3]| codes.map(|code| code.to_string()).join(" ");
    vec![
        harmless(&mark.submission.student),
        harmless(&mark.submission.scene),
        harmless(mark.submission.picture.as_deref().unwrap_or_default()),
        mark.points.to_string(),
        mark.worth.to_string(),
        mark.outcome.key().to_owned(),
        mistakes.join(" "),
        number("share_agreeing"),
        number("share_explained"),
        x,
        y,
        worst.map_or_else(String::new, |worst| codes(worst.found)),
        worst.map_or_else(String::new, |worst| codes(worst.exact)),
        harmless(cause(mark)),
    ]
}

/// Names of files for students, in their order: their letters, digits, `.`, `_` and `-`, each name once whatever the case.
pub fn file_names<'a>(students: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    const LONGEST: usize = 60;
    let mut taken = BTreeSet::new();
    let plain = |letter: char| if letter.is_alphanumeric() || "._-".contains(letter) { letter } else { '-' };
    let name_of = |student: &str| {
        let name: String = student.chars().map(plain).take(LONGEST).collect();
        let name = name.trim_matches(['-', '.']);
        let name = match name {
            "" => "student".to_owned(),
            name if is_reserved(name) => format!("student-{name}"),
            name => name.to_owned(),
        };
        let numbered = |number: u32| if number == 1 { name.clone() } else { format!("{name}-{number}") };
        let is_free = |name: &String| taken.insert(name.to_lowercase());
        (1..).map(numbered).find(is_free).unwrap_or_default()
    };
    students.into_iter().map(name_of).collect()
}

/// Whether Windows takes a name, with whatever extension, for a device.
fn is_reserved(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let is_numbered =
        |kind: &str| stem.strip_prefix(kind).is_some_and(|rest| matches!(rest.as_bytes(), [b'0'..=b'9']));
    matches!(stem.as_str(), "con" | "prn" | "aux" | "nul") || is_numbered("com") || is_numbered("lpt")
}

/// The cause in a sentence; nothing for a picture that is not there.
fn cause(mark: &PictureMark) -> &str {
    match &mark.outcome {
        SubmissionOutcome::Checked(check) => &check.sentence,
        SubmissionOutcome::Missing => "",
        SubmissionOutcome::Unreadable(reason) | SubmissionOutcome::Unmarked(reason) => reason,
    }
}

/// Text of others in a cell that no spreadsheet takes for a formula: before `=`, `+`, `-`, `@`, tabs and line breaks stands an
/// apostrophe ([OWASP, CSV Injection](https://owasp.org/www-community/attacks/CSV_Injection)).
fn harmless(text: &str) -> String {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠']);
    if is_formula { format!("'{text}") } else { text.to_owned() }
}

fn junit_counts<'a>(marks: impl Iterator<Item = &'a PictureMark>) -> String {
    let mut counts = [0_usize; 4];
    for mark in marks {
        counts[0] += 1;
        match mark.outcome.key() {
            "right" => {}
            "unreadable" => counts[2] += 1,
            "unmarked" => counts[3] += 1,
            _ => counts[1] += 1,
        }
    }
    let [tests, failures, errors, skipped] = counts;
    format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"{skipped}\"")
}

fn junit_case(xml: &mut String, student: &str, mark: &PictureMark) {
    let _ = write!(xml, "<testcase classname=\"{student}\" name=\"{}\">", escape(&mark.submission.scene));
    let key = mark.outcome.key();
    let message = escape(&format!("{} / {}: {}", mark.points, mark.worth, cause(mark)));
    let element = match key {
        "right" => None,
        "unreadable" => Some("error"),
        "unmarked" => Some("skipped"),
        _ => Some("failure"),
    };
    if element == Some("skipped") {
        let _ = write!(xml, "<skipped message=\"{message}\"/>");
    } else if let Some(element) = element {
        let places = mark.outcome.check().map(|check| check.places.as_slice()).unwrap_or_default();
        let places: Vec<String> = places.iter().map(|line| escape(line)).collect();
        let _ =
            write!(xml, "<{element} type=\"{key}\" message=\"{message}\">{}</{element}>", places.join("\n"));
    }
    xml.push_str("</testcase>\n");
}

impl StudentMarks {
    /// The student's `results.json` as Gradescope's autograders write it
    /// ([specification](https://gradescope-autograders.readthedocs.io/en/latest/specs/)).
    pub fn gradescope(&self, language: Language) -> Value {
        let tests: Vec<Value> = self
            .pictures
            .iter()
            .filter(|mark| !matches!(mark.outcome, SubmissionOutcome::Unmarked(_)))
            .map(|mark| {
                json!({
                    "name": mark.submission.scene,
                    "name_format": "text",
                    "score": mark.points,
                    "max_score": mark.worth,
                    "status": if mark.outcome.key() == "right" { "passed" } else { "failed" },
                    "output": feedback(mark, language),
                    "output_format": "text",
                    "tags": mark.deductions.iter().map(|deduction| deduction.key).collect::<Vec<_>>(),
                    "visibility": "visible",
                })
            })
            .collect();
        json!({
            "score": self.points(),
            "output": self.summary(language),
            "output_format": "text",
            "test_output_format": "text",
            "test_name_format": "text",
            "visibility": "visible",
            "stdout_visibility": "hidden",
            "tests": tests,
        })
    }

    /// The student's `validation_results.json` as Submitty's custom validators write it
    /// ([specification](https://submitty.org/instructor/autograding/validation)): the share of the points, and a message for
    /// each picture.
    pub fn submitty(&self, language: Language) -> Value {
        let score = if self.worth() > 0.0 { self.points() / self.worth() } else { 0.0 };
        let status = |mark: &PictureMark| match mark.outcome.key() {
            "right" => "success",
            "unmarked" => "information",
            "different" if mark.points > 0.0 => "warning",
            _ => "failure",
        };
        let messages: Vec<Value> = self
            .pictures
            .iter()
            .map(|mark| {
                let points = language.marking_points(mark.points, mark.worth);
                let message = format!("{}: {points}. {}", mark.submission.scene, feedback(mark, language));
                json!({ "message": message, "status": status(mark) })
            })
            .collect();
        json!({ "status": "success", "data": { "score": score.clamp(0.0, 1.0), "message": messages } })
    }

    /// The points of all pictures in words.
    pub fn summary(&self, language: Language) -> String {
        language.marking_points(self.points(), self.worth())
    }
}

/// What a student is told of a picture: the cause, what it costs, and where it differs still.
fn feedback(mark: &PictureMark, language: Language) -> String {
    let mut lines = vec![match &mark.outcome {
        SubmissionOutcome::Missing => language.marking_missing().to_owned(),
        _ => cause(mark).to_owned(),
    }];
    for deduction in &mark.deductions {
        lines.push(format!("{}: {}", language.marking_cost(deduction.points), deduction.words));
    }
    if let Some(check) = mark.outcome.check() {
        if let Some(worst) = check.evidence.worst.as_ref().filter(|_| !check.is_right) {
            lines.push(language.marking_worst(worst.stored, worst.found, worst.exact));
        }
        lines.extend(check.places.iter().cloned());
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marking::Rubric;
    use crate::marking::marks::tests::{checked, submission};

    fn class() -> ClassMarks {
        let pictures = [
            (submission("=cmd|'/c'!A0", "a,\"b\""), checked(&["no-shadows"], 0.0)),
            (submission("=cmd|'/c'!A0", "right"), checked(&[], 0.0)),
            (submission("<b>&]]>", "right"), SubmissionOutcome::Missing),
            (submission("<b>&]]>", "broken"), SubmissionOutcome::Unreadable("not a <picture>".to_owned())),
            (submission("<b>&]]>", "gone"), SubmissionOutcome::Unmarked("no scene".to_owned())),
        ];
        ClassMarks::new(pictures, &Rubric::default(), Language::English)
    }

    #[test]
    fn no_name_is_a_formula_or_breaks_a_line() {
        let csv = class().pictures_csv();
        let lines: Vec<&str> = csv.lines().collect();
        assert!(lines[1].starts_with("'=cmd|'/c'!A0,\"a,\"\"b\"\"\",\"'=cmd|'/c'!A0/a"), "{csv}");
        assert!(lines[1].contains(",7,10,different,no-shadows,0.5,1,0,0,0 0 0,188 188 188,"), "{csv}");
        assert!(lines[2].contains(",10,10,right,,0.5,1,,,,,"), "{csv}");
        assert_eq!(lines.len(), 6);
        let totals = class().students_csv();
        assert_eq!(
            totals,
            "student,points,of,percent,right,different,missing,unreadable,unmarked\r\n\
             '=cmd|'/c'!A0,17,20,85.0,1,1,0,0,0\r\n<b>&]]>,0,20,0.0,0,0,1,1,1\r\n"
        );
    }

    #[test]
    fn students_have_files_of_their_own() {
        let names = ["Ann/../Lee", "ann-..-lee", "Иван", "..", "CON", "com1.x", ""];
        let files = file_names(names);
        assert_eq!(
            files,
            ["Ann-..-Lee", "ann-..-lee-2", "Иван", "student", "student-CON", "student-com1.x", "student-2"]
        );
    }

    #[test]
    fn junit_is_xml_with_the_counts_of_its_cases() {
        let xml = class().junit_xml();
        let document = roxmltree::Document::parse(&xml).unwrap();
        let root = document.root_element();
        let counts = ["tests", "failures", "errors", "skipped"].map(|name| root.attribute(name).unwrap());
        assert_eq!(counts, ["5", "2", "1", "1"]);
        let suites: Vec<_> = root.children().filter(roxmltree::Node::is_element).collect();
        assert_eq!(suites[1].attribute("name"), Some("<b>&]]>"));
        let cases = suites[1].children().filter(|node| node.has_tag_name("testcase"));
        let inner: Vec<_> = cases
            .map(|case| case.first_element_child().map(|node| node.tag_name().name().to_owned()))
            .collect();
        assert_eq!(
            inner,
            [Some("failure"), Some("error"), Some("skipped")].map(|name| name.map(str::to_owned))
        );
        assert!(xml.contains("message=\"7 / 10: a &lt;sentence&gt;\""), "{xml}");
    }

    #[test]
    fn gradescope_and_submitty_get_what_they_read() {
        let class = class();
        let value = class.students[0].gradescope(Language::English);
        assert_eq!((value["score"].as_f64(), value["tests"].as_array().map(Vec::len)), (Some(17.0), Some(2)));
        let test = &value["tests"][0];
        assert_eq!((test["score"].as_f64(), test["max_score"].as_f64()), (Some(7.0), Some(10.0)));
        assert_eq!((test["status"].as_str(), test["name"].as_str()), (Some("failed"), Some("a,\"b\"")));
        assert!(test["output"].as_str().unwrap().contains("−3: no-shadows in words"), "{test}");
        assert_eq!(value["tests"][1]["status"], "passed");
        let value = class.students[1].gradescope(Language::English);
        assert_eq!(value["tests"].as_array().map(Vec::len), Some(2), "what cannot be marked is no test");
        let value = class.students[0].submitty(Language::Russian);
        assert_eq!(
            (value["status"].as_str(), value["data"]["score"].as_f64()),
            (Some("success"), Some(0.85))
        );
        let statuses: Vec<_> =
            value["data"]["message"].as_array().unwrap().iter().map(|own| own["status"].clone()).collect();
        assert_eq!(statuses, ["warning", "success"]);
        assert!(value["data"]["message"][0]["message"].as_str().unwrap().starts_with("a,\"b\": 7 из 10"));
    }
}
