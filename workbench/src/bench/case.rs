//! The scenes to measure.

use std::path::PathBuf;

use anyhow::{Context as _, Result};
use catoptric_lab::cloud::cloud;
use catoptric_platform::files::write_bytes;
use catoptric_scene::{Scene, write};
use catoptric_store::{load, save};
use xtask::root;

use super::folder;
use crate::scenes::{glass_grid, lens_grid, sphereflake};

use crate::povray;

/// A scene to measure.
#[derive(Debug)]
pub(super) struct Case {
    pub label: &'static str,
    pub name: &'static str,
    /// The least share of pixels, in percent, within 1/255 of POV-Ray's. Less than 99.9 where single precision is
    /// amplified: those are the shares that a tracer on Embree reaches.
    pub least_percent: f64,
    make: fn() -> Result<Scene>,
}

#[rustfmt::skip]
pub(super) const CASES: [Case; 10] = [
    Case { label: "B1", name: "whitted", least_percent: 99.9, make: || reference("whitted") },
    Case { label: "B2", name: "four-bodies", least_percent: 99.9, make: || reference("four-bodies") },
    Case { label: "B3", name: "mirrors", least_percent: 99.9, make: || reference("mirrors") },
    Case { label: "B4", name: "corridor", least_percent: 99.9, make: || reference("corridor") },
    Case { label: "B5", name: "sphereflake-7381", least_percent: 98.9, make: || Ok(sphereflake(5)) },
    Case { label: "B6", name: "cloud-1000", least_percent: 99.9, make: || Ok(cloud(1_000)) },
    Case { label: "B7", name: "cloud-100000", least_percent: 99.1, make: || Ok(cloud(100_000)) },
    Case { label: "B8", name: "cloud-1000000", least_percent: 98.6, make: || Ok(cloud(1_000_000)) },
    Case { label: "B9", name: "glass-grid", least_percent: 99.4, make: || Ok(glass_grid()) },
    Case { label: "B10", name: "lenses-1000", least_percent: 98.5, make: || Ok(lens_grid()) },
];

fn reference(name: &str) -> Result<Scene> {
    Ok(load(root().join(format!("tests/reference/{name}.toml")))?.scene)
}

/// The case of this label or name.
pub(super) fn find(text: &str) -> Result<&'static Case, String> {
    CASES.iter().find(|case| case.label.eq_ignore_ascii_case(text) || case.name == text).ok_or_else(|| {
        let known: Vec<String> = CASES.iter().map(|case| format!("{} {}", case.label, case.name)).collect();
        format!("no such scene; there are {}", known.join(", "))
    })
}

/// A case's scene as files.
pub(super) struct CaseFiles {
    pub scene: PathBuf,
    pub pov: PathBuf,
    pub bodies: usize,
}

impl Case {
    /// Writes the scene for us and for POV-Ray.
    pub(super) fn write(&self) -> Result<CaseFiles> {
        let scene = (self.make)()?;
        let files = CaseFiles {
            scene: folder().join(format!("{}.toml", self.name)),
            pov: folder().join(format!("{}.pov", self.name)),
            bodies: scene.bodies.len(),
        };
        save(&files.scene, &write(&scene))?;
        let source = povray::source(&scene).context(self.name)?;
        write_bytes(&files.pov, source.as_bytes())?;
        Ok(files)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_found_by_label_and_by_name() {
        for (index, case) in CASES.iter().enumerate() {
            assert_eq!(case.label, format!("B{}", index + 1));
            for text in [case.label, case.name, &case.label.to_lowercase()] {
                assert_eq!(find(text).unwrap().label, case.label);
            }
        }
        assert!(find("B11").unwrap_err().contains("B9 glass-grid"));
    }

    #[test]
    fn small_cases_can_be_said_to_both_programs() {
        for case in CASES.iter().filter(|case| !["B7", "B8"].contains(&case.label)) {
            let scene = (case.make)().unwrap();
            let read = catoptric_scene::read(&write(&scene)).into_result().unwrap();
            assert_eq!(read.value, scene, "{}", case.name);
            let source = povray::source(&scene).unwrap();
            let bodies = source.lines().filter(|line| line.contains("matrix")).count();
            assert_eq!(bodies, scene.bodies.len(), "{}", case.name);
        }
    }
}
