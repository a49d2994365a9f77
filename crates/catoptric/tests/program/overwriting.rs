//! No command writes over what it reads, however that is named.

use std::fs;

use crate::common::{Folder, ONE_BODY};

/// A scene with a picture around it and one on a body, each of which is a file.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("plain.toml", ONE_BODY);
    folder.good("render plain.toml -q --size 16x12 -o around.exr");
    folder.good("render plain.toml -q --size 16x12 -o wood.png");
    let scene = format!(
        "{ONE_BODY}[environment]\npicture = \"around.exr\"\n[[bodies]]\nshape = \"cube\"\n\
         material = {{ texture = \"wood.png\" }}\n"
    );
    folder.write("scene.toml", scene);
    fs::create_dir(folder.path("deep")).unwrap();
    folder
}

/// Other names of a file in the folder.
fn other_names(folder: &Folder, name: &str) -> Vec<String> {
    let mut names = vec![
        name.to_owned(),
        format!("./{name}"),
        format!("deep/../{name}"),
        folder.path(name).to_str().unwrap().to_owned(),
    ];
    let kind = name.split('.').next_back().unwrap();
    if fs::hard_link(folder.path(name), folder.path(format!("hard-{name}"))).is_ok() && cfg!(unix) {
        names.push(format!("hard-{name}"));
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(name, folder.path(format!("soft-{name}"))).unwrap();
        std::os::unix::fs::symlink(format!("soft-{name}"), folder.path(format!("chain-{name}.{kind}")))
            .unwrap();
        let _ = std::os::unix::fs::symlink(".", folder.path("here"));
        names.extend([
            format!("soft-{name}"),
            format!("chain-{name}.{kind}"),
            format!("here/deep/../{name}"),
        ]);
    }
    names
}

#[test]
fn an_output_is_no_input() {
    for (input, commands) in [
        (
            "wood.png",
            &[
                "render scene.toml -q --size 16x12 -o OUT",
                "render scene.toml -q --size 16x12 --map rays -o OUT",
                "render scene.toml -q --size 16x12 -o other.png --stats OUT",
                "audit scene.toml --pixel 1,1 --svg OUT",
                "audit scene.toml --pixel 1,1 --dot OUT",
                "diff wood.png around.exr --heat OUT",
                "diff around.exr wood.png --heat OUT",
                "convert wood.png OUT",
                "convert scene.toml OUT --format toml",
            ][..],
        ),
        (
            "around.exr",
            &[
                "render scene.toml -q --size 16x12 -o OUT",
                "render scene.toml -q --size 16x12 -o other.png --stats OUT",
                "audit scene.toml --pixel 1,1 --svg OUT",
                "convert around.exr OUT --exposure 1",
            ],
        ),
        (
            "scene.toml",
            &[
                "render scene.toml -q --size 16x12 -o OUT --format png",
                "render scene.toml -q --size 16x12 -o other.png --stats OUT",
                "audit scene.toml --pixel 1,1 --dot OUT",
                "convert scene.toml OUT",
            ],
        ),
    ] {
        let folder = folder();
        let before = folder.read(input);
        for name in other_names(&folder, input) {
            for command in commands {
                let errors = folder.refused(&command.replace("OUT", &name));
                assert!(errors.contains("the same command uses this file"), "{command} {name}: {errors}");
                assert!(folder.read(input) == before, "{command} {name}");
            }
        }
    }
}

#[test]
fn two_outputs_are_two_files() {
    let folder = folder();
    folder.write("a.png", "old");
    for name in other_names(&folder, "a.png").iter().chain(&["b.png".to_owned(), "./b.png".to_owned()]) {
        let first = if name.ends_with("b.png") { "b.png" } else { "a.png" };
        let errors = folder.refused(&format!("render plain.toml -q --size 16x12 -o {first} --stats {name}"));
        assert!(errors.contains("writes something else there"), "{name}: {errors}");
    }
    assert_eq!(folder.read("a.png"), b"old");
    // Standard output is a pipe here.
    folder.refused("render plain.toml -q --size 16x12 -o - --stats -");
    if cfg!(unix) {
        folder.refused("render plain.toml -q --size 16x12 -o /dev/stdout --stats -");
        folder.good("render plain.toml -q --size 16x12 -o /dev/null --stats /dev/null");
    }
}

/// Files into a directory have names of their own, which may be those of inputs.
#[test]
fn a_file_in_a_directory_is_no_input() {
    let folder = folder();
    fs::create_dir(folder.path("out")).unwrap();
    fs::copy(folder.path("wood.png"), folder.path("out/depth.png")).unwrap();
    fs::copy(folder.path("wood.png"), folder.path("out/1-around.png")).unwrap();
    let scene = format!("{ONE_BODY}[environment]\npicture = \"out/depth.png\"\n");
    folder.write("layered.toml", scene);
    let before = folder.read("out/depth.png");
    folder.refused("render layered.toml -q --size 16x12 --method ssr -o a.png --layers out");
    folder.refused("render layered.toml -q --size 16x12 --method ssr -o out/color.png --layers out");
    folder.refused("compare --pictures around.exr,out/1-around.png -q -o out");
    assert!(folder.read("out/depth.png") == before && folder.read("out/1-around.png") == before);
    // In another one, or by another name, nothing is in the way.
    folder.good("render layered.toml -q --size 16x12 --method ssr -o a.png --layers layers/new");
    folder.good("compare --pictures out/depth.png,around.exr -q -o out");
}

/// What is appended to a scene by its own audit would spoil it.
#[cfg(unix)]
#[test]
fn standard_output_is_no_input() {
    let folder = folder();
    for (line, input) in [
        ("check scene.toml", "scene.toml"),
        ("check scene.toml", "wood.png"),
        ("audit scene.toml --pixel 1,1", "around.exr"),
        ("diff wood.png around.exr", "wood.png"),
        ("convert around.exr -", "around.exr"),
        ("render scene.toml -q --size 16x12 -o -", "wood.png"),
    ] {
        let before = folder.read(input);
        let appended = fs::File::options().append(true).open(folder.path(input)).unwrap();
        let ran = folder.command(line.split(' ')).stdout(appended).output().unwrap();
        assert!(folder.read(input) == before, "{line} >> {input}");
        assert_eq!(ran.status.code(), Some(2), "{line} >> {input}");
    }
}
