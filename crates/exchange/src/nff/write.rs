//! Writing NFF.

use catoptric_scene::{Color, Scene, Shape};

use crate::message::Message;
use crate::options::DEFAULT_SIZE;
use crate::scene_text::{ExportOptions, SceneText, components, decimal, three, times};

/// Writes a scene.
pub(crate) fn write(scene: &Scene, options: &ExportOptions) -> SceneText {
    let mut out = SceneText::default();
    out.environment(scene);
    let [width, height] = options.size.unwrap_or(DEFAULT_SIZE);
    let camera = &scene.camera;
    let angle = out.fov(camera);
    out.line("v");
    for (key, point) in [("from", camera.position), ("at", camera.target), ("up", camera.up)] {
        out.line(&format!("{key} {}", three(point, " ")));
    }
    out.line(&format!("angle {}", decimal(angle)));
    out.line("hither 0");
    out.line(&format!("resolution {width} {height}"));
    out.line(&format!("b {}", components(scene.environment.background, " ")));
    for (_, light) in out.lights(scene) {
        let color = components(times(light.color, light.intensity), " ");
        out.line(&format!("l {} {color}", three(light.position, " ")));
    }
    let has_ambient_light = scene.environment.ambient != Color::BLACK;
    let mut last_fill = String::new();
    for (title, body, material) in out.bodies(scene) {
        let scale = body.placement.scale;
        let radius = match body.shape {
            Shape::Sphere { radius } if scale.x == scale.y && scale.y == scale.z => radius * scale.x,
            _ => {
                out.lose(Message::LosesShape { title });
                continue;
            }
        };
        for (is_lost, message) in [
            (material.ambient > 0.0 && has_ambient_light, Message::LosesBodyAmbient { title: title.clone() }),
            (material.reflection() != material.specular, Message::LosesReflection { title: title.clone() }),
            (material.pattern.solid.is_some(), Message::LosesPattern { title: title.clone() }),
            (
                material.transmission > 0.0 && material.tint != Color::WHITE,
                Message::LosesTint { title: title.clone() },
            ),
        ] {
            if is_lost {
                out.lose(message);
            }
        }
        let numbers =
            [material.diffuse, material.specular, material.shininess, material.transmission, material.ior];
        let fill =
            format!("f {} {}", components(material.pattern.color, " "), numbers.map(decimal).join(" "));
        if fill != last_fill {
            out.line(&fill);
            last_fill = fill;
        }
        out.line(&format!("s {} {}", three(body.placement.origin(), " "), decimal(radius)));
    }
    out
}
