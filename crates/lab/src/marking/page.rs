//! The marks of a class as one page: points of all, and each picture beside the exact one with its cause and worst pixel.

use std::fmt::Write as _;
use std::sync::Arc;

use base64::Engine as _;

use super::evidence::{Evidence, ShownPicture, WorstPlace};
use super::marks::{ClassMarks, PictureMark, StudentMarks, SubmissionCheck, SubmissionOutcome};
use crate::report::Language;
use crate::report::html::{escape, table};
use crate::report::page::frame;

/// What this page looks like besides.
const STYLE: &str = "
.totals td a { color: inherit; text-decoration: none; display: block; }
.totals td.lost, .points.lost { color: #b3261e; }
.totals td.none { color: var(--soft); }
.totals tfoot th, .totals tfoot td { border-top: 2px solid var(--ink); border-bottom: 0; font-weight: 600; }
.totals th button { all: unset; cursor: pointer; }
.totals th button:focus-visible { outline: 2px solid #0072b2; outline-offset: 2px; }
.totals th[aria-sort=ascending] button::after { content: ' ▲'; font-size: .7em; }
.totals th[aria-sort=descending] button::after { content: ' ▼'; font-size: .7em; }
.student h2, .student h3 { display: flex; gap: 1rem; justify-content: space-between; overflow-wrap: anywhere; }
.points { white-space: nowrap; font-weight: 500; }
.shown { display: grid; grid-template-columns: repeat(4, minmax(0, 1fr)); gap: 1rem; align-items: start; }
.cause { margin: .6rem 0 .2rem; max-width: 46rem; }
.costs { margin: .2rem 0; padding-left: 1.2rem; }
.places { margin: .3rem 0 0; padding-left: 1.2rem; color: var(--soft); font-size: .85rem; }
.detail rect { fill: none; stroke: #ff2d8a; stroke-width: .12; }
@media (max-width: 40rem) { .shown { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
@media (prefers-color-scheme: dark) { .totals td.lost, .points.lost { color: #ff8a80; } }
";

/// Sorts the table of points by the head that is pressed.
const SCRIPT: &str = "
for (const table of document.querySelectorAll('.totals table')) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  heads.forEach((head, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener('click', () => {
      const order = head.getAttribute('aria-sort') === 'descending' ? 1 : -1;
      heads.forEach(other => other.removeAttribute('aria-sort'));
      head.setAttribute('aria-sort', order === 1 ? 'ascending' : 'descending');
      const value = row => row.cells[column].dataset.value;
      const compare = (a, b) => column === 0
        ? value(b).localeCompare(value(a), undefined, { numeric: true }) : value(a) - value(b);
      body.append(...[...body.rows].sort((a, b) => order * compare(a, b)));
    });
  });
}
";

/// Makes the page of a class; `left_over` are pictures that nobody gets points for. It is well-formed XML, needs no network, and
/// without scripts only the table is not sorted.
pub fn class_page(class: &ClassMarks, left_over: &[String], language: Language) -> String {
    let title = language.marking_title();
    let page = ClassPage { class, language, exact: exact_pictures(class) };
    let mut html = frame::head_with(language, title, STYLE);
    page.definitions(&mut html);
    let lead = escape(language.marking_lead());
    let _ = write!(html, "<h1>{}</h1>\n<p class=\"lead\">{lead}</p>\n", escape(title));
    page.totals(&mut html);
    page.frequencies(&mut html);
    if !left_over.is_empty() {
        let names: Vec<String> = left_over.iter().map(|path| escape(path)).collect();
        let words = escape(language.marking_left_over());
        let _ = writeln!(html, "<p class=\"note\">{words}: {}</p>", names.join(", "));
    }
    for (place, student) in class.students.iter().enumerate() {
        page.student(&mut html, place, student);
    }
    html.push_str(&frame::end_with(SCRIPT));
    html
}

/// Each exact picture once.
fn exact_pictures(class: &ClassMarks) -> Vec<&Arc<ShownPicture>> {
    let mut all: Vec<&Arc<ShownPicture>> = Vec::new();
    for check in class.marks().filter_map(|mark| mark.outcome.check()) {
        if !check.is_right && !all.iter().any(|own| Arc::ptr_eq(own, &check.evidence.exact)) {
            all.push(&check.evidence.exact);
        }
    }
    all
}

/// The page while it is written.
struct ClassPage<'a> {
    class: &'a ClassMarks,
    language: Language,
    /// The exact pictures, which the page uses by their places.
    exact: Vec<&'a Arc<ShownPicture>>,
}

impl ClassPage<'_> {
    fn definitions(&self, html: &mut String) {
        html.push_str("<svg width=\"0\" height=\"0\" class=\"definitions\" aria-hidden=\"true\"><defs>\n");
        for (place, shown) in self.exact.iter().enumerate() {
            let _ = writeln!(html, "{}", image(shown, &format!(" id=\"e{place}\"")));
        }
        html.push_str("</defs></svg>\n");
    }

    /// The points of all students.
    fn totals(&self, html: &mut String) {
        let language = self.language;
        let _ = write!(
            html,
            "<div class=\"wide totals\"><table>\n<caption>{}</caption>\n<thead><tr><th scope=\"col\">{}</th>",
            escape(language.marking_totals_caption()),
            escape(language.marking_student())
        );
        for scene in &self.class.scenes {
            let _ = write!(html, "<th scope=\"col\">{}</th>", escape(scene));
        }
        let _ = write!(
            html,
            "<th scope=\"col\">{}</th></tr></thead>\n<tbody>\n",
            escape(language.marking_total())
        );
        for (place, student) in self.class.students.iter().enumerate() {
            self.totals_row(html, place, student);
        }
        html.push_str("</tbody>\n");
        self.means(html);
        html.push_str("</table></div>\n");
    }

    fn totals_row(&self, html: &mut String, place: usize, student: &StudentMarks) {
        let name = escape(&student.student);
        let _ =
            write!(html, "<tr><th scope=\"row\" data-value=\"{name}\"><a href=\"#s{place}\">{name}</a></th>");
        for scene in &self.class.scenes {
            let at = student.pictures.iter().position(|mark| mark.submission.scene == *scene);
            match at.and_then(|at| Some((at, student.pictures.get(at)?))) {
                Some((at, mark)) if !matches!(mark.outcome, SubmissionOutcome::Unmarked(_)) => {
                    let lost = if mark.points < mark.worth { " class=\"lost\"" } else { "" };
                    let points = mark.points;
                    let shown = self.language.decimal(points);
                    let _ = write!(
                        html,
                        "<td{lost} data-value=\"{points}\"><a href=\"#s{place}p{at}\">{shown}</a></td>"
                    );
                }
                _ => html.push_str("<td class=\"none\" data-value=\"-1\">–</td>"),
            }
        }
        let points = student.points();
        let shown = self.language.decimal(points);
        let of = self.language.marking_of().replace("{of}", &self.language.decimal(student.worth()));
        let _ = writeln!(html, "<td data-value=\"{points}\"><b>{shown}</b> {of}</td></tr>");
    }

    /// The means below the points.
    fn means(&self, html: &mut String) {
        let mean = |points: &[f64]| match points.len() {
            0 => "–".to_owned(),
            count => self.language.fixed(points.iter().sum::<f64>() / count as f64, 2),
        };
        let _ = write!(html, "<tfoot><tr><th scope=\"row\">{}</th>", escape(self.language.marking_mean()));
        for scene in &self.class.scenes {
            let marks = self.class.marks().filter(|mark| {
                mark.submission.scene == *scene && !matches!(mark.outcome, SubmissionOutcome::Unmarked(_))
            });
            let points: Vec<f64> = marks.map(|mark| mark.points).collect();
            let _ = write!(html, "<td>{}</td>", mean(&points));
        }
        let totals: Vec<f64> = self.class.students.iter().map(StudentMarks::points).collect();
        let _ = writeln!(html, "<td>{}</td></tr></tfoot>", mean(&totals));
    }

    /// How often each mistake was made.
    fn frequencies(&self, html: &mut String) {
        let frequencies = self.class.frequencies();
        if frequencies.is_empty() {
            return;
        }
        let language = self.language;
        let heads = [language.marking_mistake(), language.marking_pictures(), language.marking_students()];
        let rows: Vec<Vec<String>> = frequencies
            .into_iter()
            .map(|own| vec![own.words, own.pictures.to_string(), own.students.to_string()])
            .collect();
        let table = table(language.marking_frequencies_caption(), &heads.map(str::to_owned), &rows);
        let _ = writeln!(html, "<div class=\"wide reasons\">{table}</div>");
    }

    fn student(&self, html: &mut String, place: usize, student: &StudentMarks) {
        let _ = writeln!(
            html,
            "<section class=\"student\" id=\"s{place}\">\n<h2><span>{}</span> {}</h2>",
            escape(&student.student),
            self.points(student.points(), student.worth())
        );
        for (at, mark) in student.pictures.iter().enumerate() {
            let _ = writeln!(html, "<article id=\"s{place}p{at}\">");
            self.picture(html, &student.student, mark);
            html.push_str("</article>\n");
        }
        html.push_str("</section>\n");
    }

    fn points(&self, points: f64, worth: f64) -> String {
        let lost = if points < worth { " lost" } else { "" };
        let words = escape(&self.language.marking_points(points, worth));
        format!("<span class=\"points{lost}\">{words}</span>")
    }

    fn picture(&self, html: &mut String, student: &str, mark: &PictureMark) {
        let _ = writeln!(
            html,
            "<h3><span>{}</span> {}</h3>",
            escape(&mark.submission.scene),
            self.points(mark.points, mark.worth)
        );
        let said = |words: &str, reason: &str| {
            format!("<p class=\"cause\">{} {}</p>\n", escape(words), escape(reason))
        };
        match &mark.outcome {
            SubmissionOutcome::Checked(check) => self.check(html, student, mark, check),
            SubmissionOutcome::Missing => html.push_str(&said(self.language.marking_missing(), "")),
            SubmissionOutcome::Unreadable(reason) => {
                html.push_str(&said(self.language.marking_unreadable(), reason));
            }
            SubmissionOutcome::Unmarked(reason) => {
                html.push_str(&said(self.language.marking_unmarked(), reason));
            }
        }
    }

    fn check(&self, html: &mut String, student: &str, mark: &PictureMark, check: &SubmissionCheck) {
        let language = self.language;
        let evidence = &check.evidence;
        let file = mark.submission.picture.as_deref().unwrap_or(student);
        html.push_str("<div class=\"shown\">\n");
        let worst = evidence.worst.as_ref().filter(|_| !check.is_right);
        figure(html, &image(&evidence.picture, ""), evidence.picture.size, worst.map(|own| own.stored), file);
        if !check.is_right {
            self.exact(html, evidence, worst.map(|own| own.pixel));
        }
        if let Some(worst) = worst {
            self.details(html, worst);
        }
        let _ = writeln!(html, "</div>\n<p class=\"cause\">{}</p>", escape(&check.sentence));
        if !mark.deductions.is_empty() {
            html.push_str("<ul class=\"costs\">");
            for deduction in &mark.deductions {
                let again = if deduction.is_repeated { language.marking_again() } else { "" };
                let cost = language.marking_cost(deduction.points);
                let words = escape(&format!("{cost}: {} {again}", deduction.words));
                let _ = write!(html, "<li>{}</li>", words.trim_end());
            }
            html.push_str("</ul>\n");
        }
        if !check.places.is_empty() {
            let places: String =
                check.places.iter().map(|line| format!("<li>{}</li>", escape(line))).collect();
            let _ = writeln!(html, "<ul class=\"places\">{places}</ul>");
        }
    }

    fn exact(&self, html: &mut String, evidence: &Evidence, mark: Option<[u32; 2]>) {
        let place = self.exact.iter().position(|own| Arc::ptr_eq(own, &evidence.exact)).unwrap_or(0);
        let used = format!("<use href=\"#e{place}\"/>");
        figure(html, &used, evidence.exact.size, mark, self.language.checked_exact());
    }

    /// The neighborhoods of the worst pixel.
    fn details(&self, html: &mut String, worst: &WorstPlace) {
        let language = self.language;
        let [x, y] = worst.stored;
        let codes = |codes: [u8; 3]| codes.map(|code| code.to_string()).join(", ");
        let captions = [
            format!("{} {x}, {y}: {}", language.checked_pixel(), codes(worst.found)),
            format!("{}: {}", language.checked_exact(), codes(worst.exact)),
        ];
        for (detail, caption) in worst.details.iter().zip(captions) {
            let [width, height] = detail.size;
            let [x, y] = worst.middle;
            let caption = escape(&caption);
            let _ = writeln!(
                html,
                "<figure class=\"detail\"><svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{caption}\">{}<rect \
                 x=\"{x}\" y=\"{y}\" width=\"1\" height=\"1\"/></svg><figcaption>{caption}</figcaption></figure>",
                image(detail, "")
            );
        }
    }
}

/// A picture as an element of a drawing, in its own pixels.
fn image(shown: &ShownPicture, attributes: &str) -> String {
    let [width, height] = shown.size;
    let data = base64::engine::general_purpose::STANDARD.encode(&shown.png);
    format!(
        "<image{attributes} width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
         style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{data}\"/>"
    )
}

/// A picture with a circle around a pixel.
fn figure(html: &mut String, image: &str, [width, height]: [u32; 2], mark: Option<[u32; 2]>, caption: &str) {
    let caption = escape(caption);
    let _ = write!(
        html,
        "<figure><svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{caption}\">{image}"
    );
    if let Some([x, y]) = mark {
        let radius = f64::from(width.max(height)) / 24.0;
        let [x, y] = [x, y].map(|place| f64::from(place) + 0.5);
        let _ = write!(
            html,
            "<g class=\"mark\" stroke-width=\"{:.3}\"><circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.3}\"/></g>",
            radius / 5.0
        );
    }
    let _ = writeln!(html, "</svg><figcaption>{caption}</figcaption></figure>");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marking::Rubric;
    use crate::marking::marks::tests::{checked, submission};

    #[test]
    fn the_page_is_well_formed_whatever_names_hold() {
        let pictures = [
            (submission("<script>alert(1)</script>", "\"a\"&b"), checked(&["no-shadows"], 0.1)),
            (submission("<script>alert(1)</script>", "right"), checked(&[], 0.0)),
            (submission("\u{202e}]]>\u{1}", "\"a\"&b"), SubmissionOutcome::Missing),
            (submission("\u{202e}]]>\u{1}", "right"), SubmissionOutcome::Unreadable("<bad>".to_owned())),
        ];
        for language in Language::ALL {
            let class = ClassMarks::new(pictures.clone(), &Rubric::default(), language);
            let html = class_page(&class, &["stray <1>.png".to_owned()], language);
            let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
            let document = roxmltree::Document::parse_with_options(&html, options).unwrap();
            let count = |name: &str| document.descendants().filter(|node| node.has_tag_name(name)).count();
            assert_eq!((count("script"), count("section"), count("article")), (1, 2, 4));
            // The picture and two neighborhoods of what differs, the exact one, and the picture that is right.
            assert_eq!((count("image"), count("use"), count("circle")), (5, 1, 2));
            for link in document.descendants().filter_map(|node| node.attribute("href")) {
                let target = link.strip_prefix('#');
                assert!(
                    target
                        .is_none_or(|id| document.descendants().any(|node| node.attribute("id") == Some(id))),
                    "{link}"
                );
            }
            let cells: Vec<_> = document
                .descendants()
                .filter(|node| node.has_tag_name("td") && node.attribute("data-value").is_some())
                .map(|node| node.attribute("data-value").unwrap_or_default())
                .collect();
            assert_eq!(cells, ["5", "10", "15", "0", "0", "0"]);
        }
    }
}
