//! Scenes of other ray tracers in place of scene files.

use catoptric_picture::{BitDepth, Codes, Development, Picture, ReadOptions, ToneCurve};

use crate::common::Folder;

/// The ray of the middle pixel meets (0, 0, 1), where n·L is 3/5: its light is (1, 0.4, 0) · (0.2 + 0.5 · 0.6).
const SCENE: &str =
    "R 3 1\nA 0.2 255,255,255\nC 0,0,5 0,0,-1 60\nL 0,4,4 0.5 255,255,255\nsp 0,0,0 2 255,102,0\n";

/// Runs the program, which must end well with nothing worse than notes and warnings.
fn done(folder: &Folder, line: &str) {
    let ran = folder.run(line);
    assert!(ran.status == Some(0) && !ran.errors.contains("error"), "{line}: {ran:?}");
}

/// The codes of a pixel of a picture file.
fn codes(folder: &Folder, name: &str, x: u32) -> Vec<u8> {
    let picture: Picture = ReadOptions::default().read(&folder.path(name)).unwrap();
    let developed = Development { exposure_stops: 0.0, tone_curve: ToneCurve::None };
    match developed.develop(&picture, BitDepth::Eight).unwrap().codes() {
        Codes::Eight(codes) => codes[3 * x as usize..][..3].to_vec(),
        Codes::Sixteen(_) => panic!("asked for 8 bits"),
    }
}

#[test]
fn a_picture_has_the_size_and_the_codes_that_the_program_would_give_it() {
    let folder = Folder::new();
    folder.write("a.rt", SCENE);
    done(&folder, "render a.rt -o a.png");
    assert_eq!(codes(&folder, "a.png", 1), [128, 51, 0]);
    // The sRGB codes of half and a fifth of white.
    done(&folder, "render a.rt -o b.png --tone-curve none");
    assert_eq!(codes(&folder, "b.png", 1), [188, 124, 0]);
    done(&folder, "render a.rt -o c.png --size 1x1");
    assert_eq!(codes(&folder, "c.png", 0), [128, 51, 0]);
}

#[test]
fn notes_are_told_and_errors_end_a_command() {
    let folder = Folder::new();
    folder.write("a.rt", SCENE);
    let told = folder.run("render a.rt -o a.png");
    assert!(
        told.errors.contains("a.rt:2:7: note: colors are light in proportion to their codes"),
        "{}",
        told.errors
    );
    assert_eq!(folder.run("render a.rt -o a.png -q").errors, "");
    let found = folder.good("check a.rt");
    assert!(found.ends_with("a.rt: good, 3 notes (1 body, 1 light)\n"), "{found}");
    assert!(found.contains("2 | A 0.2 255,255,255\n"), "{found}");
    folder.write("b.rt", format!("{SCENE}to 0,0,0 1,0,0 2 1 1,2,3\nsp 0,0,0 -1 1,2,3\n"));
    let refused = folder.refused("render b.rt -o b.png");
    assert!(
        refused.contains("there is no element `to`") && refused.contains("the diameter is -1"),
        "{refused}"
    );
    assert!(!folder.path("b.png").exists());
}

#[test]
fn dialects_and_approximations_are_asked_for() {
    let folder = Folder::new();
    folder.write("a.rt", format!("{SCENE}to 0,0,0 1,0,0 2 1 1,2,3\n"));
    done(&folder, "render a.rt -o a.png --approximate");
    assert_eq!(codes(&folder, "a.png", 1), [128, 51, 0]);
    done(&folder, "check a.rt --approximate --dialect radius,vertical-fov");
    let refused = folder.refused("check a.rt --dialect diameter");
    assert!(refused.contains("radius, base, cone-base"), "{refused}");
}

#[test]
fn scenes_are_converted_both_ways() {
    let folder = Folder::new();
    folder.write("a.rt", SCENE);
    done(&folder, "convert a.rt a.toml");
    done(&folder, "convert a.rt a.yml");
    done(&folder, "convert a.toml b.rt");
    done(&folder, "render a.rt -o a.exr --size 9x9");
    for name in ["a.toml", "a.yml"] {
        done(&folder, &format!("convert {name} c.rt --size 3x1"));
        done(&folder, "render c.rt -o c.exr --size 9x9");
        done(&folder, "diff a.exr c.exr --tolerance 0.0001");
    }
    let refused = folder.run("convert a.rt a.nff");
    let said = "body 1: the format has no ambient light";
    assert!(refused.status == Some(2) && refused.errors.contains(said), "{refused:?}");
    done(&folder, "convert a.rt a.nff --approximate");
    done(&folder, "render a.nff -o n.png");
    assert_eq!(codes(&folder, "n.png", 1), [77, 31, 0]);
}
