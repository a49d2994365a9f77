//! Patterns of the book as those of a scene.

use catoptric_scene::{Color, Pattern, PatternSpace, Placement, SolidKind, SolidTexture, rotation_degrees};
use glam::{DAffine3, DMat3, DQuat, DVec3};

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

/// A color, or a pattern that begins with it.
type Layer = (Color, Option<SolidTexture>);

impl ChallengeReader {
    /// The pattern of a material.
    pub(super) fn pattern(&mut self, node: &Node, surface: &Surface<'_>) -> Option<Pattern> {
        let (color, solid) = self.layer(node, surface.object_from_world, surface, 1)?;
        Some(Pattern { solid, ..Pattern::from(color) })
    }

    /// A pattern within `depth` - 1 others, the next of which has the space `outer_from_world`.
    fn layer(
        &mut self,
        node: &Node,
        outer_from_world: DAffine3,
        surface: &Surface<'_>,
        depth: usize,
    ) -> Option<Layer> {
        let mut pattern = Table::open(node, "pattern", &mut self.draft)?;
        let kind = pattern.require(&["type"], &mut self.draft)?;
        let name = table::name(&kind, "type", &mut self.draft)?.to_owned();
        let colors = pattern.take(&["colors"]);
        let transform = match pattern.take(&["transform"]) {
            Some(transform) => self.transform(&transform)?,
            None => DAffine3::IDENTITY,
        };
        let pattern_from_world = transform.inverse() * outer_from_world;
        let layers: Vec<Layer> = match colors {
            Some(colors) => self.layers(&colors, pattern_from_world, surface, depth)?,
            None => Vec::new(),
        };
        let mean = mean(&layers);
        if depth > SolidTexture::MAX_DEPTH {
            let most = SolidTexture::MAX_DEPTH.to_string();
            self.draft.unsupported(&node.span, Message::PatternsTooDeep { most }, Message::MeanColor);
            return Some((mean, None));
        }
        let ([first, second], Some(kind)) = (layers.as_slice(), kind_of(&name)) else {
            let message = match kind_of(&name) {
                Some(_) => Message::PatternColors { kind: name, count: layers.len().to_string() },
                None => Message::NoPattern { kind: name },
            };
            self.draft.unsupported(&kind.span, message, Message::MeanColor);
            return Some((mean, None));
        };
        pattern.end(&mut self.draft);
        let Some((mut solid, is_swapped)) = placed(kind, pattern_from_world, surface) else {
            self.draft.unsupported(&node.span, Message::PatternSheared, Message::MeanColor);
            return Some((mean, None));
        };
        let (first, second) = if is_swapped { (second, first) } else { (first, second) };
        let boxed = |layer: &Layer| layer.1.clone().map(Box::new);
        (solid.first, solid.second, solid.color) = (boxed(first), boxed(second), second.0);
        Some((first.0, Some(solid)))
    }

    /// The colors of a pattern, in the place of each of which another may stand.
    fn layers(
        &mut self,
        node: &Node,
        pattern_from_world: DAffine3,
        surface: &Surface<'_>,
        depth: usize,
    ) -> Option<Vec<Layer>> {
        let list = table::list(node, "colors", &mut self.draft)?;
        let mut layers = Vec::new();
        for color in list.iter().take(16) {
            let color = self.resolved(color);
            if color.list().is_some() || color.number().is_some() {
                layers.push((table::color(&color, "colors", &mut self.draft)?, None));
            } else if depth <= SolidTexture::MAX_DEPTH {
                layers.push(self.layer(&color, pattern_from_world, surface, depth + 1)?);
            }
        }
        Some(layers)
    }
}

fn kind_of(name: &str) -> Option<SolidKind> {
    Some(match name {
        "checkers" | "checker" | "checkered" | "checkerboard" => SolidKind::Checker,
        "stripes" | "stripe" | "striped" => SolidKind::Stripes,
        "rings" | "ring" => SolidKind::Rings,
        "gradient" | "gradients" => SolidKind::Gradient,
        _ => return None,
    })
}

fn mean(layers: &[Layer]) -> Color {
    if layers.is_empty() {
        return Color::gray(0.5);
    }
    let of = |(first, solid): &Layer| {
        let first = DVec3::from_array(first.to_array());
        solid.as_ref().map_or(first, |solid| 0.5 * (first + DVec3::from_array(solid.color.to_array())))
    };
    let sum: DVec3 = layers.iter().map(of).sum();
    (sum / layers.len() as f64).to_array().into()
}

/// The pattern of a space whose unit cells are those of `pattern_from_world`, and whether its colors are swapped; `None`
/// if there is none.
fn placed(
    kind: SolidKind,
    pattern_from_world: DAffine3,
    surface: &Surface<'_>,
) -> Option<(SolidTexture, bool)> {
    if !pattern_from_world.is_finite() {
        return None;
    }
    let rotation = surface.placement.rotation();
    let body = DAffine3 { matrix3: rotation, translation: surface.placement.origin() };
    let spaces = [(PatternSpace::World, DAffine3::IDENTITY), (PatternSpace::Body, body)];
    if kind == SolidKind::Checker {
        let found = spaces.into_iter().find_map(|(space, world_from_space)| {
            let is_plane = surface.is_plane && space == PatternSpace::Body;
            let (is_swapped, size) = same_cells(pattern_from_world * world_from_space, is_plane)?;
            Some((SolidTexture { space, size, ..SolidTexture::default() }, is_swapped))
        });
        if found.is_some() {
            return found;
        }
    }
    // As in the book, it goes with the body where that can be said.
    spaces.into_iter().rev().find_map(|(space, world_from_space)| {
        let (solid, is_swapped) = turned(kind, pattern_from_world * world_from_space)?;
        Some((SolidTexture { space, ..solid }, is_swapped))
    })
}

/// The pattern that stands in a space as the map of its points to cells says, and whether its colors are swapped; `None`
/// where the axes that it counts along are not at right angles.
fn turned(kind: SolidKind, cells_from_space: DAffine3) -> Option<(SolidTexture, bool)> {
    let rows = cells_from_space.matrix3.transpose().to_cols_array_2d().map(DVec3::from_array);
    let used: &[usize] = match kind {
        SolidKind::Checker => &[0, 1, 2],
        SolidKind::Rings => &[0, 2],
        SolidKind::Stripes | SolidKind::Gradient => &[0],
    };
    let is_across = |one: usize, other: usize| {
        rows[one].dot(rows[other]).abs() <= WHOLE * rows[one].length() * rows[other].length()
    };
    if used.iter().any(|&one| used.iter().any(|&other| one != other && !is_across(one, other))) {
        return None;
    }
    let [x, y, z] = [0, 1, 2].map(|axis| rows[axis].normalize_or_zero());
    let (turn, is_swapped) = match kind {
        SolidKind::Checker => {
            // Cells whose numbers run the other way are of the other color.
            let is_swapped = x.cross(y).dot(z) < 0.0;
            (DQuat::from_mat3(&DMat3::from_cols(x, y, if is_swapped { -z } else { z })), is_swapped)
        }
        SolidKind::Rings if (rows[0].length() - rows[2].length()).abs() <= WHOLE * rows[0].length() => {
            (DQuat::from_rotation_arc(DVec3::Y, z.cross(x)), false)
        }
        SolidKind::Rings => (DQuat::from_mat3(&DMat3::from_cols(x, z.cross(x), z)), false),
        SolidKind::Stripes | SolidKind::Gradient => (DQuat::from_rotation_arc(DVec3::X, x), false),
    };
    let sizes = DVec3::from_array(std::array::from_fn(|axis| {
        if used.contains(&axis) { rows[axis].length().recip() } else { rows[0].length().recip() }
    }));
    let offset = |&axis: &usize| {
        let along = rows[axis] / rows[axis].length_squared();
        -cells_from_space.translation[axis] * along
    };
    let scale = sizes / sizes.x;
    let solid = SolidTexture {
        kind,
        size: tidy(sizes.x, sizes.x),
        scale: if (scale - DVec3::ONE).abs().max_element() < WHOLE { DVec3::ONE } else { scale },
        position: used.iter().map(offset).sum::<DVec3>().map(|along| tidy(along, sizes.x)),
        rotation_degrees: rotation_degrees(turn.normalize()),
        ..SolidTexture::default()
    };
    let is_length = |length: f64| (1e-9..=1e9).contains(&length);
    let fits = solid.scale.to_array().into_iter().chain([solid.size]).all(is_length)
        && solid.position.is_finite()
        && solid.position.abs().max_element() <= 1e9;
    fits.then_some((solid, is_swapped))
}

/// A length without what is only rounding, in cells of this size.
fn tidy(length: f64, size: f64) -> f64 {
    // Twelve digits of the size.
    let step = 10_f64.powf(size.log10().floor() - 11.0);
    let tidy = (length / step).round() * step;
    // The step itself is rounded.
    let text = format!("{tidy:.11e}");
    text.parse().unwrap_or(length)
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
    (scale.is_finite() && scale > 0.0).then(|| (is_swapped, tidy(1.0 / scale, 1.0 / scale)))
}
