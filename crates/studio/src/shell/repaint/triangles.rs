//! The triangles of a frame, as renderers take them.

use std::collections::HashSet;
use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use egui::epaint::{Vertex, WHITE_UV};
use egui::{Color32, Pos2, Rect, TextureId, Vec2, vec2};

use super::damage::{DrawBatch, Triangle, around};

/// Triangles of at least this area, in square points, are worth a change of the shader.
const LARGE: f32 = 2000.0;

/// A canvas, and the part of egui's space that is drawn on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanvasArea {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// What is drawn, points.
    pub screen: Rect,
    /// Pixels in a point.
    pub pixels_per_point: f32,
}

/// A corner of a triangle: its place on the canvas from -1 to 1, in a texture from 0 to 1, and its color.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CanvasVertex {
    /// To the right and up.
    pub position: [f32; 2],
    /// To the right and down.
    pub uv: [f32; 2],
    /// Gamma-encoded, multiplied by its opacity.
    pub color: [u8; 4],
}

/// The way that a triangle is colored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FillKind {
    /// By its corners, hiding what is behind.
    Opaque,
    /// By its corners, over what is behind.
    Plain,
    /// By its corners and a texture, over what is behind.
    Textured,
    /// By its corners and a texture, hiding what is behind.
    Picture,
}

impl FillKind {
    /// Whether what is behind is seen through it.
    pub fn is_mixed(self) -> bool {
        matches!(self, Self::Plain | Self::Textured)
    }

    /// Whether a texture colors it.
    pub fn is_textured(self) -> bool {
        matches!(self, Self::Textured | Self::Picture)
    }

    /// Of a triangle with a texture, which is egui's own (of the fonts) or another.
    fn of(triangle: &Triangle, is_own: bool, is_opaque: bool) -> Self {
        let hides = triangle.iter().all(|corner| corner.color.is_opaque());
        if area(triangle) < LARGE {
            Self::Textured
        } else if is_own && triangle.iter().all(|corner| corner.uv == WHITE_UV) {
            // egui draws areas with the white corner of its own texture.
            if hides { Self::Opaque } else { Self::Plain }
        } else if is_opaque && hides {
            Self::Picture
        } else {
            Self::Textured
        }
    }
}

fn area([one, two, three]: &Triangle) -> f32 {
    let (along, aside) = (two.pos - one.pos, three.pos - one.pos);
    0.5 * (along.x * aside.y - along.y * aside.x).abs()
}

/// The triangles of a frame, in the order in which they are drawn.
#[derive(Debug, Default)]
pub struct FrameTriangles {
    /// The corners of all of them, three by three.
    pub corners: Vec<CanvasVertex>,
    /// The calls that draw them.
    pub runs: Vec<TriangleRun>,
}

/// Neighboring triangles of one kind, drawn by one call.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleRun {
    /// How they are colored.
    pub kind: FillKind,
    /// The texture, if one colors them.
    pub texture: TextureId,
    /// All that may be drawn on, pixels: left, top, width, height.
    pub scissor: [u32; 4],
    /// Their corners among those of the frame.
    pub corners: Range<u32>,
}

impl FrameTriangles {
    /// The triangles of `pieces` in the parts `damage`, points.
    pub(super) fn new(
        pieces: &[DrawBatch],
        damage: &[Rect],
        area: CanvasArea,
        opaque: &HashSet<TextureId>,
    ) -> Self {
        let mut frame = Self::default();
        for part in damage {
            // Rounding may have left out a pixel at the edge.
            let part = part.expand(1.0);
            frame.add(area, part, TextureId::default(), FillKind::Opaque, &blank(part));
            for piece in pieces {
                let is_own = piece.texture == TextureId::default();
                let is_opaque = opaque.contains(&piece.texture);
                let kind = |triangle: &Triangle| FillKind::of(triangle, is_own, is_opaque);
                for run in piece.triangles.chunk_by(|one, next| kind(one) == kind(next)) {
                    let Some(first) = run.first() else { continue };
                    frame.add(area, part.intersect(piece.clip), piece.texture, kind(first), run);
                }
            }
        }
        frame
    }

    /// Adds the triangles that reach into the part `clip`.
    fn add(&mut self, area: CanvasArea, clip: Rect, texture: TextureId, kind: FillKind, run: &[Triangle]) {
        let Some(scissor) = area.pixels(clip) else { return };
        let start = self.corners.len() as u32;
        let reaching = run.iter().filter(|triangle| around(triangle).intersects(clip));
        self.corners.extend(reaching.flatten().map(|vertex| area.corner(vertex)));
        let end = self.corners.len() as u32;
        match self.runs.last_mut() {
            _ if start == end => {}
            // What was left out in between has brought them together.
            Some(last) if (last.kind, last.scissor, last.texture) == (kind, scissor, texture) => {
                last.corners.end = end;
            }
            _ => self.runs.push(TriangleRun { kind, texture, scissor, corners: start..end }),
        }
    }

    /// The corners as the bytes of a vertex buffer.
    pub fn bytes(&self) -> &[u8] {
        bytemuck::cast_slice(&self.corners)
    }
}

/// Two triangles that hide what was there.
fn blank(part: Rect) -> [Triangle; 2] {
    let corner = |pos: Pos2| Vertex { pos, uv: WHITE_UV, color: Color32::BLACK };
    let [one, two, three, four] =
        [part.left_top(), part.right_top(), part.right_bottom(), part.left_bottom()].map(corner);
    [[one, two, three], [one, three, four]]
}

impl CanvasArea {
    fn corner(&self, vertex: &Vertex) -> CanvasVertex {
        let points = vec2(self.size[0] as f32, self.size[1] as f32) / self.pixels_per_point;
        let Vec2 { x, y } = (vertex.pos - self.screen.min) / points;
        CanvasVertex {
            position: [2.0 * x - 1.0, 1.0 - 2.0 * y],
            uv: vertex.uv.into(),
            color: vertex.color.to_array(),
        }
    }

    /// A part of the window in pixels: left, top, width, height. None if nothing of it is on the canvas.
    fn pixels(&self, part: Rect) -> Option<[u32; 4]> {
        let part = part.translate(-self.screen.min.to_vec2());
        let to = |place: f32, side: u32| ((place * self.pixels_per_point).round() as u32).min(side);
        let [left, right] = [part.left(), part.right()].map(|x| to(x, self.size[0]));
        let [top, bottom] = [part.top(), part.bottom()].map(|y| to(y, self.size[1]));
        (left < right && top < bottom).then(|| [left, top, right - left, bottom - top])
    }
}

#[cfg(test)]
mod tests {
    use egui::epaint::Mesh;
    use egui::{pos2, vec2};

    use super::*;

    const FULL: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(200.0, 100.0) };

    fn piece(texture: TextureId, rect: Rect, color: Color32) -> DrawBatch {
        let mut mesh = Mesh::with_texture(texture);
        let uv = if texture == TextureId::default() { Rect::from_min_max(WHITE_UV, WHITE_UV) } else { FULL };
        mesh.add_rect_with_uv(rect, uv, color);
        let corner = |index: &u32| mesh.vertices[*index as usize];
        let (triangles, _) = mesh.indices.as_chunks::<3>();
        let triangles = triangles.iter().map(|[a, b, c]| [a, b, c].map(corner)).collect();
        DrawBatch { clip: FULL, texture, triangles }
    }

    #[test]
    fn each_triangle_is_drawn_by_the_cheapest_way_that_shows_it() {
        let [picture, glass] = [1, 2].map(TextureId::User);
        let pieces = [
            piece(TextureId::default(), FULL, Color32::RED),
            piece(TextureId::default(), FULL, Color32::from_black_alpha(9)),
            piece(picture, FULL, Color32::WHITE),
            piece(picture, FULL, Color32::from_white_alpha(9)),
            piece(glass, FULL, Color32::WHITE),
            piece(TextureId::default(), Rect::from_min_size(FULL.min, vec2(9.0, 9.0)), Color32::RED),
        ];
        let area = CanvasArea { size: [400, 200], screen: FULL, pixels_per_point: 2.0 };
        let frame = FrameTriangles::new(&pieces, &[FULL], area, &HashSet::from([picture]));
        use FillKind::{Opaque, Picture, Plain, Textured};
        let kinds: Vec<_> = frame.runs.iter().map(|run| (run.kind, run.corners.len())).collect();
        // What hides the last frame, and the red that hides that, need one call.
        let wanted = [(Opaque, 12), (Plain, 6), (Picture, 6), (Textured, 6), (Textured, 6), (Textured, 6)];
        assert_eq!(kinds, wanted);
        assert_eq!(frame.runs[0].scissor, [0, 0, 400, 200]);
    }

    #[test]
    fn what_lies_outside_the_changed_part_is_left_out() {
        let left = Rect::from_min_max(FULL.min, pos2(100.0, 100.0));
        let right = Rect::from_min_max(pos2(100.0, 0.0), FULL.max);
        let pieces = [left, right].map(|rect| piece(TextureId::User(1), rect, Color32::from_white_alpha(9)));
        let area = CanvasArea { size: [200, 100], screen: FULL, pixels_per_point: 1.0 };
        let part = Rect::from_min_max(pos2(10.0, 20.0), pos2(30.0, 40.0));
        let frame = FrameTriangles::new(&pieces, &[part], area, &HashSet::new());
        let [blank, drawn] = &frame.runs[..] else { panic!("{:?}", frame.runs) };
        // A pixel more at each side, for rounding.
        assert_eq!([blank.scissor, drawn.scissor], [[9, 19, 22, 22]; 2]);
        assert_eq!(drawn.corners.len(), 6);
        assert_eq!(frame.corners[6].position, [-1.0, 1.0]);
    }
}
