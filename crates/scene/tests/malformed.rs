//! Every `malformed/*.toml` gives exactly the findings in the `.txt` beside it.
//! `BLESS=1 cargo test -p catoptric-scene` rewrites them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail like that")]

use std::fs;
use std::path::{Path, PathBuf};

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/malformed");
    let mut cases: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    cases.sort();
    cases
}

#[test]
fn findings_are_as_expected() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut failures = String::new();
    for path in cases() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let (reading, text) = catoptric_scene::read_bytes(fs::read(&path).unwrap());
        let found = reading.diagnostics.render(name, &text, false);
        assert!(!reading.diagnostics.is_empty(), "{name}: nothing was found");
        let expected_path = path.with_extension("txt");
        if bless {
            fs::write(&expected_path, &found).unwrap();
            continue;
        }
        let expected = fs::read_to_string(&expected_path).unwrap_or_default();
        if expected != found {
            failures.push_str(&format!("{name}: expected\n{expected}\nfound\n{found}\n"));
        }
    }
    assert!(failures.is_empty(), "{failures}");
}
