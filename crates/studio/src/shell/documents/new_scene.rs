//! The scene of a new document: a ball on a checkered floor under a light, ready to work in.

use catoptric_scene::{
    Body, Camera, Color, Environment, Light, Material, MaterialChoice, Pattern, Phong, Placement, Projection,
    Scene, Shape, SolidTexture,
};
use glam::DVec3;

use crate::base::texts::Texts;

/// A new scene, its things named in the present language.
pub(crate) fn fresh_scene(texts: &Texts) -> Scene {
    let floor = Material::Phong(Phong {
        pattern: Pattern {
            color: Color::new(0.62, 0.63, 0.65),
            solid: Some(SolidTexture {
                color: Color::new(0.30, 0.31, 0.33),
                size: 1.0,
                ..SolidTexture::default()
            }),
            ..Pattern::default()
        },
        ambient: 0.15,
        diffuse: 0.75,
        reflection: Some(0.12),
        ..Phong::default()
    });
    let ball = Material::Phong(Phong {
        pattern: Color::new(0.80, 0.30, 0.10).into(),
        ambient: 0.12,
        diffuse: 0.75,
        specular: 0.5,
        shininess: 80.0,
        reflection: Some(0.25),
        ..Phong::default()
    });
    let body = |name, shape, at, material| Body {
        name: texts.get(name).to_owned(),
        shape,
        placement: Placement::at(at),
        material: MaterialChoice::Inline(Box::new(material)),
        ..Body::default()
    };
    Scene {
        camera: Camera {
            position: DVec3::new(3.2, 2.6, 6.4),
            target: DVec3::new(0.0, 0.8, 0.0),
            projection: Projection::Perspective { fov_degrees: 34.0 },
            ..Camera::default()
        },
        environment: Environment { background: Color::new(0.30, 0.42, 0.60), ..Environment::default() },
        lights: vec![Light {
            name: texts.get("name-light").to_owned(),
            position: DVec3::new(-4.0, 7.0, 5.0),
            ..Light::default()
        }],
        bodies: [
            body("name-plane", Shape::Plane, DVec3::ZERO, floor),
            body("name-sphere", Shape::SPHERE, DVec3::Y, ball),
        ]
        .into(),
        ..Scene::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;

    #[test]
    fn a_new_scene_is_good_in_every_language() {
        for language in Language::ALL {
            let texts = Texts::new(language);
            let scene = fresh_scene(&texts);
            assert_eq!(scene.check(), []);
            assert_eq!(catoptric_scene::read(&catoptric_scene::write(&scene)).scene, scene);
            assert!(texts.missing().iter().all(|key| key.starts_with("name-")));
        }
    }
}
