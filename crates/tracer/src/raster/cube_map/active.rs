//! The cube maps that a picture uses.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use crate::raster::cube_map::CubeMap;
use crate::raster::cube_map::proxy::ParallaxBox;
use crate::raster::gbuffer::GBufferTexel;
use crate::raster::point_shader::exact;
use crate::simd::vector::Vector;

/// The cube maps that a picture uses, by the bodies' places in the scene, and the boxes of their corrections.
#[derive(Clone, Debug, Default)]
pub(crate) struct ActiveCubeMaps {
    pub(crate) maps: BTreeMap<u32, (Arc<CubeMap>, Option<ParallaxBox>)>,
}

impl ActiveCubeMaps {
    /// The maps with their bodies.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, &CubeMap)> {
        self.maps.iter().map(|(body, (map, _))| (*body, &**map))
    }

    /// The direction in which the map of a body is asked for a reflected ray, and the map.
    pub(crate) fn looked_up(
        &self,
        texel: &GBufferTexel,
        direction: Vector<f32>,
    ) -> Option<(DVec3, &CubeMap)> {
        let (map, proxy) = self.maps.get(&texel.start.body)?;
        let direction = exact(direction);
        let corrected =
            proxy.map_or(direction, |proxy| proxy.corrected(map.center(), exact(texel.position), direction));
        Some((corrected, map))
    }

    /// What the map of its body shows to a reflected ray.
    pub(crate) fn light(&self, texel: &GBufferTexel, direction: Vector<f32>) -> Option<Vector<f32>> {
        self.looked_up(texel, direction).map(|(direction, map)| map.light(direction.as_vec3()).into())
    }
}
