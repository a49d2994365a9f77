//! `catoptric diff`

use crate::common::Folder;
use catoptric_picture::{Picture, decode, write_exr};
use serde_json::Value;

/// Two pictures of 10x10 pixels, of which one pixel differs by 0.1.
fn folder() -> Folder {
    let folder = Folder::new();
    let mut picture = Picture::new(10, 10).unwrap();
    write_exr(&folder.path("a.exr"), &picture).unwrap();
    picture.pixels_mut()[42] = [0.0, 0.1, 0.0];
    write_exr(&folder.path("b.exr"), &picture).unwrap();
    folder
}

#[test]
fn equal_pictures_are_equal() {
    let output = folder().good("diff a.exr a.exr --tolerance 0");
    assert!(output.ends_with("\nequal within the tolerance\n") && output.contains("infinite"), "{output}");
}

#[test]
fn a_difference_is_exit_status_1() {
    let folder = folder();
    for line in ["diff a.exr b.exr", "diff b.exr a.exr --tolerance 0.0999", "diff a.exr b.exr --allow 0.009"]
    {
        let ran = folder.run(line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(1), ""), "{line}: {ran:?}");
        assert!(ran.output.ends_with("\ndifferent\n"), "{ran:?}");
        assert!(ran.output.contains("0.100000 at pixel 2,4\n"), "{ran:?}");
        assert!(ran.output.contains("  1 of 100 pixels, 1.0000 %\n"), "{ran:?}");
    }
}

#[test]
fn tolerance_and_allowance_forgive() {
    let folder = folder();
    for option in ["--tolerance 0.11", "--tolerance 1/9", "--allow 0.01", "--allow 1/100"] {
        assert!(
            folder.good(&format!("diff a.exr b.exr {option}")).ends_with("\nequal within the tolerance\n")
        );
    }
}

#[test]
fn values_beyond_white_count_only_unclamped() {
    let folder = folder();
    for (name, light) in [("white.exr", 1.0), ("sun.exr", 50.0)] {
        write_exr(&folder.path(name), &Picture::from_fn(2, 2, |_, _| [light; 3]).unwrap()).unwrap();
    }
    folder.good("diff white.exr sun.exr --tolerance 0");
    assert_eq!(folder.run("diff white.exr sun.exr --unclamped").status, Some(1));
}

#[test]
fn pixels_that_are_no_numbers_never_pass() {
    let folder = folder();
    write_exr(&folder.path("nan.exr"), &Picture::from_fn(10, 10, |_, _| [f32::NAN; 3]).unwrap()).unwrap();
    let ran = folder.run("diff nan.exr nan.exr --tolerance 2");
    assert_eq!(ran.status, Some(1));
    assert!(ran.output.contains("not a number   100 pixels\n"), "{ran:?}");
    let ran = folder.run("diff nan.exr a.exr --unclamped --json");
    let value: Value = serde_json::from_str(&ran.output).unwrap();
    assert_eq!((&value["pixels_not_a_number"], &value["max"]), (&100.into(), &Value::Null));
}

#[test]
fn the_numbers_come_as_json() {
    let ran = folder().run("diff a.exr b.exr --json");
    assert_eq!(ran.status, Some(1));
    let value: Value = serde_json::from_str(&ran.output).unwrap();
    assert_eq!((&value["width"], &value["height"]), (&10.into(), &10.into()));
    assert_eq!(value["equal"], false);
    assert_eq!(value["pixels_above"], 1);
    assert_eq!(value["worst_pixel"], serde_json::json!([2, 4]));
    assert_eq!(value["share_above"], 0.01);
    assert!((value["max"].as_f64().unwrap() - 0.1).abs() < 1e-6);
    assert_eq!(value["ssim"], Value::Null, "10x10 pixels are too few");
    for key in ["flip", "mean", "rmse", "psnr_db", "tolerance", "share_allowed", "pixels_not_a_number"] {
        assert!(value[key].is_number(), "{key}");
    }
}

#[test]
fn how_different_they_look_is_told() {
    let folder = Folder::new();
    for (name, light) in [("black.exr", 0.0), ("white.exr", 1.0)] {
        write_exr(&folder.path(name), &Picture::from_fn(16, 16, |_, _| [light; 3]).unwrap()).unwrap();
    }
    // 0.9674 is the authors' own program's; the similarity is C1 / (1 + C1).
    let output = folder.run("diff black.exr white.exr").output;
    assert!(output.contains("\nSSIM           0.000100\nFLIP           0.967"), "{output}");
    let value: Value = serde_json::from_str(&folder.run("diff black.exr white.exr --json").output).unwrap();
    assert!((value["flip"].as_f64().unwrap() - 0.96739).abs() < 5e-5, "{value}");
    assert!((value["ssim"].as_f64().unwrap() - 1e-4).abs() < 1e-6, "{value}");
    assert!(
        folder
            .good("diff white.exr white.exr")
            .contains("\nSSIM           1.000000\nFLIP           0.000000\n")
    );
}

#[test]
fn the_heat_map_is_written_whatever_the_verdict() {
    let folder = folder();
    assert_eq!(folder.run("diff a.exr b.exr --heat heat.png").status, Some(1));
    let map = decode(&folder.read("heat.png")).unwrap();
    assert_eq!(map.width(), 10);
    let light = |x, y| map.pixel(x, y).unwrap().iter().sum::<f32>();
    assert!(light(2, 4) > 10.0 * light(0, 0));
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = folder();
    folder.write("text.png", "no picture");
    folder.write("empty.png", "");
    write_exr(&folder.path("small.exr"), &Picture::new(10, 9).unwrap()).unwrap();
    let whole = folder.read("b.exr");
    folder.write("cut.exr", &whole[..whole.len() / 2]);
    for (line, said) in [
        ("diff a.exr small.exr", "cannot compare a.exr and small.exr: the pictures differ in size"),
        ("diff a.exr no.png", "cannot open no.png"),
        ("diff a.exr text.png", "text.png: this is none of the formats that are read"),
        ("diff a.exr empty.png", "empty.png: the file is empty"),
        ("diff a.exr cut.exr", "cut.exr: "),
        ("diff a.exr .", "not a plain file"),
        ("diff a.exr", "<B>"),
        ("diff a.exr b.exr --tolerance -1", "0 or more"),
        ("diff a.exr b.exr --tolerance 1/0", "0 or more"),
        ("diff a.exr b.exr --allow 1.5", "from 0 to 1"),
        ("diff a.exr b.exr --heat heat.exr", "ends in .png"),
        ("diff a.exr b.exr --heat no/heat.png", "there is no directory no"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
    std::fs::copy(folder.path("a.exr"), folder.path("a.png")).unwrap();
    assert!(folder.refused("diff a.png b.exr --heat ./a.png").contains("cannot write ./a.png"));
}
