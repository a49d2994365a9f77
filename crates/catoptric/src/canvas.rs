//! The picture before there is a scene.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, sync_channel};

use catoptric_picture::{Picture, SizeError};
use rayon::ThreadPool;

/// A picture whose memory one of the threads gets from the system while they have nothing else to do: that takes 1 ms
/// for 8 MB, and otherwise happens when pixels are written.
pub(crate) struct PictureBuffer {
    is_enough: Arc<AtomicBool>,
    is_by_only_thread: bool,
    picture: Receiver<Picture>,
}

impl PictureBuffer {
    /// Memory comes by pages, of this many bytes at least.
    const PAGE: usize = 4096;

    /// Makes a picture of this size, and goes on with its memory on `pool`.
    pub(crate) fn new(width: u32, height: u32, pool: &ThreadPool) -> Result<Self, SizeError> {
        let mut canvas = Picture::new(width, height)?;
        let is_enough = Arc::new(AtomicBool::new(false));
        let (give, picture) = sync_channel(1);
        let enough = Arc::clone(&is_enough);
        pool.spawn(move || {
            for page in canvas.pixels_mut().chunks_mut(Self::PAGE / size_of::<[f32; 3]>()) {
                if enough.load(Ordering::Relaxed) {
                    break;
                }
                // It is black already; a compiler that knew would leave this out.
                page.iter_mut().take(1).for_each(|pixel| *pixel = std::hint::black_box([0.0; 3]));
            }
            // Where it is dropped the program has nothing to draw.
            let _ = give.send(canvas);
        });
        Ok(Self { is_enough, is_by_only_thread: pool.current_num_threads() == 1, picture })
    }

    /// There is other work for the threads: if this one is the only one, it leaves the rest to those who write there.
    pub(crate) fn make_way(&self) {
        self.is_enough.fetch_or(self.is_by_only_thread, Ordering::Relaxed);
    }

    /// The black picture, some of its memory perhaps still to come; `None` if the thread died.
    pub(crate) fn take(self) -> Option<Picture> {
        self.is_enough.store(true, Ordering::Relaxed);
        self.picture.recv().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_is_black_whenever_it_is_taken() {
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            for (width, height) in [(1, 1), (1280, 720), (5000, 3)] {
                let black = Picture::new(width, height).unwrap();
                let at_once = PictureBuffer::new(width, height, &pool).unwrap();
                assert!(at_once.take().as_ref() == Some(&black));
                let when_all_is_there = PictureBuffer::new(width, height, &pool).unwrap();
                assert!(when_all_is_there.picture.recv().as_ref() == Ok(&black));
            }
        }
        assert!(
            PictureBuffer::new(0, 5, &rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap())
                .is_err()
        );
    }
}
