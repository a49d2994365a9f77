//! Common parts of the drawings of a tree.

use std::collections::VecDeque;

use super::{Audit, Node, NodeKind, RayTree};

/// The color of a kind of rays, as in CSS. The studio may draw rays in the same.
pub(super) fn color(kind: NodeKind) -> &'static str {
    match kind {
        NodeKind::Primary => "#5f6b7a",
        NodeKind::Reflected => "#1f77c9",
        NodeKind::TotallyReflected => "#7a4fc4",
        NodeKind::Refracted => "#1a9a6c",
    }
}

/// How wide the line of a ray is drawn.
pub(super) fn line_width(node: &Node) -> f32 {
    1.0 + 7.0 * node.largest_weight().clamp(0.0, 1.0)
}

/// What a ray ends at.
pub(super) fn end_of(audit: &Audit, node: &Node) -> String {
    node.ray.hit.map_or_else(|| "background".to_owned(), |hit| audit.names.body(hit.body))
}

/// The rays that a drawing of a tree shows: those near the eye.
pub(super) struct RayDiagram {
    /// The places of the drawn rays in the tree, in order.
    pub(super) places: Vec<usize>,
    /// How many rays are not.
    pub(super) hidden: usize,
}

impl RayDiagram {
    /// The rays up to `depth` steps from the eye, at most `limit`.
    pub(super) fn of(tree: &RayTree, depth: Option<usize>, limit: usize) -> Self {
        let mut places = Vec::new();
        let mut waiting: VecDeque<(usize, usize)> =
            (!tree.nodes.is_empty()).then_some((0, 0)).into_iter().collect();
        while let Some((place, steps)) = waiting.pop_front()
            && places.len() < limit
        {
            places.push(place);
            let goes_on = depth.is_none_or(|depth| steps < depth);
            if let Some(node) = tree.nodes.get(place).filter(|_| goes_on) {
                waiting.extend(node.children.iter().map(|&child| (child, steps + 1)));
            }
        }
        places.sort_unstable();
        let hidden = tree.nodes.len() - places.len();
        Self { places, hidden }
    }
}
