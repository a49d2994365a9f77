//! The column beside a page: the search, and below it the pages, or what was found.

use egui::text::{LayoutJob, TextFormat};
use egui::{Button, FontId, Key, Label, RichText, ScrollArea, TextEdit, Ui, WidgetInfo, vec2};
use egui_material_icons::icons;

use super::markdown::{BlockContent, ManualLink, ManualPage};
use super::pages::SOURCES;
use super::search::{self, SearchHit};
use super::{ManualLocation, ManualResponse, ManualWindow};
use crate::base::texts::Texts;
use crate::base::theme;

/// How far pages below another one, and the headings of a page, are set in, points.
const INDENT: f32 = 14.0;

/// Draws the column.
pub(super) fn contents_ui(
    ui: &mut Ui,
    texts: &Texts,
    manual: &mut ManualWindow,
    choice: &mut ManualResponse,
) {
    search_ui(ui, texts, manual, choice);
    ui.add_space(4.0);
    let is_searching = !manual.search.trim().is_empty();
    ScrollArea::vertical().id_salt(("manual contents", is_searching)).auto_shrink(false).show(ui, |ui| {
        ui.set_width(ui.available_width() - 8.0);
        ui.spacing_mut().item_spacing.y = 1.0;
        let Some((_, pages)) = &manual.library else { return };
        if is_searching {
            hits_ui(ui, texts, (pages, &manual.hits), choice);
        } else {
            pages_ui(ui, pages, manual.place.page, choice);
        }
    });
}

fn search_ui(ui: &mut Ui, texts: &Texts, manual: &mut ManualWindow, choice: &mut ManualResponse) {
    let name = texts.get("manual-search");
    let edit = TextEdit::singleline(&mut manual.search)
        .hint_text(format!("{} {name}", icons::ICON_SEARCH.codepoint))
        .desired_width(f32::INFINITY)
        .margin(vec2(8.0, 5.0));
    let response = ui.add(edit);
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::SearchInput, true, name));
    // Without the sign of the icon.
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_placeholder(name));
    if response.changed()
        && let Some((_, pages)) = &manual.library
    {
        manual.hits = search::hits(pages, &manual.search);
    }
    if std::mem::take(&mut manual.is_new) {
        response.request_focus();
    }
    if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
        choice.hit = manual.hits.first().map(place_of);
    }
}

fn place_of(hit: &SearchHit) -> ManualLocation {
    ManualLocation { page: hit.page, block: hit.block }
}

/// The pages, and the headings of the one that is read.
fn pages_ui(ui: &mut Ui, pages: &[ManualPage], present: usize, choice: &mut ManualResponse) {
    for (place, (page, source)) in pages.iter().zip(SOURCES).enumerate() {
        let indent = if source.is_below() { INDENT } else { 0.0 };
        if entry_ui(ui, indent, RichText::new(&page.title), place == present) {
            choice.follows = Some(ManualLink::Page(place, String::new()));
        }
        if place != present {
            continue;
        }
        let weak = theme::palette(ui.visuals()).weak;
        for block in &page.blocks {
            if let BlockContent::Heading { level: 2, anchor, .. } = &block.content
                && entry_ui(ui, indent + INDENT, RichText::new(&block.plain).size(12.5).color(weak), false)
            {
                choice.follows = Some(ManualLink::Page(place, anchor.clone()));
            }
        }
    }
}

fn entry_ui(ui: &mut Ui, indent: f32, text: RichText, is_present: bool) -> bool {
    ui.horizontal(|ui| {
        ui.add_space(indent);
        let (width, name) = (ui.available_width(), text.text().to_owned());
        // With something at its right end, the text stands at the left.
        let button = Button::selectable(is_present, text).right_text("");
        ui.add(button.truncate().min_size(vec2(width, 0.0))).accessible_name(name).clicked()
    })
    .inner
}

fn hits_ui(
    ui: &mut Ui,
    texts: &Texts,
    (pages, hits): (&[ManualPage], &[SearchHit]),
    choice: &mut ManualResponse,
) {
    let palette = theme::palette(ui.visuals());
    if hits.is_empty() {
        ui.add(Label::new(RichText::new(texts.get("manual-nothing")).color(palette.weak)).wrap());
    }
    let mut last = None;
    for hit in hits {
        if last != Some(hit.page)
            && let Some(page) = pages.get(hit.page)
        {
            ui.add_space(5.0);
            ui.add(Label::new(RichText::new(&page.title).strong()).truncate());
            last = Some(hit.page);
        }
        let mut job = LayoutJob::default();
        let [before, found, after] = &hit.excerpt;
        for (part, color) in [(before, palette.weak), (found, palette.accent), (after, palette.weak)] {
            let format = TextFormat::simple(FontId::proportional(12.5), color);
            job.append(part, 0.0, format);
        }
        let button =
            Button::new(job).wrap().frame_when_inactive(false).min_size(vec2(ui.available_width(), 0.0));
        if ui.add(button).clicked() {
            choice.hit = Some(place_of(hit));
        }
    }
}
