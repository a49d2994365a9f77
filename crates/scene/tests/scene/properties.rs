//! What holds for every scene and every text.

use catoptric_scene::{
    Language, Material, Model, NamedMaterial, Phong, Scene, read, read_bytes, update, write,
};
use proptest::prelude::*;

const SMALL: &str = include_str!("small.toml");

/// Reads a text and looks at all that is found, however odd.
fn read_anything(bytes: Vec<u8>) {
    let length = bytes.len();
    let (reading, text) = read_bytes(bytes);
    let rendered = reading.diagnostics.render("a.toml", &text, false);
    assert!(rendered.len() < 4000 * (reading.diagnostics.len() + 1), "long findings for {length} bytes");
    for diagnostic in &reading.diagnostics {
        assert!(diagnostic.line > 0 && diagnostic.column > 0);
        assert!(diagnostic.span.start <= text.len());
        assert!(!diagnostic.message(Language::English).is_empty());
    }
    // What is left of a broken file is a scene without problems.
    let problems = reading.scene.check();
    assert!(problems.is_empty(), "{problems:?} in\n{text}");
    if !reading.diagnostics.has_errors() {
        assert_eq!(read(&write(&reading.scene)).scene, reading.scene);
    }
}

#[test]
fn a_file_cut_anywhere_is_read() {
    for length in 0..=SMALL.len() {
        read_anything(SMALL.as_bytes()[..length].to_vec());
    }
}

#[test]
fn a_file_without_any_one_byte_is_read() {
    for place in 0..SMALL.len() {
        let mut bytes = SMALL.as_bytes().to_vec();
        bytes.remove(place);
        read_anything(bytes);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn written_scenes_read_back(scene in crate::common::scene()) {
        prop_assert_eq!(scene.check(), vec![]);
        let text = write(&scene);
        let reading = read(&text);
        prop_assert!(!reading.diagnostics.has_errors(), "{}\n{}", reading.diagnostics, text);
        prop_assert_eq!(&reading.scene, &scene);
        prop_assert_eq!(write(&reading.scene), text);
    }

    #[test]
    fn a_material_of_any_model_is_written_and_read_back(material in crate::common::material()) {
        let named = NamedMaterial { name: "m".to_owned(), material };
        let scene = Scene { materials: vec![named], ..Scene::default() };
        let reading = read(&write(&scene));
        prop_assert!(!reading.diagnostics.has_errors(), "{}", reading.diagnostics);
        prop_assert_eq!(reading.scene, scene);
    }

    #[test]
    fn a_change_of_the_model_keeps_what_both_models_have(material in crate::common::material()) {
        for model in Model::ALL {
            let other = material.with_model(model);
            prop_assert_eq!(other.model(), model);
            let back = other.with_model(material.model());
            if other.pattern().is_some() && material.pattern().is_some() {
                prop_assert_eq!(other.pattern(), material.pattern());
                prop_assert_eq!(back.pattern(), material.pattern());
            }
            for number in [Material::ambient, Material::ior, Material::roughness] {
                if let (Some(here), Some(there)) = (number(&material), number(&other)) {
                    prop_assert_eq!((there, number(&back)), (here, Some(here)));
                }
            }
            if let (Material::Phong(Phong { reflection, .. }), Material::Mirror(mirror)) = (&material, &other) {
                prop_assert_eq!(mirror.reflection, *reflection);
            }
            // What is remembered of a model is as it was, when nothing has changed meanwhile.
            prop_assert_eq!(material.clone().with_shared(&other), material.clone());
        }
    }

    #[test]
    fn updated_texts_say_the_scene(before in crate::common::scene(), after in crate::common::scene()) {
        let text = write(&before);
        prop_assert_eq!(&update(&text, &before), &text);
        let updated = update(&text, &after);
        prop_assert_eq!(&read(&updated).into_result().unwrap().value, &after);
        prop_assert_eq!(&update(&updated, &after), &updated);
        let commented = update(&format!("# beginning\n{text}"), &after);
        prop_assert!(commented.starts_with("# beginning\n"), "{}\n{}\n{}", text, write(&after), commented);
        let from_small = update(SMALL, &after);
        prop_assert!(from_small.contains("# dotted"), "{}\n{}", write(&after), from_small);
        prop_assert_eq!(&read(&from_small).into_result().unwrap().value, &after);
    }

    #[test]
    fn edits_keep_the_rest(scene in crate::common::scene(), seed in any::<u8>()) {
        // Every line gets a comment; an edit of one body keeps all comments outside of it.
        let text = write(&scene).replace("\n\n", "\n# between\n").replace("]]\n", "]] # header\n");
        let text = format!("# beginning\n{text}# end\n");
        if scene.bodies.is_empty() || read(&text).scene != scene {
            return Ok(());
        }
        let mut edited = scene.clone();
        let index = usize::from(seed) % edited.bodies.len();
        let scale = &mut edited.bodies[index].placement.scale;
        *scale = if *scale == glam::DVec3::ONE { glam::DVec3::X + glam::DVec3::ONE } else { glam::DVec3::ONE };
        let updated = update(&text, &edited);
        prop_assert_eq!(&read(&updated).into_result().unwrap().value, &edited);
        for comment in ["# beginning", "# between", "# header", "# end"] {
            prop_assert_eq!(updated.matches(comment).count(), text.matches(comment).count(), "{}\n{}", text, updated);
        }
    }

    #[test]
    fn mutated_files_are_read(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4u8, 0..30usize), 1..8)
    ) {
        let mut bytes = SMALL.as_bytes().to_vec();
        for (index, byte, kind, length) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = index.index(bytes.len());
            let end = (at + length).min(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => drop(bytes.drain(at..end)),
                2 => {
                    let part = bytes[at..end].to_vec();
                    let to = usize::from(byte) % bytes.len();
                    bytes.splice(to..to, part);
                }
                _ => bytes.insert(at, b"[]{}=.,\"'#\n\\"[usize::from(byte) % 12]),
            }
        }
        read_anything(bytes);
    }

    #[test]
    fn arbitrary_texts_are_read(text in "\\PC{0,200}", tokens in proptest::collection::vec(
        prop::sample::select(vec!["[", "]", "{", "}", "[[", "]]", "=", ".", ",", "\n", "\r\n", " ", "bodies", "materials",
            "camera", "shape", "'", "\"", "\"\"\"", "'''", "#", "1", "-", "nan", "\\", "material", "checker", "color", "fov"]),
        0..60)) {
        read_anything(text.into_bytes());
        read_anything(tokens.concat().into_bytes());
    }
}

#[test]
fn deep_and_wide_texts_end_soon() {
    for text in [
        "[",
        "{",
        "[{a=",
        "a=[",
        "a={",
        "a.",
        "[a]\n",
        "[[bodies]]\n",
        "\"",
        "'''",
        "=",
        "x=1\n",
        "a=[\n[b,",
        "a={b=1\n",
        "#\n",
        "-",
    ] {
        read_anything(text.repeat(20_000).into_bytes());
        read_anything(format!("a = {}", text.repeat(20_000)).into_bytes());
    }
}

#[test]
fn a_new_scene_is_written_over_garbage() {
    let scene = Scene::default();
    assert_eq!(update("not toml [", &scene), write(&scene));
}
