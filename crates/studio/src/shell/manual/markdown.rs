//! Markdown as a list of blocks that can be drawn one by one.

use std::rc::Rc;

use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, Options, Parser, Tag, TagEnd};

use super::formula::{self, Formula};
use super::missing_glyphs;
use super::pages;

/// A document that has been read.
pub(super) struct ManualPage {
    /// The first heading.
    pub(super) title: String,
    pub(super) blocks: Vec<Block>,
}

/// A block of a page: a paragraph, a table, a heading.
pub(super) struct Block {
    pub(super) content: BlockContent,
    /// How far it is set in, in steps of lists and quotations.
    pub(super) indent: usize,
    /// Words without marks, to be searched.
    pub(super) plain: String,
}

/// A block's content.
pub(super) enum BlockContent {
    /// A heading; the title of the page has level 1.
    Heading { level: usize, spans: Vec<TextSpan>, anchor: String },
    /// Running text, perhaps with the mark of a list before it.
    Paragraph { marker: Option<String>, spans: Vec<TextSpan> },
    /// Text with its own lines.
    Code(String),
    /// Rows of cells; the first row is the head.
    Table(Vec<Vec<Vec<TextSpan>>>),
    /// A formula of its own.
    Formula(Formula),
    /// A line across the page.
    Line,
}

/// A piece of running text.
#[derive(Clone)]
pub(super) struct TextSpan {
    pub(super) kind: TextSpanKind,
    pub(super) is_strong: bool,
    pub(super) is_emphasized: bool,
    pub(super) link: Option<Rc<ManualLink>>,
}

/// The kind of a piece of running text.
#[derive(Clone)]
pub(super) enum TextSpanKind {
    Text(String),
    Code(String),
    Formula(Rc<Formula>),
    /// What stands for a picture.
    Picture(String),
    /// The line ends here.
    Break,
}

/// The target of a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ManualLink {
    /// To a page, by its place, and to a heading of it.
    Page(usize, String),
    /// Into the browser.
    Web(String),
}

/// Reads the document `text`, the page at `place` with this path.
pub(super) fn read(text: &str, place: usize, path: &str) -> ManualPage {
    let mut reader = MarkdownReader { place, path, ..MarkdownReader::default() };
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    for event in Parser::new_ext(text, options) {
        reader.take(event);
    }
    reader.end_paragraph();
    let mut blocks = reader.blocks;
    if blocks.get(1).is_some_and(leads_to_other_language) {
        // The window has its own way to the other language and the other pages.
        blocks.remove(1);
    }
    let title = blocks.first().map_or_else(String::new, |block| block.plain.clone());
    ManualPage { title, blocks }
}

/// Whether a block is the line of links between the documents of the repository.
fn leads_to_other_language(block: &Block) -> bool {
    let BlockContent::Paragraph { marker: None, spans } = &block.content else { return false };
    spans.len() <= 4 && (block.plain.contains("По-русски") || block.plain.contains("In English"))
}

#[derive(Default)]
struct MarkdownReader<'a> {
    place: usize,
    path: &'a str,
    blocks: Vec<Block>,
    spans: Vec<TextSpan>,
    strong: usize,
    emphasis: usize,
    link: Option<Rc<ManualLink>>,
    /// The numbers of the open lists; `None` for dots.
    lists: Vec<Option<u64>>,
    quotes: usize,
    marker: Option<String>,
    code: Option<String>,
    /// What stands for the picture that is open.
    picture: Option<String>,
    rows: Vec<Vec<Vec<TextSpan>>>,
}

impl MarkdownReader<'_> {
    fn take(&mut self, event: Event<'_>) {
        match event {
            Event::Start(tag) => self.start(tag),
            Event::End(tag) => self.end(tag),
            Event::Text(text) => self.text(&text),
            Event::Code(text) => self.span(TextSpanKind::Code(missing_glyphs::simplified(&text))),
            Event::InlineMath(tex) => self.span(TextSpanKind::Formula(Rc::new(formula::read(&tex)))),
            Event::DisplayMath(tex) => {
                self.end_paragraph();
                let formula = formula::read(&tex);
                let plain = formula.plain();
                self.block(BlockContent::Formula(formula), plain);
            }
            Event::SoftBreak => self.text(" "),
            Event::HardBreak => self.span(TextSpanKind::Break),
            Event::Rule => self.block(BlockContent::Line, String::new()),
            Event::Html(_)
            | Event::InlineHtml(_)
            | Event::FootnoteReference(_)
            | Event::TaskListMarker(_) => {}
        }
    }

    fn start(&mut self, tag: Tag<'_>) {
        match tag {
            Tag::List(first) => {
                self.end_paragraph();
                self.lists.push(first);
            }
            Tag::Item => {
                self.marker = Some(match self.lists.last_mut() {
                    Some(Some(number)) => {
                        let marker = format!("{number}.");
                        *number += 1;
                        marker
                    }
                    _ => "•".to_owned(),
                });
            }
            Tag::BlockQuote(_) => self.quotes += 1,
            Tag::CodeBlock(CodeBlockKind::Fenced(_) | CodeBlockKind::Indented) => {
                self.end_paragraph();
                self.code = Some(String::new());
            }
            Tag::Strong => self.strong += 1,
            Tag::Emphasis => self.emphasis += 1,
            Tag::Link { dest_url, .. } => self.link = self.target(&dest_url).map(Rc::new),
            Tag::Image { .. } => self.picture = Some(String::new()),
            Tag::Table(_) => {
                self.end_paragraph();
                self.rows.clear();
            }
            Tag::TableHead | Tag::TableRow => self.rows.push(Vec::new()),
            _ => {}
        }
    }

    fn end(&mut self, tag: TagEnd) {
        match tag {
            TagEnd::Paragraph | TagEnd::Item => self.end_paragraph(),
            TagEnd::Heading(level) => self.end_heading(level),
            TagEnd::List(_) => {
                self.end_paragraph();
                self.lists.pop();
            }
            TagEnd::BlockQuote(_) => self.quotes = self.quotes.saturating_sub(1),
            TagEnd::CodeBlock => {
                let code = self.code.take().unwrap_or_default();
                let code = code.trim_end().to_owned();
                self.block(BlockContent::Code(code.clone()), code);
            }
            TagEnd::Strong => self.strong = self.strong.saturating_sub(1),
            TagEnd::Emphasis => self.emphasis = self.emphasis.saturating_sub(1),
            TagEnd::Link => self.link = None,
            TagEnd::Image => {
                let picture = self.picture.take().unwrap_or_default();
                self.span(TextSpanKind::Picture(picture));
            }
            TagEnd::TableCell => {
                let cell = std::mem::take(&mut self.spans);
                if let Some(row) = self.rows.last_mut() {
                    row.push(cell);
                }
            }
            TagEnd::Table => {
                let rows = std::mem::take(&mut self.rows);
                let plain = rows.iter().flatten().map(|cell| plain(cell)).collect::<Vec<_>>().join("  ");
                self.block(BlockContent::Table(rows), plain);
            }
            _ => {}
        }
    }

    fn text(&mut self, text: &str) {
        if let Some(code) = &mut self.code {
            code.push_str(text);
        } else if let Some(picture) = &mut self.picture {
            picture.push_str(text);
        } else {
            for kind in missing_glyphs::pieces(text) {
                self.span(kind);
            }
        }
    }

    fn span(&mut self, kind: TextSpanKind) {
        let (is_strong, is_emphasized) = (self.strong > 0, self.emphasis > 0);
        let link = self.link.clone();
        // Pieces of one look are one, so that lines break as they should.
        if let (TextSpanKind::Text(more), Some(last)) = (&kind, self.spans.last_mut())
            && (last.is_strong, last.is_emphasized, &last.link) == (is_strong, is_emphasized, &link)
            && let TextSpanKind::Text(text) = &mut last.kind
        {
            text.push_str(more);
            return;
        }
        self.spans.push(TextSpan { kind, is_strong, is_emphasized, link });
    }

    fn block(&mut self, content: BlockContent, plain: String) {
        let indent = self.lists.len() + self.quotes;
        self.blocks.push(Block { content, indent, plain });
    }

    fn end_paragraph(&mut self) {
        let spans = std::mem::take(&mut self.spans);
        if spans.iter().all(|span| matches!(&span.kind, TextSpanKind::Text(text) if text.trim().is_empty())) {
            return;
        }
        let plain = plain(&spans);
        let marker = self.marker.take();
        self.block(BlockContent::Paragraph { marker, spans }, plain);
    }

    fn end_heading(&mut self, level: HeadingLevel) {
        let spans = std::mem::take(&mut self.spans);
        let plain = plain(&spans);
        let anchor = anchor(&plain);
        self.block(BlockContent::Heading { level: level as usize, spans, anchor }, plain);
    }

    fn target(&self, url: &str) -> Option<ManualLink> {
        if url.starts_with("https://") || url.starts_with("http://") {
            return Some(ManualLink::Web(url.to_owned()));
        }
        let (path, anchor) = url.split_once('#').unwrap_or((url, ""));
        let place = if path.is_empty() { Some(self.place) } else { pages::find(self.path, path) };
        Some(ManualLink::Page(place?, anchor.to_owned()))
    }
}

/// Words without marks.
fn plain(spans: &[TextSpan]) -> String {
    let mut plain = String::new();
    for span in spans {
        match &span.kind {
            TextSpanKind::Text(text) | TextSpanKind::Code(text) | TextSpanKind::Picture(text) => {
                plain.push_str(text);
            }
            TextSpanKind::Formula(formula) => plain.push_str(&formula.plain()),
            TextSpanKind::Break => plain.push(' '),
        }
    }
    plain
}

/// How links name a heading, as GitHub does.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;
    use crate::shell::manual::pages::SOURCES;

    fn all(language: Language) -> Vec<ManualPage> {
        let sources = SOURCES.iter().enumerate();
        sources.map(|(place, source)| read(&source.text(language).unwrap(), place, source.path)).collect()
    }

    fn spans(block: &Block) -> Vec<&TextSpan> {
        match &block.content {
            BlockContent::Heading { spans, .. } | BlockContent::Paragraph { spans, .. } => {
                spans.iter().collect()
            }
            BlockContent::Table(rows) => rows.iter().flatten().flatten().collect(),
            _ => Vec::new(),
        }
    }

    #[test]
    fn every_link_between_pages_leads_to_a_heading() {
        for language in Language::ALL {
            let pages = all(language);
            let mut count = 0;
            for (page, source) in pages.iter().zip(SOURCES) {
                for span in page.blocks.iter().flat_map(spans) {
                    let Some(ManualLink::Page(place, anchor)) = span.link.as_deref() else { continue };
                    count += 1;
                    let is_there = |block: &Block| matches!(&block.content, BlockContent::Heading { anchor: own, .. } if own == anchor);
                    let is_found = anchor.is_empty() || pages[*place].blocks.iter().any(is_there);
                    assert!(is_found, "{language:?} {}: {}#{anchor}", source.path, SOURCES[*place].path);
                }
            }
            assert!(count > 60, "{count}");
        }
    }

    #[test]
    fn a_page_has_its_title_and_no_links_to_other_languages() {
        for language in Language::ALL {
            for (page, source) in all(language).iter().zip(SOURCES) {
                let is_title = matches!(&page.blocks[0].content, BlockContent::Heading { level: 1, .. });
                assert!(is_title && !page.title.is_empty(), "{}", source.path);
                let is_left = |block: &Block| block.plain.contains("По-русски") && block.plain.len() < 90;
                assert!(!page.blocks.iter().any(is_left), "{language:?} {}", source.path);
            }
        }
    }

    #[test]
    fn lists_tables_and_formulas_are_blocks() {
        let page = read(
            "# A\n\n1. one `x`\n   - two\n2. $k_a$\n\n$$ x $$\n\n| a | b |\n|---|---|\n| 1 | 2 |\n",
            0,
            "a.md",
        );
        let told: Vec<String> = page
            .blocks
            .iter()
            .map(|block| match &block.content {
                BlockContent::Heading { level, anchor, .. } => format!("h{level} {anchor}"),
                BlockContent::Paragraph { marker, .. } => {
                    format!("{} {:?} {}", block.indent, marker.as_deref(), block.plain)
                }
                BlockContent::Table(rows) => format!("{}×{}", rows.len(), rows[0].len()),
                BlockContent::Formula(formula) => formula.plain(),
                BlockContent::Code(code) => code.clone(),
                BlockContent::Line => "-".to_owned(),
            })
            .collect();
        let expected =
            ["h1 a", "1 Some(\"1.\") one x", "2 Some(\"•\") two", "1 Some(\"2.\") k_a", "x", "2×2"];
        assert_eq!(told, expected);
    }

    #[test]
    fn headings_are_named_as_on_github() {
        assert_eq!(anchor("The graphics card"), "the-graphics-card");
        assert_eq!(anchor("[materials.NAME]"), "materialsname");
        assert_eq!(anchor("Свет в точке"), "свет-в-точке");
    }
}
