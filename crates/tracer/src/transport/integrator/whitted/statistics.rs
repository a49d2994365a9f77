//! The tree of a pixel in figures.

use glam::{DVec3, UVec2, Vec3};

use crate::simd::scalar::ScalarWidth;
use crate::transport::counts::RayCounts;
use crate::transport::integrator::whitted::WhittedIntegrator;
use crate::transport::path::PathState;
use crate::transport::sampler::Sampler;
use crate::transport::tile_rect::{TILE, TileRect};

/// What the rays of one sample of a pixel come to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PixelStatistics {
    /// The rays.
    pub counts: RayCounts,
    /// The light of the rays of each generation, the first first; as long as the tree is deep.
    pub generations: Vec<DVec3>,
    /// Whether all rays were followed.
    pub is_complete: bool,
}

impl PixelStatistics {
    /// The light of all generations.
    pub fn light(&self) -> DVec3 {
        self.generations.iter().sum()
    }
}

/// A tree that is not at its end after so many rays in a row is left there.
const LONGEST_WALK: usize = 1 << 12;

impl WhittedIntegrator<'_> {
    /// One walk down the tree of a sample of a pixel, a random branch at each fork, which `choose` takes of so many: an
    /// estimate of the number of its rays, those to lights included, that is right on average however large the tree is
    /// (D. E. Knuth 1975, Estimating the efficiency of backtrack programs, Mathematics of Computation 29).
    pub fn pixel_walk(
        &mut self,
        pixel: UVec2,
        size: UVec2,
        sample: u32,
        mut choose: impl FnMut(usize) -> usize,
    ) -> f64 {
        if pixel.x >= size.x || pixel.y >= size.y {
            return 0.0;
        }
        let mut beam = self.primary_of(pixel, size, sample);
        let mut branches: Vec<PathState<ScalarWidth>> = Vec::new();
        // How many rays of the tree the one that is followed stands for.
        let (mut stands_for, mut rays) = (1.0, 0.0);
        for _ in 0..LONGEST_WALK {
            let before = self.shading.counts.shadow;
            self.follow(&beam, &mut branches);
            rays += stands_for * (1 + self.shading.counts.shadow - before) as f64;
            if branches.is_empty() {
                break;
            }
            stands_for *= branches.len() as f64;
            let chosen = choose(branches.len()).min(branches.len() - 1);
            beam = branches.swap_remove(chosen);
            branches.clear();
        }
        rays
    }

    /// The primary ray of a sample of a pixel of a picture that has it.
    fn primary_of(&mut self, pixel: UVec2, size: UVec2, sample: u32) -> PathState<ScalarWidth> {
        self.shading.trim_media();
        self.shading.begin_sample(sample, Sampler::of_pixel(sample, pixel));
        let ray = TileRect::around(pixel, size, TILE).ray(self.shading.camera, (pixel, size), sample);
        self.started_path(ray)
    }

    /// Counts the rays of one sample of a pixel (column, row) of a picture of `size` pixels, and adds up their light
    /// generation by generation. After about `most_rays`, shadow rays not counted, it gives up; so it does when it is
    /// cancelled. A pixel that is not in the picture has no rays.
    pub fn pixel_tally(
        &mut self,
        pixel: UVec2,
        size: UVec2,
        sample: u32,
        most_rays: usize,
    ) -> PixelStatistics {
        let before = self.shading.counts;
        let mut generations: Vec<DVec3> = Vec::new();
        let is_complete = self.pixel_rays(pixel, size, sample, most_rays, |generation, light| {
            let generation = generation as usize;
            if generations.len() < generation {
                generations.resize(generation, DVec3::ZERO);
            }
            if let Some(sum) = generation.checked_sub(1).and_then(|place| generations.get_mut(place)) {
                *sum += light.as_dvec3();
            }
        });
        PixelStatistics { counts: self.shading.counts - before, generations, is_complete }
    }

    /// Shows `take` the generation of each ray of one sample of a pixel and what it adds to it, in no particular order;
    /// limits are those of [`pixel_tally`](Self::pixel_tally). Whether that were all rays.
    pub fn pixel_rays(
        &mut self,
        pixel: UVec2,
        size: UVec2,
        sample: u32,
        most_rays: usize,
        mut take: impl FnMut(u32, Vec3),
    ) -> bool {
        if pixel.x >= size.x || pixel.y >= size.y {
            return false;
        }
        let mut pending: Vec<PathState<ScalarWidth>> = vec![self.primary_of(pixel, size, sample)];
        let mut followed = 0;
        while followed < most_rays
            && !self.is_cancelled_at(followed)
            && let Some(beam) = pending.pop()
        {
            take(beam.generation, self.follow(&beam, &mut pending).into());
            followed += 1;
        }
        pending.is_empty()
    }
}
