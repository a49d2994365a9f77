//! Materials of the book as Phong's coefficients.

use catoptric_scene::{Color, FresnelTerm, Material, Pattern, Phong};

use crate::challenge::pattern::Surface;
use crate::challenge::read::ChallengeReader;
use crate::challenge::table::{self, Table};
use crate::challenge::yaml::Node;

/// The defaults of Buck 2019, chapters 6 and 11.
pub(super) fn default_material() -> Phong {
    Phong {
        pattern: Pattern::from(Color::WHITE),
        ambient: 0.1,
        diffuse: 0.9,
        specular: 0.9,
        shininess: 200.0,
        reflection: Some(0.0),
        transmission: 0.0,
        ior: 1.0,
        ..Phong::default()
    }
}

impl ChallengeReader {
    /// The material that a table describes, or the name of one.
    pub(super) fn material(&mut self, node: &Node, surface: &Surface<'_>) -> Option<Material> {
        let mut phong = default_material();
        let mut table = Table::open(node, "material", &mut self.draft)?;
        if let Some(color) = table.take(&["color"]) {
            let color = self.resolved(&color);
            if let Some(color) = table::color(&color, "color", &mut self.draft) {
                phong.pattern = color.into();
            }
        }
        if let Some(pattern) = table.take(&["pattern"]) {
            let pattern = self.resolved(&pattern);
            if let Some(pattern) = self.pattern(&pattern, surface) {
                phong.pattern = pattern;
            }
        }
        let draft = &mut self.draft;
        let any = [0.0, 1e6];
        let mut reflective = 0.0;
        for (keys, range, value) in [
            (&["ambient"] as &[&str], any, &mut phong.ambient),
            (&["diffuse"], any, &mut phong.diffuse),
            (&["specular"], any, &mut phong.specular),
            (&["shininess"], any, &mut phong.shininess),
            (&["reflective", "reflectivity"], any, &mut reflective),
            (&["transparency"], any, &mut phong.transmission),
            (&["refractive-index"], [0.01, 100.0], &mut phong.ior),
        ] {
            if let Some(found) = table.number(keys, range, draft) {
                *value = found;
            }
        }
        phong.reflection = Some(reflective);
        // The book weighs what is clear (chapter 11).
        if phong.transmission > 0.0 {
            phong.fresnel = FresnelTerm::Schlick;
        }
        table.end(draft);
        Some(Material::Phong(phong))
    }
}
