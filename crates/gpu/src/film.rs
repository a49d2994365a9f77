//! A picture in the memory of a card that is refined sample by sample.

use std::ops::AddAssign;

use catoptric_picture::Picture;
use catoptric_platform::time::{Duration, Instant};
use catoptric_tracer::shaders::{
    CameraRaysBytes, FILM_HEAD, FILM_PIXEL, FRAME_PLACES, FrameUniforms, PhysicalFeatures, TILE_BLOCKS,
    UnsupportedOnGpu, WavelengthUniforms, tile_rays,
};
use catoptric_tracer::{RayCounts, RenderCamera, RenderControl, RenderScene};

use crate::card::Gpu;
use crate::error::GpuError;
use crate::scene::GpuScene;
use crate::upload::GpuArray;

/// The light gathered so far in every pixel of a picture, in the memory of a card; the twin of
/// [`Film`](catoptric_tracer::Film).
pub struct GpuFilm {
    size: [u32; 2],
    pixels: wgpu::Buffer,
    frame: wgpu::Buffer,
    waves: wgpu::Buffer,
    tiles: GpuArray,
    /// The camera that the tiles' rays are of.
    camera: Option<RenderCamera>,
    report: DispatchReport,
    samples: u32,
    /// Of samples that were begun: how many, and the first tile without them.
    begun: Option<(u32, u32)>,
    /// The number of tiles of one dispatch.
    stride: u32,
}

/// The time and rays of some samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GpuPass {
    /// Rays traced.
    pub counts: RayCounts,
    /// What the card worked, by its own clock; `None` if it has none.
    pub on_card: Option<Duration>,
    /// How many dispatches it was cut into.
    pub dispatches: u32,
}

impl GpuFilm {
    /// What a dispatch may take: as long as a few frames of the desktop, which the same card draws.
    const BUDGET: Duration = Duration::from_millis(40);
    /// The first dispatch has so many tiles, of 4096 pixels.
    const FIRST_STRIDE: u32 = 8;
    /// The most that a dispatch can have.
    const MOST_STRIDE: u32 = 65535;

    /// A film without light.
    ///
    /// # Errors
    /// When the size is 0 or too large, for a picture or for the card, or the card has too little memory.
    pub async fn new(gpu: &Gpu, width: u32, height: u32) -> Result<Self, GpuError> {
        let pixels = Picture::check_size(width, height)? as u64;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let uniform = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        Ok(Self {
            size: [width, height],
            pixels: gpu.buffer("pixels", FILM_HEAD + pixels * FILM_PIXEL, usage).await?,
            frame: gpu.buffer("a frame", size_of::<FrameUniforms>() as u64, uniform).await?,
            waves: gpu.buffer("waves", size_of::<WavelengthUniforms>() as u64, uniform).await?,
            tiles: GpuArray::empty(gpu, "tiles").await?,
            camera: None,
            report: DispatchReport::new(gpu).await?,
            samples: 0,
            begun: None,
            stride: Self::FIRST_STRIDE,
        })
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Samples that every pixel has.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Forgets all light; the memory is kept for the next picture of this size.
    pub fn clear(&mut self) {
        (self.samples, self.begun) = (0, None);
    }

    /// Adds samples to every pixel. Scene and camera must be those of the earlier samples, and `on_card` has to have
    /// [followed](GpuScene::follow) the scene.
    ///
    /// # Errors
    /// When the scene cannot be drawn, the card is lost, or `control` is cancelled. After the last the film is valid,
    /// some tiles being ahead, and the next call does what is missing; also when the work is dropped half way.
    pub async fn add_samples(
        &mut self,
        gpu: &Gpu,
        (render_scene, on_card): (&RenderScene, &GpuScene),
        camera: &RenderCamera,
        samples: u32,
        control: &RenderControl,
    ) -> Result<GpuPass, GpuError> {
        let special = on_card.specialization(render_scene, camera)?;
        let pipeline = gpu.pipeline(special).await?;
        self.aim(gpu, camera).await?;
        let bindings = self.bind(gpu, on_card).await?;
        let frame = FrameUniforms::new(render_scene, camera, self.size);
        let tiles = self.tile_count();
        let mut pass =
            GpuPass { on_card: self.report.clock.as_ref().map(|_| Duration::ZERO), ..GpuPass::default() };
        let mut left = samples;
        while left > 0 {
            let (count, mut first) = self.begun.unwrap_or((left.min(self.most_samples(gpu)), 0));
            if special.physical.has(PhysicalFeatures::DISPERSES) {
                let waves = WavelengthUniforms::new(self.samples, count);
                gpu.write(&self.waves, 0, bytemuck::bytes_of(&waves)).await?;
            }
            while first < tiles {
                if control.is_cancelled() {
                    return Err(GpuError::Cancelled);
                }
                let stride = self.stride.min(tiles - first);
                let dispatch = frame.dispatch(first, self.samples, count);
                gpu.write(&self.frame, 0, bytemuck::bytes_of(&dispatch)).await?;
                let start = Instant::now();
                self.begun = Some((count, first + stride));
                self.submit(gpu, &pipeline, &bindings, stride).await?;
                pass += self.report.read(gpu).await?;
                self.stride = stride_after(stride, start.elapsed());
                first += stride;
                control.add_pixels(self.pixels_of(stride) * u64::from(count));
            }
            self.begun = None;
            self.samples += count;
            left = left.saturating_sub(count);
        }
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        pass.counts.primary = pixels * u64::from(samples);
        Ok(pass)
    }

    /// How many samples a dispatch adds at most: one, if that takes long already, or on a software driver, which lets a
    /// thread do only so much.
    fn most_samples(&self, gpu: &Gpu) -> u32 {
        if gpu.info().is_software || self.stride < Self::FIRST_STRIDE { 1 } else { FRAME_PLACES as u32 }
    }

    fn tile_count(&self) -> u32 {
        (self.tiles.len() / size_of::<CameraRaysBytes>() as u64) as u32
    }

    /// About how many pixels tiles have.
    fn pixels_of(&self, tiles: u32) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1]) * u64::from(tiles) / u64::from(self.tile_count())
    }

    /// Sends the rays of a camera that is new.
    async fn aim(&mut self, gpu: &Gpu, camera: &RenderCamera) -> Result<(), GpuError> {
        if self.camera.as_ref() != Some(camera) {
            self.camera = None;
            self.tiles.write(gpu, bytemuck::cast_slice(&tile_rays(camera, self.size))).await?;
            self.camera = Some(camera.clone());
        }
        Ok(())
    }

    async fn bind(&self, gpu: &Gpu, on_card: &GpuScene) -> Result<wgpu::BindGroup, GpuError> {
        let arrays = on_card.bindings().into_iter();
        let all = [self.frame.as_entire_binding()].into_iter().chain(arrays);
        let pictures = on_card.pictures.view(gpu).await?;
        let rest = [
            self.tiles.binding(),
            self.pixels.as_entire_binding(),
            self.waves.as_entire_binding(),
            wgpu::BindingResource::TextureView(&pictures),
        ];
        let all = all.chain(rest);
        let entries: Vec<wgpu::BindGroupEntry<'_>> =
            (0..).zip(all).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        gpu.trusted(|device| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("stage and film"),
                layout: &gpu.pipelines.layout,
                entries: &entries,
            })
        })
        .await
    }

    async fn submit(
        &self,
        gpu: &Gpu,
        pipeline: &wgpu::ComputePipeline,
        bindings: &wgpu::BindGroup,
        tiles: u32,
    ) -> Result<(), GpuError> {
        gpu.trusted(|device| {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.clear_buffer(&self.pixels, 0, Some(FILM_HEAD));
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("samples"),
                timestamp_writes: self.report.clock.as_ref().map(GpuTimer::writes),
            });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, bindings, &[]);
            pass.dispatch_workgroups(TILE_BLOCKS, tiles, 1);
            drop(pass);
            self.report.record(&mut encoder, &self.pixels);
            gpu.queue.submit([encoder.finish()]);
        })
        .await
    }

    /// The memory that it lies in.
    pub(crate) fn buffer(&self) -> &wgpu::Buffer {
        &self.pixels
    }

    /// The mean of the samples so far; black before the first.
    ///
    /// # Errors
    /// When there is too little memory, or the card is lost.
    pub async fn picture(&self, gpu: &Gpu) -> Result<Picture, GpuError> {
        let mut picture = Picture::new(self.size[0], self.size[1])?;
        if self.samples > 0 {
            let take = |pixel: &mut [f32; 3], [x, y, z, _]: [u32; 4]| *pixel = [x, y, z].map(f32::from_bits);
            self.each_pixel(gpu, picture.pixels_mut(), take).await?;
        }
        Ok(picture)
    }

    /// The body that the last sample met in each pixel, by its place in the scene; [`NO_BODY`](catoptric_tracer::NO_BODY)
    /// where it met none.
    ///
    /// # Errors
    /// When there is too little memory, or the card is lost.
    pub async fn bodies(&self, gpu: &Gpu) -> Result<Vec<u32>, GpuError> {
        let mut bodies = vec![catoptric_tracer::NO_BODY; Picture::check_size(self.size[0], self.size[1])?];
        if self.samples > 0 {
            self.each_pixel(gpu, &mut bodies, |body, [_, _, _, found]| *body = found).await?;
        }
        Ok(bodies)
    }

    /// Shows `take` the words of every pixel with one of `to`. They come in pieces, so that little memory is needed.
    async fn each_pixel<T>(
        &self,
        gpu: &Gpu,
        to: &mut [T],
        take: impl Fn(&mut T, [u32; 4]),
    ) -> Result<(), GpuError> {
        const PIECE: u64 = 1 << 20;
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let most = PIECE.min(to.len() as u64) * FILM_PIXEL;
        let staging = gpu.buffer("pixels on their way", most, usage).await?;
        let mut start = FILM_HEAD;
        for piece in to.chunks_mut(PIECE as usize) {
            let bytes = piece.len() as u64 * FILM_PIXEL;
            gpu.trusted(|device| {
                let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                encoder.copy_buffer_to_buffer(&self.pixels, start, &staging, 0, bytes);
                gpu.queue.submit([encoder.finish()]);
            })
            .await?;
            gpu.read(&staging, bytes, |bytes| {
                for (to, words) in piece.iter_mut().zip(bytes.chunks_exact(FILM_PIXEL as usize)) {
                    take(to, bytemuck::pod_read_unaligned(words));
                }
            })
            .await?;
            start += bytes;
        }
        Ok(())
    }
}

/// How many tiles to dispatch after so many took so long.
fn stride_after(stride: u32, took: Duration) -> u32 {
    let wanted = f64::from(stride) * GpuFilm::BUDGET.as_secs_f64() / took.as_secs_f64().max(1e-6);
    // A short look may deceive: what is tried next is not much more.
    (wanted as u32).clamp(1, stride.saturating_mul(8).min(GpuFilm::MOST_STRIDE))
}

impl AddAssign for GpuPass {
    fn add_assign(&mut self, other: Self) {
        self.counts += other.counts;
        self.on_card = self.on_card.zip(other.on_card).map(|(one, other)| one + other);
        self.dispatches += other.dispatches;
    }
}

/// The buffers that a dispatch reports its progress and times in.
struct DispatchReport {
    /// The head of the film and two times.
    buffer: wgpu::Buffer,
    clock: Option<GpuTimer>,
}

/// Timestamp queries of the card.
struct GpuTimer {
    queries: wgpu::QuerySet,
    times: wgpu::Buffer,
    /// Nanoseconds to a tick.
    period: f32,
}

impl DispatchReport {
    const TIMES: u64 = 16;

    async fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let buffer = gpu.buffer("a report", FILM_HEAD + Self::TIMES, usage).await?;
        let has_clock = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        Ok(Self { buffer, clock: if has_clock { Some(GpuTimer::new(gpu).await?) } else { None } })
    }

    fn record(&self, encoder: &mut wgpu::CommandEncoder, pixels: &wgpu::Buffer) {
        encoder.copy_buffer_to_buffer(pixels, 0, &self.buffer, 0, FILM_HEAD);
        if let Some(GpuTimer { queries, times, .. }) = &self.clock {
            encoder.resolve_query_set(queries, 0..2, times, 0);
            encoder.copy_buffer_to_buffer(times, 0, &self.buffer, FILM_HEAD, Self::TIMES);
        }
    }

    /// Waits for the dispatch.
    async fn read(&self, gpu: &Gpu) -> Result<GpuPass, GpuError> {
        let bytes = FILM_HEAD + Self::TIMES;
        let words: [u64; 6] = gpu.read(&self.buffer, bytes, bytemuck::pod_read_unaligned).await?;
        let [shadow, reflected, refracted, overflow, start, end] = words;
        match (overflow as u32, overflow >> 32) {
            (0, 0) => {}
            (0, _) => return Err(UnsupportedOnGpu::LongTree.into()),
            _ => return Err(UnsupportedOnGpu::NestedMedia.into()),
        }
        let counts = RayCounts { primary: 0, shadow, reflected, refracted };
        let on_card = self.clock.as_ref().map(|clock| {
            Duration::from_secs_f64(1e-9 * end.saturating_sub(start) as f64 * f64::from(clock.period))
        });
        Ok(GpuPass { counts, on_card, dispatches: 1 })
    }
}

impl GpuTimer {
    async fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let made = gpu.guarded(0, |device| {
            device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            })
        });
        let queries = made.await?;
        let times = gpu.buffer("times", DispatchReport::TIMES, usage).await?;
        Ok(Self { queries, times, period: gpu.queue.get_timestamp_period() })
    }

    fn writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }
}
