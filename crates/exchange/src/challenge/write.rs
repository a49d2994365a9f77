//! Writing scenes of the book.

use catoptric_scene::{Body, Camera, Checker, CheckerSpace, Color, Phong, Scene, Shape, rotation_degrees};
use glam::{DMat3, DQuat, DVec3};

use crate::camera::horizontal_from_vertical;
use crate::challenge::shape::MIRROR;
use crate::message::Message;
use crate::options::DEFAULT_SIZE;
use crate::phrase::Title;
use crate::scene_text::{ExportOptions, SceneText, components, decimal, three, times};

/// Writes a scene.
pub(crate) fn write(scene: &Scene, options: &ExportOptions) -> SceneText {
    let mut out = SceneText::default();
    out.environment(scene);
    if scene.environment.background != Color::BLACK {
        out.lose(Message::LosesBackground);
    }
    camera(&scene.camera, options.size.unwrap_or(DEFAULT_SIZE), &mut out);
    let mut sum = DVec3::ZERO;
    for (_, light) in out.lights(scene) {
        let intensity = times(light.color, light.intensity);
        sum += DVec3::from_array(intensity.to_array());
        out.line("\n- add: light");
        out.line(&format!("  at: [{}]", three(MIRROR * light.position, ", ")));
        out.line(&format!("  intensity: [{}]", components(intensity, ", ")));
    }
    let bodies = out.bodies(scene);
    let has_ambient = bodies.iter().any(|(_, _, material)| material.ambient > 0.0);
    let share = ambient_share(scene.environment.ambient, sum);
    if has_ambient && share.is_none() {
        out.lose(Message::LosesAmbientColor);
    }
    for (title, body, material) in &bodies {
        object(title, body, material, share.unwrap_or(1.0), &mut out);
    }
    out
}

/// Ambient light as a share of the sum of all lights, which is the book's ambient light.
fn ambient_share(ambient: Color, sum: DVec3) -> Option<f64> {
    let ambient = DVec3::from_array(ambient.to_array());
    if ambient == DVec3::ZERO {
        return Some(0.0);
    }
    let share = ambient.dot(sum) / sum.length_squared();
    (share.is_finite() && (ambient - share * sum).length() <= 1e-9 * ambient.length()).then_some(share)
}

fn camera(camera: &Camera, size @ [width, height]: [u32; 2], out: &mut SceneText) {
    let vertical = out.fov(camera);
    let fov = if width >= height { horizontal_from_vertical(vertical, size) } else { vertical };
    out.line("- add: camera");
    out.line(&format!("  width: {width}"));
    out.line(&format!("  height: {height}"));
    out.line(&format!("  field-of-view: {}", decimal(fov.to_radians())));
    for (key, point) in [("from", camera.position), ("to", camera.target), ("up", camera.up)] {
        out.line(&format!("  {key}: [{}]", three(MIRROR * point, ", ")));
    }
}

/// What the book calls a shape, its own keys, and where it has to be moved and how it has to be scaled to be the
/// shape.
struct BookShape {
    name: &'static str,
    ends: Option<[f64; 2]>,
    shift: f64,
    scale: DVec3,
}

impl BookShape {
    fn of(shape: Shape) -> Option<Self> {
        let plain = |name, scale| Self { name, ends: None, shift: 0.0, scale };
        Some(match shape {
            Shape::Sphere { radius } => plain("sphere", DVec3::splat(radius)),
            Shape::Cube { size } => plain("cube", 0.5 * size),
            Shape::Plane => plain("plane", DVec3::ONE),
            Shape::Cylinder { radius, height } => {
                Self { ends: Some([0.0, 1.0]), ..plain("cylinder", DVec3::new(radius, height, radius)) }
            }
            Shape::Cone { radius, top_radius, height } if radius == top_radius => {
                return Self::of(Shape::Cylinder { radius, height });
            }
            // The book's cone is as wide as it is far from y = 0.
            Shape::Cone { radius, top_radius, height } => {
                let (wide, ends) = if radius > top_radius {
                    (radius, [-1.0, -top_radius / radius])
                } else {
                    (top_radius, [radius / top_radius, 1.0])
                };
                let scale = DVec3::new(wide, height / (ends[1] - ends[0]), wide);
                Self { name: "cone", ends: Some(ends.map(|end| end + 0.0)), shift: -ends[0], scale }
            }
            Shape::Paraboloid { .. }
            | Shape::Union
            | Shape::Intersection
            | Shape::Difference
            | Shape::Group => return None,
        })
    }
}

fn object(title: &Title, body: &Body, material: &Phong, ambient_share: f64, out: &mut SceneText) {
    let Some(shape) = BookShape::of(body.sized_shape()) else {
        return out.lose(Message::LosesShape { title: title.clone() });
    };
    if material.tint != Color::WHITE && material.transmission > 0.0 {
        out.lose(Message::LosesTint { title: title.clone() });
    }
    let placement = &body.placement;
    let scale = shape.scale * placement.scale;
    let turn = book_turn(placement.rotation());
    let position = MIRROR * placement.origin();
    out.line(&format!("\n- add: {}", shape.name));
    if let Some(ends) = shape.ends {
        let [min, max] = ends.map(decimal);
        out.line(&format!("  min: {min}\n  max: {max}\n  closed: true"));
    }
    let mut moves = TransformList::default();
    moves.translate(DVec3::Y * shape.shift);
    moves.scale(scale);
    moves.rotate(turn);
    moves.translate(position);
    moves.write("  ", out);
    out.line("  material:");
    let shifted = DVec3::Y * -shape.shift;
    match &material.pattern.checker {
        Some(checker) => pattern(material.pattern.color, checker, (shifted, scale, turn, position), out),
        None => out.line(&format!("    color: [{}]", components(material.pattern.color, ", "))),
    }
    for (key, value) in [
        ("ambient", material.ambient * ambient_share),
        ("diffuse", material.diffuse),
        ("specular", material.specular),
        ("shininess", material.shininess),
        ("reflective", material.reflection()),
        ("transparency", material.transmission),
        ("refractive-index", material.ior),
    ] {
        out.line(&format!("    {key}: {}", decimal(value)));
    }
}

/// Turns about the book's X, then Y, then Z axis, radians.
fn book_turn(rotation: DMat3) -> DVec3 {
    let own = rotation_degrees(DQuat::from_mat3(&rotation).normalize());
    DVec3::new(-own.x, -own.y, own.z).map(f64::to_radians)
}

/// A checkerboard. Cells that are mirrored in z have the other color.
fn pattern(
    even: Color,
    checker: &Checker,
    (shifted, scale, turn, position): (DVec3, DVec3, DVec3, DVec3),
    out: &mut SceneText,
) {
    out.line("    pattern:\n      type: checkers\n      colors:");
    for color in [checker.color, even] {
        out.line(&format!("        - [{}]", components(color, ", ")));
    }
    let mut moves = TransformList::default();
    moves.scale(DVec3::splat(checker.size));
    if checker.space == CheckerSpace::World {
        moves.translate(-position);
        moves.rotate_back(turn);
    }
    moves.scale(scale.recip());
    moves.translate(shifted);
    moves.write("      ", out);
}

/// A list of transforms, without those that do nothing.
#[derive(Default)]
struct TransformList(Vec<String>);

impl TransformList {
    fn translate(&mut self, by: DVec3) {
        if by != DVec3::ZERO {
            self.0.push(format!("[translate, {}]", three(by, ", ")));
        }
    }

    fn scale(&mut self, by: DVec3) {
        if by != DVec3::ONE {
            self.0.push(format!("[scale, {}]", three(by, ", ")));
        }
    }

    fn turn(&mut self, axis: &str, angle: f64) {
        if angle != 0.0 {
            self.0.push(format!("[rotate-{axis}, {angle}]"));
        }
    }

    fn rotate(&mut self, turn: DVec3) {
        self.turn("x", turn.x);
        self.turn("y", turn.y);
        self.turn("z", turn.z);
    }

    fn rotate_back(&mut self, turn: DVec3) {
        self.turn("z", -turn.z);
        self.turn("y", -turn.y);
        self.turn("x", -turn.x);
    }

    fn write(&self, indent: &str, out: &mut SceneText) {
        if self.0.is_empty() {
            return;
        }
        out.line(&format!("{indent}transform:"));
        for item in &self.0 {
            out.line(&format!("{indent}  - {item}"));
        }
    }
}
