//! `--set`

use catoptric_scene::{Example, Scene, SceneEdit, read, write};

use crate::common::{Folder, NOTHING, ONE_BODY};

const EDITS: [&str; 6] = [
    "bodies.ball.radius=0.7",
    "camera.position.y=3",
    "tracing.generations=3",
    "lights.0.color=#ff8040",
    "environment.sky.zenith=0.1,0.2,0.9",
    "bodies.ball.material.model=mirror",
];

/// A folder with a scene, and with that scene in which the values are set.
fn folder() -> (Folder, String) {
    let folder = Folder::new();
    let text = "format = 'catoptric/1'\n[[bodies]]\nname = 'ball'\nposition = [0, 1, 0]\n[[bodies]]\nshape = 'plane'\n\
                material = { checker = { size = 0.5 } }\n[[lights]]\nposition = [3, 5, 5]\n";
    folder.write("before.toml", text);
    let mut scene = read(text).into_result().unwrap().value;
    let edits: Vec<SceneEdit> = EDITS.iter().map(|edit| edit.parse().unwrap()).collect();
    scene.edit(&edits).unwrap();
    folder.write("after.toml", write(&scene));
    (folder, EDITS.map(|edit| format!("--set {edit}")).join(" "))
}

#[test]
fn what_is_set_gives_the_bytes_of_a_scene_with_these_values() {
    let (folder, set) = folder();
    for (before, after) in [
        (format!("render before.toml {set} -o a.png"), "render after.toml -o b.png"),
        (
            format!("render before.toml {set} --map generations -o a.png"),
            "render after.toml --map generations -o b.png",
        ),
        (
            format!("render before.toml --generations 2 {set} -o a.png"),
            "render after.toml --generations 2 -o b.png",
        ),
    ] {
        folder.good(&format!("{before} --size 64x36 --quiet"));
        folder.good(&format!("{after} --size 64x36 --quiet"));
        assert!(folder.read("a.png") == folder.read("b.png"), "{before}");
    }
    folder.good("render before.toml --size 64x36 --quiet -o a.png");
    assert!(folder.read("a.png") != folder.read("b.png"));
}

#[test]
fn every_command_that_reads_a_scene_sets_values() {
    let (folder, set) = folder();
    let both = |before: &str, after: &str| (folder.good(&format!("{before} {set}")), folder.good(after));
    let (before, after) = both(
        "audit before.toml --pixel 32,18 --size 64x36 --json",
        "audit after.toml --pixel 32,18 --size 64x36 --json",
    );
    assert_eq!(before, after);
    assert_ne!(before, folder.good("audit before.toml --pixel 32,18 --size 64x36 --json"));
    let (before, after) = both("check before.toml --keys", "check after.toml --keys");
    assert_eq!(before.replace("before.toml", ""), after.replace("after.toml", ""));
    for (scene, set) in [("before.toml", set.as_str()), ("after.toml", "")] {
        folder.good(&format!(
            "compare {scene} {set} --methods whitted,flat --size 64x36 --runs 1 --quiet -o {scene}-pages"
        ));
    }
    for name in ["1-whitted.png", "2-flat.png"] {
        let of = |scene: &str| folder.read(format!("{scene}-pages/{name}"));
        assert!(of("before.toml") == of("after.toml"), "{name}");
    }
}

#[test]
fn the_addresses_of_a_scene_are_listed() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    let output = folder.good("check one.toml --keys --set camera.fov=30");
    assert!(output.starts_with("camera.position = [0, 2.2, 8]"), "{output}");
    for line in [
        "camera.fov = 30                         # the vertical angle of view, degrees (0.001 to 179.9)\n",
        "environment.picture =                   # a picture of everything around in the place of the background\n",
        "lights.0.falloff = \"none\"               # how the light weakens",
        "1/d²: \"none\", \"linear\" or \"inverse-square\"\n",
    ] {
        assert!(output.contains(line), "{line}\n{output}");
    }
    assert!(output.ends_with("one.toml: good (1 body, 1 light)\n"), "{output}");
    let scene: Scene = read(ONE_BODY).scene;
    assert_eq!(output.lines().count(), scene.keys().count() + 1);
    for example in Example::ALL {
        // What is listed can be set.
        let output = folder.good(&format!("check {} --keys", example.name));
        let lines =
            output.lines().filter_map(|line| line.split_once(" # ")).map(|(assignment, _)| assignment.trim());
        let given: Vec<&str> = lines.filter(|line| !line.ends_with('=')).take(40).collect();
        assert!(given.len() > 20, "{output}");
        let arguments = given.iter().flat_map(|assignment| ["--set", assignment]);
        let ran = folder.run_with(["check", example.name].into_iter().chain(arguments));
        assert_eq!(ran.status, Some(0), "{ran:?}");
    }
}

#[test]
fn what_cannot_be_set_is_refused() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    for (set, said) in [
        ("camera.fov", "--set <PATH=VALUE>': `=` and a value are missing"),
        ("=3", "`=3` is not the address of a value"),
        (
            "camera.fow=30",
            "error: --set camera.fow: the camera has no key `fow`; did you mean `fov`?; the keys of",
        ),
        (
            "bodies.0.radius=-1",
            "error: --set bodies.0.radius: `radius` is `-1`, but must be greater than 0; `radius` is",
        ),
        (
            "bodies.1.radius=1",
            "`bodies` has no element `1`; an element of `bodies` has a name, or a number from 0 to 0",
        ),
        ("bodies.0.material=gold", "error: --set bodies.0.material: the material `gold` is not defined"),
        (
            "bodies.0.material.texture=none.png",
            "error: --set: there is no picture none.png; the path begins in the current directory",
        ),
        ("environment.picture=builtin:nothing", "there is no built-in picture of this name"),
    ] {
        let errors = folder.refused(&format!("render one.toml -o a.png --set {set}"));
        assert!(errors.contains(said), "{set}: {errors}");
    }
    let ran = folder.run("check one.toml --set bodies.0.radius=0");
    assert_eq!(ran.status, Some(2));
    assert!(ran.output.ends_with("one.toml: bad, 1 error\n"), "{ran:?}");
    let errors = folder.refused("compare --pictures a.png,b.png --set camera.fov=3");
    assert!(errors.contains("--set changes a scene"), "{errors}");
}

#[test]
fn pictures_that_are_set_are_found_from_the_current_directory() {
    let folder = Folder::new();
    folder.write("nothing.toml", NOTHING);
    folder.good("render nothing.toml --size 16x8 --quiet -o sky.png --set environment.background=1,0,0");
    std::fs::create_dir(folder.path("scenes")).unwrap();
    folder.write("scenes/nothing.toml", NOTHING);
    let line = "render scenes/nothing.toml --size 16x8 --quiet --set environment.picture=sky.png";
    folder.good(&format!("{line} -o a.png"));
    assert!(folder.read("a.png") == folder.read("sky.png"));
    let errors = folder.refused(&format!("{line} -o sky.png"));
    assert!(errors.contains("the same command"), "{errors}");
}
