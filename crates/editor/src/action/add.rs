//! New bodies, lights and materials.

use catoptric_scene::{
    Body, Color, Light, Material, MaterialChoice, NamedMaterial, Placement, Scene, Shape, ShapeKind,
};
use glam::DVec3;

use super::outcome::Outcome;
use crate::bounds::{self, Bounds};
use crate::names::Names;
use crate::selection::{Item, Selection};

/// Colors of new bodies, sRGB: of equal weight, each told from the others at a glance.
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

/// Rings of places about the wanted one that are tried for a new body.
const RINGS: u32 = 8;

pub(super) fn body(scene: &Scene, shape: ShapeKind, at: DVec3, name: &str) -> Outcome {
    let mut names = Names::of(scene.bodies.iter().map(|body| body.name.as_str()));
    let mut body = Body {
        name: names.take(if name.is_empty() { shape.key() } else { name }),
        shape: shape.shape(),
        placement: Placement::at(at.with_y(0.0).map(to_millimeters)),
        material: MaterialChoice::Inline(Box::new(material(scene, shape))),
        ..Body::default()
    };
    if let Some(bounds) = bounds::of_body(&body) {
        let up = DVec3::NEG_Y * bounds.min.y;
        body.placement = body.placement.moved_by(up);
        if let Some(aside) = free_place(scene, Bounds { min: bounds.min + up, max: bounds.max + up }) {
            body.placement = body.placement.moved_by(aside);
        }
    }
    let mut scene = scene.clone();
    let selection = Selection::one(Item::Body(scene.bodies.len()));
    let subject = body.name.clone();
    scene.bodies.push(body);
    Outcome { scene, selection, subject }
}

pub(super) fn light(scene: &Scene, at: DVec3, name: &str) -> Outcome {
    let mut names = Names::of(scene.lights.iter().map(|light| light.name.as_str()));
    let name = names.take(if name.is_empty() { "light" } else { name });
    let mut scene = scene.clone();
    let selection = Selection::one(Item::Light(scene.lights.len()));
    let subject = name.clone();
    scene.lights.push(Light { name, position: at.map(to_millimeters), ..Light::default() });
    Outcome { scene, selection, subject }
}

pub(super) fn named_material(scene: &Scene, name: &str) -> Outcome {
    let mut names = Names::of_materials(scene);
    let name = names.take(if name.is_empty() { "material" } else { name });
    let mut scene = scene.clone();
    let selection = Selection::one(Item::Material(scene.materials.len()));
    let subject = name.clone();
    scene.materials.push(NamedMaterial { name, material: Material::default() });
    Outcome { scene, selection, subject }
}

/// Places come from a mouse; files should not show its every digit.
fn to_millimeters(meters: f64) -> f64 {
    (meters * 1e3).round() * 1e-3
}

/// Of the palette's colors, the one that the fewest bodies have or come near to; with some gloss, but for planes.
fn material(scene: &Scene, shape: ShapeKind) -> Material {
    let colors = PALETTE.map(Color::from_srgb8);
    let mut uses = [0usize; PALETTE.len()];
    for body in &scene.bodies {
        let Some(material) = scene.material(&body.material) else { continue };
        let distance = |color: &Color| {
            let (a, b) = (DVec3::from_array(color.to_array()), DVec3::from_array(material.color.to_array()));
            a.distance_squared(b)
        };
        let near = colors.iter().zip(&mut uses).min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)));
        if let Some((_, uses)) = near {
            *uses += 1;
        }
    }
    let color = colors.into_iter().zip(uses).min_by_key(|(_, uses)| *uses).map(|(color, _)| color);
    let matte = Material { color: color.unwrap_or(Color::WHITE), ..Material::default() };
    if shape == ShapeKind::Plane {
        return matte;
    }
    Material { diffuse: 0.75, specular: 0.4, shininess: 60.0, reflection: Some(0.15), ..matte }
}

/// How far aside a body with these bounds meets no other that is seen; `None` when that is far away.
fn free_place(scene: &Scene, bounds: Bounds) -> Option<DVec3> {
    let others: Vec<Bounds> = scene
        .bodies
        .iter()
        .filter(|body| !body.hidden && body.shape != Shape::Plane)
        .filter_map(bounds::of_body)
        .collect();
    let step = 1.25 * bounds.size().x.max(bounds.size().z);
    let ring = |ring: u32| {
        let count = (6 * ring).max(1);
        (0..count).map(move |index| {
            let angle = std::f64::consts::TAU * f64::from(index) / f64::from(count);
            let aside = step * f64::from(ring) * DVec3::new(angle.cos(), 0.0, angle.sin());
            aside.map(to_millimeters)
        })
    };
    (0..=RINGS).flat_map(ring).find(|aside| {
        let there = Bounds { min: bounds.min + *aside, max: bounds.max + *aside };
        !others.iter().any(|other| other.overlaps(&there))
    })
}
