//! The traced truth of a pixel, in parts.

use std::sync::atomic::AtomicBool;

use glam::Vec3;

use crate::geometry::ray::{Ray, RayOrigin};
use crate::raster::point_shader::{PointShader, ShadingPoint, color_at, exact, vector};
use crate::raster::reasons::ReasonInput;
use crate::raster::settings::LightModel;
use crate::simd::vector::Vector;
use crate::transport::control::RenderControl;
use crate::transport::integrator::whitted::WhittedIntegrator;
use crate::transport::record::{RayKind, RayRecord};
use crate::transport::scene::RenderScene;

/// The light of a pixel, by what brings it.
pub(crate) struct PixelParts {
    /// The primary ray.
    pub(crate) primary: RayRecord,
    /// The ray reflected where that meets something.
    pub(crate) mirrored: Option<RayRecord>,
    /// What the tree behind the reflected ray brings, without its first hit.
    pub(crate) second: Vec3,
    /// What is seen through the surface.
    pub(crate) refracted: Vec3,
}

impl PixelParts {
    /// The light of the reflected ray's own hit.
    pub(crate) fn first(&self) -> Vec3 {
        self.mirrored.as_ref().map_or(Vec3::ZERO, |ray| ray.light)
    }
}

/// One thread's means of finding the truth.
pub(crate) struct ReferencePixel<'a> {
    pub(crate) probe: PointShader<'a>,
    whitted: WhittedIntegrator<'a>,
    others: Option<WhittedIntegrator<'a>>,
}

impl<'a> ReferencePixel<'a> {
    /// So many rays of a tree are looked at; what the rest brings is little.
    const MOST_RAYS: usize = 4096;

    pub(crate) fn new(case: &ReasonInput<'a>, control: &'a RenderControl) -> Self {
        let cancel: &AtomicBool = &control.cancel;
        Self {
            probe: PointShader::new(case.scene, case.camera),
            whitted: WhittedIntegrator::through(case.scene, case.camera, cancel),
            others: case.others.map(|others| WhittedIntegrator::new(others, cancel)),
        }
    }

    /// Traces the tree behind a primary ray.
    pub(crate) fn parts(&mut self, ray: Ray) -> Option<PixelParts> {
        let tree = self.whitted.tree(ray, Self::MOST_RAYS);
        let (primary, rest) = tree.split_first()?;
        let (mut mirrored, mut second, mut refracted) = (None, Vec3::ZERO, Vec3::ZERO);
        // For each ray of the tree, whether it belongs to the reflected branch.
        let mut branch = vec![false; tree.len()];
        for (ray, index) in rest.iter().zip(1..) {
            let parent = ray.parent.unwrap_or(0);
            let is_mirrored = match parent {
                0 => ray.kind == RayKind::Reflected,
                _ => branch.get(parent).copied().unwrap_or(false),
            };
            branch.get_mut(index).into_iter().for_each(|slot| *slot = is_mirrored);
            if !is_mirrored {
                refracted += ray.light;
            } else if parent == 0 {
                mirrored = Some(ray.clone());
            } else {
                second += ray.light;
            }
        }
        Some(PixelParts { primary: primary.clone(), mirrored, second, refracted })
    }

    /// What comes along a ray from what the cube map shows.
    pub(crate) fn light_of_others(&mut self, ray: Ray) -> Vec3 {
        let others = self.others.as_mut();
        others
            .map_or(Vec3::ZERO, |others| others.tree(ray, Self::MOST_RAYS).iter().map(|ray| ray.light).sum())
    }

    /// The local terms where `ray` meets something, seen from `viewer` (a direction of length 1); without a hit, the
    /// background.
    pub(crate) fn local(
        &mut self,
        scene: &RenderScene,
        ray: &RayRecord,
        viewer: Option<Vector<f32>>,
        model: LightModel,
        shadows: bool,
    ) -> Vec3 {
        let Some(hit) = ray.hit else { return scene.sky.along(ray.ray.alone().direction).into() };
        let rays = ray.ray.alone();
        let line = (rays.origin, rays.direction);
        let found = scene.geometry.surface_point(hit.hit.body, line, hit.hit.t, hit.hit.leaving);
        let point = ShadingPoint {
            start: RayOrigin { body: hit.hit.body, inwards: hit.hit.leaving },
            position: found.in_world,
            normal: found.normal,
            to_viewer: viewer.unwrap_or_else(|| -vector(exact(rays.direction))),
            pixel: 0,
        };
        let light = self.probe.light(&point, model, shadows);
        light.with_color(color_at(scene, hit.hit.body, &found)).into()
    }
}
