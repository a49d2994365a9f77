//! No two commands look alike, in whatever font of icons.

use egui::{Color32, Context, FontId, RawInput};
use egui_material_icons::MaterialIcon;

use super::table::ROWS;
use crate::base::theme;
use crate::state::methods;
use catoptric_tracer::raster::MethodKind;

/// Commands that may share an icon: one act in several panels, or choices of one thing.
const FAMILIES: [&[&str]; 5] = [
    &["edit.copy", "audit.copy", "measure.copy"],
    &["file.save", "audit.save", "compare.save", "measure.save"],
    &["view.look."],
    &["view.show."],
    &["window.language."],
];

/// The side of the picture of an icon, pixels, and its size in it.
const SIDE: usize = 40;
const SIZE: f32 = 28.0;

/// Above this, the ink of two icons lies in the same places as far as an eye can tell: a circle and an unchecked radio
/// button. A closed lock and an open one reach 0.981.
const MOST_ALIKE: f32 = 0.985;

fn is_family(one: &str, other: &str) -> bool {
    FAMILIES.iter().any(|family| {
        [one, other].into_iter().all(|name| family.iter().any(|member| name.starts_with(member)))
    })
}

/// How much ink an icon has in each pixel.
fn ink(context: &Context, icon: MaterialIcon) -> Vec<f32> {
    context.fonts_mut(|fonts| {
        let font = FontId::new(SIZE, icon.font_family());
        let galley = fonts.layout_no_wrap(icon.codepoint.to_owned(), font, Color32::WHITE);
        let image = fonts.image();
        let mut picture = vec![0.0; SIDE * SIDE];
        let glyph = galley.rows[0].glyphs[0];
        let uv = glyph.uv_rect;
        assert!(!uv.is_nothing(), "no glyph of {:?}", icon.codepoint);
        let [width, height] = [uv.max[0] - uv.min[0], uv.max[1] - uv.min[1]].map(usize::from);
        // As it stands in its cell: a small circle is no large one.
        let [left, top] = [SIDE.saturating_sub(width) / 2, SIDE.saturating_sub(height) / 2];
        for y in 0..height.min(SIDE) {
            for x in 0..width.min(SIDE) {
                let pixel = image[(usize::from(uv.min[0]) + x, usize::from(uv.min[1]) + y)];
                picture[(top + y) * SIDE + left + x] = f32::from(pixel.a()) / 255.0;
            }
        }
        picture
    })
}

/// From 0, no ink in common, to 1.
fn likeness(one: &[f32], other: &[f32]) -> f32 {
    let apart: f32 = one.iter().zip(other).map(|(a, b)| (a - b).abs()).sum();
    1.0 - apart / (one.iter().sum::<f32>() + other.iter().sum::<f32>())
}

#[test]
fn no_two_commands_look_alike() {
    let context = Context::default();
    theme::install(&context);
    context.run_ui(RawInput::default(), |_| {}).drop_without_applying_deltas();
    let icons: Vec<(&str, Vec<f32>)> =
        ROWS.iter().map(|row| (row.look.name, ink(&context, row.look.icon))).collect();
    let mut alike = Vec::new();
    for (place, (name, own)) in icons.iter().enumerate() {
        for (other_name, other) in icons.iter().take(place) {
            let likeness = likeness(own, other);
            if likeness > MOST_ALIKE && !is_family(name, other_name) {
                alike.push(format!("{other_name} and {name}: {likeness:.3}"));
            }
        }
    }
    assert!(alike.is_empty(), "{}", alike.join("\n"));
    // The measure tells what it is to tell.
    let [circle, radio] =
        [egui_material_icons::icons::ICON_CIRCLE, egui_material_icons::icons::ICON_RADIO_BUTTON_UNCHECKED];
    assert!(likeness(&ink(&context, circle), &ink(&context, radio)) > MOST_ALIKE);
}

#[test]
fn a_method_has_the_icon_of_its_command() {
    for kind in MethodKind::ALL {
        let command = super::Command::from(super::DisplayCommand::Method(kind));
        assert_eq!(command.look().unwrap().icon.codepoint, methods::icon(kind).codepoint, "{kind:?}");
    }
}
