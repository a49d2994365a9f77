//! Exact answers for the selected body: where the laws of optics put images, focal points and highlights.

use std::sync::Arc;

use catoptric_editor::Editor;
use catoptric_lab::exact::{ExactAnswers, answers_for};
use catoptric_scene::{Camera, Scene, ScenePart};
use egui::Context;

use crate::base::latest::Latest;

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

    /// Takes up the answers that were found.
    pub(crate) fn poll(&mut self) {
        if let Some((key, Some(answers))) = self.work.poll() {
            self.known = Some((key, answers));
        }
    }

    /// Has the answers for the selected body found out for the eye of `camera`.
    pub(crate) fn want(&mut self, context: &Context, editor: &Editor, camera: Camera) {
        let Some(body) = body_of(editor).filter(|_| self.is_on) else { return };
        let key = ExactAnswerKey { revision: editor.revision(), body, camera };
        if self.known.as_ref().is_some_and(|(known, _)| *known == key) {
            return;
        }
        let scene = Arc::clone(editor.scene());
        self.work.want(context, &key, move |_| {
            let seen = Scene { camera, ..(*scene).clone() };
            answers_for(&seen, Some(body))
        });
    }
}

/// The body that is asked about.
pub(crate) fn body_of(editor: &Editor) -> Option<usize> {
    match editor.primary_part() {
        Some(ScenePart::Body(body)) => Some(body),
        _ => None,
    }
}
