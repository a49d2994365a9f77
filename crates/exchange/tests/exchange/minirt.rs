//! miniRT: known answers, dialects, the school's errors.

use catoptric_exchange::{ForeignFormat, ImportOptions, read};
use catoptric_scene::{Anchor, Color, Projection, Severity, Shape, ShapeKind};
use glam::DVec3;

use crate::common::{assert_light, bad, count, good, pixel};

const FORMAT: ForeignFormat = ForeignFormat::MiniRt;
/// The ray meets (0, 0, 1), where the normal is +Z; n·L is 3/5.
const SPHERE: &str = "A 0.2 255,255,255\nC 0,0,5 0,0,-1 60\nL 0,4,4 0.5 255,255,255\nsp 0,0,0 2 255,102,0";

fn with(text: &str, dialect: &str) -> ImportOptions {
    assert!(!text.is_empty());
    ImportOptions { dialect: dialect.parse().unwrap(), ..ImportOptions::default() }
}

#[test]
fn a_pixel_has_the_light_of_the_schools_formula() {
    let one = |text: &str, dialect: &str| pixel(&good(FORMAT, text, &with(text, dialect)), [1, 1], [0, 0]);
    // (1, 0.4, 0) · (0.2 + 0.5 · 0.6).
    assert_light(one(SPHERE, ""), [0.5, 0.2, 0.0]);
    // The highlight adds 0.5 · 0.5 · (S·R)² with S·R = 0.6.
    let shiny = format!("{SPHERE} specular=0.5 shininess=2");
    assert_light(one(&shiny, ""), [0.59, 0.29, 0.09]);
    // Three quarters of that are left by a mirror in the dark.
    let mirror = format!("{SPHERE} reflection=0.25");
    assert_light(one(&mirror, ""), [0.375, 0.15, 0.0]);
    assert_light(one(&mirror, "added-reflection"), [0.5, 0.2, 0.0]);
    // Colored ambient light and a colored light.
    let colored = "A 0.5 0,255,0\nC 0,0,5 0,0,-1 60\nL 0,4,4 1 255,0,51\nsp 0,0,0 2 255,255,255";
    assert_light(one(colored, ""), [0.6, 0.5, 0.12]);
}

#[test]
fn sizes_follow_the_subject_or_the_dialect() {
    let text = "A 1 255,255,255\nC 0,0,5 0,0,-1 60\n\
                sp 0,0,0 3 1,2,3\ncy 0,1,0 0,1,0 2 4 1,2,3\nco 0,1,0 0,-1,0 2 4 1,2,3\npl 0,1,2 1,0,0 1,2,3";
    let bodies = |dialect: &str| good(FORMAT, text, &with(text, dialect)).scene.bodies.to_vec();
    let plain = bodies("");
    assert_eq!(plain[0].shape, Shape::Sphere { radius: 1.5 });
    let axis = |base: f64, top: f64| Anchor::Axis { base: DVec3::Y * base, top: DVec3::Y * top };
    assert_eq!(
        (plain[1].shape, plain[1].placement.anchor),
        (Shape::Cylinder { radius: 1.0, height: 4.0 }, axis(-1.0, 3.0))
    );
    assert_eq!(plain[2].placement.anchor, axis(-3.0, 1.0));
    assert!((plain[3].placement.rotation() * DVec3::Y).abs_diff_eq(DVec3::X, 1e-12));
    let other = bodies("radius,base,cone-base");
    assert_eq!(other[0].shape, Shape::Sphere { radius: 3.0 });
    assert_eq!(
        (other[1].shape, other[1].placement.anchor),
        (Shape::Cylinder { radius: 2.0, height: 4.0 }, axis(1.0, 5.0))
    );
    assert_eq!(other[2].placement.anchor, axis(1.0, -3.0));
}

#[test]
fn colors_may_stand_before_sizes() {
    let text = "A 1 255,255,255\nC 0,0,5 0,0,-1 60\ncy 0,0,0 0,1,0 255,0,0 2 4\n";
    let found = good(FORMAT, text, &ImportOptions::default());
    assert_eq!(found.scene.bodies.to_vec()[0].shape, Shape::Cylinder { radius: 1.0, height: 4.0 });
}

#[test]
fn the_angle_of_view_is_horizontal_for_the_size_of_the_picture() {
    let fov = |text: &str, options: &ImportOptions| {
        let found = good(FORMAT, text, options);
        let Projection::Perspective { fov_degrees } = found.scene.camera.projection else { panic!() };
        (fov_degrees, found.size)
    };
    let text = "R 200 100\nA 1 255,255,255\nC 0,0,5 0,0,-1 90\n";
    let (degrees, size) = fov(text, &ImportOptions::default());
    assert!((degrees - 53.130_102_354_155_98).abs() < 1e-9, "{degrees}");
    assert_eq!(size, Some([200, 100]));
    let square = ImportOptions { size: Some([50, 50]), ..ImportOptions::default() };
    assert!((fov(text, &square).0 - 90.0).abs() < 1e-9);
    assert_eq!(fov(text, &with(text, "vertical-fov")).0, 90.0);
}

#[test]
fn a_left_handed_picture_is_the_mirror_image() {
    let text = "A 1 255,255,255\nC 0,0,-5 0,0,1 90\nsp 2,0,0 2 255,255,255\n";
    let right = |dialect: &str| pixel(&good(FORMAT, text, &with(text, dialect)), [5, 5], [3, 2])[0];
    assert_eq!((right(""), right("left-handed")), (0.0, 1.0));
}

#[test]
fn what_was_interpreted_is_noted_once() {
    let text = "A 1 255,255,255\nC 0,0,5 0,0,-1 60\ncy 0,0,0 0,1,0 2 4 1,1,1\ncy 0,9,0 0,1,0 2 4 1,1,1\n";
    let report = good(FORMAT, text, &ImportOptions::default()).report;
    // Colors, angle of view, the axes' hands, cylinders.
    assert_eq!((count(&report, Severity::Note), report.len()), (4, 4), "{report}");
    assert!(
        report.to_string().contains("3:1: note: the position of a cylinder is taken as its center"),
        "{report}"
    );
}

#[test]
fn bonus_numbers_and_lines_of_properties_are_read() {
    let text = "A 1 255,255,255\nC 0,0,5 0,0,-1 60\nsp 0,0,0 2 500 0.5 1 255,0,0\nsp 0,0,9 2 255,0,0\nma\treflection:0.25\n";
    let found = good(FORMAT, text, &ImportOptions::default());
    let materials: Vec<_> =
        found.scene.bodies.iter().map(|body| found.scene.material(&body.material).unwrap()).collect();
    let phong = |index: usize| materials[index].as_phong().unwrap();
    assert_eq!((phong(0).shininess, phong(0).specular, phong(0).reflection()), (500.0, 0.5, 0.5));
    assert!(phong(0).pattern.solid.is_some());
    assert_eq!((phong(1).reflection(), phong(1).diffuse), (0.25, 0.75));
}

/// Commas may have spaces around them, and `//` begins a comment.
#[test]
fn other_ways_to_write_are_read() {
    let text =
        "A 1 0, 0,\t255 // dim\n// C\nC 0, 1, 5  0 ,0, -1 60\nsp 0 , -.5 ,2 1 9,9 ,9 reflection= 0.5\n";
    let scene = good(FORMAT, text, &ImportOptions::default()).scene;
    assert_eq!(scene.camera.position, DVec3::new(0.0, 1.0, 5.0));
    assert_eq!(scene.bodies[0].placement.origin(), DVec3::new(0.0, -0.5, 2.0));
    let body = &scene.bodies[0];
    assert_eq!(scene.material(&body.material).unwrap().as_phong().unwrap().reflection(), 0.5);
    let found = bad(FORMAT, "A 1 0,0,0\nC 0,0,5, 0,0,-1 60\n");
    assert!(found.starts_with("2:3: error: `0,0,5,` is not three numbers"), "{found}");
}

/// A coefficient comes before its exponent in other programs.
#[test]
fn bonus_numbers_may_be_those_of_a_highlight() {
    for (numbers, expected) in
        [("0.8 100", (0.8, 100.0, 0.0)), ("1 32 0.25", (1.0, 32.0, 0.25)), ("0 2", (0.0, 2.0, 0.0))]
    {
        let text = format!("A 1 255,255,255\nC 0,0,5 0,0,-1 60\nsp 0,0,0 2 255,0,0 {numbers}\n");
        let found = good(FORMAT, &text, &ImportOptions::default());
        let body = &found.scene.bodies[0];
        let phong = found.scene.material(&body.material).unwrap().as_phong().unwrap();
        assert_eq!((phong.specular, phong.shininess, phong.reflection()), expected, "{numbers}");
        assert!(phong.pattern.solid.is_none());
        assert!(found.report.to_string().contains("coefficient and exponent"), "{}", found.report);
    }
    let found = bad(FORMAT, "A 1 255,255,255\nC 0,0,5 0,0,-1 60\nsp 0,0,0 2 255,0,0 0.8 100 2\n");
    assert_eq!(found, "3:28: error: the reflection is 2, but must be from 0 to 1");
}

#[test]
fn the_schools_errors_are_refused_with_words() {
    for (text, expected) in [
        ("", "1:1: error: the scene has no `A`\n1:1: error: the scene has no `C`"),
        ("C 0,0,5 0,0,-1 60\n", "1:1: error: the scene has no `A`"),
        (
            "A 1.2 0,0,0\nC 0,0,5 0,0,-1 60",
            "1:3: error: the ratio of ambient light is 1.2, but must be from 0 to 1",
        ),
        ("A 1 0,0,256\nC 0,0,5 0,0,-1 60", "1:5: error: a color has the value 256"),
        ("A 1 0,0,0\nA 1 0,0,0\nC 0,0,5 0,0,-1 60", "2:1: error: `A` is given twice"),
        ("A 1 0,0,0\nC 0,0,5 0,0,-1 60\nC 0,0,5 0,0,-1 60", "3:1: error: `C` is given twice"),
        (
            "A 1 0,0,0\nC 0,0,5 0,0,-1 180",
            "2:16: error: the field of view is 180, but must be from 0.001 to 179.9",
        ),
        (
            "A 1 0,0,0\nC 0,0,5 0,0,-2 60",
            "2:9: error: the direction of view of `C` has a number beyond -1 to 1",
        ),
        ("A 1 0,0,0\nC 0,0,5 0,0,0 60", "2:9: error: the direction of view is zero"),
        ("A 0,5 0,0,0\nC 0,0,5 0,0,-1 60", "1:3: error: `0,5` has a decimal comma"),
        ("A 1 0,0,0\nC 0,5,0,5,1,5 0,0,-1 60", "2:3: error: `0,5,0,5,1,5` has a decimal comma"),
        ("A 1 0,0,0\nC 0, 0 5 0,0,-1 60", "2:3: error: `0, 0` is not three numbers"),
        (
            "A 1 0,0,0\nC 0,0,5 0,0,-1 60\nsp 0,0,0 0 1,1,1",
            "3:10: error: the diameter is 0, but must be greater than 0",
        ),
        ("A 1 0,0,0\nC 0,0,5 0,0,-1 60\nsp 0,0,0 1,1,1", "3:1: error: `sp` lacks the diameter"),
        ("A 1 0,0,0\nC 0,0,5 0,0,-1 60\nqq 0,0,0", "3:1: error: there is no element `qq`"),
        ("A 1 0,0,0 7\nC 0,0,5 0,0,-1 60", "1:11: error: `A` has more values than this"),
        (
            "A 1 0,0,0\nC 0,0,5 0,0,-1 60\ntr 0,0,0 1,1,1 2,2,2 9,9,9",
            "3:1: error: body 1: the corners `a`, `b` and `c` lie on a line",
        ),
        ("A 1 0,0,0\nC 0,0,5 0,0,-1 60\ntr 0,0,0 1,1,1 9,9,9", "3:1: error: `tr` lacks"),
        (
            "A 1 0,0,0\nC 0,0,2e9 0,0,-1 60",
            "2:1: error: the camera: the third number of `position` is 2e9, but must be at most 1e9",
        ),
        ("A 1 0,0,0\nC 0,0,5 0,0,-1 60\nsp 0,0,0 inf 1,1,1", "3:1: error: `sp` lacks the diameter"),
    ] {
        let found = bad(FORMAT, text);
        assert!(found.starts_with(expected), "{text}\n{found}");
    }
}

#[test]
fn what_is_not_drawn_can_be_left_out() {
    let text = "A 1 0,0,0\nC 0,0,5 0,0,-1 60\nqq 0,0,0 9,9,9\nsp 0,0,0 1 1,1,1 glow=3\n\
                W 3 4\nL 0,0,9 3 1,1,1 8\n";
    assert_eq!(bad(FORMAT, text).lines().count(), 5);
    let found = good(FORMAT, text, &ImportOptions { is_approximate: true, ..ImportOptions::default() });
    assert_eq!(
        (found.scene.bodies.len(), count(&found.report, Severity::Warning)),
        (1, 5),
        "{}",
        found.report
    );
}

fn approximate() -> ImportOptions {
    ImportOptions { is_approximate: true, ..ImportOptions::default() }
}

/// A program's own options, before, between and behind the values that are needed.
#[test]
fn options_of_a_program_are_left_out_wherever_they_stand() {
    let text = "R max_depth:8 soft:1\nS name:First\nA 1 255,255,255\nC 0,0,5 0,0,-1 60 0.0 1.0\n\
                L 0,0,9 0.9 9,9,9 sr:7680,4320\n\
                sp metal 0.3 0,1,0 rough: 0.2 2 250,120,100 glossy 7 8\n\
                pl 0,0,0 0,1,0 200,200,200 cd:250,215,160:236,112,99:1\ncy GLASS 0,0,0 0,1,0 2 9,9,9 4\n";
    let found = good(FORMAT, text, &approximate());
    let shapes: Vec<_> = found.scene.bodies.iter().map(|body| body.shape).collect();
    let cylinder = Shape::Cylinder { radius: 1.0, height: 4.0 };
    assert_eq!(shapes, [Shape::Sphere { radius: 1.0 }, Shape::Plane, cylinder], "{}", found.report);
    let sphere = &found.scene.bodies[0];
    let phong = found.scene.material(&sphere.material).unwrap().as_phong().unwrap();
    assert_eq!((phong.reflection(), phong.specular, found.size), (0.0, 0.0, None));
    let said = found.report.to_string();
    for line in ["1:1: warning: `R` lacks", "2:1: warning", "5:19: warning", "6:4: warning", "7:28: warning"]
    {
        assert!(said.contains(line), "{line}\n{said}");
    }
    assert_eq!(bad(FORMAT, text).lines().count(), count(&found.report, Severity::Warning));
}

/// What would be an error of one element leaves out that element, or the nearest is taken.
#[test]
fn one_element_does_not_stop_a_scene() {
    let text = "A 1.5 300,0,-1\nC 0,0,5 0,0,-2 60\nC 1,0,0 1,0,0 60\nL 0,9,9 1 9,9,9\n\
                tr 0,0,0 1,0,0 2,0,0 9,9,9\nsp 0,0,0 0 9,9,9\ncy 0,0,0 0,0,0 1 1 9,9,9\nsq 0,0,0 0,1,0 -1 9,9,9\n\
                sp 0,0 2 9,9,9\nsp 1,0,0 2 m_wall\ntri 0,0,0 1,0,0 0,1,0 9,9,9\n";
    let found = good(FORMAT, text, &approximate());
    let bodies: Vec<_> = found.scene.bodies.iter().map(|body| body.body_shape().kind()).collect();
    assert_eq!(bodies, [ShapeKind::Sphere, ShapeKind::Triangle], "{}", found.report);
    let sphere = found.scene.material(&found.scene.bodies[0].material).unwrap().as_phong().unwrap();
    assert_eq!(sphere.pattern.color, Color::WHITE);
    assert_eq!(found.scene.environment.ambient, Color::new(1.0, 0.0, 0.0));
    assert_eq!(found.scene.camera.target, DVec3::new(0.0, 0.0, 4.0));
    assert!(found.report.to_string().contains("5:1: warning: body 1: the corners"), "{}", found.report);
    // Where nothing would be left, the errors say more.
    let nothing = "A 1 9,9,9\nC 0,0,5\nsp\nqq\n";
    let errors = read(FORMAT, nothing, &approximate()).unwrap_err();
    assert_eq!(errors.to_string(), bad(FORMAT, nothing));
}

#[test]
fn without_camera_and_ambient_light_all_bodies_are_in_view() {
    let text = "sp 10,0,0 2 9,9,9\nsp 14,0,0 2 9,9,9\nsp 1,2,3 0 9,9,9\npl 0,-9,0 0,1,0 9,9,9\n";
    assert_eq!(bad(FORMAT, text).lines().count(), 3);
    let found = good(FORMAT, text, &approximate());
    assert_eq!(found.scene.environment.ambient, Color::BLACK);
    assert_eq!(found.scene.camera.target, DVec3::X * 12.0);
    // A ball of radius 3 about (12, 0, 0) with a tenth of room touches the edge of a view of 27°.
    let distance = found.scene.camera.position.distance(found.scene.camera.target);
    assert!((distance - 3.3 / 13.5_f64.to_radians().sin()).abs() < 1e-9, "{distance}");
    // What cannot be a camera is none.
    let beyond = "A 0 9,9,9\nC 0,0,2e9 0,0,-1 60\nsp 10,0,0 2 9,9,9\n";
    assert_eq!(good(FORMAT, beyond, &approximate()).scene.camera.target, DVec3::X * 10.0);
}

#[test]
fn cones_have_the_numbers_of_the_dialect_or_their_angle_alone() {
    let shapes = |cones: &str, dialect: &str| {
        let text = format!("A 1 255,255,255\nC 0,0,5 0,0,-1 60\n{cones}");
        let found = good(FORMAT, &text, &with(&text, dialect));
        let all: Vec<_> = found.scene.bodies.iter().map(|body| (body.shape, body.placement.anchor)).collect();
        (all, found.report.to_string())
    };
    let cone = |radius: f64, height: f64| Shape::Cone { radius, top_radius: 0.0, height };
    let near = |found: Shape, expected: Shape| match (found, expected) {
        (Shape::Cone { radius: a, height: b, .. }, Shape::Cone { radius: c, height: d, .. }) => {
            (a - c).abs() < 1e-9 * c && (b - d).abs() < 1e-9 * d
        }
        _ => false,
    };
    let slope = 30_f64.to_radians().tan();
    for (numbers, dialect, radius, height) in [
        ("2 3", "", 1.0, 3.0),
        ("30 4", "", 15.0, 4.0),
        ("30 40", "cone-angle", 40.0 * slope, 40.0),
        ("4 30", "cone-angle,cone-height-first", 4.0 * slope, 4.0),
        ("4 30", "cone-height-first,radius", 30.0, 4.0),
    ] {
        let (found, report) = shapes(&format!("co 0,0,0 0,-1,0 {numbers} 9,9,9"), dialect);
        assert!(near(found[0].0, cone(radius, height)), "{numbers} {dialect}: {found:?}");
        assert!(report.contains("3:1: note: the numbers of a cone are taken as"), "{report}");
    }
    // One number: a double cone without end.
    let (found, report) = shapes("cn 1,2,3 0,-1,0 60 9,9,9", "cone-base");
    assert_eq!(found.len(), 2);
    for ((shape, anchor), side) in found.into_iter().zip([1.0, -1.0]) {
        assert!(near(shape, cone(1e4 * 0.75_f64.sqrt(), 5e3)), "{shape:?}");
        let Anchor::Axis { base, top } = anchor else { panic!("{anchor:?}") };
        assert_eq!(top, DVec3::new(1.0, 2.0, 3.0));
        assert!((base - top).abs_diff_eq(DVec3::Y * (side * 5e3), 1e-6), "{base}");
    }
    assert!(report.contains("3:1: note: a cone with one number is endless"), "{report}");
    let wide = "A 1 9,9,9\nC 0,0,5 0,0,-1 60\nco 0,0,0 0,1,0 90 9,9,9";
    assert!(bad(FORMAT, wide).starts_with("3:16: error: half the angle at the apex is 90, but must be from"));
}
