//! The pictures of a scene in the memory of a card.

use catoptric_tracer::shaders::{AtlasTexel, PICTURES_ACROSS, PictureAtlas};

use crate::card::Gpu;
use crate::error::GpuError;

/// The pictures of a scene in the memory of a card: rows of one texture, so that no storage array is needed.
pub(crate) struct GpuSceneImages {
    texture: wgpu::Texture,
    /// What it holds; `None` after an error.
    sent: Option<PictureAtlas>,
}

/// Bytes of a row.
const ROW: u64 = PICTURES_ACROSS as u64 * size_of::<AtlasTexel>() as u64;

/// Rows that are sent at once: the driver keeps a copy of them until they are there.
const PIECE: usize = (16 << 20) / ROW as usize;

impl GpuSceneImages {
    pub(crate) async fn empty(gpu: &Gpu) -> Result<Self, GpuError> {
        Ok(Self { texture: allocate(gpu, [1, 1]).await?, sent: Some(PictureAtlas::default()) })
    }

    /// Sends all pictures if they are others than the last time; returns how many bytes that were.
    pub(crate) async fn follow(&mut self, gpu: &Gpu, pictures: PictureAtlas) -> Result<u64, GpuError> {
        if self.sent.as_ref() == Some(&pictures) {
            return Ok(0);
        }
        // What was left half done may have left no memory, either.
        let was_done = self.sent.take().is_some();
        let most = gpu.device.limits().max_texture_dimension_2d;
        let size = size_of_texture(most, &gpu.info().name, pictures.rows())?;
        if !was_done || size != [self.texture.width(), self.texture.height()] {
            // The old memory is freed first: both might not fit.
            self.texture.destroy();
            self.texture = allocate(gpu, size).await?;
        }
        let mut row = 0;
        for texels in pictures.pieces(PIECE) {
            row += self.write(gpu, row, &texels).await?;
        }
        self.sent = Some(pictures);
        Ok(u64::from(row) * ROW)
    }

    /// Writes whole rows; returns how many.
    async fn write(&self, gpu: &Gpu, row: u32, texels: &[AtlasTexel]) -> Result<u32, GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(texels);
        let rows = (bytes.len() as u64 / ROW) as u32;
        gpu.guarded(bytes.len() as u64, |_| {
            let to = wgpu::TexelCopyTextureInfo {
                texture: &self.texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y: row, z: 0 },
                aspect: wgpu::TextureAspect::All,
            };
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(ROW as u32),
                rows_per_image: None,
            };
            let size = wgpu::Extent3d { width: PICTURES_ACROSS, height: rows, depth_or_array_layers: 1 };
            gpu.queue.write_texture(to, bytes, layout, size);
            gpu.queue.submit([]);
        })
        .await?;
        Ok(rows)
    }

    pub(crate) async fn view(&self, gpu: &Gpu) -> Result<wgpu::TextureView, GpuError> {
        gpu.trusted(|_| self.texture.create_view(&wgpu::TextureViewDescriptor::default())).await
    }
}

/// Width and height of a texture with so many rows, on a card with such sides at most; nothing has one texel.
fn size_of_texture(most: u32, card: &str, rows: u64) -> Result<[u32; 2], GpuError> {
    // A card for which rows are too wide has room for none.
    let limit = if PICTURES_ACROSS <= most { most } else { 0 };
    match u32::try_from(rows) {
        Ok(0) => Ok([1, 1]),
        Ok(rows) if rows <= limit => Ok([PICTURES_ACROSS, rows]),
        _ => Err(GpuError::TooLarge {
            card: card.to_owned(),
            what: "pictures",
            bytes: rows.saturating_mul(ROW),
            limit: u64::from(limit) * ROW,
        }),
    }
}

async fn allocate(gpu: &Gpu, [width, height]: [u32; 2]) -> Result<wgpu::Texture, GpuError> {
    let bytes = u64::from(width) * u64::from(height) * size_of::<AtlasTexel>() as u64;
    gpu.guarded(bytes, |device| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: Some("pictures"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            // Words, as they are: floats might lose their smallest numbers.
            format: wgpu::TextureFormat::Rgba32Uint,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    })
    .await
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_that_no_texture_holds_are_refused() {
        let size = |most, rows| size_of_texture(most, "a card", rows);
        assert_eq!(size(8192, 0), Ok([1, 1]));
        assert_eq!(size(8192, 8192), Ok([8192, 8192]));
        let error = size(8192, 8193).unwrap_err();
        assert!(matches!(error, GpuError::TooLarge { bytes, limit, .. } if bytes == limit + ROW), "{error}");
        assert!(size(16384, 8193).is_ok() && size(16384, u64::from(u32::MAX) + 1).is_err());
        assert!(matches!(size(4096, 1), Err(GpuError::TooLarge { limit: 0, .. })));
    }
}
