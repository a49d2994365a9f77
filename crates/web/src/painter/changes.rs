//! Draws what has changed in the window, by shaders that compute no more than is wanted.

use std::collections::HashMap;

use catoptric_studio::repaint::{CanvasArea, CanvasVertex, FillKind, Repaint};
use egui::epaint::ImageDelta;
use egui::{
    ClippedPrimitive, ImageData, Pos2, Rect, TextureFilter, TextureId, TextureWrapMode, TexturesDelta, Vec2,
};
use web_sys::{WebGl2RenderingContext as Gl, WebGlProgram, WebGlTexture};

/// The corners' places in shaders, by their numbers.
const ATTRIBUTES: [&str; 3] = ["position", "uv", "color"];

const CORNER: &str = "#version 300 es
in vec2 position;
in vec2 uv;
in vec4 color;
out vec2 at;
out vec4 tint;
void main() {
    gl_Position = vec4(position, 0.0, 1.0);
    at = uv;
    tint = color;
}";

const PLAIN: &str = "#version 300 es
precision mediump float;
in vec4 tint;
out vec4 shown;
void main() {
    shown = tint;
}";

const TEXTURED: &str = "#version 300 es
precision highp float;
uniform sampler2D image;
in vec2 at;
in vec4 tint;
out vec4 shown;
void main() {
    shown = tint * texture(image, at);
}";

/// Draws into a canvas that keeps what was drawn.
pub(super) struct ChangesPainter {
    gl: Gl,
    plain: WebGlProgram,
    textured: WebGlProgram,
    textures: HashMap<TextureId, WebGlTexture>,
    repaint: Repaint,
}

impl ChangesPainter {
    /// # Errors
    /// When the driver refuses the shaders.
    pub(super) fn new(gl: Gl) -> Result<Self, String> {
        let [plain, textured] = [program(&gl, PLAIN)?, program(&gl, TEXTURED)?];
        gl.bind_buffer(Gl::ARRAY_BUFFER, gl.create_buffer().as_ref());
        let stride = size_of::<CanvasVertex>() as i32;
        for (index, (count, kind, offset)) in
            [(2, Gl::FLOAT, 0), (2, Gl::FLOAT, 8), (4, Gl::UNSIGNED_BYTE, 16)].into_iter().enumerate()
        {
            gl.enable_vertex_attrib_array(index as u32);
            let is_normalized = kind == Gl::UNSIGNED_BYTE;
            gl.vertex_attrib_pointer_with_i32(index as u32, count, kind, is_normalized, stride, offset);
        }
        gl.enable(Gl::SCISSOR_TEST);
        gl.blend_func(Gl::ONE, Gl::ONE_MINUS_SRC_ALPHA);
        Ok(Self { gl, plain, textured, textures: HashMap::new(), repaint: Repaint::default() })
    }

    pub(super) fn max_texture_side(&self) -> usize {
        let side = self.gl.get_parameter(Gl::MAX_TEXTURE_SIZE).ok().and_then(|side| side.as_f64());
        // What every WebGL 2 has.
        side.map_or(2048, |side| side as usize)
    }

    pub(super) fn paint(
        &mut self,
        primitives: Vec<ClippedPrimitive>,
        textures: &TexturesDelta,
        pixels_per_point: f32,
        size: [u32; 2],
    ) {
        self.repaint.note_textures(textures);
        for (id, deltas) in &textures.set {
            for delta in deltas {
                self.set_texture(*id, delta);
            }
        }
        let points = Vec2::from(size.map(|side| side as f32)) / pixels_per_point;
        let screen = Rect::from_min_size(Pos2::ZERO, points);
        self.draw(primitives, CanvasArea { size, screen, pixels_per_point });
        for texture in textures.free.iter().filter_map(|id| self.textures.remove(id)) {
            self.gl.delete_texture(Some(&texture));
        }
    }

    fn draw(&mut self, primitives: Vec<ClippedPrimitive>, area: CanvasArea) {
        let (gl, [width, height]) = (&self.gl, area.size.map(|side| side as i32));
        let frame = self.repaint.frame(primitives, area);
        gl.viewport(0, 0, width, height);
        gl.buffer_data_with_u8_array(Gl::ARRAY_BUFFER, frame.bytes(), Gl::STREAM_DRAW);
        let mut last = None;
        for run in &frame.runs {
            if run.kind.is_textured() {
                let Some(texture) = self.textures.get(&run.texture) else { continue };
                gl.bind_texture(Gl::TEXTURE_2D, Some(texture));
            }
            if last.replace(run.kind) != Some(run.kind) {
                self.choose(run.kind);
            }
            let [left, top, width, part_height] = run.scissor.map(|side| side as i32);
            gl.scissor(left, height - top - part_height, width, part_height);
            gl.draw_arrays(Gl::TRIANGLES, run.corners.start as i32, run.corners.len() as i32);
        }
    }

    /// Has triangles of this kind drawn.
    fn choose(&self, kind: FillKind) {
        self.gl.use_program(Some(if kind.is_textured() { &self.textured } else { &self.plain }));
        if kind.is_mixed() {
            self.gl.enable(Gl::BLEND);
        } else {
            self.gl.disable(Gl::BLEND);
        }
    }

    /// Gives a texture other pixels, or some of them.
    fn set_texture(&mut self, id: TextureId, delta: &ImageDelta) {
        let gl = &self.gl;
        let Some(texture) = self.textures.remove(&id).or_else(|| gl.create_texture()) else { return };
        gl.bind_texture(Gl::TEXTURE_2D, Some(&texture));
        self.textures.insert(id, texture);
        let filter = |filter| match filter {
            TextureFilter::Nearest => Gl::NEAREST,
            TextureFilter::Linear => Gl::LINEAR,
        };
        let wrap = match delta.options.wrap_mode {
            TextureWrapMode::ClampToEdge => Gl::CLAMP_TO_EDGE,
            TextureWrapMode::Repeat => Gl::REPEAT,
            TextureWrapMode::MirroredRepeat => Gl::MIRRORED_REPEAT,
        };
        for (name, value) in [
            (Gl::TEXTURE_MAG_FILTER, filter(delta.options.magnification)),
            (Gl::TEXTURE_MIN_FILTER, filter(delta.options.minification)),
            (Gl::TEXTURE_WRAP_S, wrap),
            (Gl::TEXTURE_WRAP_T, wrap),
        ] {
            gl.tex_parameteri(Gl::TEXTURE_2D, name, value as i32);
        }
        let ImageData::Color(image) = &delta.image;
        let [width, height] = image.size.map(|side| side as i32);
        let (pixels, format, kind) = (Some(image.as_raw()), Gl::RGBA, Gl::UNSIGNED_BYTE);
        // What fails here is seen by the studio as a lost context.
        let _ = match delta.pos.map(|pos| pos.map(|place| place as i32)) {
            Some([x, y]) => gl.tex_sub_image_2d_with_i32_and_i32_and_u32_and_type_and_opt_u8_array(
                Gl::TEXTURE_2D,
                0,
                x,
                y,
                width,
                height,
                format,
                kind,
                pixels,
            ),
            None => gl.tex_image_2d_with_i32_and_i32_and_i32_and_format_and_type_and_opt_u8_array(
                Gl::TEXTURE_2D,
                0,
                Gl::RGBA8 as i32,
                width,
                height,
                0,
                format,
                kind,
                pixels,
            ),
        };
    }
}

/// A program that colors triangles so.
fn program(gl: &Gl, coloring: &str) -> Result<WebGlProgram, String> {
    let program = gl.create_program().ok_or("WebGL 2")?;
    for (kind, source) in [(Gl::VERTEX_SHADER, CORNER), (Gl::FRAGMENT_SHADER, coloring)] {
        let shader = gl.create_shader(kind).ok_or("WebGL 2")?;
        gl.shader_source(&shader, source);
        gl.compile_shader(&shader);
        gl.attach_shader(&program, &shader);
    }
    for (index, name) in ATTRIBUTES.into_iter().enumerate() {
        gl.bind_attrib_location(&program, index as u32, name);
    }
    gl.link_program(&program);
    if gl.get_program_parameter(&program, Gl::LINK_STATUS).is_truthy() {
        Ok(program)
    } else {
        Err(format!("WebGL 2: {}", gl.get_program_info_log(&program).unwrap_or_default()))
    }
}
