//! `catoptric measure`

use crate::common::{Folder, ONE_BODY};
#[cfg(unix)]
use crate::common::{Ran, signal, signals_work, skip};

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("ball.toml", ONE_BODY);
    folder
}

#[test]
fn a_sweep_writes_its_chapter() {
    let folder = folder();
    let line =
        "measure ball.toml --vary generations=1,2,3,search --size 32x18 --rounds 2 -o out --language ru";
    let output = folder.good(line);
    assert_eq!(output.lines().count(), 3, "{output}");
    let text = |name: &str| String::from_utf8(folder.read(format!("out/{name}"))).unwrap();
    assert_eq!(text("points.csv").lines().count(), 1 + 6);
    assert_eq!(text("runs.csv").lines().count(), 1 + 12);
    assert!(
        text("report.md").contains("Число поколений K") && text("report.tex").contains("\\begin{tabular}")
    );
    for name in ["time.svg", "rays.svg"] {
        assert!(text(name).starts_with("<svg "), "{name}");
    }
    assert!(
        folder.read("out/time.png").starts_with(b"\x89PNG")
            && folder.read("out/rays.png").starts_with(b"\x89PNG")
    );
}

/// The pictures get brighter with their only light, and nothing grows by a law.
#[test]
fn a_sweep_over_a_value_of_the_scene_tells_what_the_pictures_answer() {
    let folder = folder();
    let output = folder.good(
        "measure ball.toml --vary lights.0.intensity=1..3:3 --answers mean,pixel:16,9,flip,rays --size 32x18 \
         --set environment.ambient=0,0,0 --set environment.background=0,0,0 --rounds 1 -o out",
    );
    assert!(output.starts_with("No law is expected of a value of the scene.\n"), "{output}");
    let csv = String::from_utf8(folder.read("out/points.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), ["lights.0.intensity", "1", "2", "3"]);
    let column = |name: &str| -> Vec<f64> {
        let column = rows[0].iter().position(|head| *head == name).unwrap();
        rows[1..].iter().map(|row| row[column].parse().unwrap()).collect()
    };
    let mean = column("mean_green");
    assert!(mean[0] > 0.001, "{csv}");
    assert!((mean[1] / mean[0] - 2.0).abs() < 1e-5 && (mean[2] / mean[0] - 3.0).abs() < 1e-5, "{csv}");
    let flip = column("flip");
    assert!(flip[0] == 0.0 && flip[1] > 0.0 && flip[2] > flip[1], "{csv}");
    for name in ["mean.png", "pixel-16-9.svg", "flip.svg", "rays.svg"] {
        assert!(!folder.read(format!("out/{name}")).is_empty());
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let folder = folder();
    for (line, said) in [
        ("measure ball.toml -o out", "--vary"),
        ("measure ball.toml --vary speed -o out", "cannot vary \"speed\""),
        ("measure ball.toml --vary size=5 -o out", "size cannot be \"5\""),
        ("measure ball.toml --vary size,bodies,search -o out", "one parameter or two"),
        ("measure ball.toml --vary size --rounds 0 -o out", "1..=1000"),
        ("measure ball.toml --vary size --method raster -o out", "there is no method \"raster\""),
        ("measure none.toml --vary size -o out", "none.toml"),
        ("measure ball.toml --vary camera.fov -o out", "give values, as in camera.fov=20,40"),
        ("measure ball.toml --vary camera.fov=0..5:3 -o out", "camera.fov cannot be 0: `fov` is `0`"),
        ("measure ball.toml --vary size --answers median -o out", "--answers: \"median\" cannot be asked"),
        ("measure ball.toml --vary size --answers flip -o out", "flip compares pictures of one size"),
        ("measure ball.toml --vary size -o ball.toml", "cannot make the directory ball.toml"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
}

/// Ctrl-C keeps what was measured.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_is_kept() {
    if !signals_work() {
        return;
    }
    let folder = folder();
    let child = folder
        .command("measure ball.toml --vary size=64x36,1280x720 --rounds 1000 -o out".split(' '))
        .spawn()
        .unwrap();
    // The directory is made right before the first drawing.
    while !folder.path("out").exists() {
        std::thread::yield_now();
    }
    std::thread::sleep(std::time::Duration::from_secs(1));
    signal(&child, "INT");
    let ran = Ran::of(child.wait_with_output().unwrap());
    assert_eq!(ran.status, Some(130), "{ran:?}");
    if ran.errors.contains("nothing was written") {
        return skip("no picture was measured within a second");
    }
    let report = String::from_utf8(folder.read("out/report.md")).unwrap();
    assert!(report.contains("The measurement was interrupted"), "{report}");
}
