//! The theme: colors, fonts, spacing. It is calm, so that the picture is the brightest thing.

use std::sync::Arc;

use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, Style,
    TextStyle, ThemePreference, Visuals, vec2,
};
use egui_material_icons::{FONT_FAMILY, FONT_FAMILY_OUTLINED};
use serde::{Deserialize, Serialize};

/// The theme of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Theme {
    /// The theme of the system.
    System,
    /// Dark, the default: it leaves the picture the brightest thing.
    #[default]
    Dark,
    /// Light.
    Light,
}

/// The colors of a theme beyond egui's own visuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ThemeColors {
    /// Panels.
    pub(crate) panel: Color32,
    /// Menu and status bars, tab bars.
    pub(crate) bar: Color32,
    /// Fields and lists.
    pub(crate) field: Color32,
    /// Buttons at rest.
    pub(crate) button: Color32,
    /// Buttons under the pointer.
    pub(crate) hovered: Color32,
    /// Hairlines between things.
    pub(crate) line: Color32,
    /// Text.
    pub(crate) text: Color32,
    /// Text of less weight: units, hints.
    pub(crate) weak: Color32,
    /// Selected things, the active tool.
    pub(crate) accent: Color32,
    /// Behind selected text and rows.
    pub(crate) selection: Color32,
    /// The axes: X, Y, Z.
    pub(crate) axes: [Color32; 3],
    /// Errors.
    pub(crate) error: Color32,
    /// Warnings.
    pub(crate) warning: Color32,
}

const DARK: ThemeColors = ThemeColors {
    panel: Color32::from_rgb(33, 35, 39),
    bar: Color32::from_rgb(26, 27, 31),
    field: Color32::from_rgb(22, 23, 26),
    button: Color32::from_rgb(50, 53, 59),
    hovered: Color32::from_rgb(64, 68, 76),
    line: Color32::from_rgb(48, 51, 57),
    text: Color32::from_rgb(218, 221, 226),
    weak: Color32::from_rgb(146, 151, 161),
    accent: Color32::from_rgb(92, 169, 247),
    selection: Color32::from_rgb(38, 74, 112),
    axes: [Color32::from_rgb(232, 88, 88), Color32::from_rgb(122, 196, 84), Color32::from_rgb(84, 146, 240)],
    error: Color32::from_rgb(240, 108, 100),
    warning: Color32::from_rgb(236, 178, 84),
};

const LIGHT: ThemeColors = ThemeColors {
    panel: Color32::from_rgb(247, 248, 250),
    bar: Color32::from_rgb(234, 236, 240),
    field: Color32::from_rgb(255, 255, 255),
    button: Color32::from_rgb(227, 230, 235),
    hovered: Color32::from_rgb(214, 219, 227),
    line: Color32::from_rgb(211, 215, 222),
    text: Color32::from_rgb(34, 37, 43),
    weak: Color32::from_rgb(98, 104, 115),
    accent: Color32::from_rgb(20, 104, 196),
    selection: Color32::from_rgb(190, 219, 250),
    axes: [Color32::from_rgb(206, 52, 52), Color32::from_rgb(70, 142, 34), Color32::from_rgb(38, 98, 206)],
    error: Color32::from_rgb(190, 40, 34),
    warning: Color32::from_rgb(158, 100, 0),
};

/// The palette of the theme that `visuals` show.
pub(crate) fn palette(visuals: &Visuals) -> &'static ThemeColors {
    if visuals.dark_mode { &DARK } else { &LIGHT }
}

/// Gives the window its fonts and both themes; once, at the start.
pub(crate) fn install(context: &egui::Context) {
    let mut fonts = FontDefinitions::default();
    if let Some(proportional) = fonts.families.get_mut(&FontFamily::Proportional) {
        // It has arrows and signs of mathematics that the others lack.
        proportional.push("Hack".to_owned());
    }
    add_icons(&mut fonts);
    context.set_fonts(fonts);
    context.style_mut_of(egui::Theme::Dark, |style| dress(style, &DARK));
    context.style_mut_of(egui::Theme::Light, |style| dress(style, &LIGHT));
}

/// Adds the icons, which stand in a font of their own and behind the letters of the others. `cargo xtask icons` makes it of
/// those in use: the whole font is larger than the tracer.
fn add_icons(fonts: &mut FontDefinitions) {
    let mut icons = FontData::from_static(include_bytes!("../../assets/icons.ttf"));
    icons.tweak.y_offset_factor = 0.05;
    fonts.font_data.insert(FONT_FAMILY.to_owned(), Arc::new(icons));
    let own = [FONT_FAMILY, FONT_FAMILY_OUTLINED].map(|name| FontFamily::Name(name.into()));
    for family in own.into_iter().chain([FontFamily::Proportional]) {
        fonts.families.entry(family).or_default().push(FONT_FAMILY.to_owned());
    }
}

/// Switches the theme.
pub(crate) fn choose(context: &egui::Context, theme: Theme) {
    context.set_theme(match theme {
        Theme::System => ThemePreference::System,
        Theme::Dark => ThemePreference::Dark,
        Theme::Light => ThemePreference::Light,
    });
}

fn dress(style: &mut Style, palette: &ThemeColors) {
    style.text_styles = [
        (TextStyle::Small, FontId::proportional(11.5)),
        (TextStyle::Body, FontId::proportional(13.5)),
        (TextStyle::Button, FontId::proportional(13.5)),
        (TextStyle::Heading, FontId::proportional(17.0)),
        (TextStyle::Monospace, FontId::monospace(12.5)),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(8.0, 6.0);
    spacing.button_padding = vec2(8.0, 3.0);
    spacing.interact_size = vec2(40.0, 22.0);
    spacing.window_margin = Margin::same(14);
    spacing.menu_margin = Margin::same(6);
    spacing.indent = 16.0;
    spacing.icon_width = 16.0;
    spacing.slider_width = 110.0;
    spacing.tooltip_width = 340.0;
    style.interaction.tooltip_delay = 0.4;
    style.interaction.selectable_labels = false;
    style.animation_time = 0.08;
    dress_visuals(&mut style.visuals, palette);
}

fn dress_visuals(visuals: &mut Visuals, palette: &ThemeColors) {
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.field;
    visuals.text_edit_bg_color = Some(palette.field);
    visuals.faint_bg_color = palette.bar;
    visuals.code_bg_color = palette.field;
    visuals.weak_text_color = Some(palette.weak);
    visuals.hyperlink_color = palette.accent;
    visuals.error_fg_color = palette.error;
    visuals.warn_fg_color = palette.warning;
    visuals.selection.bg_fill = palette.selection;
    visuals.selection.stroke = Stroke::new(1.0, palette.text);
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(6);
    let shadow = Shadow { offset: [0, 6], blur: 20, spread: 0, color: Color32::from_black_alpha(90) };
    visuals.window_shadow = shadow;
    visuals.popup_shadow = Shadow { offset: [0, 3], blur: 10, ..shadow };
    visuals.indent_has_left_vline = false;
    let widgets = &mut visuals.widgets;
    let all = [
        (&mut widgets.noninteractive, palette.panel, palette.line, palette.text),
        (&mut widgets.inactive, palette.button, Color32::TRANSPARENT, palette.text),
        (&mut widgets.hovered, palette.hovered, palette.line, palette.text),
        (&mut widgets.active, palette.selection, palette.accent, palette.text),
        (&mut widgets.open, palette.hovered, palette.line, palette.text),
    ];
    for (look, fill, line, text) in all {
        look.bg_fill = fill;
        look.weak_bg_fill = fill;
        look.bg_stroke = Stroke::new(1.0, line);
        look.fg_stroke = Stroke::new(1.0, text);
        look.corner_radius = CornerRadius::same(4);
        look.expansion = 0.0;
    }
}
