//! The front page as HTML, one file a language. It has no scripts, and asks no other host for anything.

use catoptric_scene::{Example, Language};

use super::images::{CARD, FIRST, FIRST_SCENE};
use super::words::PageWords;

/// The style of both pages.
pub(super) const STYLE: (&str, &str) = ("gallery.css", include_str!("gallery.css"));

/// A card tells two sentences at most, and one if both together have more letters than this.
const LETTERS: usize = 230;

/// The file's name and the page in a language.
pub(super) fn page(language: Language) -> (&'static str, String) {
    let words = PageWords::of(language);
    let other = PageWords::of(match language {
        Language::English => Language::Russian,
        Language::Russian => Language::English,
    });
    let points = words.points.map(|[head, text]| format!("<li><b>{}</b> {}</li>\n", html(head), html(text)));
    let cards: String = Example::ALL.iter().map(|example| card(example, language)).collect();
    let first =
        Example::find(FIRST_SCENE).map(|example| (title(example, language), example.notice(language)));
    let (first_title, first_notice) = first.unwrap_or_default();
    let text = format!(
        include_str!("page.html"),
        page = words.file,
        language = words.code,
        other_language = other.code,
        other_page = other.file,
        other_name = other.own_name,
        heading = html(words.heading),
        lead = html(words.lead),
        open = html(words.open),
        look = html(words.look),
        note = html(words.note),
        check = html(words.check),
        first_name = FIRST_SCENE,
        first_title = html(first_title),
        first_alt = html(beginning(&first_notice)),
        first_width = FIRST.size.0,
        first_height = FIRST.size.1,
        points = points.concat(),
        scenes = html(words.scenes),
        scenes_below = html(words.scenes_below),
        cards = cards,
        manual = html(words.manual),
        license = html(words.license),
        version = env!("CARGO_PKG_VERSION"),
    );
    (words.file, text)
}

fn card(example: &Example, language: Language) -> String {
    let title = title(example, language);
    let [before, after] = PageWords::of(language).picture;
    format!(
        include_str!("card.html"),
        name = example.name,
        language = PageWords::of(language).code,
        width = CARD.size.0,
        height = CARD.size.1,
        alt = html(&format!("{before}{title}{after}")),
        title = html(title),
        notice = with_indices(&html(beginning(&example.notice(language)))),
    )
}

fn title(example: &Example, language: Language) -> &'static str {
    match language {
        Language::English => example.title(),
        Language::Russian => example.russian_title(),
    }
}

/// The built-in scenes by their names, with their titles, for scripts of other pages.
pub(super) fn examples_script() -> String {
    let titles = Example::ALL.iter().map(|example| {
        let titles = serde_json::json!({ "en": example.title(), "ru": example.russian_title() });
        (example.name.to_owned(), titles)
    });
    format!("export const examples = {};\n", serde_json::Value::Object(titles.collect()))
}

/// The first sentence of a text, and the second if both are short.
fn beginning(text: &str) -> &str {
    let is_end = |&(index, _): &(usize, &str)| {
        text[index + 2..].starts_with(|letter: char| letter.is_uppercase() || letter.is_numeric())
    };
    let ends = text.match_indices(". ").filter(is_end).map(|(index, _)| &text[..=index]);
    let mut sentences = ends.chain([text]).take(2);
    let first = sentences.next().unwrap_or(text);
    sentences.next().filter(|both| both.chars().count() <= LETTERS).unwrap_or(first)
}

/// Text as HTML: characters that mean something there are escaped, and no line begins with a dash.
fn html(text: &str) -> String {
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    escaped.replace(" —", "\u{a0}—")
}

/// The letter after each `_` as an index: `k_r`.
fn with_indices(html: &str) -> String {
    let mut parts = html.split('_');
    let mut shown = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.chars().next().map_or(0, char::len_utf8);
        shown += &format!("<sub>{}</sub>{}", &part[..end], &part[end..]);
    }
    shown
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// The values of all attributes of this name.
    fn values<'a>(html: &'a str, attribute: &str) -> Vec<&'a str> {
        let start = format!(" {attribute}=\"");
        html.split(&start).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
    }

    #[test]
    fn all_scenes_stand_in_both_languages() {
        for language in Language::ALL {
            let (file, text) = page(language);
            for example in Example::ALL {
                let link = format!(
                    "<a href=\"studio.html?lang={}#example={}\">{}</a>",
                    PageWords::of(language).code,
                    example.name,
                    title(example, language)
                );
                assert_eq!(text.matches(&link).count(), 1, "{file}: {link}");
                let notice = with_indices(&html(beginning(&example.notice(language))));
                assert!(text.contains(&notice), "{file}: {notice}");
            }
        }
    }

    #[test]
    fn links_lead_to_what_is_there() {
        let always = ["index.html", "ru.html", "gallery.css", "icon.png", "pictures/first.jpg", "#scenes"]
            .map(str::to_owned);
        for language in Language::ALL {
            let (file, text) = page(language);
            let studio = format!("studio.html?lang={}", PageWords::of(language).code);
            let mut known = BTreeSet::from(always.clone());
            for example in Example::ALL {
                known.insert(format!("{studio}#example={}", example.name));
                known.insert(format!("pictures/{}.jpg", example.name));
            }
            known.insert(studio);
            known.insert(format!("check.html?lang={}", PageWords::of(language).code));
            let links: BTreeSet<String> =
                ["href", "src"].iter().flat_map(|name| values(&text, name)).map(str::to_owned).collect();
            assert_eq!(links, known, "{file}");
        }
    }

    #[test]
    fn nothing_is_asked_of_other_hosts_and_nothing_is_run() {
        for (file, text) in Language::ALL.map(page).into_iter().chain([(STYLE.0, STYLE.1.to_owned())]) {
            for part in
                ["http:", "https:", "//", "url(", "@import", "<script", " style=", " onload=", " onclick="]
            {
                assert!(!text.contains(part), "{file} contains {part}");
            }
            // What notices have that is not text.
            assert!(!text.contains(['`', '_']), "{file}");
        }
    }

    #[test]
    fn pictures_have_sizes_and_descriptions() {
        for language in Language::ALL {
            let (file, text) = page(language);
            let pictures: Vec<&str> =
                text.split("<img ").skip(1).map(|rest| rest.split('>').next().unwrap()).collect();
            assert_eq!(pictures.len(), Example::ALL.len() + 2, "{file}");
            for picture in pictures {
                let picture = format!(" {picture}");
                for name in ["width", "height", "alt"] {
                    assert_eq!(values(&picture, name).len(), 1, "{file}: {name}: {picture}");
                }
                let is_described = values(&picture, "alt")[0].len() > 10;
                assert!(is_described || picture.contains("icon.png"), "{file}: {picture}");
            }
        }
    }

    #[test]
    fn a_text_begins_with_whole_sentences() {
        assert_eq!(beginning("One. Two. Three."), "One. Two.");
        assert_eq!(beginning("It is 1.5 m. 9 more, cf. below. Three."), "It is 1.5 m. 9 more, cf. below.");
        assert_eq!(beginning("Only one"), "Only one");
        let long = format!("Short. L{}ng. Three.", "o".repeat(LETTERS));
        assert_eq!(beginning(&long), "Short.");
    }

    #[test]
    fn text_becomes_html() {
        assert_eq!(html("a < b & \"c\" > d — e"), "a &lt; b &amp; &quot;c&quot; &gt; d\u{a0}— e");
        assert_eq!(with_indices("k_r = 0.2, k_t_"), "k<sub>r</sub> = 0.2, k<sub>t</sub><sub></sub>");
    }
}
