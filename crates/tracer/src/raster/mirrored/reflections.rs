//! What reflected rays bring, many rays side by side.

use glam::DVec3;

use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::gbuffer::{GBuffer, GBufferTexel};
use crate::raster::mirrored::{ReflectionSources, reflecting};
use crate::raster::point_shader::exact;
use crate::raster::projection::{ScreenProjection, vector64};
use crate::raster::screen::{MarchOutcome, ScreenMarcher};
use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, SimdKernel, Width};
use crate::transport::camera::RenderCamera;
use crate::transport::scene::RenderScene;
use crate::transport::surface::{mend_unit, reflect};

/// So many rays go side by side, whatever the width: a multiple of all widths that they are in.
const RAYS: usize = 16;

const NOTHING: Vector<f32> = Vector { x: 0.0, y: 0.0, z: 0.0 };

/// Where reflected rays of a sample find their light.
pub(crate) struct Reflections<'a> {
    scene: &'a RenderScene,
    buffer: &'a GBuffer,
    projection: ScreenProjection,
    screen: Option<ScreenMarcher<'a>>,
    maps: &'a ActiveCubeMaps,
}

impl<'a> Reflections<'a> {
    pub(crate) fn new(
        (scene, camera): (&'a RenderScene, &RenderCamera),
        sources: ReflectionSources<'a>,
        buffer: &'a GBuffer,
        maps: &'a ActiveCubeMaps,
    ) -> Self {
        let screen = sources.screen.map(|settings| ScreenMarcher::new(buffer, camera, settings));
        let projection = ScreenProjection::new(camera, buffer.frame.size());
        Self { scene, buffer, projection, screen, maps }
    }
}

/// The reflections of a row of pixels.
pub(crate) struct ReflectionKernel<'k> {
    pub(crate) reflections: &'k Reflections<'k>,
    pub(crate) row: usize,
    /// What the reflected rays bring.
    pub(crate) reflected: &'k mut [Vector<f32>],
    /// To which the light of the pixels is added.
    pub(crate) sums: &'k mut [DVec3],
}

impl SimdKernel for ReflectionKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, w: W) {
        let Self { reflections, row, reflected, sums } = self;
        let Reflections { scene, buffer, .. } = *reflections;
        let first = row * buffer.frame.width;
        let texels = buffer.texels.get(first..).unwrap_or_default();
        let lit = buffer.lit.get(first..).unwrap_or_default();
        let mut shares = ShareOfBody { scene, last: None };
        let mut waiting = WaitingPixels { columns: [0; RAYS], count: 0 };
        reflected.fill(NOTHING);
        let columns = texels.len().min(reflected.len());
        for column in 0..=columns {
            let texel = texels.get(column).filter(|_| column < columns);
            if texel.is_some_and(|texel| shares.of(texel) > 0.0) {
                waiting.columns[waiting.count % RAYS] = column;
                waiting.count += 1;
            }
            // Called in one place only: each call is a copy of long code.
            if waiting.count == RAYS || (texel.is_none() && waiting.count > 0) {
                reflections.find(w, texels, &waiting, reflected);
                waiting.count = 0;
            }
        }
        for ((texel, lit), (found, sum)) in texels.iter().zip(lit).zip(reflected.iter().zip(sums)) {
            *sum += exact(*lit + *found * shares.of(texel));
        }
    }
}

/// Looks up k_r of texels: neighboring pixels mostly show the same body.
struct ShareOfBody<'a> {
    scene: &'a RenderScene,
    last: Option<(u32, f32)>,
}

impl ShareOfBody<'_> {
    /// k_r, 0 if nothing is reflected.
    #[inline(always)]
    fn of(&mut self, texel: &GBufferTexel) -> f32 {
        match self.last {
            Some((body, share)) if body == texel.start.body => share,
            _ => {
                let share = reflecting(self.scene, texel).unwrap_or(0.0);
                self.last = Some((texel.start.body, share));
                share
            }
        }
    }
}

/// Pixels of a row whose reflections are to be found.
struct WaitingPixels {
    columns: [usize; RAYS],
    count: usize,
}

impl Reflections<'_> {
    /// Writes what the reflected rays of some pixels of a row bring.
    #[inline(always)]
    fn find<W: Width>(
        &self,
        w: W,
        row: &[GBufferTexel],
        pixels: &WaitingPixels,
        reflected: &mut [Vector<f32>],
    ) {
        let mut texels = [&GBufferTexel::EMPTY; RAYS];
        for (texel, &column) in texels.iter_mut().zip(&pixels.columns).take(pixels.count) {
            *texel = row.get(column).unwrap_or(&GBufferTexel::EMPTY);
        }
        let lanes = ((1_u64 << pixels.count) - 1) as u32;
        let directions = self.directions(w, texels);
        let mut light = [NOTHING; RAYS];
        let mut left = lanes;
        if let Some(screen) = &self.screen {
            let mut along = [DVec3::ZERO; RAYS];
            for lane in 0..RAYS {
                along[lane] = exact(directions[lane]);
            }
            let outcomes = screen.march_all(texels, vector64(along), lanes);
            for lane in 0..RAYS {
                if let MarchOutcome::Met(at) = outcomes[lane] {
                    light[lane] = screen.light(at);
                    left &= !(1 << lane);
                }
            }
        }
        left &= !self.maps.light_all(w, texels, &directions, left, &mut light);
        for lane in 0..pixels.count.min(RAYS) {
            if left >> lane & 1 == 1 {
                light[lane] = self.scene.sky.along(directions[lane]);
            }
            if let Some(found) = reflected.get_mut(pixels.columns[lane]) {
                *found = light[lane];
            }
        }
    }

    /// The directions of the rays that are reflected to the viewer, as [`GBufferTexel::reflected`] has them.
    #[inline(always)]
    fn directions<W: Width>(&self, w: W, texels: [&GBufferTexel; RAYS]) -> [Vector<f32>; RAYS] {
        let mut points = [DVec3::ZERO; RAYS];
        for lane in 0..RAYS {
            points[lane] = exact(texels[lane].position);
        }
        let to_viewer = self.projection.toward_viewer(vector64(points));
        let mut directions = [NOTHING; RAYS];
        for first in (0..RAYS).step_by(W::LANES) {
            let mut rows = [[0.0; MOST_LANES]; 6];
            for lane in 0..W::LANES {
                let at = (first + lane) % RAYS;
                let normal = texels[at].normal;
                let Vector { x, y, z } = &to_viewer;
                let numbers =
                    [-x.0[at] as f32, -y.0[at] as f32, -z.0[at] as f32, normal.x, normal.y, normal.z];
                for (row, number) in rows.iter_mut().zip(numbers) {
                    row[lane] = number;
                }
            }
            let [x, y, z, normal_x, normal_y, normal_z] = &rows;
            let direction = Vector::new(w.load(x), w.load(y), w.load(z));
            let normal = Vector::new(w.load(normal_x), w.load(normal_y), w.load(normal_z));
            let Vector { x, y, z } = mend_unit(reflect(direction, normal));
            let [mut row_x, mut row_y, mut row_z] = [[0.0; MOST_LANES]; 3];
            x.store(&mut row_x);
            y.store(&mut row_y);
            z.store(&mut row_z);
            for lane in 0..W::LANES {
                directions[(first + lane) % RAYS] = Vector::new(row_x[lane], row_y[lane], row_z[lane]);
            }
        }
        directions
    }
}
