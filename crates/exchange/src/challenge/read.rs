//! Reading scenes of the book: a list of things to define and to add.

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use catoptric_scene::{
    BodyPart, Camera, Color, Diagnostics, Light, MaterialChoice, Projection, Shadow, nearest,
};
use glam::{DAffine3, DVec3};

use crate::camera::vertical_from_horizontal;
use crate::challenge::shape::MIRROR;
use crate::challenge::table::{self, Table};
use crate::challenge::yaml::{MOST_DEEP, Node, Value, parse};
use crate::draft::Draft;
use crate::message::Message;
use crate::options::{DEFAULT_SIZE, ImportOptions, ImportedScene};

/// The most parts that definitions may make: bodies, groups and transforms.
const MOST_PARTS: usize = 200_000;
/// What can be added, besides definitions.
/// The most cells along a side of an area light.
const MOST_STEPS: f64 = 32.0;
const SHAPES: [&str; 10] =
    ["camera", "light", "sphere", "plane", "cube", "cylinder", "cone", "triangle", "group", "csg"];
/// What the book has and a scene does not.
const NOT_DRAWN: [&str; 3] = ["obj", "obj-file", "smooth-triangle"];

/// Reads a scene. All errors are reported at once, but for those of the YAML, which end it.
pub(crate) fn read(text: &str, options: &ImportOptions) -> Result<ImportedScene, Diagnostics> {
    let mut reader = ChallengeReader {
        draft: Draft::new(options),
        definitions: HashMap::new(),
        camera: None,
        parts: 0,
        operand: None,
        said: WarningFlags::default(),
    };
    if let Some(root) = parse(text, &mut reader.draft) {
        reader.scene(&root);
    } else if !reader.draft.has_errors() {
        reader.draft.error(&(0..0), Message::NotAScene);
    }
    reader.draft.finish(text)
}

/// What is said once about a file.
#[derive(Default)]
pub(super) struct WarningFlags {
    too_many: bool,
    too_deep: bool,
}

/// The groups and definitions around an object.
#[derive(Clone)]
pub(super) struct ObjectContext {
    world_from_object: DAffine3,
    /// The outermost material counts.
    material: Option<Rc<Node>>,
    depth: usize,
}

/// A scene that is being read.
pub(super) struct ChallengeReader {
    pub(super) draft: Draft,
    definitions: HashMap<String, Rc<Node>>,
    camera: Option<Range<usize>>,
    /// How many parts were made.
    parts: usize,
    /// What an operand of a `csg` consists of so far, while one is read.
    pub(super) operand: Option<Vec<BodyPart>>,
    pub(super) said: WarningFlags,
}

impl ChallengeReader {
    /// The value that was defined under a name.
    pub(super) fn definition(&self, name: &str) -> Option<Rc<Node>> {
        self.definitions.get(name).map(Rc::clone)
    }

    /// A value, or what its name stands for.
    pub(super) fn resolved(&self, node: &Rc<Node>) -> Rc<Node> {
        let defined = node.text().and_then(|name| self.definition(name));
        defined.unwrap_or_else(|| Rc::clone(node))
    }

    /// Counts a part; `None` when there are too many.
    pub(super) fn part(&mut self, span: &Range<usize>) -> Option<()> {
        self.parts += 1;
        if self.parts <= MOST_PARTS {
            return Some(());
        }
        if !std::mem::replace(&mut self.said.too_many, true) {
            self.draft.error(span, Message::TooMuch { most: MOST_PARTS.to_string() });
        }
        None
    }

    /// Reports once that definitions or groups are nested too deep.
    pub(super) fn too_deep<T>(&mut self, span: &Range<usize>) -> Option<T> {
        if !std::mem::replace(&mut self.said.too_deep, true) {
            self.draft.error(span, Message::TooDeep { most: MOST_DEEP.to_string() });
        }
        None
    }

    fn scene(&mut self, root: &Node) {
        let Some(items) = root.list() else {
            self.draft.error(&root.span, Message::NotAScene);
            return;
        };
        for item in items {
            self.item(item);
        }
        self.shade();
        match &self.camera {
            Some(span) => {
                let span = span.clone();
                self.draft.note(&span, Message::Mirrored, None);
                self.draft.note(&span, Message::LightsAreCodes, Some(Message::ToneCurveHelp));
            }
            None => self.draft.lacks_camera(&(root.span.start..root.span.start), Message::NoCamera),
        }
    }

    /// In the book no light passes what is clear (chapter 8).
    fn shade(&mut self) {
        let lets_through = |choice: &MaterialChoice| matches!(choice, MaterialChoice::Inline(material) if material.lets_through().most > 0.0);
        for body in self.draft.bodies_mut() {
            if body.shadow == Shadow::Filtered && body.materials().any(lets_through) {
                body.shadow = Shadow::Full;
            }
        }
    }

    fn item(&mut self, item: &Rc<Node>) {
        let Value::Table(entries) = &item.value else {
            self.draft.refuse(&item.span, Message::NotAScene, None);
            return;
        };
        let has = |name: &str| entries.iter().any(|(key, _)| key.text() == Some(name));
        if has("define") {
            self.define(item);
        } else if has("add") {
            let outer = ObjectContext { world_from_object: DAffine3::IDENTITY, material: None, depth: 0 };
            self.add(item, &outer);
        } else {
            self.draft.refuse(&item.span, Message::NotAddOrDefine, Some(Message::NotAScene));
        }
    }

    fn define(&mut self, item: &Node) {
        let Some(mut table) = Table::open(item, "define", &mut self.draft) else { return };
        let name = table.require(&["define"], &mut self.draft);
        let extend = table.take(&["extend"]);
        let value = table.require(&["value"], &mut self.draft);
        table.end(&mut self.draft);
        let Some((name_node, mut value)) = name.zip(value) else { return };
        let Some(name) = table::name(&name_node, "define", &mut self.draft) else { return };
        if let Some(base) = extend {
            let Some(base_name) = table::name(&base, "extend", &mut self.draft) else { return };
            match self.definition(base_name) {
                Some(base) => value = extended(&base, &value),
                None => self.undefined(base_name, &base.span),
            }
        }
        if self.definitions.insert(name.to_owned(), value).is_some() {
            self.draft.warn(&name_node.span, Message::DefinedTwice { name: name.to_owned() });
        }
    }

    fn undefined(&mut self, name: &str, span: &Range<usize>) {
        let message = Message::Undefined { name: name.to_owned() };
        self.draft.refuse(span, message, Some(Message::DefinedBelow));
    }

    /// Adds what a table describes: a shape, a group, or what a definition stands for.
    pub(super) fn add(&mut self, node: &Rc<Node>, outer: &ObjectContext) -> Option<()> {
        self.part(&node.span)?;
        if outer.depth >= MOST_DEEP {
            return self.too_deep(&node.span);
        }
        let mut table = Table::open(node, "add", &mut self.draft)?;
        // Within others many programs say `type`.
        let name_node = table.require(&["add", "type"], &mut self.draft)?;
        let name = table::name(&name_node, "add", &mut self.draft)?.to_owned();
        table.owner.clone_from(&name);
        match name.as_str() {
            "camera" => {
                let span = table.span.clone();
                if self.camera(table).is_none() && self.draft.options.is_approximate {
                    self.draft.lacks_camera(&span, Message::NoCamera);
                }
                return Some(());
            }
            "light" => return self.light(table),
            _ => {}
        }
        let transform = match table.take(&["transform"]) {
            Some(transform) => self.transform(&transform)?,
            None => DAffine3::IDENTITY,
        };
        let material = table.take(&["material"]);
        let context = ObjectContext {
            world_from_object: outer.world_from_object * transform,
            material: outer.material.clone().or(material.map(|material| self.resolved(&material))),
            depth: outer.depth + 1,
        };
        let shadow = table.take(&["shadow"]);
        let bodies_before = self.draft.bodies_mut().len();
        self.object(&name, table, &context, &name_node.span)?;
        let shadow = shadow.filter(|shadow| table::flag(shadow, "shadow", &mut self.draft) == Some(false));
        if let Some(shadow) = shadow {
            if self.operand.is_some() {
                self.draft.unsupported(&shadow.span, Message::OperandShadow, Message::ThrowsShadow);
            }
            for body in self.draft.bodies_mut().iter_mut().skip(bodies_before) {
                body.shadow = Shadow::None;
            }
        }
        Some(())
    }

    fn object(
        &mut self,
        name: &str,
        mut table: Table,
        context: &ObjectContext,
        span: &Range<usize>,
    ) -> Option<()> {
        if name == "group" {
            let children = table.take(&["children"]);
            table.end(&mut self.draft);
            if let Some(children) = children {
                for child in table::list(&children, "children", &mut self.draft)? {
                    self.add(child, context);
                }
            }
            return Some(());
        }
        if name == "csg" {
            return self.csg(table, context, span);
        }
        if name == "triangle" {
            let corners = self.corners(&mut table);
            table.end(&mut self.draft);
            if self.operand.is_some() {
                self.draft.unsupported(span, Message::FlatOperand, Message::LeftOut);
            } else if let Some(corners) = corners {
                self.triangle(corners, context.world_from_object, context.material.as_ref(), span);
            }
        } else if let Some(solids) = self.solids(name, &mut table, span) {
            table.end(&mut self.draft);
            for solid in solids {
                let ObjectContext { world_from_object, material, .. } = context;
                self.solid((name, solid), *world_from_object, material.as_ref(), span);
            }
        } else if let Some(defined) = self.definition(name) {
            table.end(&mut self.draft);
            self.add(&defined, context)?;
        } else if NOT_DRAWN.contains(&name) {
            self.draft.unsupported(span, Message::NotDrawn { name: name.to_owned() }, Message::LeftOut);
        } else {
            let names = SHAPES.iter().copied().chain(self.definitions.keys().map(String::as_str));
            let unknown = Message::UnknownShape { name: name.to_owned() };
            if self.draft.options.is_approximate {
                self.draft.unsupported(span, unknown, Message::LeftOut);
                return Some(());
            }
            let help = match nearest(name, names) {
                Some(near) => Message::DidYouMean { word: near.to_owned() },
                None => Message::ShapesAre,
            };
            self.draft.error_with_help(span, unknown, help);
        }
        Some(())
    }

    /// Takes the first camera; `None` if it cannot be read.
    fn camera(&mut self, mut table: Table) -> Option<()> {
        let span = table.span.clone();
        if self.camera.is_some() {
            self.draft.refuse(&span, Message::CameraTwice, None);
            return Some(());
        }
        self.camera = Some(span.clone());
        let draft = &mut self.draft;
        let mut side = |keys: &[&str], draft: &mut Draft| {
            let side = table.number(keys, [1.0, 65535.0], draft)?;
            Some(side as u32)
        };
        let (width, height) = (side(&["width", "hsize"], draft), side(&["height", "vsize"], draft));
        if let Some((width, height)) = width.zip(height) {
            draft.size.get_or_insert([width, height]);
        }
        let fov = table.require(&["field-of-view", "fov"], draft);
        let fov = fov.and_then(|fov| table::number(&fov, "field-of-view", [1e-5, 3.1399], draft));
        let up = table.take(&["up"]);
        let ends = ["from", "to"].map(|key| {
            let node = table.require(&[key], draft)?;
            table::vector(&node, key, draft)
        });
        let up = match up {
            Some(up) => table::vector(&up, "up", draft)?,
            None => DVec3::Y,
        };
        table.end(draft);
        let ([Some(from), Some(to)], Some(fov)) = (ends, fov) else { return None };
        let size @ [width, height] = draft.size.unwrap_or(DEFAULT_SIZE);
        // The book's view transform is scaled by the sine of the angle between the view and `up`: the picture shows more.
        let sine = (to - from).normalize_or_zero().cross(up.normalize_or_zero()).length();
        let half = (0.5 * fov).tan() / if sine > 0.0 { sine } else { 1.0 };
        let degrees = 2.0 * half.atan().to_degrees();
        // The angle belongs to the longer side (Buck 2019, chapter 7).
        let fov_degrees = if width >= height { vertical_from_horizontal(degrees, size) } else { degrees };
        draft.camera_span = span;
        draft.scene.camera = Camera {
            position: MIRROR * from,
            target: MIRROR * to,
            up: MIRROR * up,
            projection: Projection::Perspective { fov_degrees },
        };
        Some(())
    }

    fn light(&mut self, mut table: Table) -> Option<()> {
        let span = table.span.clone();
        let intensity = table.take(&["intensity"]);
        let color = match intensity {
            Some(node) => table::color(&self.resolved(&node), "intensity", &mut self.draft),
            None => None,
        };
        let color = color.unwrap_or(Color::WHITE);
        let draft = &mut self.draft;
        let points = if let Some(corner) = table.take(&["corner"]) {
            let corner = table::vector(&corner, "corner", draft)?;
            let [u, v] = [("uvec", "usteps"), ("vvec", "vsteps")].map(|(side, steps)| {
                let node = table.require(&[side], draft)?;
                let side = table::vector(&node, side, draft)?;
                let count = table.require(&[steps], draft)?;
                let count = table::number(&count, steps, [1.0, MOST_STEPS], draft)?;
                Some((side, count.floor() as u32))
            });
            table.take(&["jitter"]);
            draft.note(&span, Message::AreaLight, None);
            let ((u, u_steps), (v, v_steps)) = u.zip(v)?;
            let middle = |cell: u32, cells: u32| (f64::from(cell) + 0.5) / f64::from(cells);
            let cells = (0..v_steps).flat_map(|y| (0..u_steps).map(move |x| (x, y)));
            cells.map(|(x, y)| corner + middle(x, u_steps) * u + middle(y, v_steps) * v).collect()
        } else {
            let node = table.require(&["at", "position"], draft)?;
            vec![table::vector(&node, "at", draft)?]
        };
        table.end(draft);
        // The book adds the ambient term for each light, in its color (Buck 2019, chapter 6).
        let sum = DVec3::from_array(draft.scene.environment.ambient.to_array())
            + DVec3::from_array(color.to_array());
        draft.scene.environment.ambient = sum.to_array().into();
        let intensity = 1.0 / points.len() as f64;
        for point in points {
            draft.light(Light { position: MIRROR * point, color, intensity, ..Light::default() }, &span);
        }
        Some(())
    }
}

/// A definition with the keys, or the elements, of the one that it extends.
fn extended(base: &Rc<Node>, own: &Rc<Node>) -> Rc<Node> {
    let value = match (&base.value, &own.value) {
        (Value::Table(base), Value::Table(own)) => {
            let is_kept = |key: &Rc<Node>| !own.iter().any(|(other, _)| other.text() == key.text());
            let kept = base.iter().filter(|(key, _)| is_kept(key));
            Value::Table(kept.chain(own).map(|(key, value)| (Rc::clone(key), Rc::clone(value))).collect())
        }
        (Value::List(base), Value::List(own)) => Value::List(base.iter().chain(own).map(Rc::clone).collect()),
        _ => return Rc::clone(own),
    };
    Rc::new(Node { value, span: own.span.clone() })
}
