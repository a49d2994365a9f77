//! Pictures of another ray tracer, checked, as one page: the verdict, where the rest lies, the audits of its worst pixels.

use std::fmt::Write as _;

use catoptric_picture::{Development, Picture};
use catoptric_scene::Scene;

use super::verdict::Verdict;
use crate::report::html::{escape, table};
use crate::report::page::{data_uri, frame};
use crate::report::texts::fill;
use crate::report::{Language, PageError};

/// A picture that was checked.
#[derive(Clone, Debug)]
pub struct CheckedPicture {
    /// What it is called.
    pub name: String,
    /// As it was read, and how it is shown.
    pub picture: (Picture, Development),
    /// The exact one, and how it is shown.
    pub exact: (Picture, Development),
    /// The scene that it was held against, which may depend on its size.
    pub scene: Scene,
    /// What was found.
    pub verdict: Verdict,
    /// The audits of the worst pixels of the first places where it differs, as text.
    pub audits: Vec<String>,
}

/// Makes the page of pictures that were checked against a scene of this name, as [`page`](crate::report::page()) makes its own;
/// `allowed` is the share of pixels that may differ.
///
/// # Errors
/// When there is too little memory.
pub fn checked_page(
    scene: &str,
    pictures: &[CheckedPicture],
    allowed: f64,
    language: Language,
) -> Result<String, PageError> {
    let title = fill(language.checked_title(), &[("scene", scene)]);
    let mut html = frame::head(language, &title);
    let _ = write!(
        html,
        "<h1>{}</h1>\n<p class=\"lead\">{}</p>\n",
        escape(&title),
        escape(language.checked_lead())
    );
    for picture in pictures {
        picture.section(&mut html, allowed, language)?;
    }
    html.push_str(&frame::end());
    Ok(html)
}

impl CheckedPicture {
    fn section(&self, html: &mut String, allowed: f64, language: Language) -> Result<(), PageError> {
        let is_right = self.verdict.is_right(allowed);
        let word = if is_right { language.checked_right() } else { language.checked_different() };
        let _ = write!(
            html,
            "<section class=\"pair\">\n<h2>{}: {}</h2>\n<p class=\"lead\">{}</p>\n<div class=\"maps\">\n",
            escape(&self.name),
            escape(word),
            escape(&self.verdict.sentence(&self.scene, language))
        );
        let clusters = if is_right { &[][..] } else { &self.verdict.clusters };
        let marks = |place: &dyn Fn(usize) -> Option<[u32; 2]>| {
            (0..clusters.len()).filter_map(place).collect::<Vec<[u32; 2]>>()
        };
        let stored = marks(&|index| clusters.get(index).map(|cluster| cluster.worst.stored));
        let upright = marks(&|index| clusters.get(index).map(|cluster| cluster.worst.pixel));
        figure(html, &self.picture, &stored, &self.name)?;
        figure(html, &self.exact, &upright, language.checked_exact())?;
        html.push_str("</div>\n");
        if let Some(simplest) = self.verdict.simplest.filter(|_| !is_right) {
            let _ = writeln!(html, "<p>{}</p>", escape(&simplest.in_words(&self.scene, language)));
        }
        if !clusters.is_empty() {
            self.places(html, language);
        }
        for (number, audit) in (1..).zip(&self.audits) {
            let number = number.to_string();
            let title = fill(language.checked_audit(), &[("number", &number)]);
            let _ = writeln!(html, "<h3>{}</h3>\n<pre>{}</pre>", escape(&title), lines(audit));
        }
        html.push_str("</section>\n");
        Ok(())
    }

    /// The table of places where the picture differs still.
    fn places(&self, html: &mut String, language: Language) {
        let heads = [
            language.checked_place(),
            language.checked_share(),
            language.checked_pixel(),
            language.checked_found(),
            language.checked_expected(),
        ];
        let codes = |codes: [u8; 3]| codes.map(|code| code.to_string()).join(", ");
        let rows: Vec<Vec<String>> = (1..)
            .zip(&self.verdict.clusters)
            .map(|(number, cluster): (u32, _)| {
                let [x, y] = cluster.worst.stored;
                vec![
                    format!("{number}. {}", cluster.place(&self.scene, language)),
                    cluster.share_in_words(language),
                    format!("{x}, {y}"),
                    codes(cluster.worst.found),
                    codes(cluster.worst.expected),
                ]
            })
            .collect();
        let heads = heads.map(str::to_owned);
        let table = table(language.checked_places_caption(), &heads, &rows);
        let _ = writeln!(html, "<div class=\"wide\">{table}</div>");
    }
}

/// A picture with its numbered places.
fn figure(
    html: &mut String,
    (picture, development): &(Picture, Development),
    marks: &[[u32; 2]],
    caption: &str,
) -> Result<(), PageError> {
    let [width, height] = [picture.width(), picture.height()];
    let data = data_uri(picture, development)?;
    let caption = escape(caption);
    let _ = write!(
        html,
        "<figure><svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{caption}\"><image width=\"{width}\" \
         height=\"{height}\" style=\"image-rendering:pixelated\" href=\"{data}\"/>"
    );
    let size = f64::from(width.max(height)) / 40.0;
    for (number, [x, y]) in (1..).zip(marks) {
        let [x, y] = [x, y].map(|place| f64::from(*place) + 0.5);
        // Inside of the picture on whichever side there is room.
        let shift = if x + 3.0 * size > f64::from(width) { -1.6 * size } else { 1.6 * size };
        let _ = write!(
            html,
            "<g class=\"mark\" stroke-width=\"{stroke:.3}\"><circle cx=\"{x}\" cy=\"{y}\" r=\"{size:.3}\"/><text \
             x=\"{:.3}\" y=\"{:.3}\" font-size=\"{:.3}\">{number}</text></g>",
            x + shift,
            (y + 0.5 * size).clamp(1.3 * size, f64::from(height)),
            1.6 * size,
            stroke = size / 6.0
        );
    }
    let _ = writeln!(html, "</svg><figcaption>{caption}</figcaption></figure>");
    Ok(())
}

/// Text of several lines.
fn lines(text: &str) -> String {
    text.trim_end().lines().map(escape).collect::<Vec<_>>().join("\n")
}
