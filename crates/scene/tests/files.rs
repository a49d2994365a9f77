//! Loading and saving on a real disk.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail like that")]

use std::fs;
use std::path::Path;
use std::sync::Arc;

use catoptric_picture::{Picture, write_exr};
use catoptric_scene::{Image, LoadError, Scene, load, load_partly, save, write};

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
    let moved = |path: &str| Image::moved_path(path, from, to);
    assert_eq!(moved("wood.png").as_deref(), Some("a/wood.png"));
    assert_eq!(moved("/scenes/t/wood.png").as_deref(), Some("t/wood.png"));
    assert_eq!((moved("/wood.png"), moved("builtin:grid")), (None, None));
    assert_eq!(Image::moved_path("wood.png", from, None).as_deref(), Some("/scenes/a/wood.png"));
    assert_eq!(Image::moved_path("./wood.png", from, from), None, "as it was written");
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for name in ["a", "b", "t", "b/c", "b/t"] {
        fs::create_dir(at(name)).unwrap();
    }
    fs::write(at("t/wood.png"), "").unwrap();
    let moved = |to: &str| Image::moved_path("../t/wood.png", Some(&at("a")), Some(&at(to)));
    assert_eq!(moved("b"), None, "both folders have the way in common");
    let whole = at("a/../t/wood.png").to_str().map(str::to_owned);
    assert_eq!(moved("b/c"), whole);
    fs::write(at("b/t/wood.png"), "another").unwrap();
    assert_eq!(moved("b/c"), whole);
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
         6:17: error: cannot open the picture `no.png`: this is neither a PNG nor an EXR picture; \
         convert it to one of these\n\
         7:17: error: cannot open the picture `builtin:gird`: there is no built-in picture of this name; \
         there are evening, studio, planet, grid\n8:17: {none}"
    );
    assert_eq!(diagnostics.to_string(), expected);
    let (reading, _) = load_partly(&path).unwrap();
    assert_eq!((reading.scene.bodies.len(), reading.scene.materials.len()), (3, 3));
    assert!(reading.scene.images().all(|image| image.pixels().is_none()));
}
