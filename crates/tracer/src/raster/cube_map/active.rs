//! The cube maps that a picture uses.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use crate::raster::cube_map::CubeMap;
use crate::raster::cube_map::proxy::ParallaxBox;
use crate::raster::gbuffer::GBufferTexel;
use crate::raster::point_shader::{exact, vector};
use crate::raster::projection::vector64;
use crate::simd::Width;
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

    /// Writes what the maps of their bodies show to reflected rays of `lanes`; which of them have a map.
    #[inline(always)]
    pub(crate) fn light_all<W: Width, const N: usize>(
        &self,
        w: W,
        (bodies, positions): (&[u32; N], &[Vector<f32>; N]),
        directions: &[Vector<f32>; N],
        lanes: u32,
        light: &mut [Vector<f32>; N],
    ) -> u32 {
        let (mut left, mut mapped) = (lanes, 0);
        while left != 0 {
            let body = bodies[left.trailing_zeros() as usize % N];
            let mut same = 0;
            for (lane, other) in bodies.iter().enumerate() {
                same |= u32::from(*other == body) << lane;
            }
            let same = same & left;
            left &= !same;
            let Some((map, proxy)) = self.maps.get(&body) else { continue };
            mapped |= same;
            let mut directions = *directions;
            if let Some(proxy) = proxy {
                let (mut points, mut along) = ([DVec3::ZERO; N], [DVec3::ZERO; N]);
                for lane in 0..N {
                    (points[lane], along[lane]) = (exact(positions[lane]), exact(directions[lane]));
                }
                let Vector { x, y, z } = proxy.corrected_all(map.center(), vector64(points), vector64(along));
                for (lane, direction) in directions.iter_mut().enumerate() {
                    *direction = vector(DVec3::new(x.0[lane], y.0[lane], z.0[lane]));
                }
            }
            let mut found = [Vector { x: 0.0, y: 0.0, z: 0.0 }; N];
            for (directions, found) in directions.chunks(W::LANES).zip(found.chunks_mut(W::LANES)) {
                map.light_all(w, directions, found);
            }
            for lane in 0..N {
                if same >> lane & 1 == 1 {
                    light[lane] = found[lane];
                }
            }
        }
        mapped
    }
}
