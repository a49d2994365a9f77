//! Loading and saving on a real disk.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail like that")]

use std::fs;

use catoptric_scene::{LoadError, Scene, load, load_partly, save, write};

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
