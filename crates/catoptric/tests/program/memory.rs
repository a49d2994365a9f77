//! Where the system refuses memory, the program says so.

use std::fmt::Write as _;
use std::process::{Command, Stdio};

use crate::common::{Folder, NOTHING, Ran, skip};

/// Runs the program with so many MiB of memory to address.
fn limited(folder: &Folder, mebibytes: usize, line: &str) -> Ran {
    let mut shell = Command::new("bash");
    shell.arg("-c").arg(format!("ulimit -v {}; exec \"$CATOPTRIC\" {line}", mebibytes << 10));
    shell.env("CATOPTRIC", env!("CARGO_BIN_EXE_catoptric")).current_dir(folder.path(""));
    Ran::of(shell.stdin(Stdio::null()).output().unwrap())
}

#[test]
fn a_refusal_is_said_wherever_it_happens() {
    let folder = Folder::new();
    folder.write("small.toml", NOTHING);
    // Names and materials of their own take memory of their own.
    let mut scene = NOTHING.to_owned();
    for index in 0..150_000 {
        let _ = write!(
            scene,
            "[[bodies]]\nname = \"body number {index}\"\nposition = [{index}.5, 1.25, 0.125]\n\
             material = {{ color = [0.1, 0.2, 0.3], reflection = 0.5 }}\n"
        );
    }
    folder.write("large.toml", scene);
    let enough = |mebibytes: usize| limited(&folder, mebibytes, "check small.toml").status == Some(0);
    let Some(least) = (1..64).map(|step| 32 * step).find(|&mebibytes| enough(mebibytes)) else {
        return skip("memory cannot be limited here");
    };
    let (mut refused, mut done) = (0, 0);
    for mebibytes in (least..least + 700).step_by(35) {
        for line in ["check large.toml", "render large.toml -q --size 64x64 --threads 2 -o a.png"] {
            let ran = limited(&folder, mebibytes, line);
            match ran.status {
                Some(0) => done += 1,
                Some(2) => {
                    refused += 1;
                    let words = format!("{}{}", ran.output, ran.errors);
                    assert!(words.contains("error: ") && words.contains("memory"), "{mebibytes}: {ran:?}");
                }
                _ => panic!("{mebibytes} MiB, {line}: {ran:?}"),
            }
            assert!(!ran.errors.contains("panicked"), "{ran:?}");
        }
    }
    assert!(refused > 0 && done > 0, "{refused} refused, {done} done");
}
