//! The comparison: its commands, and what it compares now.

mod export;

use std::sync::Arc;

use catoptric_platform::time::{Duration, Instant};

use egui::Context;

use crate::panels::compare::{
    CompareFailure, CompareTask, ComparedPicture, ComparisonKey, ComparisonViewKey,
};
use crate::shell::studio::Studio;
use crate::state::command::CompareCommand;
use crate::state::layout::{self, Pane};
pub(crate) use export::poll as poll_opening;

/// Nothing is compared before view and scene have rested so long.
const REST: Duration = Duration::from_millis(300);

/// Does `act`.
pub(crate) fn run(studio: &mut Studio, act: CompareCommand) {
    match act {
        CompareCommand::Swap => studio.panes.compare.sides.swap(0, 1),
        CompareCommand::FileA => export::ask_for_picture(studio, 0),
        CompareCommand::FileB => export::ask_for_picture(studio, 1),
        CompareCommand::Save => export::ask_to_save(studio),
    }
}

/// Has the comparison follow scene, view and choices while its panel can be seen; once a frame.
pub(crate) fn keep_up(context: &Context, studio: &mut Studio) {
    take_result(studio);
    if !layout::is_in_front(&studio.layout, Pane::Compare) || studio.view.is_measuring {
        studio.panes.compare.cancel();
        studio.panes.compare.wanted = None;
        return;
    }
    let Some(key) = key(studio) else { return };
    let is_moving = studio.view.is_moving || studio.editor.is_in_gesture();
    let comparing = &mut studio.panes.compare;
    let since = match &comparing.wanted {
        Some((wanted, since)) if *wanted == key => *since,
        _ => {
            studio.settings.compared = comparing.chosen();
            comparing.wanted = Some((key.clone(), Instant::now()));
            Instant::now()
        }
    };
    if comparing.running.as_ref().is_some_and(|running| running.key != key) {
        comparing.cancel();
    }
    let is_known = comparing.found.as_ref().is_some_and(|found| found.key == key)
        || comparing.failed.as_ref().is_some_and(|(failed, _)| *failed == key);
    if is_known || comparing.running.is_some() {
        return;
    }
    // The first comparison need not wait for a rest.
    let rest = if comparing.found.is_none() { Duration::ZERO } else { REST };
    if is_moving || since.elapsed() < rest {
        context.request_repaint_after(rest.saturating_sub(since.elapsed()).max(Duration::from_millis(16)));
        return;
    }
    let scene = Arc::clone(studio.editor.scene());
    match CompareTask::start(context, key.clone(), scene, studio.editor.title().to_owned()) {
        Ok(running) => comparing.running = Some(running),
        Err(error) => comparing.failed = Some((key, CompareFailure::Fault(error.to_string()))),
    }
}

fn key(studio: &Studio) -> Option<ComparisonKey> {
    let comparing = &studio.panes.compare;
    let sources = comparing.sources();
    if sources.iter().all(ComparedPicture::is_file) {
        return Some(ComparisonKey { sources, view: None });
    }
    let size = studio.panes.viewport.size_in_pixels()?;
    let size = size.map(|side| (side / comparing.coarseness.max(1)).max(1));
    let (revision, camera) = (studio.editor.revision(), studio.shown_camera());
    Some(ComparisonKey { sources, view: Some(ComparisonViewKey { revision, camera, size }) })
}

fn take_result(studio: &mut Studio) {
    let comparing = &mut studio.panes.compare;
    let Some(running) = &comparing.running else { return };
    let Some(result) = running.result() else { return };
    let key = running.key.clone();
    comparing.running = None;
    match result {
        Ok(found) => {
            comparing.found = Some(Arc::new(found));
            comparing.failed = None;
        }
        Err(CompareFailure::Cancelled) => {}
        Err(failure) => comparing.failed = Some((key, failure)),
    }
}
