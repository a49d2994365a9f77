//! What a method makes.

use std::collections::BTreeMap;
use std::time::Duration;

use catoptric_picture::{Picture, SizeError};

use crate::raster::cube_map::CubeMap;
use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::cube_map::cache::CubeMapUse;
use crate::raster::gbuffer::{GBuffer, GBufferLayer};
use crate::raster::pass::PassName;
use crate::transport::counts::RayCounts;
use crate::transport::scene::RenderScene;

/// A picture made by a method.
#[derive(Clone, Debug)]
pub struct MethodOutput {
    /// Linear light.
    pub picture: Picture,
    /// Rays traced; those of cube maps count as primary where they start.
    pub counts: RayCounts,
    /// How long each pass took, in the order of the work, all samples together.
    pub passes: Vec<(PassName, Duration)>,
    /// The cube maps that served, if the method uses any.
    pub cube_maps: Option<CubeMapUse>,
    pub(crate) evidence: FirstSampleBuffers,
}

impl MethodOutput {
    /// Whitted's tree, traced elsewhere in so much time.
    pub fn traced(picture: Picture, counts: RayCounts, time: Duration) -> Self {
        let passes = vec![(PassName::Trace, time)];
        Self { picture, counts, passes, cube_maps: None, evidence: FirstSampleBuffers::None }
    }

    /// A layer of the buffers behind the picture (of `ssr` and `cube-map`; other methods have none), of the first sample.
    /// `scene` is the one that was drawn.
    ///
    /// # Errors
    /// When memory is short.
    pub fn layer(&self, scene: &RenderScene, layer: GBufferLayer) -> Result<Option<Picture>, SizeError> {
        match &self.evidence {
            FirstSampleBuffers::Buffers(buffer, _) => buffer.picture(scene, layer).map(Some),
            FirstSampleBuffers::None | FirstSampleBuffers::Bodies(_) => Ok(None),
        }
    }

    /// The cube maps that served the picture, each with the place in [`Scene::bodies`](catoptric_scene::Scene::bodies) of
    /// its body.
    pub fn maps(&self, scene: &RenderScene) -> Vec<(usize, &CubeMap)> {
        match &self.evidence {
            FirstSampleBuffers::Buffers(_, maps) => {
                let maps = maps.iter().filter_map(|(body, map)| Some((scene.scene_index(body)?, map)));
                maps.collect::<BTreeMap<_, _>>().into_iter().collect()
            }
            FirstSampleBuffers::None | FirstSampleBuffers::Bodies(_) => Vec::new(),
        }
    }
}

/// What [`reasons()`](crate::raster::reasons()) needs of a drawing, of its first sample.
#[derive(Clone, Debug)]
pub(crate) enum FirstSampleBuffers {
    None,
    /// The body in each pixel, by its place in the scene.
    Bodies(Vec<u32>),
    /// What the pixels show and reflect, and the maps that they looked into.
    Buffers(Box<GBuffer>, ActiveCubeMaps),
}
