//! New bodies, lights and materials.

use catoptric_scene::{Body, Color, Light, Material, MaterialChoice, NamedMaterial, Phong, Scene, ShapeKind};
use glam::DVec3;

use super::outcome::ActionOutcome;
use crate::edited_scene::EditedScene;
use crate::names::UsedNames;
use crate::new_body::NewBodyPlacement;
use crate::selection::Selection;

/// Colors of new bodies, sRGB: of equal weight, each distinguished from the others at a glance.
const PALETTE: [[u8; 3]; 8] = [
    [0xe4, 0x5b, 0x43],
    [0x2f, 0x9c, 0x95],
    [0xf0, 0xac, 0x3c],
    [0x46, 0x7f, 0xd6],
    [0x78, 0xae, 0x45],
    [0x93, 0x66, 0xcf],
    [0xdc, 0x77, 0xa8],
    [0x8a, 0x97, 0xa8],
];

pub(super) fn body(
    scene: &EditedScene,
    shape: ShapeKind,
    placement: &NewBodyPlacement,
    name: &str,
) -> ActionOutcome {
    let mut names = UsedNames::of(scene.scene().bodies.iter().map(|body| body.name.as_str()));
    let body = Body {
        name: names.take(if name.is_empty() { shape.key() } else { name }),
        material: MaterialChoice::Inline(Box::new(material(scene.scene(), shape))),
        ..placement.body(shape)
    };
    let subject = body.name.clone();
    let mut scene = scene.clone();
    scene.append([], [], [body]);
    let selection = scene.bodies().next_back().map_or_else(Selection::none, Selection::one);
    ActionOutcome { scene, selection, subject }
}

pub(super) fn light(scene: &EditedScene, at: DVec3, name: &str) -> ActionOutcome {
    let mut names = UsedNames::of(scene.scene().lights.iter().map(|light| light.name.as_str()));
    let name = names.take(if name.is_empty() { "light" } else { name });
    let subject = name.clone();
    let mut scene = scene.clone();
    scene.append([], [Light { name, position: at, ..Light::default() }], []);
    let selection = scene.lights().next_back().map_or_else(Selection::none, Selection::one);
    ActionOutcome { scene, selection, subject }
}

pub(super) fn named_material(scene: &EditedScene, name: &str) -> ActionOutcome {
    let mut names = UsedNames::of_materials(scene.scene());
    let name = names.take(if name.is_empty() { "material" } else { name });
    let subject = name.clone();
    let mut scene = scene.clone();
    scene.append([NamedMaterial { name, material: Material::default() }], [], []);
    let selection = scene.materials().next_back().map_or_else(Selection::none, Selection::one);
    ActionOutcome { scene, selection, subject }
}

/// Of the palette's colors, the one that the fewest bodies have or come near to; with some gloss, but for planes.
fn material(scene: &Scene, shape: ShapeKind) -> Material {
    let colors = PALETTE.map(Color::from_srgb8);
    let mut uses = [0usize; PALETTE.len()];
    for body in &scene.bodies {
        let Some(pattern) = scene.material(&body.material).and_then(Material::pattern) else { continue };
        let distance = |color: &Color| {
            let (a, b) = (DVec3::from_array(color.to_array()), DVec3::from_array(pattern.color.to_array()));
            a.distance_squared(b)
        };
        let near = colors.iter().zip(&mut uses).min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)));
        if let Some((_, uses)) = near {
            *uses += 1;
        }
    }
    let color = colors.into_iter().zip(uses).min_by_key(|(_, uses)| *uses).map(|(color, _)| color);
    let matte = Phong { pattern: color.unwrap_or(Color::WHITE).into(), ..Phong::default() };
    if shape == ShapeKind::Plane {
        return matte.into();
    }
    Phong { diffuse: 0.75, specular: 0.4, shininess: 60.0, reflection: Some(0.15), ..matte }.into()
}
