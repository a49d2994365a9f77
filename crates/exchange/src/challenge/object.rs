//! Bodies as objects of the book.

use catoptric_scene::{
    Body, BodyPart, Color, Form, MaterialChoice, OpenCone, OpenCylinder, ParametricShape, PatternSpace,
    Placement, Scene, Shadow, Shape, SolidKind, SolidTexture, Triangle, rotation_degrees,
};
use glam::{DAffine3, DMat3, DQuat, DVec3};

use crate::challenge::csg::OPERATIONS;
use crate::challenge::shape::MIRROR;
use crate::message::Message;
use crate::phrase::Title;
use crate::scene_text::{SceneText, components, decimal, three};

/// Writes objects.
pub(super) struct ObjectWriter<'s> {
    pub(super) scene: &'s Scene,
    /// Ambient light as a share of the sum of all lights.
    pub(super) ambient_share: f64,
    /// Whether ambient light falls on anything.
    pub(super) has_ambient: bool,
    pub(super) out: SceneText,
}

/// Where an object stands in the file.
struct ObjectPlace {
    /// In front of its first line, up to the name.
    lead: String,
    /// In front of the others.
    indent: String,
}

impl ObjectPlace {
    /// An item of a list.
    fn item(indent: &str) -> Self {
        Self { lead: format!("{indent}- add: "), indent: format!("{indent}  ") }
    }

    /// An operand.
    fn operand(indent: &str) -> Self {
        Self { lead: format!("{indent}type: "), indent: indent.to_owned() }
    }
}

/// What stands around a part.
#[derive(Clone, Copy)]
struct PartContext<'s> {
    title: &'s Title,
    /// Of the wholes around, the outermost first.
    around: &'s [Placement],
    is_operand: bool,
    shadow: Shadow,
    material: &'s MaterialChoice,
}

impl ObjectWriter<'_> {
    /// Writes a body, or that it is lost.
    pub(super) fn body(&mut self, title: &Title, body: &Body) {
        let start = self.out.text.len();
        self.out.line("");
        let context = PartContext {
            title,
            around: &[],
            is_operand: false,
            shadow: body.shadow,
            material: &body.material,
        };
        if self.form(&body.form(), context, &ObjectPlace::item("")).is_none() {
            self.out.text.truncate(start);
        }
    }

    fn part(&mut self, part: &BodyPart, context: PartContext<'_>, place: &ObjectPlace) -> Option<()> {
        let material = part.material.as_ref().unwrap_or(context.material);
        self.form(&part.form(), PartContext { material, ..context }, place)
    }

    fn form(&mut self, form: &Form<'_>, context: PartContext<'_>, place: &ObjectPlace) -> Option<()> {
        if !form.shape.is_compound() || form.shape.is_surface() {
            return self.simple(form, context, place);
        }
        let around = [context.around, &[form.placement]].concat();
        let context = PartContext { around: &around, ..context };
        if form.shape != Shape::Group && form.parts.len() > 1 {
            return self.joined(form.shape, (form.parts, context), Some(&form.placement), place);
        }
        self.out.line(&format!("{}group", place.lead));
        TransformList::of(&form.placement).write(&place.indent, &mut self.out);
        let none = if form.parts.is_empty() { " []" } else { "" };
        self.out.line(&format!("{}children:{none}", place.indent));
        let item = ObjectPlace::item(&format!("{}  ", place.indent));
        form.parts.iter().try_for_each(|part| self.part(part, context, &item))
    }

    /// Operands are two: of more parts, several are an operand together, so that few are nested.
    fn joined(
        &mut self,
        shape: Shape,
        (parts, context): (&[BodyPart], PartContext<'_>),
        placement: Option<&Placement>,
        place: &ObjectPlace,
    ) -> Option<()> {
        let (operation, _) = OPERATIONS.into_iter().find(|(_, known)| *known == shape)?;
        self.out.line(&format!("{}csg", place.lead));
        self.out.line(&format!("{}operation: {operation}", place.indent));
        self.shadow(context, place);
        if let Some(placement) = placement {
            TransformList::of(placement).write(&place.indent, &mut self.out);
        }
        let (at, of_right) = match shape {
            Shape::Difference => (1, Shape::Union),
            _ => (parts.len() / 2, shape),
        };
        let (left, right) = parts.split_at_checked(at)?;
        let context = PartContext { is_operand: true, ..context };
        let operand = ObjectPlace::operand(&format!("{}  ", place.indent));
        for (key, shape, parts) in [("left", shape, left), ("right", of_right, right)] {
            self.out.line(&format!("{}{key}:", place.indent));
            match parts {
                [only] => self.part(only, context, &operand)?,
                several => self.joined(shape, (several, context), None, &operand)?,
            }
        }
        Some(())
    }

    /// Says so if what is no operand has no shadow.
    fn shadow(&mut self, context: PartContext<'_>, place: &ObjectPlace) {
        if context.shadow == Shadow::None && !context.is_operand {
            self.out.line(&format!("{}shadow: false", place.indent));
        }
    }

    fn simple(&mut self, form: &Form<'_>, context: PartContext<'_>, place: &ObjectPlace) -> Option<()> {
        let PartContext { title, around, is_operand, material, .. } = context;
        // Half-spaces and surfaces are no operands of the book.
        let is_half_space = matches!(form.shape, Shape::Plane | Shape::Surface { .. }) && is_operand;
        let shape = BookShape::of_form(form).filter(|_| !is_half_space);
        let Some(shape) = shape else {
            self.out.lose(Message::LosesShape { title: title.clone() });
            return None;
        };
        self.out.side(form, title);
        let material = self.out.surface(self.scene, material, title)?;
        if material.tint != Color::WHITE && material.transmission > 0.0 {
            self.out.lose(Message::LosesTint { title: title.clone() });
        }
        if material.transmission > 0.0 {
            for (is_lost, message) in [
                (!material.weighs_by_angle(), Message::LosesConstant { title: title.clone() }),
                (context.shadow == Shadow::Filtered, Message::LosesShadow { title: title.clone() }),
            ] {
                if is_lost {
                    self.out.lose(message);
                }
            }
        }
        self.has_ambient |= material.ambient > 0.0;
        self.out.line(&format!("{}{}", place.lead, shape.name));
        self.shadow(context, place);
        let (out, indent) = (&mut self.out, &place.indent);
        if let Some(ends) = shape.ends {
            let [min, max] = ends.map(decimal);
            let closed = shape.is_closed;
            out.line(&format!("{indent}min: {min}\n{indent}max: {max}\n{indent}closed: {closed}"));
        }
        for (key, corner) in ["p1", "p2", "p3"].into_iter().zip(shape.corners.into_iter().flatten()) {
            out.line(&format!("{indent}{key}: [{}]", three(MIRROR * corner, ", ")));
        }
        let mut moves = TransformList::default();
        moves.translate(DVec3::Y * shape.shift);
        moves.place(&form.placement, shape.scale);
        moves.write(indent, out);
        out.line(&format!("{indent}material:"));
        match &material.pattern.solid {
            Some(solid) => {
                let placements = [around, &[form.placement]].concat();
                let surface = (placements.as_slice(), &shape);
                out.line(&format!("{indent}  pattern:"));
                let place = ObjectPlace::operand(&format!("{indent}    "));
                pattern(material.pattern.color, solid, surface, None, &place, out);
            }
            None => {
                out.line(&format!("{indent}  color: [{}]", components(material.pattern.color, ", ")));
            }
        }
        for (key, value) in [
            ("ambient", material.ambient * self.ambient_share),
            ("diffuse", material.diffuse),
            ("specular", material.specular),
            ("shininess", material.shininess),
            ("reflective", material.reflection()),
            ("transparency", material.transmission),
            ("refractive-index", material.ior),
        ] {
            out.line(&format!("{indent}  {key}: {}", decimal(value)));
        }
        Some(())
    }
}

/// What the book calls a shape, its own keys, and where it has to be moved and how it has to be scaled to be the
/// shape.
struct BookShape {
    name: &'static str,
    ends: Option<[f64; 2]>,
    is_closed: bool,
    /// Of a triangle, in the axes of the scene.
    corners: Option<[DVec3; 3]>,
    shift: f64,
    scale: DVec3,
}

impl BookShape {
    fn of_form(form: &Form<'_>) -> Option<Self> {
        match form.parametric() {
            None => Self::of(form.sized_shape()),
            Some(&ParametricShape::OpenCylinder(OpenCylinder { radius, height, .. })) => {
                Some(Self { is_closed: false, ..Self::of(Shape::Cylinder { radius, height })? })
            }
            Some(&ParametricShape::OpenCone(OpenCone { radius, top_radius, height, .. })) => {
                Some(Self { is_closed: false, ..Self::of(Shape::Cone { radius, top_radius, height })? })
            }
            Some(&ParametricShape::Triangle(Triangle { a, b, c, .. })) => {
                Some(Self { corners: Some([a, b, c]), ..Self::plain("triangle", DVec3::ONE) })
            }
            Some(_) => None,
        }
    }

    const fn plain(name: &'static str, scale: DVec3) -> Self {
        Self { name, ends: None, is_closed: true, corners: None, shift: 0.0, scale }
    }

    fn of(shape: Shape) -> Option<Self> {
        let plain = Self::plain;
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
                let ends_of_cone = Some(ends.map(|end| end + 0.0));
                Self { ends: ends_of_cone, shift: -ends[0], ..plain("cone", scale) }
            }
            Shape::Paraboloid { .. }
            | Shape::Union
            | Shape::Intersection
            | Shape::Difference
            | Shape::Surface { .. }
            | Shape::Group => return None,
        })
    }
}

/// Turns about the book's X, then Y, then Z axis, radians.
fn book_turn(rotation: DMat3) -> DVec3 {
    let own = rotation_degrees(DQuat::from_mat3(&rotation).normalize());
    DVec3::new(-own.x, -own.y, own.z).map(f64::to_radians)
}

/// A pattern of a shape, which stands in all of these, the outermost first; `outer` is what the pattern around it
/// does. Cells that are mirrored in z have the other color.
fn pattern(
    first: Color,
    solid: &SolidTexture,
    surface: (&[Placement], &BookShape),
    outer: Option<&TransformList>,
    place: &ObjectPlace,
    out: &mut SceneText,
) {
    let indent = &place.indent;
    let kind = match solid.kind {
        SolidKind::Checker => "checkers",
        SolidKind::Stripes => "stripes",
        SolidKind::Rings => "rings",
        SolidKind::Gradient => "gradient",
    };
    let moves = TransformList::of_pattern(solid, surface);
    out.line(&format!("{}{kind}\n{indent}colors:", place.lead));
    let mut colors = [(first, &solid.first), (solid.color, &solid.second)];
    if solid.kind == SolidKind::Checker {
        colors.reverse();
    }
    for (color, inner) in colors {
        match inner {
            Some(inner) => {
                let lead = format!("{indent}  - type: ");
                let place = ObjectPlace { lead, indent: format!("{indent}    ") };
                pattern(color, inner, surface, Some(&moves), &place, out);
            }
            None => out.line(&format!("{indent}  - [{}]", components(color, ", "))),
        }
    }
    let moves = match outer {
        Some(outer) => moves.within(outer),
        None => moves,
    };
    moves.write(indent, out);
}

/// What the book does to a shape or a pattern.
#[derive(Clone, Copy, PartialEq)]
enum Transform {
    Translate(DVec3),
    Scale(DVec3),
    /// About an axis, radians.
    Rotate(char, f64),
}

impl Transform {
    fn inverse(self) -> Self {
        match self {
            Self::Translate(by) => Self::Translate(-by),
            Self::Scale(by) => Self::Scale(by.recip()),
            Self::Rotate(axis, angle) => Self::Rotate(axis, -angle),
        }
    }
}

/// A list of transforms, without those that do nothing.
#[derive(Default)]
struct TransformList(Vec<Transform>);

impl TransformList {
    fn of(placement: &Placement) -> Self {
        let mut moves = Self::default();
        moves.place(placement, DVec3::ONE);
        moves
    }

    /// From the space of a pattern to that of the shape.
    fn of_pattern(solid: &SolidTexture, (placements, shape): (&[Placement], &BookShape)) -> Self {
        let mut moves = Self::default();
        moves.place(&solid.placement(), DVec3::splat(solid.size));
        match solid.space {
            PatternSpace::World => {
                for placement in placements {
                    moves.translate(-(MIRROR * placement.origin()));
                    moves.rotate_back(book_turn(placement.rotation()));
                    moves.scale(placement.scale.recip());
                }
                moves.scale(shape.scale.recip());
            }
            PatternSpace::Body => {
                let frames = placements.iter().map(Placement::world_from_body);
                let linear = frames.fold(DAffine3::IDENTITY, |around, frame| around * frame).matrix3;
                let sizes =
                    DVec3::new(linear.x_axis.length(), linear.y_axis.length(), linear.z_axis.length());
                moves.scale((shape.scale * sizes).recip());
            }
        }
        moves.translate(DVec3::Y * -shape.shift);
        moves
    }

    /// The list of a pattern in the space of the one around it.
    fn within(&self, outer: &Self) -> Self {
        let same =
            self.0.iter().rev().zip(outer.0.iter().rev()).take_while(|(own, other)| own == other).count();
        let own = self.0.iter().take(self.0.len() - same).copied();
        let back = outer.0.iter().take(outer.0.len() - same).rev().map(|step| step.inverse());
        Self(own.chain(back).collect())
    }

    /// The scale of the shape itself comes first.
    fn place(&mut self, placement: &Placement, scale: DVec3) {
        self.scale(scale * placement.scale);
        self.rotate(book_turn(placement.rotation()));
        self.translate(MIRROR * placement.origin());
    }

    fn translate(&mut self, by: DVec3) {
        if by != DVec3::ZERO {
            self.0.push(Transform::Translate(by));
        }
    }

    fn scale(&mut self, by: DVec3) {
        if by != DVec3::ONE {
            self.0.push(Transform::Scale(by));
        }
    }

    fn turn(&mut self, axis: char, angle: f64) {
        if angle != 0.0 {
            self.0.push(Transform::Rotate(axis, angle));
        }
    }

    fn rotate(&mut self, turn: DVec3) {
        self.turn('x', turn.x);
        self.turn('y', turn.y);
        self.turn('z', turn.z);
    }

    fn rotate_back(&mut self, turn: DVec3) {
        self.turn('z', -turn.z);
        self.turn('y', -turn.y);
        self.turn('x', -turn.x);
    }

    fn write(&self, indent: &str, out: &mut SceneText) {
        if self.0.is_empty() {
            return;
        }
        out.line(&format!("{indent}transform:"));
        for step in &self.0 {
            let step = match *step {
                Transform::Translate(by) => format!("translate, {}", three(by, ", ")),
                Transform::Scale(by) => format!("scale, {}", three(by, ", ")),
                Transform::Rotate(axis, angle) => format!("rotate-{axis}, {angle}"),
            };
            out.line(&format!("{indent}  - [{step}]"));
        }
    }
}
