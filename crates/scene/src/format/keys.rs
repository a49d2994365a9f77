//! The table of the format `catoptric/1`: every key with its type, limits, default and meaning.
//!
//! The reader's checks and hints, the writer's order of keys, the validation of scenes in memory and the JSON schema
//! all come from here; a test holds the defaults against those of the document's types.

mod common;
mod material;
pub(crate) mod russian;

use self::common::{LAYER, ROTATION, SCALE, amount, flag};
pub use self::material::{MATERIAL, NESTED_PATTERN, PATTERN};
use crate::Tracing;
use crate::body::Shadow;
use crate::compound::{DishProfile, Lens, Prism};
use crate::contact::{BodyContact, Contact};
use crate::format::spec::{Default, KeySpec, Kind, Limits, TableSpec};
use crate::shape::{ShapeKind, VisibleSide};

/// Versions of the format that can be read; the last one is written.
pub const VERSIONS: &[&str] = &["catoptric/1"];

/// The shapes that base and top points can place.
const UPRIGHT: &[&str] = &["cylinder", "cone", "paraboloid"];
/// The shapes with parts.
const COMPOUND: &[&str] = &["union", "intersection", "difference", "surface", "group"];
/// What `base` and `top` say, so that nothing else may.
pub(crate) const SAID_BY_AXIS: &[&str] = &["position", "rotation", "height", "focal_length"];
const WHITE: Default = Default::Vector([1.0; 3]);

/// All tables of the format.
pub static TABLES: [&TableSpec; 11] = [
    &ROOT,
    &CAMERA,
    &ENVIRONMENT,
    &SKY,
    &TRACING,
    &MATERIAL,
    &PATTERN,
    &NESTED_PATTERN,
    &LIGHT,
    &BODY,
    &PART,
];

/// The file itself.
pub static ROOT: TableSpec = TableSpec {
    name: "the scene",
    doc: "A scene of Catoptric: bodies, materials, lights and a camera",
    keys: &[
        KeySpec::new("format", Kind::Version(VERSIONS), "the version of the file format").written(),
        KeySpec::new("camera", Kind::Table(&CAMERA), "where the picture is taken from")
            .or(Default::EmptyTable)
            .written(),
        KeySpec::new("environment", Kind::Table(&ENVIRONMENT), "what surrounds the bodies")
            .or(Default::EmptyTable)
            .written(),
        KeySpec::new("tracing", Kind::Table(&TRACING), "how far rays are followed")
            .or(Default::EmptyTable)
            .written(),
        KeySpec::new("materials", Kind::Named(&MATERIAL), "materials that bodies share by name"),
        KeySpec::new("lights", Kind::List(&LIGHT), "lights"),
        KeySpec::new("bodies", Kind::List(&BODY), "bodies"),
    ],
};

/// `[camera]`
pub static CAMERA: TableSpec = TableSpec {
    name: "the camera",
    doc: "A camera that looks from a point towards another",
    keys: &[
        KeySpec::new("position", Kind::Vector(Limits::PLACE), "the eye point, meters")
            .or(Default::Vector([0.0, 2.2, 8.0]))
            .written(),
        KeySpec::new("target", Kind::Vector(Limits::PLACE), "the point in the center of the picture, meters")
            .or(Default::Vector([0.0, 1.0, 0.0]))
            .written(),
        KeySpec::new("up", Kind::Vector(Limits::PLACE), "the direction that points up in the picture")
            .or(Default::Vector([0.0, 1.0, 0.0])),
        KeySpec::new(
            "projection",
            Kind::Choice(&["perspective", "parallel"]),
            "how the world is carried to the picture",
        )
        .or(Default::Text("perspective")),
        KeySpec::new("fov", Kind::Number(Limits::new(0.001, 179.9)), "the vertical angle of view, degrees")
            .or(Default::Number(27.0))
            .only("projection", &["perspective"])
            .written(),
        KeySpec::new("height", Kind::Number(Limits::LENGTH), "the height of the window, meters")
            .or(Default::Number(5.0))
            .only("projection", &["parallel"])
            .written(),
    ],
};

/// `[environment]`
pub static ENVIRONMENT: TableSpec = TableSpec {
    name: "the environment",
    doc: "What surrounds the bodies",
    keys: &[
        KeySpec::new(
            "background",
            Kind::Color(Limits::AMOUNT),
            "the light brought by a ray that hits nothing",
        )
        .or(Default::Vector([0.2, 0.35, 0.6]))
        .written(),
        KeySpec::new("ambient", Kind::Color(Limits::AMOUNT), "the ambient light").or(WHITE).written(),
        KeySpec::new("sky", Kind::Table(&SKY), "a sky in the place of the background"),
        KeySpec::new("picture", Kind::File, "a picture of everything around in the place of the background")
            .excluding(&["sky"]),
        KeySpec::new("layer", Kind::Text, LAYER).beside("picture", &[]),
        KeySpec::new(
            "rotation",
            Kind::Number(Limits::new(-1e6, 1e6)),
            "how far the picture is turned about the y axis, degrees",
        )
        .or(Default::Number(0.0)),
        amount("strength", "a factor of the light of the sky or the picture").or(Default::Number(1.0)),
        KeySpec::new(
            "contact",
            Kind::Choice(Contact::KEYS),
            "what lies between bodies that touch: a film of air (`air`) or nothing (`cemented`)",
        )
        .or(Default::Text(Contact::Air.key())),
    ],
};

/// `sky` of the environment.
pub static SKY: TableSpec = TableSpec {
    name: "a sky",
    doc: "A sky, and a ground below it",
    keys: &[
        KeySpec::new("zenith", Kind::Color(Limits::AMOUNT), "the light from straight above")
            .or(Default::Vector([0.12, 0.28, 0.65]))
            .written(),
        KeySpec::new("horizon", Kind::Color(Limits::AMOUNT), "the light from the horizon")
            .or(Default::Vector([0.8, 0.88, 1.0]))
            .written(),
        KeySpec::new("nadir", Kind::Color(Limits::AMOUNT), "the light from straight below")
            .or(Default::Vector([0.16, 0.14, 0.12]))
            .written(),
    ],
};

/// `[tracing]`
pub static TRACING: TableSpec = TableSpec {
    name: "the tracing",
    doc: "How far rays are followed",
    keys: &[
        KeySpec::new(
            "generations",
            Kind::Integer(Limits::new(1.0, Tracing::MAX_GENERATIONS as f64)),
            "the number of generations of rays, the primary ray being the first",
        )
        .or(Default::Number(6.0))
        .written(),
        KeySpec::new(
            "threshold",
            Kind::Number(Limits::new(0.0, 1.0)),
            "the weight below which a ray is not traced; 0 follows every ray that carries anything",
        )
        .or(Default::Number(0.0)),
    ],
};

/// `[[lights]]`
pub static LIGHT: TableSpec = TableSpec {
    name: "a light",
    doc: "A light: a point, or a ball",
    keys: &[
        KeySpec::new("name", Kind::Text, "a name that no other light has"),
        KeySpec::new("position", Kind::Vector(Limits::PLACE), "the place of the light, meters")
            .or(Default::Vector([-5.0, 8.0, 6.0]))
            .written(),
        KeySpec::new("color", Kind::Color(Limits::AMOUNT), "the color of the light").or(WHITE),
        amount("intensity", "a factor of the color").or(Default::Number(1.0)),
        KeySpec::new(
            "falloff",
            Kind::Choice(&["none", "linear", "inverse-square"]),
            "how the light weakens with the distance d: 1, 1/(d + K) or 1/d²",
        )
        .or(Default::Text("none")),
        KeySpec::new(
            "falloff_constant",
            Kind::Number(Limits::new(0.0, 1e9)),
            "K of the linear falloff 1/(d + K), meters",
        )
        .or(Default::Number(1.0))
        .only("falloff", &["linear"])
        .written(),
        KeySpec::new(
            "radius",
            Kind::Number(Limits::new(0.0, 1e9)),
            "the radius of the ball that shines, meters; 0 is a point",
        )
        .or(Default::Number(0.0)),
        flag("hidden", "whether the light is out"),
        flag("locked", "whether the studio leaves the light as it is; no picture depends on it"),
    ],
};

/// `[[bodies]]`
pub static BODY: TableSpec = TableSpec {
    name: "a body",
    doc: "A body: a shape, where it stands and what it is made of",
    keys: &[
        KeySpec::new("name", Kind::Text, "a name that no other body has"),
        INSTANCE_OF,
        SHAPE,
        SIDES,
        RADIUS,
        INNER_RADIUS,
        TOP_RADIUS,
        SIZE,
        WIDTH,
        LENGTH,
        A,
        B,
        C,
        THICKNESS,
        HEIGHT,
        PROFILE,
        FOCAL_LENGTH,
        LENS_IOR,
        CURVATURE_RADIUS,
        FRONT_RADIUS,
        BACK_RADIUS,
        VISIBLE_SIDE,
        BASE,
        TOP,
        KeySpec::new("position", Kind::Vector(Limits::PLACE), "the place of the body's own origin, meters")
            .or(Default::Vector([0.0; 3]))
            .written(),
        ROTATION,
        SCALE,
        KeySpec::new(
            "material",
            Kind::NameOrTable(&MATERIAL),
            "the name of a material, or a material of its own",
        )
        .or(Default::EmptyTable),
        flag(
            "hidden",
            "whether the body takes no part in the picture: not seen, not reflected, without a shadow",
        ),
        KeySpec::new(
            "shadow",
            Kind::Choice(Shadow::KEYS),
            "what of light on its way to others passes the body: what its surfaces let through (`filtered`), all of it \
             (`none`: it casts no shadow) or nothing (`full`)",
        )
        .or(Default::Text(Shadow::Filtered.key())),
        KeySpec::new(
            "contact",
            Kind::Choice(BodyContact::KEYS),
            "what lies between the body and others that it touches: a film of air (`air`), nothing (`cemented`), or what the \
             other body or the scene says (`scene`)",
        )
        .or(Default::Text(BodyContact::Scene.key())),
        flag("locked", "whether the studio leaves the body as it is; no picture depends on it"),
        parts(&PART),
    ],
};

/// `[[bodies.parts]]`, and `[[bodies.parts.parts]]` within.
pub static PART: TableSpec = TableSpec {
    name: "a part of a body",
    doc: "A part of a body: a shape, where it stands in the frame of the whole and what it is made of",
    keys: &[
        KeySpec::new("name", Kind::Text, "a name that no other part of the same whole has"),
        INSTANCE_OF,
        SHAPE,
        SIDES,
        RADIUS,
        INNER_RADIUS,
        TOP_RADIUS,
        SIZE,
        WIDTH,
        LENGTH,
        A,
        B,
        C,
        THICKNESS,
        HEIGHT,
        PROFILE,
        FOCAL_LENGTH,
        LENS_IOR,
        CURVATURE_RADIUS,
        FRONT_RADIUS,
        BACK_RADIUS,
        VISIBLE_SIDE,
        BASE,
        TOP,
        KeySpec::new(
            "position",
            Kind::Vector(Limits::PLACE),
            "the place of the part's own origin in the frame of the whole, meters",
        )
        .or(Default::Vector([0.0; 3])),
        ROTATION,
        SCALE,
        KeySpec::new(
            "material",
            Kind::NameOrTable(&MATERIAL),
            "the name of a material, or a material of its own; without it, that of the whole",
        ),
        parts(&PART),
    ],
};

#[rustfmt::skip] // The list is read as one.
const INSTANCE_OF: KeySpec = KeySpec::new(
    "instance_of",
    Kind::Text,
    "the name of a body whose shape, sizes and parts it has, and whose material unless it has its own",
)
.excluding(&[
    "shape", "sides", "radius", "inner_radius", "top_radius", "size", "thickness", "height", "profile", "focal_length",
    "ior", "curvature_radius", "front_radius", "back_radius", "width", "length", "a", "b", "c", "visible_side", "base",
    "top", "parts",
]);
const SHAPE: KeySpec = KeySpec::new("shape", Kind::Choice(ShapeKind::KEYS), "the shape of the body")
    .or(Default::Text(ShapeKind::Sphere.key()))
    .written();
const SIDES: KeySpec = KeySpec::new(
    "sides",
    Kind::Integer(Limits::new(3.0, Prism::MAX_SIDES as f64)),
    "the number of sides of a prism",
)
.or(Default::Number(3.0))
.only("shape", &["prism"])
.written();
const RADIUS: KeySpec = KeySpec::new(
    "radius",
    Kind::Number(Limits::LENGTH),
    "the radius (of the base, for a cone; of the rim, for a paraboloid, a lens or a mirror dish), meters",
)
.or(Default::ByChoice(&[
    ("sphere", 1.0),
    ("cylinder", 0.5),
    ("cone", 0.5),
    ("paraboloid", 0.5),
    ("lens", 0.5),
    ("mirror-dish", 0.5),
    ("tube", 0.5),
    ("ring", 0.5),
    ("bowl", 0.5),
    ("prism", 0.5),
    ("open-cylinder", 0.5),
    ("open-cone", 0.5),
    ("disc", 0.5),
]))
.only(
    "shape",
    &[
        "sphere",
        "cylinder",
        "cone",
        "paraboloid",
        "lens",
        "mirror-dish",
        "tube",
        "ring",
        "bowl",
        "prism",
        "open-cylinder",
        "open-cone",
        "disc",
    ],
)
.written();
const INNER_RADIUS: KeySpec = KeySpec::new(
    "inner_radius",
    Kind::Number(Limits::LENGTH),
    "the radius of the hole, less than `radius`, meters",
)
.or(Default::ByChoice(&[("tube", 0.4), ("ring", 0.3)]))
.only("shape", &["tube", "ring"])
.written();
const TOP_RADIUS: KeySpec = KeySpec::new(
    "top_radius",
    Kind::Number(Limits::new(0.0, 1e9)),
    "the radius of the upper cap, meters; 0 makes a pointed cone",
)
.or(Default::Number(0.0))
.only("shape", &["cone", "open-cone"]);
const SIZE: KeySpec = KeySpec::new(
    "size",
    Kind::NumberOrVector(Limits::LENGTH),
    "the edge length, or the three edge lengths, meters",
)
.or(Default::Number(1.0))
.only("shape", &["cube", "wedge"])
.written();
const WIDTH: KeySpec =
    KeySpec::new("width", Kind::Number(Limits::LENGTH), "the length of a rectangle along X, meters")
        .or(Default::Number(1.0))
        .only("shape", &["rectangle"])
        .written();
const LENGTH: KeySpec =
    KeySpec::new("length", Kind::Number(Limits::LENGTH), "the length of a rectangle along Z, meters")
        .or(Default::Number(1.0))
        .only("shape", &["rectangle"])
        .written();
const A: KeySpec = corner("a", "a corner of a triangle, meters", [-0.5, 0.0, 0.5]);
const B: KeySpec = corner("b", "the corner of a triangle after `a`, meters", [0.5, 0.0, 0.5]);
const C: KeySpec = corner("c", "the corner of a triangle after `b`, meters", [0.0, 0.0, -0.5]);
/// A corner of a triangle.
const fn corner(name: &'static str, meaning: &'static str, default: [f64; 3]) -> KeySpec {
    KeySpec::new(name, Kind::Vector(Limits::PLACE), meaning)
        .or(Default::Vector(default))
        .only("shape", &["triangle"])
        .written()
}
const THICKNESS: KeySpec = KeySpec::new(
    "thickness",
    Kind::Number(Limits::LENGTH),
    "the thickness (in the middle, for a lens or a mirror dish; of the wall, for a bowl), meters",
)
.or(Default::ByChoice(&[("lens", 0.3), ("mirror-dish", 0.1), ("ring", 0.1), ("bowl", 0.05)]))
.only("shape", &["lens", "mirror-dish", "ring", "bowl"])
.written();
const HEIGHT: KeySpec = KeySpec::new(
    "height",
    Kind::Number(Limits::LENGTH),
    "the height (of the rim, for a bowl: by default its radius), meters",
)
.or(Default::ByChoice(&[
    ("cylinder", 1.0),
    ("cone", 1.0),
    ("paraboloid", 1.0),
    ("tube", 1.0),
    ("prism", 1.0),
    ("open-cylinder", 1.0),
    ("open-cone", 1.0),
]))
.only("shape", &["cylinder", "cone", "paraboloid", "tube", "bowl", "prism", "open-cylinder", "open-cone"])
.written();
const PROFILE: KeySpec =
    KeySpec::new("profile", Kind::Choice(DishProfile::KEYS), "the curve of the face of a mirror dish")
        .or(Default::Text(DishProfile::Parabolic.key()))
        .only("shape", &["mirror-dish"]);
const FOCAL_LENGTH: KeySpec = KeySpec::new(
    "focal_length",
    Kind::Number(Limits::PLACE),
    "the distance of the focus (from the vertex, in the place of the height of a paraboloid; of a lens in air, in the \
     place of its radii of curvature, below 0 if it spreads light), meters",
)
.or(Default::ByChoice(&[("mirror-dish", 0.5)]))
.only("shape", &["paraboloid", "lens", "mirror-dish"])
.excluding(&["height", "back_radius"])
.written();
const LENS_IOR: KeySpec = KeySpec::new(
    "ior",
    Kind::Number(Limits::new(0.01, 100.0)),
    "the index of refraction that the focal length of a lens holds for",
)
.or(Default::Number(Lens::DEFAULT_IOR))
.only("shape", &["lens"])
.beside("focal_length", &[]);
const CURVATURE_RADIUS: KeySpec = KeySpec::new(
    "curvature_radius",
    Kind::Number(Limits::LENGTH),
    "the radius of curvature of a mirror dish at its vertex, in the place of the focal length, meters",
)
.only("shape", &["mirror-dish"])
.excluding(&["focal_length"]);
const FRONT_RADIUS: KeySpec = KeySpec::new(
    "front_radius",
    Kind::Number(Limits::PLACE),
    "the radius of curvature of a lens at -Y, meters; 0 is flat, above 0 bulges",
)
.or(Default::Number(1.0))
.only("shape", &["lens"])
.written();
const BACK_RADIUS: KeySpec = KeySpec::new(
    "back_radius",
    Kind::Number(Limits::PLACE),
    "the radius of curvature of a lens at +Y, meters; 0 is flat, below 0 bulges",
)
.or(Default::Number(-1.0))
.only("shape", &["lens"])
.written();
const VISIBLE_SIDE: KeySpec = KeySpec::new(
    "visible_side",
    Kind::Choice(VisibleSide::KEYS),
    "the side of a surface that is seen: the outer one, to which its normal points, the inner one, or both; from the other \
     nothing is there",
)
.or(Default::Text(VisibleSide::Both.key()))
.only("shape", &["surface", "open-cylinder", "open-cone", "disc", "rectangle", "triangle"]);
const BASE: KeySpec = KeySpec::new(
    "base",
    Kind::Vector(Limits::PLACE),
    "the center of the lower base, or the vertex of a paraboloid, meters",
)
.only("shape", UPRIGHT)
.beside("top", SAID_BY_AXIS);
const TOP: KeySpec = KeySpec::new(
    "top",
    Kind::Vector(Limits::PLACE),
    "the center of the upper base, or the apex of a cone, meters",
)
.only("shape", UPRIGHT)
.beside("base", SAID_BY_AXIS);
/// `parts`; a table has itself within only by a reference that it is given.
const fn parts(table: &'static TableSpec) -> KeySpec {
    KeySpec::new("parts", Kind::List(table), "what the body is joined of").only("shape", COMPOUND)
}
