//! The menu of a number: what can be done with its address.

use catoptric_scene::ScenePath;
use egui::{Button, Popup, Response, Style};
use egui_material_icons::icons::ICON_CONTENT_COPY;

use super::*;
use crate::base::widgets::tip::tip_beside_entry;
use crate::panels::menu_entry::{dress_menu, item};
use crate::state::command::{Command, MeasureCommand};

impl<T> PropertySheet<'_, '_, T> {
    /// The menu of the number of a row, or of one of its three numbers.
    pub(super) fn number_menu(&mut self, response: &Response, what: &RowQuantity, component: Option<usize>) {
        let mut varied = None;
        let menu = Popup::context_menu(response).style(dress_menu as fn(&mut Style));
        menu.show(|ui| {
            ui.set_min_width(220.0);
            let texts = self.texts();
            let address = self.address(what, component);
            let has_address = address.is_some();
            ui.add_enabled_ui(has_address, |ui| {
                if item(ui, self.cx.situation(), &MeasureCommand::Vary(None).into()) {
                    varied.clone_from(&address);
                }
            });
            let name = texts.get("copy-address");
            let copy = Button::new((ICON_CONTENT_COPY.rich_text(), name));
            let copy = ui.add_enabled(has_address, copy).accessible_name(name);
            let tip = if has_address { texts.tip("copy-address") } else { texts.tip("no-address") };
            let copy = tip_beside_entry(copy, tip.unwrap_or_default());
            if copy.clicked() {
                ui.ctx().copy_text(address.map(|address| address.to_string()).unwrap_or_default());
                ui.close();
            }
        });
        if let Some(address) = varied {
            self.cx.run(Command::Measure(MeasureCommand::Vary(Some(address))));
        }
    }

    /// The address of the number of a row, or of one of its three numbers; `None` for one that follows from others.
    fn address(&self, what: &RowQuantity, component: Option<usize>) -> Option<ScenePath> {
        let SheetPlace { part, within } = self.place;
        let spec = what.spec()?;
        let keys = self.cx.editor.scene().keys_of_nested(part, within.places());
        // Some keys of parts mean another place than those of bodies, and are else alike.
        let is_like = |of: &KeySpec| !within.is_whole() && (of.name, of.kind) == (spec.name, spec.kind);
        let key = keys.into_iter().find(|key| key.spec == spec || is_like(key.spec))?;
        match component {
            Some(index) => key.component(index),
            None => key.value.is_some().then_some(key.path),
        }
    }
}
