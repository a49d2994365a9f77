//! What edits have changed of a scene's arrays, so that a copy of them elsewhere can follow.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// A state of a scene's arrays, and the edits that led to it.
#[derive(Clone, Debug)]
pub(crate) struct EditLog {
    state: u64,
    edits: VecDeque<EditLogEntry>,
}

#[derive(Clone, Debug)]
struct EditLogEntry {
    /// The state before it.
    from: u64,
    changes: SceneChanges,
}

/// The parts of a scene's arrays that are different from what they were.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneChanges {
    /// Places of bodies.
    pub bodies: Vec<Range<u32>>,
    /// Nodes of the hierarchy.
    pub nodes: Vec<u32>,
}

impl EditLog {
    /// So many edits are remembered; who is further behind takes everything.
    const MOST: usize = 64;

    /// The log of new arrays. No other ones have their state.
    pub(crate) fn new() -> Self {
        Self { state: new_state(), edits: VecDeque::new() }
    }

    pub(crate) fn add(&mut self, changes: SceneChanges) {
        if self.edits.len() == Self::MOST {
            self.edits.pop_front();
        }
        self.edits.push_back(EditLogEntry { from: self.state, changes });
        self.state = new_state();
    }

    pub(crate) fn state(&self) -> u64 {
        self.state
    }

    /// What has changed since a state; `None` if that is not known.
    pub(crate) fn since(&self, state: u64) -> Option<SceneChanges> {
        if state == self.state {
            return Some(SceneChanges::default());
        }
        let first = self.edits.iter().position(|edit| edit.from == state)?;
        let mut all = SceneChanges::default();
        for edit in self.edits.iter().skip(first) {
            all.bodies.extend(edit.changes.bodies.iter().cloned());
            all.nodes.extend(&edit.changes.nodes);
        }
        all.bodies.sort_unstable_by_key(|range| (range.start, range.end));
        all.bodies.dedup();
        all.nodes.sort_unstable();
        all.nodes.dedup();
        Some(all)
    }
}

/// A number that no state had before: copies of a scene may be edited apart.
fn new_state() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(body: u32) -> SceneChanges {
        SceneChanges { bodies: vec![body..body + 1, 9..10], nodes: vec![0, body] }
    }

    #[test]
    fn changes_add_up_and_copies_part() {
        let mut log = EditLog::new();
        let start = log.state();
        assert_eq!(log.since(start), Some(SceneChanges::default()));
        log.add(change(4));
        let middle = log.state();
        let mut other = log.clone();
        log.add(change(2));
        other.add(change(7));
        let all = log.since(start).unwrap();
        assert_eq!((all.bodies, all.nodes), (vec![2..3, 4..5, 9..10], vec![0, 2, 4]));
        assert_eq!(log.since(middle), Some(change(2)));
        assert_eq!(log.since(other.state()), None);
        for _ in 0..=EditLog::MOST {
            log.add(change(1));
        }
        assert_eq!(log.since(middle), None);
    }
}
