//! Cuts a text into logical lines: each holds one header or one assignment, however many lines its value takes.

use toml_parser::Source;
use toml_parser::lexer::{Lexer, Token, TokenKind};

use super::Span;

/// A logical line of more tokens is refused, which bounds the memory of reading. No table needs a hundredth of it,
/// and lists of bodies or lights can be written as `[[bodies]]` and `[[lights]]`.
const MOST_TOKENS: usize = 2_000_000;

/// A logical line.
pub(crate) enum LogicalLine<'a> {
    /// The tokens of the line, with the newline.
    Tokens(&'a [Token]),
    /// Longer than can be read; the place of its first token.
    TooLong(Span),
}

/// The logical lines of a text.
///
/// A bracket that is never closed would swallow the rest of the file. So a line that looks like a header, or like an
/// assignment where none can stand, begins a new logical line even within brackets.
pub(crate) struct LogicalLines<'t> {
    text: &'t str,
    lexer: Lexer<'t>,
    tokens: Vec<Token>,
    /// The number of `tokens` that the last call handed out.
    taken: usize,
    has_ended: bool,
}

/// The state of the scan of a logical line.
#[derive(Default)]
struct LineScan {
    /// Open brackets: their kind and the physical line (counted within the logical one) where they were opened.
    open: Vec<(TokenKind, u32)>,
    /// Physical line within the logical one.
    line: u32,
    /// Index of the first token of the physical line.
    line_start: usize,
    /// Kind of the first token that is not white space.
    first: Option<TokenKind>,
    /// Whether a `=` was seen: only a value can take several lines.
    has_value: bool,
    /// Whether the physical line had a `]` or a `=`: only the first one can tell what the line is.
    is_decided: bool,
}

/// The token after the end of a logical line.
type LineEnd = Option<usize>;

impl<'t> LogicalLines<'t> {
    pub(crate) fn new(text: &'t str) -> Self {
        Self { text, lexer: Source::new(text).lex(), tokens: Vec::new(), taken: 0, has_ended: false }
    }

    /// The next logical line.
    pub(crate) fn next(&mut self) -> Option<LogicalLine<'_>> {
        self.tokens.drain(..self.taken);
        self.taken = 0;
        let mut scan = LineScan::default();
        let mut index = 0;
        loop {
            if index == self.tokens.len() && !self.pull() {
                break;
            }
            if let Some(end) = scan.step(self.text, &self.tokens, index) {
                self.taken = end;
                return self.tokens.get(..end).map(LogicalLine::Tokens);
            }
            index += 1;
            if index >= MOST_TOKENS {
                return Some(self.skip_long(scan.open.len()));
            }
        }
        self.taken = self.tokens.len();
        if self.tokens.is_empty() { None } else { Some(LogicalLine::Tokens(&self.tokens)) }
    }

    /// Lexes one more token; false at the end.
    fn pull(&mut self) -> bool {
        match self.lexer.next() {
            Some(token) if !self.has_ended => {
                self.has_ended = token.kind() == TokenKind::Eof;
                self.tokens.push(token);
                true
            }
            _ => false,
        }
    }

    /// Skips the rest of a logical line with `depth` open brackets.
    fn skip_long(&mut self, mut depth: usize) -> LogicalLine<'t> {
        let first = self.tokens.first().map(|token| Span::from(token.span())).unwrap_or_default();
        self.tokens.clear();
        for token in self.lexer.by_ref() {
            match token.kind() {
                TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => depth += 1,
                TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => {
                    depth = depth.saturating_sub(1);
                }
                TokenKind::Newline if depth == 0 => break,
                TokenKind::Eof => self.has_ended = true,
                _ => {}
            }
        }
        LogicalLine::TooLong(first)
    }
}

impl LineScan {
    /// Takes the token at `index` into account; the answer is not `None` when the logical line ends.
    fn step(&mut self, text: &str, tokens: &[Token], index: usize) -> LineEnd {
        let kind = tokens.get(index)?.kind();
        if !is_blank(kind) {
            self.first.get_or_insert(kind);
        }
        match kind {
            TokenKind::Newline => return self.end_line(index),
            TokenKind::Eof => return Some(index + 1),
            TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket if self.has_value => {
                self.open.push((kind, self.line));
            }
            TokenKind::RightSquareBracket => {
                let decides = self.line > 0 && !std::mem::replace(&mut self.is_decided, true);
                if decides && looks_like_header(text, tokens.get(self.line_start..=index)?) {
                    return Some(self.line_start);
                }
                self.open.pop();
            }
            TokenKind::RightCurlyBracket => {
                self.open.pop();
            }
            TokenKind::Equals => {
                let decides = self.line > 0 && !std::mem::replace(&mut self.is_decided, true);
                if decides && self.cannot_assign(tokens, index) {
                    return Some(self.line_start);
                }
                self.has_value = true;
            }
            _ => {}
        }
        None
    }

    /// At a newline: what has no open bracket ends here, and so does what is no assignment.
    fn end_line(&mut self, index: usize) -> LineEnd {
        let is_assignment = self.first.is_some_and(|kind| is_key_part(kind) || kind == TokenKind::Equals);
        if self.open.is_empty() || !is_assignment {
            return Some(index + 1);
        }
        self.line += 1;
        self.line_start = index + 1;
        self.is_decided = false;
        None
    }

    /// Whether the physical line up to the `=` at `index` is a key that cannot stand in the innermost bracket: in an
    /// array never, in an inline table that began on the line before not without a comma.
    fn cannot_assign(&self, tokens: &[Token], index: usize) -> bool {
        let Some(line) = tokens.get(self.line_start..index) else { return false };
        let mut parts = line.iter().map(Token::kind).filter(|&kind| !is_blank(kind));
        let is_key = parts.next().is_some_and(is_key_part)
            && parts.all(|kind| kind == TokenKind::Dot || is_key_part(kind));
        let before = tokens.get(..self.line_start).unwrap_or_default();
        let last = before.iter().rev().map(Token::kind).find(|&kind| !is_blank(kind));
        match self.open.last() {
            Some((TokenKind::LeftSquareBracket, _)) => is_key,
            Some((TokenKind::LeftCurlyBracket, line)) => {
                let is_separated = matches!(last, Some(TokenKind::Comma | TokenKind::LeftCurlyBracket));
                is_key && !is_separated && line + 1 == self.line
            }
            _ => false,
        }
    }
}

/// Whether the line is `[word…]` or `[[word…]]` so far, where the word cannot be a value.
fn looks_like_header(text: &str, line: &[Token]) -> bool {
    let mut rest = line.iter().filter(|token| token.kind() != TokenKind::Whitespace).peekable();
    if rest.next().map(Token::kind) != Some(TokenKind::LeftSquareBracket) {
        return false;
    }
    rest.next_if(|token| token.kind() == TokenKind::LeftSquareBracket);
    let Some(first) = rest.next() else { return false };
    let word = text.get(first.span().start()..first.span().end()).unwrap_or_default();
    let is_word = first.kind() == TokenKind::Atom
        && word.starts_with(|letter: char| letter.is_ascii_alphabetic())
        && !matches!(word, "true" | "false" | "inf" | "nan");
    let mut rest = rest.map(Token::kind);
    is_word
        && rest
            .all(|kind| is_key_part(kind) || matches!(kind, TokenKind::Dot | TokenKind::RightSquareBracket))
}

fn is_blank(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::Whitespace | TokenKind::Newline | TokenKind::Comment)
}

fn is_key_part(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::Atom | TokenKind::BasicString | TokenKind::LiteralString)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(text: &str) -> Vec<&str> {
        let mut lines = LogicalLines::new(text);
        let mut found = Vec::new();
        while let Some(line) = lines.next() {
            let LogicalLine::Tokens(tokens) = line else { panic!("too long") };
            let (first, last) = (tokens.first().unwrap(), tokens.last().unwrap());
            found.push(text[first.span().start()..last.span().end()].trim_end());
        }
        found.retain(|line| !line.is_empty());
        found
    }

    #[test]
    fn values_may_take_several_lines() {
        let text = "a = [\n 1, # one\n [2],\n]\r\nb = { c = [\n], d = 1 }\n[[e]]\nf = \"\"\"\n[x]\n\"\"\"\n";
        let lines =
            ["a = [\n 1, # one\n [2],\n]", "b = { c = [\n], d = 1 }", "[[e]]", "f = \"\"\"\n[x]\n\"\"\""];
        assert_eq!(cut(text), lines);
    }

    #[test]
    fn an_open_bracket_swallows_little() {
        assert_eq!(cut("a = [1,\nb = 2\n"), ["a = [1,", "b = 2"]);
        assert_eq!(cut("a = { c = 1\nb.d = 2\n"), ["a = { c = 1", "b.d = 2"]);
        assert_eq!(cut("a = { c = [1\n[[bodies]]\nb = 1"), ["a = { c = [1", "[[bodies]]", "b = 1"]);
        assert_eq!(cut("a = [\n[true],\n[1]]"), ["a = [\n[true],\n[1]]"]);
        assert_eq!(cut("[a\nb = 1"), ["[a", "b = 1"]);
        assert_eq!(cut("a = {\nc = 1,\nd = 2 }"), ["a = {\nc = 1,\nd = 2 }"]);
    }
}
