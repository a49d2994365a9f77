//! Reading miniRT's scenes.

use std::ops::Range;

use catoptric_scene::{
    Anchor, Body, BodyShape, Camera, Color, Diagnostic, Diagnostics, Light, MaterialChoice, ParametricShape,
    Placement, Projection, Rectangle, Severity, Shape, nearest, rotation_degrees,
};
use glam::{DQuat, DVec3};

use crate::camera::{up_for, vertical_from_horizontal};
use crate::draft::{Draft, FAR};
use crate::lines::{Word, lines};
use crate::message::Message;
use crate::minirt::arguments::{Arguments, Spanned, out_of_range};
use crate::minirt::cone::CONES;
use crate::minirt::property::Finish;
use crate::options::{DEFAULT_SIZE, ImportOptions, ImportedScene};
use crate::phrase::Argument;
use crate::triangle::triangle_at;

/// The elements in the order of the subject.
const ELEMENTS: [&str; 12] = ["R", "A", "C", "L", "sp", "pl", "cy", "sq", "co", "tr", "c", "l"];
/// Begins a line of properties of the body before.
const PROPERTIES: &str = "ma";

/// Reads a scene. All errors are reported at once.
pub(crate) fn read(text: &str, options: &ImportOptions) -> Result<ImportedScene, Diagnostics> {
    let mut reader = MiniRtReader {
        draft: Draft::new(options),
        body: None,
        ambient: None,
        camera: None,
        resolution: None,
        places: NotePlaces::default(),
    };
    for mut words in lines(text) {
        if let Some(word) = words.first_mut() {
            word.text = usual_name(word.text);
        }
        match words.first() {
            Some(word) if word.text != PROPERTIES && !ELEMENTS.contains(&word.text) => {
                reader.end_body();
                reader.unknown(word);
            }
            _ => {
                if let Some(arguments) = Arguments::new(words, text, &mut reader.draft) {
                    reader.element(arguments);
                }
            }
        }
    }
    reader.end_body();
    reader.finish(text)
}

/// What the subject calls an element that some programs call otherwise.
fn usual_name(word: &str) -> &str {
    match word {
        "tri" => "tr",
        word if CONES.contains(&word) => "co",
        word => word,
    }
}

/// A body whose material is still to be told: properties may follow on the next line.
struct OpenBody {
    shape: BodyShape,
    placement: Placement,
    /// The other half of a shape without end, which has the same material.
    other_half: Option<Placement>,
    color: Color,
    finish: Finish,
    span: Range<usize>,
}

/// Where the camera looks from, in which direction, and how wide.
struct View {
    position: DVec3,
    direction: DVec3,
    degrees: Spanned<f64>,
}

/// The first places of what can be read in several ways; each is said once.
#[derive(Default)]
pub(super) struct NotePlaces {
    cylinder: Option<Range<usize>>,
    pub(super) cone: Option<Range<usize>>,
    pub(super) endless_cone: Option<Range<usize>>,
    square: Option<Range<usize>>,
    reflection: Option<Range<usize>>,
    highlight: Option<Range<usize>>,
    checker: Option<Range<usize>>,
}

/// A scene that is being read.
pub(super) struct MiniRtReader {
    pub(super) draft: Draft,
    body: Option<OpenBody>,
    ambient: Option<Range<usize>>,
    /// Where the first camera stands, and what it is if it could be read.
    camera: Option<(Range<usize>, Option<View>)>,
    resolution: Option<(Range<usize>, Option<[u32; 2]>)>,
    pub(super) places: NotePlaces,
}

impl MiniRtReader {
    fn element(&mut self, mut arguments: Arguments<'_>) {
        let element = arguments.element.text;
        if element == PROPERTIES {
            return self.properties(arguments);
        }
        self.end_body();
        match element {
            "R" => self.resolution(&mut arguments),
            "A" => self.ambient(&mut arguments),
            "C" | "c" => self.camera(&mut arguments),
            "L" | "l" => self.light(&mut arguments),
            "sp" => self.sphere(&mut arguments),
            "pl" => self.plane(&mut arguments),
            "cy" => self.cylinder(&mut arguments),
            "co" => self.cone(&mut arguments),
            "sq" => self.square(&mut arguments),
            _ => self.triangle(&mut arguments),
        }
        let draft = &mut self.draft;
        for word in std::mem::take(&mut arguments.properties) {
            draft.refuse(&word.span, Message::NotANumber { word: word.text.to_owned() }, None);
        }
        arguments.end(draft);
    }

    fn unknown(&mut self, word: &Word<'_>) {
        let message = Message::NoElement { word: word.text.to_owned() };
        if self.draft.options.is_approximate {
            return self.draft.unsupported(&word.span, message, Message::LeftOut);
        }
        let finding = Diagnostic::said(Severity::Error, word.span.clone(), message);
        let finding = match nearest(word.text, ELEMENTS) {
            Some(near) => finding.labeled(Message::DidYouMean { word: near.to_owned() }),
            None => finding,
        };
        self.draft.push(finding.helped(Message::ElementsAre { elements: ELEMENTS.join(", ") }));
    }

    /// Whether this is the first element of its kind; another one is an error.
    fn is_first(first: Option<&Range<usize>>, arguments: &Arguments<'_>, draft: &mut Draft) -> bool {
        let Some(first) = first else { return true };
        let message = Message::ElementTwice { element: arguments.name() };
        if draft.options.is_approximate {
            draft.unsupported(&arguments.element.span, message, Message::LeftOut);
            return false;
        }
        let finding = Diagnostic::said(Severity::Error, arguments.element.span.clone(), message);
        draft.push(finding.related_to(first.clone(), Message::FirstTime));
        false
    }

    fn resolution(&mut self, arguments: &mut Arguments<'_>) {
        let first = self.resolution.as_ref().map(|(span, _)| span);
        let is_first = Self::is_first(first, arguments, &mut self.draft);
        let mut side = |argument| {
            let side = arguments.number(argument, [1.0, 65535.0], &mut self.draft)?;
            Some(side.value as u32)
        };
        let size = side(Argument::Width).and_then(|width| Some([width, side(Argument::PictureHeight)?]));
        if is_first {
            self.resolution = Some((arguments.element.span.clone(), size));
        }
    }

    fn ambient(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let is_first = Self::is_first(self.ambient.as_ref(), arguments, draft);
        let ratio = arguments.nearest(Argument::Ratio, [0.0, 1.0], draft);
        let color = arguments.color(draft);
        if let (true, Some(ratio), Some(color)) = (is_first, ratio, color) {
            draft.scene.environment.ambient = color.value.to_array().map(|value| value * ratio.value).into();
            draft.note(&color.span, Message::CodesAreLight, Some(Message::ToneCurveHelp));
        }
        self.ambient.get_or_insert(arguments.element.span.clone());
    }

    fn camera(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let position = arguments.point(Argument::Position, draft);
        let direction = arguments.direction(Argument::Direction, draft);
        let degrees = arguments.nearest(Argument::FieldOfView, [0.001, 179.9], draft);
        let view = position.zip(direction).zip(degrees).map(|((position, direction), degrees)| View {
            position: position.value,
            direction: direction.value,
            degrees,
        });
        match &self.camera {
            None => self.camera = Some((arguments.element.span.clone(), view)),
            // The older subject has a list of cameras.
            Some(_) if arguments.element.text == "c" => draft.warn(&arguments.span, Message::OtherCamera),
            Some((first, _)) => {
                Self::is_first(Some(first), arguments, draft);
            }
        }
    }

    fn light(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let position = arguments.point(Argument::Position, draft);
        let brightness = arguments.number(Argument::Brightness, [0.0, 1e6], draft);
        if let Some(Spanned { value, span }) = brightness.as_ref().filter(|brightness| brightness.value > 1.0)
        {
            let message = out_of_range(Argument::Brightness, *value, [0.0, 1.0]);
            draft.unsupported(span, message, Message::TakenAsItIs);
        }
        let color = if arguments.has_point() {
            arguments.color(draft).map(|color| color.value)
        } else {
            Some(Color::WHITE)
        };
        if let (Some(position), Some(brightness), Some(color)) = (position, brightness, color) {
            let light =
                Light { position: position.value, color, intensity: brightness.value, ..Light::default() };
            draft.light(light, &arguments.span);
        }
    }

    fn sphere(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let center = arguments.point(Argument::Position, draft);
        let diameter = arguments.size(Argument::Diameter, draft);
        let color = arguments.color(draft);
        let radius = diameter.map(|diameter| draft.options.dialect.radius(diameter.value));
        let geometry = center
            .zip(radius)
            .map(|(center, radius)| (plain(Shape::Sphere { radius }), Placement::at(center.value)));
        self.open_body(geometry, None, color, arguments);
    }

    fn plane(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let point = arguments.point(Argument::Position, draft);
        let normal = arguments.direction(Argument::Normal, draft);
        let color = arguments.color(draft);
        let geometry =
            point.zip(normal).map(|(point, normal)| (plain(Shape::Plane), turned(point.value, normal.value)));
        self.open_body(geometry, None, color, arguments);
    }

    fn cylinder(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let position = arguments.point(Argument::Position, draft);
        let axis = arguments.direction(Argument::Axis, draft);
        let diameter = arguments.size(Argument::Diameter, draft);
        let height = arguments.size(Argument::Height, draft);
        let color = arguments.color(draft);
        let dialect = draft.options.dialect;
        let geometry =
            position.zip(axis).zip(diameter.zip(height)).map(|((position, axis), (diameter, height))| {
                let (position, axis, height) = (position.value, axis.value, height.value);
                let base =
                    if dialect.is_cylinder_at_base { position } else { position - 0.5 * height * axis };
                let anchor = Anchor::Axis { base, top: base + height * axis };
                let shape = Shape::Cylinder { radius: dialect.radius(diameter.value), height };
                (plain(shape), Placement { anchor, scale: DVec3::ONE })
            });
        if geometry.is_some() {
            self.places.cylinder.get_or_insert(arguments.span.clone());
        }
        self.open_body(geometry, None, color, arguments);
    }

    fn square(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let center = arguments.point(Argument::Position, draft);
        let normal = arguments.direction(Argument::Normal, draft);
        let side = arguments.size(Argument::Side, draft);
        let color = arguments.color(draft);
        let geometry = center.zip(normal).zip(side).map(|((center, normal), side)| {
            let square = Rectangle { width: side.value, length: side.value, ..Rectangle::default() };
            let shape = BodyShape::Parametric(ParametricShape::Rectangle(square));
            (shape, turned(center.value, normal.value))
        });
        self.places.square.get_or_insert(arguments.span.clone());
        self.open_body(geometry, None, color, arguments);
    }

    fn triangle(&mut self, arguments: &mut Arguments<'_>) {
        let draft = &mut self.draft;
        let corners = [(); 3].map(|()| arguments.point(Argument::Corner, draft));
        let color = arguments.color(draft);
        let [a, b, c] = corners.map(|corner| corner.map(|corner| corner.value));
        let corners = a.zip(b).zip(c).map(|((a, b), c)| [a, b, c]);
        let geometry = corners.map(triangle_at);
        self.open_body(geometry, None, color, arguments);
    }

    /// Takes a body, with the other half of one without end, and the properties behind its arguments.
    pub(super) fn open_body(
        &mut self,
        geometry: Option<(BodyShape, Placement)>,
        other_half: Option<Placement>,
        color: Option<Spanned<Color>>,
        arguments: &mut Arguments<'_>,
    ) {
        let mut finish = Finish::default();
        finish.read(arguments, &mut self.draft);
        let Some(((shape, placement), color)) = geometry.zip(color) else { return };
        let span = arguments.span.clone();
        self.body = Some(OpenBody { shape, placement, other_half, color: color.value, finish, span });
    }

    /// A line of properties belongs to the body before it.
    fn properties(&mut self, mut arguments: Arguments<'_>) {
        match &mut self.body {
            Some(body) => body.finish.read(&mut arguments, &mut self.draft),
            // An error of the body, or of what stands before, is reported already.
            None if self.draft.has_errors() || self.draft.options.is_approximate => {}
            None => self.draft.error(&arguments.span, Message::NoBodyBefore),
        }
    }

    fn end_body(&mut self) {
        let Some(body) = self.body.take() else { return };
        let OpenBody { shape, placement, other_half, color, finish, span } = body;
        let places = &mut self.places;
        for (place, is_so) in [
            (&mut places.reflection, finish.reflects()),
            (&mut places.highlight, finish.has_highlight()),
            (&mut places.checker, finish.is_checkered()),
        ] {
            if is_so {
                place.get_or_insert(span.clone());
            }
        }
        let material = MaterialChoice::Inline(Box::new(finish.material(color, self.draft.options.dialect)));
        let body = Body { placement, material, ..Body::of_shape(shape) };
        match other_half {
            Some(placement) => {
                self.draft.endless_body(Body { placement, ..body.clone() }, &span);
                self.draft.endless_body(body, &span);
            }
            None => self.draft.body(body, &span),
        }
    }

    fn finish(mut self, text: &str) -> Result<ImportedScene, Diagnostics> {
        let start = if text.starts_with('\u{feff}') { 3 } else { 0 };
        let draft = &mut self.draft;
        let place = start..start;
        if self.ambient.is_none() {
            let message = Message::ElementMissing { element: "A" };
            if draft.options.is_approximate {
                draft.unsupported(&place, message, Message::NoAmbientLight);
            } else {
                let usage = super::arguments::usage("A").unwrap_or_default().to_owned();
                draft.error_with_help(&place, message, Message::Write { usage });
            }
        }
        let has_camera = self.camera.as_ref().is_some_and(|(_, view)| view.is_some());
        if !has_camera && (self.camera.is_none() || draft.options.is_approximate) {
            draft.lacks_camera(&place, Message::ElementMissing { element: "C" });
        }
        if let Some((_, Some(size))) = self.resolution {
            draft.size.get_or_insert(size);
        }
        if let Some((span, Some(view))) = self.camera.take() {
            look(draft, &span, &view);
        }
        self.notes();
        let mut draft = self.draft;
        if draft.options.dialect.is_left_handed {
            mirror(&mut draft);
        }
        draft.finish(text)
    }

    fn notes(&mut self) {
        let (draft, places) = (&mut self.draft, &self.places);
        let dialect = draft.options.dialect;
        if let Some(span) = &places.cylinder {
            let message =
                if dialect.is_cylinder_at_base { Message::CylinderAtBase } else { Message::CylinderAtCenter };
            draft.note(span, message, (!dialect.is_cylinder_at_base).then(|| dialect_help("base")));
        }
        if let Some(span) = &places.cone {
            let message = if dialect.is_cone_at_base { Message::ConeAtBase } else { Message::ConeAtApex };
            draft.note(span, message, (!dialect.is_cone_at_base).then(|| dialect_help("cone-base")));
        }
        for (span, is_endless) in [(&places.cone, false), (&places.endless_cone, true)] {
            if let Some(span) = span {
                let numbers = dialect.cone_numbers();
                let message = if is_endless {
                    Message::ConeOfAngle { far: FAR.into() }
                } else {
                    Message::ConeNumbers { numbers }
                };
                draft.note(span, message, (!is_endless).then_some(Message::ConeDialects));
            }
        }
        if let Some(span) = &places.square {
            draft.note(span, Message::SquareIsTurned, None);
        }
        if let Some(span) = &places.reflection {
            let message = if dialect.has_added_reflection {
                Message::ReflectionAdds
            } else {
                Message::ReflectionBlends
            };
            draft.note(
                span,
                message,
                (!dialect.has_added_reflection).then(|| dialect_help("added-reflection")),
            );
        }
        if let Some(span) = &places.highlight {
            draft.note(span, Message::HighlightIsLight, None);
        }
        if let Some(span) = &places.checker {
            draft.note(span, Message::CheckerOfBody, None);
        }
    }
}

fn dialect_help(word: &str) -> Message {
    Message::OtherDialect { word: word.to_owned() }
}

fn look(draft: &mut Draft, span: &Range<usize>, view: &View) {
    let size = draft.size.unwrap_or(DEFAULT_SIZE);
    let dialect = draft.options.dialect;
    let degrees = view.degrees.value;
    let fov_degrees =
        if dialect.has_vertical_fov { degrees } else { vertical_from_horizontal(degrees, size) };
    let [width, height] = size.map(|side| side.to_string());
    let note = if dialect.has_vertical_fov {
        (Message::VerticalFov, None)
    } else {
        (Message::HorizontalFov { width, height }, Some(dialect_help("vertical-fov")))
    };
    draft.note(&view.degrees.span, note.0, note.1);
    if !dialect.is_left_handed {
        draft.note(span, Message::RightHanded, Some(dialect_help("left-handed")));
    }
    draft.camera_span = span.clone();
    draft.scene.camera = Camera {
        position: view.position,
        target: view.position + view.direction,
        up: up_for(view.direction),
        projection: Projection::Perspective { fov_degrees },
    };
}

/// A shape of one piece.
fn plain(shape: Shape) -> BodyShape {
    BodyShape::Plain(shape)
}

/// A frame at `origin` whose +Y is turned to `normal` along the shortest arc.
fn turned(origin: DVec3, normal: DVec3) -> Placement {
    let rotation_degrees = rotation_degrees(DQuat::from_rotation_arc(DVec3::Y, normal));
    Placement { anchor: Anchor::Frame { position: origin, rotation_degrees }, scale: DVec3::ONE }
}

/// Turns z around: what is left-handed becomes right-handed. A mirrored shape is the shape mirrored back in x.
fn mirror(draft: &mut Draft) {
    let mirror = |point: &mut DVec3| point.z = -point.z;
    let camera = &mut draft.scene.camera;
    [&mut camera.position, &mut camera.target, &mut camera.up].into_iter().for_each(mirror);
    for light in &mut draft.scene.lights {
        mirror(&mut light.position);
    }
    for body in draft.bodies_mut() {
        match &mut body.placement.anchor {
            // Turns about x and y change their sense.
            Anchor::Frame { position, rotation_degrees } => {
                mirror(position);
                rotation_degrees.x = 0.0 - rotation_degrees.x;
                rotation_degrees.y = 0.0 - rotation_degrees.y;
            }
            Anchor::Axis { base, top } => [base, top].into_iter().for_each(mirror),
        }
        body.change_shape(|shape| {
            for corner in ["a", "b", "c"] {
                if let Some(mut point) = shape.vector(corner) {
                    mirror(&mut point);
                    shape.set_vector(corner, point);
                }
            }
        });
    }
}
