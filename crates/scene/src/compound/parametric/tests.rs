//! Expansions held against formulas for the points of each shape, and what is wrong with sizes.

use glam::dvec3;

use super::*;
use crate::language::Language;
use crate::{Body, Scene};

/// Whether a point lies in a body of parts, by the definitions of shapes and kinds of wholes.
fn holds(form: &Form<'_>, point: DVec3) -> bool {
    let at = form.placement.world_from_body().inverse().transform_point3(point);
    let across = at.x.hypot(at.z);
    let mut parts = form.parts.iter().map(|part| holds(&part.form(), at));
    match form.shape {
        Shape::Union | Shape::Group => parts.any(|held| held),
        Shape::Intersection | Shape::Surface { .. } => parts.all(|held| held),
        Shape::Difference => parts.next().unwrap() && !parts.any(|held| held),
        Shape::Plane => at.y < 0.0,
        Shape::Sphere { radius } => at.length() < radius,
        Shape::Cube { size } => (2.0 * at.abs()).cmplt(size).all(),
        Shape::Cylinder { radius, height } => across < radius && at.y > 0.0 && at.y < height,
        Shape::Paraboloid { radius, depth } => {
            at.y < depth.height(radius) && across * across < 4.0 * depth.focal_length(radius) * at.y
        }
        Shape::Cone { .. } => panic!("no expansion has a cone"),
    }
}

/// Points between −1 and 1, evenly (Roberts 2018, the R₃ sequence).
fn points(count: u32) -> impl Iterator<Item = DVec3> {
    let steps = dvec3(0.819_172_513_396_164_5, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3);
    (1..=count).map(move |index| 2.0 * (steps * f64::from(index)).fract() - 1.0)
}

/// The parts hold the points that the formula does, and the extent is the least box around them.
fn assert_is(shape: ParametricShape, formula: impl Fn(DVec3, f64) -> bool) {
    assert_eq!(shape.broken_size(), None, "{shape:?}");
    let body = Body::of_shape(BodyShape::Parametric(shape));
    let [min, max] = body.form().extent().unwrap();
    let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
    let (mut least, mut greatest) = (max, min);
    for point in points(40_000) {
        let point = middle + 1.1 * half * point;
        let is_in = formula(point, point.x.hypot(point.z));
        assert_eq!(holds(&body.form(), point), is_in, "{shape:?}: {point}");
        if is_in {
            (least, greatest) = (least.min(point), greatest.max(point));
        }
    }
    assert!(least.cmpge(min).all() && greatest.cmple(max).all(), "{shape:?}: {least} {greatest}");
    // The sharp edges of a wedge hold few points.
    let gap = ((least - min) / half).max((max - greatest) / half).max_element();
    assert!(gap < 0.1, "{shape:?}: {least} {greatest} in {min} {max}");
}

#[test]
fn hollow_shapes_hold_what_lies_between_their_walls() {
    for [radius, inner_radius, height] in [[0.5, 0.4, 1.0], [3.0, 0.01, 0.02], [1e-3, 9e-4, 40.0]] {
        let within = |across: f64| across > inner_radius && across < radius;
        assert_is(ParametricShape::Tube(Tube { radius, inner_radius, height }), |point, across| {
            within(across) && point.y > 0.0 && point.y < height
        });
        let ring = Ring { radius, inner_radius, thickness: height };
        assert_is(ParametricShape::Ring(ring), |point, across| {
            within(across) && point.y.abs() < 0.5 * height
        });
    }
    for (thickness, height) in [(0.05, None), (0.4, Some(0.41)), (0.1, Some(0.2)), (0.1, Some(0.85))] {
        let bowl = Bowl { radius: 0.5, thickness, height };
        assert_is(ParametricShape::Bowl(bowl), |point, _| {
            let from_center = point.distance(DVec3::Y * 0.5);
            from_center < 0.5 && from_center > 0.5 - thickness && point.y < height.unwrap_or(0.5)
        });
    }
}

#[test]
fn prisms_and_wedges_end_at_their_corners() {
    for sides in [3, 4, 5, 6, 7, 8, 12, 60] {
        let prism = Prism { sides, radius: 0.7, height: 0.3 };
        let corner = |index: u32| {
            let angle = std::f64::consts::TAU * (f64::from(index) + 0.5) / f64::from(sides);
            0.7 * dvec3(angle.sin(), 0.0, angle.cos())
        };
        assert_is(ParametricShape::Prism(prism), |point, _| {
            let is_inside = |side| (corner(side + 1) - corner(side)).cross(point - corner(side)).y > 0.0;
            point.y > 0.0 && point.y < 0.3 && (0..sides).all(is_inside)
        });
        // A side along an axis of the box is the box's own.
        let own = (0..4).filter(|quarter| sides * quarter % 4 == 0).count();
        let parts = ParametricShape::Prism(prism).expansion().parts.len();
        assert_eq!(parts, 1 + sides as usize - own, "{sides}");
        assert!(parts <= Shape::MAX_PARTS);
    }
    for size in [DVec3::ONE, dvec3(4.0, 0.5, 2.0), dvec3(0.01, 1.0, 0.3)] {
        assert_is(ParametricShape::Wedge(Wedge { size }), |point, _| {
            let is_in_box = (2.0 * point.abs()).cmplt(size).all();
            is_in_box && point.x / size.x + point.y / size.y < 0.0
        });
    }
}

/// A surface has the points of its first part's surface that the formula has, and the extent is the least box around them.
fn assert_is_flat(shape: ParametricShape, normal: DVec3, formula: impl Fn(DVec3) -> bool) {
    assert_eq!(shape.broken_size(), None, "{shape:?}");
    let body = Body::of_shape(BodyShape::Parametric(shape));
    assert_eq!(body.shape, Shape::SURFACE);
    let [first, cutters @ ..] = body.parts.as_slice() else { panic!("{shape:?}") };
    let up = first.placement.world_from_body().matrix3 * DVec3::Y;
    assert!(first.shape == Shape::Plane && up.distance(normal) < 1e-12, "{shape:?}: {up}");
    let [min, max] = body.form().extent().unwrap();
    let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
    let (mut least, mut greatest) = (max, min);
    for point in points(40_000) {
        let point = middle + 1.1 * half * point;
        let point = point - normal * normal.dot(point - first.placement.origin());
        let is_in = formula(point);
        let is_held = cutters.iter().all(|part| holds(&part.form(), point));
        assert_eq!(is_held, is_in, "{shape:?}: {point}");
        if is_in {
            (least, greatest) = (least.min(point), greatest.max(point));
        }
    }
    let gap = (least - min).max(max - greatest).max_element() / half.max_element();
    assert!(gap < 0.1, "{shape:?}: {least} {greatest} in {min} {max}");
}

#[test]
fn flat_shapes_end_at_their_edges() {
    for radius in [0.5, 3.0, 1e-3] {
        let disc = ParametricShape::Disc(Disc { radius, side: VisibleSide::Both });
        assert_is_flat(disc, DVec3::Y, |point| point.length() < radius);
    }
    for (width, length) in [(1.0, 1.0), (0.01, 4.0), (300.0, 7.0)] {
        let rectangle = ParametricShape::Rectangle(Rectangle { width, length, side: VisibleSide::Both });
        assert_is_flat(rectangle, DVec3::Y, |point| {
            2.0 * point.x.abs() < width && 2.0 * point.z.abs() < length
        });
    }
    for triangle in [
        Triangle::default(),
        Triangle {
            a: dvec3(1.0, 2.0, 3.0),
            b: dvec3(-1.0, 0.5, 2.0),
            c: dvec3(0.3, -4.0, 0.1),
            ..Triangle::default()
        },
        Triangle {
            a: dvec3(0.0, 0.0, 0.0),
            b: dvec3(0.0, 1e-3, 0.0),
            c: dvec3(1.0, 0.0, 0.0),
            ..Triangle::default()
        },
    ] {
        let Triangle { a, b, c, .. } = triangle;
        let normal = (b - a).cross(c - a);
        assert_is_flat(ParametricShape::Triangle(triangle), normal.normalize(), |point| {
            let is_left = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) > 0.0;
            is_left(a, b) && is_left(b, c) && is_left(c, a)
        });
    }
    let line = Triangle { a: DVec3::ZERO, b: DVec3::ONE, c: 3.0 * DVec3::ONE, ..Triangle::default() };
    assert_eq!(ParametricShape::Triangle(line).broken_size(), Some(SizeFault::FlatTriangle.at("c")));
}

#[test]
fn polygons_are_flat_and_convex() {
    let at = |corners: &[[f64; 2]]| {
        // In a plane that is along no axis.
        let [right, up] = [dvec3(2.0, -1.0, 2.0) / 3.0, dvec3(1.0, -2.0, -2.0) / 3.0];
        corners.iter().map(|[x, y]| dvec3(0.3, 0.1, -2.0) + *x * right + *y * up).collect::<Vec<_>>()
    };
    let square = at(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let backwards: Vec<DVec3> = square.iter().rev().copied().collect();
    for corners in [&square, &backwards] {
        let Expansion { shape, parts } = Expansion::convex_polygon(corners).unwrap();
        assert_eq!((shape, parts.len()), (Shape::SURFACE, 6));
    }
    let with_middle = at(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert!(Expansion::convex_polygon(&with_middle).is_some(), "a corner on a side");
    let notched = at(&[[0.0, 0.0], [1.0, 0.0], [0.4, 0.4], [0.0, 1.0]]);
    let crossed = at(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
    let mut bent = square.clone();
    bent[2] += dvec3(0.0, 0.1, 0.1);
    for corners in [&notched[..], &crossed, &bent, &square[..2], &[DVec3::ONE; 5], &[], &[DVec3::NAN; 4]] {
        assert_eq!(Expansion::convex_polygon(corners), None, "{corners:?}");
    }
    let round = |count: usize| {
        let angle = |index: usize| std::f64::consts::TAU * index as f64 / count as f64;
        (0..count).map(|index| dvec3(angle(index).cos(), 0.0, angle(index).sin())).collect::<Vec<_>>()
    };
    assert_eq!(Expansion::convex_polygon(&round(62)).unwrap().parts.len(), Shape::MAX_PARTS);
    assert_eq!(Expansion::convex_polygon(&round(63)), None);
}

#[test]
fn open_shapes_are_their_sides() {
    let (radius, top_radius, height) = (0.4, 0.1, 2.0);
    for (open, side) in [
        (
            ParametricShape::OpenCylinder(OpenCylinder { radius, height, side: VisibleSide::Both }),
            Shape::Cylinder { radius, height },
        ),
        (
            ParametricShape::OpenCone(OpenCone { radius, top_radius, height, side: VisibleSide::Both }),
            Shape::Cone { radius, top_radius, height },
        ),
    ] {
        let Expansion { shape, parts } = open.expansion();
        assert_eq!((shape, parts.len(), parts[0].shape), (Shape::SURFACE, 1, side));
        assert_eq!(Some(open.extent()), side.extent());
    }
}

#[test]
fn dishes_are_cut_by_their_profile() {
    for depth in [DishDepth::FocalLength(0.5), DishDepth::FocalLength(20.0), DishDepth::CurvatureRadius(0.51)]
    {
        for profile in [DishProfile::Parabolic, DishProfile::Spherical] {
            let dish = MirrorDish { radius: 0.5, thickness: 0.1, profile, depth };
            let curvature = 2.0 * dish.focal_length();
            assert_is(ParametricShape::MirrorDish(dish), |point, across| {
                let face = match profile {
                    DishProfile::Parabolic => across * across / (2.0 * curvature),
                    DishProfile::Spherical => {
                        curvature - (curvature.powi(2) - across.powi(2)).max(0.0).sqrt()
                    }
                };
                across < 0.5 && point.y > -0.1 && point.y < face
            });
        }
    }
}

/// Biconvex, plano-convex either way, menisci of both kinds, biconcave, plano-concave, a window.
const RADII: [[f64; 2]; 9] = [
    [1.0, -1.0],
    [0.6, 0.0],
    [0.0, -0.55],
    [0.6, 1.5],
    [2.0, 0.7],
    [-0.8, -0.6],
    [-0.51, 0.7],
    [0.0, 3.0],
    [0.0, 0.0],
];

#[test]
fn lenses_lie_between_their_faces() {
    for [front, back] in RADII {
        let lens = Lens { radius: 0.5, thickness: 0.4, curvature: LensCurvature::Radii { front, back } };
        // The sag of a conic with the constant 0 (ISO 10110-12).
        let sag = |radius: f64, across: f64| {
            let c = if radius == 0.0 { 0.0 } else { 1.0 / radius };
            c * across * across / (1.0 + (1.0 - (c * across).powi(2)).max(0.0).sqrt())
        };
        assert_is(ParametricShape::Lens(lens), |point, across| {
            let faces = [-0.2 + sag(front, across), 0.2 + sag(back, across)];
            across < 0.5 && point.y > faces[0] && point.y < faces[1]
        });
    }
}

/// The radii of the faces as the parts have them: a ball that meets the axis where a face does.
fn faces_of(lens: Lens) -> [f64; 2] {
    let body = Body::of_shape(BodyShape::Parametric(ParametricShape::Lens(lens)));
    let mut radii = [0.0; 2];
    body.form().each_simple(glam::DAffine3::IDENTITY, &mut |part| {
        let Shape::Sphere { radius } = part.shape else { return };
        for (face, vertex) in radii.iter_mut().zip([-0.5 * lens.thickness, 0.5 * lens.thickness]) {
            let from_vertex = part.frame.translation.y - vertex;
            if (from_vertex.abs() - radius).abs() < 1e-9 * radius {
                *face = from_vertex;
            }
        }
    });
    radii
}

#[test]
fn paraxial_rays_meet_at_the_focal_length() {
    let lens = |focal_length: f64, ior, thickness, front| {
        let curvature = LensCurvature::FocalLength { focal_length, ior, front };
        Lens { radius: 0.2, thickness, curvature }
    };
    let lenses = [
        lens(1.0, 1.5, 0.1, None),
        lens(0.5, 1.5, 0.3, None),
        lens(-1.0, 1.5, 0.05, None),
        lens(3.0, 2.4, 0.2, None),
        lens(2.0, 1.33, 0.15, Some(0.0)),
        lens(-2.0, 1.7, 0.1, Some(0.0)),
        lens(1.5, 1.5, 0.1, Some(0.4)),
        lens(-1.5, 1.5, 0.1, Some(0.4)),
        lens(2.5, 1.9, 0.2, Some(-3.0)),
        // A lens of air in glass, as it were: a hollow one gathers light.
        lens(1.0, 0.66, 0.1, None),
    ];
    for lens in lenses {
        let LensCurvature::FocalLength { focal_length, ior, .. } = lens.curvature else { panic!() };
        assert_eq!(ParametricShape::Lens(lens).broken_size(), None, "{lens:?}");
        // Refraction at a face of the power (n' − n) / R, twice (Hecht, sec. 6.2.1), with a transfer between.
        let [front, back] = faces_of(lens).map(|radius| if radius == 0.0 { 0.0 } else { 1.0 / radius });
        let (height, angle) = (1.0, 0.0);
        let angle = (angle - height * (ior - 1.0) * front) / ior;
        let height = height + lens.thickness * angle;
        let angle = ior * angle - height * (1.0 - ior) * back;
        assert!((-1.0 / angle / focal_length - 1.0).abs() < 1e-9, "{lens:?}: {}", -1.0 / angle);
        assert!((lens.focal_length(ior) / focal_length - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_size_by_another_key_keeps_what_it_can() {
    let mut lens = Lens::default();
    lens.set_number("focal_length", 2.0);
    let symmetric = LensCurvature::FocalLength { focal_length: 2.0, ior: 1.5, front: None };
    assert_eq!((lens.curvature, lens.number("back_radius")), (symmetric, None));
    let (front, _) = lens.radii().unwrap();
    lens.set_number("back_radius", 0.0);
    assert_eq!(lens.curvature, LensCurvature::Radii { front, back: 0.0 });
    lens.set_number("focal_length", 2.0);
    assert!((lens.radii().unwrap().1 - lens.focal_length(1.5)).abs() > 0.0);
    assert_eq!(lens.number("front_radius"), Some(front));
    let twice = BodyShape::Parametric(ParametricShape::Lens(lens)).scaled(2.0);
    assert_eq!(
        ["radius", "thickness", "focal_length", "ior"].map(|key| twice.number(key)),
        [Some(1.0), Some(0.6), Some(4.0), Some(1.5)]
    );
    for kind in ShapeKind::PARAMETRIC {
        let shape = BodyShape::of_size(kind, 2.0, 3.0);
        assert_eq!((shape.kind(), ShapeKind::of_key(kind.key())), (kind, Some(kind)));
        let body = Body::of_shape(shape);
        assert_eq!((body.shape, body.body_shape()), (kind.shape(), shape));
        assert!((body.form().extent().unwrap()[1].x / 2.0 - 1.0).abs() < 0.14, "{kind:?}");
        assert_eq!(Scene { bodies: [body].into(), ..Scene::default() }.check(), []);
    }
}

#[test]
fn a_changed_expansion_is_a_body_of_parts() {
    let mut body = Body::of_shape(ShapeKind::Tube.body_shape());
    body.parts[1].shape.set_number("radius", 0.1);
    assert_eq!(body.body_shape(), BodyShape::Plain(Shape::Difference));
    body.change_shape(|shape| shape.set_number("radius", 2.0));
    assert_eq!((body.parts.len(), body.parametric), (2, None));
}

/// Shapes whose sizes are wrong together, and what is said of them in English and in Russian.
fn contradictions() -> [(ParametricShape, &'static str, &'static str); 13] {
    let lens = |radius, thickness, curvature| ParametricShape::Lens(Lens { radius, thickness, curvature });
    let radii = |front, back| LensCurvature::Radii { front, back };
    let focal = |focal_length, ior, front| LensCurvature::FocalLength { focal_length, ior, front };
    let dish = |profile, depth| {
        ParametricShape::MirrorDish(MirrorDish { radius: 0.5, thickness: 0.1, profile, depth })
    };
    let bowl = |thickness, height| ParametricShape::Bowl(Bowl { radius: 0.5, thickness, height });
    [
        (
            ParametricShape::Tube(Tube { radius: 0.4, inner_radius: 0.4, height: 1.0 }),
            "`inner_radius` is not smaller than `radius`",
            "`inner_radius` не меньше, чем `radius`",
        ),
        (
            ParametricShape::Ring(Ring { radius: 0.4, inner_radius: 0.5, thickness: 1.0 }),
            "`inner_radius` is not smaller than `radius`",
            "`inner_radius` не меньше, чем `radius`",
        ),
        (bowl(0.5, None), "`thickness` is not smaller than `radius`", "`thickness` не меньше, чем `radius`"),
        (
            bowl(0.1, Some(0.95)),
            "the rim of this bowl must be higher than 0.1 and lower than 0.9 meters",
            "край этой чаши должен быть выше 0,1 и ниже 0,9 м",
        ),
        (
            lens(0.5, 0.3, radii(0.5, 0.0)),
            "a face with a radius of curvature of 0.5 meters is too small for this `radius`",
            "поверхность с радиусом кривизны 0,5 м мала для такого `radius`",
        ),
        (
            lens(0.5, 0.2, radii(1.0, -1.0)),
            "the faces of this lens meet before the rim unless it is thicker than 0.267949 meters",
            "поверхности линзы сходятся до края, если она не толще 0,267949 м",
        ),
        (
            lens(0.5, 1.9, radii(1.0, 0.0)),
            "the ball of a face ends within this lens unless it is thinner than 1.86603 meters",
            "шар одной из поверхностей кончается внутри линзы, если она не тоньше 1,86603 м",
        ),
        (
            lens(0.5, 0.3, focal(1.0, 1.0, None)),
            "a lens whose index of refraction is 1 has no focal length",
            "у линзы с показателем преломления 1 нет фокусного расстояния",
        ),
        (
            lens(0.05, 0.3, focal(0.1, 1.5, None)),
            "no lens of this `thickness` has this `focal_length`",
            "при такой `thickness` такого `focal_length` у линзы не бывает",
        ),
        (
            lens(0.5, 0.3, focal(0.4, 1.5, None)),
            "a face with a radius of curvature of 0.341421 meters is too small for this `radius`",
            "поверхность с радиусом кривизны 0,341421 м мала для такого `radius`",
        ),
        (
            dish(DishProfile::Spherical, DishDepth::FocalLength(0.25)),
            "a face with a radius of curvature of 0.5 meters is too small for this `radius`",
            "поверхность с радиусом кривизны 0,5 м мала для такого `radius`",
        ),
        (
            dish(DishProfile::Parabolic, DishDepth::FocalLength(1e9)),
            "the rim of this dish is less than 1e-9 or more than 1e9 meters above its vertex",
            "край этого зеркала выше его вершины меньше чем на 1e-9 или больше чем на 1e9 метров",
        ),
        (
            dish(DishProfile::Parabolic, DishDepth::FocalLength(-1.0)),
            "`focal_length` is -1, but must be greater than 0",
            "`focal_length` равно -1, а должно быть больше 0",
        ),
    ]
}

#[test]
fn sizes_that_contradict_each_other_are_problems() {
    for (shape, english, russian) in contradictions() {
        let body = Body::of_shape(BodyShape::Parametric(shape));
        let problems = Scene { bodies: [body].into(), ..Scene::default() }.check();
        let said: Vec<_> = problems
            .iter()
            .map(|problem| {
                [(Language::English, "body 1: "), (Language::Russian, "тело 1: ")]
                    .map(|(language, subject)| problem.message(language).replacen(subject, "", 1))
            })
            .collect();
        assert_eq!(said, [[english, russian].map(str::to_owned)], "{shape:?}");
    }
    // What is no number is a problem of its key.
    let mut body = Body::of_shape(ShapeKind::Lens.body_shape());
    body.change_shape(|shape| shape.set_number("front_radius", f64::NAN));
    let problems = Scene { bodies: [body].into(), ..Scene::default() }.check();
    assert_eq!(problems.iter().map(|problem| problem.key).collect::<Vec<_>>(), ["front_radius"]);
}
