//! The changed parts of the window.

use std::collections::HashSet;

use egui::epaint::{ClippedPrimitive, Mesh, Primitive, Vertex};
use egui::{Rect, TextureId};

/// More parts than this are drawn as one.
const MOST: usize = 6;

pub(super) type Triangle = [Vertex; 3];

/// Triangles with one texture and one clip rectangle.
pub(super) struct DrawBatch {
    pub(super) clip: Rect,
    pub(super) texture: TextureId,
    pub(super) triangles: Vec<Triangle>,
}

pub(super) fn pieces(primitives: Vec<ClippedPrimitive>) -> Vec<DrawBatch> {
    let piece = |ClippedPrimitive { clip_rect, primitive }| match primitive {
        Primitive::Mesh(mesh) => {
            Some(DrawBatch { clip: clip_rect, texture: mesh.texture_id, triangles: triangles(&mesh) })
        }
        Primitive::Callback(_) => None,
    };
    primitives.into_iter().filter_map(piece).collect()
}

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let corner = |index: u32| mesh.vertices.get(index as usize).copied().unwrap_or_default();
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    triangles.iter().map(|triangle| triangle.map(corner)).collect()
}

/// The parts of the window where `new` looks otherwise than `old`, points. Textures `renewed` do so wherever they are.
pub(super) fn damage(old: &[DrawBatch], new: &[DrawBatch], renewed: &HashSet<TextureId>) -> Vec<Rect> {
    let mut damage = Vec::new();
    for at in 0..old.len().max(new.len()) {
        match (old.get(at), new.get(at)) {
            (Some(old), Some(new)) if is_alike(old, new) && !renewed.contains(&new.texture) => {
                add(&mut damage, differing(&old.triangles, &new.triangles).intersect(new.clip));
            }
            (old, new) => {
                for piece in [old, new].into_iter().flatten() {
                    add(&mut damage, bounds(&piece.triangles).intersect(piece.clip));
                }
            }
        }
    }
    damage
}

fn is_alike(old: &DrawBatch, new: &DrawBatch) -> bool {
    old.clip == new.clip && old.texture == new.texture
}

/// Adds a part; what overlaps becomes one.
fn add(damage: &mut Vec<Rect>, mut part: Rect) {
    if !part.is_positive() {
        return;
    }
    while let Some(at) = damage.iter().position(|other| other.intersects(part)) {
        part = part.union(damage.swap_remove(at));
    }
    damage.push(part);
    if damage.len() > MOST {
        let whole = damage.iter().fold(Rect::NOTHING, |whole, part| whole.union(*part));
        *damage = vec![whole];
    }
}

/// A box around the triangles that are not in both.
fn differing(old: &[Triangle], new: &[Triangle]) -> Rect {
    if old.len() == new.len() {
        let pairs = old.iter().zip(new).filter(|(old, new)| old != new);
        return pairs.fold(Rect::NOTHING, |all, (old, new)| all.union(around(old)).union(around(new)));
    }
    // What was put in or taken out moves what follows.
    let alike = |pairs: &mut dyn Iterator<Item = (&Triangle, &Triangle)>| {
        pairs.take_while(|(old, new)| old == new).count()
    };
    let before = alike(&mut old.iter().zip(new));
    let (old, new) = (old.get(before..).unwrap_or_default(), new.get(before..).unwrap_or_default());
    let after = alike(&mut old.iter().rev().zip(new.iter().rev()));
    let rest = |triangles: &[Triangle]| bounds(triangles.get(..triangles.len() - after).unwrap_or_default());
    rest(old).union(rest(new))
}

fn bounds(triangles: &[Triangle]) -> Rect {
    triangles.iter().fold(Rect::NOTHING, |all, triangle| all.union(around(triangle)))
}

/// A box around a triangle.
pub(super) fn around(triangle: &Triangle) -> Rect {
    Rect::from_points(&triangle.map(|corner| corner.pos))
}

#[cfg(test)]
mod tests {
    use egui::{Color32, Vec2, pos2, vec2};

    use super::*;

    fn square(at: f32, color: Color32) -> Mesh {
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(Rect::from_min_size(pos2(at, 10.0), Vec2::splat(5.0)), color);
        mesh
    }

    fn piece(squares: &[Mesh]) -> DrawBatch {
        let clip = Rect::from_min_size(pos2(0.0, 0.0), vec2(1000.0, 100.0));
        let triangles = squares.iter().flat_map(triangles).collect();
        DrawBatch { clip, texture: TextureId::default(), triangles }
    }

    fn damage_of(old: &[DrawBatch], new: &[DrawBatch]) -> Vec<[f32; 2]> {
        let mut parts: Vec<_> =
            damage(old, new, &HashSet::new()).iter().map(|part| [part.left(), part.right()]).collect();
        parts.sort_by(|one, other| one[0].total_cmp(&other[0]));
        parts
    }

    #[test]
    fn only_what_differs_is_drawn_again() {
        let [red, blue] = [Color32::RED, Color32::BLUE];
        let squares = |middle| [square(0.0, red), square(100.0, middle), square(200.0, red)];
        assert!(damage_of(&[piece(&squares(red))], &[piece(&squares(red))]).is_empty());
        assert_eq!(damage_of(&[piece(&squares(red))], &[piece(&squares(blue))]), [[100.0, 105.0]]);
    }

    #[test]
    fn what_is_put_in_does_not_damage_what_follows() {
        let red = Color32::RED;
        let two = [square(0.0, red), square(200.0, red)];
        let three = [square(0.0, red), square(100.0, red), square(200.0, red)];
        assert_eq!(damage_of(&[piece(&two)], &[piece(&three)]), [[100.0, 105.0]]);
        assert_eq!(damage_of(&[piece(&three)], &[piece(&two)]), [[100.0, 105.0]]);
        let more = [piece(&two), piece(&[square(300.0, red)])];
        assert_eq!(damage_of(&[piece(&two)], &more), [[300.0, 305.0]]);
        assert_eq!(damage_of(&more, &[piece(&two)]), [[300.0, 305.0]]);
    }

    #[test]
    fn a_renewed_texture_is_drawn_again_and_many_parts_become_few() {
        let red = Color32::RED;
        let old = [piece(&[square(0.0, red)])];
        let renewed = HashSet::from([TextureId::default()]);
        assert_eq!(damage(&old, &old, &renewed).len(), 1);
        let many = |color| -> Vec<DrawBatch> {
            (0..9).map(|at| piece(&[square(20.0 * at as f32, color)])).collect()
        };
        let parts = damage_of(&many(red), &many(Color32::BLUE));
        assert!(parts.len() <= MOST, "{parts:?}");
        for left in (0..9).map(|at| 20.0 * at as f32) {
            assert!(parts.iter().any(|part| part[0] <= left && part[1] >= left + 5.0), "{left}: {parts:?}");
        }
    }
}
