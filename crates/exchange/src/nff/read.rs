//! Reading NFF.

use std::ops::Range;

use catoptric_scene::{
    Anchor, Body, BodyShape, Camera, Color, Diagnostics, Expansion, Light, Material, MaterialChoice,
    OpenCone, OpenCylinder, ParametricShape, Pattern, Phong, Placement, Projection, Shape, VisibleSide,
    rotation_degrees,
};
use glam::{DQuat, DVec3};

use crate::draft::Draft;
use crate::lines::{MOST_WORDS, Word, lines, number};
use crate::message::Message;
use crate::options::{ImportOptions, ImportedScene};
use crate::triangle::triangle_at;

/// The most corners of a polygon.
const MOST_CORNERS: usize = 10_000;
/// The lines of a view, in their order.
const VIEW: [(&str, &str, usize); 6] = [
    ("from", "from x y z", 3),
    ("at", "at x y z", 3),
    ("up", "up x y z", 3),
    ("angle", "angle degrees", 1),
    ("hither", "hither distance", 1),
    ("resolution", "resolution width height", 2),
];

/// Reads a scene. All errors are reported at once.
pub(crate) fn read(text: &str, options: &ImportOptions) -> Result<ImportedScene, Diagnostics> {
    let mut reader = NffReader {
        draft: Draft::new(options),
        fill: None,
        view: None,
        last_side: None,
        colorless: Vec::new(),
    };
    let mut lines = lines(text);
    while let Some(line) = lines.next() {
        reader.record(&line, &mut lines);
    }
    reader.finish(text)
}

struct NffReader {
    draft: Draft,
    /// The material of what follows.
    fill: Option<Phong>,
    /// Where the first view stands, and whether it could be read.
    view: Option<(Range<usize>, bool)>,
    /// What the other side of the last surface would be, which is the body of this index.
    last_side: Option<(usize, Vec<f64>)>,
    /// Lights whose color follows from their number.
    colorless: Vec<(usize, Range<usize>)>,
}

impl NffReader {
    fn record<'t>(&mut self, line: &[Word<'t>], rest: &mut impl Iterator<Item = Vec<Word<'t>>>) {
        let Some(first) = line.first() else { return };
        if line.len() > MOST_WORDS {
            self.draft.refuse(&first.span, Message::LineTooLong { most: MOST_WORDS.to_string() }, None);
            return;
        }
        let span = first.span.start..line.last().map_or(first.span.end, |last| last.span.end);
        match first.text {
            "v" => self.view(&span, rest),
            "b" => {
                if let Some(&[r, g, b]) = self.numbers(line, "b", &[3], &span).as_deref() {
                    self.draft.scene.environment.background = Color::new(r, g, b);
                }
            }
            "l" => self.light(line, &span),
            "f" => self.fill(line, &span),
            "s" => self.sphere(line, &span),
            "c" => self.cone(line, &span, rest),
            "p" | "pp" => self.polygon(line, &span, rest),
            word => {
                let message = Message::NoRecord { word: word.to_owned() };
                self.draft.refuse(&first.span, message, Some(Message::RecordsAre));
            }
        }
    }

    /// The numbers behind the first word, as many as one of `counts`.
    fn numbers(
        &mut self,
        line: &[Word<'_>],
        record: &'static str,
        counts: &[usize],
        span: &Range<usize>,
    ) -> Option<Vec<f64>> {
        self.all_numbers(line.get(1..).unwrap_or_default(), record, counts, span)
    }

    fn all_numbers(
        &mut self,
        words: &[Word<'_>],
        record: &'static str,
        counts: &[usize],
        span: &Range<usize>,
    ) -> Option<Vec<f64>> {
        let mut found = Vec::new();
        for word in words {
            match number(word.text) {
                Some(value) => found.push(value),
                None => {
                    self.draft.refuse(&word.span, Message::NotANumber { word: word.text.to_owned() }, None);
                    return None;
                }
            }
        }
        if counts.contains(&found.len()) {
            return Some(found);
        }
        let count = counts.iter().map(usize::to_string).collect::<Vec<_>>().join(" / ");
        self.draft.refuse(span, Message::RecordCount { record, count }, None);
        None
    }

    fn view<'t>(&mut self, span: &Range<usize>, rest: &mut impl Iterator<Item = Vec<Word<'t>>>) {
        let is_second = self.view.is_some();
        if is_second {
            self.draft.refuse(span, Message::ViewTwice, None);
        }
        self.view.get_or_insert((span.clone(), false));
        let mut values: Vec<f64> = Vec::new();
        for (name, expected, count) in VIEW {
            let line = rest.next().unwrap_or_default();
            let place = line.first().map_or(span, |word| &word.span).clone();
            if line.first().is_none_or(|word| word.text != name) {
                self.draft.refuse(&place, Message::RecordLine { expected }, None);
                return;
            }
            let Some(numbers) = self.numbers(&line, name, &[count], &place) else { return };
            values.extend(numbers);
        }
        let &[fx, fy, fz, ax, ay, az, ux, uy, uz, angle, _, width, height] = values.as_slice() else {
            return;
        };
        for (what, value, [low, high]) in [
            ("angle", angle, [0.001, 179.9]),
            ("resolution", width, [1.0, 65535.0]),
            ("resolution", height, [1.0, 65535.0]),
        ] {
            if !self.in_range(what, value, [low, high], span) {
                return;
            }
        }
        if is_second {
            return;
        }
        self.view = Some((span.clone(), true));
        let draft = &mut self.draft;
        draft.size.get_or_insert([width as u32, height as u32]);
        draft.camera_span = span.clone();
        draft.scene.camera = Camera {
            position: DVec3::new(fx, fy, fz),
            target: DVec3::new(ax, ay, az),
            up: DVec3::new(ux, uy, uz),
            projection: Projection::Perspective { fov_degrees: angle },
        };
    }

    fn in_range(
        &mut self,
        what: &'static str,
        value: f64,
        [low, high]: [f64; 2],
        span: &Range<usize>,
    ) -> bool {
        let is_in = (low..=high).contains(&value);
        if !is_in {
            let [value, low, high] = [value, low, high].map(Into::into);
            self.draft.refuse(span, Message::RecordRange { what, value, low, high }, None);
        }
        is_in
    }

    fn light(&mut self, line: &[Word<'_>], span: &Range<usize>) {
        let Some(numbers) = self.numbers(line, "l", &[3, 6], span) else { return };
        let light = match *numbers.as_slice() {
            [x, y, z, r, g, b] => {
                Light { position: DVec3::new(x, y, z), color: Color::new(r, g, b), ..Light::default() }
            }
            [x, y, z] => {
                self.colorless.push((self.draft.scene.lights.len(), span.clone()));
                Light { position: DVec3::new(x, y, z), ..Light::default() }
            }
            _ => return,
        };
        self.draft.light(light, span);
    }

    /// `f red green blue Kd Ks Shine T index`.
    fn fill(&mut self, line: &[Word<'_>], span: &Range<usize>) {
        let Some(numbers) = self.numbers(line, "f", &[8], span) else { return };
        let &[r, g, b, diffuse, specular, shininess, transmission, ior] = numbers.as_slice() else { return };
        let any = [0.0, 1e6];
        let ranges = [
            ("color", r, any),
            ("color", g, any),
            ("color", b, any),
            ("Kd", diffuse, any),
            ("Ks", specular, any),
            ("Shine", shininess, any),
            ("T", transmission, any),
        ];
        if !ranges.into_iter().all(|(what, value, range)| self.in_range(what, value, range, span)) {
            return;
        }
        // An opaque body's index does not matter, and is 0 in many files.
        let ior = if transmission > 0.0 { ior } else { ior.max(1.0) };
        if self.in_range("index", ior, [0.01, 100.0], span) {
            self.fill = Some(Phong {
                pattern: Pattern::from(Color::new(r, g, b)),
                ambient: 0.0,
                diffuse,
                specular,
                shininess,
                reflection: Some(specular),
                transmission,
                ior,
                ..Phong::default()
            });
        }
    }

    /// The material of a body, if one stands before it.
    fn material(&mut self, span: &Range<usize>) -> MaterialChoice {
        if self.fill.is_none() && !self.draft.has_errors() {
            self.draft.error(span, Message::NoFill);
        }
        MaterialChoice::Inline(Box::new(Material::Phong(self.fill.clone().unwrap_or_default())))
    }

    /// Whether a surface of these numbers is the other side of the one before it, which is then seen from both. Else it is
    /// to be a body, with an other side of `mirrored` numbers.
    fn completes(&mut self, numbers: &[f64], mirrored: Vec<f64>) -> bool {
        let fill = self.fill.as_ref();
        let bodies = self.draft.bodies_mut();
        let index = bodies.len();
        let last = self.last_side.replace((index, mirrored));
        let Some((_, body)) = last.zip(bodies.last_mut()).filter(|((last, other), body)| {
            let is_same_fill =
                matches!(&body.material, MaterialChoice::Inline(own) if own.as_phong() == fill);
            last + 1 == index && other == numbers && is_same_fill
        }) else {
            return false;
        };
        body.change_shape(|shape| shape.set_word("visible_side", VisibleSide::Both.key()));
        self.last_side = None;
        true
    }

    fn sphere(&mut self, line: &[Word<'_>], span: &Range<usize>) {
        let Some(numbers) = self.numbers(line, "s", &[4], span) else { return };
        let &[x, y, z, radius] = numbers.as_slice() else { return };
        if radius < 0.0 {
            self.draft.warn(span, Message::NegativeRadius);
        }
        let material = self.material(span);
        let shape = Shape::Sphere { radius: radius.abs() };
        self.draft.body(
            Body { shape, placement: Placement::at(DVec3::new(x, y, z)), material, ..Body::default() },
            span,
        );
    }

    /// `c`, then base and radius, then apex and radius, each on a line of its own or all on one.
    fn cone<'t>(
        &mut self,
        line: &[Word<'t>],
        span: &Range<usize>,
        rest: &mut impl Iterator<Item = Vec<Word<'t>>>,
    ) {
        let mut words = line.get(1..).unwrap_or_default().to_vec();
        for enough in [4, 8] {
            if words.len() < enough {
                words.extend(rest.next().unwrap_or_default());
            }
        }
        let Some(numbers) = self.all_numbers(&words, "c", &[8], span) else { return };
        let &[x, y, z, radius, top_x, top_y, top_z, top_radius] = numbers.as_slice() else { return };
        let (base, top) = (DVec3::new(x, y, z), DVec3::new(top_x, top_y, top_z));
        let material = self.material(span);
        let is_inner = radius < 0.0 || top_radius < 0.0;
        if is_inner && (radius > 0.0 || top_radius > 0.0) {
            return self.draft.refuse(span, Message::MixedRadii, None);
        }
        let mirrored = vec![x, y, z, -radius, top_x, top_y, top_z, -top_radius];
        if self.completes(&numbers, mirrored) {
            return;
        }
        let side = if is_inner { VisibleSide::Inner } else { VisibleSide::Outer };
        let (radius, top_radius) = (radius.abs(), top_radius.abs());
        let height = base.distance(top);
        // An apex is above.
        let (base, top, radius, top_radius) =
            if radius > 0.0 { (base, top, radius, top_radius) } else { (top, base, top_radius, radius) };
        let shape = BodyShape::Parametric(if radius == top_radius {
            ParametricShape::OpenCylinder(OpenCylinder { radius, height, side })
        } else {
            ParametricShape::OpenCone(OpenCone { radius, top_radius, height, side })
        });
        let turn = DQuat::from_rotation_arc(DVec3::Y, (top - base).normalize_or(DVec3::Y));
        let anchor = Anchor::Frame { position: base, rotation_degrees: rotation_degrees(turn) };
        let placement = Placement { anchor, scale: DVec3::ONE };
        self.draft.body(Body { placement, material, ..Body::of_shape(shape) }, span);
    }

    /// `p count` or `pp count`, then the corners, with normals in the latter.
    fn polygon<'t>(
        &mut self,
        line: &[Word<'t>],
        span: &Range<usize>,
        rest: &mut impl Iterator<Item = Vec<Word<'t>>>,
    ) {
        let (record, numbers_of_corner) =
            if line.first().is_some_and(|word| word.text == "pp") { ("pp", 6) } else { ("p", 3) };
        let Some(numbers) = self.numbers(line, record, &[1], span) else { return };
        let count = numbers.first().copied().unwrap_or_default();
        if count.fract() != 0.0 || !(3.0..=MOST_CORNERS as f64).contains(&count) {
            self.draft.refuse(span, Message::PolygonCount { most: MOST_CORNERS.to_string() }, None);
            return;
        }
        let mut corners = Vec::new();
        for _ in 0..count as usize {
            let corner = rest.next().unwrap_or_default();
            let place = corner.first().map_or(span, |word| &word.span).clone();
            let Some(numbers) = self.all_numbers(&corner, record, &[numbers_of_corner], &place) else {
                return;
            };
            corners.extend(numbers.first_chunk().copied().map(DVec3::from_array));
        }
        if numbers_of_corner == 6 {
            self.draft.unsupported(span, Message::NoNormals, Message::IsFlat);
        }
        let material = self.material(span);
        let numbers = |corner: &DVec3| corner.to_array();
        let own: Vec<f64> = corners.iter().flat_map(numbers).collect();
        if self.completes(&own, corners.iter().rev().flat_map(numbers).collect()) {
            return;
        }
        let side = VisibleSide::Outer;
        if let &[a, b, c] = corners.as_slice() {
            let (mut shape, placement) = triangle_at([a, b, c]);
            shape.set_word("visible_side", side.key());
            self.draft.body(Body { placement, material, ..Body::of_shape(shape) }, span);
            return;
        }
        let middle = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
        let own: Vec<DVec3> = corners.iter().map(|corner| corner - middle).collect();
        match Expansion::convex_polygon(&own) {
            Some(Expansion { parts, .. }) => {
                let (shape, placement) = (Shape::Surface { side }, Placement::at(middle));
                self.draft.body(Body { shape, parts, placement, material, ..Body::default() }, span);
            }
            None => {
                let most = (Shape::MAX_PARTS - 2).to_string();
                self.draft.unsupported(span, Message::NoPolygon { most }, Message::LeftOut);
            }
        }
    }

    fn finish(mut self, text: &str) -> Result<ImportedScene, Diagnostics> {
        let draft = &mut self.draft;
        match &self.view {
            Some((span, _)) => {
                draft.note(&span.clone(), Message::LightsAreCodes, Some(Message::ToneCurveHelp));
            }
            None => draft.lacks_camera(&(0..0), Message::NoView),
        }
        if let (Some((span, false)), true) = (&self.view, draft.options.is_approximate) {
            draft.lacks_camera(span, Message::NoView);
        }
        if let Some((_, span)) = self.colorless.first() {
            // Haines: with n lights each has the intensity √n / n.
            let intensity = (draft.scene.lights.len() as f64).sqrt().recip();
            draft.note(span, Message::EqualLights { value: intensity.into() }, None);
            for (index, _) in &self.colorless {
                if let Some(light) = draft.scene.lights.get_mut(*index) {
                    light.intensity = intensity;
                }
            }
        }
        self.draft.finish(text)
    }
}
