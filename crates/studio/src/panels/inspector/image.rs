//! The choice of a picture.

use catoptric_scene::Image;
use egui::{ComboBox, Ui};

use super::header;
use super::sheet::PropertySheet;
use crate::base::widgets::row::control_width;
use crate::base::widgets::tip::tip_beside;
use crate::state::command::PictureCommand;
use crate::state::images::{self, ImageUse};

/// A choice besides pictures.
pub(super) struct OtherChoice<T> {
    pub(super) key: &'static str,
    pub(super) is_chosen: bool,
    pub(super) value: T,
}

/// The chosen entry of the menu.
pub(super) enum ImageMenuChoice<T> {
    Other(T),
    Picture(Image),
}

/// Draws a row with a list: what there is besides, some pictures that come with the program, the one of a file, and any
/// other file.
pub(super) fn choice_ui<T, V: Copy>(
    ui: &mut Ui,
    sheet: &mut PropertySheet<'_, '_, T>,
    key: &'static str,
    usage: ImageUse,
    others: &[OtherChoice<V>],
    image: Option<&Image>,
) -> Option<ImageMenuChoice<V>> {
    let texts = sheet.texts();
    let built_in: &[&str] = match usage {
        ImageUse::Surroundings => &["builtin:evening", "builtin:studio"],
        ImageUse::Texture => &["builtin:planet", "builtin:grid"],
    };
    let path = image.map(Image::path);
    let shown = match path {
        Some(path) => images::name(texts, path),
        None => others.iter().find(|other| other.is_chosen).map_or("", |other| texts.get(other.key)).into(),
    };
    let mut picked = None;
    let mut asks = false;
    sheet.plain_row(ui, key, |_, ui| {
        let combo =
            ComboBox::from_id_salt(key).selected_text(shown.as_ref()).width(control_width(ui)).truncate();
        let list = combo.show_ui(ui, |ui| {
            for other in others {
                if ui.selectable_label(other.is_chosen, texts.get(other.key)).clicked() && !other.is_chosen {
                    picked = Some(ImageMenuChoice::Other(other.value));
                }
            }
            let own = path.filter(|path| !built_in.contains(path));
            for &choice in built_in.iter().chain(&own) {
                let is_chosen = path == Some(choice);
                if ui.selectable_label(is_chosen, images::name(texts, choice)).clicked() && !is_chosen {
                    picked = Some(ImageMenuChoice::Picture(Image::new(choice)));
                }
            }
            asks = ui.selectable_label(false, texts.get("picture-of-file")).clicked();
        });
        let tip = path.filter(|path| !path.starts_with(Image::BUILT_IN)).unwrap_or_default();
        let tip = if tip.is_empty() { texts.tip(key).unwrap_or_default() } else { tip };
        tip_beside(ui, list.response.accessible_name(texts.get(key)), tip);
    });
    if asks {
        sheet.cx.run(PictureCommand::Choose(usage));
    }
    if image.is_some_and(|image| image.pixels().is_none() && sheet.cx.images.is_missing(image.source())) {
        header::hint(ui, texts.get("picture-not-there"));
    }
    picked
}
