//! The second click of a double click on a dialog that the first one closed: it must not reach what lies behind.

use egui::{Area, Context, Id, LayerId, Order, Pos2, Sense, Vec2};

/// How near to the first click the second one of a double click is, points; egui's own limit is 6.
const NEAR: f32 = 8.0;

fn shield_id() -> Id {
    Id::unique("click shield")
}

/// Takes the clicks at a place for as long as a double click takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClickShield {
    at: Pos2,
    /// Seconds of egui's clock.
    until: f64,
}

impl ClickShield {
    /// Puts a shield where a dialog is closed by a click in this frame; `None` when it is closed by other means.
    pub(super) fn raise(context: &Context) -> Option<Self> {
        let delay = context.options(|options| options.input_options.max_double_click_delay);
        let shield = context.input(|input| {
            let at = input.pointer.interact_pos().filter(|_| input.pointer.primary_clicked())?;
            Some(Self { at, until: input.time + delay })
        })?;
        // In the frame of the click already, since what takes clicks must have been seen in the frame before them.
        shield.show(context);
        context.move_to_top(LayerId::new(Order::Foreground, shield_id()));
        Some(shield)
    }

    /// Puts the shield over the window; returns whether it is still needed.
    pub(super) fn show(&self, context: &Context) -> bool {
        let (now, is_down) = context.input(|input| (input.time, input.pointer.any_down()));
        if now > self.until && !is_down {
            return false;
        }
        let size = Vec2::splat(2.0 * NEAR);
        Area::new(shield_id())
            .order(Order::Foreground)
            .fixed_pos(self.at - 0.5 * size)
            .constrain(false)
            .show(context, |ui| ui.allocate_exact_size(size, Sense::click_and_drag()));
        true
    }
}
