//! Runs the commands of the audit.

mod export;

use std::sync::Arc;

use egui::{Context, OutputCommand};

use crate::panels::viewport::ROOM_BELOW_PIXEL;
use crate::shell::camera;
use crate::shell::studio::Studio;
use crate::state::command::AuditCommand;
use crate::state::layout::{self, Pane};

/// Does `act`.
pub(crate) fn run(context: &Context, studio: &mut Studio, act: AuditCommand) {
    let found = studio.audit.found().cloned();
    let generations = found.as_ref().map_or(0, |found| found.generations());
    let span = found.as_ref().map(|found| found.span).unwrap_or_default();
    match act {
        AuditCommand::Tool => {
            studio.view.is_auditing = !studio.view.is_auditing;
            studio.view.is_aiming = false;
            // The panel comes with the first pixel, and goes with the tool.
            if !studio.view.is_auditing || studio.audit.pin().is_some() {
                layout::set_visible(&mut studio.layout, Pane::Audit, studio.view.is_auditing);
            }
        }
        AuditCommand::Release => studio.audit.release(),
        AuditCommand::View => {
            if let Some(pin) = studio.audit.pin().copied() {
                camera::look_through(studio, pin.home);
            }
        }
        AuditCommand::Previous => {
            let shown = studio.audit.step.unwrap_or(generations);
            studio.audit.step = Some(shown.saturating_sub(1).max(1)).filter(|step| *step < generations);
        }
        AuditCommand::Next => {
            studio.audit.step = studio.audit.step.map(|step| step + 1).filter(|step| *step < generations);
        }
        AuditCommand::All => {
            studio.audit.step = None;
            studio.audit.light.end();
        }
        AuditCommand::Play => studio.audit.light.toggle(&span),
        AuditCommand::Copy => {
            if let Some(found) = found {
                let text = found.audit.to_text(None);
                context.output_mut(|output| output.commands.push(OutputCommand::CopyText(text)));
                studio.toasts.success(studio.texts.get("audit-copied"));
            }
        }
        AuditCommand::Save => {
            if let Some(found) = found {
                export::ask(studio, Arc::clone(&found.audit));
            }
        }
    }
    context.request_repaint();
}

/// Shows the panel if a pixel was pinned in this frame. The picture stays where it is, so that the pixel stays under
/// the pointer, and the panel lies below the pixel where there is room for it.
pub(crate) fn open_panel(context: &Context, studio: &mut Studio) {
    if !std::mem::take(&mut studio.audit.wants_panel) || layout::is_in_front(&studio.layout, Pane::Audit) {
        return;
    }
    let (Some(pin), Some(rect)) = (studio.audit.pin().copied(), studio.viewport_rect()) else { return };
    let share = (pin.pixel.as_dvec2() + 0.5) / pin.size.as_dvec2();
    let place = rect.lerp_inside(egui::vec2(share.x as f32, share.y as f32));
    studio.panes.viewport.keep_in_place(context, place);
    let below = (rect.bottom() - place.y - ROOM_BELOW_PIXEL) / rect.height().max(1.0);
    layout::open_below_picture(&mut studio.layout, Pane::Audit, below);
    context.request_repaint();
}
