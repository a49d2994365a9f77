//! The gallery of built-in scenes.

use catoptric_scene::{Example, Scene};
use catoptric_tracer::RenderSettings;
use egui::{
    Align2, FontId, Key, Rect, Response, ScrollArea, Sense, Stroke, StrokeKind, TextEdit, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};
use egui_material_icons::icons;

use crate::base::example_texts::example_title;
use crate::base::texts::Texts;
use crate::base::widgets::paint_line_in;
use crate::base::{scripts, theme};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::{Dialog, DialogFlow, buttons_if};
use crate::state::command::FileCommand;

/// A card: its picture and the text below.
const PICTURE: Vec2 = vec2(192.0, 108.0);
const TEXT: f32 = 40.0;
const GAP: f32 = 12.0;
/// How the pictures are traced.
const TRACED: RenderSettings = RenderSettings { width: 288, height: 162, samples: 4 };

/// Shows the built-in scenes; one that is chosen is opened.
struct ExampleGallery {
    search: String,
    selected: usize,
    is_new: bool,
    scrolls: bool,
}

/// Opens the gallery.
pub(crate) fn open(studio: &mut Studio) {
    let gallery = ExampleGallery { search: String::new(), selected: 0, is_new: true, scrolls: false };
    studio.dialogs.open(gallery);
}

/// The examples whose name or title in either language has all words of `search`.
fn found(search: &str) -> Vec<(usize, &'static Example)> {
    let search = search.to_lowercase();
    let has = |example: &Example, word: &str| {
        [example.name, example.title(), example.russian_title()]
            .iter()
            .any(|text| text.to_lowercase().contains(word))
    };
    let fits = |example: &Example| search.split_whitespace().all(|word| has(example, word));
    Example::ALL.iter().enumerate().filter(|(_, example)| fits(example)).collect()
}

fn scene_of(index: &usize) -> Option<(Scene, RenderSettings)> {
    Example::ALL.get(*index)?.load().ok().map(|loaded| (loaded.scene, TRACED))
}

impl Dialog for ExampleGallery {
    fn title(&self, texts: &Texts) -> String {
        texts.get("examples-title").to_owned()
    }

    fn width(&self) -> f32 {
        4.0 * PICTURE.x + 3.0 * GAP + 16.0
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        let all: Vec<usize> = (0..Example::ALL.len()).collect();
        studio.dialogs.thumbnails.want(ui.ctx(), &all, scene_of);
        self.search_ui(ui, &studio.texts);
        let found = found(&self.search);
        let columns = (((ui.available_width() + GAP) / (PICTURE.x + GAP)).floor() as usize).max(1);
        self.selected = self.selected.min(found.len().saturating_sub(1));
        self.walk(ui, found.len(), columns);
        let mut opened = self.cards_ui(ui, studio, &found, columns);
        let texts = &studio.texts;
        match buttons_if(ui, &[texts.get("open"), texts.get("cancel")], !found.is_empty()) {
            Some(0) => opened = found.get(self.selected).map(|(_, example)| *example),
            Some(_) => return DialogFlow::Close,
            None => {}
        }
        let Some(example) = opened else { return DialogFlow::Stay };
        studio.run(FileCommand::OpenExample(example.name));
        DialogFlow::Close
    }
}

impl ExampleGallery {
    fn search_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        let edit = TextEdit::singleline(&mut self.search)
            .hint_text(format!("{} {}", icons::ICON_SEARCH.codepoint, texts.get("examples-search")))
            .desired_width(f32::INFINITY)
            .margin(vec2(8.0, 5.0));
        let response = ui.add(edit);
        response.widget_info(|| {
            WidgetInfo::labeled(egui::accesskit::Role::SearchInput, true, texts.get("examples-search"))
        });
        // Without the sign of the icon.
        ui.ctx()
            .accesskit_node_builder(response.id, |node| node.set_placeholder(texts.get("examples-search")));
        if response.changed() {
            self.selected = 0;
        }
        if std::mem::take(&mut self.is_new) {
            response.request_focus();
        }
        ui.add_space(4.0);
    }

    /// Arrow keys walk over the cards; those to the sides only while nothing has been typed.
    fn walk(&mut self, ui: &Ui, count: usize, columns: usize) {
        let pressed = |key| ui.input(|input| input.key_pressed(key));
        let before = self.selected;
        let last = count.saturating_sub(1);
        if pressed(Key::ArrowDown) && self.selected + columns <= last {
            self.selected += columns;
        }
        if pressed(Key::ArrowUp) {
            self.selected = self.selected.checked_sub(columns).unwrap_or(self.selected);
        }
        if self.search.is_empty() {
            if pressed(Key::ArrowRight) {
                self.selected = (self.selected + 1).min(last);
            }
            if pressed(Key::ArrowLeft) {
                self.selected = self.selected.saturating_sub(1);
            }
        }
        self.scrolls |= self.selected != before;
    }

    /// Draws the cards; returns the example that was clicked.
    fn cards_ui(
        &mut self,
        ui: &mut Ui,
        studio: &Studio,
        found: &[(usize, &'static Example)],
        columns: usize,
    ) -> Option<&'static Example> {
        let height = (ui.ctx().content_rect().height() - 230.0).clamp(160.0, 520.0);
        let mut opened = None;
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false).show(
            ui,
            |ui| {
                if found.is_empty() {
                    ui.centered_and_justified(|ui| ui.weak(studio.texts.get("examples-none")));
                    return;
                }
                ui.spacing_mut().item_spacing = Vec2::splat(GAP);
                for (row, examples) in found.chunks(columns).enumerate() {
                    ui.horizontal(|ui| {
                        for (column, (index, example)) in examples.iter().enumerate() {
                            let place = row * columns + column;
                            let is_selected = place == self.selected;
                            let response = card_ui(ui, studio, *index, example, is_selected);
                            if is_selected && std::mem::take(&mut self.scrolls) {
                                response.scroll_to_me(None);
                            }
                            if response.clicked() {
                                opened = Some(*example);
                            }
                            if response.gained_focus() {
                                self.selected = place;
                            }
                        }
                    });
                }
            },
        );
        opened
    }
}

fn card_ui(ui: &mut Ui, studio: &Studio, index: usize, example: &Example, is_selected: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(PICTURE + vec2(0.0, TEXT), Sense::click());
    let title = example_title(example, studio.texts.language());
    response.widget_info(|| WidgetInfo::selected(egui::accesskit::Role::Button, true, is_selected, title));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let palette = theme::palette(ui.visuals());
    let painter = ui.painter().with_clip_rect(rect.expand(2.0).intersect(ui.clip_rect()));
    let fill = if is_selected {
        palette.selection
    } else if response.hovered() {
        palette.hovered
    } else {
        palette.field
    };
    painter.rect_filled(rect, 6.0, fill);
    let picture = Rect::from_min_size(rect.min, PICTURE);
    match studio.dialogs.thumbnails.get(&index) {
        Some(texture) => {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            egui::Image::new(texture)
                .uv(whole)
                .corner_radius(egui::CornerRadius { nw: 6, ne: 6, sw: 0, se: 0 })
                .paint_at(ui, picture);
        }
        None => {
            let icon = icons::ICON_HOURGLASS_EMPTY.codepoint;
            painter.text(
                picture.center(),
                Align2::CENTER_CENTER,
                icon,
                FontId::proportional(22.0),
                palette.weak,
            );
        }
    }
    let line = Rect::from_min_size(picture.left_bottom() + vec2(8.0, 3.0), vec2(PICTURE.x - 16.0, 18.0));
    paint_line_in(ui, line, title, FontId::proportional(13.5), palette.text);
    let line = line.translate(vec2(0.0, 17.0));
    paint_line_in(ui, line, example.name, FontId::proportional(11.5), palette.weak);
    if is_selected || response.has_focus() {
        painter.rect_stroke(rect, 6.0, Stroke::new(1.5, palette.accent), StrokeKind::Outside);
    }
    let notice = example.notice(studio.texts.language().into());
    response.on_hover_text(scripts::job(&notice, 13.5, ui.visuals().text_color()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn examples_are_found_in_both_languages() {
        assert_eq!(found("").len(), Example::ALL.len());
        let names = |search| found(search).iter().map(|(_, example)| example.name).collect::<Vec<_>>();
        assert_eq!(names("FOUR bod"), ["four-bodies"]);
        assert_eq!(names("четыре тела"), ["four-bodies"]);
        assert!(names("xyzzy").is_empty());
    }
}
