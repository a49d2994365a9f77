//! `catoptric compare --class`

use std::fs;
use std::path::Path;

use crate::common::Folder;
use crate::independent::{Encoding, IndependentTracer, Slip};
use catoptric_picture::{BitDepth, Development, Picture, encode_png, srgb};
use catoptric_scene::Scene;
use serde_json::Value;

const SIZE: [u32; 2] = [48, 36];

/// The scenes of the class: each shows every mistake of [`STUDENTS`].
const SCENES: [(&str, &str); 4] = [
    (
        "1-balls",
        "[[bodies]]\nshape = 'plane'\nposition = [0, -1, 0]\nmaterial = { color = [0.7, 0.7, 0.6] }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [-0.9, 0, 0]\nradius = 0.8\n\
         material = { color = [0.9, 0.3, 0.2], specular = 0.6, shininess = 20 }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [1, -0.2, 0.6]\nradius = 0.5\n\
         material = { color = [0.2, 0.4, 0.9], specular = 0.5, shininess = 30 }\n",
    ),
    (
        "2-mirror",
        "[[bodies]]\nshape = 'plane'\nposition = [0, -1, 0]\nmaterial = { color = [0.5, 0.8, 0.5] }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [0.7, 0.1, -0.4]\nradius = 0.9\n\
         material = { color = [0.6, 0.5, 0.2], specular = 0.5, shininess = 25, reflection = 0.4 }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [-1.1, -0.3, 0.4]\nradius = 0.55\n\
         material = { color = [0.8, 0.2, 0.7], specular = 0.6, shininess = 15 }\n",
    ),
    (
        "3-egg",
        "[[bodies]]\nshape = 'plane'\nposition = [0, -1, 0]\nmaterial = { color = [0.8, 0.6, 0.5] }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [-0.5, 0, 0]\nscale = [0.6, 1, 0.6]\nradius = 0.9\n\
         material = { color = [0.3, 0.7, 0.8], specular = 0.6, shininess = 12 }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [1.1, -0.4, 0.3]\nradius = 0.6\n\
         material = { color = [0.9, 0.8, 0.1], specular = 0.4, shininess = 40 }\n",
    ),
    (
        "4-row",
        "[[bodies]]\nshape = 'plane'\nposition = [0, -1, 0]\nmaterial = { color = [0.6, 0.6, 0.8] }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [-1.2, -0.3, 0.5]\nradius = 0.7\n\
         material = { color = [0.9, 0.4, 0.1], specular = 0.5, shininess = 18 }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [0.3, -0.4, 0]\nradius = 0.6\n\
         material = { color = [0.2, 0.8, 0.3], specular = 0.5, shininess = 18 }\n\
         [[bodies]]\nshape = 'sphere'\nposition = [1.4, -0.5, -0.8]\nradius = 0.5\n\
         material = { color = [0.3, 0.3, 0.9], specular = 0.5, shininess = 18 }\n",
    ),
];

/// What all scenes have.
const HEAD: &str = "format = 'catoptric/1'\n\
    environment = { background = [0.1, 0.15, 0.25], ambient = [0.3, 0.3, 0.3] }\n\
    camera = { position = [0.3, 0.9, 5], target = [0, -0.1, 0], fov = 42 }\n\
    [[lights]]\nposition = [3, 5, 4]\nintensity = 0.7\n";

const RUBRIC: &str = "\
points = 10
floor = 1
repeated = 0.5

[groups]
light = 4
highlights = 2

[mistakes]
no-ambient = 3
half-pixel = 0
flipped-top-to-bottom = 9.5
flipped-left-to-right = 2.5
red-and-blue-exchanged = 1.5
exposure = 1
diameter-taken-as-radius = 6

[scenes.4-row]
points = 20
";

/// The students, what their programs do wrong, and by hand the points of their pictures by [`RUBRIC`]: a mistake costs half
/// from the second picture on, and the last picture is worth 20.
const STUDENTS: [(&str, &[Slip], [f64; 4]); 10] = [
    ("ann", &[], [10.0, 10.0, 10.0, 20.0]),
    ("bob", &[Slip::NoShadows], [6.0, 8.0, 8.0, 18.0]),
    ("cid", &[Slip::FlippedDown], [1.0, 5.25, 5.25, 15.25]),
    ("dan", &[Slip::NoAmbient], [7.0, 8.5, 8.5, 18.5]),
    ("eve", &[Slip::NoSpecular], [8.0, 9.0, 9.0, 19.0]),
    ("fay", &[Slip::Corners], [10.0, 10.0, 10.0, 20.0]),
    ("gus", &[Slip::BlueFirst], [8.5, 9.25, 9.25, 19.25]),
    ("hal", &[Slip::DoubledRadius], [4.0, 7.0, 7.0, 17.0]),
    ("ida", &[Slip::LeftHanded, Slip::NoShadows], [3.5, 6.75, 6.75, 16.75]),
    ("jon", &[Slip::Darker], [9.0, 9.5, 9.5, 19.5]),
];

fn text_of(body: &str) -> String {
    format!("{HEAD}{body}")
}

fn scene(body: &str) -> Scene {
    catoptric_scene::read(&text_of(body)).into_result().unwrap().value
}

/// A picture of the independent tracer as a file of PNG, codes by the sRGB curve.
fn png(scene: &Scene, slips: &[Slip]) -> Vec<u8> {
    let codes = IndependentTracer::new(scene, slips).codes(SIZE, Encoding::Srgb);
    let light = |code: u8| srgb::decode(f64::from(code) / 255.0) as f32;
    let pixels = codes.iter().map(|code| code.map(light)).collect();
    let picture = Picture::from_pixels(SIZE[0], SIZE[1], pixels).unwrap();
    encode_png(&Development::default().develop(&picture, BitDepth::Eight).unwrap()).unwrap()
}

fn write(folder: &Folder, name: &str, content: impl AsRef<[u8]>) {
    fs::create_dir_all(folder.path(name).parent().unwrap()).unwrap();
    folder.write(name, content);
}

/// A folder with the scenes.
fn with_scenes() -> Folder {
    let folder = Folder::new();
    for (name, body) in SCENES {
        write(&folder, &format!("scenes/{name}.toml"), text_of(body));
    }
    folder.write("rubric.toml", RUBRIC);
    folder
}

fn json(folder: &Folder, name: &str) -> Value {
    serde_json::from_slice(&folder.read(name)).unwrap()
}

#[test]
fn forty_pictures_get_the_points_computed_by_hand() {
    let folder = with_scenes();
    for (name, body) in SCENES {
        let scene = scene(body);
        for (student, slips, _) in STUDENTS {
            write(&folder, &format!("class/{student}/{name}.png"), png(&scene, slips));
        }
    }
    let told =
        folder.run("compare --class class --scenes scenes --rubric rubric.toml --size 48x36 -o marked");
    assert_eq!((told.status, told.errors.as_str()), (Some(1), ""), "{told:?}");
    let marks = json(&folder, "marked/metrics.json");
    let students = marks["students"].as_array().unwrap();
    assert_eq!(students.len(), STUDENTS.len());
    for (found, (student, slips, points)) in students.iter().zip(STUDENTS) {
        assert_eq!(found["student"], student);
        let pictures = found["pictures"].as_array().unwrap();
        for (picture, points) in pictures.iter().zip(points) {
            let keys: Vec<&str> = picture["deductions"]
                .as_array()
                .unwrap()
                .iter()
                .map(|own| own["key"].as_str().unwrap())
                .collect();
            let mut expected: Vec<&str> = slips.iter().map(|slip| slip.key()).collect();
            expected.sort_unstable();
            assert_eq!(keys, expected, "{student}: {picture}");
            assert_eq!(picture["points"], points, "{student}: {picture}");
        }
        let total: f64 = points.iter().sum();
        assert_eq!((&found["points"], &found["of"]), (&total.into(), &50.0.into()), "{student}");
        assert!(told.output.contains(&format!("{student}  {total} of 50 points\n")), "{told:?}");
        let gradescope = json(&folder, &format!("marked/gradescope/{student}.json"));
        assert_eq!(gradescope["score"], total, "{gradescope}");
        let submitty = json(&folder, &format!("marked/submitty/{student}.json"));
        assert_eq!(submitty["data"]["score"], total / 50.0, "{submitty}");
    }
    let csv = String::from_utf8(folder.read("marked/pictures.csv")).unwrap();
    assert_eq!(csv.lines().count(), 41);
    assert!(
        csv.contains("ida,1-balls,ida/1-balls.png,3.5,10,different,flipped-left-to-right no-shadows,"),
        "{csv}"
    );
    let totals = String::from_utf8(folder.read("marked/students.csv")).unwrap();
    assert!(totals.contains("bob,40,50,80.0,0,4,0,0,0\r\n"), "{totals}");
    let page = String::from_utf8(folder.read("marked/report.html")).unwrap();
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let page = roxmltree::Document::parse_with_options(&page, options).unwrap();
    assert_eq!(page.descendants().filter(|node| node.has_tag_name("article")).count(), 40);
    roxmltree::Document::parse(&String::from_utf8(folder.read("marked/junit.xml")).unwrap()).unwrap();
}

#[test]
fn what_is_missing_broken_or_in_the_way_stops_nobody() {
    let folder = with_scenes();
    let (name, body) = SCENES[0];
    let right = png(&scene(body), &[]);
    let file = format!("scenes/{name}.toml");
    write(&folder, "files/right.png", &right);
    write(&folder, "files/broken.png", &right[..right.len() / 2]);
    folder.write("scenes/wrong.toml", "format = 'catoptric/1'\n[camera]\nfov = 300\n");
    let rows = [
        "Student;Scene;Picture".to_owned(),
        format!("=HYPERLINK(\"\"x\"\");{file};files/right.png"),
        format!("\"</script>\"\"\";{file};files/broken.png"),
        format!("Zoë;{file};files/none.png"),
        format!("Zoë;{file};files/right.png"),
        "Zoë;scenes/wrong.toml;files/right.png".to_owned(),
        format!("Ян;{file};"),
    ];
    folder.write("class.csv", rows.join("\n"));
    let told = folder.run("compare --class class.csv -o marked --language ru --json");
    assert_eq!(told.status, Some(2), "a scene cannot be used: {told:?}");
    assert!(
        told.errors.contains("class.csv:5:1") && told.errors.contains("scenes/wrong.toml:3:7"),
        "{told:?}"
    );
    let marks: Value = serde_json::from_str(&told.output).unwrap();
    let told: Vec<[String; 4]> = marks["students"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|student| {
            student["pictures"].as_array().unwrap().iter().map(|picture| {
                [&student["student"], &picture["outcome"], &picture["points"], &picture["of"]]
                    .map(|value| value.as_str().map_or_else(|| value.to_string(), str::to_owned))
            })
        })
        .collect();
    let row = |student: &str, outcome: &str, points: &str, of: &str| {
        [student, outcome, points, of].map(str::to_owned)
    };
    assert_eq!(
        told,
        [
            row("=HYPERLINK(\"\"x\"\")", "right", "10.0", "10.0"),
            row("</script>\"", "unreadable", "0.0", "10.0"),
            row("Zoë", "missing", "0.0", "10.0"),
            row("Zoë", "unmarked", "0.0", "0.0"),
            row("Ян", "missing", "0.0", "10.0"),
        ]
    );
    let page = String::from_utf8(folder.read("marked/report.html")).unwrap();
    assert!(page.contains("lang=\"ru\"") && page.contains("Изображения нет."));
    assert_eq!(page.matches("</script>").count(), 1);
    let names = fs::read_dir(folder.path("marked/gradescope")).unwrap();
    let mut names: Vec<String> = names.map(|name| name.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["HYPERLINK---x.json", "Zoë.json", "script.json", "Ян.json"]);
}

#[test]
fn a_student_alone_is_a_class_too() {
    let folder = with_scenes();
    let (name, body) = SCENES[0];
    write(&folder, &format!("submission/{name}.png"), png(&scene(body), &[]));
    let scene = format!("scenes/{name}.toml");
    let output = folder.good(&format!("compare {scene} --class submission -o out"));
    assert!(output.starts_with("submission  10 of 10 points\n"), "{output}");
    assert_eq!(json(&folder, "out/gradescope/submission.json")["tests"][0]["status"], "passed");
    // The folder of the results is not a student.
    let output = folder.good(&format!("compare {scene} --class submission -o submission/marked -q"));
    assert_eq!(output, "");
    let output = folder.good(&format!("compare {scene} --class submission -o submission/marked"));
    assert_eq!(output.lines().count(), 2, "{output}");
}

#[test]
fn classes_that_cannot_be_marked_are_refused() {
    let folder = with_scenes();
    fs::create_dir_all(folder.path("class/ann")).unwrap();
    fs::create_dir_all(folder.path("empty")).unwrap();
    folder.write("1-balls.rt", "");
    folder.write("heads.csv", "a,b,c\n");
    folder.write("rubric-2.toml", "[mistakes]\nno-shadow = 1\n");
    for (line, said) in [
        ("compare --class class", "name the scenes with --scenes"),
        ("compare --class class --scenes scenes 1-balls.rt", "have the same name"),
        ("compare --class class --scenes empty", "has no scene file in it"),
        ("compare --class empty --scenes scenes", "neither folders nor pictures"),
        ("compare --class none.csv", "none.csv"),
        ("compare --scenes scenes --pictures a.png", "cannot be used with"),
        ("compare whitted --rubric rubric.toml", "--class"),
        ("compare --class class --pictures a.png", "cannot be used with"),
    ] {
        let told = folder.refused(line);
        assert!(told.contains(said), "{line}: {told}");
    }
    for (line, said) in [
        ("compare --class heads.csv", "heads.csv:1:1"),
        ("compare --class class --scenes scenes --rubric rubric-2.toml", "did you mean `no-shadows`?"),
    ] {
        let told = folder.run(line);
        assert!(told.status == Some(2) && told.errors.contains(said), "{line}: {told:?}");
        assert!(!Path::new(&folder.path("marked")).exists(), "{line}");
    }
}
