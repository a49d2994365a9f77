//! Where the nodes of a tree go when it is drawn: no two overlap, parents stand in the middle of their children, equal
//! branches look equal (Reingold and Tilford 1981, Tidier drawings of trees).

/// Where each node goes across the direction of growth, in units of the distance that neighbors keep; the least is 0.
/// `parents` names the node before each, which must come earlier; the first node is the root.
pub(super) fn tidy(parents: &[Option<usize>]) -> Vec<f64> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); parents.len()];
    for (place, parent) in parents.iter().enumerate() {
        if let Some(siblings) = parent.and_then(|parent| children.get_mut(parent)) {
            siblings.push(place);
        }
    }
    // From the leaves to the root: where each node stands beside its parent.
    let mut outlines: Vec<BranchContour> = (0..parents.len()).map(|_| BranchContour::default()).collect();
    let mut beside = vec![0.0; parents.len()];
    for (place, children) in children.iter().enumerate().rev() {
        let mut all = BranchContour::default();
        let mut offsets = Vec::with_capacity(children.len());
        for &child in children {
            let branch = outlines.get_mut(child).map(std::mem::take).unwrap_or_default();
            offsets.push(all.put_beside(branch));
        }
        let middle = match (offsets.first(), offsets.last()) {
            (Some(first), Some(last)) => 0.5 * (first + last),
            _ => 0.0,
        };
        for (&child, offset) in children.iter().zip(&offsets) {
            if let Some(beside) = beside.get_mut(child) {
                *beside = offset - middle;
            }
        }
        if let Some(outline) = outlines.get_mut(place) {
            *outline = all.under_a_root(middle);
        }
    }
    let mut places: Vec<f64> = Vec::with_capacity(parents.len());
    for (parent, beside) in parents.iter().zip(&beside) {
        let above = parent.and_then(|parent| places.get(parent).copied()).unwrap_or(0.0);
        places.push(above + beside);
    }
    let least = places.iter().copied().fold(f64::INFINITY, f64::min);
    places.iter_mut().for_each(|place| *place -= least);
    places
}

/// The contour of a branch: its reach to both sides, level by level; the deepest level first.
#[derive(Default)]
struct BranchContour {
    levels: Vec<(f64, f64)>,
}

impl BranchContour {
    /// Puts another branch beside this one, as near as it goes; how far its root is moved.
    fn put_beside(&mut self, other: Self) -> f64 {
        let pairs = self.levels.iter().rev().zip(other.levels.iter().rev());
        let offset =
            pairs.map(|((_, most), (least, _))| most - least + 1.0).fold(f64::NEG_INFINITY, f64::max);
        let offset = if offset.is_finite() { offset } else { 0.0 };
        let moved = other.levels.into_iter().map(|(least, most)| (least + offset, most + offset));
        let mut merged: Vec<(f64, f64)> = moved.collect();
        // The levels that both have; of the others, those of the deeper branch stay.
        if merged.len() < self.levels.len() {
            std::mem::swap(&mut merged, &mut self.levels);
        }
        let shallow = std::mem::take(&mut self.levels);
        for (deep, shallow) in merged.iter_mut().rev().zip(shallow.iter().rev()) {
            *deep = (deep.0.min(shallow.0), deep.1.max(shallow.1));
        }
        self.levels = merged;
        offset
    }

    /// The branches under a root that stands at `middle`, seen from it.
    fn under_a_root(mut self, middle: f64) -> Self {
        self.levels.iter_mut().for_each(|(least, most)| (*least, *most) = (*least - middle, *most - middle));
        self.levels.push((0.0, 0.0));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbors_keep_their_distance_and_parents_stand_in_the_middle() {
        // A root with two branches: one of two leaves, one a chain with two leaves at its end.
        let parents = [None, Some(0), Some(1), Some(1), Some(0), Some(4), Some(5), Some(5)];
        let at = tidy(&parents);
        assert_eq!(at, [1.25, 0.5, 0.0, 1.0, 2.0, 2.0, 1.5, 2.5]);
        assert_eq!(0.5 * (at[2] + at[3]), at[1]);
        assert_eq!(0.5 * (at[1] + at[4]), at[0]);
    }

    #[test]
    fn no_two_nodes_of_a_level_come_too_close() {
        let parents: Vec<Option<usize>> = (0..4095_usize)
            .map(|place| place.checked_sub(1).map(|before| before / (1 + place % 2).min(before.max(1))))
            .map(|parent| parent.map(|parent| parent.saturating_sub(1)))
            .collect();
        let at = tidy(&parents);
        let mut depths = vec![0_usize; parents.len()];
        let mut last: std::collections::BTreeMap<usize, Vec<f64>> = std::collections::BTreeMap::new();
        for (place, parent) in parents.iter().enumerate() {
            depths[place] = parent.map_or(0, |parent| depths[parent] + 1);
            last.entry(depths[place]).or_default().push(at[place]);
        }
        for level in last.values_mut() {
            level.sort_by(f64::total_cmp);
            assert!(level.windows(2).all(|pair| pair[1] - pair[0] > 1.0 - 1e-9));
        }
    }

    #[test]
    fn nothing_and_one_node_have_places() {
        assert!(tidy(&[]).is_empty());
        assert_eq!(tidy(&[None]), [0.0]);
    }
}
