//! The acceptance set: small scenes in all formats that can say them, with their exact pictures.
//!
//! `BLESS=1 cargo test -p catoptric-exchange acceptance` writes the files anew.

use std::fs;
use std::path::{Path, PathBuf};

use catoptric_exchange::{ExportOptions, ForeignFormat, ImportOptions, read, write};
use catoptric_picture::{Development, Difference, Picture, PictureFormat, SaveOptions, ToneCurve, decode};
use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};

const SIZE: [u32; 2] = [64, 48];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/acceptance")
}

fn drawn(scene: &Scene) -> Picture {
    let settings = RenderSettings { width: SIZE[0], height: SIZE[1], samples: 1 };
    render(&RenderScene::build(scene).unwrap(), settings, &RenderControl::default()).unwrap().picture
}

fn encoded(picture: &Picture, format: PictureFormat) -> Vec<u8> {
    let mut options = SaveOptions::new(format, None).unwrap();
    options.development = Development { exposure_stops: 0.0, tone_curve: ToneCurve::LinearCodes };
    options.prepare(picture).unwrap().encode().unwrap()
}

/// Fails if the file is not this one, or writes it.
fn check(name: &str, is_current: impl FnOnce(&[u8]) -> bool, bytes: &[u8]) {
    let path = folder().join(name);
    if std::env::var_os("BLESS").is_some() {
        fs::write(path, bytes).unwrap();
    } else {
        let own = fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}; run with BLESS=1"));
        assert!(is_current(&own), "{name} is out of date: run with BLESS=1");
    }
}

#[test]
fn the_acceptance_set_is_current_and_small() {
    let entries =
        fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> =
        entries.filter_map(|name| Some(name.strip_suffix(".toml")?.to_owned())).collect();
    names.sort();
    assert_eq!(names.len(), 15);
    let mut counts = [0; 3];
    for name in &names {
        let text = fs::read_to_string(folder().join(format!("{name}.toml"))).unwrap();
        let scene =
            catoptric_scene::read(&text).into_result().unwrap_or_else(|errors| panic!("{name}: {errors}"));
        let picture = drawn(&scene.value);
        for format in [PictureFormat::Png, PictureFormat::Ppm] {
            let bytes = encoded(&picture, format);
            assert!(bytes.len() <= 10_000, "{name}: {} bytes", bytes.len());
            let is_same = |own: &[u8]| {
                let own = decode(own).unwrap();
                // Other processors may round another way.
                Difference::between(&own, &decode(&bytes).unwrap()).unwrap().max < 0.02
            };
            check(&format!("{name}.{}", format.extensions()[0]), is_same, &bytes);
        }
        for (format, count) in ForeignFormat::ALL.into_iter().zip(&mut counts) {
            let file = format!("{name}.{}", format.extensions()[0]);
            let options = ExportOptions { size: Some(SIZE), ..ExportOptions::default() };
            let exactly = write(format, &scene.value, &options);
            let is_approximate = exactly.is_err();
            let options = ExportOptions { is_approximate, ..options };
            let written = exactly.or_else(|_| write(format, &scene.value, &options)).unwrap().text;
            let again = read(format, &written, &ImportOptions::default()).unwrap();
            assert_eq!(again.size, Some(SIZE), "{file}");
            let difference = Difference::between(&drawn(&again.scene), &picture).unwrap();
            if is_approximate && difference.above >= 4 {
                println!("{file}: {difference:?}");
                assert!(!folder().join(&file).exists(), "{file}: {difference:?}");
                continue;
            }
            *count += 1;
            check(&file, |own| own == written.as_bytes(), written.as_bytes());
            assert!(difference.above < 4, "{file}: {difference:?}");
        }
    }
    println!("{counts:?}");
    assert!(counts.iter().all(|count| *count >= 8), "{counts:?}");
}
