//! Asking for a file.

use std::path::PathBuf;
use std::sync::mpsc::TryRecvError;

use crate::app::Studio;
use crate::host::{FileAnswer, FileQuestion};

/// A file that was chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Chosen {
    pub(crate) path: PathBuf,
    /// Whether the person has agreed that a file there is replaced.
    pub(crate) may_replace: bool,
}

/// The answer to a question for a file.
pub(crate) enum Answer {
    Waiting,
    Cancelled,
    Chosen(Chosen),
}

/// A question that has been asked; to be polled once a frame.
pub(crate) struct Asking {
    question: FileQuestion,
    answer: Option<FileAnswer>,
}

impl Asking {
    pub(crate) fn start(studio: &mut Studio, question: FileQuestion) -> Self {
        Self { answer: studio.host.ask_file(&question), question }
    }

    pub(crate) fn poll(&mut self, context: &egui::Context, _studio: &mut Studio) -> Answer {
        let Some(answer) = &self.answer else { return Answer::Cancelled };
        match answer.try_recv() {
            Ok(Some(path)) => {
                let fits = self.question.kind.extensions().iter().any(|fitting| {
                    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(fitting))
                });
                if fits {
                    return Answer::Chosen(Chosen { path, may_replace: true });
                }
                let mut whole = path.into_os_string();
                whole.push(".png");
                Answer::Chosen(Chosen { path: whole.into(), may_replace: false })
            }
            Ok(None) | Err(TryRecvError::Disconnected) => Answer::Cancelled,
            Err(TryRecvError::Empty) => {
                context.request_repaint_after(std::time::Duration::from_millis(100));
                Answer::Waiting
            }
        }
    }
}
