//! Surfaces of revolution about the Y axis: circles of vertices joined by bands of faces.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::geometry::shape::solid::RevolutionRing;
use crate::raster::mesh::Mesh;

impl Mesh {
    /// Adds the bands between neighboring rings, each of `segments` faces.
    pub(crate) fn revolve(&mut self, rings: &[RevolutionRing], segments: u32) {
        let firsts: Vec<u32> = rings.iter().map(|ring| self.add_ring(ring, segments)).collect();
        let pairs = rings.iter().zip(&firsts);
        for ((low, &a), (high, &b)) in pairs.clone().zip(pairs.skip(1)) {
            for segment in 0..segments {
                let next = (segment + 1) % segments;
                match (low.radius == 0.0, high.radius == 0.0) {
                    (false, false) => self.faces.push([a + segment, a + next, b + next, b + segment]),
                    (true, false) => self.faces.push([a + segment, b + next, b + segment, b + segment]),
                    (false, true) => self.faces.push([a + segment, a + next, b + segment, b + segment]),
                    (true, true) => {}
                }
            }
        }
    }

    /// Adds the vertices of a ring. Those of a point differ in their normals: at the tip of a cone each face has that of
    /// its middle.
    fn add_ring(&mut self, ring: &RevolutionRing, segments: u32) -> u32 {
        let first = self.vertices.len() as u32;
        let middle = if ring.radius == 0.0 { 0.5 } else { 0.0 };
        for segment in 0..segments {
            let (sin, cos) = (TAU * (f64::from(segment) + middle) / f64::from(segments)).sin_cos();
            let point = DVec3::new(ring.radius * cos, ring.y, ring.radius * sin);
            let normal = DVec3::new(ring.normal.x * cos, ring.normal.y, ring.normal.x * sin);
            self.add(point, normal);
        }
        first
    }
}
