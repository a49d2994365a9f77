//! Writing NFF.

use catoptric_scene::{
    Body, Color, OpenCone, OpenCylinder, ParametricShape, Rectangle, Scene, Shape, Triangle, VisibleSide,
};
use glam::DVec3;

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
        let Some(record) = record(body) else {
            out.lose(Message::LosesShape { title });
            continue;
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
        out.line(&record);
    }
    out
}

/// The lines of a body, if there are any for it.
fn record(body: &Body) -> Option<String> {
    let (frame, scale) = (body.placement.world_from_body(), body.placement.scale);
    let is_round = scale.x == scale.z;
    // The format has each side by itself.
    let sides = |side: VisibleSide, record: &dyn Fn(bool) -> String| {
        let sides = [true, false].into_iter().filter(|is_outer| side.is_met(*is_outer));
        Some(sides.map(record).collect::<Vec<_>>().join("\n"))
    };
    let ends = |side: VisibleSide, [radius, top_radius]: [f64; 2], height: f64| {
        sides(side, &|is_outer| {
            let line = |y: f64, radius: f64| {
                let end = three(frame.transform_point3(DVec3::Y * y), " ");
                let radius = radius * if is_outer { scale.x } else { -scale.x };
                // No zero has a sign.
                format!("{end} {}", decimal(radius + 0.0))
            };
            format!("c\n{}\n{}", line(0.0, radius), line(height, top_radius))
        })
    };
    let polygon = |side: VisibleSide, corners: &[DVec3]| {
        sides(side, &|is_outer| {
            let mut lines: Vec<String> =
                corners.iter().map(|corner| three(frame.transform_point3(*corner), " ")).collect();
            if !is_outer {
                lines.reverse();
            }
            format!("p {}\n{}", lines.len(), lines.join("\n"))
        })
    };
    match (body.shape, body.form().parametric()) {
        (Shape::Sphere { radius }, _) if is_round && scale.x == scale.y => {
            Some(format!("s {} {}", three(frame.translation, " "), decimal(radius * scale.x)))
        }
        (_, Some(&ParametricShape::OpenCylinder(OpenCylinder { radius, height, side }))) if is_round => {
            ends(side, [radius, radius], height)
        }
        (_, Some(&ParametricShape::OpenCone(OpenCone { radius, top_radius, height, side }))) if is_round => {
            ends(side, [radius, top_radius], height)
        }
        (_, Some(&ParametricShape::Triangle(Triangle { a, b, c, side }))) => polygon(side, &[a, b, c]),
        (_, Some(&ParametricShape::Rectangle(Rectangle { width, length, side }))) => {
            let [x, z] = [0.5 * width, 0.5 * length];
            let corners = [[-x, z], [x, z], [x, -z], [-x, -z]];
            polygon(side, &corners.map(|[x, z]| DVec3::new(x, 0.0, z)))
        }
        _ => None,
    }
}
