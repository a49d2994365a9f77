//! Arrays in the memory of a card.

use std::ops::Range;

use crate::card::Gpu;
use crate::error::GpuError;

/// An array in the memory of a card, with room to grow.
pub(crate) struct GpuArray {
    what: &'static str,
    buffer: wgpu::Buffer,
    /// The bytes that there is room for; none while the buffer is being replaced.
    room: u64,
    /// The bytes that are in use.
    len: u64,
    /// What it holds, if it is compared before it is written.
    copy: Option<Vec<u8>>,
}

/// Bytes that are written at once where an array has changed.
const BLOCK: usize = 256;

impl GpuArray {
    /// No array is smaller: the shader's arrays have one element at least.
    const LEAST: u64 = 256;

    /// An array whose bytes are known here too, so that only what differs is written.
    pub(crate) async fn compared(gpu: &Gpu, what: &'static str) -> Result<Self, GpuError> {
        Ok(Self { copy: Some(Vec::new()), ..Self::empty(gpu, what).await? })
    }

    /// An array without a copy of its bytes: a write sends all of them.
    pub(crate) async fn empty(gpu: &Gpu, what: &'static str) -> Result<Self, GpuError> {
        let buffer = Self::allocate(gpu, what, Self::LEAST).await?;
        Ok(Self { what, buffer, room: Self::LEAST, len: 0, copy: None })
    }

    async fn allocate(gpu: &Gpu, what: &'static str, bytes: u64) -> Result<wgpu::Buffer, GpuError> {
        gpu.buffer(what, bytes, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST).await
    }

    /// Writes all bytes, or those that differ; returns how many.
    pub(crate) async fn write(&mut self, gpu: &Gpu, bytes: &[u8]) -> Result<u64, GpuError> {
        let len = bytes.len() as u64;
        // Until all is written, nothing is known to be there.
        let mut copy = self.copy.as_mut().map(std::mem::take);
        if len > self.room {
            // The old memory is freed first: both might not fit.
            self.buffer.destroy();
            (self.len, self.room) = (0, 0);
            copy = copy.map(|_| Vec::new());
            let room = len.max(Self::LEAST);
            self.buffer = Self::allocate(gpu, self.what, room).await?;
            self.room = room;
        }
        let written = differences(copy.as_deref().unwrap_or_default(), bytes);
        let sum = self.write_parts(gpu, bytes, &written).await?;
        self.len = len;
        if let Some(mut copy) = copy {
            copy.clear();
            copy.extend_from_slice(bytes);
            self.copy = Some(copy);
        }
        Ok(sum)
    }

    /// Writes parts of what is to be all the bytes; returns how many.
    pub(crate) async fn write_parts(
        &self,
        gpu: &Gpu,
        bytes: &[u8],
        parts: &[Range<usize>],
    ) -> Result<u64, GpuError> {
        let mut sum = 0;
        for part in parts {
            let Some(bytes) = bytes.get(part.clone()).filter(|bytes| !bytes.is_empty()) else { continue };
            gpu.write(&self.buffer, part.start as u64, bytes).await?;
            sum += bytes.len() as u64;
        }
        Ok(sum)
    }

    pub(crate) fn binding(&self) -> wgpu::BindingResource<'_> {
        self.buffer.as_entire_binding()
    }

    /// The bytes in use.
    pub(crate) fn len(&self) -> u64 {
        self.len
    }
}

impl Gpu {
    /// Writes into memory of the card, in pieces: the driver keeps a copy of each until it is there.
    pub(crate) async fn write(
        &self,
        buffer: &wgpu::Buffer,
        start: u64,
        bytes: &[u8],
    ) -> Result<(), GpuError> {
        const PIECE: usize = 16 << 20;
        /// There is always room for so much.
        const SMALL: usize = 1 << 16;
        let mut at = start;
        for piece in bytes.chunks(PIECE) {
            if bytes.len() > SMALL {
                self.guarded(piece.len() as u64, |_| self.queue.write_buffer(buffer, at, piece)).await?;
            } else {
                self.trusted(|_| self.queue.write_buffer(buffer, at, piece)).await?;
            }
            at += piece.len() as u64;
            if bytes.len() > PIECE {
                self.trusted(|_| self.queue.submit([])).await?;
            }
        }
        Ok(())
    }
}

/// The parts of `new` that are not in `old`, in blocks.
fn differences(old: &[u8], new: &[u8]) -> Vec<Range<usize>> {
    let mut parts: Vec<Range<usize>> = Vec::new();
    for (index, block) in new.chunks(BLOCK).enumerate() {
        let part = index * BLOCK..index * BLOCK + block.len();
        if old.get(part.clone()) == Some(block) {
            continue;
        }
        match parts.last_mut() {
            Some(last) if last.end == part.start => last.end = part.end,
            _ => parts.push(part),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_blocks_that_differ_are_found() {
        let old = vec![7; 5 * BLOCK + 8];
        assert!(differences(&old, &old).is_empty());
        let mut new = old.clone();
        new[BLOCK + 3] = 1;
        new[2 * BLOCK] = 1;
        *new.last_mut().unwrap() = 1;
        assert_eq!(differences(&old, &new), [BLOCK..3 * BLOCK, 5 * BLOCK..5 * BLOCK + 8]);
        assert_eq!(differences(&[], &old).first(), Some(&(0..old.len())));
        assert!(differences(&old, &old[..BLOCK]).is_empty());
    }
}
