//! Patterns of *The Ray Tracer Challenge*: read as the book defines them, and written so that they come back.

use catoptric_exchange::{ExportOptions, ForeignFormat, ImportOptions, write};
use catoptric_scene::{
    Anchor, Body, Color, Light, MaterialChoice, Pattern, PatternSpace, Phong, Placement, Scene, Shape,
    SolidKind, SolidTexture,
};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;

use crate::common::{bad, good};

const FORMAT: ForeignFormat = ForeignFormat::Challenge;
const HEAD: &str = "- add: camera\n  width: 4\n  height: 2\n  field-of-view: 1\n  from: [0, 0, -5]\n  \
                    to: [0, 0, 0]\n  up: [0, 1, 0]\n- add: light\n  at: [0, 50, 0]\n  intensity: [1, 1, 1]\n";
/// Points this near to a border of cells are on either side of it.
const BORDER: f64 = 1e-4;

/// A pattern of the book; its colors are grays.
#[derive(Clone, Debug)]
struct BookPattern {
    kind: SolidKind,
    turn: DVec3,
    scale: DVec3,
    shift: DVec3,
    colors: [f64; 2],
    within: [Option<Box<Self>>; 2],
}

impl BookPattern {
    /// As the file has it; `indent` stands in front of its keys.
    fn text(&self, indent: &str) -> String {
        let name = match self.kind {
            SolidKind::Checker => "checkers",
            SolidKind::Stripes => "stripes",
            SolidKind::Rings => "ring",
            SolidKind::Gradient => "gradient",
        };
        let mut text = format!("{indent}type: {name}\n{indent}colors:\n");
        for (color, inner) in self.colors.iter().zip(&self.within) {
            match inner {
                Some(inner) => {
                    let inner = inner.text(&format!("{indent}    "));
                    text += &format!("{indent}  - {}", inner.trim_start());
                }
                None => text += &format!("{indent}  - [{color}, {color}, {color}]\n"),
            }
        }
        let Self { turn, scale, shift, .. } = *self;
        text += &format!("{indent}transform:\n");
        for (name, numbers) in [("scale", scale), ("translate", shift)] {
            text += &format!("{indent}  - [{name}, {}, {}, {}]\n", numbers.x, numbers.y, numbers.z);
            if name == "scale" {
                for (axis, angle) in [("x", turn.x), ("y", turn.y), ("z", turn.z)] {
                    text += &format!("{indent}  - [rotate-{axis}, {angle}]\n");
                }
            }
        }
        text
    }

    fn transform(&self) -> DAffine3 {
        DAffine3::from_translation(self.shift)
            * DAffine3::from_rotation_z(self.turn.z)
            * DAffine3::from_rotation_y(self.turn.y)
            * DAffine3::from_rotation_x(self.turn.x)
            * DAffine3::from_scale(self.scale)
    }

    /// The gray at a point of the space around it (Buck 2019, chapter 10); `None` near a border.
    fn at(&self, outer: DVec3) -> Option<f64> {
        let point = self.transform().inverse().transform_point3(outer);
        let share = share(self.kind, point)?;
        let gray = |side: usize| match &self.within[side] {
            Some(inner) => inner.at(point),
            None => Some(self.colors[side]),
        };
        mixed(share, || gray(0), || gray(1))
    }
}

/// The share of the second color; `None` near a border.
fn share(kind: SolidKind, at: DVec3) -> Option<f64> {
    let cell = |x: f64| ((x - x.round()).abs() > BORDER).then(|| x.floor().rem_euclid(2.0));
    Some(match kind {
        SolidKind::Checker => (cell(at.x)? + cell(at.y)? + cell(at.z)?).rem_euclid(2.0),
        SolidKind::Stripes => cell(at.x)?,
        SolidKind::Rings => cell(at.x.hypot(at.z))?,
        SolidKind::Gradient => cell(at.x).map(|_| at.x - at.x.floor())?,
    })
}

fn mixed(share: f64, first: impl Fn() -> Option<f64>, second: impl Fn() -> Option<f64>) -> Option<f64> {
    Some(match share {
        0.0 => first()?,
        1.0 => second()?,
        _ => (1.0 - share) * first()? + share * second()?,
    })
}

/// The gray of a body at a point of the world.
fn gray_of(scene: &Scene, body: &Body, at: DVec3) -> Option<f64> {
    fn of(first: f64, solid: Option<&SolidTexture>, body: &Body, at: DVec3) -> Option<f64> {
        let Some(solid) = solid else { return Some(first) };
        let space = match solid.space {
            PatternSpace::World => DAffine3::IDENTITY,
            PatternSpace::Body => {
                let translation = body.placement.origin();
                DAffine3 { matrix3: body.placement.rotation(), translation }
            }
        };
        let cells = (space * solid.placement().world_from_body()).inverse().transform_point3(at) / solid.size;
        mixed(
            share(solid.kind, cells)?,
            || of(first, solid.first.as_deref(), body, at),
            || of(solid.color.r, solid.second.as_deref(), body, at),
        )
    }
    let pattern = scene.material(&body.material).unwrap().pattern().unwrap();
    of(pattern.color.r, pattern.solid.as_ref(), body, at)
}

fn three(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(range).prop_map(DVec3::from)
}

/// Scaled evenly within others, so that nothing is sheared.
fn book_pattern(is_even: bool) -> BoxedStrategy<BookPattern> {
    let kind = prop::sample::select(SolidKind::ALL.to_vec());
    let scale = prop_oneof![(0.2..1.5_f64).prop_map(DVec3::splat), three(0.2..1.5)]
        .prop_map(move |scale| if is_even { DVec3::splat(scale.x) } else { scale });
    (kind, three(-3.0..3.0), scale, three(-1.0..1.0), prop::array::uniform2(0.0..1.0_f64))
        .prop_map(|(kind, turn, scale, shift, colors)| BookPattern {
            kind,
            turn,
            scale,
            shift,
            colors,
            within: [None, None],
        })
        .boxed()
}

fn nested() -> impl Strategy<Value = BookPattern> {
    book_pattern(true).prop_recursive(2, 4, 2, |inner| {
        let within = || prop::option::of(inner.clone().prop_map(Box::new));
        (inner.clone(), within(), within())
            .prop_map(|(outer, first, second)| BookPattern { within: [first, second], ..outer })
    })
}

fn solid() -> impl Strategy<Value = SolidTexture> {
    let kind = prop::sample::select(SolidKind::ALL.to_vec());
    let space = prop::sample::select(PatternSpace::ALL.to_vec());
    let leaf = (kind, space, 0.0..1.0_f64, 0.2..1.5_f64, three(-1.0..1.0), three(-180.0..180.0)).prop_map(
        |(kind, space, gray, size, position, rotation_degrees)| SolidTexture {
            size,
            space,
            position,
            rotation_degrees,
            ..SolidTexture::new(kind, Color::gray(gray))
        },
    );
    leaf.prop_recursive(2, 4, 2, |inner| {
        let within = || prop::option::of(inner.clone().prop_map(Box::new));
        (inner.clone(), within(), within()).prop_map(|(outer, first, second)| SolidTexture {
            first,
            second,
            ..outer
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn patterns_are_those_of_the_book(
        pattern in prop_oneof![book_pattern(false), nested()],
        turn in -3.0..3.0_f64,
        scale in 0.3..2.0_f64,
        points in prop::collection::vec(three(-1.0..1.0), 30),
    ) {
        let text = format!(
            "{HEAD}- add: sphere\n  transform:\n    - [scale, {scale}, {scale}, {scale}]\n    - [rotate-y, {turn}]\n    \
             - [translate, 0.3, 0.2, -0.1]\n  material:\n    pattern:\n{}",
            pattern.text("      ")
        );
        let found = good(FORMAT, &text, &ImportOptions::default());
        let body = found.scene.bodies.to_vec()[0].clone();
        let world_from_object = DAffine3::from_translation(DVec3::new(0.3, 0.2, -0.1))
            * DAffine3::from_rotation_y(turn)
            * DAffine3::from_scale(DVec3::splat(scale));
        for point in points {
            // Z is turned around.
            let at = world_from_object.transform_point3(point) * DVec3::new(1.0, 1.0, -1.0);
            if let (Some(own), Some(book)) = (gray_of(&found.scene, &body, at), pattern.at(point)) {
                prop_assert!((own - book).abs() < 1e-6, "{} at {}, {} not {}", text, point, own, book);
            }
        }
    }

    #[test]
    fn patterns_come_back(
        solid in solid(),
        gray in 0.0..1.0_f64,
        turn in three(-180.0..180.0),
        points in prop::collection::vec(three(-1.0..1.0), 30),
    ) {
        let pattern = Pattern { solid: Some(solid), ..Color::gray(gray).into() };
        let anchor = Anchor::Frame { position: DVec3::new(0.5, 1.0, -2.0), rotation_degrees: turn };
        let body = Body {
            shape: Shape::Cylinder { radius: 0.7, height: 1.5 },
            placement: Placement { anchor, scale: DVec3::ONE },
            material: MaterialChoice::own(Phong { pattern, ambient: 0.0, ..Phong::default() }),
            ..Body::default()
        };
        let mut scene =
            Scene { bodies: [body.clone()].into(), lights: vec![Light::default()], ..Scene::default() };
        scene.environment.background = Color::BLACK;
        scene.environment.ambient = Color::BLACK;
        let written = write(FORMAT, &scene, &ExportOptions::default()).unwrap();
        let found = good(FORMAT, &written.text, &ImportOptions::default());
        let other = found.scene.bodies.to_vec()[0].clone();
        for point in points {
            let at = body.placement.origin() + point;
            let grays = (gray_of(&scene, &body, at), gray_of(&found.scene, &other, at));
            if let (Some(own), Some(read)) = grays {
                prop_assert!((own - read).abs() < 1e-5, "at {}: {} not {}\n{}", at, read, own, written.text);
            }
        }
    }
}

#[test]
fn what_is_no_pattern_is_refused() {
    let pattern = |lines: &str| {
        format!("{HEAD}- add: cube\n  transform:\n    - [scale, 1, 2, 1]\n  material:\n    pattern:\n{lines}")
    };
    let sheared = "      type: checkers\n      colors: [[1, 1, 1], [0, 0, 0]]\n      transform:\n        - [rotate-z, 0.5]\n";
    assert!(bad(FORMAT, &pattern(sheared)).contains("not at right angles"));
    // Along one axis any map is a turned one.
    good(FORMAT, &pattern(&sheared.replace("checkers", "stripes")), &ImportOptions::default());
    let three = "      type: stripes\n      colors: [[1, 1, 1], [0, 0, 0], [1, 0, 0]]\n";
    assert!(bad(FORMAT, &pattern(three)).contains("the pattern `stripes` has 2 colors, not 3"));
    // Definitions that name each other have no end.
    let endless = "      type: stripes\n      colors: [again, again]\n";
    let defined = format!(
        "- define: again\n  value:\n    type: ring\n    colors: [again, again]\n{}",
        pattern(endless)
    );
    assert!(bad(FORMAT, &defined).contains("4 levels deep"));
}
