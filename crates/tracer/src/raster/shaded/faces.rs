//! The faces of bodies in the world.

use std::collections::HashMap;
use std::sync::Arc;

use catoptric_scene::VisibleSide;
use glam::{DMat3, DVec3};

use crate::geometry::body::RenderBody;
use crate::geometry::ray::RayOrigin;
use crate::geometry::shape::ShapeKind;
use crate::raster::mesh::Mesh;
use crate::raster::mesh::patch::PlanePatch;
use crate::raster::point_shader::vector;
use crate::simd::vector::Vector;
use crate::transport::camera::RenderCamera;
use crate::transport::scene::RenderScene;

/// A vertex in the world.
#[derive(Clone, Copy)]
pub(crate) struct WorldVertex {
    pub(crate) position: DVec3,
    /// Outward, of length 1.
    pub(crate) normal: DVec3,
    pub(crate) in_body: Vector<f32>,
    pub(crate) body: u32,
    /// Whether faces around it show their outer side, and their inner side.
    pub(crate) seen: [bool; 2],
}

/// A face in the world, and the side of it that is seen.
pub(crate) struct WorldFace {
    /// Numbers of vertices; of a triangle the last counts twice.
    pub(crate) corners: [u32; 4],
    /// The mean of its corners.
    pub(crate) middle: DVec3,
    /// Of length 1, on the side that is seen.
    pub(crate) normal: DVec3,
    pub(crate) start: RayOrigin,
    /// Of a part of a joined body: the normal out of the part. It is seen only where it bounds the whole.
    pub(crate) outward: Option<DVec3>,
}

/// The faces of some bodies.
#[derive(Default)]
pub(crate) struct FaceList {
    pub(crate) vertices: Vec<WorldVertex>,
    pub(crate) faces: Vec<WorldFace>,
}

/// What a simple body is to the one that is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// That itself.
    Alone,
    /// A part of it.
    Part,
    /// The part of which it is the surface.
    Surface,
}

/// Meshes of shapes that many bodies share, by their kinds.
#[derive(Default)]
pub(crate) struct MeshCache(HashMap<u8, Arc<Mesh>>);

impl MeshCache {
    fn of(&mut self, body: &RenderBody, camera: &RenderCamera, fineness: u32) -> Arc<Mesh> {
        let shape = body.canonical();
        let make = || Arc::new(Mesh::of(shape, fineness, PlanePatch::seen(body, camera)));
        match shape.kind {
            // Each plane and each cone has faces of its own.
            ShapeKind::Plane | ShapeKind::Cone => make(),
            _ => Arc::clone(self.0.entry(body.kind).or_insert_with(make)),
        }
    }
}

impl FaceList {
    /// Adds the faces of a body that the camera may see.
    pub(crate) fn add(
        &mut self,
        scene: &RenderScene,
        camera: &RenderCamera,
        index: u32,
        fineness: u32,
        meshes: &mut MeshCache,
    ) {
        // Of a body that is seen from outside only the side that faces the eye is seen.
        let is_outside = camera.eye().is_some_and(|eye| !scene.geometry.contains(index, eye));
        let Some(joined) = scene.geometry.joined(index) else {
            let is_plane = scene.geometry.body(index).canonical().kind == ShapeKind::Plane;
            let hidden = (is_outside && !is_plane).then_some(true);
            return self.add_simple(scene, camera, index, (hidden, Role::Alone), fineness, meshes);
        };
        if joined.tree.is_surface() {
            let hidden = match joined.tree.visible_side() {
                VisibleSide::Both => None,
                VisibleSide::Outer => Some(true),
                VisibleSide::Inner => Some(false),
            };
            return self.add_simple(scene, camera, joined.first, (hidden, Role::Surface), fineness, meshes);
        }
        for (part, index) in (0..).zip(joined.parts()) {
            // Of what is cut away the inner side is seen.
            let hidden = is_outside.then_some(!joined.tree.is_inverted(part));
            self.add_simple(scene, camera, index, (hidden, Role::Part), fineness, meshes);
        }
    }

    /// Adds the faces of a simple body, or of a part, but for those whose inner side, or outer side, `hidden` tells to be
    /// the one that is seen.
    fn add_simple(
        &mut self,
        scene: &RenderScene,
        camera: &RenderCamera,
        index: u32,
        (hidden, role): (Option<bool>, Role),
        fineness: u32,
        meshes: &mut MeshCache,
    ) {
        let body = scene.geometry.body(index);
        let mesh = meshes.of(body, camera, fineness);
        let first = self.vertices.len() as u32;
        self.add_vertices(body, index, &mesh);
        let has_caps = body.canonical().kind.has_caps();
        for corners in &mesh.faces {
            if role == Role::Surface && has_caps && mesh.is_on_cap(corners) {
                continue;
            }
            let corners = corners.map(|corner| corner + first);
            let Some(mut face) = self.face(corners, index) else { continue };
            face.outward = (role != Role::Alone).then_some(face.normal);
            face.start.inwards = face.normal.dot(camera.toward_viewer(face.middle)) < 0.0;
            if hidden == Some(face.start.inwards) {
                continue;
            }
            if face.start.inwards {
                face.normal = -face.normal;
            }
            for corner in corners {
                if let Some(vertex) = self.vertices.get_mut(corner as usize) {
                    vertex.seen[usize::from(face.start.inwards)] = true;
                }
            }
            self.faces.push(face);
        }
    }

    fn add_vertices(&mut self, body: &RenderBody, index: u32, mesh: &Mesh) {
        let matrix = |rows: [[f32; 3]; 3]| DMat3::from_cols_array_2d(&rows.map(|row| row.map(f64::from)));
        let world_from_body = matrix(body.world_from_body).transpose();
        // Normals go back by the inverse transpose.
        let normal_from_body = matrix(body.body_from_world);
        let origin = DVec3::from(body.origin.map(f64::from));
        // The pattern of a body in double precision looks at points of the world.
        let has_solid = body.sees_solid_in_world();
        self.vertices.extend(mesh.vertices.iter().map(|vertex| {
            let position = origin + world_from_body * vertex.point;
            WorldVertex {
                position,
                normal: (normal_from_body * vertex.normal).normalize_or(DVec3::Y),
                in_body: vector(if has_solid { position } else { vertex.point }),
                body: index,
                seen: [false; 2],
            }
        }));
    }

    /// The outer side of the face of these corners.
    fn face(&self, corners: [u32; 4], body: u32) -> Option<WorldFace> {
        let [a, b, c, d] = corners.map(|corner| self.vertices.get(corner as usize));
        let [a, b, c, d] = [a?, b?, c?, d?];
        let three = a.position + b.position + c.position;
        let is_triangle = corners[2] == corners[3];
        let middle = if is_triangle { three / 3.0 } else { (three + d.position) / 4.0 };
        let across = (c.position - a.position).cross(d.position - b.position);
        let outward = across.dot(a.normal + b.normal + c.normal).signum();
        let normal = (across * outward).normalize_or(a.normal);
        Some(WorldFace { corners, middle, normal, start: RayOrigin { body, inwards: false }, outward: None })
    }
}
