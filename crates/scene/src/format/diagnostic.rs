//! Findings about a scene file: where, what, and what is allowed.

use std::fmt;
use std::ops::Range;

use crate::format::message::{Message, Sentence};
use crate::image::{ImageError, ImageSource};
use crate::language::Language;

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The file cannot be used as it is.
    Error,
    /// The file can be used; something in it is probably not meant so.
    Warning,
    /// The file can be used; something in it can be read in several ways, and this says in which it was.
    Note,
}

impl Severity {
    /// `error`, `warning` or `note`.
    pub const fn word(self) -> &'static str {
        self.word_in(Language::English)
    }

    /// The word for it in a language.
    pub const fn word_in(self, language: Language) -> &'static str {
        match self {
            Self::Error => language.pick("error", "ошибка"),
            Self::Warning => language.pick("warning", "предупреждение"),
            Self::Note => language.pick("note", "замечание"),
        }
    }
}

/// One finding. Its texts are put into words in the language that they are asked for in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// The marked bytes of the text.
    pub span: Range<usize>,
    /// Line of the mark, from 1.
    pub line: usize,
    /// Column of the mark in characters, from 1.
    pub column: usize,
    pub(crate) message: Message,
    pub(crate) label: Option<Message>,
    pub(crate) help: Option<Message>,
    /// Another place that explains this one.
    pub related: Option<Related>,
}

/// A place that explains a finding elsewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Related {
    /// The marked bytes of the text.
    pub span: Range<usize>,
    /// Line of the mark, from 1.
    pub line: usize,
    /// Column of the mark in characters, from 1.
    pub column: usize,
    message: Message,
}

impl Related {
    /// What stands there.
    pub fn message(&self, language: Language) -> String {
        self.message.text(language)
    }
}

impl Diagnostic {
    /// What was found and what is wrong with it.
    pub fn message(&self, language: Language) -> String {
        self.message.text(language)
    }

    /// What stands beside the mark, if anything does.
    pub fn label(&self, language: Language) -> Option<String> {
        self.label.as_ref().map(|label| label.text(language))
    }

    /// Whether it says what is allowed, or what to do.
    pub fn has_help(&self) -> bool {
        self.help.is_some()
    }

    /// What is allowed, or what to do.
    pub fn help(&self, language: Language) -> Option<String> {
        self.help.as_ref().map(|help| help.text(language))
    }

    /// `LINE:COLUMN: error: message`, as `Display` writes it in English.
    pub fn line_of_text(&self, language: Language) -> String {
        let severity = self.severity.word_in(language);
        format!("{}:{}: {severity}: {}", self.line, self.column, self.message(language))
    }

    /// A finding of the reader of another format. Its line and column are still to be found, by
    /// [`Diagnostics::locate`].
    pub fn said(severity: Severity, span: Range<usize>, sentence: impl Into<Sentence>) -> Self {
        Self::new(severity, span, Message::Said { sentence: sentence.into() })
    }

    /// Adds a label beside the mark.
    #[must_use]
    pub fn labeled(self, sentence: impl Into<Sentence>) -> Self {
        self.with_label(Message::Said { sentence: sentence.into() })
    }

    /// Adds help: what is allowed, or what to do.
    #[must_use]
    pub fn helped(self, sentence: impl Into<Sentence>) -> Self {
        self.with_help(Message::Said { sentence: sentence.into() })
    }

    /// Adds another place of the file that explains the finding.
    #[must_use]
    pub fn related_to(self, span: Range<usize>, sentence: impl Into<Sentence>) -> Self {
        self.with_related(span, Message::Said { sentence: sentence.into() })
    }

    /// A finding whose line and column are still to be found.
    pub(crate) fn new(severity: Severity, span: Range<usize>, message: Message) -> Self {
        Self { severity, span, line: 0, column: 0, message, label: None, help: None, related: None }
    }

    /// An error whose line and column are still to be found.
    pub(crate) fn error(span: Range<usize>, message: Message) -> Self {
        Self::new(Severity::Error, span, message)
    }

    /// Adds a label beside the mark.
    pub(crate) fn with_label(mut self, label: Message) -> Self {
        self.label = Some(label);
        self
    }

    /// Adds help.
    pub(crate) fn with_help(mut self, help: Message) -> Self {
        self.help = Some(help);
        self
    }

    /// Adds another place of the file that explains the finding.
    pub(crate) fn with_related(mut self, span: Range<usize>, message: Message) -> Self {
        self.related = Some(Related { span, line: 0, column: 0, message });
        self
    }
}

/// `LINE:COLUMN: error: message`, in English.
impl fmt::Display for Diagnostic {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.line_of_text(Language::English))
    }
}

impl std::error::Error for Diagnostic {}

/// All findings about a file, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    omitted: usize,
    /// Paths of pictures and where they stand. Whether they can be opened is found out when all is read.
    images: Vec<(ImageSource, Range<usize>)>,
}

impl Diagnostics {
    /// The most findings that are kept; the others are counted.
    pub const MOST: usize = 1000;

    /// Adds a finding, or counts it when there are too many already.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.push_with(|| diagnostic);
    }

    /// Adds a finding that is only put into words when it is kept.
    pub(crate) fn push_with(&mut self, diagnostic: impl FnOnce() -> Diagnostic) {
        if self.list.len() < Self::MOST {
            self.list.push(diagnostic());
        } else {
            self.omitted += 1;
        }
    }

    /// Remembers where the path of a picture stands.
    pub(crate) fn names_image(&mut self, image: ImageSource, span: Range<usize>) {
        if self.images.len() < Self::MOST {
            self.images.push((image, span));
        }
    }

    /// Reports pictures that could not be opened, wherever the text names them.
    pub(crate) fn report_images(&mut self, errors: &[ImageError], text: &str) {
        for (image, span) in std::mem::take(&mut self.images) {
            if let Some(error) = errors.iter().find(|error| error.image == image) {
                self.push(Diagnostic::error(span, Message::NoImage { error: error.clone() }));
            }
        }
        self.locate(text);
    }

    /// Moves the findings of `other` here.
    pub(crate) fn append(&mut self, other: &mut Self) {
        for diagnostic in other.list.drain(..) {
            self.push(diagnostic);
        }
        self.omitted += std::mem::take(&mut other.omitted);
    }

    /// Puts the findings in the order of `text` and finds their lines and columns, in one walk over the text.
    pub fn locate(&mut self, text: &str) {
        self.list.sort_by_key(|diagnostic| diagnostic.span.start);
        let mut places: Vec<usize> = self.list.iter().map(|diagnostic| diagnostic.span.start).collect();
        places
            .extend(self.list.iter().filter_map(|diagnostic| Some(diagnostic.related.as_ref()?.span.start)));
        places.sort_unstable();
        places.dedup();
        let found = positions(text, &places);
        let position_of = |place: usize| {
            let index = places.partition_point(|&other| other < place);
            found.get(index).copied().unwrap_or((1, 1))
        };
        for diagnostic in &mut self.list {
            (diagnostic.line, diagnostic.column) = position_of(diagnostic.span.start);
            if let Some(related) = &mut diagnostic.related {
                (related.line, related.column) = position_of(related.span.start);
            }
        }
    }

    /// The findings in the order of the file, at most [`Self::MOST`].
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// How many findings are kept.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many findings beyond [`Self::MOST`] there were.
    pub fn omitted(&self) -> usize {
        self.omitted
    }

    /// Whether any finding is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// Keeps the findings that `keep` accepts.
    pub fn retain(&mut self, keep: impl FnMut(&Diagnostic) -> bool) {
        self.list.retain(keep);
    }
}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// One finding per line in English, without the lines of the file.
impl fmt::Display for Diagnostics {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.list.iter().enumerate() {
            let newline = if index == 0 { "" } else { "\n" };
            write!(out, "{newline}{diagnostic}")?;
        }
        if self.omitted > 0 {
            write!(out, "\n… and {} more", self.omitted)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// Line and column of each of the sorted byte offsets `places`. A byte order mark takes no column.
fn positions(text: &str, places: &[usize]) -> Vec<(usize, usize)> {
    let bytes = text.as_bytes();
    let (mut line, mut column, mut at) = (1, 1, 0);
    if bytes.starts_with(b"\xEF\xBB\xBF") {
        at = 3;
    }
    let mut found = Vec::with_capacity(places.len());
    for &place in places {
        let Some(skipped) = bytes.get(at..place.min(bytes.len())) else {
            found.push((line, column));
            continue;
        };
        for &byte in skipped {
            if byte == b'\n' {
                line += 1;
                column = 1;
            } else if byte & 0b1100_0000 != 0b1000_0000 {
                // Not a continuation byte: a character begins.
                column += 1;
            }
        }
        at = place.min(bytes.len()).max(at);
        found.push((line, column));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let text = "\u{feff}a = 'ж'\r\nb = 1\n";
        let place = |what: &str| text.find(what).unwrap();
        assert_eq!(positions(text, &[place("a")]), [(1, 1)]);
        assert_eq!(
            positions(text, &[place("ж"), place("'\r"), place("b"), place("1")]),
            [(1, 6), (1, 7), (2, 1), (2, 5)]
        );
        assert_eq!(positions(text, &[0, text.len(), text.len() + 5]), [(1, 1), (3, 1), (3, 1)]);
    }

    #[test]
    fn findings_are_counted_beyond_the_most() {
        let mut diagnostics = Diagnostics::default();
        for index in 0..Diagnostics::MOST + 5 {
            diagnostics.push(Diagnostic::error(index..index, Message::NotAColor));
        }
        assert_eq!((diagnostics.len(), diagnostics.omitted()), (Diagnostics::MOST, 5));
        assert!(diagnostics.to_string().ends_with("\n… and 5 more"));
    }
}
