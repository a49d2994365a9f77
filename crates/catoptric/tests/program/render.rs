//! `catoptric render`

use std::fs::File;

use crate::common::{FIVE_ERRORS, FIVE_PLACES, Folder, NOTHING, ONE_BODY, Ran};
use catoptric_picture::{Comparison, decode};
use serde_json::Value;

#[test]
fn an_example_or_a_file_becomes_a_picture_without_a_word() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    assert_eq!(folder.good("render whitted -o a.png --size 12x8"), "");
    assert_eq!(folder.good("render one.toml -o b.EXR --size 12x8"), "");
    assert_eq!(folder.names(), ["a.png", "b.EXR", "one.toml"]);
    for name in ["a.png", "b.EXR"] {
        let picture = decode(&folder.read(name)).unwrap();
        assert_eq!((picture.width(), picture.height()), (12, 8));
    }
}

#[test]
fn a_file_wins_over_an_example_and_a_folder_does_not() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("whitted")).unwrap();
    folder.good("render whitted -o a.png --size 4x4");
    std::fs::remove_dir(folder.path("whitted")).unwrap();
    folder.write("whitted", ONE_BODY);
    let stats: Value =
        serde_json::from_str(&folder.good("render whitted -o a.png --size 4x4 --stats -")).unwrap();
    assert_eq!(stats["bodies"], 1);
}

#[test]
fn the_bytes_do_not_depend_on_the_threads() {
    let folder = Folder::new();
    // Of several tiles across and down, so that threads have parts of the picture to begin in.
    for name in ["four-bodies", "whitted", "kaleidoscope"] {
        for kind in ["png", "exr"] {
            for threads in [1, 2, 3, 64] {
                folder.good(&format!(
                    "render {name} -o {threads}.{kind} --size 131x197 --samples 2 --backend cpu --threads {threads}"
                ));
            }
            let one = folder.read(format!("1.{kind}"));
            for threads in [2, 3, 64] {
                assert!(folder.read(format!("{threads}.{kind}")) == one, "{name}.{kind}, {threads} threads");
            }
        }
    }
}

#[test]
fn exposure_and_tone_curve_shape_the_png_and_leave_linear_light_alone() {
    let folder = Folder::new();
    for kind in ["png", "exr"] {
        folder.good(&format!("render whitted -o plain.{kind} --size 16x12"));
        folder.good(&format!("render whitted -o bright.{kind} --size 16x12 --exposure 1.5"));
        folder.good(&format!("render whitted -o dark.{kind} --size 16x12 --exposure -1"));
        folder.good(&format!("render whitted -o curve.{kind} --size 16x12 --tone-curve filmic"));
        for name in ["bright", "dark", "curve"] {
            let same = folder.read(format!("{name}.{kind}")) == folder.read(format!("plain.{kind}"));
            assert_eq!(same, kind == "exr", "{name}.{kind}");
        }
    }
}

#[test]
fn sixteen_bits_are_closer_to_the_truth_than_eight() {
    let folder = Folder::new();
    folder.good("render whitted -o truth.exr --size 32x24");
    folder.good("render whitted -o 8.png --size 32x24");
    folder.good("render whitted -o 16.png --size 32x24 --bits 16");
    // Bit depth and color type in the header: 16 bits, RGB.
    assert_eq!(folder.read("16.png")[24..26], [16, 2]);
    let truth = decode(&folder.read("truth.exr")).unwrap();
    let error = |name| {
        let picture = decode(&folder.read(name)).unwrap();
        Comparison::default().compare(&picture, &truth).unwrap().max
    };
    assert!(error("16.png") < 2e-5, "{}", error("16.png"));
    assert!(error("8.png") > 1e-3 && error("8.png") < 1.0 / 200.0, "{}", error("8.png"));
}

#[test]
fn options_change_the_picture_as_they_say() {
    let folder = Folder::new();
    folder.good("render whitted -o plain.exr --size 16x12 --backend cpu");
    for option in ["--samples 4", "--generations 1"] {
        folder.good(&format!("render whitted -o other.exr --size 16x12 {option}"));
        assert!(folder.read("other.exr") != folder.read("plain.exr"), "{option}");
    }
    for option in ["--samples 1", "--generations 8", "--method whitted", "--threads 2"] {
        folder.good(&format!("render whitted -o other.exr --size 16x12 --backend cpu {option}"));
        assert!(folder.read("other.exr") == folder.read("plain.exr"), "{option}");
    }
}

#[cfg(feature = "gpu")]
#[test]
fn a_graphics_card_draws_the_same_picture_and_says_so() {
    use std::io::Write as _;

    let folder = Folder::new();
    let line = "render whitted -o gpu.exr --size 160x90 --backend gpu --software-gpu --stats -";
    let ran = folder.run(line);
    if ran.status == Some(2) && ran.errors.contains("no graphics driver can be used") {
        let _ = writeln!(
            std::io::stderr().lock(),
            "SKIPPED: a_graphics_card_draws_the_same_picture_and_says_so: {}",
            ran.errors
        );
        return;
    }
    assert_eq!(ran.status, Some(0), "{ran:?}");
    let stats: Value = serde_json::from_str(&ran.output).unwrap();
    assert_eq!(stats["backend"], "gpu");
    assert!(stats["gpu"]["name"].as_str().is_some_and(|name| !name.is_empty()), "{}", stats["gpu"]);
    assert_eq!(stats["rays"]["primary"], 160 * 90);
    assert!(stats["rays"]["refracted"].as_u64().unwrap() > 1000);
    folder.good("render whitted -o cpu.exr --size 160x90 --backend cpu");
    let [gpu, cpu] = ["gpu.exr", "cpu.exr"].map(|name| decode(&folder.read(name)).unwrap());
    let difference = Comparison::default().compare(&gpu, &cpu).unwrap();
    assert!(difference.share_above <= 0.001, "{difference:?}");
}

#[test]
fn statistics_have_the_documented_keys() {
    let folder = Folder::new();
    let options = "--size 20x10 --samples 2 --threads 3 --generations 5 --backend cpu";
    folder.good(&format!("render whitted -o a.png {options} --stats stats.json"));
    let stats: Value = serde_json::from_slice(&folder.read("stats.json")).unwrap();
    assert_eq!(stats["scene"], "whitted");
    assert_eq!((&stats["width"], &stats["height"]), (&20.into(), &10.into()));
    assert_eq!((&stats["method"], &stats["backend"]), (&"whitted".into(), &"cpu".into()));
    for (key, value) in [("samples", 2), ("threads", 3), ("generations", 5), ("bodies", 4), ("lights", 2)] {
        assert_eq!(stats[key], value, "{key}");
    }
    for key in ["read", "prepare", "trace", "develop", "write"] {
        assert!(stats["milliseconds"][key].as_f64().unwrap() >= 0.0, "{key}");
    }
    let rays = |key: &str| stats["rays"][key].as_u64().unwrap();
    assert_eq!(rays("primary"), 400);
    assert_eq!(
        rays("total"),
        rays("primary") + rays("shadow") + rays("reflected") + rays("refracted"),
        "{stats:#}"
    );
    assert!(rays("shadow") > 0 && rays("reflected") > 0 && rays("refracted") > 0);
    assert!(stats["mrays_per_second"].as_f64().unwrap() > 0.0);
    if cfg!(target_os = "linux") {
        assert!(stats["peak_memory_bytes"].as_u64().unwrap() > 1 << 20);
    }
    let printed = folder.good(&format!("render whitted -o a.png {options} --stats -"));
    let printed: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(printed["rays"], stats["rays"]);
    assert_eq!(folder.names(), ["a.png", "stats.json"]);
}

#[test]
fn an_empty_scene_shows_its_background_and_says_so() {
    let folder = Folder::new();
    folder.write("nothing.toml", NOTHING);
    let ran = folder.run("render nothing.toml -o a.exr --size 3x2");
    assert_eq!(ran.status, Some(0), "{ran:?}");
    assert_eq!(
        ran.errors,
        "warning: nothing.toml: the scene has no bodies; the picture shows the background only\n"
    );
    let picture = decode(&folder.read("a.exr")).unwrap();
    assert!(picture.pixels().iter().all(|pixel| *pixel == [0.2, 0.35, 0.6]));
    folder.good("render nothing.toml -o a.exr --size 3x2 --quiet");
}

#[test]
fn all_errors_of_a_bad_file_come_with_their_places_and_no_picture_comes() {
    let folder = Folder::new();
    folder.write("bad.toml", FIVE_ERRORS);
    let errors = folder.refused("render bad.toml -o a.png --size 4x4 --stats stats.json");
    for place in FIVE_PLACES {
        assert_eq!(errors.matches(&format!("--> bad.toml:{place}\n")).count(), 1, "{place}: {errors}");
    }
    assert_eq!(errors.matches("error: ").count(), 5, "{errors}");
}

#[test]
fn hostile_files_are_refused() {
    let folder = Folder::new();
    folder.good("render whitted -o picture.png --size 4x4");
    let deep = format!("format = \"catoptric/1\"\na = {}", "[".repeat(100_000));
    let contents: [(&str, &[u8]); 6] = [
        ("empty.toml", b""),
        ("binary.toml", &folder.read("picture.png")),
        ("zeros.toml", &[0; 10_000]),
        ("deep.toml", deep.as_bytes()),
        ("other.nff", b"v\nfrom 2 0 0\nat 0 0 0\nup 0 0 1\nangle 45\ns 0 0 0 0.5\n"),
        ("version.toml", b"format = \"catoptric/99\"\n"),
    ];
    for (name, content) in contents {
        folder.write(name, content);
        let errors = folder.refused(&format!("render {name} -o a.png --size 4x4"));
        assert!(errors.contains(&format!("--> {name}:")) && errors.len() < 100_000, "{errors}");
    }
}

#[test]
fn wrong_arguments_are_refused_before_anything_is_written() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    folder.write("old.png", "old");
    for (line, said) in [
        ("render whited -o a.png", "did you mean \"whitted\"?"),
        ("render nonsense -o a.png", "`catoptric examples` lists the scenes"),
        ("render no.toml -o a.png", "cannot read no.toml: there is no such file; check its name\n"),
        ("render . -o a.png", "it is a folder"),
        ("render whitted", "--output <FILE>"),
        (
            "render whitted -o a.gif",
            "a name that ends in .png, .exr, .jpg, .jpeg, .hdr, .webp, .tif, .tiff, .ppm, .pnm or .pfm",
        ),
        ("render whitted -o a.bmp", "BMP pictures are read, but not written"),
        ("render whitted -o a.jpg --bits 16", "JPEG files are not written with 16 bits"),
        ("render whitted -o a.png --bits 32", "PNG files are not written with linear light"),
        ("render whitted -o a.webp --size 16385x1", "at most 16384 pixels along a side"),
        ("render whitted -o a.png --quality 50", "only JPEG has a quality"),
        ("render whitted -o whitted", "a name that ends in .png, .exr"),
        ("render whitted -o no/a.png", "there is no directory no"),
        ("render whitted -o old.png --stats old.png", "cannot write old.png"),
        ("render whitted -o a.png --stats ./a.png", "cannot write ./a.png"),
        ("render one.toml -o a.png --stats one.toml", "cannot write one.toml"),
        ("render whitted -o a.png --stats no/s.json", "there is no directory no"),
        ("render whitted -o a.png --size 1000000x1000000", "too large"),
        ("render whitted -o a.png --size 4294967296x1", "at most 1048576 pixels"),
        ("render whitted -o a.png --size 0x1", "at least 1 pixel"),
        ("render whitted -o a.png --size 10", "such as 1280x720"),
        ("render whitted -o a.png --size -1x-1", "unexpected argument"),
        ("render whitted -o a.png --size=-1x-1", "such as 1280x720"),
        ("render whitted -o a.png --threads 0", "1..=1024"),
        ("render whitted -o a.png --threads 99999", "1..=1024"),
        ("render whitted -o a.png --samples 0", "1..=65536"),
        ("render whitted -o a.png --generations 65", "1..=64"),
        ("render whitted -o a.png --exposure nan", "such as -1.5"),
        ("render whitted -o a.png --exposure inf", "such as -1.5"),
        ("render whitted -o a.png --tone-curve wrong", "reinhard"),
        ("render whitted -o a.png --bits 12", "[possible values: 8, 16, 32]"),
        ("render whitted -o a.png --method wrong", "whitted"),
        ("render whitted -o a.png --backend gpu --method ssr", "--backend cpu"),
        ("render whitted -o a.png --backend gpu --map rays", "--backend cpu"),
        ("render whitted -o a.png --backend gpu --gpu nobody's --software-gpu", "--backend cpu"),
        ("render whitted -o a.png --backend cpu --software-gpu", "leave out"),
        ("render whitted -o a.png --backend wrong", "[possible values: auto, cpu, gpu]"),
        ("render whitted -o a.png --nonsense", "--nonsense"),
        ("nonsense", "nonsense"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
    assert_eq!(folder.read("old.png"), b"old");
}

#[test]
fn empty_names_are_refused() {
    let folder = Folder::new();
    for arguments in [["render", "", "-o", "a.png"], ["render", "whitted", "-o", ""]] {
        let ran = folder.run_with(arguments);
        assert_eq!(ran.status, Some(2), "{ran:?}");
        assert!(ran.errors.contains("a value is required"), "{ran:?}");
    }
}

#[test]
fn names_may_hold_spaces_and_any_letters() {
    let folder = Folder::new();
    folder.write("с пробелом.toml", ONE_BODY);
    let ran = folder.run_with(["render", "с пробелом.toml", "-o", "вы ход.png", "--size", "4x4"]);
    assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""));
    assert_eq!(folder.names(), ["вы ход.png", "с пробелом.toml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn names_may_be_any_bytes() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt as _;

    let folder = Folder::new();
    let (scene, picture) = (OsStr::from_bytes(b"s\xff.toml"), OsStr::from_bytes(b"p\xfe.png"));
    folder.write(scene, ONE_BODY);
    let ran = folder.run_with([
        OsStr::new("render"),
        scene,
        OsStr::new("-o"),
        picture,
        OsStr::new("--size"),
        OsStr::new("4x4"),
    ]);
    assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""));
    assert!(folder.path(picture).exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_and_not_half_written() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("/dev/full", folder.path("full.png")).unwrap();
    let errors = folder.refused("render whitted -o full.png --size 4x4");
    assert!(errors.contains("cannot write full.png") && errors.contains("free space"), "{errors}");
    let ran = folder.run("render whitted -o a.png --size 4x4 --stats /dev/full");
    assert_eq!(ran.status, Some(2), "{ran:?}");
    assert!(ran.errors.contains("cannot write /dev/full"), "{ran:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn full_streams_do_not_panic() {
    let folder = Folder::new();
    let full = || File::options().write(true).open("/dev/full").unwrap();
    for line in ["examples", "--help", "--version", "man", "render --help", "check whitted"] {
        let ran = Ran::of(folder.command(line.split(' ')).stdout(full()).output().unwrap());
        assert_eq!(ran.status, Some(2), "{line}: {ran:?}");
        assert!(ran.errors.contains("cannot write to standard output: No space left"), "{line}: {ran:?}");
    }
    for line in ["render no.toml -o a.png", "nonsense"] {
        let ran = Ran::of(folder.command(line.split(' ')).stderr(full()).output().unwrap());
        assert_eq!(ran.status, Some(2), "{line}: {ran:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_error() {
    use std::io::Read as _;

    let folder = Folder::new();
    let mut child = folder.command(["completions", "zsh"]).spawn().unwrap();
    let mut first = [0; 1];
    child.stdout.take().unwrap().read_exact(&mut first).unwrap();
    let ran = Ran::of(child.wait_with_output().unwrap());
    assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""));
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link_and_protected_files_stay() {
    let folder = Folder::new();
    folder.write("real.png", "old");
    std::os::unix::fs::symlink("real.png", folder.path("link.png")).unwrap();
    folder.good("render whitted -o link.png --size 4x4");
    assert!(folder.path("link.png").is_symlink());
    assert!(folder.read("real.png").starts_with(b"\x89PNG"));

    folder.write("protected.png", "old");
    let mut permissions = std::fs::metadata(folder.path("protected.png")).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(folder.path("protected.png"), permissions).unwrap();
    assert!(folder.refused("render whitted -o protected.png --size 4x4").contains("write-protected"));
    assert_eq!(folder.read("protected.png"), b"old");
}

#[test]
fn extreme_shapes_and_numbers_work() {
    let folder = Folder::new();
    for options in [
        "--size 1x1",
        "--size 30000x1",
        "--size 1x3000",
        "--size 2x2 --threads 300",
        "--size 1x1 --samples 65536",
    ] {
        folder.good(&format!("render four-bodies -o a.png {options}"));
    }
    folder.good("render four-bodies -o a.png --size 2x2 --exposure 1e300 --generations 64");
}
