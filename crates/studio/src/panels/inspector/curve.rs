//! The curve of reflection: how much a material reflects under which angle.

use catoptric_lab::reflectance::{
    CurveKind, ReflectanceCurve, SpecialAngle, SpecialAngleKind, curves_of, marks_of, reflected_at,
};
use catoptric_scene::Material;
use egui::{
    Align2, Color32, FontId, Pos2, Rect, RichText, Role, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo,
    pos2, vec2,
};

use super::header::hint;
use crate::base::texts::Texts;
use crate::base::theme::{self, ThemeColors};
use crate::base::widgets::number::shown;
use crate::state::view::ProjectedPoint;

const HEIGHT: f32 = 132.0;
/// Points of a curve: two for each degree, so that critical angles are sharp.
const POINTS: usize = 181;

/// The reflectance curves of a material and their special angles, kept until it changes: those of metals take work.
#[derive(Default)]
pub(crate) struct ReflectanceCurves {
    of: Option<Box<Material>>,
    curves: Vec<ReflectanceCurve>,
    marks: Vec<SpecialAngle>,
}

impl ReflectanceCurves {
    fn follow(&mut self, material: &Material) {
        if self.of.as_deref() != Some(material) {
            self.curves = curves_of(material);
            self.marks = marks_of(material);
            self.of = Some(Box::new(material.clone()));
        }
    }
}

/// Draws the curve of a material, if it has one that is not flat; `seen` is a point of a body made of it.
pub(super) fn curve_ui(
    ui: &mut Ui,
    texts: &Texts,
    material: &Material,
    kept: &mut ReflectanceCurves,
    seen: Option<ProjectedPoint>,
) {
    kept.follow(material);
    let ReflectanceCurves { curves, marks, .. } = kept;
    if curves.is_empty() {
        return;
    }
    let palette = theme::palette(ui.visuals());
    let (whole, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    let area = Rect::from_min_max(whole.min + vec2(26.0, 8.0), whole.max - vec2(8.0, 18.0));
    let chart = CurveChart { area, palette };
    chart.axes(ui, texts);
    for mark in marks.iter() {
        chart.mark(ui, texts, mark);
    }
    for curve in curves.iter() {
        chart.curve(ui, curve);
    }
    let summary = marks.iter().map(|mark| told(texts, mark)).collect::<Vec<_>>().join("; ");
    response.widget_info(|| {
        WidgetInfo::labeled(Role::Image, true, format!("{}. {summary}", texts.get("reflection-curve")))
    });
    let pointed = response.hover_pos().filter(|pos| area.expand(2.0).contains(*pos));
    if let Some(pos) = pointed {
        let degrees = f64::from(((pos.x - area.left()) / area.width()).clamp(0.0, 1.0)) * 90.0;
        chart.pointer(ui, degrees, curves.iter());
        let mut words = vec![texts.localized(format!("θ = {degrees:.1}°"))];
        let values = curves.iter().map(|curve| (name_of(texts, curve.kind), curve.at(degrees)));
        words.extend(values.map(|(name, value)| format!("{name} {}", shown(texts, value, 4))));
        hint(ui, &words.join(";  "));
        return;
    }
    if !summary.is_empty() {
        hint(ui, &summary);
    }
    if let Some(seen) = seen
        && let Some(shares) = reflected_at(material, curves, seen.degrees, seen.is_from_inside)
    {
        let own = curves.iter().filter(|curve| curve.kind.is_from_inside() == seen.is_from_inside);
        chart.pointer(ui, seen.degrees, own);
        ui.add(egui::Label::new(RichText::new(seen_text(texts, seen, shares)).size(12.0)).wrap());
    }
}

/// The angle under which a point is seen, and what is reflected there.
fn seen_text(texts: &Texts, seen: ProjectedPoint, [red, green, blue]: [f64; 3]) -> String {
    let angle = texts.localized(format!("{:.1}", seen.degrees));
    if red == green && green == blue {
        let key = if seen.is_from_inside { "curve-seen-inside-alike" } else { "curve-seen-alike" };
        return texts.with(key, &[("angle", angle.into()), ("share", shown(texts, red, 4).into())]);
    }
    let [red, green, blue] = [red, green, blue].map(|share| shown(texts, share, 4));
    let shares =
        [("angle", angle.into()), ("red", red.into()), ("green", green.into()), ("blue", blue.into())];
    texts.with(if seen.is_from_inside { "curve-seen-inside" } else { "curve-seen" }, &shares)
}

struct CurveChart<'p> {
    area: Rect,
    palette: &'p ThemeColors,
}

impl CurveChart<'_> {
    fn place(&self, degrees: f64, share: f64) -> Pos2 {
        let x = self.area.left() + self.area.width() * (degrees / 90.0) as f32;
        pos2(x, self.area.bottom() - self.area.height() * share as f32)
    }

    fn axes(&self, ui: &Ui, texts: &Texts) {
        let (painter, palette) = (ui.painter(), self.palette);
        painter.rect(self.area, 2.0, palette.field, Stroke::new(1.0, palette.line), StrokeKind::Inside);
        let font = FontId::proportional(10.5);
        for share in [0.0, 0.5, 1.0] {
            let at = self.place(0.0, share);
            painter.hline(self.area.x_range(), at.y, Stroke::new(0.5, palette.line));
            let text = shown(texts, share, 1);
            painter.text(at - vec2(4.0, 0.0), Align2::RIGHT_CENTER, text, font.clone(), palette.weak);
        }
        for degrees in [0.0, 30.0, 60.0, 90.0] {
            let at = self.place(degrees, 0.0);
            painter.vline(at.x, self.area.y_range(), Stroke::new(0.5, palette.line));
            let text = format!("{degrees}°");
            painter.text(at + vec2(0.0, 3.0), Align2::CENTER_TOP, text, font.clone(), palette.weak);
        }
    }

    fn curve(&self, ui: &Ui, curve: &ReflectanceCurve) {
        let step = 90.0 / (POINTS - 1) as f64;
        let points: Vec<Pos2> = (0..POINTS)
            .map(|index| {
                let degrees = step * index as f64;
                self.place(degrees, curve.at(degrees))
            })
            .collect();
        let stroke = Stroke::new(1.6, color_of(curve.kind, self.palette));
        if curve.kind == CurveKind::FromInside {
            ui.painter().extend(Shape::dashed_line(&points, stroke, 4.0, 3.0));
        } else {
            ui.painter().add(Shape::line(points, stroke));
        }
    }

    /// Marks an angle, and where the curves are there.
    fn pointer<'c>(&self, ui: &Ui, degrees: f64, curves: impl Iterator<Item = &'c ReflectanceCurve>) {
        let x = self.place(degrees, 0.0).x;
        ui.painter().vline(x, self.area.y_range(), Stroke::new(1.0, self.palette.text));
        for curve in curves {
            let at = self.place(degrees, curve.at(degrees));
            ui.painter().circle(
                at,
                3.0,
                color_of(curve.kind, self.palette),
                Stroke::new(1.0, self.palette.field),
            );
        }
    }

    fn mark(&self, ui: &Ui, texts: &Texts, mark: &SpecialAngle) {
        let at = self.place(mark.degrees, 1.0);
        let stroke = Stroke::new(1.0, self.palette.accent.gamma_multiply(0.8));
        let bottom = self.place(mark.degrees, 0.0);
        ui.painter().extend(Shape::dashed_line(&[at, bottom], stroke, 2.0, 3.0));
        let sign = texts.get(match mark.kind {
            SpecialAngleKind::Brewster => "brewster-sign",
            SpecialAngleKind::Critical => "critical-sign",
        });
        let font = FontId::proportional(10.5);
        ui.painter().text(at + vec2(3.0, 2.0), Align2::LEFT_TOP, sign, font, self.palette.accent);
    }
}

fn told(texts: &Texts, mark: &SpecialAngle) -> String {
    let key = match (mark.kind, mark.is_from_inside) {
        (SpecialAngleKind::Brewster, false) => "brewster-outside",
        (SpecialAngleKind::Brewster, true) => "brewster-inside",
        (SpecialAngleKind::Critical, false) => "critical-outside",
        (SpecialAngleKind::Critical, true) => "critical-inside",
    };
    texts.with(key, &[("angle", shown(texts, mark.degrees, 2).into())])
}

fn name_of(texts: &Texts, kind: CurveKind) -> &str {
    texts.get(match kind {
        CurveKind::Red => "curve-red",
        CurveKind::Green => "curve-green",
        CurveKind::Blue => "curve-blue",
        CurveKind::FromOutside => "curve-outside",
        CurveKind::FromInside => "curve-inside",
    })
}

fn color_of(kind: CurveKind, palette: &ThemeColors) -> Color32 {
    match kind {
        CurveKind::Red => Color32::from_rgb(226, 84, 72),
        CurveKind::Green => Color32::from_rgb(84, 176, 92),
        CurveKind::Blue => Color32::from_rgb(88, 134, 236),
        CurveKind::FromOutside => palette.text,
        CurveKind::FromInside => palette.weak,
    }
}
