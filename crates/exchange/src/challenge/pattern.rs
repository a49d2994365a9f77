//! Patterns: where a checkerboard of the book is one of a scene.

use catoptric_scene::{Checker, CheckerSpace, Color, Pattern, Placement};
use glam::{DAffine3, DVec3};

use crate::challenge::read::ChallengeReader;
use crate::challenge::table::{self, Table};
use crate::challenge::yaml::Node;
use crate::message::Message;

/// A number this near to a whole one is meant to be one.
const WHOLE: f64 = 1e-6;

/// Where the surface of a body is, for its pattern.
pub(super) struct Surface<'p> {
    /// The frame of the pattern's body, of the book's axes, from our world.
    pub(super) object_from_world: DAffine3,
    /// Where the body stands.
    pub(super) placement: &'p Placement,
    /// Whether the surface is y = 0 of the body's frame.
    pub(super) is_plane: bool,
}

impl ChallengeReader {
    /// The pattern of a material.
    pub(super) fn pattern(&mut self, node: &Node, surface: &Surface<'_>) -> Option<Pattern> {
        let mut pattern = Table::open(node, "pattern", &mut self.draft)?;
        let kind = pattern.require(&["type"], &mut self.draft)?;
        let name = table::name(&kind, "type", &mut self.draft)?.to_owned();
        let colors = pattern.take(&["colors"]);
        let transform = match pattern.take(&["transform"]) {
            Some(transform) => self.transform(&transform)?,
            None => DAffine3::IDENTITY,
        };
        let mut colors: Vec<Color> = match colors {
            Some(colors) => self.colors(&colors)?,
            None => Vec::new(),
        };
        if matches!(name.as_str(), "checkers" | "checker") && colors.len() == 2 {
            pattern.end(&mut self.draft);
            let pattern_from_world = transform.inverse() * surface.object_from_world;
            if let Some((space, is_swapped, size)) = cells(pattern_from_world, surface) {
                if is_swapped {
                    colors.reverse();
                }
                let checker = Checker { color: colors[1], size, space };
                return Some(Pattern { checker: Some(checker), ..Pattern::from(colors[0]) });
            }
            self.draft.unsupported(&node.span, Message::PatternTurned, Message::MeanColor);
        } else {
            self.draft.unsupported(&kind.span, Message::NoPattern { kind: name }, Message::MeanColor);
        }
        Some(mean(&colors).into())
    }

    fn colors(&mut self, node: &Node) -> Option<Vec<Color>> {
        let list = table::list(node, "colors", &mut self.draft)?;
        let mut colors = Vec::new();
        for color in list.iter().take(16) {
            let color = self.resolved(color);
            // A pattern in the place of a color.
            if color.list().is_some() || color.number().is_some() {
                colors.push(table::color(&color, "colors", &mut self.draft)?);
            }
        }
        Some(colors)
    }
}

fn mean(colors: &[Color]) -> Color {
    if colors.is_empty() {
        return Color::gray(0.5);
    }
    let sum: DVec3 = colors.iter().map(|color| DVec3::from_array(color.to_array())).sum();
    (sum / colors.len() as f64).to_array().into()
}

/// The space whose cells are those of the pattern, whether their colors are swapped, and their size; `None` if there is
/// none.
fn cells(pattern_from_world: DAffine3, surface: &Surface<'_>) -> Option<(CheckerSpace, bool, f64)> {
    let rotation = surface.placement.rotation();
    let body = DAffine3 { matrix3: rotation, translation: surface.placement.origin() };
    [(CheckerSpace::World, DAffine3::IDENTITY), (CheckerSpace::Body, body)].into_iter().find_map(
        |(space, world_from_space)| {
            let is_plane = surface.is_plane && space == CheckerSpace::Body;
            let (is_swapped, size) = same_cells(pattern_from_world * world_from_space, is_plane)?;
            Some((space, is_swapped, size))
        },
    )
}

/// Whether unit cells of a pattern are cubes along the axes of a space, with their parity, and the edge of these cubes.
/// On a plane, only the axes within it matter.
fn same_cells(pattern_from_space: DAffine3, is_plane: bool) -> Option<(bool, f64)> {
    let columns = pattern_from_space.matrix3.to_cols_array_2d().map(DVec3::from_array);
    let axes: &[usize] = if is_plane { &[0, 2] } else { &[0, 1, 2] };
    let scale = columns[0].length();
    let mut used = [false; 3];
    let mut parity = 0.0;
    for &axis in axes {
        let column = columns[axis];
        let along = (0..3).find(|&row| (column[row].abs() - scale).abs() <= WHOLE * scale)?;
        if column.length() > (1.0 + WHOLE) * scale || std::mem::replace(&mut used[along], true) {
            return None;
        }
        // ⌊−x⌋ is −⌊x⌋ − 1.
        if column[along] < 0.0 {
            parity += 1.0;
        }
    }
    for (row, offset) in pattern_from_space.translation.to_array().into_iter().enumerate() {
        let is_across = is_plane && !used[row];
        let cells = if is_across { (offset + WHOLE).floor() } else { offset.round() };
        if !is_across && (offset - cells).abs() > WHOLE {
            return None;
        }
        parity += cells;
    }
    let is_swapped = parity.rem_euclid(2.0) == 1.0;
    (scale.is_finite() && scale > 0.0).then(|| (is_swapped, 1.0 / scale))
}
