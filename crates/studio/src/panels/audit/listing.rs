//! The rows of the list of rays: which ray or which of its terms stands where.

use super::terms;
use crate::base::texts::{Language, Texts};
use crate::state::audit::AuditState;

/// The content of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AuditRow {
    /// A ray.
    Ray(usize),
    /// A term of a ray, by its place among them.
    Term(usize, usize),
}

/// The rows, kept until something changes that decides about them.
#[derive(Default)]
pub(crate) struct AuditListing {
    key: Option<AuditListingKey>,
    rows: Vec<AuditRow>,
    /// How many steps each ray is from the eye.
    depths: Vec<u32>,
}

#[derive(PartialEq)]
struct AuditListingKey {
    serial: u64,
    step: Option<u32>,
    expanded: Vec<usize>,
    language: Language,
}

impl AuditListing {
    /// How many rows there are.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// What stands in a row.
    pub(super) fn row(&self, index: usize) -> Option<AuditRow> {
        self.rows.get(index).copied()
    }

    /// Where a ray stands, if it is shown.
    pub(super) fn place_of(&self, node: usize) -> Option<usize> {
        self.rows.iter().position(|row| *row == AuditRow::Ray(node))
    }

    /// How many steps a ray is from the eye.
    pub(super) fn depth(&self, node: usize) -> u32 {
        self.depths.get(node).copied().unwrap_or(0)
    }

    /// Brings the rows up to date.
    pub(super) fn refresh(&mut self, audit: &AuditState, texts: &Texts) {
        let Some(found) = audit.found() else { return };
        let (expanded, step) = (audit.expanded.iter().copied().collect(), audit.step);
        let key = AuditListingKey { serial: found.serial, step, expanded, language: texts.language() };
        if self.key.as_ref() == Some(&key) {
            return;
        }
        let Some(tree) = found.tree() else { return };
        let mut depths: Vec<u32> = Vec::with_capacity(tree.nodes.len());
        let mut rows = Vec::with_capacity(tree.nodes.len());
        for (place, node) in tree.nodes.iter().enumerate() {
            let above = node.ray.parent.and_then(|parent| depths.get(parent));
            depths.push(above.map_or(0, |above| above + 1));
            if !audit.shows(node.ray.generation) {
                continue;
            }
            rows.push(AuditRow::Ray(place));
            if audit.expanded.contains(&place) {
                let count = terms::of_node(texts, &found.scene, &found.audit, node).len();
                rows.extend((0..count).map(|term| AuditRow::Term(place, term)));
            }
        }
        *self = Self { key: Some(key), rows, depths };
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use catoptric_scene::{Body, Material, MaterialChoice, Phong, Placement, Scene, Shape};
    use catoptric_tracer::{RenderControl, RenderScene};
    use glam::{DVec3, UVec2};

    use super::*;
    use crate::state::audit::{AuditRequest, AuditResult, PinnedPixel};

    /// A pixel whose rays branch at each of some panes of glass, one behind the other.
    fn found(panes: usize) -> AuditResult {
        let glass =
            Material::Phong(Phong { reflection: Some(0.4), transmission: 0.5, ior: 1.5, ..Phong::default() });
        let pane = |place: usize| Body {
            shape: Shape::Cube { size: DVec3::new(4.0, 4.0, 0.1) },
            placement: Placement::at(-0.3 * place as f64 * DVec3::Z),
            material: MaterialChoice::Inline(Box::new(glass.clone())),
            ..Body::default()
        };
        let mut scene = Scene { bodies: (0..panes).map(pane).collect(), ..Scene::default() };
        (scene.tracing.generations, scene.tracing.threshold) = (6, 0.0);
        let render_scene = Arc::new(RenderScene::build(&scene).unwrap());
        let camera = scene.camera;
        let pin = PinnedPixel { pixel: UVec2::new(80, 70), size: UVec2::new(160, 90), camera, home: camera };
        let order = AuditRequest { serial: 1, pin, scene: Arc::new(scene), render_scene, before: None };
        order.carry_out(&RenderControl::default()).unwrap()
    }

    #[test]
    fn rows_follow_the_steps_and_what_is_expanded() {
        let texts = Texts::new(Language::English);
        let found = found(3);
        let count = found.tree().unwrap().nodes.len();
        assert!(count > 8, "{count}");
        let mut audit = AuditState::of(found);
        let mut listing = AuditListing::default();
        listing.refresh(&audit, &texts);
        assert_eq!(listing.len(), count);
        audit.expanded.insert(0);
        listing.refresh(&audit, &texts);
        let terms = listing.len() - count;
        assert!(terms > 5, "{terms}");
        assert_eq!(listing.row(1), Some(AuditRow::Term(0, 0)));
        assert_eq!(listing.place_of(1), Some(1 + terms));
        audit.step = Some(1);
        listing.refresh(&audit, &texts);
        assert_eq!((listing.len(), listing.place_of(1)), (1 + terms, None));
        assert_eq!(listing.depth(1), 1);
    }
}
