//! The page around its content: style and script.

use crate::report::html::escape;
use crate::report::language::Language;

/// How the page looks, on the screen and on paper.
const STYLE: &str = "
:root { color-scheme: light dark; --ink: #1c1c1e; --soft: #5d5d63; --paper: #fdfdfb; --rule: #c9c9c6; --tint: #f1f1ee; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8e6; --soft: #a5a5a3; --paper: #17181a; --rule: #45464a; --tint: #222326; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2.5rem 1.25rem 4rem; max-width: 62rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 Georgia, 'PT Serif', 'Noto Serif', 'DejaVu Serif', serif; hyphens: auto; }
h1, h2, h3, table, figcaption, .note, label { font-family: 'Helvetica Neue', 'PT Sans', 'Segoe UI', 'Noto Sans',
  'DejaVu Sans', Arial, sans-serif; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .8rem; font-weight: 600; text-wrap: balance; }
h2 { font-size: 1.25rem; margin: 2.6rem 0 .8rem; padding-top: .7rem; border-top: 1px solid var(--rule); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .6rem; }
.lead { max-width: 46rem; }
.note { color: var(--soft); font-size: .85rem; max-width: 46rem; }
.definitions { position: absolute; }
figure { margin: 0; break-inside: avoid; }
figure > svg { display: block; width: 100%; height: auto; background: var(--tint); }
figcaption { font-size: .85rem; line-height: 1.4; color: var(--soft); padding: .4rem 0 0; }
figcaption b { color: var(--ink); font-weight: 600; }
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: 1.1rem; }
.maps { display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 1.1rem; margin-top: 1.1rem; }
.split { touch-action: pan-y; cursor: ew-resize; }
.split + label { display: none; }
.live .split + label { display: block; font-size: .85rem; }
.split + label input { width: 100%; margin: .35rem 0 0; accent-color: #0072b2; }
.scale { height: auto; background: none !important; margin-top: .3rem; }
.scale text { fill: var(--ink); font: 11px 'Helvetica Neue', 'PT Sans', 'DejaVu Sans', Arial, sans-serif; }
.wide { overflow-x: auto; margin-top: 1.1rem; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; font-variant-numeric: tabular-nums lining-nums;
  break-inside: avoid; }
caption { text-align: left; color: var(--soft); padding: 0 0 .45rem; }
th, td { padding: .32rem .55rem; text-align: right; vertical-align: baseline; border-bottom: 1px solid var(--rule); }
th:first-child, .words td { text-align: left; }
thead th { font-weight: 600; border-bottom: 2px solid var(--ink); vertical-align: bottom; hyphens: manual; }
tbody th { font-weight: 500; hyphens: manual; white-space: nowrap; }
.reasons tbody th { white-space: normal; }
.reasons { font-size: .82rem; }
.mark circle { fill: none; stroke: #ff2d8a; }
.mark text { fill: #ff2d8a; stroke: #fff; paint-order: stroke; text-anchor: middle; font-weight: 600;
  font-family: 'Helvetica Neue', 'PT Sans', 'DejaVu Sans', Arial, sans-serif; }
pre { overflow-x: auto; padding: .7rem .9rem; background: var(--tint); font-size: .8rem; line-height: 1.4;
  font-family: 'DejaVu Sans Mono', 'PT Mono', Consolas, monospace; hyphens: manual; }
.key { display: inline-block; width: .85em; height: .85em; margin-right: .5em; vertical-align: -.08em;
  border: 1px solid var(--rule); }
@page { size: A4; margin: 16mm 15mm 18mm; }
@media print {
  :root { color-scheme: light; --ink: #000; --soft: #444; --paper: #fff; --rule: #aaa; --tint: #f3f3f3; }
  body { padding: 0; max-width: none; font-size: 10pt; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  h2, h3 { break-after: avoid; }
  .pair { break-before: page; }
  .gallery { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 5mm; }
  .maps { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 5mm; }
  .live .split + label { display: none; }
  .pair .split { width: 62%; }
  h2 { margin-top: 1.2rem; }
  th, td { padding: .22rem .4rem; }
  .reasons { font-size: .74rem; }
  pre { font-size: .62rem; white-space: pre-wrap; }
}
";

/// Moves the dividing lines: by the pointer on the picture, or by the slider below it.
const SCRIPT: &str = "
document.documentElement.classList.add('live');
for (const split of document.querySelectorAll('.split')) {
  const width = split.viewBox.baseVal.width;
  const cover = split.querySelector('.cover'), line = split.querySelector('.divider');
  const slider = split.nextElementSibling.querySelector('input');
  const place = part => {
    const x = Math.min(Math.max(part, 0), 1) * width;
    cover.setAttribute('x', x); line.setAttribute('x1', x); line.setAttribute('x2', x);
  };
  const point = event => {
    const box = split.getBoundingClientRect();
    const part = (event.clientX - box.left) / box.width;
    slider.value = 100 * part; place(part);
  };
  slider.addEventListener('input', () => place(slider.value / 100));
  split.addEventListener('pointerdown', event => { split.setPointerCapture(event.pointerId); point(event); });
  split.addEventListener('pointermove', event => { if (event.buttons) point(event); });
}
";

/// The beginning of the page, up to its first heading.
pub(crate) fn head(language: Language, title: &str) -> String {
    head_with(language, title, "")
}

/// [`head`] with a style of the page's own.
pub(crate) fn head_with(language: Language, title: &str, style: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"{code}\">\n<head>\n<meta \
         charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}\
         </title>\n<style>{STYLE}{style}</style>\n</head>\n<body>\n",
        code = language.code(),
        title = escape(title)
    )
}

/// The end of the page, with the script, which stands in a section that XML passes over and HTML takes as a comment.
pub(crate) fn end() -> String {
    end_with("")
}

/// [`end`] with a script of the page's own.
pub(crate) fn end_with(script: &str) -> String {
    format!("<script>//<![CDATA[\n{SCRIPT}{script}//]]></script>\n</body>\n</html>\n")
}
