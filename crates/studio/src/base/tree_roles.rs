//! Roles for what the toolkit tells screen readers of without one.

use egui::accesskit::Role;
use egui::{Context, FullOutput, Plugin};

/// Calls a frame what has no role: the borders between docked panels and the rooms beside their tabs, which only the
/// pointer uses.
struct TreeRoles;

/// From now on all that `context` tells of has a role.
pub(crate) fn install(context: &Context) {
    context.add_plugin(TreeRoles);
}

impl Plugin for TreeRoles {
    fn debug_name(&self) -> &'static str {
        "tree roles"
    }

    fn output_hook(&mut self, _context: &Context, output: &mut FullOutput) {
        let Some(update) = &mut output.platform_output.accesskit_update else { return };
        for (_, node) in &mut update.nodes {
            if node.role() == Role::Unknown {
                node.set_role(Role::GenericContainer);
            }
        }
    }
}
