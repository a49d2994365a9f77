//! Pipes, descriptors and standard streams in the place of files, as shells offer them.

use std::io::pipe;
use std::process::{Command, Stdio};

use crate::common::{Folder, ONE_BODY, Ran, skip};

/// Commands with one output, `OUT`, that is the same every time.
const COMMANDS: [&str; 10] = [
    "render scene.toml -q --size 24x16 -o OUT --format png",
    "render scene.toml -q --size 24x16 -o OUT --format exr",
    "render scene.toml -q --size 24x16 --map rays -o OUT --format png",
    "audit scene.toml --size 24x16 --pixel 12,8 --dot OUT",
    "audit scene.toml --size 24x16 --pixel 12,8 --svg OUT",
    "convert a.exr OUT --format png",
    "convert a.png OUT --format exr",
    "convert scene.toml OUT --format toml",
    "examples whitted -o OUT",
    "render whitted -q --size 24x16 --samples 4 -o OUT --format png",
];

/// Ways to get what is written to `OUT` into the file `got`.
const SINKS: [(&str, &str); 9] = [
    ("-", "CMD > got"),
    ("-", "CMD | cat > got"),
    ("/dev/stdout", "CMD | cat > got"),
    ("/dev/stdout", "CMD > got"),
    ("link", "ln -s /dev/stdout link; CMD | cat > got"),
    ("/dev/fd/3", "CMD 3> got"),
    ("fifo", "mkfifo fifo; cat fifo > got & CMD; wait"),
    (">(cat > part; mv part got)", "CMD; while [ ! -e got ]; do sleep 0.01; done"),
    ("/dev/fd/1", "(echo -n before; CMD; echo -n after) > all; head -c -5 all | tail -c +7 > got"),
];

fn folder() -> Option<Folder> {
    if !Command::new("bash").arg("-c").arg("true").status().is_ok_and(|status| status.success()) {
        skip("there is no command `bash`");
        return None;
    }
    let folder = Folder::new();
    folder.write("scene.toml", ONE_BODY);
    folder.good("render scene.toml -q --size 24x16 -o a.exr");
    folder.good("render scene.toml -q --size 24x16 -o a.png");
    Some(folder)
}

/// Runs a line of a shell in the folder; `catoptric` is the program.
fn shell(folder: &Folder, line: &str) -> Ran {
    let mut shell = Command::new("bash");
    shell.arg("-c").arg(format!("catoptric() {{ \"$CATOPTRIC\" \"$@\"; }}; {line}"));
    shell.env("CATOPTRIC", env!("CARGO_BIN_EXE_catoptric")).current_dir(folder.path("")).stdin(Stdio::null());
    Ran::of(shell.output().unwrap())
}

fn remove(folder: &Folder, names: &[&str]) {
    for name in names {
        let _ = std::fs::remove_file(folder.path(name));
    }
}

#[test]
fn a_stream_gets_the_bytes_of_a_file() {
    let Some(folder) = folder() else { return };
    for command in COMMANDS {
        folder.good(&command.replace("OUT", "file"));
        let expected = folder.read("file");
        assert!(!expected.is_empty());
        for (out, sink) in SINKS {
            let line = sink.replace("CMD", &format!("catoptric {}", command.replace("OUT", out)));
            let ran = shell(&folder, &line);
            assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
            assert!(folder.read("got") == expected, "{line}: other bytes");
            remove(&folder, &["got", "link", "fifo", "all"]);
        }
        remove(&folder, &["file"]);
    }
    assert_eq!(folder.names(), ["a.exr", "a.png", "scene.toml"]);
}

#[test]
fn statistics_and_heat_maps_go_into_streams() {
    let Some(folder) = folder() else { return };
    for (out, sink) in SINKS {
        let command = "catoptric render scene.toml -q --size 24x16 -o b.png --stats OUT";
        let line = sink.replace("CMD", &command.replace("OUT", out));
        let ran = shell(&folder, &line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
        let stats: serde_json::Value = serde_json::from_slice(&folder.read("got")).unwrap();
        assert_eq!((&stats["scene"], &stats["width"]), (&"scene.toml".into(), &24.into()), "{line}");
        remove(&folder, &["got", "link", "fifo", "all"]);
    }
    folder.good("diff a.png a.exr --tolerance 0.1 --heat heat.png");
    for line in [
        "catoptric diff a.png a.exr --tolerance 0.1 --heat /dev/fd/3 3> got > text",
        "catoptric diff a.png a.exr --tolerance 0.1 --heat >(cat > part; mv part got) > text; \
         while [ ! -e got ]; do sleep 0.01; done",
    ] {
        let ran = shell(&folder, line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
        assert!(folder.read("got") == folder.read("heat.png"), "{line}");
        remove(&folder, &["got"]);
    }
    // The numbers go to standard output already.
    for out in ["-", "/dev/stdout"] {
        let ran = shell(&folder, &format!("catoptric diff a.png a.exr --heat {out}"));
        assert_eq!((ran.status, ran.output.as_str()), (Some(2), ""), "{ran:?}");
    }
}

/// What others have written to a descriptor, and write afterwards, stays.
#[test]
fn a_file_behind_a_descriptor_is_shared() {
    let Some(folder) = folder() else { return };
    let scene = folder.good("examples whitted");
    let expected = format!("first\n{scene}second\n{scene}last\n");
    for out in ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "/dev/../dev/./stdout", "link", "links/1"]
    {
        if out.starts_with("/proc") && !cfg!(target_os = "linux") {
            continue;
        }
        let write = format!("catoptric examples whitted -o {out}");
        for line in [
            format!("echo first > log; {write} >> log; echo second >> log; {write} >> log; echo last >> log"),
            format!("(echo first; {write}; echo second; {write}; echo last) > log"),
        ] {
            let ran = shell(&folder, &format!("ln -s /dev/fd/1 link; ln -s /dev/fd links; {line}"));
            assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
            assert!(folder.read("log") == expected.as_bytes(), "{line}");
            remove(&folder, &["log", "link", "links"]);
        }
    }
    let write = "catoptric examples whitted -o /dev/fd/7";
    let line = format!("exec 7> log; echo first >&7; {write}; echo second >&7; {write}; echo last >&7");
    let ran = shell(&folder, &line);
    assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{ran:?}");
    assert!(folder.read("log") == expected.as_bytes());
    let ran = shell(&folder, "catoptric render whitted -o /dev/fd/77");
    assert_eq!(ran.status, Some(2));
    assert!(ran.errors.contains("not given such an open descriptor"), "{ran:?}");
}

#[test]
fn what_cannot_be_delivered_is_an_error() {
    let Some(folder) = folder() else { return };
    for command in COMMANDS.map(|command| command.replace("OUT", "-")).iter().chain(&[
        "render scene.toml -q --size 24x16 -o b.png --stats -".to_owned(),
        "render scene.toml -q --size 24x16 -o b.png --stats /dev/stdout".to_owned(),
    ]) {
        let (reader, writer) = pipe().unwrap();
        drop(reader);
        let mut program = folder.command(command.split(' '));
        let ran = Ran::of(program.stdout(writer).output().unwrap());
        assert_eq!(ran.status, Some(2), "{command}: {ran:?}");
        assert!(ran.errors.starts_with("error: cannot write"), "{command}: {ran:?}");
    }
    if cfg!(target_os = "linux") {
        let ran = shell(&folder, "catoptric render scene.toml --size 24x16 -o - > /dev/full");
        assert_eq!(ran.status, Some(2), "{ran:?}");
    }
    // For words a reader that has heard enough is none.
    let (reader, writer) = pipe().unwrap();
    drop(reader);
    let ran = Ran::of(folder.command(["check", "scene.toml"]).stdout(writer).output().unwrap());
    assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""));
}

#[test]
fn pictures_and_scenes_come_from_streams() {
    let Some(folder) = folder() else { return };
    folder.good("convert a.png expected.exr");
    folder.good("convert scene.toml expected.toml");
    for (line, got, expected) in [
        ("cat a.png | catoptric convert /dev/stdin got", "got", "expected.exr"),
        ("cat a.png | catoptric convert - got", "got", "expected.exr"),
        ("catoptric convert - got < a.png", "got", "expected.exr"),
        ("catoptric convert <(cat a.png) - > got", "got", "expected.exr"),
    ] {
        let ran = shell(&folder, &line.replace("convert", "convert --format exr"));
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
        assert!(folder.read(got) == folder.read(expected), "{line}");
        remove(&folder, &["got"]);
    }
    for line in [
        "cat scene.toml | catoptric convert - got.toml",
        "catoptric convert /dev/stdin got.toml < scene.toml",
        "catoptric convert <(cat scene.toml) --format toml - > got.toml",
        "catoptric convert scene.toml - > got.toml",
    ] {
        let ran = shell(&folder, line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
        assert!(folder.read("got.toml") == folder.read("expected.toml"), "{line}");
    }
    for line in [
        "catoptric diff <(cat a.png) <(cat a.png)",
        "catoptric diff - a.png < a.png",
        "cat a.exr | catoptric diff a.exr /dev/stdin",
        "catoptric check <(cat scene.toml)",
        "cat scene.toml | catoptric check -",
        "cat scene.toml | catoptric render - -q --size 24x16 -o b.exr; catoptric diff a.exr b.exr",
        "catoptric render <(cat scene.toml) -q --size 24x16 -o - --format exr | catoptric diff - a.exr",
        "catoptric audit - --pixel 1,1 < scene.toml",
        "catoptric compare --pictures <(cat a.png),<(cat a.exr) -q -o compared",
    ] {
        let ran = shell(&folder, line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
    }
    for line in
        ["true | catoptric convert - got.png", "echo x | catoptric diff - a.png", "true | catoptric check -"]
    {
        assert_eq!(shell(&folder, line).status, Some(2), "{line}");
    }
}

/// The pictures of a scene from a stream begin where the program was started.
#[test]
fn a_scene_from_a_stream_finds_its_pictures() {
    let Some(folder) = folder() else { return };
    std::fs::create_dir(folder.path("deep")).unwrap();
    folder.write("textured.toml", format!("{ONE_BODY}[environment]\npicture = \"a.png\"\n"));
    folder.write("deep/textured.toml", format!("{ONE_BODY}[environment]\npicture = \"../a.png\"\n"));
    for line in [
        "cat textured.toml | catoptric check -",
        "catoptric check /dev/stdin < textured.toml",
        "catoptric check <(cat textured.toml)",
        "catoptric check deep/textured.toml",
        "catoptric convert deep/textured.toml - | catoptric check -",
        "catoptric convert - deep/again.toml < textured.toml && catoptric check deep/again.toml",
        "catoptric convert deep/textured.toml again.toml && grep -q '\"a.png\"' again.toml",
        "catoptric convert - deep/again.toml < textured.toml && grep -q '\"../a.png\"' deep/again.toml",
    ] {
        let ran = shell(&folder, line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
    }
}
