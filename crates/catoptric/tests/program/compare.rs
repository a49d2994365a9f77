//! `catoptric compare`

use std::path::Path;

use crate::common::{Folder, ONE_BODY};
use catoptric_picture::{Picture, PictureFormat, SaveOptions, decode, write_exr};
use serde_json::Value;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("ball.toml", ONE_BODY);
    for (name, light) in [("a.exr", 0.25), ("b.exr", 0.5)] {
        write_exr(&folder.path(name), &Picture::from_fn(64, 36, |_, _| [light; 3]).unwrap()).unwrap();
    }
    folder
}

fn metrics(folder: &Folder, directory: &str) -> Value {
    serde_json::from_slice(&folder.read(format!("{directory}/metrics.json"))).unwrap()
}

#[test]
fn methods_are_compared_and_reported() {
    let folder = folder();
    let output =
        folder.good("compare ball.toml --methods whitted,phong,flat:fineness=2 --size 64x36 --runs 1");
    assert_eq!(output.lines().count(), 3);
    assert!(output.ends_with(&format!("report: {}\n", Path::new("compared").join("report.html").display())));
    assert!(output.contains("phong") && output.contains("flat:fineness=2"), "{output}");
    let names = ["1-whitted.png", "2-phong.png", "2-phong-difference.png", "3-flat-fineness-2-flip.png"];
    for name in names {
        decode(&folder.read(format!("compared/{name}"))).unwrap();
    }
    let value = metrics(&folder, "compared");
    assert_eq!(value["truth"]["name"], "whitted");
    let flip = |index: usize| value["others"][index]["flip"].as_f64().unwrap();
    assert!(flip(0) < flip(1), "smooth normals are nearer than four faces: {value}");
    let page = String::from_utf8(folder.read("compared/report.html")).unwrap();
    assert!(page.contains("lang=\"en\"") && page.contains("flat:fineness=2"));
}

#[test]
fn pictures_alone_and_beside_a_scene() {
    let folder = folder();
    folder.good("compare --pictures a.exr,b.exr -o files --language ru");
    let value = metrics(&folder, "files");
    assert!((value["others"][0]["rmse"].as_f64().unwrap() - 0.25).abs() < 1e-9, "{value}");
    let page = String::from_utf8(folder.read("files/report.html")).unwrap();
    assert!(page.contains("lang=\"ru\"") && page.contains("0,2500"));
    folder.good("compare ball.toml --methods whitted --pictures a.exr --size 64x36 --runs 1 -o both --quiet");
    assert_eq!(metrics(&folder, "both")["others"][0]["name"], "a.exr");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = folder();
    write_exr(&folder.path("small.exr"), &Picture::new(10, 9).unwrap()).unwrap();
    for (line, said) in [
        ("compare ball.toml -o out", "--methods"),
        ("compare -o out", "<SCENE>"),
        ("compare ball.toml --methods whitted -o out", "two pictures or more"),
        ("compare ball.toml --methods whitted,raster -o out", "there is no method \"raster\""),
        ("compare ball.toml --methods whitted,ssr:speed=3 -o out", "has no setting \"speed\""),
        (
            "compare ball.toml --methods whitted --pictures a.exr -o out",
            "give --size as the pictures have it",
        ),
        ("compare --pictures a.exr,small.exr -o out", "small.exr has 10x9 pixels, the others have 64x36"),
        ("compare --pictures a.exr,none.exr -o out", "none.exr"),
        ("compare none.toml --methods whitted,flat -o out", "none.toml"),
        ("compare --pictures a.exr,b.exr -o a.exr", "cannot make the directory a.exr"),
        ("compare --pictures a.exr,b.exr -o out --language de", "give en or ru"),
        ("compare --pictures a.exr,b.exr -o out --tolerance -1", "0 or more"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
}

/// A ball to the left of the middle, and one above it that throws a shadow on it.
const BALLS: &str = "R 64 48\nA 0.2 255,255,255\nC 0,0,6 0,0,-1 50\nL 2,6,6 0.7 255,255,255\n\
                     sp -0.6,-0.4,0 3 255,102,51\nsp 0.6,1.6,2 0.8 51,102,255\n";

#[test]
fn a_right_picture_is_right_whatever_its_format() {
    let folder = Folder::new();
    folder.write("a.rt", BALLS);
    for name in ["a.ppm", "a.png", "a.exr"] {
        folder.good(&format!("render a.rt -o {name} -q"));
        let told = folder.good(&format!("compare a.rt --pictures {name} -q"));
        assert!(told.starts_with(&format!("{name}: right: 100")), "{told}");
    }
    // In a JPEG edges disturb their blocks, and nothing else.
    folder.good("render a.rt -o a.jpg -q");
    folder.good("compare a.rt --pictures a.jpg -q");
    folder.good("render a.rt -o smooth.jpg --samples 16 -q");
    folder.good("compare a.rt --pictures smooth.jpg -q");
    // The codes are the same, unless they are antialiased.
    folder.good("compare a.rt --pictures a.ppm,a.png,a.exr --tolerance 0 --allow 0 -q");
    folder.good("render a.rt -o smooth.png --samples 16 -q");
    folder.good("compare a.rt --pictures smooth.png -q");
    assert_eq!(folder.run("compare a.rt --pictures smooth.png --tolerance 0 -q").status, Some(1));
    folder.good("render a.rt -o srgb.png --tone-curve none -q");
    folder.good("compare a.rt --pictures srgb.png --tone-curve none -q");
    let told = folder.run("compare a.rt --pictures srgb.png -q");
    assert_eq!(told.status, Some(1));
    assert!(
        told.output.contains("codes have the sRGB curve (gamma), though linear ones are expected"),
        "{told:?}"
    );
}

#[test]
fn pixels_that_no_edge_explains_are_wrong() {
    let folder = Folder::new();
    folder.write("a.rt", BALLS);
    folder.good("render a.rt -o a.ppm -q");
    let mut picture = decode(&folder.read("a.ppm")).unwrap();
    let width = picture.width() as usize;
    for place in [0, 1, width, width + 1] {
        picture.pixels_mut()[5 * width + 9 + place] = [1.0; 3];
    }
    for (name, format) in [("block.png", PictureFormat::Png), ("block.jpg", PictureFormat::Jpeg)] {
        let options = SaveOptions::new(format, None).unwrap();
        options.prepare(&picture).unwrap().write(&folder.path(name)).unwrap();
        let told = folder.run(&format!("compare a.rt --pictures {name} -q"));
        assert_eq!(told.status, Some(1), "{told:?}");
        let first = told.output.lines().nth(1).unwrap();
        assert!(first.contains("look first at pixel") && first.contains("background"), "{told:?}");
    }
}

#[test]
fn mistakes_are_named_with_their_keys() {
    let folder = Folder::new();
    folder.write("a.rt", BALLS);
    folder.good("render a.rt -o wide.ppm --dialect vertical-fov -q");
    folder.good("render a.rt -o small.ppm --size 32x24 -q");
    let told = folder.run("compare a.rt --pictures wide.ppm,small.ppm --json -q");
    assert_eq!(told.status, Some(1), "{told:?}");
    let value: Value = serde_json::from_str(&told.output).unwrap();
    assert_eq!(value["right"], false);
    let [wide, small] = [&value["pictures"][0], &value["pictures"][1]];
    assert_eq!(wide["mistakes"][0]["key"], "field-of-view-taken-as-vertical", "{value}");
    assert_eq!(small["mistakes"][0]["key"], "size", "{value}");
    assert_eq!(small["mistakes"][0]["expected_size"], serde_json::json!([64, 48]));
    assert!(
        wide["share_agreeing"].as_f64().unwrap() < 0.9 && wide["share_explained"].as_f64().unwrap() > 0.99
    );
}

#[test]
fn a_page_tells_what_was_found() {
    let folder = Folder::new();
    folder.write("a.rt", BALLS);
    folder.write("b.rt", BALLS.replace("0.8 51,102,255", "1.3 51,255,255"));
    folder.good("render b.rt -o b.ppm -q");
    folder.good("render a.rt -o a.ppm -q");
    let told = folder.run("compare a.rt --pictures b.ppm,a.ppm -o checked -q");
    assert_eq!(told.status, Some(1), "{told:?}");
    let page = std::fs::read_to_string(folder.path("checked/report.html")).unwrap();
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(&page, options).unwrap();
    let texts = |name: &str| -> Vec<String> {
        let nodes = document.descendants().filter(|node| node.has_tag_name(name));
        nodes
            .map(|node| {
                node.descendants().filter(roxmltree::Node::is_text).filter_map(|node| node.text()).collect()
            })
            .collect()
    };
    assert_eq!(texts("h2"), ["b.ppm: different", "a.ppm: right"]);
    assert_eq!(document.descendants().filter(|node| node.has_tag_name("image")).count(), 4);
    let places = document.descendants().filter(|node| node.has_tag_name("circle")).count();
    assert!(places >= 2 && places % 2 == 0, "the same places in both pictures");
    assert!(texts("pre").iter().any(|audit| audit.contains("Ray 1: primary")));
    let found: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path("checked/metrics.json")).unwrap()).unwrap();
    assert_eq!((&found["right"], &found["pictures"][1]["right"]), (&false.into(), &true.into()));
}

#[test]
fn the_worst_pixels_are_audited() {
    let folder = Folder::new();
    folder.write("a.rt", BALLS);
    // Another ball in the place of the small one.
    folder.write("b.rt", BALLS.replace("0.8 51,102,255", "1.3 51,255,255"));
    folder.good("render b.rt -o b.ppm -q");
    let told = folder.run("compare a.rt --pictures b.ppm --pixels 1 --language ru -q");
    assert_eq!(told.status, Some(1), "{told:?}");
    assert!(told.output.starts_with("b.ppm: отличается: ") && told.output.contains("шар 2"), "{told:?}");
    assert!(told.output.contains("Ray 1: primary"), "the audit of a pixel: {told:?}");
    for (line, said) in [
        ("compare a.rt --pictures a.rt", "a.rt"),
        ("compare a.rt --pictures b.ppm --methods whitted --json", "--json"),
    ] {
        assert!(folder.refused(line).contains(said), "{line}");
    }
}
