//! An estimate of the rays of a picture, before it is traced.

use catoptric_tracer::{RenderCamera, RenderControl, RenderError, RenderScene, WhittedIntegrator};
use glam::UVec2;
use rayon::prelude::*;

use crate::random::Random;

/// An estimate of the rays of a picture's trees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayEstimate {
    /// Of all kinds, for one sample of a pixel, on average over the picture.
    pub per_sample: f64,
}

impl RayEstimate {
    /// From so many rays for each sample of a pixel on, a picture is worth a warning: at 1280×720 that is 10⁹ rays, a
    /// minute or so for a thread.
    pub const MANY: f64 = 1000.0;
    /// A threshold that bounds the trees of bodies that give no more light than they get: below a quarter of a step of
    /// a display, rays are not traced.
    pub const ADVISED_THRESHOLD: f64 = 0.001;
    /// Walks down trees, spread over the picture.
    const WALKS: u32 = 4096;

    /// The estimate for a picture of `size` pixels, on the threads of the current rayon pool. It takes as long for
    /// trees of any size: some ten thousand rays.
    ///
    /// # Errors
    /// When `control` is cancelled.
    pub fn of(
        render_scene: &RenderScene,
        camera: &RenderCamera,
        size: UVec2,
        control: &RenderControl,
    ) -> Result<Self, RenderError> {
        Self::within(
            render_scene,
            camera,
            size,
            (render_scene.generations(), render_scene.threshold()),
            control,
        )
    }

    /// Estimates the rays under other limits than the scene's: of generations, and the weight below which rays are not
    /// traced.
    ///
    /// # Errors
    /// When `control` is cancelled.
    pub fn within(
        render_scene: &RenderScene,
        camera: &RenderCamera,
        size: UVec2,
        (generations, threshold): (u32, f32),
        control: &RenderControl,
    ) -> Result<Self, RenderError> {
        let size = size.max(UVec2::ONE);
        // As many rows as columns in proportion, a walk in the middle of each cell.
        let aspect = f64::from(size.x) / f64::from(size.y);
        let rows = (f64::from(Self::WALKS) / aspect).sqrt().round().clamp(1.0, f64::from(Self::WALKS)) as u32;
        let columns = (Self::WALKS / rows).max(1);
        let middle = |cell: u32, cells: u32, pixels: u32| {
            let at = (f64::from(cell) + 0.5) / f64::from(cells) * f64::from(pixels);
            (at as u32).min(pixels - 1)
        };
        let rays: Vec<f64> = (0..rows)
            .into_par_iter()
            .map_init(
                || {
                    WhittedIntegrator::watched(render_scene, camera, control)
                        .with_limits(generations, threshold)
                },
                |tracer, row| {
                    let mut random = Random::new(u64::from(row));
                    let walks = (0..columns).map(|column| {
                        if control.is_cancelled() {
                            return 0.0;
                        }
                        let pixel = UVec2::new(middle(column, columns, size.x), middle(row, rows, size.y));
                        tracer.pixel_walk(pixel, size, column, |count| random.below(count as u64) as usize)
                    });
                    walks.sum()
                },
            )
            .collect();
        if control.is_cancelled() {
            return Err(RenderError::Cancelled);
        }
        // Summed in order, so that the number does not depend on the threads.
        let per_sample = rays.iter().sum::<f64>() / f64::from(rows * columns);
        Ok(Self { per_sample: per_sample.min(f64::MAX) })
    }

    /// The rays of a picture of so many pixels, with so many samples each.
    pub fn of_picture(&self, pixels: u64, samples: u32) -> f64 {
        self.per_sample * pixels as f64 * f64::from(samples)
    }

    /// Whether a picture takes so many rays that one should know before.
    pub fn is_worth_a_warning(&self) -> bool {
        self.per_sample >= Self::MANY
    }
}
