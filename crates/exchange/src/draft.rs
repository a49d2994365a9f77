//! A scene that is being read, with what is said about it.

use std::ops::Range;

use catoptric_scene::{Body, Diagnostic, Diagnostics, Light, Scene, ScenePart, Sentence, Severity};

use crate::message::Message;
use crate::options::{ImportOptions, ImportedScene};

/// The findings about a text that is too long to be read.
pub(crate) fn too_long() -> Diagnostics {
    let mut found = Diagnostics::default();
    let most = (crate::options::LONGEST_FILE >> 20).to_string();
    found.push(Diagnostic::said(Severity::Error, 0..0, Message::TooLong { most }));
    found.locate("");
    found
}

/// A scene that is being read.
#[derive(Debug)]
pub(crate) struct Draft {
    pub(crate) scene: Scene,
    pub(crate) options: ImportOptions,
    pub(crate) size: Option<[u32; 2]>,
    pub(crate) camera_span: Range<usize>,
    bodies: Vec<Body>,
    body_spans: Vec<Range<usize>>,
    light_spans: Vec<Range<usize>>,
    found: Diagnostics,
}

impl Draft {
    /// A scene without anything, black all around.
    pub(crate) fn new(options: &ImportOptions) -> Self {
        let mut scene = Scene::default();
        scene.environment.background = catoptric_scene::Color::BLACK;
        scene.environment.ambient = catoptric_scene::Color::BLACK;
        Self {
            scene,
            options: *options,
            size: options.size,
            camera_span: 0..0,
            bodies: Vec::new(),
            body_spans: Vec::new(),
            light_spans: Vec::new(),
            found: Diagnostics::default(),
        }
    }

    /// Adds a finding.
    pub(crate) fn push(&mut self, finding: Diagnostic) {
        self.found.push(finding);
    }

    /// Adds an error.
    pub(crate) fn error(&mut self, span: &Range<usize>, message: Message) {
        self.push(Diagnostic::said(Severity::Error, span.clone(), message));
    }

    /// Adds an error with help.
    pub(crate) fn error_with_help(&mut self, span: &Range<usize>, message: Message, help: Message) {
        self.push(Diagnostic::said(Severity::Error, span.clone(), message).helped(help));
    }

    /// Says in which of several ways something was read.
    pub(crate) fn note(&mut self, span: &Range<usize>, message: Message, help: Option<Message>) {
        let note = Diagnostic::said(Severity::Note, span.clone(), message);
        self.push(match help {
            Some(help) => note.helped(help),
            None => note,
        });
    }

    /// Says that something is taken over inexactly, whatever the options.
    pub(crate) fn warn(&mut self, span: &Range<usize>, message: Message) {
        self.push(Diagnostic::said(Severity::Warning, span.clone(), message));
    }

    /// Says that the scene cannot say something, and what stands in its place: an error, unless the options allow it.
    pub(crate) fn unsupported(&mut self, span: &Range<usize>, message: Message, instead: Message) {
        let finding = if self.options.is_approximate {
            Diagnostic::said(Severity::Warning, span.clone(), message).labeled(instead)
        } else {
            let help = Message::Approximate { instead: instead.into() };
            Diagnostic::said(Severity::Error, span.clone(), message).helped(help)
        };
        self.push(finding);
    }

    /// Adds a body that `span` describes.
    pub(crate) fn body(&mut self, body: Body, span: &Range<usize>) {
        self.bodies.push(body);
        self.body_spans.push(span.clone());
    }

    /// All bodies.
    pub(crate) fn bodies_mut(&mut self) -> &mut [Body] {
        &mut self.bodies
    }

    /// Adds a light that `span` describes.
    pub(crate) fn light(&mut self, light: Light, span: &Range<usize>) {
        self.scene.lights.push(light);
        self.light_spans.push(span.clone());
    }

    /// Whether an error was found.
    pub(crate) fn has_errors(&self) -> bool {
        self.found.has_errors()
    }

    /// The scene, if it is one: what no scene may have is an error of what describes it.
    pub(crate) fn finish(mut self, text: &str) -> Result<ImportedScene, Diagnostics> {
        self.scene.bodies = std::mem::take(&mut self.bodies).into();
        if !self.has_errors() {
            for problem in self.scene.check() {
                let span = match problem.part {
                    ScenePart::Light(index) => self.light_spans.get(index),
                    ScenePart::Body(index) => self.body_spans.get(index),
                    _ => None,
                };
                let span = span.unwrap_or(&self.camera_span).clone();
                let sentence = Sentence::new(|language| problem.message(language));
                self.found.push(Diagnostic::said(Severity::Error, span, sentence));
            }
        }
        self.found.locate(text);
        if self.found.has_errors() {
            // How something was read does not matter yet.
            self.found.retain(|finding| finding.severity != Severity::Note);
            return Err(self.found);
        }
        Ok(ImportedScene { scene: self.scene, report: self.found, size: self.size })
    }
}
