//! A scene in the memory of a card.

use catoptric_tracer::shaders::{SceneArrays, SceneContents, ShaderSpecialization};
use catoptric_tracer::{RenderCamera, RenderScene};

use crate::card::Gpu;
use crate::error::GpuError;
use crate::scene_images::GpuSceneImages;
use crate::upload::GpuArray;

/// A scene in the memory of a card. It follows edits and sends only what they changed.
pub struct GpuScene {
    bodies: GpuArray,
    scene_order: GpuArray,
    boxes: GpuArray,
    materials: GpuArray,
    solids: GpuArray,
    lights: GpuArray,
    pub(crate) pictures: GpuSceneImages,
    /// What bodies and boxes are up to date with, and whether the order of volumes is known.
    state: Option<(u64, bool)>,
    contents: SceneContents,
}

impl GpuScene {
    /// Makes room for a scene.
    ///
    /// # Errors
    /// When the card is lost or has no memory at all.
    pub async fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        Ok(Self {
            bodies: GpuArray::empty(gpu, "bodies").await?,
            scene_order: GpuArray::empty(gpu, "places of bodies").await?,
            boxes: GpuArray::empty(gpu, "boxes").await?,
            materials: GpuArray::compared(gpu, "materials").await?,
            solids: GpuArray::compared(gpu, "solids").await?,
            lights: GpuArray::compared(gpu, "lights").await?,
            pictures: GpuSceneImages::empty(gpu).await?,
            state: None,
            contents: SceneContents::default(),
        })
    }

    /// Sends what is different from the last time, and returns how many bytes that were.
    ///
    /// # Errors
    /// When the scene is too large for the card, or the card is lost; the next call sends everything.
    pub async fn follow(
        &mut self,
        gpu: &Gpu,
        render_scene: &RenderScene,
        camera: &RenderCamera,
    ) -> Result<u64, GpuError> {
        let last = self.state.take();
        let arrays = SceneArrays(render_scene);
        let changes = last.and_then(|(state, ranked)| Some((render_scene.changes_since(state)?, ranked)));
        let mut sum = 0;
        let mut is_ranked = false;
        match changes {
            Some((changes, was_ranked)) => {
                self.contents.follow(render_scene, &changes);
                let [bodies, boxes, order] = arrays.parts(&changes);
                sum += self.bodies.write_parts(gpu, arrays.bodies(), &bodies).await?;
                sum += self.boxes.write_parts(gpu, arrays.boxes(), &boxes).await?;
                let ranked = self.wants_ranks(render_scene, camera);
                let is_same = changes.bodies.is_empty() && (was_ranked || !ranked);
                if !is_same {
                    let all = arrays.scene_order(ranked);
                    sum += if ranked {
                        self.scene_order.write(gpu, &all).await?
                    } else {
                        self.scene_order.write_parts(gpu, &all, &order).await?
                    };
                }
                is_ranked = ranked || (was_ranked && is_same);
            }
            None => {
                self.contents = SceneContents::of(render_scene);
                is_ranked = self.wants_ranks(render_scene, camera) || is_ranked;
                sum += self.bodies.write(gpu, arrays.bodies()).await?;
                sum += self.boxes.write(gpu, arrays.boxes()).await?;
                sum += self.scene_order.write(gpu, &arrays.scene_order(is_ranked)).await?;
            }
        }
        sum += self.materials.write(gpu, &arrays.materials()).await?;
        sum += self.solids.write(gpu, &arrays.solids()).await?;
        sum += self.lights.write(gpu, &arrays.lights()).await?;
        sum += self.pictures.follow(gpu, arrays.pictures()).await?;
        self.state = Some((render_scene.state(), is_ranked));
        Ok(sum)
    }

    fn wants_ranks(&self, render_scene: &RenderScene, camera: &RenderCamera) -> bool {
        ShaderSpecialization::of(&self.contents, render_scene, camera)
            .is_ok_and(|special| special.asks_each_start)
    }

    /// The shader that it needs.
    ///
    /// # Errors
    /// What in the scene the shaders cannot draw.
    pub fn specialization(
        &self,
        render_scene: &RenderScene,
        camera: &RenderCamera,
    ) -> Result<ShaderSpecialization, GpuError> {
        Ok(ShaderSpecialization::of(&self.contents, render_scene, camera)?)
    }

    /// The arrays but the pictures, in the order of the shader's bindings.
    pub(crate) fn bindings(&self) -> [wgpu::BindingResource<'_>; 6] {
        [&self.bodies, &self.scene_order, &self.boxes, &self.materials, &self.solids, &self.lights]
            .map(GpuArray::binding)
    }
}
