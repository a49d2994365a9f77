//! Films become textures that a window shows, without a way through the processor.

use std::sync::Arc;

use catoptric_picture::Development;
use catoptric_tracer::shaders::FILM_HEAD;

use crate::card::Gpu;
use crate::error::GpuError;
use crate::film::GpuFilm;

/// Develops films into textures. Those that nobody shows any more are used again.
pub struct GpuScreen {
    pipeline: wgpu::ComputePipeline,
    uniform: wgpu::Buffer,
    pictures: Vec<Arc<GpuPicture>>,
    /// What pictures of a size were read through.
    staging: Option<([u32; 2], wgpu::Buffer)>,
    last_number: u64,
}

/// A developed picture in the memory of a card.
pub struct GpuPicture {
    number: u64,
    size: [u32; 2],
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    gpu: Arc<Gpu>,
}

impl GpuScreen {
    /// Words of the shader's uniform.
    const UNIFORM: usize = 4;

    /// Compiles the shader.
    ///
    /// # Errors
    /// When the card is lost or its driver refuses.
    pub async fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = gpu.buffer("a development", 4 * Self::UNIFORM as u64, usage).await?;
        let compiled = gpu.guarded(0, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("development"),
                source: wgpu::ShaderSource::Wgsl(Development::SHADER.into()),
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("development"),
                layout: None,
                module: &module,
                entry_point: Some("develop"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        });
        let pipeline = compiled.await?;
        Ok(Self { pipeline, uniform, pictures: Vec::new(), staging: None, last_number: 0 })
    }

    /// Develops a film.
    ///
    /// # Errors
    /// When the picture is too large for a texture, the card has too little memory, or is lost.
    pub async fn develop(
        &mut self,
        gpu: &Arc<Gpu>,
        film: &GpuFilm,
        development: &Development,
    ) -> Result<Arc<GpuPicture>, GpuError> {
        let size = film.size();
        let picture = self.free_picture(gpu, size).await?;
        let [scale, curve] = development.words();
        let words: [u32; Self::UNIFORM] = [scale, curve, size[0], size[1]];
        gpu.write(&self.uniform, 0, bytemuck::bytes_of(&words)).await?;
        gpu.trusted(|device| {
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("development"),
                layout: &self.pipeline.get_bind_group_layout(0),
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 1, resource: film.buffer().as_entire_binding() },
                    wgpu::BindGroupEntry {
                        binding: 2,
                        resource: wgpu::BindingResource::TextureView(&picture.view),
                    },
                ],
            });
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.dispatch_workgroups(size[0].div_ceil(8), size[1].div_ceil(8), 1);
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        })
        .await?;
        self.pictures.push(Arc::clone(&picture));
        Ok(picture)
    }

    /// The codes of a picture as [`GpuPicture::read`] gives them, for who reads one after the other.
    ///
    /// # Errors
    /// When there is too little memory, or the card is lost.
    pub async fn read(&mut self, picture: &GpuPicture) -> Result<Vec<u8>, GpuError> {
        let staging = match self.staging.take() {
            Some((size, staging)) if size == picture.size => staging,
            _ => picture.staging().await?,
        };
        let codes = picture.read_through(&staging).await?;
        self.staging = Some((picture.size, staging));
        Ok(codes)
    }

    /// A texture of a size that nobody shows; others that nobody shows are freed.
    async fn free_picture(&mut self, gpu: &Arc<Gpu>, size: [u32; 2]) -> Result<Arc<GpuPicture>, GpuError> {
        let is_free = |picture: &Arc<GpuPicture>| Arc::strong_count(picture) == 1;
        let found = self.pictures.iter().position(|picture| is_free(picture) && picture.size == size);
        let free = found.map(|place| self.pictures.swap_remove(place));
        self.pictures.retain(|picture| !is_free(picture));
        if let Some(picture) = free {
            return Ok(picture);
        }
        self.last_number += 1;
        Ok(Arc::new(GpuPicture::new(gpu, size, self.last_number).await?))
    }
}

impl GpuPicture {
    const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    async fn new(gpu: &Arc<Gpu>, size: [u32; 2], number: u64) -> Result<Self, GpuError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let side = size[0].max(size[1]);
        if side > limit {
            let (card, what) = (gpu.info().name.clone(), "a side of the picture");
            return Err(GpuError::TooLarge { card, what, bytes: u64::from(side), limit: u64::from(limit) });
        }
        let bytes = 4 * u64::from(size[0]) * u64::from(size[1]);
        let allocated = gpu.guarded(bytes, |device| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some("picture"),
                size: extent(size),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: Self::FORMAT,
                usage: wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        });
        let texture = allocated.await?;
        let view = gpu.trusted(|_| texture.create_view(&wgpu::TextureViewDescriptor::default())).await?;
        Ok(Self { number, size, texture, view, gpu: Arc::clone(gpu) })
    }

    /// A number that no other picture of its [`GpuScreen`] has; the same while the texture is the same.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Whether it lies in the memory of this card.
    pub fn is_on(&self, gpu: &Gpu) -> bool {
        std::ptr::eq(Arc::as_ptr(&self.gpu), gpu)
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The texture, with gamma-encoded colors.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Red, green, blue (sRGB) and 255 for every pixel, row by row from the top.
    ///
    /// # Errors
    /// When there is too little memory, or the card is lost.
    pub async fn read(&self) -> Result<Vec<u8>, GpuError> {
        let staging = self.staging().await?;
        self.read_through(&staging).await
    }

    /// Memory for its codes on their way.
    async fn staging(&self) -> Result<wgpu::Buffer, GpuError> {
        let bytes = u64::from(self.padded_row()) * u64::from(self.size[1]);
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        self.gpu.buffer("a picture on its way", bytes, usage).await
    }

    /// Bytes from one row to the next in such memory.
    fn padded_row(&self) -> u32 {
        (4 * self.size[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
    }

    async fn read_through(&self, staging: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
        let (row, padded) = (4 * self.size[0], self.padded_row());
        let copied = self.gpu.trusted(|device| {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let layout = wgpu::TexelCopyBufferLayout { bytes_per_row: Some(padded), ..Default::default() };
            encoder.copy_texture_to_buffer(
                self.texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo { buffer: staging, layout },
                extent(self.size),
            );
            self.gpu.queue.submit([encoder.finish()]);
        });
        copied.await?;
        let taken = self.gpu.read(staging, u64::from(padded) * u64::from(self.size[1]), |bytes| {
            let rows = bytes.chunks(padded as usize).filter_map(|line| line.get(..row as usize));
            rows.flatten().copied().collect()
        });
        taken.await
    }
}

fn extent([width, height]: [u32; 2]) -> wgpu::Extent3d {
    wgpu::Extent3d { width, height, depth_or_array_layers: 1 }
}

/// What [`GpuScreen`] takes for granted of the tracer's film.
const _: () = assert!(FILM_HEAD == 32);

impl std::fmt::Debug for GpuPicture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GpuPicture").field("number", &self.number).field("size", &self.size).finish()
    }
}
