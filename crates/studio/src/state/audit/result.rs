//! The result of an audit, with all that is drawn of it.

use std::sync::Arc;

use catoptric_lab::audit::{Audit, AuditError, AuditSettings, Node, NodeKind, RayTree, audit};
use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};

use super::PinnedPixel;
use super::clock::LightSpan;
use super::segments::{self, RaySegment};

/// A finished audit with all that is drawn of it.
pub(crate) struct AuditResult {
    /// Tells it from others.
    pub(crate) serial: u64,
    pub(crate) pin: PinnedPixel,
    /// The scene that was looked into.
    pub(crate) scene: Arc<Scene>,
    pub(crate) audit: Arc<Audit>,
    /// The ways of its rays in space.
    pub(crate) ways: Vec<RaySegment>,
    /// How many ways there would be besides.
    pub(crate) ways_left_out: usize,
    /// The optical paths along which something happens.
    pub(crate) span: LightSpan,
    /// How it was before the last change of the scene.
    pub(crate) before: Option<EarlierAudit>,
}

/// An earlier audit of the same pixel.
pub(crate) struct EarlierAudit {
    pub(crate) audit: Arc<Audit>,
    pub(crate) scene: Arc<Scene>,
    /// For each ray the one that it was, if there was one.
    twins: Vec<Option<usize>>,
}

impl EarlierAudit {
    /// The ray that this one was, and its place.
    pub(crate) fn twin(&self, place: usize) -> Option<(usize, &Node)> {
        let twin = (*self.twins.get(place)?)?;
        Some((twin, self.audit.trees.first()?.nodes.get(twin)?))
    }
}

/// A request for an audit.
pub(crate) struct AuditRequest {
    pub(crate) serial: u64,
    pub(crate) pin: PinnedPixel,
    pub(crate) scene: Arc<Scene>,
    pub(crate) render_scene: Arc<RenderScene>,
    pub(crate) before: Option<(Arc<Audit>, Arc<Scene>)>,
}

impl AuditRequest {
    /// Traces the pixel, one ray through its middle.
    pub(crate) fn carry_out(self, control: &RenderControl) -> Result<AuditResult, AuditError> {
        let Self { serial, pin, scene, render_scene, before } = self;
        let picture = RenderSettings { width: pin.size.x, height: pin.size.y, samples: 1 };
        let settings = AuditSettings { picture, ..AuditSettings::default() };
        let camera = render_scene.camera_for(&pin.camera);
        let audit = audit(&scene, &render_scene, &camera, pin.pixel, &settings, control)?;
        let tree = audit.trees.first();
        let (ways, ways_left_out) =
            tree.map(|tree| segments::of_tree(tree, &scene, &pin)).unwrap_or_default();
        let span = LightSpan::of_ways(&ways);
        let before = before.map(|(old, scene)| {
            let twins = tree.zip(old.trees.first()).map(|(new, old)| twins(new, old)).unwrap_or_default();
            EarlierAudit { audit: old, scene, twins }
        });
        Ok(AuditResult { serial, pin, scene, audit: Arc::new(audit), ways, ways_left_out, span, before })
    }
}

impl AuditResult {
    /// The tree of the ray through the pixel's middle.
    pub(crate) fn tree(&self) -> Option<&RayTree> {
        self.audit.trees.first()
    }

    /// A ray of the tree.
    pub(crate) fn node(&self, place: usize) -> Option<&Node> {
        self.tree()?.nodes.get(place)
    }

    /// The last generation of the tree.
    pub(crate) fn generations(&self) -> u32 {
        self.tree().map_or(0, RayTree::generations)
    }
}

/// For each ray of a tree the one that came the same way in another: by reflection and refraction in the same order.
fn twins(new: &RayTree, old: &RayTree) -> Vec<Option<usize>> {
    let mut twins: Vec<Option<usize>> = Vec::with_capacity(new.nodes.len());
    for node in &new.nodes {
        let twin = match node.ray.parent {
            None => (!old.nodes.is_empty()).then_some(0),
            Some(parent) => twins.get(parent).copied().flatten().and_then(|above| {
                let children = &old.nodes.get(above)?.children;
                let is_alike = |child: &&usize| {
                    old.nodes.get(**child).is_some_and(|other| is_refracted(other) == is_refracted(node))
                };
                children.iter().find(is_alike).copied()
            }),
        };
        twins.push(twin);
    }
    twins
}

fn is_refracted(node: &Node) -> bool {
    node.kind == NodeKind::Refracted
}
