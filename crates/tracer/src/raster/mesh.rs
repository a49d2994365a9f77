//! Bodies as flat faces, in their own frames.
//!
//! Vertices lie on the surface and carry its true normals; where the surface has an edge, each side has vertices of its
//! own, at the same place bit by bit, so that nothing shows through between faces.

pub(crate) mod cube;
pub(crate) mod patch;
pub(crate) mod revolution;

use glam::DVec3;

use crate::geometry::shape::{CanonicalShape, ShapeKind};
use crate::raster::mesh::patch::PlanePatch;

/// A vertex in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MeshVertex {
    pub(crate) point: DVec3,
    /// Outward normal, of any length above 0.
    pub(crate) normal: DVec3,
}

/// A plane face of three or four corners, which go around it; of a triangle the last counts twice.
pub(crate) type MeshFace = [u32; 4];

/// The faces of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<MeshVertex>,
    pub(crate) faces: Vec<MeshFace>,
}

impl Mesh {
    /// The canonical shape with a quarter of a circle, or the edge of a cube, in `fineness` parts; of a plane the
    /// patch that can be seen.
    pub(crate) fn of(shape: CanonicalShape, fineness: u32, patch: PlanePatch) -> Self {
        let curves = shape.kind.solid().profile(f64::from(shape.cone_ratio), fineness);
        match (curves, shape.kind) {
            (Some(curves), _) => {
                let mut mesh = Self::default();
                curves.iter().for_each(|rings| mesh.revolve(rings, 4 * fineness));
                mesh
            }
            (None, ShapeKind::Plane) => patch.mesh(fineness),
            (None, _) => cube::cube(fineness),
        }
    }

    /// Whether a face of a shape with caps belongs to one: its vertices look along the axis.
    pub(crate) fn is_on_cap(&self, face: &MeshFace) -> bool {
        let normal = |corner: &u32| self.vertices.get(*corner as usize).map(|vertex| vertex.normal);
        face.iter().filter_map(normal).all(|normal| normal.x == 0.0 && normal.z == 0.0)
    }

    fn add(&mut self, point: DVec3, normal: DVec3) -> u32 {
        self.vertices.push(MeshVertex { point, normal });
        self.vertices.len() as u32 - 1
    }
}

#[cfg(test)]
mod tests;
