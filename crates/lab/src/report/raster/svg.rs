//! Drawing by `resvg`.

use std::sync::{Arc, LazyLock};

use catoptric_picture::{Picture, SizeError, srgb};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

use super::RasterError;

/// The font of the plots, which also has Cyrillic letters: pictures do not depend on what is installed.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    Arc::new(fonts)
});

/// Draws an SVG, `scale` pixels for each unit of its size, on white.
///
/// # Errors
/// When it is no SVG, or the picture would be too large.
pub fn rasterize(svg: &str, scale: f32) -> Result<Picture, RasterError> {
    let mut options = Options { fontdb: Arc::clone(&FONTS), ..Options::default() };
    options.font_family = "Ubuntu".to_owned();
    // The font has no raised minus, but a macron that looks like one.
    let tree = Tree::from_str(&svg.replace('⁻', "¯"), &options)?;
    let sides = [tree.size().width(), tree.size().height()].map(|side| (side * scale).ceil() as u32);
    let [width, height] = sides;
    Picture::check_size(width, height)?;
    let mut pixels = Pixmap::new(width, height).ok_or(SizeError::Empty { width, height })?;
    pixels.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    let light = pixels.pixels().iter().map(|pixel| {
        [pixel.red(), pixel.green(), pixel.blue()].map(|code| srgb::decode(f64::from(code) / 255.0) as f32)
    });
    Ok(Picture::from_pixels(width, height, light.collect())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_both_alphabets_are_drawn() {
        let dark = |text: &str| {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"30\"><text x=\"5\" y=\"20\" \
                 font-size=\"16\">{text}</text></svg>"
            );
            let picture = rasterize(&svg, 2.0).unwrap();
            assert_eq!((picture.width(), picture.height()), (120, 60));
            picture.pixels().iter().filter(|pixel| pixel[0] < 0.5).count()
        };
        assert_eq!(dark(""), 0);
        for text in ["K", "Ж", "10⁵", "⁻", "α", "−", "×"] {
            assert!(dark(text) > 5, "{text}");
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert!(matches!(rasterize("plain text", 1.0), Err(RasterError::Svg(_))));
        let huge = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"99999\" height=\"99999\"/>";
        assert!(matches!(rasterize(huge, 100.0), Err(RasterError::Size(_))));
    }
}
