//! Formulas as boxes: texts and lines at their places about a baseline, as TeX sets them.

use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Galley, Pos2, Stroke, Ui, Vec2, vec2};

use super::FormulaNode;

/// How much smaller indices, exponents and notes are.
const SCRIPT: f32 = 0.72;
/// How much smaller the parts of a fraction within another one are.
const NESTED: f32 = 0.86;
/// Height of capital letters and figures, depth of tails, and of the middle of signs such as `=`, in sizes of the font.
const CAPITAL: f32 = 0.70;
const TAIL: f32 = 0.20;
const AXIS: f32 = 0.26;

/// A formula that has been set.
#[derive(Clone, Default)]
pub(in crate::shell::manual) struct FormulaBox {
    /// Points.
    pub(in crate::shell::manual) width: f32,
    /// From the baseline up and down, points.
    pub(in crate::shell::manual) ascent: f32,
    pub(in crate::shell::manual) descent: f32,
    pieces: Vec<FormulaShape>,
}

/// A text or line of a formula, relative to the left end of the baseline; y goes down.
#[derive(Clone)]
enum FormulaShape {
    Text { galley: Arc<Galley>, corner: Vec2 },
    Stroke { points: Vec<Vec2> },
}

/// Sets formulas in a color, with stacked fractions or in one line.
#[derive(Clone, Copy)]
struct Typesetter<'a> {
    ui: &'a Ui,
    color: Color32,
    /// Fractions stand one over the other, and not in one line.
    is_high: bool,
}

/// Sets a formula in lines of at most `width` points: on its own (`is_high`), or within a line of text.
pub(in crate::shell::manual) fn lines(
    ui: &Ui,
    node: &FormulaNode,
    (size, color): (f32, Color32),
    is_high: bool,
    width: f32,
) -> Vec<FormulaBox> {
    let setter = Typesetter { ui, color, is_high };
    let whole = setter.set(node, size);
    let FormulaNode::Row(nodes) = node else { return vec![whole] };
    if whole.width <= width {
        return vec![whole];
    }
    let mut lines: Vec<FormulaBox> = Vec::new();
    for part in parts(nodes) {
        let part = setter.row(part, size);
        match lines.last_mut() {
            Some(line) if line.width + part.width <= width => line.append(part),
            _ => lines.push(part),
        }
    }
    lines
}

/// A row in parts between which a line can end: before signs of operation, and after wide gaps.
fn parts(nodes: &[FormulaNode]) -> Vec<&[FormulaNode]> {
    let mut parts = Vec::new();
    let mut start = 0;
    for (place, node) in nodes.iter().enumerate().skip(1) {
        let is_gap = matches!(nodes.get(place - 1), Some(FormulaNode::Space(width)) if *width >= 1.0);
        if is_gap || matches!(node, FormulaNode::Operator('=' | '+' | '−' | '≤' | '≥')) {
            parts.extend(nodes.get(start..place));
            start = place;
        }
    }
    parts.extend(nodes.get(start..));
    parts
}

impl FormulaBox {
    /// Paints it; `start` is the left end of its baseline.
    pub(in crate::shell::manual) fn paint(&self, ui: &Ui, start: Pos2, color: Color32) {
        for piece in &self.pieces {
            match piece {
                FormulaShape::Text { galley, corner } => {
                    ui.painter().galley(start + *corner, Arc::clone(galley), color);
                }
                FormulaShape::Stroke { points } => {
                    let points = points.iter().map(|point| start + *point).collect();
                    ui.painter().line(points, Stroke::new(1.0, color));
                }
            }
        }
    }

    /// Puts `other` after it.
    fn append(&mut self, other: Self) {
        let at = vec2(self.width, 0.0);
        self.put(other, at);
    }

    /// Puts `other` with the left end of its baseline at `at`.
    fn put(&mut self, other: Self, at: Vec2) {
        self.width = self.width.max(at.x + other.width);
        self.ascent = self.ascent.max(other.ascent - at.y);
        self.descent = self.descent.max(other.descent + at.y);
        self.pieces.extend(other.pieces.into_iter().map(|piece| match piece {
            FormulaShape::Text { galley, corner } => FormulaShape::Text { galley, corner: corner + at },
            FormulaShape::Stroke { points } => {
                FormulaShape::Stroke { points: points.into_iter().map(|point| point + at).collect() }
            }
        }));
    }

    fn stroke<const N: usize>(&mut self, points: [Vec2; N]) {
        self.pieces.push(FormulaShape::Stroke { points: points.to_vec() });
    }
}

impl Typesetter<'_> {
    fn set(&self, node: &FormulaNode, size: f32) -> FormulaBox {
        match node {
            FormulaNode::Row(nodes) => self.row(nodes, size),
            FormulaNode::Letter(letter) => {
                let mut leaning = self.text(&letter.to_string(), size, letter.is_alphabetic());
                // Room for the slant.
                leaning.width += 0.06 * size;
                leaning
            }
            FormulaNode::Sign(sign) | FormulaNode::Function(sign) => self.text(sign, size, false),
            FormulaNode::Operator(sign) => self.operator(*sign, size),
            FormulaNode::Space(width) => FormulaBox { width: width * size, ..FormulaBox::default() },
            FormulaNode::Hat(base) => self.hat(base, size),
            FormulaNode::Root(inner) => self.root(inner, size),
            FormulaNode::Fraction(over, under) if self.is_high => self.fraction(over, under, size),
            FormulaNode::Fraction(over, under) => self.flat_fraction(over, under, size),
            FormulaNode::Script { base, below, above } => {
                self.script(base, below.as_deref(), above.as_deref(), size)
            }
            FormulaNode::Fence { open, inner, close } => self.fence(*open, inner, *close, size),
            FormulaNode::Braced { base, note } => self.braced(base, note, size),
        }
    }

    fn row(&self, nodes: &[FormulaNode], size: f32) -> FormulaBox {
        let mut row = FormulaBox::default();
        for (place, node) in nodes.iter().enumerate() {
            row.append(self.set(node, size));
            let is_function = match node {
                FormulaNode::Function(_) => true,
                FormulaNode::Script { base, .. } => matches!(**base, FormulaNode::Function(_)),
                _ => false,
            };
            let is_closed = match nodes.get(place + 1) {
                Some(FormulaNode::Sign(sign)) => sign.starts_with(['(', '/', ')']),
                None | Some(FormulaNode::Fence { .. } | FormulaNode::Operator(_) | FormulaNode::Space(_)) => {
                    true
                }
                Some(_) => false,
            };
            if is_function && !is_closed {
                row.width += 0.17 * size;
            }
        }
        row
    }

    fn text(&self, text: &str, size: f32, italics: bool) -> FormulaBox {
        let font_id = FontId::proportional(size);
        let format = TextFormat { font_id, color: self.color, italics, ..TextFormat::default() };
        let galley = self.ui.painter().layout_job(LayoutJob::single_section(text.to_owned(), format));
        let glyph =
            galley.rows.first().and_then(|row| row.glyphs.first().map(|glyph| row.pos.y + glyph.pos.y));
        let baseline = glyph.unwrap_or(galley.size().y - TAIL * size);
        let has_tail =
            text.contains(['(', ')', '[', ']', '|', 'g', 'j', 'p', 'q', 'y', 'η', 'φ', 'μ', 'ρ', ',', '/']);
        FormulaBox {
            width: galley.size().x,
            ascent: CAPITAL * size,
            descent: if has_tail { TAIL * size } else { 0.0 },
            pieces: vec![FormulaShape::Text { galley, corner: vec2(0.0, -baseline) }],
        }
    }

    fn operator(&self, sign: char, size: f32) -> FormulaBox {
        let (before, after) = match sign {
            ',' => (0.0, 0.2),
            '·' => (0.12, 0.12),
            _ => (0.24, 0.24),
        };
        let mut operator = FormulaBox { width: before * size, ..FormulaBox::default() };
        operator.append(self.text(&sign.to_string(), size, false));
        operator.width += after * size;
        operator
    }

    fn hat(&self, base: &FormulaNode, size: f32) -> FormulaBox {
        let mut hat = self.set(base, size);
        let is_small = matches!(base, FormulaNode::Letter(letter) if letter.is_lowercase() && !"bdfhklt".contains(*letter));
        let foot = if is_small { 0.56 * size } else { hat.ascent + 0.04 * size };
        let wide = (0.5 * size).min(hat.width);
        // A leaning letter has its top a little to the right.
        let left = 0.5 * (hat.width - wide) + 0.05 * size;
        let top = foot + 0.16 * size;
        hat.stroke([vec2(left, -foot), vec2(left + 0.5 * wide, -top), vec2(left + wide, -foot)]);
        hat.ascent = hat.ascent.max(top + 1.0);
        hat
    }

    fn root(&self, inner: &FormulaNode, size: f32) -> FormulaBox {
        let inner = self.set(inner, size);
        let (top, foot, hook) = (inner.ascent + 0.14 * size, inner.descent, 0.5 * size);
        let width = inner.width;
        let mut root = FormulaBox::default();
        root.put(inner, vec2(hook, 0.0));
        root.width += 0.08 * size;
        root.ascent = top + 1.0;
        root.stroke([
            vec2(0.04 * size, -0.36 * size),
            vec2(0.16 * size, -0.42 * size),
            vec2(0.3 * size, foot),
            vec2(hook - 0.06 * size, -top),
            vec2(hook + width + 0.04 * size, -top),
        ]);
        root
    }

    fn fraction(&self, over: &FormulaNode, under: &FormulaNode, size: f32) -> FormulaBox {
        let nested = Self { ui: self.ui, color: self.color, is_high: true };
        let is_plain = |node: &FormulaNode| matches!(node, FormulaNode::Sign(_));
        // Figures such as one half are small.
        let part = if is_plain(over) && is_plain(under) { SCRIPT } else { NESTED } * size;
        let (over, under) = (nested.set(over, part), nested.set(under, part));
        let (axis, gap, rim) = (AXIS * size, 0.18 * size, 0.1 * size);
        let width = over.width.max(under.width) + 2.0 * rim;
        let mut fraction = FormulaBox { width, ..FormulaBox::default() };
        let middle = |part: &FormulaBox| 0.5 * (width - part.width);
        let (x, y) = (middle(&over), -(axis + gap + over.descent));
        fraction.put(over, vec2(x, y));
        let (x, y) = (middle(&under), -axis + gap + under.ascent);
        fraction.put(under, vec2(x, y));
        fraction.stroke([vec2(0.0, -axis), vec2(width, -axis)]);
        fraction.width = width + rim;
        fraction
    }

    /// A fraction in one line; its parts are in brackets where they would be read otherwise.
    fn flat_fraction(&self, over: &FormulaNode, under: &FormulaNode, size: f32) -> FormulaBox {
        let mut flat = FormulaBox::default();
        for (node, sign) in [(over, "/"), (under, "")] {
            let inner = self.set(node, size);
            if node.is_composite() {
                flat.append(self.text("(", size, false));
                flat.append(inner);
                flat.append(self.text(")", size, false));
            } else {
                flat.append(inner);
            }
            flat.append(self.text(sign, size, false));
        }
        flat
    }

    fn script(
        &self,
        base: &FormulaNode,
        below: Option<&FormulaNode>,
        above: Option<&FormulaNode>,
        size: f32,
    ) -> FormulaBox {
        let mut whole = self.set(base, size);
        let small = SCRIPT * size;
        let start = whole.width + 0.02 * size;
        let (rise, fall) = (
            (0.36 * size).max(whole.ascent - 0.38 * size),
            (0.2 * size).max(if matches!(base, FormulaNode::Fence { .. } | FormulaNode::Braced { .. }) {
                whole.descent
            } else {
                0.0
            }),
        );
        if let Some(above) = above {
            // A prime is high by itself.
            let lift = if *above == FormulaNode::Sign("′".to_owned()) { 0.14 * size } else { rise };
            whole.put(self.set(above, small), vec2(start, -lift));
        }
        if let Some(below) = below {
            whole.put(self.set(below, small), vec2(start, fall));
        }
        whole.width += 0.05 * size;
        whole
    }

    fn fence(&self, open: char, inner: &FormulaNode, close: char, size: f32) -> FormulaBox {
        let inner = self.set(inner, size);
        let axis = AXIS * size;
        let reach = (inner.ascent - axis).max(inner.descent + axis);
        let high = size.max(2.0 * reach);
        let bracket = |sign: char| {
            let text = self.text(&sign.to_string(), high, false);
            // Its own middle comes to the axis.
            let drop = (0.5 * (CAPITAL - TAIL)) * high - axis;
            let mut bracket = FormulaBox::default();
            bracket.put(text, vec2(0.0, drop));
            bracket
        };
        let mut fence = bracket(open);
        fence.append(inner);
        fence.append(bracket(close));
        fence
    }

    fn braced(&self, base: &FormulaNode, note: &FormulaNode, size: f32) -> FormulaBox {
        let base = self.set(base, size);
        let note = self.set(note, SCRIPT * size);
        let width = base.width.max(note.width);
        let mut braced = FormulaBox { width, ..FormulaBox::default() };
        let left = 0.5 * (width - base.width);
        let (right, top) = (left + base.width, base.descent + 0.16 * size);
        let (foot, middle) = (top + 0.18 * size, 0.5 * width);
        braced.put(base, vec2(left, 0.0));
        braced.stroke([vec2(left, top), vec2(left, foot), vec2(right, foot), vec2(right, top)]);
        braced.stroke([vec2(middle, foot), vec2(middle, foot + 0.16 * size)]);
        let (x, y) = (0.5 * (width - note.width), foot + 0.26 * size + note.ascent);
        braced.put(note, vec2(x, y));
        braced.width = width;
        braced
    }
}
