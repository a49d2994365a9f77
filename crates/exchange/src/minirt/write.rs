//! Writing miniRT's scenes, as the subject has them.

use catoptric_scene::{
    Body, Camera, Color, ParametricShape, PatternSpace, Phong, Rectangle, Scene, Shape, SolidKind,
    SolidTexture, Triangle,
};
use glam::{DAffine3, DMat3, DVec3};

use crate::camera::{horizontal_from_vertical, up_for};
use crate::message::Message;
use crate::options::DEFAULT_SIZE;
use crate::phrase::Title;
use crate::scene_text::{ExportOptions, SceneText, decimal, three, times};

/// Writes a scene.
pub(crate) fn write(scene: &Scene, options: &ExportOptions) -> SceneText {
    let mut out = SceneText::default();
    if let Some([width, height]) = options.size {
        out.line(&format!("R {width} {height}"));
    }
    out.environment(scene);
    if scene.environment.background != Color::BLACK {
        out.lose(Message::LosesBackground);
    }
    let bodies = out.bodies(scene);
    let ratio = ambient_ratio(&bodies, &mut out);
    ambient(times(scene.environment.ambient, ratio), &mut out);
    camera(&scene.camera, options.size.unwrap_or(DEFAULT_SIZE), &mut out);
    for (title, light) in out.lights(scene) {
        let [color, brightness] = [light.color, Color::gray(light.intensity)];
        let total = times(color, light.intensity);
        let is_plain = brightest(color) <= 1.0 && brightest(brightness) <= 1.0;
        let (color, brightness) = if is_plain {
            (color, light.intensity)
        } else {
            (times(total, brightest(total).recip()), brightest(total))
        };
        if brightness > 1.0 {
            out.lose(Message::LosesBrightness { title });
        }
        out.line(&format!(
            "L {} {} {}",
            three(light.position, ","),
            decimal(brightness.min(1.0)),
            codes(color)
        ));
    }
    for (title, body, material) in &bodies {
        element(title, body, material, &mut out);
    }
    out
}

/// The ambient coefficient of all bodies as a share of their diffuse one. The format has one ambient light for all.
fn ambient_ratio(bodies: &[(Title, &Body, std::borrow::Cow<'_, Phong>)], out: &mut SceneText) -> f64 {
    let mut common = None;
    for (title, _, material) in bodies {
        if material.ambient == 0.0 && material.diffuse == 0.0 {
            continue;
        }
        let ratio = material.ambient / material.diffuse;
        let common = *common.get_or_insert(ratio);
        if !ratio.is_finite() || (ratio - common).abs() > 1e-9 * common {
            out.lose(Message::LosesAmbient { title: title.clone() });
        }
    }
    common.filter(|ratio: &f64| ratio.is_finite()).unwrap_or(1.0)
}

fn ambient(light: Color, out: &mut SceneText) {
    let ratio = brightest(light);
    if ratio > 1.0 {
        out.lose(Message::LosesAmbientLight);
    }
    let color = if ratio > 0.0 { times(light, ratio.recip()) } else { Color::WHITE };
    out.line(&format!("A {} {}", decimal(ratio.min(1.0)), codes(color)));
}

fn camera(camera: &Camera, size: [u32; 2], out: &mut SceneText) {
    let direction = (camera.target - camera.position).normalize_or(DVec3::NEG_Z);
    let right = |up: DVec3| direction.cross(up).normalize_or_zero();
    if right(camera.up).dot(right(up_for(direction))) < 1.0 - 1e-9 {
        out.lose(Message::LosesRoll);
    }
    let degrees = horizontal_from_vertical(out.fov(camera), size);
    out.line(&format!("C {} {} {}", three(camera.position, ","), three(direction, ","), decimal(degrees)));
}

fn element(title: &Title, body: &Body, material: &Phong, out: &mut SceneText) {
    let frame = body.placement.world_from_body();
    let turn = body.placement.rotation();
    let scale = body.placement.scale;
    let (origin, up) = (frame.translation, turn.y_axis);
    let is_uniform = scale.x == scale.y && scale.y == scale.z;
    let form = body.form();
    let flat = form.parametric().map(|shape| flat(*shape, (frame, turn, is_uniform.then_some(scale.x))));
    let geometry = match body.sized_shape() {
        _ if flat.is_some() => match flat.flatten() {
            Some(geometry) => geometry,
            None => return out.lose(Message::LosesShape { title: title.clone() }),
        },
        Shape::Sphere { radius } if is_uniform => {
            format!("sp {} {}", three(origin, ","), decimal(2.0 * radius * scale.x))
        }
        Shape::Plane => format!("pl {} {}", three(origin, ","), three(up, ",")),
        Shape::Cylinder { radius, height } if scale.x == scale.z => {
            let (height, diameter) = (height * scale.y, 2.0 * radius * scale.x);
            let center = origin + 0.5 * height * up;
            format!("cy {} {} {} {}", three(center, ","), three(up, ","), decimal(diameter), decimal(height))
        }
        Shape::Cone { radius, top_radius: 0.0, height } if scale.x == scale.z => {
            let (height, diameter) = (height * scale.y, 2.0 * radius * scale.x);
            let apex = origin + height * up;
            format!("co {} {} {} {}", three(apex, ","), three(-up, ","), decimal(diameter), decimal(height))
        }
        _ => return out.lose(Message::LosesShape { title: title.clone() }),
    };
    out.side(&form, title);
    let reflection = material.reflection();
    if material.transmission > 0.0 {
        out.lose(Message::LosesTransmission { title: title.clone() });
    }
    // The reader takes what a mirror reflects from its own light.
    let own = 1.0 - reflection;
    let factor = if own > 0.0 { material.diffuse / own } else { 1.0 };
    if brightest(material.pattern.brightest()) * factor > 1.0 + 1e-12
        || reflection > 1.0
        || (own <= 0.0 && material.diffuse > 0.0)
    {
        out.lose(Message::LosesColor { title: title.clone() });
    }
    let mut line = format!("{geometry} {}", codes(times(material.pattern.color, factor)));
    if reflection > 0.0 {
        line += &format!(" reflection={}", decimal(reflection.min(1.0)));
    }
    if material.specular > 0.0 {
        if material.specular > 1.0 {
            out.lose(Message::LosesHighlight { title: title.clone() });
        }
        line += &format!(
            " specular={} shininess={}",
            decimal(material.specular.min(1.0)),
            decimal(material.shininess)
        );
    }
    if let Some(solid) = &material.pattern.solid {
        if is_of_body(solid, body) {
            line += &format!(" checker={}:{}", codes(times(solid.color, factor)), decimal(solid.size));
        } else {
            out.lose(Message::LosesPattern { title: title.clone() });
        }
    }
    out.line(&line);
}

/// A square or a triangle in a frame with this turn, and this scale if it is uniform.
fn flat(shape: ParametricShape, (frame, turn, scale): (DAffine3, DMat3, Option<f64>)) -> Option<String> {
    match (shape, scale) {
        (ParametricShape::Rectangle(Rectangle { width, length, .. }), Some(scale))
            if width == length && is_shortest(turn) =>
        {
            let [center, up] = [frame.translation, turn.y_axis].map(|point| three(point, ","));
            Some(format!("sq {center} {up} {}", decimal(width * scale)))
        }
        (ParametricShape::Triangle(Triangle { a, b, c, .. }), _) => {
            let corners = [a, b, c].map(|corner| three(frame.transform_point3(corner), ","));
            Some(format!("tr {}", corners.join(" ")))
        }
        _ => None,
    }
}

/// Whether a turn carries +Y along the shortest arc, as the reader turns a square.
fn is_shortest(turn: DMat3) -> bool {
    let arc = DMat3::from_quat(glam::DQuat::from_rotation_arc(DVec3::Y, turn.y_axis.normalize_or(DVec3::Y)));
    arc.abs_diff_eq(turn, 1e-9)
}

/// Whether a pattern is a checkerboard of the body's own frame.
fn is_of_body(solid: &SolidTexture, body: &Body) -> bool {
    let SolidTexture { color, size, space, .. } = *solid;
    if *solid != (SolidTexture { size, space, ..SolidTexture::new(SolidKind::Checker, color) }) {
        return false;
    }
    if space == PatternSpace::Body {
        return true;
    }
    let cells = body.placement.origin() / size;
    let is_turned = !body.placement.rotation().abs_diff_eq(DMat3::IDENTITY, 1e-12);
    !is_turned && cells == cells.round() && cells.element_sum().rem_euclid(2.0) == 0.0
}

fn brightest(color: Color) -> f64 {
    color.to_array().into_iter().fold(0.0, f64::max)
}

fn codes(color: Color) -> String {
    three(DVec3::from_array(color.to_array().map(|value| 255.0 * value.clamp(0.0, 1.0))), ",")
}
