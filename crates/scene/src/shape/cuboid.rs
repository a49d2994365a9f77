//! The box about the origin.

use glam::{DVec3, dvec3};

use crate::shape::Solid;

pub(super) struct Cuboid {
    /// Half the edge lengths.
    pub(super) half: DVec3,
}

impl Solid for Cuboid {
    fn extent(&self) -> [DVec3; 2] {
        [-self.half, self.half]
    }

    fn support(&self, direction: DVec3) -> f64 {
        self.half.dot(direction.abs())
    }

    fn ball(&self, scale: DVec3) -> (DVec3, f64) {
        (DVec3::ZERO, (self.half * scale).length())
    }

    /// The twelve edges.
    fn outline(&self, _eye: DVec3) -> Vec<Vec<DVec3>> {
        let signs = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
        let edge = |from: DVec3, to: DVec3| vec![from * self.half, to * self.half];
        let edges = |a: f64, b: f64| {
            [
                edge(dvec3(-1.0, a, b), dvec3(1.0, a, b)),
                edge(dvec3(a, -1.0, b), dvec3(a, 1.0, b)),
                edge(dvec3(a, b, -1.0), dvec3(a, b, 1.0)),
            ]
        };
        signs.into_iter().flat_map(|(a, b)| edges(a, b)).collect()
    }
}
