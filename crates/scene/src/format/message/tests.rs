use std::collections::BTreeSet;

use super::phrase::Phrase as _;
use super::syntax::{RUSSIAN, SyntaxFault};
use super::*;
use crate::format::keys;
use crate::format::spec::{Kind, Limits};
use crate::language::Language;
use crate::{Diagnostics, Image, ImageError, ImageFault, ImageSource, Scene, UnreadableKind, read};

/// The names between braces; `{{` and `}}` are braces themselves.
fn arguments(sentence: &str) -> BTreeSet<String> {
    let plain = sentence.replace("{{", "").replace("}}", "");
    let parts = plain.split('{').skip(1);
    parts.filter_map(|part| part.split('}').next()).map(str::to_owned).collect()
}

/// A text without what stands between two of the same quotes.
fn outside(text: &str, quote: char) -> String {
    text.split(quote).step_by(2).collect::<Vec<_>>().join(" ")
}

/// Latin words in a Russian text, but for those between backquotes or quotes, arguments, numbers and names of formats.
fn latin_words(text: &str) -> Vec<String> {
    let plain = outside(&outside(&text.replace("\\\"", "\""), '`'), '"');
    let plain =
        arguments(&plain).iter().fold(plain, |plain, name| plain.replace(&format!("{{{name}}}"), " "));
    let words = plain.split(|character: char| !character.is_alphanumeric());
    let known = ["UTF", "TOML", "sRGB", "PNG"];
    words
        .filter(|word| word.chars().any(|letter| letter.is_ascii_alphabetic()))
        .filter(|word| word.len() > 1 && !word.contains(|digit: char| digit.is_ascii_digit()))
        .filter(|word| !known.contains(word))
        .map(str::to_owned)
        .collect()
}

#[test]
fn latin_words_are_found() {
    assert_eq!(latin_words("ключ `fov` is \"a\" {name} 1e-9 в UTF-8, x"), ["is"]);
}

#[test]
fn both_sentences_of_a_message_have_the_same_arguments() {
    assert!(Message::SENTENCES.len() > 100);
    for [name, english, russian] in Message::SENTENCES {
        assert_eq!(arguments(english), arguments(russian), "{name}");
        assert_eq!(english.ends_with('?'), russian.ends_with('?'), "{name}");
        assert_eq!(russian.matches('`').count() % 2, 0, "{name}");
    }
}

#[test]
fn russian_sentences_are_russian() {
    for [name, english, russian] in Message::SENTENCES {
        assert_eq!(latin_words(russian), Vec::<String>::new(), "{name}: {russian}");
        let has_words = outside(english, '`').contains(|letter: char| letter.is_ascii_alphabetic());
        assert!(!has_words || english == russian || russian.contains(is_cyrillic), "{name}: {russian}");
    }
    for (english, russian) in RUSSIAN {
        assert_eq!(latin_words(russian), Vec::<String>::new(), "{english}");
    }
}

fn is_cyrillic(letter: char) -> bool {
    matches!(letter, 'а'..='я' | 'А'..='Я' | 'ё')
}

#[test]
fn what_the_library_adds_is_told_as_it_is() {
    let said = |text: &str| {
        let error = toml_parser::ParseError::new(text.to_owned());
        SyntaxFault::from(&error).phrase(Language::Russian).into_owned()
    };
    assert_eq!(said("extra `=`"), "лишний знак `=`");
    assert_eq!(said("something new"), "синтаксис TOML: something new");
}

#[test]
fn counts_have_their_plural_form() {
    let said = |count| FoundValue::ListOf(count).phrase(Language::Russian).into_owned();
    assert_eq!(said(0), "список из 0 значений");
    assert_eq!(said(1), "список из одного значения");
    assert_eq!(said(2), "список из 2 значений");
    assert_eq!(said(11), "список из 11 значений");
    assert_eq!(said(21), "список из 21 значения");
    assert_eq!(said(5001), "список из 5001 значения");
    assert_eq!(said(111), "список из 111 значений");
}

#[test]
fn numbers_have_the_decimal_sign_of_the_language() {
    let fov = keys::CAMERA.key("fov").unwrap();
    let message = Message::OutOfRange {
        subject: Subject::key("fov"),
        value: FoundValue::Written("`300.5`".to_owned()),
        requirement: fov.limits().unwrap().requirement(300.5),
    };
    assert_eq!(message.text(Language::English), "`fov` is `300.5`, but must be at most 179.9");
    assert_eq!(message.text(Language::Russian), "`fov` равно `300.5`, а должно быть не больше 179,9");
    let help = Message::KeyMeans { meaning: KeyMeaning { key: fov, has_range: true } };
    assert_eq!(help.text(Language::English), "`fov` is the vertical angle of view, degrees (0.001 to 179.9)");
    assert_eq!(help.text(Language::Russian), "`fov` — вертикальный угол обзора, градусы (от 0,001 до 179,9)");
}

#[test]
fn every_kind_and_requirement_has_russian_words() {
    let spec = &keys::BODY;
    let limits = Limits::LENGTH;
    let kinds = [
        Kind::Version(keys::VERSIONS),
        Kind::Text,
        Kind::File,
        Kind::Choice(&["a", "b"]),
        Kind::Number(limits),
        Kind::Integer(limits),
        Kind::Vector(limits),
        Kind::NumberOrVector(limits),
        Kind::Color(limits),
        Kind::Table(spec),
        Kind::NameOrTable(spec),
        Kind::Named(spec),
        Kind::List(spec),
        Kind::Flag,
    ];
    for kind in kinds {
        assert_eq!(latin_words(&kind.phrase(Language::Russian)), Vec::<String>::new(), "{kind:?}");
    }
    for value in [f64::NAN, -1.0, 0.0, 1e-12, 1e12] {
        let requirement = limits.requirement(value);
        assert_eq!(latin_words(&requirement.phrase(Language::Russian)), Vec::<String>::new());
    }
}

fn unreadable(kind: UnreadableKind) -> ImageFault {
    ImageFault::Unreadable { reason: "it cannot be read".to_owned(), kind }
}

#[test]
fn pictures_that_cannot_be_opened_are_told_in_russian() {
    let faults = [
        ImageFault::NotBuiltIn,
        ImageFault::BuiltInLayer,
        ImageFault::Missing("/a/b.png".into()),
        ImageFault::NotAFile,
        ImageFault::TooLarge { width: 9000, height: 9000 },
        unreadable(UnreadableKind::Empty),
        unreadable(UnreadableKind::UnknownFormat),
        unreadable(UnreadableKind::Damaged),
        unreadable(UnreadableKind::ManyLayers { layers: vec!["diffuse".to_owned()] }),
        unreadable(UnreadableKind::NoSuchLayer { layers: Vec::new() }),
        unreadable(UnreadableKind::NoSuchLayer { layers: vec!["diffuse".to_owned()] }),
    ];
    for fault in faults {
        let error = ImageError { image: ImageSource::new("b.png", None), fault };
        let message = Message::NoImage { error: error.clone() };
        assert_eq!(message.text(Language::English), error.to_string());
        let russian = message.text(Language::Russian);
        assert!(russian.starts_with("картинка `b.png` не открывается: "), "{russian}");
        assert_eq!(latin_words(&russian), Vec::<String>::new(), "{russian}");
    }
}

#[test]
fn a_whole_finding_is_told_in_russian() {
    let text = "format = 'catoptric/1'\n[[bodies]]\nradus = 1\nsize = [1, 2]\nshape = 'cube'\n";
    let said = |diagnostics: &Diagnostics| {
        let lines = diagnostics.iter().map(|finding| finding.line_of_text(Language::Russian));
        lines.collect::<Vec<_>>().join("\n")
    };
    let found = read(text).diagnostics;
    assert_eq!(
        said(&found),
        "3:1: ошибка: у тела нет ключа `radus`\n\
         4:8: ошибка: `size` — список из 2 значений, а ожидается число или три числа"
    );
    let first = found.iter().next().unwrap();
    assert_eq!(first.label(Language::Russian).as_deref(), Some("возможно, `radius`?"));
    let help = first.help(Language::Russian).unwrap();
    assert!(
        help.starts_with("ключи тела: `name`, ")
            && help.ends_with(" `hidden`, `shadow`, `contact`, `locked` и `parts`"),
        "{help}"
    );
}

#[test]
fn problems_of_a_scene_are_told_in_russian() {
    let mut scene = Scene::default();
    scene.camera.target = scene.camera.position;
    scene.tracing.threshold = 1.5;
    scene.environment.ambient.g = -0.5;
    let body = |name: &str| crate::Body { name: name.to_owned(), ..crate::Body::default() };
    scene.bodies = [
        body("шар"),
        body("шар"),
        crate::Body { material: crate::MaterialChoice::Named("glass".to_owned()), ..body("") },
    ]
    .into();
    scene.environment.surroundings = crate::Surroundings::Picture(Image::new(""));
    let said: Vec<String> = scene.check().iter().map(|problem| problem.message(Language::Russian)).collect();
    assert_eq!(
        said,
        [
            "камера: `target` и `position` камеры — одна и та же точка",
            "окружение: второе значение в `ambient` равно -0,5, а должно быть не меньше 0",
            "окружение: `picture` — пустой текст, а ожидается путь к картинке",
            "трассировка: `threshold` равно 1,5, а должно быть не больше 1",
            "имя `шар` носят два тела: номера 1 и 2",
            "тело 3: материал `glass` не определён",
        ]
    );
}
