//! A scene that is being read, with what is said about it.

use std::collections::BTreeSet;
use std::ops::Range;

use catoptric_scene::bounds::ball_around;
use catoptric_scene::{Body, Camera, Diagnostic, Diagnostics, Light, Scene, ScenePart, Sentence, Severity};

use crate::message::Message;
use crate::options::{DEFAULT_SIZE, ImportOptions, ImportedScene};

/// How far shapes without end are drawn, meters.
pub(crate) const FAR: f64 = 1e4;

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
    /// Bodies that would have no end.
    endless: BTreeSet<usize>,
    /// Whether the camera is still to be put where it sees all bodies.
    is_to_be_framed: bool,
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
            endless: BTreeSet::new(),
            is_to_be_framed: false,
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
    pub(crate) fn unsupported(
        &mut self,
        span: &Range<usize>,
        message: impl Into<Sentence>,
        instead: Message,
    ) {
        let finding = if self.options.is_approximate {
            Diagnostic::said(Severity::Warning, span.clone(), message).labeled(instead)
        } else {
            let help = Message::Approximate { instead: instead.into() };
            Diagnostic::said(Severity::Error, span.clone(), message).helped(help)
        };
        self.push(finding);
    }

    /// Says that something is wrong with what stands there, which is then left out if the options allow it.
    pub(crate) fn refuse(&mut self, span: &Range<usize>, message: Message, help: Option<Message>) {
        match help {
            _ if self.options.is_approximate => self.unsupported(span, message, Message::LeftOut),
            Some(help) => self.error_with_help(span, message, help),
            None => self.error(span, message),
        }
    }

    /// Says that the camera is missing; if the options allow it, one that sees all bodies takes its place.
    pub(crate) fn lacks_camera(&mut self, span: &Range<usize>, message: impl Into<Sentence>) {
        self.is_to_be_framed = true;
        self.unsupported(span, message, Message::AllInView);
    }

    /// Adds a body that `span` describes.
    pub(crate) fn body(&mut self, body: Body, span: &Range<usize>) {
        self.bodies.push(body);
        self.body_spans.push(span.clone());
    }

    /// Adds a body of a shape without end, which is drawn as far as [`FAR`] and not brought into view.
    pub(crate) fn endless_body(&mut self, body: Body, span: &Range<usize>) {
        self.endless.insert(self.bodies.len());
        self.body(body, span);
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
            self.check();
        }
        self.found.locate(text);
        if self.found.has_errors() {
            // How something was read does not matter yet.
            self.found.retain(|finding| finding.severity != Severity::Note);
            return Err(self.found);
        }
        Ok(ImportedScene { scene: self.scene, report: self.found, size: self.size })
    }

    /// Reports what no scene may have. Bodies and lights that are so are left out if the options allow it.
    fn check(&mut self) {
        let (mut bodies, mut lights) = (BTreeSet::new(), BTreeSet::new());
        for problem in self.scene.check() {
            let sentence = Sentence::new(|language| problem.message(language));
            let span = match problem.part {
                ScenePart::Light(index) => self.light_spans.get(index),
                ScenePart::Body(index) => self.body_spans.get(index),
                _ => None,
            };
            let span = span.unwrap_or(&self.camera_span).clone();
            let is_first = match problem.part {
                ScenePart::Light(index) => lights.insert(index),
                ScenePart::Body(index) => bodies.insert(index),
                _ => true,
            };
            match problem.part {
                _ if !self.options.is_approximate => {
                    self.push(Diagnostic::said(Severity::Error, span, sentence));
                }
                ScenePart::Light(_) | ScenePart::Body(_) if is_first => {
                    self.unsupported(&span, sentence, Message::LeftOut);
                }
                ScenePart::Light(_) | ScenePart::Body(_) => {}
                ScenePart::Camera => self.lacks_camera(&span, sentence),
                _ => self.push(Diagnostic::said(Severity::Error, span, sentence)),
            }
        }
        if self.is_to_be_framed {
            self.frame(&bodies);
        }
        let mut index = 0..;
        self.scene.bodies.retain(|_| index.next().is_none_or(|index| !bodies.contains(&index)));
        let mut index = 0..;
        self.scene.lights.retain(|_| index.next().is_none_or(|index| !lights.contains(&index)));
    }

    /// Puts the camera where it sees all bodies but those left out, in the direction of the built-in scenes.
    fn frame(&mut self, left_out: &BTreeSet<usize>) {
        let is_seen = |index: &usize| !left_out.contains(index) && !self.endless.contains(index);
        let bodies = self.scene.bodies.iter().enumerate().filter(|(index, _)| is_seen(index));
        let [width, height] = self.size.unwrap_or(DEFAULT_SIZE).map(f64::from);
        let ball = ball_around(bodies.map(|(_, body)| body));
        let camera = ball.map(|ball| Camera::default().framing(&ball, width / height));
        self.scene.camera = camera.filter(Camera::is_valid).unwrap_or_default();
    }
}
