//! What the commands of the audit do.

use std::sync::Arc;

use egui::{Context, OutputCommand};

use super::saving;
use crate::app::Studio;
use crate::command::AuditAct;
use crate::layout::{self, Pane};
use crate::viewport;

/// Does `act`.
pub(crate) fn run(context: &Context, studio: &mut Studio, act: AuditAct) {
    let found = studio.audit.found.clone();
    let generations = found.as_ref().map_or(0, |found| found.generations());
    let longest = found.as_ref().map_or(0.0, |found| found.longest);
    match act {
        AuditAct::Tool => {
            studio.view.is_auditing = !studio.view.is_auditing;
            studio.view.is_aiming = false;
            // The tool and its panel are open together.
            layout::set_visible(&mut studio.layout, Pane::Audit, studio.view.is_auditing);
        }
        AuditAct::Release => studio.audit.release(),
        AuditAct::View => {
            if let Some(pin) = studio.audit.pin {
                viewport::look_through(studio, pin.home);
            }
        }
        AuditAct::Previous => {
            let shown = studio.audit.step.unwrap_or(generations);
            studio.audit.step = Some(shown.saturating_sub(1).max(1)).filter(|step| *step < generations);
        }
        AuditAct::Next => {
            studio.audit.step = studio.audit.step.map(|step| step + 1).filter(|step| *step < generations);
        }
        AuditAct::All => {
            studio.audit.step = None;
            studio.audit.light.end();
        }
        AuditAct::Play => studio.audit.light.toggle(longest),
        AuditAct::Copy => {
            if let Some(found) = found {
                let text = found.audit.to_text(None);
                context.output_mut(|output| output.commands.push(OutputCommand::CopyText(text)));
                studio.toasts.success(studio.texts.get("audit-copied"));
            }
        }
        AuditAct::Save => {
            if let Some(found) = found {
                saving::ask(studio, Arc::clone(&found.audit));
            }
        }
    }
    context.request_repaint();
}
