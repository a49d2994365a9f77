//! Explanations: the shortcuts, the terms, and about the program.

mod shortcut_list;
mod terms;

use egui::{Align, Context, Id, Layout, Modal, RichText, ScrollArea, Ui, vec2};
use egui_material_icons::{MaterialIcon, icons};

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::icon_button;

/// A page of the help window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HelpTopic {
    Shortcuts,
    Terms,
    About,
}

impl HelpTopic {
    const ALL: [Self; 3] = [Self::Shortcuts, Self::Terms, Self::About];

    const fn key(self) -> &'static str {
        match self {
            Self::Shortcuts => "command-shortcuts",
            Self::Terms => "command-terms",
            Self::About => "command-about",
        }
    }

    const fn icon(self) -> MaterialIcon {
        match self {
            Self::Shortcuts => icons::ICON_KEYBOARD,
            Self::Terms => icons::ICON_DICTIONARY,
            Self::About => icons::ICON_INFO,
        }
    }
}

/// The help window: its page, if it is open.
#[derive(Debug, Default)]
pub(crate) struct HelpWindow {
    page: Option<HelpTopic>,
}

impl HelpWindow {
    /// Whether it is open.
    pub(crate) fn is_any_open(&self) -> bool {
        self.page.is_some()
    }

    /// Opens a page; what was being typed below ends.
    pub(crate) fn open(&mut self, context: &Context, page: HelpTopic) {
        context.memory_mut(egui::Memory::stop_text_input);
        self.page = Some(page);
    }
}

/// Draws the explanations if they are asked for.
pub(crate) fn help_ui(context: &Context, texts: &Texts, help: &mut HelpWindow) {
    let Some(page) = help.page else { return };
    let screen = context.content_rect().size();
    let size = vec2((screen.x - 60.0).min(720.0), (screen.y - 80.0).min(620.0));
    let mut wanted = Some(page);
    let frame = egui::Frame::popup(&context.global_style()).inner_margin(14.0);
    let id = Id::unique("help");
    let area = Modal::default_area(id).accessible_name(texts.get(page.key()));
    let modal = Modal::new(id).area(area).frame(frame).show(context, |ui| {
        ui.set_width(size.x);
        ui.set_height(size.y);
        heads_ui(ui, texts, &mut wanted);
        ui.separator();
        let scroll = ScrollArea::vertical().id_salt(page.key()).auto_shrink(false);
        scroll.show(ui, |ui| match page {
            HelpTopic::Shortcuts => shortcut_list::list_ui(ui, texts),
            HelpTopic::Terms => terms::terms_ui(ui, texts),
            HelpTopic::About => about_ui(ui, texts),
        });
    });
    help.page = if modal.should_close() { None } else { wanted };
}

/// The pages to choose from, and the button that closes.
fn heads_ui(ui: &mut Ui, texts: &Texts, wanted: &mut Option<HelpTopic>) {
    ui.horizontal(|ui| {
        for page in HelpTopic::ALL {
            let name = texts.get(page.key());
            let button = egui::Button::selectable(*wanted == Some(page), (page.icon().rich_text(), name));
            if ui.add(button).accessible_name(name).clicked() {
                *wanted = Some(page);
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if icon_button(ui, icons::ICON_CLOSE, texts.get("close"), false).clicked() {
                *wanted = None;
            }
        });
    });
}

fn about_ui(ui: &mut Ui, texts: &Texts) {
    let palette = theme::palette(ui.visuals());
    ui.add_space(12.0);
    ui.label(RichText::new(texts.get("app-name")).heading().size(26.0));
    let version = env!("CARGO_PKG_VERSION");
    ui.label(RichText::new(texts.with("about-version", &[("version", version.into())])).color(palette.weak));
    ui.add_space(8.0);
    for key in ["about-what", "about-how", "about-license", "about-parts"] {
        ui.label(texts.get(key));
        ui.add_space(4.0);
    }
}
