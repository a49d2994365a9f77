//! Exact answers over the picture: images in their true places, focal points and highlights, each beside what the
//! tracer finds.

use catoptric_lab::exact::{ExactAnswer, ExactDeviation, Inapplicable, RingImage};
use catoptric_scene::{DishProfile, ScenePart};
use egui::accesskit::Role;
use egui::{
    Align2, Color32, Id, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Visuals, WidgetInfo, pos2, vec2,
};
use glam::DVec3;

use super::dashes::dashed;
use super::scene_view::SceneView;
use crate::base::texts::Texts;
use crate::base::{plates, theme};
use crate::panels::audit::short;
use crate::panels::outliner::part_name;
use crate::state::context::Cx;
use crate::state::exact;

/// The color of what the laws say.
const EXACT: Color32 = Color32::from_rgb(255, 142, 214);
/// The most labels: those of the first answers.
const MOST_LABELS: usize = 10;

/// Draws the answers for the selected body.
pub(crate) fn answers_ui(ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView) {
    cx.exact.poll();
    if !cx.view.is_measuring {
        cx.exact.want(ui.ctx(), cx.editor, scene_view.camera);
    }
    let Some(body) = exact::body_of(cx.editor) else { return };
    let Some(answers) = cx.exact.answers(body) else { return };
    let painter = ui.painter_at(scene_view.visible);
    let mut pen = AnswerPainter { ui, cx, scene_view, painter: &painter, plates: Vec::new() };
    answers.answers.iter().for_each(|answer| pen.answer(answer));
    let mut remarks: Vec<String> =
        answers.inapplicable.iter().map(|reason| pen.inapplicable(*reason)).collect();
    if answers.answers.is_empty() && remarks.is_empty() {
        remarks.push(cx.t("exact-none").to_owned());
    }
    if !remarks.is_empty() {
        pen.remark(&remarks.join("\n"));
    }
}

struct AnswerPainter<'a> {
    ui: &'a Ui,
    cx: &'a Cx<'a>,
    scene_view: &'a SceneView,
    painter: &'a Painter,
    /// Where labels are.
    plates: Vec<Rect>,
}

impl AnswerPainter<'_> {
    fn answer(&mut self, answer: &ExactAnswer) {
        let texts = self.cx.texts;
        let scene = self.cx.editor.scene();
        let name = |part: ScenePart| part_name(texts, scene, part).into_owned();
        let in_mirror =
            |key: &str, mirror: usize| texts.with(key, &[("mirror", name(ScenePart::Body(mirror)).into())]);
        match answer {
            ExactAnswer::PlaneImage { mirror, body, object, image } => {
                self.ghost(*body, *object, image.exact);
                self.dashed(*object, image.exact);
                self.compared(image, &in_mirror("exact-image", *mirror));
            }
            ExactAnswer::SphereImage { mirror, object, image, .. } => {
                self.dashed(*object, image.exact);
                self.compared(image, &in_mirror("exact-sphere-image", *mirror));
            }
            ExactAnswer::ReflectionPoint { mirror, point, .. } => {
                self.compared(point, &in_mirror("exact-reflection-point", *mirror));
            }
            ExactAnswer::Focus { body, focal_length, paraxial, marginal }
            | ExactAnswer::LensFocus { body, focal_length, paraxial, marginal } => {
                let is_lens = matches!(answer, ExactAnswer::LensFocus { .. });
                let key = if is_lens { "exact-lens-focus" } else { "exact-focus" };
                let center = scene.bodies.get(*body).map(|body| body.placement.world_from_body().translation);
                self.dashed(center.unwrap_or(paraxial.exact), paraxial.exact);
                let focus = texts.with(key, &[("length", short(texts, *focal_length).into())]);
                self.compared(paraxial, &focus);
                if let Some(marginal) = marginal {
                    self.compared(marginal, texts.get("exact-marginal"));
                }
            }
            ExactAnswer::DishFocus { mirror, profile, focal_length, near, marginal, .. } => {
                let frame = scene.bodies.get(*mirror).map(|body| body.placement.world_from_body());
                self.dashed(frame.map_or(near.exact, |frame| frame.translation), near.exact);
                let focus = |key| texts.with(key, &[("length", short(texts, *focal_length).into())]);
                match profile {
                    DishProfile::Parabolic => {
                        let worst = if near.difference() < marginal.difference() { marginal } else { near };
                        self.compared(worst, &focus("exact-parabolic-focus"));
                    }
                    DishProfile::Spherical => {
                        self.compared(near, &focus("exact-spherical-focus"));
                        self.compared(marginal, texts.get("exact-marginal"));
                    }
                }
            }
            ExactAnswer::Highlight { light, point, off, .. } => {
                let title =
                    texts.with("exact-highlight", &[("light", name(ScenePart::Light(*light)).into())]);
                self.told(*point, &title, off.map(|off| format!("{}°", short(texts, off.to_degrees()))));
            }
            ExactAnswer::Ring { angle, images, .. } => self.ring(*angle, images),
        }
    }

    /// Why something has no exact answer.
    fn inapplicable(&self, reason: Inapplicable) -> String {
        let scene = self.cx.editor.scene();
        let name = |body: usize| part_name(self.cx.texts, scene, ScenePart::Body(body)).into_owned();
        let key = match reason {
            Inapplicable::RoughMirror { .. } => "exact-rough-mirror",
            Inapplicable::CurvedMirror { .. } => "exact-curved-mirror",
            Inapplicable::OfParts { .. } => "exact-of-parts",
            Inapplicable::ObjectInFocus { .. } => "exact-object-in-focus",
            Inapplicable::RoughLens { .. } => "exact-rough-lens",
            Inapplicable::UnevenLens { .. } => "exact-uneven-lens",
            Inapplicable::SharedLens { .. } => "exact-shared-lens",
            Inapplicable::WeakLens { .. } => "exact-weak-lens",
            Inapplicable::FocusInside { .. } => "exact-focus-inside",
        };
        let other = reason.other().map_or_else(String::new, name);
        self.cx.texts.with(key, &[("body", name(reason.body()).into()), ("other", other.into())])
    }

    /// Words at the lower edge of the picture, about no point of it.
    fn remark(&mut self, text: &str) {
        let palette = theme::palette(&Visuals::dark());
        let at = self.scene_view.visible.center_bottom() - vec2(0.0, 16.0);
        let plate =
            plates::plate(self.painter, self.scene_view.visible, at, Align2::CENTER_BOTTOM, text, palette);
        self.listen(plate, text);
    }

    /// The images between two mirrors, each with the number of its reflections.
    fn ring(&mut self, angle: f64, images: &[RingImage]) {
        for image in images {
            self.point(image.position);
            if let Some(at) = self.scene_view.point(image.position) {
                let font = egui::FontId::proportional(12.0);
                let at = at + vec2(0.0, -7.0);
                let number = image.reflections.to_string();
                let shadow = at + vec2(1.0, 1.0);
                self.painter.text(shadow, Align2::CENTER_BOTTOM, &number, font.clone(), Color32::BLACK);
                self.painter.text(at, Align2::CENTER_BOTTOM, number, font, Color32::WHITE);
            }
        }
        // The last ones lie farthest away, where there is room.
        let Some(last) = images.last() else { return };
        let arguments =
            [("count", images.len().into()), ("angle", short(self.cx.texts, angle.to_degrees()).into())];
        let texts = self.cx.texts;
        let title = texts.with("exact-ring", &arguments);
        let miss = images.iter().filter_map(|image| image.miss).reduce(f64::max);
        self.told(last.position, &title, miss.map(|miss| length(texts, miss)));
    }

    /// The outline of a body mirrored from `object` to `image`.
    fn ghost(&self, body: usize, object: DVec3, image: DVec3) {
        let Some(body) = self.cx.editor.scene().bodies.get(body) else { return };
        let Some(normal) = (image - object).try_normalize() else { return };
        let middle = object.midpoint(image);
        let mirrored = |point: DVec3| point - 2.0 * (point - middle).dot(normal) * normal;
        // What is far outside would make a shape of every dash up to there.
        let near = self.scene_view.rect.expand(self.scene_view.rect.size().max_elem());
        let shown = |point: DVec3| self.scene_view.point(mirrored(point)).filter(|at| near.contains(*at));
        for line in body.outline(mirrored(self.scene_view.projector.position())) {
            let points: Vec<Option<Pos2>> = line.into_iter().map(shown).collect();
            for piece in points.split(Option::is_none) {
                let piece: Vec<Pos2> = piece.iter().copied().flatten().collect();
                let dark = Stroke::new(3.2, Color32::from_black_alpha(120));
                self.painter.add(Shape::line(piece.clone(), dark));
                let dashes = Shape::dashed_line(&piece, Stroke::new(1.6, EXACT), 6.0, 3.0);
                self.painter.extend(dashes);
            }
        }
    }

    fn dashed(&self, from: DVec3, to: DVec3) {
        let Some(ends) = self.scene_view.projector.segment(from, to) else { return };
        let ends = ends.map(|end| self.scene_view.pos(end));
        let color = EXACT.gamma_multiply(0.7);
        dashed(self.painter, ends, Stroke::new(1.0, color), 3.0, 4.0);
    }

    /// Where the law puts a point.
    fn point(&self, point: DVec3) {
        if let Some(at) = self.scene_view.point(point) {
            self.painter.circle(at, 4.0, EXACT, Stroke::new(1.5, Color32::from_black_alpha(160)));
        }
    }

    /// Where the tracer finds it.
    fn found(&self, point: DVec3) {
        let Some(at) = self.scene_view.point(point) else { return };
        for stroke in [Stroke::new(3.0, Color32::from_black_alpha(150)), Stroke::new(1.2, Color32::WHITE)] {
            for arm in [vec2(7.0, 0.0), vec2(0.0, 7.0)] {
                self.painter.line_segment([at - arm, at + arm], stroke);
            }
        }
    }

    fn compared(&mut self, compared: &ExactDeviation, title: &str) {
        if let Some(found) = compared.found {
            self.found(found);
        }
        let off = compared.difference().map(|off| length(self.cx.texts, off));
        self.told(compared.exact, title, off);
    }

    /// A point with what it is, and how far the tracer is from it.
    fn told(&mut self, point: DVec3, title: &str, off: Option<String>) {
        self.point(point);
        let texts = self.cx.texts;
        let off = match off {
            Some(off) => texts.with("exact-off", &[("difference", off.into())]),
            None => texts.get("exact-elsewhere").to_owned(),
        };
        if let Some(at) = self.scene_view.point(point).filter(|at| self.scene_view.visible.contains(*at)) {
            self.label(at, &format!("{title}\n{off}"));
        }
    }

    /// A label beside a point, moved down from those that are there.
    fn label(&mut self, point: Pos2, text: &str) {
        /// A little more than two lines.
        const STEP: f32 = 42.0;
        if self.plates.len() == MOST_LABELS {
            return;
        }
        let place = Rect::from_min_size(point + vec2(22.0, -14.0), vec2(200.0, STEP - 2.0));
        let is_free = |place: &Rect| !self.plates.iter().any(|plate| plate.intersects(*place));
        let steps = (0..8_u8).map(|step| place.translate(vec2(0.0, STEP * f32::from(step))));
        let place = steps.into_iter().find(is_free).unwrap_or(place);
        let palette = theme::palette(&Visuals::dark());
        let plate =
            plates::plate(self.painter, self.scene_view.visible, place.min, Align2::LEFT_TOP, text, palette);
        let end = pos2(plate.left(), plate.center().y);
        if !plate.contains(point) && end.x > point.x {
            self.painter
                .line_segment([point + vec2(5.0, 0.0), end], Stroke::new(1.0, EXACT.gamma_multiply(0.8)));
        }
        self.listen(plate, text);
    }

    /// Keeps the place of a label, which screen readers and tests can read.
    fn listen(&mut self, plate: Rect, text: &str) {
        self.plates.push(plate);
        let id = Id::unique(("exact answer", self.plates.len()));
        let response = self.ui.interact(plate, id, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    }
}

/// A length in the unit in which it is easily said.
fn length(texts: &Texts, meters: f64) -> String {
    let (factor, key) = match meters {
        meters if meters >= 1.0 => (1.0, "exact-m"),
        meters if meters >= 1e-3 => (1e3, "exact-mm"),
        meters if meters >= 1e-6 => (1e6, "exact-um"),
        _ => (1e9, "exact-nm"),
    };
    texts.with(key, &[("value", short(texts, (10.0 * factor * meters).round() / 10.0).into())])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;

    #[test]
    fn lengths_have_units_that_fit() {
        let texts = Texts::new(Language::English);
        let all = [0.0, 3.2e-8, 4.56e-5, 0.0123, 2.0].map(|meters| length(&texts, meters));
        assert_eq!(all, ["0 nm", "32 nm", "45.6 µm", "12.3 mm", "2 m"]);
    }
}
