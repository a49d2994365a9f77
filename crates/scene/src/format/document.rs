//! Texts of keys and numbers that are no scenes, such as a rubric: read and checked as scene files are.

use std::ops::Range;

use crate::format::diagnostic::{Diagnostic, Diagnostics};
use crate::format::message::{Message, Subject};
use crate::format::quote::quoted;
use crate::format::read::not_a_list;
use crate::format::spec::{Kind, TableSpec};
use crate::format::toml::{LogicalLine, LogicalLines, Statement, ValueKind, parse};
use crate::format::tree::{KeyValue, Schema, Table, TableOrigin};
use crate::format::typed::Fields;

/// A text of keys and numbers whose tables are known. Keys that no table has, keys given twice and wrong values are
/// findings with their places, as in a scene file.
#[derive(Debug)]
pub struct Document<'t> {
    text: &'t str,
    root: Table<'t>,
    found: Diagnostics,
}

impl<'t> Document<'t> {
    /// The longest text that is read, bytes: 1 MiB.
    pub const LONGEST: usize = 1 << 20;

    /// Reads a text whose keys are those of `spec`. Never fails: what is wrong is among the findings.
    pub fn read(text: &'t str, spec: &'static TableSpec) -> Self {
        let root = Table::new(Schema::Keys(spec), TableOrigin::ByHeader);
        let mut document = Self { text, root, found: Diagnostics::default() };
        if text.len() > Self::LONGEST {
            let help = Message::LongestText { bytes: Self::LONGEST.to_string() };
            document.found.push(Diagnostic::error(0..0, Message::TextTooLong).with_help(help));
            return document;
        }
        document.read_lines();
        check(text, &document.root, &mut document.found);
        document
    }

    fn read_lines(&mut self) {
        let mut lines = LogicalLines::new(self.text);
        // Where the next assignments belong; `None` behind a header that is wrong.
        let mut place = Some(Vec::new());
        while let Some(line) = lines.next() {
            let tokens = match line {
                LogicalLine::Tokens(tokens) => tokens,
                LogicalLine::TooLong(span) => {
                    self.found.push(Diagnostic::error(span.range(), Message::ValueTooLong));
                    continue;
                }
            };
            let parsed = parse(self.text, tokens);
            parsed.problems.into_iter().for_each(|problem| self.found.push(problem));
            match parsed.statement {
                Some(Statement::Header(header)) if header.is_list => {
                    self.found.push(not_a_list(&header.path, header.span));
                    place = None;
                }
                Some(Statement::Header(header)) => match self.root.open(&header.path) {
                    Ok(()) => place = Some(header.path),
                    Err(problem) => {
                        self.found.push(*problem);
                        place = None;
                    }
                },
                Some(Statement::Assignment(assignment)) => {
                    if let Some(table) = place.as_ref().and_then(|path| self.root.at(path)) {
                        table.assign(assignment, &mut self.found);
                    }
                }
                None => {}
            }
        }
    }

    /// The number under a path of keys; `None` for what is absent, and for what is among the findings.
    pub fn number(&self, path: &[&str]) -> Option<f64> {
        let (name, parents) = path.split_last()?;
        let table = table_at(&self.root, parents)?;
        let Schema::Keys(spec) = table.schema else { return None };
        let limits = spec.key(name)?.limits()?;
        match table.get(name)?.kind {
            ValueKind::Number { value, .. } if limits.contains(value) => Some(value),
            _ => None,
        }
    }

    /// The keys of the table under a path, in the order of the text; none where it is absent.
    pub fn keys(&self, path: &[&str]) -> Vec<String> {
        let table = table_at(&self.root, path);
        table.map_or_else(Vec::new, |table| {
            table.entries.iter().map(|entry| entry.key.text.to_string()).collect()
        })
    }

    /// The bytes of the text where the last key of a path stands.
    pub fn place(&self, path: &[&str]) -> Option<Range<usize>> {
        let (name, parents) = path.split_last()?;
        let entry: &KeyValue<'_> = table_at(&self.root, parents)?.entry(name)?;
        Some(entry.key.span.range())
    }

    /// Adds a finding of whoever reads the text.
    pub fn report(&mut self, finding: Diagnostic) {
        self.found.push(finding);
    }

    /// All findings, in the order of the text.
    pub fn into_findings(mut self) -> Diagnostics {
        self.found.locate(self.text);
        self.found
    }
}

/// Reports the wrong values of a table and of those below it.
fn check<'t>(text: &'t str, table: &Table<'t>, found: &mut Diagnostics) {
    match table.schema {
        Schema::Keys(spec) => {
            for key in spec.keys {
                let mut fields = Fields { text, spec, table, found: &mut *found };
                fields.check_value(key);
                if matches!(key.kind, Kind::Table(_) | Kind::Named(_))
                    && let Some(child) = fields.child(key.name)
                {
                    check(text, child, found);
                }
            }
        }
        Schema::Names(spec) => {
            for entry in &table.entries {
                match &entry.value.kind {
                    ValueKind::Table(child) => check(text, child, found),
                    ValueKind::Invalid => {}
                    other => {
                        let message = Message::WrongValue {
                            subject: Subject::quoted(quoted(&entry.key.text)),
                            found: other.found(),
                            expected: Kind::Table(spec),
                        };
                        found.push(Diagnostic::error(entry.value.span.range(), message));
                    }
                }
            }
        }
    }
}

/// The table below `root` at a path.
fn table_at<'b, 't>(root: &'b Table<'t>, path: &[&str]) -> Option<&'b Table<'t>> {
    path.iter().try_fold(root, |table, name| match &table.get(name)?.kind {
        ValueKind::Table(child) => Some(child),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::spec::{KeySpec, Limits};

    const COST: Kind = Kind::Number(Limits::new(0.0, 100.0));
    static COSTS: TableSpec = TableSpec {
        name: "`costs`",
        doc: "what things cost",
        keys: &[
            KeySpec::new("shadow", COST, "what a shadow costs"),
            KeySpec::new("size", COST, "what a size costs"),
        ],
    };
    static SCENE: TableSpec = TableSpec {
        name: "a scene",
        doc: "a scene",
        keys: &[KeySpec::new("points", COST, "what it is worth")],
    };
    static ROOT: TableSpec = TableSpec {
        name: "the rubric",
        doc: "a rubric",
        keys: &[
            KeySpec::new("points", COST, "what a picture is worth"),
            KeySpec::new("costs", Kind::Table(&COSTS), "what things cost"),
            KeySpec::new("scenes", Kind::Named(&SCENE), "what scenes are worth"),
        ],
    };

    #[test]
    fn numbers_are_found_by_their_paths() {
        let text = "points = 10\ncosts.size = 1.5\n[scenes.12-glass]\npoints = 20\n[scenes.\"a b\"]\n";
        let document = Document::read(text, &ROOT);
        assert_eq!(document.number(&["points"]), Some(10.0));
        assert_eq!(document.number(&["costs", "size"]), Some(1.5));
        assert_eq!(document.number(&["costs", "shadow"]), None);
        assert_eq!(document.number(&["scenes", "12-glass", "points"]), Some(20.0));
        assert_eq!(document.keys(&["scenes"]), ["12-glass", "a b"]);
        assert_eq!(
            document.place(&["scenes", "a b"]),
            Some(text.find("\"a b\"").map(|at| at..at + 5).unwrap())
        );
        assert!(document.keys(&["nothing"]).is_empty() && document.into_findings().is_empty());
    }

    #[test]
    fn findings_have_places_and_the_nearest_name() {
        let found = |text: &str| Document::read(text, &ROOT).into_findings();
        let said = |text: &str| found(text).to_string();
        assert!(
            said("points = 10\n[costs]\nshadwo = 1").starts_with("3:1: error: `costs` has no key `shadwo`")
        );
        assert_eq!(
            found("[costs]\nshadwo = 1").iter().next().unwrap().label(crate::Language::English).unwrap(),
            "did you mean `shadow`?"
        );
        assert!(said("points = -1").starts_with("1:10: error: `points` is `-1`, but must be 0 or more"));
        assert!(said("points = 'ten'").starts_with("1:10: error: `points` is a text"));
        assert!(said("points = 1\npoints = 2").starts_with("2:1: error: `points` is given twice"));
        assert!(said("costs = 3").starts_with("1:9: error: `costs` is a number, but must be a table"));
        assert!(said("scenes.a = 3").starts_with("1:12: error: `a` is a number, but must be a table"));
        assert!(said("[scenes.a]\npoint = 1").starts_with("2:1: error: a scene has no key `point`"));
        assert!(said("[[costs]]\n").starts_with("1:"));
        assert!(said("points = \n").starts_with("1:"));
        assert!(said(&"#".repeat(Document::LONGEST + 1)).contains("too long"));
    }
}
