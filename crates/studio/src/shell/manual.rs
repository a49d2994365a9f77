//! The manual: the documents of the repository in a window of its own, with search and links, without a network.

mod contents;
mod formula;
mod markdown;
mod missing_glyphs;
mod page_ui;
mod pages;
mod search;

use egui::accesskit::Role;
use egui::{
    Align, Align2, Context, EventFilter, Frame, Id, Key, Layout, Margin, Modifiers, OpenUrl, Popup, Sense,
    Ui, Vec2, WidgetInfo, vec2,
};
use egui_material_icons::icons;

use crate::base::texts::{Language, Texts};
use crate::base::theme;
use crate::base::widgets::{icon_button, icon_ui};
use markdown::{BlockContent, ManualLink, ManualPage};
use page_ui::{BlockOffsets, PageView};
use pages::SOURCES;
use search::SearchHit;

/// The size of the window at first, and the least one, points.
const SIZE: Vec2 = vec2(940.0, 640.0);
const LEAST: Vec2 = vec2(380.0, 240.0);
/// How far an arrow key scrolls, points.
const STEP: f32 = 60.0;

/// A page and the block in view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct ManualLocation {
    page: usize,
    /// The block that was gone to.
    block: usize,
}

/// The window of the manual.
#[derive(Default)]
pub(crate) struct ManualWindow {
    is_open: bool,
    /// Whether the window was used last, so that Esc and the keys that scroll are for it.
    has_keys: bool,
    is_new: bool,
    place: ManualLocation,
    /// The places before this one.
    back: Vec<ManualLocation>,
    /// The block to scroll to.
    to: Option<usize>,
    /// The block that was found by search.
    marked: Option<usize>,
    search: String,
    hits: Vec<SearchHit>,
    /// The pages that have been read, and their language.
    library: Option<(Language, Vec<ManualPage>)>,
    measured: BlockOffsets,
}

/// The links and buttons pressed in a frame.
#[derive(Default)]
struct ManualResponse {
    follows: Option<ManualLink>,
    /// A hit of the search.
    hit: Option<ManualLocation>,
    goes_back: bool,
    is_closed: bool,
}

impl ManualWindow {
    /// Opens the window, or brings it to the front.
    pub(crate) fn open(&mut self, context: &Context) {
        (self.is_open, self.has_keys, self.is_new) = (true, true, true);
        context.move_to_top(egui::LayerId::new(egui::Order::Middle, window_id()));
    }

    /// Whether Esc is for the window.
    pub(crate) fn has_keys(&self) -> bool {
        self.is_open && self.has_keys
    }

    /// Reads the pages in the language of the window.
    fn read(&mut self, language: Language) {
        if self.library.as_ref().is_some_and(|(own, _)| *own == language) {
            return;
        }
        let sources = SOURCES.iter().enumerate();
        let pages =
            sources.map(|(place, source)| Some(markdown::read(&source.text(language)?, place, source.path)));
        let Some(pages) = pages.collect::<Option<Vec<ManualPage>>>() else {
            self.library = None;
            return;
        };
        self.hits = search::hits(&pages, &self.search);
        self.library = Some((language, pages));
        // Blocks have other places in another language.
        (self.marked, self.to) = (None, Some(0));
        self.back.clear();
    }

    fn go_to(&mut self, place: ManualLocation) {
        if place != self.place {
            self.back.push(self.place);
        }
        self.place = place;
        self.to = Some(place.block);
    }

    fn follow(&mut self, context: &Context, link: ManualLink) {
        match link {
            ManualLink::Web(url) => context.open_url(OpenUrl::new_tab(url)),
            ManualLink::Page(page, anchor) => {
                let block = self.library.as_ref().and_then(|(_, pages)| heading(pages.get(page)?, &anchor));
                self.marked = None;
                self.go_to(ManualLocation { page, block: block.unwrap_or(0) });
            }
        }
    }

    /// Does what was chosen.
    fn take(&mut self, context: &Context, choice: ManualResponse) {
        if let Some(place) = choice.hit {
            self.go_to(place);
            self.marked = Some(place.block);
        }
        if let Some(link) = choice.follows {
            self.follow(context, link);
        }
        if choice.goes_back
            && let Some(place) = self.back.pop()
        {
            self.place = place;
            (self.marked, self.to) = (None, Some(place.block));
        }
        self.is_open &= !choice.is_closed;
    }
}

fn window_id() -> Id {
    Id::unique("manual")
}

/// The block with the heading that a link names.
fn heading(page: &ManualPage, anchor: &str) -> Option<usize> {
    let is_named = |content: &BlockContent| matches!(content, BlockContent::Heading { anchor: own, .. } if own == anchor);
    page.blocks.iter().position(|block| is_named(&block.content))
}

/// Draws the window of the manual if it is open. `is_behind` while a dialog lies before it.
pub(crate) fn manual_ui(context: &Context, texts: &Texts, manual: &mut ManualWindow, is_behind: bool) {
    if !manual.is_open {
        return;
    }
    manual.read(texts.language());
    let screen = context.content_rect();
    let most = (screen.size() - vec2(24.0, 24.0)).max(LEAST.min(screen.size()));
    let style = context.global_style();
    let frame = Frame::window(&style).inner_margin(Margin::same(10));
    let mut choice = ManualResponse::default();
    let shown = egui::Window::new(texts.get("command-manual"))
        .id(window_id())
        .title_bar(false)
        .collapsible(false)
        .frame(frame)
        .pivot(Align2::CENTER_CENTER)
        .default_pos(screen.center())
        .default_size(SIZE.min(most))
        .min_size(LEAST.min(most))
        .max_size(most)
        .constrain_to(screen)
        .show(context, |ui| {
            choice = window_ui(ui, texts, manual);
        });
    if let Some(shown) = shown {
        mind_keys(context, manual, shown.response.rect, &mut choice, is_behind);
    }
    manual.take(context, choice);
}

/// The keys are for the window after it was opened or pressed, until something else is pressed. Esc closes it.
fn mind_keys(
    context: &Context,
    manual: &mut ManualWindow,
    rect: egui::Rect,
    choice: &mut ManualResponse,
    is_behind: bool,
) {
    let pressed = context.input(|input| {
        let is_pressed = input.pointer.any_pressed();
        input.pointer.interact_pos().filter(|_| is_pressed)
    });
    if let Some(at) = pressed {
        let is_here = context.layer_id_at(at).is_some_and(|layer| layer.id == window_id());
        manual.has_keys = is_here && rect.contains(at);
    }
    let is_free = manual.has_keys && !is_behind && !Popup::is_any_open(context);
    choice.is_closed |= is_free && context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
}

fn window_ui(ui: &mut Ui, texts: &Texts, manual: &mut ManualWindow) -> ManualResponse {
    let mut choice = ManualResponse::default();
    head_ui(ui, texts, manual, &mut choice);
    ui.separator();
    let room = ui.available_size();
    let side = (0.3 * room.x).clamp(120.0, 250.0);
    ui.horizontal_top(|ui| {
        ui.allocate_ui_with_layout(vec2(side, room.y), Layout::top_down(Align::Min), |ui| {
            contents::contents_ui(ui, texts, manual, &mut choice);
        });
        ui.separator();
        ui.allocate_ui_with_layout(ui.available_size(), Layout::top_down(Align::Min), |ui| {
            let Some((_, pages)) = &manual.library else {
                ui.weak(texts.get("manual-loading"));
                return;
            };
            let Some(page) = pages.get(manual.place.page) else { return };
            let step = scrolled_by_keys(ui, manual.has_keys, &page.title);
            let shown = PageView { page, place: manual.place.page, marked: manual.marked, texts };
            let link = page_ui::page_ui(ui, &shown, &mut manual.measured, &mut manual.to, step);
            choice.follows = link.or(choice.follows.take());
        });
    });
    choice
}

/// The name of the window, the way back, and the button that closes.
fn head_ui(ui: &mut Ui, texts: &Texts, manual: &ManualWindow, choice: &mut ManualResponse) {
    ui.horizontal(|ui| {
        let color = theme::palette(ui.visuals()).accent;
        icon_ui(ui, icons::ICON_MENU_BOOK, 18.0, color);
        ui.strong(texts.get("command-manual"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            choice.is_closed = icon_button(ui, icons::ICON_CLOSE, texts.get("close"), false).clicked();
            ui.add_enabled_ui(!manual.back.is_empty(), |ui| {
                choice.goes_back =
                    icon_button(ui, icons::ICON_ARROW_BACK, texts.get("manual-back"), false).clicked();
            });
        });
    });
}

/// What has the keyboard while a page is read.
pub(crate) fn page_id() -> Id {
    Id::unique("manual page")
}

/// How far Page Up, Page Down and the arrows scroll the page, points. The page has the keyboard while nothing else in
/// the window has it.
fn scrolled_by_keys(ui: &Ui, has_keys: bool, title: &str) -> f32 {
    let rect = ui.available_rect_before_wrap();
    let response = ui.interact(rect, page_id(), Sense::focusable_noninteractive());
    response.widget_info(|| WidgetInfo::labeled(Role::Document, true, title));
    if has_keys && ui.memory(|memory| memory.focused().is_none()) && !Popup::is_any_open(ui.ctx()) {
        response.request_focus();
    }
    if !response.has_focus() {
        return 0.0;
    }
    let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let page = 0.9 * rect.height();
    let steps = [(Key::PageDown, page), (Key::PageUp, -page), (Key::ArrowDown, STEP), (Key::ArrowUp, -STEP)];
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    steps.into_iter().filter(|(key, _)| pressed(*key)).map(|(_, step)| step).sum()
}
