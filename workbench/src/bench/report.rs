//! The figures as tables for BENCHMARKS.md.

use super::measure::{CaseTimings, TimingRow};

/// Both tables, with what they mean. The other renderers are in the order of the figures.
pub(super) fn tables(results: &[CaseTimings], others: &[&str], [width, height]: [u32; 2]) -> String {
    format!(
        "Trace times in ms at {width}x{height}, one sample: best (median, worst) of the runs by turns; ratios of the \
         best times, scaling against the first number of threads.\n\n{}\nRays by kind, ms to prepare, bytes a body, and the percentage of pixels within 1/255 of \
         POV-Ray's.\n\n{}",
        times(results, others),
        scenes(results, others)
    )
}

fn times(results: &[CaseTimings], others: &[&str]) -> String {
    let names = others.iter().map(|name| (*name).to_owned());
    let ratios = ["Catoptric"].iter().chain(others).map(|name| format!("POV-Ray / {name}"));
    let head = cells(["scene", "threads", "POV-Ray", "Catoptric"]).into_iter().chain(names).chain(ratios);
    let mut rows = vec![head.chain(cells(["scaling", "Mray/s"])).collect()];
    for result in results {
        rows.extend(result.rows.iter().map(|row| times_row(result, row)));
    }
    table(&rows)
}

fn times_row(result: &CaseTimings, row: &TimingRow) -> Vec<String> {
    let TimingRow { threads, povray, trace, others, .. } = row;
    let ours = std::iter::once(trace);
    let times = std::iter::once(povray).chain(ours.clone()).chain(others).map(ToString::to_string);
    let ratios = ours.chain(others).map(|times| format!("{:.1}", povray.best() / times.best()));
    let mrays = format!("{:.1}", result.stats.all_rays() / (trace.best() * 1e3));
    let scaling = result.rows.first().map_or(f64::NAN, |first| first.trace.best() / trace.best());
    let scene = [result.title(), threads.to_string()];
    scene.into_iter().chain(times).chain(ratios).chain([format!("{scaling:.2}"), mrays]).collect()
}

fn scenes(results: &[CaseTimings], others: &[&str]) -> String {
    let threads =
        results.first().map(|result| result.rows.iter().map(|row| row.threads)).into_iter().flatten();
    let head = cells(["scene", "bodies", "primary", "shadow", "reflected", "refracted"]).into_iter();
    let head = head.chain(threads.map(|threads| format!("prepare, threads: {threads}")));
    let head = head.chain(cells(["bytes a body", "Catoptric, %"]));
    let mut rows = vec![head.chain(others.iter().map(|name| format!("{name}, %"))).collect()];
    rows.extend(results.iter().map(scenes_row));
    table(&rows)
}

fn scenes_row(result: &CaseTimings) -> Vec<String> {
    let CaseTimings { bodies, stats, rows, same, others_same, .. } = result;
    let rays = stats.rays.map(|count| format!("{count:.0}"));
    let prepare = rows.iter().map(|row| row.prepare.to_string());
    let bytes = stats.stage_bytes / (*bodies).max(1) as f64;
    let same = std::iter::once(Some(*same)).chain(others_same.iter().copied());
    let same = same.map(|same| same.map_or_else(|| "–".to_owned(), |same| format!("{same:.3}")));
    let row = [result.title(), bodies.to_string()].into_iter().chain(rays).chain(prepare);
    row.chain([format!("{bytes:.0}")]).chain(same).collect()
}

impl CaseTimings {
    fn title(&self) -> String {
        format!("{} {}", self.case.label, self.case.name)
    }
}

pub(super) fn cells<const N: usize>(texts: [&str; N]) -> [String; N] {
    texts.map(str::to_owned)
}

/// A Markdown table with aligned columns; the first row is the head.
pub(super) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or_default();
    let length = |row: &Vec<String>, column: usize| row.get(column).map_or(0, |cell| cell.chars().count());
    let width = |column| rows.iter().map(|row| length(row, column)).max().unwrap_or_default();
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (index, row) in rows.iter().enumerate() {
        let padded = row.iter().zip(&widths).map(|(cell, &width)| format!(" {cell:width$} |"));
        text.extend(std::iter::once("|".to_owned()).chain(padded).chain(["\n".to_owned()]));
        if index == 0 {
            let rule = widths.iter().map(|width| "-".repeat(width + 2) + "|");
            text.extend(std::iter::once("|".to_owned()).chain(rule).chain(["\n".to_owned()]));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::case::CASES;
    use crate::bench::programs::RenderStats;
    use crate::bench::series::TimeSeries;

    fn measured() -> CaseTimings {
        let series = |times: [f64; 3]| {
            let mut series = TimeSeries::default();
            times.into_iter().for_each(|time| series.push(time));
            series
        };
        let row = TimingRow {
            threads: 2,
            povray: series([400.0, 420.0, 410.0]),
            prepare: series([0.5; 3]),
            trace: series([10.0, 12.0, 11.0]),
            others: vec![series([20.0; 3])],
        };
        let stats = RenderStats { prepare: 0.5, trace: 12.0, rays: [4e5, 3e5, 2e5, 1e5], stage_bytes: 700.0 };
        let others_same = vec![None];
        CaseTimings { case: &CASES[0], bodies: 7, stats, rows: vec![row], same: 99.95, others_same }
    }

    #[test]
    fn the_tables_say_what_was_measured() {
        let mut result = measured();
        let first = TimingRow { threads: 1, ..result.rows[0].clone() };
        result.rows.insert(0, first);
        result.rows[1].trace.push(8.0);
        let text = tables(&[result], &["mine"], [320, 180]);
        let cells = |line: &str| line.split('|').map(str::trim).collect::<Vec<_>>().join("|");
        let rows: Vec<String> = text.lines().filter(|line| line.starts_with('|')).map(cells).collect();
        let [times_head, _, first, second, scenes_head, _, scene] = rows.as_slice() else {
            panic!("not two tables:\n{text}")
        };
        let head = "|scene|threads|POV-Ray|Catoptric|mine|POV-Ray / Catoptric|POV-Ray / mine|scaling|Mray/s|";
        assert_eq!(times_head, head);
        let begin = "|B1 whitted|1|400.0 (410.0, 420.0)|10.0 (11.0, 12.0)|20.0 (20.0, 20.0)|";
        assert_eq!(*first, format!("{begin}40.0|20.0|1.00|100.0|"));
        assert!(second.ends_with("|50.0|20.0|1.25|125.0|"), "{second}");
        let head = "|scene|bodies|primary|shadow|reflected|refracted|prepare, threads: 1|prepare, threads: 2|\
                    bytes a body|Catoptric, %|mine, %|";
        assert_eq!(scenes_head, head);
        let prepare = "0.5 (0.5, 0.5)";
        let row = format!("|B1 whitted|7|400000|300000|200000|100000|{prepare}|{prepare}|100|99.950|–|");
        assert_eq!(*scene, row);
        assert!(text.contains("320x180"));
    }

    #[test]
    fn columns_are_aligned() {
        let rows = [vec!["a".to_owned(), "bcd".to_owned()], vec!["–é".to_owned(), "1".to_owned()]];
        assert_eq!(table(&rows), "| a  | bcd |\n|----|-----|\n| –é | 1   |\n");
    }

    #[test]
    fn a_picture_below_its_bound_is_a_fault() {
        let good = measured();
        assert_eq!(good.fault(), None);
        let bad = CaseTimings { same: 99.89, ..good };
        assert!(bad.fault().unwrap().starts_with("B1 whitted: 99.890 %"));
    }
}
