//! The words, signs and numbers of a typed text.

use std::ops::Range;

use super::{ExpressionError, ExpressionErrorKind, TypedWord, word};
use crate::base::texts::DecimalSign;

/// A part of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(f64),
    /// `+`, `-`, `*`, `/` or `^`.
    Sign(char),
    Open,
    Close,
    Word(&'t str),
}

/// Cuts a text into tokens.
pub(super) struct Lexer<'t> {
    text: &'t str,
    /// The letters with their places in bytes.
    letters: Vec<(usize, char)>,
    next: usize,
    sign: DecimalSign,
}

impl<'t> Lexer<'t> {
    pub(super) fn new(text: &'t str, sign: DecimalSign) -> Self {
        Self { text, letters: text.char_indices().collect(), next: 0, sign }
    }

    /// All tokens with their places, counted in letters.
    pub(super) fn tokens(mut self) -> Result<Vec<(Token<'t>, Range<usize>)>, ExpressionError> {
        let mut tokens = Vec::new();
        while let Some(letter) = self.letter(0) {
            let start = self.next;
            if letter.is_whitespace() {
                self.next += 1;
                continue;
            }
            let token = self.token(letter)?;
            tokens.push((token, start..self.next));
        }
        Ok(tokens)
    }

    fn letter(&self, ahead: usize) -> Option<char> {
        self.letters.get(self.next + ahead).map(|&(_, letter)| letter)
    }

    fn is_figure(&self, ahead: usize) -> bool {
        self.letter(ahead).is_some_and(|letter| letter.is_ascii_digit())
    }

    fn token(&mut self, letter: char) -> Result<Token<'t>, ExpressionError> {
        if letter.is_ascii_digit() || (matches!(letter, '.' | ',') && self.is_figure(1)) {
            return self.number();
        }
        let start = self.next;
        if letter.is_alphabetic() {
            while self.letter(0).is_some_and(char::is_alphabetic) {
                self.next += 1;
            }
            return Ok(Token::Word(self.part(start)));
        }
        self.next += 1;
        Ok(match letter {
            '+' => Token::Sign('+'),
            '-' | '−' | '–' => Token::Sign('-'),
            '*' if self.letter(0) == Some('*') => {
                self.next += 1;
                Token::Sign('^')
            }
            '*' | '×' | '·' | '⋅' => Token::Sign('*'),
            '/' | '÷' => Token::Sign('/'),
            '^' => Token::Sign('^'),
            '(' => Token::Open,
            ')' => Token::Close,
            '°' | '√' => Token::Word(self.part(start)),
            _ => return Err(ExpressionError { kind: ExpressionErrorKind::Unknown, place: start..self.next }),
        })
    }

    /// The text from letter `start` to the next one.
    fn part(&self, start: usize) -> &'t str {
        let byte = |at: usize| self.letters.get(at).map_or(self.text.len(), |&(byte, _)| byte);
        self.text.get(byte(start)..byte(self.next)).unwrap_or_default()
    }

    /// Figures, a decimal sign and an exponent. Spaces may stand before groups of three figures.
    fn number(&mut self) -> Result<Token<'t>, ExpressionError> {
        let start = self.next;
        let mut plain = String::new();
        self.figures(&mut plain);
        let is_grouped = self.groups(&mut plain);
        if let Some(sign @ ('.' | ',')) = self.letter(0) {
            self.next += 1;
            let whole = std::mem::take(&mut plain);
            self.figures(&mut plain);
            let is_thousands = plain.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0');
            if sign == ',' && self.sign == DecimalSign::Point && is_thousands && !is_grouped {
                return Err(ExpressionError {
                    kind: ExpressionErrorKind::AmbiguousComma,
                    place: start..self.next,
                });
            }
            plain = format!("{whole}.{plain}");
        }
        self.exponent(&mut plain);
        let follows = self.letter(0).is_some_and(|letter| letter == '.' || letter == ',');
        let fault = |kind, end| Err(ExpressionError { kind, place: start..end });
        if follows {
            return fault(ExpressionErrorKind::Number, self.next + 1);
        }
        if let Some(end) = self.end_of_bare_word() {
            return Err(ExpressionError { kind: ExpressionErrorKind::Unknown, place: self.next..end });
        }
        match plain.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Token::Number(number)),
            Ok(_) => fault(ExpressionErrorKind::NotFinite, self.next),
            Err(_) => fault(ExpressionErrorKind::Number, self.next),
        }
    }

    fn figures(&mut self, plain: &mut String) {
        while let Some(figure) = self.letter(0).filter(char::is_ascii_digit) {
            plain.push(figure);
            self.next += 1;
        }
    }

    /// Groups of three figures, each after a space; returns whether there are any.
    fn groups(&mut self, plain: &mut String) -> bool {
        let mut is_grouped = false;
        while self.letter(0).is_some_and(char::is_whitespace)
            && (1..=3).all(|ahead| self.is_figure(ahead))
            && !self.is_figure(4)
            && (is_grouped || (1..=3).contains(&plain.len()))
        {
            self.next += 1;
            self.figures(plain);
            is_grouped = true;
        }
        is_grouped
    }

    fn exponent(&mut self, plain: &mut String) {
        let is_exponent = matches!(self.letter(0), Some('e' | 'E' | 'е' | 'Е'));
        let is_negative = matches!(self.letter(1), Some('-' | '−'));
        let digits = 1 + usize::from(is_negative || self.letter(1) == Some('+'));
        if is_exponent && self.is_figure(digits) {
            plain.push_str(if is_negative { "e-" } else { "e" });
            self.next += digits;
            self.figures(plain);
        }
    }

    /// The end of a word right after a number that is none of ours.
    fn end_of_bare_word(&self) -> Option<usize> {
        let mut ahead = 0;
        while self.letter(ahead).is_some_and(char::is_alphabetic) {
            ahead += 1;
        }
        let end = self.next + ahead;
        let bytes = |at: usize| self.letters.get(at).map_or(self.text.len(), |&(byte, _)| byte);
        let text = self.text.get(bytes(self.next)..bytes(end)).unwrap_or_default();
        let is_ours =
            matches!(word(text), Some(TypedWord::Unit(_) | TypedWord::Constant(_) | TypedWord::Function(_)));
        (ahead > 0 && !is_ours).then_some(end)
    }
}
