//! The cube [-1, 1]³ as squares.

use glam::DVec3;

use crate::raster::mesh::Mesh;

/// Each face in `fineness`² squares.
pub(crate) fn cube(fineness: u32) -> Mesh {
    let mut mesh = Mesh::default();
    // The same numbers on all faces, the ends exactly ±1.
    let at = |step: u32| 2.0 * f64::from(step) / f64::from(fineness) - 1.0;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let place = |a: f64, b: f64| {
                let mut point = DVec3::splat(side);
                point[(axis + 1) % 3] = a;
                point[(axis + 2) % 3] = b;
                point
            };
            let mut normal = DVec3::ZERO;
            normal[axis] = side;
            let first = mesh.vertices.len() as u32;
            for j in 0..=fineness {
                for i in 0..=fineness {
                    mesh.add(place(at(i), at(j)), normal);
                }
            }
            let row = fineness + 1;
            for j in 0..fineness {
                for i in 0..fineness {
                    let corner = first + j * row + i;
                    mesh.faces.push([corner, corner + 1, corner + 1 + row, corner + row]);
                }
            }
        }
    }
    mesh
}
