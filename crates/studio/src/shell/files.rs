//! Prompts for files: the system's dialog where there is one, else the studio's own.

mod dialog;

use std::sync::mpsc::{self, TryRecvError};

use crate::shell::host::FileQuestion;
use crate::shell::studio::Studio;
use crate::shell::studio::file_prompt::{FilePrompt, FilePromptChannel, FilePromptState};
use dialog::FileDialog;
pub(crate) use dialog::age;

impl FilePrompt {
    /// Asks `question`.
    pub(crate) fn start(studio: &mut Studio, question: FileQuestion) -> Self {
        let way = match studio.host.ask_file(&question) {
            Some(answer) => FilePromptChannel::System(answer),
            None => own(studio, &question),
        };
        Self { question, way }
    }

    /// The answer so far.
    pub(crate) fn poll(&mut self, context: &egui::Context, studio: &mut Studio) -> FilePromptState {
        match &self.way {
            FilePromptChannel::System(answer) => match answer.try_recv() {
                Ok(Some(path)) => FilePromptState::Chosen(self.complete(path)),
                Ok(None) => FilePromptState::Cancelled,
                Err(TryRecvError::Empty) => {
                    // The system does not wake the window.
                    context.request_repaint_after(std::time::Duration::from_millis(100));
                    FilePromptState::Waiting
                }
                // The system's dialog could not appear.
                Err(TryRecvError::Disconnected) => {
                    self.way = own(studio, &self.question);
                    FilePromptState::Waiting
                }
            },
            FilePromptChannel::Own(answer) => match answer.try_recv() {
                Ok(Some(chosen)) => FilePromptState::Chosen(chosen),
                Ok(None) | Err(TryRecvError::Disconnected) => FilePromptState::Cancelled,
                Err(TryRecvError::Empty) => FilePromptState::Waiting,
            },
        }
    }
}

fn own(studio: &mut Studio, question: &FileQuestion) -> FilePromptChannel {
    let (sender, receiver) = mpsc::channel();
    let recent = studio.settings.recent.iter().filter_map(|path| Some(path.parent()?.to_owned()));
    let dialog = FileDialog::new(question.clone(), studio.host.home_folder(), recent, sender);
    studio.dialogs.open(dialog);
    FilePromptChannel::Own(receiver)
}
