//! `catoptric audit` and `catoptric render --map`

use crate::common::{Folder, ONE_BODY};
use catoptric_picture::decode;
use serde_json::Value;

#[test]
fn the_sum_is_the_pixel_of_the_rendered_picture() {
    let folder = Folder::new();
    folder.good("render whitted -o w.exr --size 64x36 --samples 3 --backend cpu --quiet");
    let picture = decode(&folder.read("w.exr")).unwrap();
    for (x, y) in [(20, 18), (40, 15), (0, 0), (63, 35)] {
        let text = folder.good(&format!("audit whitted --pixel {x},{y} --size 64x36 --samples 3 --json"));
        let audit: Value = serde_json::from_str(&text).unwrap();
        let light: Vec<f32> =
            audit["light"].as_array().unwrap().iter().map(|c| c.as_f64().unwrap() as f32).collect();
        assert_eq!(light, picture.pixels()[y * 64 + x], "pixel {x},{y}");
        assert_eq!(audit["proof"], "any-order");
        assert_eq!(audit["trees"].as_array().unwrap().len(), 3);
        for tree in audit["trees"].as_array().unwrap() {
            let rays = tree["rays"].as_array().unwrap();
            let reds = rays.iter().map(|ray| ray["light"][0].as_f64().unwrap());
            assert!((reds.sum::<f64>() - tree["sum"][0].as_f64().unwrap()).abs() < 1e-12);
        }
    }
}

#[test]
fn the_tree_is_told_in_words_and_drawn() {
    let folder = Folder::new();
    let text = folder.good("audit whitted --pixel 545,330");
    for part in
        ["Pixel 545,330 of 1280x720", "└─ refracted", "highlight k_s·(Ŝ·R̂)ⁿ", "is below 0.004", "\nThe sum\n"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    let short = folder.good("audit whitted --pixel 545,330 --depth 0");
    assert!(short.len() < text.len() / 2 && short.contains("deeper in the tree"), "{short}");
    assert_eq!(folder.good("audit whitted --pixel 545,330 --svg tree.svg"), "");
    assert_eq!(folder.names(), ["tree.svg"]);
    let svg = String::from_utf8(folder.read("tree.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    let dot = folder.good("audit whitted --pixel 545,330 --dot -");
    assert!(dot.starts_with("digraph audit {") && dot.ends_with("}\n"), "{dot}");
}

#[test]
fn what_cannot_be_audited_is_refused() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    let columns = "columns go from 0 to 8, rows from 0 to 3";
    for (line, reason) in [
        ("audit one.toml --pixel 9,0 --size 9x4", columns),
        ("audit one.toml --pixel 0,4 --size 9x4", columns),
        ("audit one.toml --pixel 9", "give column and row, such as 640,360"),
        ("audit one.toml --pixel -1,2", "--pixel"),
        ("audit one.toml", "--pixel"),
        ("audit one.toml --exact --pixel 1,1", "cannot be used with"),
        ("audit one.toml --pixel 1,1 --json --svg t.svg", "cannot be used with"),
        ("audit one.toml --pixel 1,1 --svg one.toml", "uses this file"),
        ("audit nonsense --pixel 1,1", "no file and no built-in scene"),
        ("render one.toml -o m.png --map nonsense", "limit-loss"),
        ("render one.toml -o m.png --map rays --stats -", "cannot be used with"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(reason), "{line}: {errors}");
    }
    assert_eq!(folder.names(), ["one.toml"]);
}

#[test]
fn exact_answers_stand_beside_those_of_the_tracer() {
    let folder = Folder::new();
    let text = folder.good("audit ring-of-images --exact");
    assert!(text.contains(
        "5 images of \"cone\" between \"left mirror\" and \"right mirror\", which stand at 60.000°"
    ));
    let answers: Value = serde_json::from_str(&folder.good("audit lens --exact --json")).unwrap();
    let focus =
        answers["answers"].as_array().unwrap().iter().find(|answer| answer["kind"] == "focus").unwrap();
    assert!((focus["focal_length"].as_f64().unwrap() - 1.5).abs() < 1e-12);
    assert!(focus["marginal"]["difference"].as_f64().unwrap() < 1e-5);
    folder.write("one.toml", ONE_BODY);
    assert!(folder.good("audit one.toml --exact").contains("no mirrors"));
}

#[test]
fn maps_are_pictures_with_a_legend_or_numbers() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    for map in ["generations", "rays", "limit-loss", "threshold-loss", "clipped"] {
        assert_eq!(folder.good(&format!("render one.toml -o {map}.png --size 40x30 --map {map}")), "");
        let picture = decode(&folder.read(format!("{map}.png"))).unwrap();
        assert!(picture.width() == 40 && picture.height() > 30, "{map}");
    }
    folder.good("render one.toml -o rays.exr --size 40x30 --map rays");
    let rays = decode(&folder.read("rays.exr")).unwrap();
    assert_eq!((rays.width(), rays.height()), (40, 30));
    // One ray into the background; one more to the light where the ball is lit.
    assert_eq!((rays.pixels()[0], rays.pixels()[15 * 40 + 20]), ([1.0; 3], [2.0; 3]));
}
