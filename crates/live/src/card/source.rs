//! Where a card comes from.

use std::pin::Pin;
use std::sync::Arc;

use catoptric_gpu::{Gpu, GpuChoice, GpuError};

/// A graphics card to draw with. It is opened by the task that drives it.
pub struct CardSource(Box<dyn FnOnce() -> Opening + Send>);

type Opening = Pin<Box<dyn Future<Output = Result<Arc<Gpu>, GpuError>>>>;

impl CardSource {
    /// A card that nothing else uses, called `name`.
    pub fn open(choice: GpuChoice, name: String) -> Self {
        Self(Box::new(move || {
            Box::pin(async move {
                let gpu = Gpu::open(&choice).await?;
                #[allow(
                    clippy::arc_with_non_send_sync,
                    reason = "a page leaves a card with the task that drives it"
                )]
                Ok(Arc::new(gpu.with_name(name)))
            })
        }))
    }

    pub(super) async fn gpu(self) -> Result<Arc<Gpu>, GpuError> {
        self.0().await
    }
}

#[cfg(not(target_family = "wasm"))]
impl From<Arc<Gpu>> for CardSource {
    /// A card that others use too.
    fn from(gpu: Arc<Gpu>) -> Self {
        Self(Box::new(|| Box::pin(std::future::ready(Ok(gpu)))))
    }
}

impl std::fmt::Debug for CardSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("CardSource").finish_non_exhaustive()
    }
}
