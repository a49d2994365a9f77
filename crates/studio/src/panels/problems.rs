//! The panel of what is wrong in the file: its findings, and the text that they speak of.

mod excerpt;
mod notes;
mod source;

use std::ops::Range;
use std::sync::Arc;

use catoptric_scene::{Diagnostic, Diagnostics, Problem, Scene, ScenePart, Severity};
use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, FontId, Rect, RichText, ScrollArea, Sense, TextFormat, Ui, WidgetInfo, pos2, vec2,
};
use egui_material_icons::icons;

use crate::base::theme::{self, ThemeColors};
use crate::base::widgets::paint_line_in;
use crate::panels::viewport::why;
use crate::state::command::{Command, FileCommand};
use crate::state::context::Cx;
use excerpt::Excerpt;

/// Scenes with more bodies than this are not checked as a whole while they are edited; each edit is.
const MOST_CHECKED: usize = 20_000;

/// The state of the panel.
#[derive(Default)]
pub(crate) struct ProblemsPanel {
    name: String,
    text: Arc<str>,
    findings: Diagnostics,
    /// For each finding, whether it is only a note.
    notes: Vec<bool>,
    excerpts: Vec<Excerpt>,
    selected: Option<usize>,
    /// Scroll the text to the selected finding.
    scrolls: bool,
    /// What is wrong with the scene as it is now, and the revision that was checked.
    live: Vec<Problem>,
    checked: Option<u64>,
}

impl ProblemsPanel {
    /// Lists the findings of a file's `text`, which describes `scene`.
    pub(crate) fn set(&mut self, name: &str, text: Arc<str>, findings: Diagnostics, scene: &Scene) {
        name.clone_into(&mut self.name);
        self.notes = notes::notes(&findings, &text, scene);
        self.excerpts = findings.iter().map(|finding| Excerpt::new(&text, &finding.span)).collect();
        self.text = text;
        self.findings = findings;
        self.selected = (!self.findings.is_empty()).then_some(0);
        self.scrolls = true;
    }

    /// Whether the findings of the file are notes and nothing else.
    pub(crate) fn has_only_notes(&self) -> bool {
        self.findings.omitted() == 0 && self.notes.iter().all(|is_note| *is_note)
    }

    /// How many findings of the file are notes.
    pub(crate) fn note_count(&self) -> usize {
        self.notes.iter().filter(|is_note| **is_note).count()
    }

    /// Lists no findings of a file.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }
}

/// Lists the findings with their lines; a click shows the text.
pub(crate) fn problems_ui(ui: &mut Ui, cx: &mut Cx<'_>, problems: &mut ProblemsPanel) {
    check_scene(cx, problems);
    let fault = cx.live.status().error.map(|error| why(cx.texts, &error));
    let has_live = fault.is_some() || !problems.live.is_empty();
    if problems.findings.is_empty() && !has_live {
        ui.centered_and_justified(|ui| ui.weak(cx.t("problems-none")));
        return;
    }
    if has_live {
        live_ui(ui, cx, problems, fault);
    }
    if problems.findings.is_empty() {
        return;
    }
    let width = ui.available_width();
    if width < 560.0 {
        list_ui(ui, cx, problems);
        return;
    }
    let height = ui.available_height();
    ui.horizontal_top(|ui| {
        let list = vec2((width * 0.52).floor(), height);
        ui.allocate_ui(list, |ui| ui.vertical(|ui| list_ui(ui, cx, problems)));
        ui.allocate_ui(ui.available_size(), |ui| ui.vertical(|ui| source::source_ui(ui, cx, problems)));
    });
}

/// Holds the scene against the rules, once for each revision.
fn check_scene(cx: &Cx<'_>, problems: &mut ProblemsPanel) {
    let revision = cx.editor.revision();
    if problems.checked == Some(revision) || cx.editor.is_in_gesture() {
        return;
    }
    problems.checked = Some(revision);
    let scene = cx.editor.scene();
    problems.live = if scene.bodies.len() > MOST_CHECKED { Vec::new() } else { scene.check() };
}

/// What is wrong with the scene itself; a click selects the thing.
fn live_ui(ui: &mut Ui, cx: &mut Cx<'_>, problems: &ProblemsPanel, fault: Option<String>) {
    let color = theme::palette(ui.visuals()).error;
    ui.label(RichText::new(cx.t("problems-scene")).strong());
    if let Some(fault) = fault {
        ui.label(RichText::new(fault).color(color));
    }
    for problem in &problems.live {
        let message = problem.message(cx.texts.language().into());
        if ui.selectable_label(false, RichText::new(message).color(color)).clicked()
            && matches!(problem.part, ScenePart::Body(_) | ScenePart::Light(_))
        {
            cx.editor.select_parts([problem.part]);
        }
    }
    ui.separator();
}

fn list_ui(ui: &mut Ui, cx: &mut Cx<'_>, problems: &mut ProblemsPanel) {
    let number = problems.findings.len() + problems.findings.omitted();
    let arguments = [("number", number.into()), ("name", problems.name.as_str().into())];
    let heading = if problems.has_only_notes() {
        cx.texts.with("notes-in", &arguments)
    } else {
        cx.texts.with("problems-in", &arguments)
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(heading).strong());
        let otherwise = Command::from(FileCommand::ReadOtherwise);
        if cx.situation().can(&otherwise) && ui.button(cx.t("command-read-otherwise")).clicked() {
            cx.run(otherwise);
        }
    });
    let line =
        ui.text_style_height(&egui::TextStyle::Body).max(ui.text_style_height(&egui::TextStyle::Monospace));
    let tops = tops(&problems.findings, line);
    let height = tops.last().copied().unwrap_or(0.0);
    let palette = theme::palette(ui.visuals());
    ScrollArea::vertical().id_salt("findings").auto_shrink(false).show_viewport(ui, |ui, view| {
        ui.set_height(height);
        let corner = ui.max_rect().min;
        let width = ui.available_width();
        let first = tops.partition_point(|top| *top <= view.min.y).saturating_sub(1);
        for (index, finding) in problems.findings.iter().enumerate().skip(first) {
            let (Some(&top), Some(&bottom)) = (tops.get(index), tops.get(index + 1)) else { break };
            if top > view.max.y {
                break;
            }
            let rect = Rect::from_min_max(corner + vec2(0.0, top), pos2(corner.x + width, corner.y + bottom));
            let is_selected = problems.selected == Some(index);
            let excerpt = problems.excerpts.get(index);
            let rank = FindingRank::of(finding, problems.notes.get(index) == Some(&true));
            if finding_ui(ui, cx, rect, (finding, rank), excerpt, is_selected, palette) {
                problems.selected = Some(index);
                problems.scrolls = true;
            }
        }
    });
    if problems.findings.omitted() > 0 {
        let omitted = [("number", problems.findings.omitted().into())];
        ui.weak(cx.texts.with("problems-omitted", &omitted));
    }
}

const PADDING: f32 = 4.0;

/// Where each finding begins, and the last one ends.
fn tops(findings: &Diagnostics, line: f32) -> Vec<f32> {
    let mut tops = vec![0.0];
    let mut top = 0.0;
    for finding in findings {
        let lines = if finding.has_help() { 3.0 } else { 2.0 };
        top += lines * (line + 1.0) + 2.0 * PADDING;
        tops.push(top);
    }
    tops
}

/// The rank of a finding in the list.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FindingRank {
    Error,
    Warning,
    Note,
}

impl FindingRank {
    fn of(finding: &Diagnostic, is_note: bool) -> Self {
        match finding.severity {
            Severity::Error => Self::Error,
            Severity::Warning if !is_note => Self::Warning,
            Severity::Warning | Severity::Note => Self::Note,
        }
    }

    const fn key(self) -> &'static str {
        match self {
            Self::Error => "problem-error",
            Self::Warning => "problem-warning",
            Self::Note => "problem-note",
        }
    }

    fn sign(self, palette: &ThemeColors) -> (&'static str, Color32) {
        match self {
            Self::Error => (icons::ICON_ERROR.codepoint, palette.error),
            Self::Warning => (icons::ICON_WARNING.codepoint, palette.warning),
            Self::Note => (icons::ICON_INFO.codepoint, palette.accent),
        }
    }
}

/// Draws a finding; returns whether it was clicked.
fn finding_ui(
    ui: &Ui,
    cx: &Cx<'_>,
    rect: Rect,
    (finding, rank): (&Diagnostic, FindingRank),
    excerpt: Option<&Excerpt>,
    is_selected: bool,
    palette: &ThemeColors,
) -> bool {
    let language = cx.texts.language().into();
    let text = finding.message(language);
    let id = ui.scope_id().with(("finding", finding.span.start, finding.line, &text));
    let response = ui.interact(rect, id, Sense::click());
    let severity = cx.texts.get(rank.key());
    response.widget_info(|| {
        let place = [("line", finding.line.into()), ("column", finding.column.into())];
        let place = cx.texts.with("problem-place", &place);
        let name = format!("{place}: {severity}: {text}");
        WidgetInfo::selected(egui::accesskit::Role::Button, true, is_selected, name)
    });
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    if is_selected {
        painter.rect_filled(rect, 4.0, palette.selection);
    } else if response.hovered() || response.has_focus() {
        painter.rect_filled(rect, 4.0, palette.button);
    }
    let (icon, color) = rank.sign(palette);
    let body = FontId::proportional(13.5);
    let mono = FontId::monospace(12.5);
    let help = finding.help(language);
    let lines = if help.is_some() { 3.0 } else { 2.0 };
    let step = (rect.height() - 2.0 * PADDING) / lines;
    let line = Rect::from_min_size(rect.min + vec2(6.0, PADDING), vec2(rect.width() - 12.0, step));
    let mark = painter.text(line.left_center(), Align2::LEFT_CENTER, icon, FontId::proportional(15.0), color);
    let line = line.with_min_x(mark.max.x + 6.0);
    let place = format!("{}:{}", finding.line, finding.column);
    let place = painter.text(line.left_center(), Align2::LEFT_CENTER, place, mono.clone(), palette.weak);
    let message = line.with_min_x(place.max.x + 8.0);
    paint_line_in(ui, message, &text, body.clone(), palette.text);
    let line = line.translate(vec2(0.0, step));
    if let Some(excerpt) = excerpt {
        let mut job = marked(&excerpt.line, &excerpt.mark, &mono, palette.weak, color);
        job.wrap = TextWrapping::truncate_at_width(line.width());
        let galley = painter.layout_job(job);
        let corner = pos2(line.left(), line.center().y - galley.size().y / 2.0);
        painter.galley(corner, galley, palette.weak);
    }
    if let Some(help) = &help {
        paint_line_in(ui, line.translate(vec2(0.0, step)), help, body, palette.weak);
    }
    if response.hovered() {
        let full: Vec<String> = [Some(text), finding.label(language), help].into_iter().flatten().collect();
        return response.on_hover_text(full.join("\n")).clicked();
    }
    response.clicked()
}

/// A line with its mark in color and underlined.
fn marked(line: &str, mark: &Range<usize>, font: &FontId, color: Color32, mark_color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    let plain = TextFormat::simple(font.clone(), color);
    let underlined = TextFormat {
        underline: egui::Stroke::new(1.5, mark_color),
        ..TextFormat::simple(font.clone(), mark_color)
    };
    let part = |range: Range<usize>| line.get(range).unwrap_or_default();
    job.append(part(0..mark.start), 0.0, plain.clone());
    job.append(part(mark.start..mark.end), 0.0, underlined);
    job.append(part(mark.end..line.len()), 0.0, plain);
    job
}
