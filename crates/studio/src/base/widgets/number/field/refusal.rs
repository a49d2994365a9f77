//! The reason of a refused text, in words.

use catoptric_scene::format::spec::Limits;

use super::super::expression::{ExpressionError, ExpressionErrorKind};
use super::super::{Unit, exact};
use crate::base::texts::Texts;

/// The messages about limits: in general, and for lengths.
const LIMITS: [&str; 2] = ["limits", "limits-positive"];
const REFUSED_LIMITS: [&str; 2] = ["refused-limits", "refused-limits-positive"];

/// A text that is not taken.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    pub(crate) text: String,
    pub(crate) unit: Unit,
    pub(crate) reason: RefusalReason,
}

/// The reason why a text is refused.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum RefusalReason {
    /// The text is no number.
    Fault(ExpressionError),
    /// A number of things is whole.
    NotWhole,
    /// The number lies outside of the limits.
    OutOfLimits(Limits),
}

impl Refusal {
    /// What is wrong, where, and what is allowed.
    pub(crate) fn explained(&self, texts: &Texts) -> String {
        let fault = match &self.reason {
            RefusalReason::OutOfLimits(limits) => return between(texts, REFUSED_LIMITS, *limits, ""),
            RefusalReason::NotWhole => return texts.get("refused-not-whole").to_owned(),
            RefusalReason::Fault(fault) => fault,
        };
        let allowed = match self.unit {
            Unit::Meters => "allowed-length",
            Unit::Degrees => "allowed-angle",
            Unit::None | Unit::Pixels | Unit::Stops => "allowed-plain",
        };
        let part: String = self.text.trim().chars().skip(fault.place.start).take(fault.place.len()).collect();
        let arguments = [("part", part.into()), ("at", (fault.place.start + 1).into())];
        let problem = texts.with(key_of(fault.kind), &arguments);
        let arguments = [("problem", problem.into()), ("allowed", texts.get(allowed).into())];
        texts.with("refused-no-number", &arguments)
    }
}

const fn key_of(kind: ExpressionErrorKind) -> &'static str {
    match kind {
        ExpressionErrorKind::Unknown => "fault-unknown",
        ExpressionErrorKind::NumberMissing => "fault-number-missing",
        ExpressionErrorKind::OperatorMissing => "fault-operator-missing",
        ExpressionErrorKind::Parenthesis => "fault-parenthesis",
        ExpressionErrorKind::ArgumentMissing => "fault-argument-missing",
        ExpressionErrorKind::AmbiguousComma => "fault-ambiguous-comma",
        ExpressionErrorKind::Number => "fault-number",
        ExpressionErrorKind::Unit => "fault-unit",
        ExpressionErrorKind::PowerOfUnit => "fault-power-of-unit",
        ExpressionErrorKind::NotFinite => "fault-not-finite",
        ExpressionErrorKind::TooLong => "fault-too-long",
    }
}

/// The limits of a number, in words.
pub(crate) fn limits_in_words(texts: &Texts, limits: Limits, unit: &str) -> String {
    between(texts, LIMITS, limits, unit)
}

/// A message about a range. Lengths begin so close to 0 that people need not know where.
fn between(texts: &Texts, [key, positive_key]: [&str; 2], limits: Limits, unit: &str) -> String {
    let [min, max] = [limits.min, limits.max].map(|limit| format!("{}{unit}", exact(texts, limit)));
    if limits.min > 0.0 && limits.min < 1e-6 {
        return texts.with(positive_key, &[("max", max.into())]);
    }
    texts.with(key, &[("min", min.into()), ("max", max.into())])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;
    use crate::base::widgets::number::evaluate;

    #[test]
    fn a_refusal_names_what_where_and_what_is_allowed() {
        for language in Language::ALL {
            let texts = Texts::new(language);
            for (text, named) in [("0.5abc", "abc"), ("1 + (2", "("), ("2 $", "$"), ("1 2", "2")] {
                for unit in [Unit::None, Unit::Meters, Unit::Degrees] {
                    let fault = evaluate(text, unit, language.decimal_sign()).unwrap_err();
                    let at = (fault.place.start + 1).to_string();
                    let refusal =
                        Refusal { text: text.to_owned(), unit, reason: RefusalReason::Fault(fault) };
                    let told = refusal.explained(&texts);
                    assert!(told.contains(named) && told.contains(&at) && told.contains("sqrt"), "{told}");
                }
            }
            let kinds = [
                ExpressionErrorKind::ArgumentMissing,
                ExpressionErrorKind::AmbiguousComma,
                ExpressionErrorKind::Number,
                ExpressionErrorKind::NumberMissing,
                ExpressionErrorKind::Unit,
                ExpressionErrorKind::PowerOfUnit,
                ExpressionErrorKind::NotFinite,
                ExpressionErrorKind::TooLong,
            ];
            for kind in kinds {
                let reason = RefusalReason::Fault(ExpressionError { kind, place: 0..1 });
                let _ = Refusal { text: "1,500".to_owned(), unit: Unit::None, reason }.explained(&texts);
            }
            assert_eq!(texts.missing(), Vec::<String>::new());
        }
    }
}
