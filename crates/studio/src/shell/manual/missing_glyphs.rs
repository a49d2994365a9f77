//! Replacements of rare signs that the fonts of the window do not have.

use std::rc::Rc;

use super::formula::{Formula, FormulaNode};
use super::markdown::TextSpanKind;
use crate::base::scripts::Script;

/// The sign that puts a hat on the letter before it.
const HAT: char = '\u{302}';
/// The accent of a stressed syllable, which can be done without.
const ACCENT: char = '\u{301}';

fn other(sign: char) -> char {
    match sign {
        'ꟻ' => 'F',
        '⎮' => '|',
        sign => sign,
    }
}

/// Running text in pieces: where letters wear hats or have indices, these are formulas.
pub(super) fn pieces(text: &str) -> Vec<TextSpanKind> {
    let mut pieces = Vec::new();
    let mut run = String::new();
    for sign in text.chars().filter(|sign| *sign != ACCENT) {
        if sign != HAT && Script::of(sign).is_none() {
            run.push(other(sign));
            continue;
        }
        let Some(base) = base(&mut run, &mut pieces) else { continue };
        let node = match Script::of(sign) {
            Some(Script::Above(letter)) => {
                FormulaNode::scripted(base, None, Some(FormulaNode::letter(letter)))
            }
            Some(Script::Below(letter)) => {
                FormulaNode::scripted(base, Some(FormulaNode::letter(letter)), None)
            }
            None => FormulaNode::Hat(Box::new(base)),
        };
        pieces.push(TextSpanKind::Formula(Rc::new(Formula::of(node))));
    }
    if !run.is_empty() {
        pieces.push(TextSpanKind::Text(run));
    }
    pieces
}

/// What a hat or an index belongs to: the last letter, or the formula before it. The text before the letter is a piece.
fn base(run: &mut String, pieces: &mut Vec<TextSpanKind>) -> Option<FormulaNode> {
    if let Some(letter) = run.pop() {
        if !run.is_empty() {
            pieces.push(TextSpanKind::Text(std::mem::take(run)));
        }
        return Some(FormulaNode::letter(letter));
    }
    match pieces.pop()? {
        TextSpanKind::Formula(formula) => Some(formula.node().clone()),
        other => {
            pieces.push(other);
            None
        }
    }
}

/// Text without the signs that are missing: indices and exponents are written out, hats left to [`hats`].
pub(super) fn simplified(text: &str) -> String {
    let mut simple = String::new();
    for sign in text.chars().filter(|sign| !matches!(*sign, HAT | ACCENT)) {
        match Script::of(sign) {
            Some(Script::Above(letter)) => simple.extend(['^', letter]),
            Some(Script::Below(letter)) => simple.extend(['_', letter]),
            None => simple.push(other(sign)),
        }
    }
    simple
}

/// Which letters of the [`simplified`] text wear a hat, counted from 0.
pub(super) fn hats(text: &str) -> Vec<usize> {
    let mut hats = Vec::new();
    let mut place = 0_usize;
    for sign in text.chars() {
        match sign {
            HAT => hats.extend(usize::checked_sub(place, 1)),
            ACCENT => {}
            sign if Script::of(sign).is_some() => place += 2,
            _ => place += 1,
        }
    }
    hats
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hats_and_indices_become_formulas() {
        let told: Vec<String> = pieces("the n̂·L̂ⁿ of aᵢ")
            .iter()
            .map(|piece| match piece {
                TextSpanKind::Text(text) => format!("t {text}"),
                TextSpanKind::Formula(formula) => format!("f {}", formula.plain()),
                _ => String::new(),
            })
            .collect();
        assert_eq!(told, ["t the ", "f n", "t ·", "f L^n", "t  of ", "f a_i"]);
    }

    #[test]
    fn code_keeps_its_columns() {
        assert_eq!(simplified("n̂·L̂ = 0"), "n·L = 0");
        assert_eq!(hats("n̂·L̂ = 0"), [0, 2]);
        assert_eq!(simplified("(Ŝ)ⁿ x̂"), "(Ŝ)^n x");
        assert_eq!(hats("(Ŝ)ⁿ x̂"), [6]);
    }
}
