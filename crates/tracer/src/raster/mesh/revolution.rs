//! Surfaces of revolution about the Y axis: circles of vertices joined by bands of faces.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3};

use crate::raster::mesh::Mesh;

/// A circle about the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RevolutionRing {
    pub(crate) y: f64,
    /// 0: the circle is a point.
    pub(crate) radius: f64,
    /// The normal's components away from the axis and along it.
    pub(crate) normal: DVec2,
}

/// The sphere in 2·`fineness` bands of 4·`fineness` faces.
pub(crate) fn sphere(fineness: u32) -> Mesh {
    let ring = |step: u32| {
        let quarter = f64::from(step) / f64::from(fineness);
        // The poles exactly, as the equator.
        let (sin, cos) = match quarter {
            0.0 => (0.0, 1.0),
            1.0 => (1.0, 0.0),
            2.0 => (0.0, -1.0),
            _ => (FRAC_PI_2 * quarter).sin_cos(),
        };
        RevolutionRing { y: -cos, radius: sin, normal: DVec2::new(sin, -cos) }
    };
    let rings: Vec<RevolutionRing> = (0..=2 * fineness).map(ring).collect();
    let mut mesh = Mesh::default();
    mesh.revolve(&rings, 4 * fineness);
    mesh
}

/// The closed cone, frustum or cylinder with base radius 1 and top radius `ratio`: side, base and top in `fineness`
/// bands each.
pub(crate) fn frustum(ratio: f64, fineness: u32) -> Mesh {
    let steps = || (0..=fineness).map(|step| f64::from(step) / f64::from(fineness));
    let mut mesh = Mesh::default();
    let side =
        |y: f64| RevolutionRing { y, radius: 1.0 + (ratio - 1.0) * y, normal: DVec2::new(1.0, 1.0 - ratio) };
    let mut rings: Vec<RevolutionRing> = steps().map(side).collect();
    // The end exactly as the cap's.
    rings.last_mut().into_iter().for_each(|top| top.radius = ratio);
    mesh.revolve(&rings, 4 * fineness);
    let mut cap = |y: f64, radius: f64, normal: f64| {
        let ring = |part: f64| RevolutionRing { y, radius: radius * part, normal: DVec2::new(0.0, normal) };
        mesh.revolve(&steps().map(ring).collect::<Vec<_>>(), 4 * fineness);
    };
    cap(0.0, 1.0, -1.0);
    if ratio > 0.0 {
        cap(1.0, ratio, 1.0);
    }
    mesh
}

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
