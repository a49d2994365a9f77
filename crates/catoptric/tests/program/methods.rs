//! `catoptric render --method`

use crate::common::{Folder, ONE_BODY};
use catoptric_picture::decode;
use serde_json::Value;

const METHODS: [&str; 6] = ["whitted", "ssr", "cube-map", "phong", "gouraud", "flat"];

#[test]
fn every_method_draws_a_picture_of_its_own() {
    let folder = Folder::new();
    for method in METHODS {
        folder.good(&format!("render four-bodies -o {method}.exr --size 60x40 --method {method}"));
    }
    for (index, method) in METHODS.iter().enumerate() {
        for other in &METHODS[..index] {
            let same = folder.read(format!("{method}.exr")) == folder.read(format!("{other}.exr"));
            assert!(!same, "{method} and {other}");
        }
    }
}

#[test]
fn the_options_of_a_method_change_its_picture() {
    let folder = Folder::new();
    let options = [
        ("phong", "--fineness 2"),
        ("phong", "--shadows"),
        ("gouraud", "--model lambert"),
        ("flat", "--fineness 20"),
        ("ssr", "--ssr-step 16"),
        ("ssr", "--ssr-thickness 5"),
        ("ssr", "--ssr-range 0.5"),
        ("ssr", "--ssr-step 8 --ssr-refine 0"),
        ("ssr", "--ssr-fallback cube-map"),
        ("ssr", "--ssr-fallback cube-map --cube-size 4"),
        ("cube-map", "--cube-size 4"),
        ("cube-map", "--parallax"),
    ];
    for (method, option) in options {
        let line = format!("render four-bodies --size 120x80 --method {method}");
        folder.good(&format!("{line} -o plain.exr"));
        folder.good(&format!("{line} -o other.exr {option}"));
        assert!(folder.read("plain.exr") != folder.read("other.exr"), "{method} {option}");
    }
}

#[test]
fn options_of_other_methods_and_values_out_of_range_are_refused_with_what_to_do() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    let refusals = [
        ("--fineness 4", "--fineness has no meaning for the method whitted: it is for flat, gouraud, phong"),
        ("--method ssr --shadows", "leave it out, or give --method flat"),
        ("--method phong --layers layers", "it is for ssr, cube-map"),
        ("--method ssr --parallax", "add --ssr-fallback cube-map"),
        ("--method phong --fineness 0", "the fineness is 0; it must be from 1 to 128"),
        ("--method ssr --ssr-step nan", "the step in pixels is NaN; it must be from 0.25 to 256"),
        ("--method ssr --ssr-thickness 0", "the thickness in meters is 0"),
        ("--method cube-map --cube-size 5000", "it must be from 1 to 4096"),
    ];
    for (options, said) in refusals {
        let errors = folder.refused(&format!("render one.toml -o a.png {options}"));
        assert!(errors.contains(said), "{options}: {errors}");
    }
}

#[test]
fn layers_and_unfolded_cubes_are_written() {
    let folder = Folder::new();
    folder.good(
        "render four-bodies -o a.png --size 30x20 --method cube-map --cube-size 8 --layers made/layers",
    );
    for name in ["depth", "normal", "color", "coefficients", "body", "lit", "reflected"] {
        let picture = decode(&folder.read(format!("made/layers/{name}.png"))).unwrap();
        assert_eq!((picture.width(), picture.height()), (30, 20), "{name}");
    }
    let cube = decode(&folder.read("made/layers/cube-map-1.png")).unwrap();
    assert_eq!((cube.width(), cube.height()), (32, 24));
}

#[test]
fn statistics_tell_the_time_of_each_pass() {
    let folder = Folder::new();
    let passes = [
        ("whitted", &["trace"][..]),
        ("ssr", &["first-hits", "reflect"]),
        ("cube-map", &["first-hits", "cube-maps", "reflect"]),
        ("phong", &["tessellate", "light", "rasterize"]),
    ];
    for (method, passes) in passes {
        let line = format!("render four-bodies -o a.png --size 30x20 --method {method} --stats -");
        let stats: Value = serde_json::from_str(&folder.good(&line)).unwrap();
        assert_eq!(stats["method"], method);
        let found: Vec<&String> = stats["passes"].as_object().unwrap().keys().collect();
        assert_eq!(found, passes);
        assert!(stats["passes"].as_object().unwrap().values().all(|time| time.as_f64().unwrap() >= 0.0));
        assert_eq!(stats["cube_maps"].is_null(), method != "cube-map");
        if method == "cube-map" {
            assert!(stats["cube_maps"]["built"].as_u64().unwrap() > 0);
            assert_eq!(stats["cube_maps"]["kept"], 0);
        }
    }
}
