//! The page as the studio's host.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::mpsc::{self, Receiver, Sender};

use catoptric_studio::host::{FileAnswer, FileQuestion, Host, HostAbilities, LinkOutcome};

use crate::page::{FileRequest, PageCommand};

/// The folder of what the studio keeps for itself.
const OWN_FOLDER: &str = "/catoptric";

/// The folder of the person's files. What is written there is given to the person.
pub(crate) const PERSONS_FOLDER: &str = "/files";

/// The page as the studio's host. Clones are the same one.
#[derive(Clone, Debug, Default)]
pub(crate) struct PageHost {
    /// Whether the picture stands alone on somebody's page: nothing is kept then.
    is_embedded: bool,
    questions: Rc<RefCell<Questions>>,
}

/// The questions that the person has not answered yet.
#[derive(Debug, Default)]
struct Questions {
    /// The number of the next one.
    next: u32,
    open: BTreeMap<u32, Sender<Option<PathBuf>>>,
    /// What the page has not been told of.
    untold: Vec<PageCommand>,
    /// Who wants to know what became of a link.
    linking: Option<Sender<LinkOutcome>>,
}

impl PageHost {
    pub(crate) fn new(is_embedded: bool) -> Self {
        Self { is_embedded, questions: Rc::default() }
    }

    /// What the page is to ask.
    pub(crate) fn take_questions(&self) -> impl Iterator<Item = PageCommand> {
        std::mem::take(&mut self.questions.borrow_mut().untold).into_iter()
    }

    /// The person chose this file, or none.
    pub(crate) fn answer(&self, id: u32, path: Option<PathBuf>) {
        if let Some(asker) = self.questions.borrow_mut().open.remove(&id) {
            // Who asked may not care any more.
            let _ = asker.send(path);
        }
    }
}

impl PageHost {
    /// This became of the link.
    pub(crate) fn link_done(&self, outcome: LinkOutcome) {
        if let Some(asker) = self.questions.borrow_mut().linking.take() {
            // Who asked may not care any more.
            let _ = asker.send(outcome);
        }
    }
}

impl Host for PageHost {
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer> {
        let (sender, answer) = mpsc::channel();
        let mut questions = self.questions.borrow_mut();
        let id = questions.next;
        questions.next += 1;
        questions.open.insert(id, sender);
        questions.untold.push(PageCommand::AskFile(FileRequest {
            id,
            is_saving: question.is_saving,
            title: question.title.clone(),
            name: question.name.clone(),
            extensions: question.kind.extensions(),
        }));
        Some(answer)
    }

    fn settings_path(&self) -> Option<PathBuf> {
        (!self.is_embedded).then(|| Path::new(OWN_FOLDER).join("settings.json"))
    }

    fn recovery_folder(&self) -> Option<PathBuf> {
        (!self.is_embedded).then(|| Path::new(OWN_FOLDER).join("recovery"))
    }

    fn abilities(&self) -> HostAbilities {
        HostAbilities { has_links: true, can_quit: false, comes_back: !self.is_embedded }
    }

    fn copy_link(&mut self, view: String) -> Option<Receiver<LinkOutcome>> {
        let (sender, answer) = mpsc::channel();
        let mut questions = self.questions.borrow_mut();
        questions.linking = Some(sender);
        questions.untold.push(PageCommand::Link { view });
        Some(answer)
    }

    fn home_folder(&self) -> Option<PathBuf> {
        Some(PERSONS_FOLDER.into())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::TryRecvError;

    use catoptric_studio::host::FileKind;

    use super::*;

    fn question(name: &str) -> FileQuestion {
        FileQuestion {
            kind: FileKind::Scene,
            is_saving: true,
            title: "Save as".to_owned(),
            folder: None,
            name: name.to_owned(),
        }
    }

    #[test]
    fn each_question_gets_its_own_answer() {
        let page = PageHost::default();
        let mut host = page.clone();
        let [one, other] = ["a.toml", "b.toml"].map(|name| host.ask_file(&question(name)).unwrap());
        let told: Vec<PageCommand> = page.take_questions().collect();
        let [PageCommand::AskFile(first), PageCommand::AskFile(second)] = &told[..] else {
            panic!("{told:?}")
        };
        assert_eq!((first.name.as_str(), second.name.as_str()), ("a.toml", "b.toml"));
        page.answer(second.id, Some("/files/b.toml".into()));
        assert_eq!(other.try_recv(), Ok(Some("/files/b.toml".into())));
        assert_eq!(one.try_recv(), Err(TryRecvError::Empty));
        page.answer(first.id, None);
        assert_eq!(one.try_recv(), Ok(None));
        assert_eq!(page.take_questions().count(), 0);
    }
}
