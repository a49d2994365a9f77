//! Joined bodies, members of groups and parts as the shaders read them: behind the order of the bodies.

use crate::geometry::Geometry;
use crate::geometry::joined::{JoinGate, JoinedBody};
use crate::geometry::shape::ShapeKind;
use crate::shaders::constants::ShaderConstants;

/// Beside the number of gates: the body is a surface.
const SURFACE: u32 = 1 << 31;
/// And rays pass it that come from its outer side, or from its inner one.
const HIDES_OUTER: u32 = 1 << 30;
const HIDES_INNER: u32 = 1 << 29;

/// The constants of shaders for scenes with joined bodies of so many parts at most.
pub(crate) fn constants(parts: u32) -> ShaderConstants {
    // Whatever comes after it is joined too.
    let words = vec![
        ("PARTS", parts),
        ("JOINED", ShapeKind::Joined as u32),
        ("SURFACE", SURFACE),
        ("HIDES_OUTER", HIDES_OUTER),
        ("HIDES_INNER", HIDES_INNER),
    ];
    ShaderConstants { words, numbers: Vec::new(), flags: Vec::new() }
}

/// The place behind the order of bodies that belongs to the number 0: that of each member is as far from there.
pub(crate) fn members_of(geometry: &Geometry) -> u32 {
    (geometry.bodies.len() as u32).wrapping_sub(geometry.members.first)
}

/// Adds to the order of bodies, the volumes of which are in order, the place in the scene of each member and the records of
/// joined bodies. A joined body has the place of its record in place of its volume's, a part the word of a ray that
/// starts from its outer side, as its whole has it.
pub(crate) fn add_to(order: &mut Vec<[u32; 2]>, geometry: &Geometry) {
    order.extend(geometry.members.scene_indices.iter().map(|&index| [index, 0]));
    if geometry.joined.bodies.is_empty() {
        return;
    }
    for whole in geometry.whole() {
        let Some(joined) = geometry.joined(whole) else { continue };
        let record = order.len() as u32;
        let Some(own) = order.get_mut(whole as usize) else { continue };
        let rank = std::mem::replace(&mut own[1], record);
        add_record(order, joined, rank);
        for part in joined.parts() {
            if let Some(entry) = order.get_mut(part as usize) {
                entry[1] = geometry.joined.whole_of(part, false).word();
            }
        }
    }
}

fn add_record(order: &mut Vec<[u32; 2]>, JoinedBody { first, tree }: &JoinedBody, rank: u32) {
    let gates = tree.gates();
    let side = tree.visible_side();
    let marks =
        [(tree.is_surface(), SURFACE), (!side.is_met(true), HIDES_OUTER), (!side.is_met(false), HIDES_INNER)];
    let marked = |word: u32, (is_marked, mark): (bool, u32)| word | if is_marked { mark } else { 0 };
    let gate_word = marks.into_iter().fold(gates.len() as u32, marked);
    order.extend([[*first, tree.parts], halves(tree.inverted()), [rank, gate_word]]);
    order.extend(
        gates
            .iter()
            .flat_map(|&JoinGate { parts, depth, needs_all }| [halves(parts), [depth, u32::from(needs_all)]]),
    );
}

/// The lower half of the bits first.
fn halves(bits: u64) -> [u32; 2] {
    [bits as u32, (bits >> 32) as u32]
}
