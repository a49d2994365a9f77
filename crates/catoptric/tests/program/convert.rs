//! `catoptric convert`

use crate::common::{FIVE_ERRORS, Folder, ONE_BODY};

#[test]
fn pictures_survive_the_round_trip() {
    let folder = Folder::new();
    for bits in [8, 16] {
        folder.good(&format!("render whitted -o a.png --size 32x24 --bits {bits}"));
        folder.good("convert a.png b.exr");
        folder.good(&format!("convert b.exr c.png --bits {bits}"));
        assert!(folder.read("a.png") == folder.read("c.png"), "{bits} bits");
        folder.good("convert b.exr d.exr --exposure 3 --tone-curve filmic");
        assert!(folder.read("b.exr") == folder.read("d.exr"), "linear light stays as it is");
    }
}

#[test]
fn development_makes_the_picture_that_render_makes() {
    let folder = Folder::new();
    let options = "--exposure 0.5 --tone-curve reinhard --bits 16";
    folder.good(&format!("render whitted -o a.png --size 16x12 {options}"));
    folder.good("render whitted -o b.exr --size 16x12");
    folder.good(&format!("convert b.exr b.png {options}"));
    assert!(folder.read("a.png") == folder.read("b.png"));
}

#[test]
fn pictures_are_known_by_their_content() {
    let folder = Folder::new();
    folder.good("render whitted -o a.exr --size 8x8");
    std::fs::copy(folder.path("a.exr"), folder.path("really.png")).unwrap();
    folder.good("convert really.png b.exr");
    assert!(folder.read("a.exr") == folder.read("b.exr"));
}

#[test]
fn a_scene_in_its_standard_form_is_the_same_scene() {
    let folder = Folder::new();
    folder.good("examples whitted -o a.toml");
    folder.good("convert a.toml b.toml");
    folder.good("convert b.toml c.toml");
    assert!(folder.read("b.toml") == folder.read("c.toml"));
    folder.good("render a.toml -o a.exr --size 16x12");
    folder.good("render b.toml -o b.exr --size 16x12");
    assert!(folder.read("a.exr") == folder.read("b.exr"));
}

#[test]
fn a_scene_in_another_folder_keeps_its_pictures() {
    let folder = Folder::new();
    for name in ["one", "one/pictures", "two"] {
        std::fs::create_dir(folder.path(name)).unwrap();
    }
    folder.good("render whitted -o one/pictures/a.png --size 8x4");
    folder.write("one/a.toml", format!("{ONE_BODY}[environment]\npicture = \"pictures/a.png\"\n"));
    folder.good("render one/a.toml -o a.exr --size 16x12");
    // Beside it, the path may stay as it was written.
    folder.good("convert one/a.toml one/b.toml");
    assert!(String::from_utf8(folder.read("one/b.toml")).unwrap().contains("\"pictures/a.png\""));
    folder.good("convert one/a.toml two/c.toml");
    folder.good("render two/c.toml -o c.exr --size 16x12");
    assert!(folder.read("a.exr") == folder.read("c.exr"));
    let paths = |name: &str| String::from_utf8(folder.read(name)).unwrap();
    assert!(paths("two/c.toml").contains("\"../one/pictures/a.png\""));
    folder.good("convert one/a.toml d.toml");
    assert!(paths("d.toml").contains("\"one/pictures/a.png\""));
    // Moved together, they find each other still.
    std::fs::create_dir(folder.path("moved")).unwrap();
    for name in ["one", "two"] {
        std::fs::rename(folder.path(name), folder.path("moved").join(name)).unwrap();
    }
    folder.good("check moved/two/c.toml");
}

#[test]
fn what_cannot_be_converted_is_refused() {
    let folder = Folder::new();
    folder.write("one.toml", ONE_BODY);
    folder.write("bad.toml", FIVE_ERRORS);
    folder.write("text.png", ONE_BODY);
    folder.good("render whitted -o a.png --size 4x4");
    for (line, said) in [
        ("convert one.toml b.png", "`catoptric render` makes a picture of it"),
        ("convert a.png b.toml", "cannot make a scene of a.png"),
        ("convert whitted b.toml", "`catoptric examples` writes"),
        ("convert a.png b.gif", ".yml or .nff"),
        ("convert a.png b", ".yml or .nff"),
        ("convert no.png b.exr", "cannot open no.png"),
        ("convert no.toml b.toml", "cannot read no.toml: there is no such file; check its name\n"),
        ("convert bad.toml b.toml", "bad.toml:3:7"),
        ("convert text.png b.exr", "none of the formats that are read"),
        ("convert a.png no/b.exr", "there is no directory no"),
        ("convert one.toml ./one.toml", "cannot write ./one.toml"),
        ("convert a.png a.png", "cannot write a.png"),
        ("convert a.png", "<OUT>"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
    assert_eq!(folder.read("one.toml"), ONE_BODY.as_bytes());
}
