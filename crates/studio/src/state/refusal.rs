//! Why the document refused something, in the language of the window.

use catoptric_editor::{ActionError, RefusedChange};
use catoptric_scene::Shape;

use crate::base::texts::Texts;

/// Why an action was not done; `None` when there was nothing to do.
pub(crate) fn of_action(texts: &Texts, error: &ActionError) -> Option<String> {
    let key = match error {
        ActionError::NothingToDo => return None,
        ActionError::NothingSelected => "refused-nothing-selected",
        ActionError::Locked => "refused-locked",
        ActionError::OneBody => "refused-one-body",
        ActionError::Sheared { name } => {
            return Some(texts.with("refused-sheared", &[("name", name.as_str().into())]));
        }
        ActionError::NotJoined => "refused-not-joined",
        ActionError::WithinItself => "refused-within-itself",
        ActionError::TooDeep => return Some(at_most(texts, "refused-too-deep", Shape::MAX_DEPTH)),
        ActionError::TooManyParts => return Some(at_most(texts, "refused-too-many-parts", Shape::MAX_PARTS)),
        ActionError::NoSuchItem => "refused-no-such-item",
        ActionError::EmptyName => "refused-empty-name",
        ActionError::BadText(_) => "refused-bad-text",
        ActionError::NothingToPaste => "refused-nothing-to-paste",
        ActionError::Refused(refused) => return Some(of_change(texts, refused)),
    };
    Some(texts.get(key).to_owned())
}

fn at_most(texts: &Texts, key: &str, most: usize) -> String {
    texts.with(key, &[("most", most.into())])
}

/// Why a change was refused.
pub(crate) fn of_change(texts: &Texts, refused: &RefusedChange) -> String {
    let key = match refused.problems.first().map(|problem| problem.key) {
        Some("target") => "refused-target",
        Some("up") => "refused-up",
        Some("top") => "refused-axis",
        Some("name") => "refused-name",
        _ => "refused-range",
    };
    texts.get(key).to_owned()
}
