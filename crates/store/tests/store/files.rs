//! Loading and saving on a real disk.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use catoptric_picture::{Picture, write_exr};
use catoptric_scene::{Image, Scene, read, write};
use catoptric_store::{LoadError, load, load_partly, moved_path, moved_relative_path, save};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

#[test]
fn what_is_saved_can_be_loaded() {
    let folder = folder();
    let path = folder.path().join("a.toml");
    let text = write(&Scene::default());
    save(&path, &text).unwrap();
    let loaded = load(&path).unwrap();
    assert_eq!((loaded.scene, loaded.text), (Scene::default(), text));
    assert!(loaded.warnings.is_empty());
    save(&path, "format = 'catoptric/1'\n").unwrap();
    assert_eq!(load(&path).unwrap().text, "format = 'catoptric/1'\n");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");
}

#[test]
fn what_cannot_be_read_is_said() {
    let folder = folder();
    let shown = folder.path().display();
    let error = load(folder.path()).unwrap_err();
    assert_eq!(error.to_string(), format!("cannot read {shown}: it is a folder; name a scene file in it"));
    let error = load(folder.path().join("a.toml")).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("cannot read {shown}/a.toml: there is no such file; check its name")
    );
    let path = folder.path().join("b.toml");
    fs::write(&path, "format = 'catoptric/1'\ncamera.fov = 0\n").unwrap();
    let error = load(&path).unwrap_err();
    let expected = format!("{shown}/b.toml:2:14: error: `fov` is `0`, but must be at least 0.001");
    assert_eq!(error.to_string(), expected);
    let LoadError::Diagnostics { text, diagnostics, .. } = error else { panic!("{error}") };
    assert!(diagnostics.render("b.toml", &text, false).contains("camera.fov = 0"));
    fs::write(&path, b"\xff").unwrap();
    assert!(load(&path).unwrap_err().to_string().contains("1:1: error: the file is not UTF-8 text"));
    let file = fs::File::create(&path).unwrap();
    file.set_len((1 << 30) + 1).unwrap();
    assert!(load(&path).unwrap_err().to_string().contains("longer than 1024 MiB"));
}

#[test]
fn the_good_part_of_a_bad_file_can_be_loaded() {
    let folder = folder();
    let path = folder.path().join("a.toml");
    let text = "format = 'catoptric/1'\n[[bodies]]\nshape = 'sphere'\n[[bodies]]\nshape = 'banana'\n";
    fs::write(&path, text).unwrap();
    let (reading, read) = load_partly(&path).unwrap();
    assert_eq!((reading.scene.bodies.len(), read.as_str()), (1, text));
    assert!(reading.diagnostics.has_errors() && load(&path).is_err());
    assert!(load_partly(folder.path()).is_err());
}

#[test]
fn what_cannot_be_written_leaves_the_old_file() {
    let folder = folder();
    assert!(save(folder.path(), "x").is_err());
    assert!(save(folder.path().join("none/a.toml"), "x").is_err());
    let path = folder.path().join("a.toml");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let error = save(&path, "new").unwrap_err();
    assert!(error.to_string().starts_with(&format!("cannot write {}: ", path.display())));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
}

#[test]
fn pictures_are_found_beside_the_scene_and_shared() {
    let folder = folder();
    let grays = [0.25, f32::INFINITY, -1.0, f32::NAN];
    let picture = Picture::from_fn(4, 2, |x, y| [grays[x as usize], y as f32, 2.0]).unwrap();
    write_exr(&folder.path().join("around.exr"), &picture).unwrap();
    let path = folder.path().join("a.toml");
    let text = "format = 'catoptric/1'\nenvironment.picture = 'around.exr'\n\
        [materials.m]\ntexture = './around.exr'\n\
        [[bodies]]\nmaterial = { model = 'matte', texture = 'builtin:grid' }\n[[bodies]]\nmaterial = 'm'\n";
    fs::write(&path, text).unwrap();
    let loaded = load(&path).unwrap();
    assert!(loaded.warnings.is_empty(), "{}", loaded.warnings);
    let images: Vec<&Image> = loaded.scene.images().collect();
    let paths: Vec<&str> = images.iter().map(|image| image.path()).collect();
    assert_eq!(paths, ["around.exr", "./around.exr", "builtin:grid"]);
    let pixels: Vec<_> = images.iter().map(|image| image.pixels().unwrap()).collect();
    assert!(Arc::ptr_eq(pixels[0], pixels[1]), "one file is read once");
    let first: Vec<f32> = pixels[0].pixels()[..4].iter().map(|pixel| pixel[0]).collect();
    assert_eq!(first, [0.25, 1e6, 0.0, 0.0], "what no light can be is mended");
    assert_eq!(load(&path).unwrap().scene, loaded.scene);
    // Another picture in the same place is another scene.
    let other = Picture::from_fn(4, 2, |x, _| [x as f32; 3]).unwrap();
    write_exr(&folder.path().join("around.exr"), &other).unwrap();
    let file = fs::File::options().write(true).open(folder.path().join("around.exr")).unwrap();
    file.set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
    assert_ne!(load(&path).unwrap().scene, loaded.scene);
}

#[test]
fn a_path_that_moves_to_another_folder_leads_to_the_same_file() {
    let (from, to) = (Some(Path::new("/scenes/a")), Some(Path::new("/scenes")));
    let moved = |path: &str| moved_path(path, from, to);
    assert_eq!(moved("wood.png").as_deref(), Some("a/wood.png"));
    assert_eq!(moved("/scenes/t/wood.png").as_deref(), Some("t/wood.png"));
    assert_eq!((moved("/wood.png"), moved("builtin:grid")), (None, None));
    assert_eq!(moved_path("wood.png", from, None).as_deref(), Some("/scenes/a/wood.png"));
    assert_eq!(moved_path("./wood.png", from, from), None, "as it was written");
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for name in ["a", "b", "t", "b/c", "b/t"] {
        fs::create_dir(at(name)).unwrap();
    }
    fs::write(at("t/wood.png"), "").unwrap();
    let moved = |to: &str| moved_path("../t/wood.png", Some(&at("a")), Some(&at(to)));
    assert_eq!(moved("b"), None, "both folders have the way in common");
    let whole = at("a/../t/wood.png").to_str().map(str::to_owned);
    assert_eq!(moved("b/c"), whole);
    fs::write(at("b/t/wood.png"), "another").unwrap();
    assert_eq!(moved("b/c"), whole);
}

#[test]
fn a_relative_path_can_stay_relative() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for name in ["a", "b", "t", "b/c", "b/t"] {
        fs::create_dir(at(name)).unwrap();
    }
    fs::write(at("t/wood.png"), "").unwrap();
    fs::write(at("b/t/wood.png"), "another").unwrap();
    let moved = |to: &str| moved_relative_path("../t/wood.png", &at("a"), &at(to));
    assert_eq!(moved("b"), None, "both folders have the way in common");
    assert_eq!(moved("b/c").as_deref(), Some("../../t/wood.png"));
    assert_eq!(moved("").as_deref(), Some("t/wood.png"));
    assert_eq!(moved("t"), None, "up and down again");
    assert_eq!(moved("not/yet/there").as_deref(), Some("../../../t/wood.png"));
    let whole = at("t/wood.png").to_str().unwrap().to_owned();
    assert_eq!(moved_relative_path(&whole, &at("a"), &at("b")), None, "as it was written");
    assert_eq!(moved_relative_path("builtin:grid", &at("a"), &at("b")), None);
}

/// `..` after a symbolic link leads to the folder above the link's destination.
#[cfg(unix)]
#[test]
fn a_path_that_moves_past_a_link_leads_to_the_same_file() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for name in ["a", "deep", "deep/er"] {
        fs::create_dir(at(name)).unwrap();
    }
    std::os::unix::fs::symlink(at("deep/er"), at("link")).unwrap();
    fs::write(at("a/wood.png"), "").unwrap();
    let moved = moved_relative_path("wood.png", &at("a"), &at("link")).unwrap();
    assert_eq!(moved, "../../a/wood.png");
    assert!(at("link").join(&moved).exists());
    // By a link that is on the way as the user wrote it, it stays.
    std::os::unix::fs::symlink(at("a"), at("textures")).unwrap();
    let moved = moved_relative_path("../textures/wood.png", &at("deep"), &at("deep/er"));
    assert_eq!(moved.as_deref(), Some("../../textures/wood.png"));
}

#[test]
fn pictures_that_cannot_be_opened_are_told_where_they_are_named() {
    let folder = folder();
    fs::write(folder.path().join("no.png"), "no picture").unwrap();
    let path = folder.path().join("a.toml");
    let text = "format = 'catoptric/1'\n# picture = 'none.exr'\n[environment]\npicture = 'none.exr'\n\
        [materials]\na = { texture = 'no.png' }\nb = { texture = 'builtin:gird' }\nc = { texture = 'none.exr' }\n\
        [[bodies]]\nmaterial = 'a'\n[[bodies]]\nmaterial = 'b'\n[[bodies]]\nmaterial = 'c'\n";
    fs::write(&path, text).unwrap();
    let LoadError::Diagnostics { diagnostics, .. } = load(&path).unwrap_err() else { panic!() };
    let shown = folder.path().display();
    let none = format!(
        "error: cannot open the picture `none.exr`: there is no file {shown}/none.exr; \
         check the path, which begins at the scene's folder"
    );
    let expected = format!(
        "4:11: {none}\n\
         6:17: error: cannot open the picture `no.png`: this is none of the formats that are read \
         (PNG, EXR, JPEG, HDR, WebP, TIFF, BMP, PPM, PFM); convert it to one of these\n\
         7:17: error: cannot open the picture `builtin:gird`: there is no built-in picture of this name; \
         there are evening, studio, planet, grid\n8:17: {none}"
    );
    assert_eq!(diagnostics.to_string(), expected);
    let (reading, _) = load_partly(&path).unwrap();
    assert_eq!((reading.scene.bodies.len(), reading.scene.materials.len()), (3, 3));
    assert!(reading.scene.images().all(|image| image.pixels().is_none()));
}

/// An EXR of one pixel whose layers have these names and values.
fn write_layers(path: &Path, layers: &[(&str, f32)]) {
    use exr::prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage as _,
    };
    let channels = layers.iter().flat_map(|(name, value)| {
        ["B", "G", "R"].map(|letter| {
            AnyChannel::new(format!("{name}.{letter}").as_str(), FlatSamples::F32(vec![*value]))
        })
    });
    let layer = Layer::new(
        (1, 1),
        LayerAttributes::default(),
        Encoding::UNCOMPRESSED,
        AnyChannels::sort(channels.collect()),
    );
    Image::from_layer(layer).write().non_parallel().to_file(path).unwrap();
}

#[test]
fn a_layer_is_chosen_beside_the_path_and_each_is_a_picture_of_its_own() {
    let folder = folder();
    write_layers(&folder.path().join("l.exr"), &[("ViewLayer.AO", 0.25), ("ViewLayer.Combined", 0.5)]);
    let path = folder.path().join("a.toml");
    let text = "format = 'catoptric/1'\nenvironment = { picture = 'l.exr', layer = 'ViewLayer.AO' }\n\
        [materials]\nm = { texture = 'l.exr' }\nn = { texture = 'l.exr', layer = 'AO' }\n\
        [[bodies]]\nmaterial = 'm'\n[[bodies]]\nmaterial = 'n'\n";
    fs::write(&path, text).unwrap();
    let loaded = load(&path).unwrap();
    let values: Vec<f32> =
        loaded.scene.images().map(|image| image.pixels().unwrap().pixels()[0][1]).collect();
    assert_eq!(values, [0.25, 0.5, 0.25]);
    let layers: Vec<_> = loaded.scene.images().map(|image| image.layer().map(str::to_owned)).collect();
    assert_eq!(layers, [Some("ViewLayer.AO".to_owned()), None, Some("AO".to_owned())]);
    let written = write(&loaded.scene);
    assert!(written.contains("layer = \"ViewLayer.AO\""), "{written}");
    assert_eq!(
        read(&written).scene.images().map(Image::source).collect::<Vec<_>>(),
        loaded.scene.images().map(Image::source).collect::<Vec<_>>()
    );

    let wrong = [
        (
            "environment = { picture = 'l.exr', layer = 'Glossy' }",
            "no layer `Glossy`; it has ViewLayer.AO, ViewLayer.Combined",
        ),
        ("environment = { layer = 'AO' }", "`layer` needs `picture`"),
        ("environment = { picture = 'builtin:evening', layer = 'AO' }", "no layers"),
        ("[materials]\nm = { layer = 'AO' }\n[[bodies]]\nmaterial = 'm'", "`layer` needs `texture`"),
        (
            "[materials]\nm = { model = 'conductor', layer = 'AO' }\n[[bodies]]\nmaterial = 'm'",
            "`layer` is only for `model`",
        ),
    ];
    for (text, expected) in wrong {
        fs::write(&path, format!("format = 'catoptric/1'\n{text}\n")).unwrap();
        let error = load(&path).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn a_picture_that_kills_its_decoder_is_an_error_at_its_name() {
    let folder = folder();
    // A palette of four bytes, and a head that declares more pixels than a scene may take.
    let palette = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0(\xcb4\xbb\0\0\0\x04PLTE\0\0\0\0\xb4\xa3\xaez\
        \0\0\0\nIDATx\x9cc`\0\0\0\x02\0\x01H\xaf\xa4q\0\0\0\0IEND\xaeB`\x82";
    fs::write(folder.path().join("bad.png"), palette).unwrap();
    let large = ["#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4097 +X 8193\n", &"\0".repeat(4 * 4097)].concat();
    fs::write(folder.path().join("large.hdr"), large).unwrap();
    let path = folder.path().join("a.toml");
    for (name, expected) in
        [("bad.png", "PNG decoder broke down"), ("large.hdr", "8193x4097 pixels, but may have")]
    {
        fs::write(&path, format!("format = 'catoptric/1'\nenvironment.picture = '{name}'\n")).unwrap();
        let LoadError::Diagnostics { diagnostics, .. } = load(&path).unwrap_err() else { panic!() };
        assert!(diagnostics.to_string().contains(expected), "{diagnostics}");
    }
}
