//! Meshes are closed, lie on their surfaces, and have their normals.

use std::collections::HashMap;

use super::*;
use crate::simd::vector::Vector;

fn shapes() -> Vec<CanonicalShape> {
    let of = |kind, cone_ratio| CanonicalShape { kind, cone_ratio };
    vec![
        of(ShapeKind::Sphere, 0.0),
        of(ShapeKind::Cube, 0.0),
        of(ShapeKind::Cylinder, 1.0),
        of(ShapeKind::Cone, 0.0),
        of(ShapeKind::Cone, 0.4),
        of(ShapeKind::Paraboloid, 0.0),
    ]
}

fn mesh(shape: CanonicalShape, fineness: u32) -> Mesh {
    let render_scene =
        crate::transport::scene::RenderScene::build(&catoptric_scene::Scene::default()).unwrap();
    let body = bytemuck::Zeroable::zeroed();
    Mesh::of(shape, fineness, PlanePatch::seen(&body, render_scene.camera()))
}

/// The corners of a face, each once.
fn corners(mesh: &Mesh, face: &MeshFace) -> Vec<MeshVertex> {
    let count = if face[2] == face[3] { 3 } else { 4 };
    face[..count].iter().map(|&corner| mesh.vertices[corner as usize]).collect()
}

#[test]
fn every_edge_belongs_to_two_faces_bit_by_bit() {
    for shape in shapes() {
        for fineness in [1, 2, 5] {
            let mesh = mesh(shape, fineness);
            let mut edges: HashMap<_, u32> = HashMap::new();
            for face in &mesh.faces {
                let corners = corners(&mesh, face);
                for (index, corner) in corners.iter().enumerate() {
                    // -0 is 0.
                    let bits = |v: &MeshVertex| (v.point + DVec3::ZERO).to_array().map(f64::to_bits);
                    let (a, b) = (bits(corner), bits(&corners[(index + 1) % corners.len()]));
                    assert_ne!(a, b, "{shape:?}: an edge without length");
                    *edges.entry((a.min(b), a.max(b))).or_default() += 1;
                }
            }
            assert!(edges.values().all(|&count| count == 2), "{shape:?} in {fineness} parts is not closed");
        }
    }
}

#[test]
fn vertices_lie_on_the_surface_and_normals_point_outwards() {
    for shape in shapes() {
        for vertex in &mesh(shape, 6).vertices {
            let inside: Vector<f32> = (vertex.point * (1.0 - 1e-5) + DVec3::Y * 1e-6).as_vec3().into();
            let outside: Vector<f32> = (vertex.point + vertex.normal.normalize() * 1e-4).as_vec3().into();
            assert!(!shape.contains(outside), "{shape:?}: {vertex:?}");
            assert!(shape.contains(inside) || shape.kind == ShapeKind::Cone, "{shape:?}: {vertex:?}");
        }
    }
}

#[test]
fn faces_are_plane() {
    for shape in shapes() {
        let mesh = mesh(shape, 7);
        for face in &mesh.faces {
            let points: Vec<DVec3> = corners(&mesh, face).iter().map(|vertex| vertex.point).collect();
            if let [a, b, c, d] = points[..] {
                let volume = (b - a).cross(c - a).dot(d - a).abs();
                assert!(volume < 1e-15, "{shape:?}: {volume}");
            }
        }
    }
}

#[test]
fn the_count_of_faces_is_as_documented() {
    let count = |shape: usize| mesh(shapes()[shape], 8).faces.len();
    let known = [16 * 32, 6 * 64, 3 * 8 * 32, 2 * 8 * 32];
    assert_eq!([count(0), count(1), count(2), count(3)], known);
    assert_eq!(count(5), 2 * 8 * 32);
}
