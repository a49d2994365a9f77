//! The plot of a measurement, in the colors of the window.

use catoptric_lab::report::{Language, Plot, PlotCurve, PlotMark, Scale};
use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use crate::base::theme::{self, ThemeColors};

/// Colors that the color-blind can tell apart (M. Okabe, K. Ito, 2008), on light ground and on dark.
const ON_LIGHT: [Color32; 6] = [
    Color32::from_rgb(0x00, 0x72, 0xb2),
    Color32::from_rgb(0xd5, 0x5e, 0x00),
    Color32::from_rgb(0x00, 0x8a, 0x66),
    Color32::from_rgb(0xb0, 0x5a, 0x90),
    Color32::from_rgb(0xa0, 0x6a, 0x00),
    Color32::from_rgb(0x33, 0x33, 0x33),
];
const ON_DARK: [Color32; 6] = [
    Color32::from_rgb(0x56, 0xb4, 0xe9),
    Color32::from_rgb(0xe6, 0x9f, 0x00),
    Color32::from_rgb(0x2e, 0xc4, 0x99),
    Color32::from_rgb(0xe0, 0x8f, 0xc0),
    Color32::from_rgb(0xf0, 0xe4, 0x42),
    Color32::from_rgb(0xd0, 0xd0, 0xd0),
];

/// What is left free around the curves for numbers and titles, points.
const LEFT: f32 = 62.0;
const RIGHT: f32 = 16.0;
const TOP: f32 = 24.0;
const BOTTOM: f32 = 40.0;

/// The distance to a median within which the pointer shows its numbers, points.
const NEAR: f32 = 14.0;

fn color(ui: &Ui, index: usize) -> Color32 {
    let colors = if ui.visuals().dark_mode { &ON_DARK } else { &ON_LIGHT };
    colors.get(index % colors.len()).copied().unwrap_or(Color32::GRAY)
}

/// The symbol of a curve, for a legend.
pub(super) fn key_ui(ui: &mut Ui, index: usize) {
    let (rect, _) = ui.allocate_exact_size(vec2(16.0, 14.0), Sense::hover());
    symbol(ui.painter(), rect.center(), index, color(ui, index), theme::palette(ui.visuals()));
}

/// Draws the plot over all the room there is.
pub(super) fn plot_ui(ui: &mut Ui, plot: &Plot) {
    let (whole, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &plot.description));
    let area = Rect::from_min_max(whole.min + vec2(LEFT, TOP), whole.max - vec2(RIGHT, BOTTOM));
    if area.width() < 40.0 || area.height() < 40.0 {
        return;
    }
    let palette = theme::palette(ui.visuals());
    let painter = ui.painter_at(whole);
    let ends = |from: f32, to: f32| [f64::from(from), f64::from(to)];
    let (x, y) = plot.scales_over(ends(area.left(), area.right()), ends(area.bottom(), area.top()));
    grid(&painter, plot, area, (&x, &y), palette);
    let mut nearest: Option<(f32, usize, &PlotMark)> = None;
    let pointer = response.hover_pos();
    for (index, curve) in plot.curves.iter().enumerate() {
        draw(&painter, curve, (&x, &y), index, color(ui, index), palette);
        for mark in &curve.marks {
            let Some(pointer) = pointer else { continue };
            let distance = place(&x, &y, mark.x, mark.y).distance(pointer);
            if distance < NEAR && nearest.is_none_or(|(least, ..)| distance < least) {
                nearest = Some((distance, index, mark));
            }
        }
    }
    if let Some((_, index, mark)) = nearest {
        response.on_hover_text_at_pointer(told(plot, index, mark));
    }
}

/// The numbers of a median.
fn told(plot: &Plot, index: usize, mark: &PlotMark) -> String {
    let language = plot.language;
    let at = plot
        .x
        .names
        .get(mark.x.max(0.0) as usize)
        .cloned()
        .unwrap_or_else(|| language.significant(mark.x, 6));
    let label = plot.curves.get(index).map(|curve| curve.label.as_str()).unwrap_or_default();
    let mut lines = vec![format!("{}: {at}", plot.x.title)];
    if !label.is_empty() {
        lines.push(label.to_owned());
    }
    let interval = language.interval(mark.low, mark.high, 3);
    lines.push(format!("{}: {} ({interval})", plot.y.title, language.significant(mark.y, 4)));
    lines.join("\n").replace('⁻', "¯")
}

/// A number as the window can show it: its font has no raised minus, but a macron that looks like one.
fn label(scale: &Scale, value: f64, language: Language) -> String {
    scale.label(value, language).replace('⁻', "¯")
}

fn place(x: &Scale, y: &Scale, at: f64, value: f64) -> Pos2 {
    pos2(x.at(at) as f32, y.at(value) as f32)
}

/// Lines, numbers and titles.
fn grid(painter: &Painter, plot: &Plot, area: Rect, (x, y): (&Scale, &Scale), palette: &ThemeColors) {
    let font = FontId::proportional(11.5);
    let line = |is_labeled: bool| {
        Stroke::new(1.0, if is_labeled { palette.line } else { palette.line.gamma_multiply(0.45) })
    };
    for tick in y.ticks() {
        let at = y.at(tick.value) as f32;
        painter.hline(area.x_range(), at, line(tick.labeled));
        if tick.labeled {
            let text = label(y, tick.value, plot.language);
            painter.text(pos2(area.left() - 7.0, at), Align2::RIGHT_CENTER, text, font.clone(), palette.weak);
        }
    }
    let labels: Vec<(f32, String)> = if plot.x.names.is_empty() {
        let ticks = x.ticks();
        for tick in &ticks {
            painter.vline(x.at(tick.value) as f32, area.y_range(), line(tick.labeled));
        }
        let labeled = ticks.iter().filter(|tick| tick.labeled);
        labeled.map(|tick| (x.at(tick.value) as f32, label(x, tick.value, plot.language))).collect()
    } else {
        plot.x.names.iter().zip(0..).map(|(name, at)| (x.at(f64::from(at)) as f32, name.clone())).collect()
    };
    let mut end = f32::NEG_INFINITY;
    for (at, text) in labels {
        let galley = painter.layout_no_wrap(text, font.clone(), palette.weak);
        let left = at - 0.5 * galley.size().x;
        // Numbers that would run into each other are left out.
        if left > end + 4.0 {
            end = left + galley.size().x;
            painter.galley(pos2(left, area.bottom() + 5.0), galley, palette.weak);
        }
    }
    let axes = Stroke::new(1.2, palette.weak);
    painter.hline(area.x_range(), area.bottom(), axes);
    painter.vline(area.left(), area.y_range(), axes);
    let title = FontId::proportional(12.5);
    let below = pos2(area.center().x, area.bottom() + BOTTOM - 2.0);
    painter.text(below, Align2::CENTER_BOTTOM, &plot.x.title, title.clone(), palette.text);
    let above = pos2(area.left() - LEFT + 4.0, area.top() - 6.0);
    painter.text(above, Align2::LEFT_BOTTOM, &plot.y.title, title, palette.text);
}

/// The law, the measurements, their intervals and medians, from back to front.
fn draw(
    painter: &Painter,
    curve: &PlotCurve,
    (x, y): (&Scale, &Scale),
    index: usize,
    color: Color32,
    palette: &ThemeColors,
) {
    if let Some((_, law)) = &curve.law {
        let is_shown = |(at, value): &&(f64, f64)| x.shows(*at) && y.shows(*value);
        let points = law.iter().filter(is_shown).map(|(at, value)| place(x, y, *at, *value));
        painter.add(Shape::line(points.collect(), Stroke::new(1.5, color)));
    }
    for mark in &curve.marks {
        let at = x.at(mark.x) as f32;
        // Side by side, or measurements that are close hide each other.
        let count = mark.all.len() as f32;
        for (number, (time, is_outlier)) in mark.all.iter().enumerate() {
            let aside = if count > 1.0 { 10.0 * (number as f32 / (count - 1.0) - 0.5) } else { 0.0 };
            let center = pos2(at + aside, y.at(*time) as f32);
            if *is_outlier {
                painter.circle_stroke(center, 3.0, Stroke::new(1.0, color));
            } else {
                painter.circle_filled(center, 1.4, color.gamma_multiply(0.5));
            }
        }
        let stroke = Stroke::new(1.3, color);
        let [low, high] = [mark.low, mark.high].map(|value| y.at(value) as f32);
        painter.vline(at, low.min(high)..=low.max(high), stroke);
        for end in [low, high] {
            painter.hline(at - 4.0..=at + 4.0, end, stroke);
        }
        symbol(painter, place(x, y, mark.x, mark.y), index, color, palette);
    }
}

/// Curves can be distinguished without colors, too.
fn symbol(painter: &Painter, center: Pos2, index: usize, color: Color32, palette: &ThemeColors) {
    let edge = Stroke::new(1.0, palette.panel);
    let at = |x: f32, y: f32| center + vec2(x, y);
    match index % 4 {
        0 => {
            painter.circle(center, 4.2, color, edge);
        }
        1 => {
            let rect = Rect::from_center_size(center, vec2(7.6, 7.6));
            painter.rect(rect, 0.0, color, edge, egui::StrokeKind::Middle);
        }
        2 => {
            let points = vec![at(0.0, -5.0), at(4.8, 3.2), at(-4.8, 3.2)];
            painter.add(Shape::convex_polygon(points, color, edge));
        }
        _ => {
            let points = vec![at(0.0, -5.0), at(5.0, 0.0), at(0.0, 5.0), at(-5.0, 0.0)];
            painter.add(Shape::convex_polygon(points, color, edge));
        }
    }
}
