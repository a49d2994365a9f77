//! `catoptric compare`

use std::path::Path;

use crate::common::{Folder, ONE_BODY};
use catoptric_picture::{Picture, decode, write_exr};
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
