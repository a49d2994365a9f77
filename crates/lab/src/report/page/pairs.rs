//! A picture against the truth: the two halves, the maps with their legends, the reasons.

use std::fmt::Write as _;

use catoptric_picture::{Development, HeatMap, heat_map};

use super::{HtmlPage, PageError, data_uri};
use crate::compare::{AGREED, Contender, Metrics, reason_color, reason_picture};
use crate::report::html::escape;
use crate::report::texts::fill;

impl HtmlPage<'_> {
    /// A section for each picture but the first.
    pub(super) fn pairs(&self, html: &mut String) -> Result<(), PageError> {
        let language = self.settings.language;
        let scale = self.compared.scale();
        for (index, (other, metrics)) in self.compared.others().enumerate() {
            let names = [("name", other.name.as_str()), ("truth", self.truth_name())];
            let title = fill(language.pair_title(), &names);
            let _ = write!(html, "<section class=\"pair\">\n<h2>{}</h2>\n", escape(&title));
            self.split(html, index + 1, &fill(language.split_caption(), &names), &title);
            if metrics.difference.worst.is_none() {
                let _ = writeln!(html, "<p>{}</p>", escape(language.equal()));
            } else {
                self.maps(html, other, metrics, scale)?;
            }
            html.push_str("</section>\n");
        }
        Ok(())
    }

    /// The truth on the left, the other on the right of a line that can be moved.
    fn split(&self, html: &mut String, index: usize, caption: &str, title: &str) {
        let [width, height] = self.size();
        let (middle, label) = (f64::from(width) / 2.0, escape(self.settings.language.split_label()));
        let stroke = (f64::from(width) / 500.0).max(0.5);
        let _ = writeln!(
            html,
            "<figure><svg class=\"split\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\">\
             <clipPath id=\"c{index}\"><rect class=\"cover\" x=\"{middle}\" width=\"{width}\" height=\"{height}\"/>\
             </clipPath><use href=\"#p0\"/><g clip-path=\"url(#c{index})\"><use href=\"#p{index}\"/></g>\
             <line class=\"divider\" x1=\"{middle}\" x2=\"{middle}\" y2=\"{height}\" stroke=\"#ffffff\" \
             stroke-width=\"{stroke}\"/></svg><label>{label}<input type=\"range\" min=\"0\" max=\"100\" step=\"any\" \
             value=\"50\"/></label><figcaption>{}</figcaption></figure>",
            escape(title),
            escape(caption)
        );
    }

    fn maps(
        &self,
        html: &mut String,
        other: &Contender,
        metrics: &Metrics,
        scale: f64,
    ) -> Result<(), PageError> {
        let language = self.settings.language;
        let Some(truth) = self.compared.truth() else { return Ok(()) };
        html.push_str("<div class=\"maps\">\n");
        let options = HeatMap { legend: false, maximum: scale, ..HeatMap::default() };
        let map = heat_map(&truth.picture, &other.picture, &options)?;
        let data = data_uri(&map, &Development::default())?;
        self.map(html, &data, language.difference_caption(), &self.scale_legend(scale));
        let map = metrics.flip_map.heat_map(&HeatMap { maximum: 1.0, ..options })?;
        let data = data_uri(&map, &Development::default())?;
        let caption = fill(language.flip_caption(), &[("mean", &language.fixed(metrics.flip, 4))]);
        self.map(html, &data, &caption, &self.scale_legend(1.0));
        let reasons = other.drawn.as_ref().and_then(|drawn| drawn.reasons.as_ref());
        if let Some(map) = reasons {
            let data = data_uri(&reason_picture(map)?, &Development::default())?;
            let caption = fill(language.reasons_caption(), &[("truth", self.truth_name())]);
            self.map(html, &data, &caption, "");
            html.push_str("<div>");
            self.shares(html, map, metrics);
            html.push_str("</div>\n");
        }
        html.push_str("</div>\n");
        Ok(())
    }

    /// A map with its caption and legend.
    fn map(&self, html: &mut String, data: &str, caption: &str, legend: &str) {
        let [width, height] = self.size();
        let caption = escape(caption);
        let _ = writeln!(
            html,
            "<figure><svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{caption}\"><image \
             width=\"{width}\" height=\"{height}\" href=\"{data}\"/></svg>{legend}<figcaption>{caption}</figcaption>\
             </figure>"
        );
    }

    /// The scale of a heat map with its numbers.
    fn scale_legend(&self, maximum: f64) -> String {
        let places = if maximum < 0.1 { 4 } else { 3 };
        let numbers: String = (0..=4_u32)
            .map(|quarter| {
                let part = f64::from(quarter) / 4.0;
                let anchor = match quarter {
                    0 => "start",
                    4 => "end",
                    _ => "middle",
                };
                let number = self.settings.language.fixed(maximum * part, places);
                let number = number.trim_end_matches('0').trim_end_matches(['.', ',']);
                let number = if number.is_empty() { "0" } else { number };
                format!("<text x=\"{:.1}\" y=\"24\" text-anchor=\"{anchor}\">{number}</text>", 400.0 * part)
            })
            .collect();
        format!(
            "<svg class=\"scale\" viewBox=\"0 0 400 28\" aria-hidden=\"true\"><rect width=\"400\" height=\"10\" \
             fill=\"url(#inferno)\"/>{numbers}</svg>"
        )
    }

    /// The table of reasons, which is the legend of their map too.
    fn shares(&self, html: &mut String, map: &catoptric_tracer::raster::ReasonMap, metrics: &Metrics) {
        let language = self.settings.language;
        let counts = map.counts();
        let explained: u64 = counts.iter().map(|(_, count)| count).sum();
        let wrong = metrics.difference.above.max(explained);
        let all = map.reasons().len() as f64;
        let _ = write!(
            html,
            "<table class=\"reasons\"><caption>{}</caption><thead><tr><th scope=\"col\">{}</th><th \
             scope=\"col\">{}</th><th scope=\"col\">{}</th><th scope=\"col\">{}</th></tr></thead><tbody>",
            escape(language.shares_caption()),
            escape(language.reason()),
            escape(language.pixels_head()),
            escape(language.share_of_wrong()),
            escape(language.share_of_all())
        );
        let rest = wrong - explained;
        let known =
            counts.iter().map(|(reason, count)| (reason_color(*reason), language.why(*reason), *count));
        let unknown = (rest > 0).then_some((AGREED, language.without_reason(), rest));
        for ([red, green, blue], name, count) in known.chain(unknown) {
            let _ = write!(
                html,
                "<tr><th scope=\"row\"><span class=\"key\" style=\"background:#{red:02x}{green:02x}{blue:02x}\"></span>\
                 {}</th><td>{}</td><td>{}</td><td>{}</td></tr>",
                escape(name),
                language.count(count),
                language.fixed(100.0 * count as f64 / (wrong as f64).max(1.0), 1),
                language.fixed(100.0 * count as f64 / all, 2)
            );
        }
        html.push_str("</tbody></table>");
    }
}
