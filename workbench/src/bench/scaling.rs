//! How much quicker more threads are, picture after picture in one process.

use std::path::Path;

use anyhow::{Context as _, Result};
use xtask::shell::{self, command};

use super::case::Case;
use super::programs::program;
use super::report::{cells, table};
use super::{BenchArguments, folder};

/// A number of threads, and the milliseconds of a picture with so many.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ScalingPoint {
    threads: u32,
    median: f64,
    least: f64,
}

/// Measures the scenes with all numbers of threads by turns: a table.
pub(super) fn measure(cases: &[&'static Case], arguments: &BenchArguments) -> Result<String> {
    let head = ["scene", "threads", "median, ms", "best, ms", "scaling of medians", "of best"];
    let mut rows = vec![cells(head).to_vec()];
    for case in cases {
        eprintln!("{} {}, scaling", case.label, case.name);
        let points = points(&case.write()?.scene, arguments)?;
        rows.extend(points.iter().map(|point| row(case, points[0], *point)));
    }
    Ok(format!(
        "Scaling by `catoptric measure`: medians and best times of {} pictures in one process, by turns, without the \
         first of each.\n\n{}",
        arguments.runs,
        table(&rows)
    ))
}

fn row(case: &Case, first: ScalingPoint, point: ScalingPoint) -> Vec<String> {
    let times = [point.median, point.least].map(|time| format!("{time:.2}"));
    let gains = [first.median / point.median, first.least / point.least].map(|gain| format!("{gain:.2}"));
    let name = [format!("{} {}", case.label, case.name), point.threads.to_string()];
    name.into_iter().chain(times).chain(gains).collect()
}

fn points(scene: &Path, arguments: &BenchArguments) -> Result<Vec<ScalingPoint>> {
    let output = folder().join("scaling");
    let threads: Vec<String> = arguments.threads.iter().map(u32::to_string).collect();
    let vary = format!("threads={}", threads.join(","));
    let [width, height] = arguments.size();
    let (size, rounds) = (format!("{width}x{height}"), arguments.runs.to_string());
    let [scene, folder] = [scene, &output].map(|path| path.display().to_string());
    let words = ["measure", &scene, "--vary", &vary, "--size", &size, "--rounds", &rounds, "-o", &folder];
    shell::run(command(&program(), &words).arg("--quiet"))?;
    let path = output.join("points.csv");
    let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    read(&text).with_context(|| format!("{} tells no times:\n{text}", path.display()))
}

/// The points of a `points.csv`, none of whose cells here has a comma in it.
fn read(text: &str) -> Option<Vec<ScalingPoint>> {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next()?;
    let column = |name| head.iter().position(|cell| *cell == name);
    let [threads, median, least] = [column("threads")?, column("median_ms")?, column("least_ms")?];
    let point = |cells: Vec<&str>| {
        let number = |column: usize| cells.get(column)?.parse::<f64>().ok();
        let threads = cells.get(threads)?.parse().ok()?;
        Some(ScalingPoint { threads, median: number(median)?, least: number(least)? })
    };
    lines.map(point).collect::<Option<Vec<_>>>().filter(|points| !points.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::case::CASES;

    #[test]
    fn reads_what_was_measured() {
        let text = "threads,runs,median_ms,least_ms\n1,25,24.5,24\n2,25,12.5,12.5\n";
        let points = read(text).unwrap();
        assert_eq!(points[1], ScalingPoint { threads: 2, median: 12.5, least: 12.5 });
        let row = row(&CASES[0], points[0], points[1]);
        assert_eq!(row, ["B1 whitted", "2", "12.50", "12.50", "1.96", "1.92"]);
        for wrong in
            ["", "threads,median_ms,least_ms\n", "threads,median_ms\n1,2\n", &text.replace("24.5", "x")]
        {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
