//! Reads scene files.

mod list;
mod names;

use crate::Scene;
use crate::format::build::SceneBuilder;
use crate::format::diagnostic::{Diagnostic, Diagnostics};
use crate::format::keys;
use crate::format::message::{Message, Subject};
use crate::format::quote::{path_to_copy, quoted};
use crate::format::spec::Kind;
use crate::format::toml::{
    Assignment, Header, Key, LogicalLine, LogicalLines, Span, Statement, Value, ValueKind, parse,
};
use crate::format::tree::{Schema, Table, TableOrigin};
use crate::image::Resources;
use crate::language::Language;
use crate::material::NamedMaterial;
use toml_parser::lexer::TokenKind;

use list::{ListKind, ListReader};
use names::SourcePositions;
pub(crate) use names::{instance_fault, undefined_material};

/// Longest text in bytes: 1 GiB.
pub const LONGEST_TEXT: usize = 1 << 30;

/// The scene of a text, and its findings.
#[derive(Clone, Debug)]
pub struct ParsedScene {
    /// The scene as far as it could be understood: wrong values have their defaults, bodies of an unknown shape are
    /// left out.
    pub scene: Scene,
    /// All errors and warnings, in the order of the file.
    pub diagnostics: Diagnostics,
}

impl ParsedScene {
    /// Opens the pictures that the scene names, and adds what is wrong with them to the findings; `text` is what was
    /// read.
    pub fn open_images(&mut self, resources: &dyn Resources, text: &str) {
        if let Err(errors) = self.scene.open_images(resources) {
            self.diagnostics.report_images(&errors, text);
        }
    }

    /// The scene, or the findings when any of them is an error.
    pub fn into_result(self) -> Result<Warned<Scene>, Diagnostics> {
        if self.diagnostics.has_errors() {
            Err(self.diagnostics)
        } else {
            Ok(Warned { value: self.scene, warnings: self.diagnostics })
        }
    }
}

/// A scene that was read without errors.
#[derive(Clone, Debug)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// The text that was read, which [`update`](crate::update) needs to keep comments and order.
    pub text: String,
    /// Warnings about it.
    pub warnings: Diagnostics,
}

/// A value together with warnings about it.
#[derive(Clone, Debug)]
pub struct Warned<T> {
    /// The value.
    pub value: T,
    /// The warnings, in the order of the file.
    pub warnings: Diagnostics,
}

/// Reads a scene from the text of a file. Never fails: errors are among the findings.
///
/// ```
/// let reading = catoptric_scene::read("format = 'catoptric/1'\n[camera]\nfov = 300");
/// assert_eq!(reading.diagnostics.to_string(), "3:7: error: `fov` is `300`, but must be at most 179.9");
/// ```
pub fn read(text: &str) -> ParsedScene {
    if text.len() > LONGEST_TEXT {
        let mut diagnostics = Diagnostics::default();
        let help = Message::LongestText { bytes: LONGEST_TEXT.to_string() };
        diagnostics.push(Diagnostic::error(0..0, Message::TextTooLong).with_help(help));
        diagnostics.locate("");
        return ParsedScene { scene: Scene::default(), diagnostics };
    }
    Reader::new(text).read()
}

/// Reads a scene from the bytes of a file, which should be UTF-8. With the reading comes the text that its places
/// refer to.
pub fn read_bytes(bytes: Vec<u8>) -> (ParsedScene, String) {
    match decode(bytes) {
        Ok(text) => (read(&text), text),
        Err((diagnostics, text)) => (ParsedScene { scene: Scene::default(), diagnostics }, text),
    }
}

/// The text of a file.
///
/// # Errors
/// When it is not UTF-8: the finding, and the text that its place refers to.
pub fn decode(bytes: Vec<u8>) -> Result<String, (Diagnostics, String)> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let byte = error.as_bytes().get(at).copied().unwrap_or_default();
        let mut diagnostics = Diagnostics::default();
        let place = at..at + char::REPLACEMENT_CHARACTER.len_utf8();
        diagnostics.push(
            Diagnostic::error(place, Message::NotUtf8)
                .with_label(Message::ByteOutOfPlace { byte: format!("0x{byte:02x}") })
                .with_help(Message::SaveAsUtf8),
        );
        diagnostics.locate(&text);
        (diagnostics, text)
    })
}

/// A header of a list where a table belongs.
pub(crate) fn not_a_list(path: &[Key<'_>], span: Span) -> Diagnostic {
    let keys = || path.iter().map(|key| key.text.as_ref());
    let name: Vec<&str> = keys().collect();
    let message = Message::NotAList { name: quoted(&name.join(".")) };
    Diagnostic::error(span.range(), message).with_help(match path_to_copy(keys()) {
        Some(path) => Message::Write { text: format!("[{path}]") },
        None => Message::WriteInSingleBrackets,
    })
}

/// The table that receives the next assignments.
enum AssignmentTarget<'t> {
    /// The one at this path from the root.
    Table(Vec<Key<'t>>),
    /// The one at this path from the open element of a list.
    Element(ListKind, Vec<Key<'t>>),
    /// None: the header was wrong.
    Nowhere,
}

/// A text that is being read.
struct Reader<'t> {
    text: &'t str,
    /// Findings about the meaning.
    found: Diagnostics,
    /// Syntax errors.
    syntax: Diagnostics,
    /// Whether tables may have got lost in syntax errors.
    has_lost_tables: bool,
    root: Table<'t>,
    lights: ListReader<'t>,
    bodies: ListReader<'t>,
    place: AssignmentTarget<'t>,
    places: SourcePositions,
    scene: Scene,
}

impl<'t> Reader<'t> {
    fn new(text: &'t str) -> Self {
        Self {
            text,
            found: Diagnostics::default(),
            syntax: Diagnostics::default(),
            has_lost_tables: false,
            root: Table::new(Schema::Keys(&keys::ROOT), TableOrigin::ByHeader),
            lights: ListReader::default(),
            bodies: ListReader::default(),
            place: AssignmentTarget::Table(Vec::new()),
            places: SourcePositions::default(),
            scene: Scene::default(),
        }
    }

    fn read(mut self) -> ParsedScene {
        let mut lines = LogicalLines::new(self.text);
        while let Some(line) = lines.next() {
            self.line(&line);
        }
        self.close(ListKind::Lights);
        self.close(ListKind::Bodies);
        self.finish();
        self.found.locate(self.text);
        self.scene.lights.shrink_to_fit();
        ParsedScene { scene: self.scene, diagnostics: self.found }
    }

    fn line(&mut self, line: &LogicalLine<'_>) {
        let tokens = match line {
            LogicalLine::Tokens(tokens) => tokens,
            LogicalLine::TooLong(span) => {
                self.syntax.push(
                    Diagnostic::error(span.range(), Message::ValueTooLong)
                        .with_help(Message::WriteWithHeaders),
                );
                return;
            }
        };
        let parsed = parse(self.text, tokens);
        let has_problems = !parsed.problems.is_empty();
        // A text of several lines that is not closed takes everything after it along.
        let is_long_text = |kind| matches!(kind, TokenKind::MlBasicString | TokenKind::MlLiteralString);
        self.has_lost_tables |= has_problems && tokens.iter().any(|token| is_long_text(token.kind()));
        for problem in parsed.problems {
            self.syntax.push(problem);
        }
        match parsed.statement {
            Some(Statement::Header(header)) => {
                self.has_lost_tables |= has_problems;
                self.header(header);
            }
            Some(Statement::Assignment(assignment)) => self.assignment(assignment),
            None => self.has_lost_tables |= has_problems,
        }
    }

    fn header(&mut self, header: Header<'t>) {
        let Header { path, is_list, span } = header;
        let Some(first) = path.first() else { return };
        self.place = match ListKind::from_key(&first.text) {
            Some(kind) => self.list_header(kind, path, is_list),
            None => {
                if is_list && keys::ROOT.find(&first.text).is_some() {
                    self.found.push(not_a_list(&path, span));
                }
                match self.root.open(&path) {
                    Ok(()) => AssignmentTarget::Table(path),
                    Err(problem) => {
                        self.found.push(*problem);
                        AssignmentTarget::Nowhere
                    }
                }
            }
        };
    }

    fn assignment(&mut self, assignment: Assignment<'t>) {
        let found = &mut self.found;
        let table = match &self.place {
            AssignmentTarget::Nowhere => None,
            AssignmentTarget::Table(path) if path.is_empty() => {
                let kind = assignment.path.first().and_then(|key| ListKind::from_key(&key.text));
                if let Some(kind) = kind {
                    return self.list_value(kind, assignment);
                }
                Some(&mut self.root)
            }
            AssignmentTarget::Table(path) => self.root.at(path),
            AssignmentTarget::Element(kind, path) => match kind {
                ListKind::Lights => &mut self.lights,
                ListKind::Bodies => &mut self.bodies,
            }
            .open
            .as_mut()
            .and_then(|table| table.at(path)),
        };
        if let Some(table) = table {
            table.assign(assignment, found);
        }
    }

    /// Everything that needs the whole file.
    fn finish(&mut self) {
        self.singletons();
        let materials = self.materials();
        let is_used =
            names::check_materials(&mut self.scene, &self.places, self.has_lost_tables, &mut self.found);
        names::check_unique(&mut self.scene, &self.places, &mut self.found);
        names::follow_instances(&mut self.scene, &self.places, self.has_lost_tables, &mut self.found);
        names::remove_unknown(&mut self.scene, &self.places);
        let is_known = self.version();
        if !is_known {
            // A file of another version has other keys; only its syntax can be judged.
            self.found.retain(|diagnostic| diagnostic.message(Language::English).contains("`format`"));
        }
        self.found.append(&mut self.syntax);
        if !self.found.has_errors() {
            names::warn(&self.scene, &self.places, &materials, &is_used, &mut self.found);
        }
    }

    fn singletons(&mut self) {
        let mut build = SceneBuilder { text: self.text, found: &mut self.found };
        if let Some(camera) = build.root(&self.root, "camera") {
            self.scene.camera = build.camera(camera);
        }
        if let Some(environment) = build.root(&self.root, "environment") {
            self.scene.environment = build.environment(environment);
        }
        if let Some(tracing) = build.root(&self.root, "tracing") {
            self.scene.tracing = build.tracing(tracing);
        }
    }

    /// Builds the materials; the answer has the place of each name.
    fn materials(&mut self) -> Vec<std::ops::Range<usize>> {
        let mut build = SceneBuilder { text: self.text, found: &mut self.found };
        let Some(materials) = build.root(&self.root, "materials") else { return Vec::new() };
        let mut spans = Vec::new();
        for entry in &materials.entries {
            let material = match &entry.value.kind {
                ValueKind::Table(table) => build.material(table),
                ValueKind::Invalid => Default::default(),
                other => {
                    let message = Message::WrongValue {
                        subject: Subject::quoted(quoted(&entry.key.text)),
                        found: other.found(),
                        expected: Kind::Table(&keys::MATERIAL),
                    };
                    let finding = Diagnostic::error(entry.value.span.range(), message);
                    build.found.push(finding.with_help(Message::MaterialIsTable));
                    Default::default()
                }
            };
            self.scene.materials.push(NamedMaterial { name: entry.key.text.as_ref().to_owned(), material });
            spans.push(entry.key.span.range());
        }
        spans
    }

    /// Whether a key was reported that was probably meant to be `format`.
    fn misspells_format(&self) -> bool {
        let hint = Some(Message::DidYouMean { word: "`format`".to_owned() });
        self.found.iter().any(|diagnostic| diagnostic.label == hint)
    }

    /// Checks the version; false when the file is of another one.
    fn version(&mut self) -> bool {
        let known: Vec<String> = keys::VERSIONS.iter().map(|version| format!("\"{version}\"")).collect();
        let known = known.join(", ");
        match self.root.get("format") {
            Some(Value { kind: ValueKind::Invalid, .. }) => true,
            Some(Value { kind: ValueKind::Text(version), .. })
                if keys::VERSIONS.contains(&version.as_ref()) =>
            {
                true
            }
            Some(Value { kind: ValueKind::Text(version), span }) => {
                let message = Message::UnknownVersion { version: quoted(version) };
                let finding = Diagnostic::error(span.range(), message);
                self.found.push(finding.with_help(Message::KnownVersions { known }));
                false
            }
            Some(Value { kind, span }) => {
                let message = Message::WrongValue {
                    subject: Subject::key("format"),
                    found: kind.found(),
                    expected: Kind::Version(keys::VERSIONS),
                };
                self.found.push(Diagnostic::error(span.range(), message));
                true
            }
            None if !self.syntax.is_empty() || self.misspells_format() => true,
            None => {
                let start = if self.text.starts_with('\u{feff}') { 3 } else { 0 };
                self.found.push(
                    Diagnostic::error(start..start, Message::FormatMissing)
                        .with_help(Message::BeginWithFormat { known }),
                );
                true
            }
        }
    }
}
