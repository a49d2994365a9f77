//! Where samples of a picture add up, and rows of pixels worked on by all threads.

use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_vec;
use catoptric_picture::{Picture, SizeError};
use catoptric_platform::time::{Duration, Instant};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::raster::pass::PassName;
use crate::transport::render::RenderSettings;

/// The passes of a drawing with their times, in the order of their first beginning.
#[derive(Debug, Default)]
pub(crate) struct PassTimer {
    pub(crate) passes: Vec<(PassName, Duration)>,
}

impl PassTimer {
    /// Does `work` and adds its time to that of the pass.
    pub(crate) fn time<T>(&mut self, name: PassName, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        let spent = start.elapsed();
        match self.passes.iter_mut().find(|(pass, _)| *pass == name) {
            Some((_, time)) => *time += spent,
            None => self.passes.push((name, spent)),
        }
        result
    }
}

/// The size of a picture as numbers of all kinds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrameSize {
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl FrameSize {
    pub(crate) fn new(settings: RenderSettings) -> Result<Self, SizeError> {
        Picture::check_size(settings.width, settings.height)?;
        Ok(Self { width: settings.width as usize, height: settings.height as usize })
    }

    pub(crate) fn pixels(self) -> usize {
        self.width * self.height
    }

    pub(crate) fn size(self) -> DVec2 {
        DVec2::new(self.width as f64, self.height as f64)
    }

    /// As many values as there are pixels.
    pub(crate) fn buffer<T: Clone>(self, value: T) -> Result<Vec<T>, SizeError> {
        let (width, height) = (self.width as u32, self.height as u32);
        let mut values = Vec::new();
        values.try_reserve_exact(self.pixels()).map_err(|_| SizeError::Memory {
            width,
            height,
            bytes: (self.pixels() as u64).saturating_mul(size_of::<T>() as u64),
        })?;
        values.resize(self.pixels(), value);
        Ok(values)
    }

    /// As many zeros as there are pixels: fresh memory as it comes, of which nothing is written here.
    pub(crate) fn zeroed<T: Zeroable>(self) -> Result<Vec<T>, SizeError> {
        let (width, height) = (self.width as u32, self.height as u32);
        try_zeroed_vec(self.pixels()).map_err(|()| SizeError::Memory {
            width,
            height,
            bytes: (self.pixels() as u64).saturating_mul(size_of::<T>() as u64),
        })
    }

    /// As many zeros as there are pixels, in memory that the system has cleared already: that is no part of a pass. All
    /// threads write to its pages, one value each.
    pub(crate) fn touched<T: Zeroable + Send>(self) -> Result<Vec<T>, SizeError> {
        /// No system has smaller pages, bytes.
        const PAGE: usize = 4096;
        let mut values = self.zeroed()?;
        let pages = values.par_chunks_mut((PAGE / size_of::<T>().max(1)).max(1));
        pages.for_each(|page| page.iter_mut().take(1).for_each(|value| *value = T::zeroed()));
        Ok(values)
    }

    /// Whether a place lies in the picture.
    pub(crate) fn holds(self, at: DVec2) -> bool {
        at.cmpge(DVec2::ZERO).all() && at.cmplt(self.size()).all()
    }
}

/// The light of all samples so far.
pub(crate) struct SampleSums {
    sums: Vec<DVec3>,
    frame: FrameSize,
}

impl SampleSums {
    pub(crate) fn new(frame: FrameSize) -> Result<Self, SizeError> {
        Ok(Self { sums: frame.buffer(DVec3::ZERO)?, frame })
    }

    /// The sums, row by row from the top.
    pub(crate) fn sums(&mut self) -> &mut [DVec3] {
        &mut self.sums
    }

    /// The mean of this many samples.
    pub(crate) fn picture(self, samples: u32) -> Result<Picture, SizeError> {
        let mut picture = Picture::new(self.frame.width as u32, self.frame.height as u32)?;
        let pixels = picture.pixels_mut().par_iter_mut().zip(&self.sums);
        pixels.for_each(|(pixel, sum)| *pixel = (*sum / f64::from(samples)).as_vec3().to_array());
        Ok(picture)
    }
}
