//! What lies between bodies that touch.

use crate::keyed::keyed;

/// What lies between two bodies that touch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Contact {
    /// A film of air: light leaves the one body before it enters the other.
    #[default]
    Air,
    /// Nothing: light goes from the medium of the one straight to the other, as in optical contact or with a cement of no
    /// thickness.
    Cemented,
}

keyed!(Contact { Air = "air", Cemented = "cemented" });

/// What a body says of all its contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BodyContact {
    /// Nothing: the other body decides, or else the scene.
    #[default]
    Scene,
    /// A film of air, whatever the other body says.
    Air,
    /// Cemented, unless the other body says air.
    Cemented,
}

keyed!(BodyContact { Scene = "scene", Air = "air", Cemented = "cemented" });

impl Contact {
    /// What lies between two bodies of a scene that says `self`: a word of a body counts before that of the scene, and of
    /// two bodies that differ the one that says air is right.
    pub fn between(self, one: BodyContact, other: BodyContact) -> Self {
        match (one, other) {
            (BodyContact::Air, _) | (_, BodyContact::Air) => Self::Air,
            (BodyContact::Cemented, _) | (_, BodyContact::Cemented) => Self::Cemented,
            (BodyContact::Scene, BodyContact::Scene) => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_counts_before_the_scene_and_air_before_cement() {
        use BodyContact::{Air, Cemented, Scene};
        for scene in Contact::ALL {
            assert_eq!(scene.between(Scene, Scene), scene);
            assert_eq!(scene.between(Scene, Cemented), Contact::Cemented);
            assert_eq!(scene.between(Cemented, Cemented), Contact::Cemented);
            for other in BodyContact::ALL {
                assert_eq!(scene.between(Air, other), Contact::Air);
                assert_eq!(scene.between(other, Cemented), scene.between(Cemented, other));
            }
        }
    }
}
