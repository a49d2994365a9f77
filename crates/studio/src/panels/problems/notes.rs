//! Findings that are only worth a note: nothing is wrong with a file that keeps a material for later.

use std::collections::BTreeSet;

use catoptric_scene::{Body, Diagnostic, Diagnostics, MaterialChoice, Scene, Severity};

/// For each finding about `text`, whether it is a note, or only says that a material of `scene` is not used.
pub(super) fn notes(findings: &Diagnostics, text: &str, scene: &Scene) -> Vec<bool> {
    let has_warnings = findings.iter().any(|finding| finding.severity == Severity::Warning);
    let unused = if has_warnings { unused_materials(scene) } else { BTreeSet::new() };
    findings.iter().map(|finding| is_note(finding, text, &unused)).collect()
}

fn unused_materials(scene: &Scene) -> BTreeSet<&str> {
    let choices = scene.bodies.iter().flat_map(Body::materials);
    let used: BTreeSet<&str> = choices.filter_map(MaterialChoice::name).collect();
    scene.materials.iter().map(|named| named.name.as_str()).filter(|name| !used.contains(name)).collect()
}

/// Whether the mark of a warning is the name of an unused material. The words of the finding do not matter.
fn is_note(finding: &Diagnostic, text: &str, unused: &BTreeSet<&str>) -> bool {
    let marked = text.get(finding.span.clone()).unwrap_or_default();
    finding.severity == Severity::Note
        || finding.severity == Severity::Warning && unused.contains(marked.trim_matches(['"', '\'']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unused_materials_are_notes_and_darkness_is_none() {
        let text = "format = \"catoptric/1\"\n[environment]\nambient = [0, 0, 0]\n[materials.red]\n\
                    [materials.\"light blue\"]\n[[bodies]]\nshape = \"sphere\"\nmaterial = \"red\"\n";
        let reading = catoptric_scene::read(text);
        assert_eq!(reading.diagnostics.len(), 2, "{:?}", reading.diagnostics);
        assert_eq!(notes(&reading.diagnostics, text, &reading.scene), [false, true]);
    }
}
