//! Picture files of all formats, and malformed ones, given to the program.

use crate::common::{Folder, ONE_BODY};
use catoptric_picture::{Comparison, decode};

/// A palette of four bytes, on which `png` 0.18.1 panics.
const BAD_PALETTE: &[u8] = include_bytes!("files/bad-palette.png");
/// A flipped bit in a DWA chunk, by which `exr` 1.74.2 asks for 72 PB.
const DWA_ONE_BYTE: &[u8] = include_bytes!("files/dwa-one-byte.exr");
/// The layers `ViewLayer.AO` and `ViewLayer.Combined`, in this order.
const LAYERS: &[u8] = include_bytes!("files/layers-ao-first.exr");

#[test]
fn renders_are_written_and_read_in_every_format() {
    let folder = Folder::new();
    folder.good("render whitted -o truth.exr --size 48x32");
    folder.good("render whitted -o shown.png --size 48x32");
    for (name, options, truth, most) in [
        ("a.jpg", "", "shown.png", 0.05),
        ("b.jpeg", "--quality 100", "shown.png", 0.02),
        ("c.webp", "", "shown.png", 0.0),
        ("d.tif", "--bits 8", "shown.png", 0.0),
        ("e.tiff", "", "shown.png", 0.003),
        ("f.tif", "--bits 32", "truth.exr", 0.0),
        ("g.hdr", "", "truth.exr", 0.01),
        ("h.EXR", "--bits 16", "truth.exr", 0.0),
    ] {
        folder.good(&format!("render whitted -o {name} --size 48x32 {options}"));
        folder.good(&format!("convert truth.exr again-{name} {options}"));
        assert!(folder.read(name) == folder.read(format!("again-{name}")), "{name}");
        let pictures = [name, truth].map(|name| decode(&folder.read(name)).unwrap());
        let difference = Comparison::default().compare(&pictures[0], &pictures[1]).unwrap();
        assert!(difference.rmse <= most, "{name}: {difference:?}");
        let report = folder.run(&format!("diff {name} {truth} --tolerance 1"));
        assert_eq!(report.status, Some(0), "{name}: {report:?}");
        folder.good(&format!("compare --pictures {truth},{name} -o report-{name} --quiet"));
    }
}

#[test]
fn textures_and_surroundings_are_read_in_every_format() {
    let folder = Folder::new();
    for name in ["p.png", "p.exr", "p.jpg", "p.webp", "p.tif", "p.hdr"] {
        folder.good(&format!("render whitted -o {name} --size 32x16"));
        let scene = format!("{ONE_BODY}[environment]\npicture = \"{name}\"\n");
        folder.write(
            "scene.toml",
            scene
                .replace("\"sphere\"\n", "\"sphere\"\nmaterial = { texture = \"NAME\" }\n")
                .replace("NAME", name),
        );
        folder.good("check scene.toml");
        folder.good("render scene.toml -o seen.exr --size 16x12");
        let seen = decode(&folder.read("seen.exr")).unwrap();
        assert!(seen.pixels().iter().flatten().any(|&value| value > 0.0), "{name}");
    }
}

#[test]
fn a_picture_that_breaks_its_decoder_is_an_error_of_every_command() {
    let folder = Folder::new();
    folder.write("bad.png", BAD_PALETTE);
    folder.write("bad.exr", DWA_ONE_BYTE);
    folder.good("render whitted -o good.png --size 1x1");
    for name in ["bad.png", "bad.exr"] {
        let scene = format!("{ONE_BODY}[environment]\npicture = \"{name}\"\n");
        folder.write("scene.toml", &scene);
        let textured = ONE_BODY.replace("\"sphere\"\n", "\"sphere\"\nmaterial = { texture = \"NAME\" }\n");
        folder.write("body.toml", textured.replace("NAME", name));
        for line in [
            format!("convert {name} out.exr"),
            format!("diff {name} good.png"),
            format!("diff good.png {name}"),
            format!("compare --pictures good.png,{name} -o out"),
        ] {
            let said = folder.refused(&line);
            assert!(said.contains(name) && said.contains("corrupt"), "{line}: {said}");
        }
        for line in [
            "check scene.toml",
            "check body.toml",
            "render scene.toml -o out.png",
            "render body.toml -o out.png",
        ] {
            let ran = folder.run(line);
            assert_eq!(ran.status, Some(2), "{line}: {ran:?}");
            let said = ran.output + &ran.errors;
            assert!(
                said.contains(name) && said.contains("corrupt") && !said.contains("panicked"),
                "{line}: {said}"
            );
        }
    }
}

#[test]
fn the_picture_comes_before_its_layers_and_a_layer_can_be_chosen() {
    let folder = Folder::new();
    folder.write("l.exr", LAYERS);
    folder.good("convert l.exr picture.exr");
    folder.good("convert l.exr combined.exr --layer ViewLayer.Combined");
    folder.good("convert l.exr ao.exr --layer AO");
    assert!(folder.read("picture.exr") == folder.read("combined.exr"));
    assert!(folder.read("picture.exr") != folder.read("ao.exr"));
    // A picture without named layers is read as it is, beside one that has the layer.
    folder.good("diff ao.exr l.exr --layer ViewLayer.AO");
    folder.good("diff l.exr ao.exr --layer AO");
    assert_eq!(folder.run("diff l.exr ao.exr").status, Some(1));
    folder.good("compare --pictures ao.exr,l.exr --layer AO -o report --quiet");

    for line in ["convert l.exr out.exr --layer Glossy", "diff l.exr ao.exr --layer Glossy"] {
        let said = folder.refused(line);
        assert!(said.contains("`Glossy`") && said.contains("ViewLayer.AO, ViewLayer.Combined"), "{said}");
    }
    for line in ["convert ao.exr out.exr --layer AO", "diff ao.exr ao.exr --layer AO"] {
        assert!(folder.refused(line).contains("no named layers"), "{line}");
    }
    let scene = |layer: &str| format!("{ONE_BODY}[environment]\npicture = \"l.exr\"\n{layer}");
    folder.write("all.toml", scene(""));
    folder.write("ao.toml", scene("layer = \"ViewLayer.AO\"\n"));
    folder.good("render all.toml -o all.exr --size 8x8");
    folder.good("render ao.toml -o one.exr --size 8x8");
    assert!(folder.read("all.exr") != folder.read("one.exr"));
    folder.good("convert ao.toml again.toml");
    assert!(String::from_utf8(folder.read("again.toml")).unwrap().contains("layer = \"ViewLayer.AO\""));
}

#[test]
#[cfg(target_os = "linux")]
fn a_comparison_takes_memory_in_proportion_to_the_pixels() {
    // 2048×2048 black pixels of one bit in half a kilobyte; twice 48 MiB of light.
    let folder = Folder::new();
    let row = [0_u8; 257];
    let mut zlib = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    for _ in 0..2048 {
        std::io::Write::write_all(&mut zlib, &row).unwrap();
    }
    let png = one_bit_png(2048, 2048, &zlib.finish().unwrap());
    folder.write("a.png", &png);
    folder.write("b.png", &png);
    let program = env!("CARGO_BIN_EXE_catoptric");
    // The limit is on addresses, of which allocators and threads reserve some. Before, this took 1.4 GB.
    let shell = format!("ulimit -v 900000; exec {program} diff a.png b.png --json");
    let ran =
        std::process::Command::new("sh").args(["-c", &shell]).current_dir(folder.path("")).output().unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
}

/// A black-and-white PNG with these compressed rows.
fn one_bit_png(width: u32, height: u32, zlib: &[u8]) -> Vec<u8> {
    let header = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[1, 0, 0, 0, 0]].concat();
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    for (name, data) in [(b"IHDR", header.as_slice()), (b"IDAT", zlib), (b"IEND", &[])] {
        let body = [&name[..], data].concat();
        let mut sum = flate2::Crc::new();
        sum.update(&body);
        png.extend((data.len() as u32).to_be_bytes());
        png.extend(&body);
        png.extend(sum.sum().to_be_bytes());
    }
    png
}
