//! The documents' worked example is what the program prints.

use std::fs;
use std::io::Write as _;

use catoptric_lab::audit::{AuditSettings, audit};
use catoptric_lab::detective::MistakeGroup;
use catoptric_lab::marking::Rubric;
use catoptric_scene::Example;
use catoptric_tracer::{RenderControl, RenderScene};
use glam::UVec2;

const BEGIN: &str = "    catoptric audit whitted --pixel 800,440\n\n```text\n";
const END: &str = "```\n";

/// `BLESS=1` writes the listing into both documents; the words around it are to be read again then.
#[test]
fn the_pixel_explained_is_the_pixel() {
    #[cfg(target_arch = "x86_64")]
    if !std::arch::is_x86_feature_detected!("avx2") {
        let _ = writeln!(std::io::stderr().lock(), "SKIPPED: without AVX2 numbers have other last digits");
        return;
    }
    let scene = Example::find("whitted").unwrap().load().unwrap().scene;
    let render_scene = RenderScene::build(&scene).unwrap();
    let pixel = UVec2::new(800, 440);
    let audit = audit(
        &scene,
        &render_scene,
        render_scene.camera(),
        pixel,
        &AuditSettings::default(),
        &RenderControl::default(),
    )
    .unwrap();
    let listing = audit.to_text(None);
    for language in ["en", "ru"] {
        let path = format!("{}/../../docs/{language}/audit.md", env!("CARGO_MANIFEST_DIR"));
        let text = fs::read_to_string(&path).unwrap();
        let (head, rest) = text.split_once(BEGIN).unwrap();
        let (written, tail) = rest.split_once(END).unwrap();
        if std::env::var_os("BLESS").is_some() {
            fs::write(&path, format!("{head}{BEGIN}{listing}{END}{tail}")).unwrap();
        } else {
            assert_eq!(written, listing, "{path} is out of date: BLESS=1 refreshes it");
        }
        let mut numbers = 0;
        for word in tail.split(|c: char| !(c.is_ascii_digit() || c == '.')) {
            let number = word.trim_matches('.');
            if number.contains('.') && number.len() >= 5 {
                assert!(listing.contains(number), "{path}: {number} is not in the listing");
                numbers += 1;
            }
        }
        assert!(numbers > 20, "{path}: only {numbers} numbers are explained");
    }
}

#[test]
fn the_rubric_of_the_documents_is_one() {
    for language in ["en", "ru"] {
        let path = format!("{}/../../docs/{language}/check-your-tracer.md", env!("CARGO_MANIFEST_DIR"));
        let text = fs::read_to_string(&path).unwrap();
        let rubric = text.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
        let rubric = Rubric::read(rubric, &["12-glass"]).unwrap_or_else(|found| panic!("{path}: {found}"));
        assert_eq!((rubric.worth("12-glass"), rubric.worth("01-sphere"), rubric.repeated), (20.0, 10.0, 0.5));
        for group in MistakeGroup::ALL {
            let part = match (Rubric::usual_part(group), language) {
                (0.1, "en") => "a tenth",
                (0.2, "en") => "a fifth",
                (0.3, "en") => "three tenths",
                (0.1, _) => "десятую часть",
                (0.2, _) => "пятую часть",
                (0.3, _) => "три десятых",
                (part, _) => panic!("{part}"),
            };
            let row = text.lines().find(|line| line.starts_with(&format!("| `{}`", group.key())));
            assert!(row.is_some_and(|row| row.contains(part)), "{path}: {}: {part}", group.key());
        }
    }
}
