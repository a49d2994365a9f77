//! Measures one scene in all programs, by turns.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use catoptric_picture::{Difference, Picture, read};

use super::case::{Case, CaseFiles};
use super::programs::{RenderStats, catoptric};
use super::series::TimeSeries;
use super::{BenchArguments, folder};
use crate::povray::{self, PovrayTask};

/// Times of one scene with one number of threads.
#[derive(Clone, Debug, Default)]
pub(super) struct TimingRow {
    pub threads: u32,
    pub povray: TimeSeries,
    pub prepare: TimeSeries,
    pub trace: TimeSeries,
    /// In the order of the arguments.
    pub others: Vec<TimeSeries>,
}

/// Everything measured of one scene.
pub(super) struct CaseTimings {
    pub case: &'static Case,
    pub bodies: usize,
    pub stats: RenderStats,
    pub rows: Vec<TimingRow>,
    /// Percent of the pixels within 1/255 of POV-Ray's.
    pub same: f64,
    /// Percent of the pixels of the other renderers' pictures within 1/255 of POV-Ray's, where there is one.
    pub others_same: Vec<Option<f64>>,
}

/// Measures a scene, and says on the way how far it is.
pub(super) fn measure(case: &'static Case, arguments: &BenchArguments) -> Result<CaseTimings> {
    let files = case.write()?;
    let turns = CaseRun { case, arguments, files: &files };
    let runs = arguments.runs.max(1);
    let povray_runs = arguments.povray_runs.unwrap_or(runs).max(1);
    let others = vec![TimeSeries::default(); arguments.others.len()];
    let row = |&threads: &u32| TimingRow { threads, others: others.clone(), ..TimingRow::default() };
    let mut rows: Vec<TimingRow> = arguments.threads.iter().map(row).collect();
    let mut stats = None;
    for turn in 0..runs.max(povray_runs) {
        eprintln!("{} {}, turn {}", case.label, case.name, turn + 1);
        for row in &mut rows {
            if turn < povray_runs {
                row.povray.push(povray::trace(&files.pov, &turns.task(&turns.povray(), row.threads))?);
            }
            if turn < runs {
                stats = Some(turns.ours(row)?);
                turns.others(row)?;
            }
        }
    }
    let stats = stats.context("no number of threads")?;
    let reference = read(&turns.povray())?;
    let same = percent_same(&turns.picture("catoptric"), &reference)?;
    let others = (0..arguments.others.len()).map(|number| turns.other(number));
    let others_same = others.map(|path| path.exists().then(|| percent_same(&path, &reference)).transpose());
    let others_same = others_same.collect::<Result<_>>()?;
    Ok(CaseTimings { case, bodies: files.bodies, stats, rows, same, others_same })
}

impl CaseTimings {
    /// What is wrong with our picture, if anything.
    pub(super) fn fault(&self) -> Option<String> {
        let Case { label, name, least_percent, .. } = self.case;
        let same = self.same;
        (same < *least_percent)
            .then(|| format!("{label} {name}: {same:.3} % of the pixels are the same, not {least_percent} %"))
    }
}

struct CaseRun<'a> {
    case: &'static Case,
    arguments: &'a BenchArguments,
    files: &'a CaseFiles,
}

impl CaseRun<'_> {
    fn picture(&self, program: &str) -> PathBuf {
        folder().join(format!("{}.{program}.exr", self.case.name))
    }

    fn povray(&self) -> PathBuf {
        self.picture("povray")
    }

    fn other(&self, number: usize) -> PathBuf {
        self.picture(&format!("other-{}", number + 1))
    }

    fn task<'a>(&self, output: &'a Path, threads: u32) -> PovrayTask<'a> {
        let [width, height] = self.arguments.size();
        PovrayTask { output, width, height, threads }
    }

    fn ours(&self, row: &mut TimingRow) -> Result<RenderStats> {
        let stats = catoptric(&self.files.scene, &self.task(&self.picture("catoptric"), row.threads))?;
        row.prepare.push(stats.prepare);
        row.trace.push(stats.trace);
        Ok(stats)
    }

    fn others(&self, row: &mut TimingRow) -> Result<()> {
        for (number, (other, series)) in self.arguments.others.iter().zip(&mut row.others).enumerate() {
            let output = self.other(number);
            if output.exists() {
                std::fs::remove_file(&output)?;
            }
            series.push(other.trace(self.files, &self.task(&output, row.threads))?);
        }
        Ok(())
    }
}

/// How many of the pixels of a picture are within 1/255 of the reference's, in percent.
fn percent_same(picture: &Path, reference: &Picture) -> Result<f64> {
    let difference = Difference::between(&read(picture)?, reference)?;
    Ok(100.0 * (1.0 - difference.share_above))
}
