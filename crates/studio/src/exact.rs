//! Exact answers for the selected body: where the laws of optics put images, focal points and highlights.

use std::sync::Arc;

use catoptric_editor::Item;
use catoptric_lab::exact::{ExactAnswers, answers_for};
use catoptric_scene::{Camera, Scene};
use egui::Context;

use crate::context::Cx;
use crate::latest::Latest;

/// The exact answers of the window, if they are displayed.
#[derive(Default)]
pub(crate) struct ExactState {
    pub(crate) is_on: bool,
    work: Latest<ExactAnswerKey, ExactAnswers>,
    known: Option<(ExactAnswerKey, ExactAnswers)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct ExactAnswerKey {
    revision: u64,
    body: usize,
    camera: Camera,
}

impl ExactState {
    /// The answers for a body, while they are wanted: those for the last view while the view moves.
    pub(crate) fn answers(&self, body: usize) -> Option<&ExactAnswers> {
        let (key, answers) = self.known.as_ref().filter(|_| self.is_on)?;
        (key.body == body).then_some(answers)
    }
}

/// The body that is asked about.
pub(crate) fn body_of(cx: &Cx<'_>) -> Option<usize> {
    match cx.editor.selection().primary() {
        Some(Item::Body(body)) => Some(body),
        _ => None,
    }
}

/// Has the answers found out for the eye of `camera`.
pub(crate) fn keep_up(context: &Context, cx: &mut Cx<'_>, camera: Camera) {
    if let Some((key, Some(answers))) = cx.exact.work.poll() {
        cx.exact.known = Some((key, answers));
    }
    if cx.view.is_measuring {
        return;
    }
    let Some(body) = body_of(cx).filter(|_| cx.exact.is_on) else { return };
    let key = ExactAnswerKey { revision: cx.editor.revision(), body, camera };
    if cx.exact.known.as_ref().is_some_and(|(known, _)| *known == key) {
        return;
    }
    let scene = Arc::clone(cx.editor.scene());
    cx.exact.work.want(context, &key, move |_| {
        let seen = Scene { camera, ..(*scene).clone() };
        answers_for(&seen, Some(body))
    });
}
