//! What of a window has to be drawn anew.
//!
//! egui draws the whole window in every frame, by a shader that mixes every triangle with a texture and what is behind.
//! A graphics card does not mind; a software driver needs most of a frame's time for that. Here the same triangles are
//! sorted by what they need, and only those where the window has changed are given to a renderer, which keeps its canvas
//! from frame to frame.

mod damage;
mod triangles;

use std::collections::HashSet;

use egui::epaint::{ClippedPrimitive, ImageData};
use egui::{Color32, TextureId, TexturesDelta};

use damage::{DrawBatch, damage, pieces};
pub use triangles::{CanvasArea, CanvasVertex, FillKind, FrameTriangles, TriangleRun};

/// Knows what is on a canvas, and tells what has to be drawn anew.
#[derive(Default)]
pub struct Repaint {
    area: Option<CanvasArea>,
    drawn: Vec<DrawBatch>,
    /// The textures that nothing is seen through.
    opaque: HashSet<TextureId>,
    /// The textures that look otherwise where they were used before.
    renewed: HashSet<TextureId>,
}

impl Repaint {
    /// Takes note of how textures change, before the frame that is drawn with them.
    pub fn note_textures(&mut self, textures: &TexturesDelta) {
        self.opaque.retain(|id| !textures.free.contains(id));
        for (id, deltas) in &textures.set {
            for delta in deltas {
                let ImageData::Color(image) = &delta.image;
                let is_part = delta.pos.is_some();
                // A part that is opaque does not tell of the whole.
                if !is_part && image.pixels.iter().all(Color32::is_opaque) {
                    self.opaque.insert(*id);
                } else {
                    self.opaque.remove(id);
                }
                // Glyphs are only added to the texture of the fonts, where there was nothing.
                if !is_part || *id != TextureId::default() {
                    self.renewed.insert(*id);
                }
            }
        }
    }

    /// Forgets what is on the canvas, which something else draws on.
    pub fn forget(&mut self) {
        self.area = None;
        self.drawn.clear();
    }

    /// What has to be drawn for this frame; all of it, if the canvas is another one. Callbacks are left out.
    pub fn frame(&mut self, primitives: Vec<ClippedPrimitive>, area: CanvasArea) -> FrameTriangles {
        let new = pieces(primitives);
        let damage = if self.area == Some(area) {
            damage(&self.drawn, &new, &self.renewed)
        } else {
            vec![area.screen]
        };
        let triangles = FrameTriangles::new(&new, &damage, area, &self.opaque);
        self.renewed.clear();
        (self.area, self.drawn) = (Some(area), new);
        triangles
    }
}
