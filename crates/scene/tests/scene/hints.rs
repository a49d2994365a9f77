//! What findings advise is sound: copied into the file, it mends what they find.

use catoptric_scene::{
    Body, Diagnostic, Language, Material, MaterialChoice, NamedMaterial, Scene, is_active, read, write,
};
use proptest::prelude::*;

/// Names as people and machines give them.
fn name() -> impl Strategy<Value = String> {
    prop_oneof![
        "[a-z]{1,8}( [a-z]{1,8}){0,2}",
        "[a-zA-Z0-9_-]{1,12}",
        r#"[ab"'\\`.\[\]{}#=, \t\n\u{1b}\u{7f}\u{9b}\u{202e}жé]{1,12}"#,
        any::<String>().prop_map(|name| name.chars().take(20).collect()),
    ]
    .prop_filter("a name is not empty", |name| !name.is_empty())
}

/// The parts of a text between backquotes, read from the front.
fn advised(text: &str, before: &str, after: &str) -> Option<String> {
    let start = text.find(before)? + before.len();
    let end = start + text.get(start..)?.find(after)?;
    text.get(start..end).map(str::to_owned)
}

fn errors(text: &str) -> Vec<Diagnostic> {
    read(text).diagnostics.iter().cloned().collect()
}

fn replaced(text: &str, finding: &Diagnostic, by: &str) -> String {
    format!("{}{by}{}", &text[..finding.span.start], &text[finding.span.end..])
}

fn scene_with(material: &str) -> Scene {
    let body = Body { material: MaterialChoice::Named(material.to_owned()), ..Body::default() };
    let mut scene = Scene { bodies: [body].into(), ..Scene::default() };
    scene.environment.ambient = catoptric_scene::Color::WHITE;
    scene
}

proptest! {
    #[test]
    fn a_material_that_is_missing_can_be_defined_as_advised(name in name()) {
        let text = write(&scene_with(&name));
        let found = errors(&text);
        prop_assert_eq!(found.len(), 1, "{:?}", found);
        let help = found[0].help(Language::English).unwrap();
        let header = advised(&help, "define it with `", "`, or write").unwrap();
        let russian = found[0].help(Language::Russian).unwrap();
        let told = advised(&russian, "определите его: `", "`, или напишите");
        prop_assert_eq!(told.as_ref(), Some(&header));
        let mended = format!("{text}\n{header}\n");
        prop_assert_eq!(errors(&mended), [], "{}", mended);
        prop_assert_eq!(&read(&mended).scene.materials[0].name, &name);
        let own = advised(&help, "of its own: `", "`").unwrap();
        let mended = replaced(&text, &found[0], &own);
        prop_assert_eq!(errors(&mended), [], "{}", mended);
    }

    #[test]
    fn the_nearest_material_can_be_written_as_advised(name in name(), other in "[a-z]") {
        let mut scene = scene_with(&format!("{name}{other}"));
        scene.materials.push(NamedMaterial { name: name.clone(), material: Material::default() });
        let text = write(&scene);
        let found = errors(&text);
        prop_assert_eq!(found.len(), 1, "{:?}", found);
        let label = found[0].label(Language::English).unwrap();
        if let Some(value) = label.strip_prefix("did you mean `") {
            let value = value.strip_suffix("`?").unwrap();
            let russian = found[0].label(Language::Russian).unwrap();
            prop_assert_eq!(russian, format!("возможно, `{value}`?"));
            let mended = replaced(&text, &found[0], value);
            prop_assert_eq!(errors(&mended), [], "{}", mended);
        }
    }

    #[test]
    fn a_header_can_be_written_as_advised(name in name()) {
        let key = write(&Scene {
            materials: vec![NamedMaterial { name: name.clone(), material: Material::default() }],
            ..Scene::default()
        });
        let header = key.lines().find(|line| line.starts_with("[materials.")).unwrap();
        let text = format!("format = \"catoptric/1\"\n[{header}]\n");
        let finding = errors(&text).into_iter().find(|finding| finding.message(Language::English).ends_with("is not a list")).unwrap();
        let advice = finding.help(Language::English).unwrap();
        let advice = advice.strip_prefix("write `").unwrap().strip_suffix('`').unwrap();
        let mended = text.replace(&format!("[{header}]"), advice);
        prop_assert!(!read(&mended).diagnostics.has_errors(), "{}", mended);
        prop_assert_eq!(&read(&mended).scene.materials[0].name, &name);
    }

    #[test]
    fn findings_do_nothing_to_a_terminal(name in name(), other in name()) {
        let text = format!("format = \"catoptric/1\"\n{name} = 1\n[materials.{other}]\n[[bodies]]\nmaterial = \"{name}\" # {other}\n");
        for text in [text, write(&scene_with(&name)).replace("material =", &format!("{other} ="))] {
            let reading = read(&text);
            let rendered = reading.diagnostics.render(&name, &text, false);
            let is_harmless = |text: &str| !text.contains(|active| is_active(active) && active != '\n');
            prop_assert!(is_harmless(&rendered), "{:?}", rendered);
            prop_assert!(is_harmless(&reading.diagnostics.to_string()));
            // Colors are the only commands of a colored one.
            let colored = reading.diagnostics.render(&name, &text, true);
            let rest: Vec<&str> = colored.split("\u{1b}[").map(|part| part.trim_start_matches(|digit: char| digit.is_ascii_digit() || digit == ';')).collect();
            prop_assert!(rest.iter().skip(1).all(|part| part.starts_with('m')) && rest.iter().all(|part| is_harmless(part)));
        }
    }
}

/// Choices and keys are replaced at their mark.
#[test]
fn a_misspelled_word_can_be_replaced_as_advised() {
    for text in [
        "format = \"catoptric/1\"\n[[lights]]\nfalloff = \"liner\"\n",
        "format = \"catoptric/1\"\n[[lights]]\n[[bodies]]\nshape = \"cyllinder\"\n",
        "format = \"catoptric/1\"\n[[lights]]\n[[bodies]]\nradus = 2.0\n",
        "format = \"catoptric/1\"\n[[lights]]\n[camera]\n\"posi\\u0074in\" = [0, 1, 7]\n",
        "fromat = \"catoptric/1\"\n[[lights]]\n",
    ] {
        let found = errors(text);
        let label = found[0].label(Language::English).unwrap_or_default();
        let advice = advised(&label, "did you mean `", "`?").unwrap_or_else(|| panic!("{found:?}"));
        let mended = replaced(text, &found[0], &advice);
        assert_eq!(errors(&mended), [], "{mended}");
    }
}

#[test]
fn decimal_commas_can_be_replaced_as_advised() {
    let advice = |finding: &Diagnostic| {
        let help = finding.help(Language::English).unwrap_or_default();
        help.strip_prefix("a decimal number is written with a point: ")
            .map(|rest| rest.trim_matches('`').to_owned())
    };
    for (line, right) in [
        ("position = [0,5, 1,0, 2,25]", "[0.5, 1.0, 2.25]"),
        ("position = [0,5,1,0,2,25]", "[0.5, 1.0, 2.25]"),
        ("position = [-0,5, 1, 2]", "[-0.5, 1, 2]"),
        ("scale = [1, 1, 0,5]", "[1, 1, 0.5]"),
        ("material = { color = [0,8, 0,7, 0,6] }", "[0.8, 0.7, 0.6]"),
    ] {
        let text = format!("format = \"catoptric/1\"\n[[lights]]\n[[bodies]]\n{line}\n");
        let found = errors(&text);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(advice(&found[0]).as_deref(), Some(right), "{found:?}");
        let mended = replaced(&text, &found[0], right);
        assert_eq!(errors(&mended), [], "{mended}");
    }
    for (line, right) in [
        ("radius = 1,5", "1.5"),
        ("position = [0,05, 1, 2]", "0.05"),
        ("position = [0, 1,05, 2]", "1.05"),
        ("material = { reflection = 0,25 }", "0.25"),
        ("material = { reflection = 0,25, specular = 0.5 }", "0.25"),
    ] {
        let text = format!("format = \"catoptric/1\"\n[[lights]]\n[[bodies]]\n{line}\n");
        let found = errors(&text);
        assert_eq!(found.iter().find_map(advice).as_deref(), Some(right), "{line}: {found:?}");
        let comma = right.replace('.', ",");
        assert_eq!(errors(&text.replace(&comma, right)), [], "{line}");
    }
}
