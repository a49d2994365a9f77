//! Ctrl-C, and requests to end.

use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::common::{Folder, NOTHING, Ran, signal, signals_work, skip};

/// Runs the program, sends it a signal in the midst of its work, and waits for the end.
fn interrupted(folder: &Folder, line: &str, name: &str) -> Ran {
    let mut delay = Duration::from_millis(200);
    loop {
        let child = folder.command(line.split(' ')).spawn().unwrap();
        sleep(delay);
        signal(&child, name);
        let ran = ended(child);
        // On a busy machine the signal can come before the program listens, and the system ends it.
        if ran.status.is_some() || delay > Duration::from_secs(3) {
            return ran;
        }
        delay *= 2;
    }
}

/// Waits for the end, which must come soon.
fn ended(mut child: Child) -> Ran {
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(10) {
            child.kill().unwrap();
            panic!("the program did not end: {:?}", Ran::of(child.wait_with_output().unwrap()));
        }
        sleep(Duration::from_millis(5));
    }
    Ran::of(child.wait_with_output().unwrap())
}

#[test]
fn tracing_ends_at_once_and_leaves_nothing() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    for name in ["INT", "TERM", "HUP"] {
        let line = "render hall-of-mirrors -o a.png --size 8000x8000 --stats s.json";
        let ran = interrupted(&folder, line, name);
        assert_eq!(ran.status, Some(130), "{name}: {ran:?}");
        assert_eq!((ran.output.as_str(), ran.errors.as_str()), ("", "interrupted; nothing was written\n"));
        assert!(folder.names().is_empty(), "{name}: {:?}", folder.names());
    }
}

#[test]
fn one_enormous_pixel_can_be_interrupted() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    // Two parallel mirrors around a forest of glass: every ray splits until the last generation.
    let mut scene = NOTHING.to_owned();
    for index in 0..40 {
        scene += &format!(
            "[[bodies]]\nshape = \"sphere\"\nposition = [{}, {}, 0]\nmaterial = {{ reflection = 0.9, \
             transmission = 0.9, specular = 0.9 }}\n",
            index % 7,
            index / 7
        );
    }
    folder.write("glass.toml", scene);
    let line = "render glass.toml -o a.png --size 1x1 --samples 65536 --generations 64";
    let ran = interrupted(&folder, line, "INT");
    assert_eq!(ran.status, Some(130), "{ran:?}");
    assert_eq!(folder.names(), ["glass.toml"]);
}

#[test]
fn reading_and_opening_can_be_interrupted() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    for name in ["scene.toml", "pipe.png"] {
        if !Command::new("mkfifo").arg(folder.path(name)).status().is_ok_and(|status| status.success()) {
            return skip("there is no command `mkfifo`");
        }
    }
    for line in [
        "check scene.toml",
        "render scene.toml -o a.png",
        "convert scene.toml a.toml",
        "render whitted -o pipe.png --size 4x4",
    ] {
        let ran = interrupted(&folder, line, "INT");
        assert_eq!(ran.status, Some(130), "{line}: {ran:?}");
        assert_eq!(folder.names(), ["pipe.png", "scene.toml"], "{line}");
    }
}

/// A folder is made with the first file in it.
#[test]
fn no_empty_folder_is_left() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    for line in [
        "compare hall-of-mirrors --methods whitted,ssr --size 4000x4000 -o new/folder",
        "render hall-of-mirrors -o a.png --size 4000x4000 --method ssr --layers new/folder",
    ] {
        for name in ["INT", "KILL"] {
            let ran = interrupted(&folder, line, name);
            assert!(matches!(ran.status, Some(130) | None), "{name} {line}: {ran:?}");
            assert!(folder.names().is_empty(), "{name} {line}: {:?}", folder.names());
        }
    }
}

/// What is left by a program that could not tidy up, the next one takes away.
#[test]
fn what_killed_programs_leave_is_removed() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    folder.write("nothing.toml", NOTHING);
    let is_temporary = |name: &String| name.starts_with(".catoptric-") && name.ends_with(".tmp");
    let line = "render nothing.toml -q -o a.exr --size 3000x2000 --threads 1";
    let mut left = 0;
    for step in 0..12 {
        let mut child = folder.command(line.split(' ')).spawn().unwrap();
        let start = Instant::now();
        // Once the file is begun, or after a while in which it has begun and ended.
        while !folder.names().iter().any(is_temporary) && start.elapsed() < Duration::from_secs(5) {
            sleep(Duration::from_millis(1));
        }
        sleep(Duration::from_millis(10 * step));
        child.kill().unwrap();
        child.wait().unwrap();
        let count = folder.names().iter().filter(|name| is_temporary(name)).count();
        assert!(count <= 1, "the next program removes what the last one left");
        left += count;
    }
    folder.good("render nothing.toml -q -o c.png --size 8x8");
    assert!(!folder.names().iter().any(is_temporary), "{:?}", folder.names());
    println!("{left} left and removed");
}

/// Whenever the signal comes, the picture is there whole or not at all, and no temporary stays.
#[test]
fn writing_is_finished_or_not_begun() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    folder.write("nothing.toml", NOTHING);
    let line = "render nothing.toml -q -o a.exr --size 1200x800 --threads 1";
    let start = Instant::now();
    folder.good(line);
    let whole = start.elapsed();
    let expected = folder.read("a.exr");
    let (mut finished, mut nothing) = (0, 0);
    for step in 0..15 {
        std::fs::remove_file(folder.path("a.exr")).unwrap_or_default();
        let child = folder.command(line.split(' ')).spawn().unwrap();
        sleep(whole * step / 13);
        if step > 0 {
            signal(&child, "INT");
        }
        let ran = ended(child);
        if folder.path("a.exr").exists() {
            assert!(folder.read("a.exr") == expected, "a half file, {step}: {ran:?}");
            assert_eq!(folder.names(), ["a.exr", "nothing.toml"], "{step}: {ran:?}");
            assert!(
                ran.status == Some(0) || ran.errors == "interrupted; written before that: a.exr\n",
                "{step}: {ran:?}"
            );
            finished += 1;
        } else {
            assert_eq!(folder.names(), ["nothing.toml"], "{step}: {ran:?}");
            // In the first moments the system itself ends the program.
            assert!(matches!(ran.status, Some(130) | None), "{step}: {ran:?}");
            nothing += 1;
        }
    }
    println!("{finished} finished, {nothing} not begun");
}

#[cfg(target_os = "linux")]
#[test]
fn an_ignored_signal_stays_ignored() {
    if !signals_work() {
        return;
    }
    let folder = Folder::new();
    let mut shell = Command::new("nohup");
    shell.arg(env!("CARGO_BIN_EXE_catoptric"));
    shell.args("render whitted -o a.png --size 600x400".split(' ')).current_dir(folder.path(""));
    shell.stdin(std::process::Stdio::null()).stdout(std::process::Stdio::piped());
    let Ok(child) = shell.stderr(std::process::Stdio::piped()).spawn() else {
        return skip("there is no command `nohup`");
    };
    // Until `nohup` has become the program, it may not yet have asked that the signal be ignored.
    let started = Instant::now();
    let name = format!("/proc/{}/comm", child.id());
    while std::fs::read_to_string(&name).is_ok_and(|name| name.trim_end() != "catoptric")
        && started.elapsed() < Duration::from_secs(10)
    {
        sleep(Duration::from_millis(1));
    }
    sleep(Duration::from_millis(100));
    signal(&child, "HUP");
    let ran = ended(child);
    assert_eq!(ran.status, Some(0), "{ran:?}");
    assert_eq!(folder.names(), ["a.png"]);
}
