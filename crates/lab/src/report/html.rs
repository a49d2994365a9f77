//! Pieces of pages. All of it is well-formed XML.

use std::fmt::Write as _;

use catoptric_scene::visible;

/// Text as XML has it: no markup, no character that XML cannot say, none that turns the direction of the text around
/// it.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in visible(text).chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // In attributes between single quotes, should there be any.
            '\'' => escaped.push_str("&#39;"),
            // XML cannot say these at all.
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}

/// A table: the heads of its columns and its rows, of which the first column is text and the others are numbers.
pub(crate) fn table(caption: &str, heads: &[String], rows: &[Vec<String>]) -> String {
    let mut html = format!("<table>\n<caption>{}</caption>\n<thead><tr>", escape(caption));
    for head in heads {
        let _ = write!(html, "<th scope=\"col\">{}</th>", escape(head));
    }
    html.push_str("</tr></thead>\n<tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (index, cell) in row.iter().enumerate() {
            let cell = escape(cell);
            let _ = match index {
                0 => write!(html, "<th scope=\"row\">{cell}</th>"),
                _ => write!(html, "<td>{cell}</td>"),
            };
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody>\n</table>\n");
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_breaks_the_markup() {
        let wild = "a<b>&\"c\"'\u{1}\u{fffe}\u{9b}\u{202e}\n</table>";
        let html = table(wild, &[wild.to_owned()], &[vec![wild.to_owned(), wild.to_owned()]]);
        let document = roxmltree::Document::parse(&html).unwrap();
        let caption = document.descendants().find(|node| node.has_tag_name("caption")).unwrap();
        assert_eq!(caption.text(), Some("a<b>&\"c\"'\\u0001\u{fffd}\\u009B\\u202E\\u000A</table>"));
    }
}
