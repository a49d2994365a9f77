//! Names that no other thing of the kind has.

use std::collections::{HashMap, HashSet};

use catoptric_scene::{Body, List, MaterialChoice, Scene};

/// The names that are in use.
pub(crate) struct UsedNames {
    taken: HashSet<String>,
    /// For a name without its number, the number to try next.
    next: HashMap<String, u64>,
}

impl UsedNames {
    pub(crate) fn of<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        Self { taken: names.map(str::to_owned).collect(), next: HashMap::new() }
    }

    pub(crate) fn of_materials(scene: &Scene) -> Self {
        Self::of(scene.materials.iter().map(|named| named.name.as_str()))
    }

    /// `wanted`, or when it is taken, the same with the least free number from 2 on; taken from now on. An empty name
    /// stays empty, and is never taken.
    pub(crate) fn take(&mut self, wanted: &str) -> String {
        if wanted.is_empty() || self.taken.insert(wanted.to_owned()) {
            return wanted.to_owned();
        }
        let base = base(wanted);
        let next = self.next.entry(base.to_owned()).or_insert(2);
        loop {
            let name = format!("{base} {next}");
            *next += 1;
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// The names of the materials that bodies and their parts are made of.
pub(crate) fn used_materials(bodies: &List<Body>) -> HashSet<&str> {
    bodies.iter().flat_map(Body::materials).filter_map(MaterialChoice::name).collect()
}

/// A name without the number that was added to make it unique: `ball` of `ball 2`.
pub(crate) fn base(name: &str) -> &str {
    let Some((base, number)) = name.rsplit_once(' ') else { return name };
    let is_number = number.bytes().all(|byte| byte.is_ascii_digit());
    let is_added = is_number && !number.starts_with('0') && number != "1" && !number.is_empty();
    if is_added && !base.trim().is_empty() { base } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_from_two_and_fill_gaps() {
        let mut names = UsedNames::of(["ball", "ball 3", "7", "cube 2", ""].into_iter());
        assert_eq!(names.take("ball"), "ball 2");
        assert_eq!(names.take("ball"), "ball 4");
        assert_eq!(names.take("ball 2"), "ball 5");
        assert_eq!(names.take("cube"), "cube");
        assert_eq!(names.take("7"), "7 2");
        assert_eq!(names.take(""), "");
        assert_eq!(names.take(""), "");
        assert_eq!(names.take("new"), "new");
    }

    #[test]
    fn only_added_numbers_are_taken_off() {
        for (name, expected) in [
            ("ball 2", "ball"),
            ("ball 12", "ball"),
            ("ball 1", "ball 1"),
            ("ball 02", "ball 02"),
            (" 2", " 2"),
            ("a ", "a "),
            ("a b", "a b"),
        ] {
            assert_eq!(base(name), expected);
        }
    }
}
