//! How quickly the studio answers, in a real window: `cargo xtask bench-studio` calls this.
//!
//! Events of a mouse are put into the window's input and wake it, so that everything runs as under a hand. A time "to
//! the screen" begins when the mouse moves and ends when the frame that draws the new picture has been handed over and
//! the next one begins.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a benchmark")]

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use catoptric_live::RenderJob;
use catoptric_studio::host::{FileAnswer, FileQuestion, Host};
use catoptric_studio::{StartDocument, Studio};
use catoptric_tracer::RenderSettings;
use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, Ui, vec2};

/// Between what is measured: time for a full picture and the first samples of its refinement.
const REST: Duration = Duration::from_millis(700);
/// How often a body is dragged.
const EDITS: usize = 30;
/// How long the camera is turned by a drag.
const ORBIT: Duration = Duration::from_secs(6);
/// How long the window is watched while a picture of 3840×2160 is made.
const RENDER: Duration = Duration::from_secs(8);

/// A system without files, so that each run begins alike.
struct Nowhere;

impl Host for Nowhere {
    fn ask_file(&mut self, _question: &FileQuestion) -> Option<FileAnswer> {
        None
    }

    fn settings_path(&self) -> Option<PathBuf> {
        None
    }

    fn recovery_folder(&self) -> Option<PathBuf> {
        None
    }
}

fn main() {
    let size: Vec<f32> = std::env::args().skip(1).map(|side| side.parse().unwrap()).collect();
    let viewport = egui::ViewportBuilder::default().with_inner_size([size[0], size[1]]);
    let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
    let create = |creation: &eframe::CreationContext<'_>| {
        catoptric_studio::prepare_window(creation);
        let studio = Studio::new(
            &creation.egui_ctx,
            &StartDocument::Example("four-bodies".to_owned()),
            Box::new(Nowhere),
        )?;
        Ok(Box::new(Bench::new(studio)) as Box<dyn eframe::App>)
    };
    eframe::run_native("Catoptric", options, Box::new(create)).unwrap();
}

/// What is being measured.
enum Phase {
    /// Waiting while the picture is being refined.
    Rest(Next, Instant),
    /// The button is down on a body, and the mouse will move in a moment; then the first new picture is awaited.
    Edit { since: Option<Instant>, revision: Option<u64>, is_drawn: bool },
    /// The camera is turned by a long drag.
    Orbit { since: Instant, last_picture: u64 },
    /// The pointer wanders while a large picture is made.
    Render { since: Instant, job: RenderJob },
}

/// What comes after the rest.
#[derive(Clone, Copy)]
enum Next {
    Edit,
    Orbit,
    Render,
}

struct Bench {
    studio: Studio,
    phase: Phase,
    events: Vec<Event>,
    /// The mouse's next move, when it comes: set by a thread of its own, as the system's events come.
    moved: Arc<Mutex<Option<(Instant, Pos2)>>>,
    pointer: Pos2,
    /// Milliseconds from a moved mouse to the new picture on the screen.
    edits: Vec<f64>,
    /// Milliseconds between new pictures while the camera is turned.
    gaps: Vec<f64>,
    /// Milliseconds of the window's thread in each frame while a large picture is made.
    frames: Vec<f64>,
    last_picture: Instant,
}

impl Bench {
    fn new(studio: Studio) -> Self {
        Self {
            studio,
            phase: Phase::Rest(Next::Edit, Instant::now()),
            events: Vec::new(),
            moved: Arc::default(),
            pointer: Pos2::ZERO,
            edits: Vec::new(),
            gaps: Vec::new(),
            frames: Vec::new(),
            last_picture: Instant::now(),
        }
    }

    fn point(&mut self, at: Pos2) {
        self.pointer = at;
        self.events.push(Event::PointerMoved(at));
    }

    fn button(&mut self, button: PointerButton, pressed: bool) {
        let modifiers = Modifiers::NONE;
        self.events.push(Event::PointerButton { pos: self.pointer, button, pressed, modifiers });
    }

    fn picture(&self) -> u64 {
        self.studio.live().latest().map_or(0, |frame| frame.picture_serial)
    }

    /// Goes on after a frame; `shown` is the revision of which a picture was surely drawn in it.
    fn advance(&mut self, context: &egui::Context, shown: u64, cpu: Option<f32>) {
        match &mut self.phase {
            Phase::Rest(next, since) => {
                let (next, since) = (*next, *since);
                // The pointer rests where it will press, as a hand's does.
                self.point(self.start());
                if since.elapsed() > REST && self.studio.viewport_rect().is_some() {
                    self.begin(context, next);
                }
                context.request_repaint_after(REST / 10);
            }
            Phase::Edit { since: None, .. } => {}
            Phase::Edit { since: Some(since), revision, is_drawn } => {
                if *is_drawn {
                    self.edits.push(milliseconds(*since));
                    self.button(PointerButton::Primary, false);
                    let next = if self.edits.len() < EDITS { Next::Edit } else { Next::Orbit };
                    self.phase = Phase::Rest(next, Instant::now());
                    context.request_repaint();
                } else if let Some(revision) = *revision {
                    *is_drawn = shown >= revision;
                    if *is_drawn {
                        context.request_repaint();
                    }
                } else if self.studio.editor().is_in_gesture() {
                    *revision = Some(self.studio.editor().revision());
                }
            }
            Phase::Orbit { since, last_picture } => {
                let since = *since;
                let picture = self.studio.live().latest().map_or(0, |frame| frame.picture_serial);
                if picture != *last_picture {
                    *last_picture = picture;
                    self.gaps.push(milliseconds(self.last_picture));
                    self.last_picture = Instant::now();
                }
                let turn = since.elapsed().as_secs_f32();
                context.request_repaint();
                let at = self.start() + vec2(220.0 * turn.sin(), 40.0 * (1.3 * turn).sin());
                self.point(at);
                if since.elapsed() > ORBIT {
                    self.button(PointerButton::Secondary, false);
                    self.phase = Phase::Rest(Next::Render, Instant::now());
                }
            }
            Phase::Render { since, job } => {
                self.frames.extend(cpu.map(|seconds| 1e3 * f64::from(seconds)));
                let is_over = since.elapsed() > RENDER || job.progress().is_finished;
                if is_over {
                    job.cancel();
                    self.report();
                    std::process::exit(0);
                }
                let turn = since.elapsed().as_secs_f32();
                context.request_repaint();
                let at = self.start() + vec2(300.0 * turn.sin(), 150.0 * (2.0 * turn).cos());
                self.point(at);
            }
        }
    }

    /// The middle of the picture, where a body is.
    fn start(&self) -> Pos2 {
        self.studio.viewport_rect().map_or(Pos2::ZERO, |rect| rect.center() + vec2(0.0, 0.2 * rect.height()))
    }

    fn begin(&mut self, context: &egui::Context, next: Next) {
        self.point(self.start());
        match next {
            Next::Edit => {
                self.button(PointerButton::Primary, true);
                self.phase = Phase::Edit { since: None, revision: None, is_drawn: false };
                let side = if self.edits.len().is_multiple_of(2) { 1.0 } else { -1.0 };
                let to = self.pointer + vec2(24.0 * side, 0.0);
                // Not in step with anything that the window does.
                let pause = Duration::from_millis(150 + (37 * self.edits.len() as u64) % 61);
                let (moved, window) = (Arc::clone(&self.moved), context.clone());
                std::thread::spawn(move || {
                    std::thread::sleep(pause);
                    *moved.lock().unwrap() = Some((Instant::now(), to));
                    window.request_repaint();
                });
                context.request_repaint();
            }
            Next::Orbit => {
                self.button(PointerButton::Secondary, true);
                self.last_picture = Instant::now();
                self.phase = Phase::Orbit { since: Instant::now(), last_picture: self.picture() };
            }
            Next::Render => {
                let scene = self.studio.editor().scene().clone();
                let settings = RenderSettings { width: 3840, height: 2160, samples: 16 };
                let job = RenderJob::start(scene, settings, None, 0).unwrap();
                self.phase = Phase::Render { since: Instant::now(), job };
            }
        }
    }

    /// One line a figure, for the chore that started this.
    fn report(&self) {
        let seconds = self.gaps.iter().sum::<f64>() / 1e3;
        let per_second = self.gaps.len() as f64 / seconds;
        println!("| edit to new picture on the screen, ms | {} |", spread(&self.edits));
        println!("| new pictures a second while turning | {per_second:.1} |");
        println!("| from one of these to the next, ms | {} |", spread(&self.gaps));
        println!(
            "| window's thread in a frame during a render of 3840×2160, ms | {} |",
            spread(&self.frames)
        );
        println!("| frames measured there | {} |", self.frames.len());
    }
}

impl eframe::App for Bench {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        let shown = self.studio.live().latest().map_or(0, |frame| frame.revision);
        let context = ui.ctx().clone();
        let cpu = frame.info().cpu_usage;
        self.studio.ui(ui);
        self.advance(&context, shown, cpu);
    }

    fn raw_input_hook(&mut self, _context: &egui::Context, input: &mut RawInput) {
        if let Some((at, to)) = self.moved.lock().unwrap().take() {
            self.events.push(Event::PointerMoved(to));
            self.pointer = to;
            if let Phase::Edit { since, .. } = &mut self.phase {
                *since = Some(at);
            }
        }
        input.events.append(&mut self.events);
    }
}

fn milliseconds(since: Instant) -> f64 {
    1e3 * since.elapsed().as_secs_f64()
}

/// Median, 95 % and largest.
fn spread(values: &[f64]) -> String {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| sorted.get((share * sorted.len() as f64) as usize).or(sorted.last()).copied();
    match (at(0.5), at(0.95), sorted.last()) {
        (Some(median), Some(nearly_all), Some(worst)) => {
            format!("median {median:.1}, 95 % {nearly_all:.1}, largest {worst:.1}")
        }
        _ => "none".to_owned(),
    }
}
