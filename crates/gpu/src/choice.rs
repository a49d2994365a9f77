//! The choice of a graphics card.

use std::path::Path;

use catoptric_platform::files;

use crate::error::GpuError;

/// The choice of a graphics card.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GpuChoice {
    /// Whether a driver that computes on the CPU will do (Mesa's lavapipe, Microsoft's WARP); not by default.
    pub software: bool,
    /// A part of the card's name, in any case; any card by default.
    pub name: Option<String>,
}

impl GpuChoice {
    /// Whether there may be such a card, as far as can be told in no time: a driver takes a while to wake up. Linux
    /// shows cards as files.
    pub fn is_likely(&self) -> bool {
        const FILES: [&str; 4] = ["/dev/dri", "/dev/nvidiactl", "/dev/dxg", "/dev/mali0"];
        self.software || !cfg!(target_os = "linux") || FILES.iter().any(|file| files::exists(Path::new(file)))
    }

    /// The best card that there is: by itself before one that shares the computer's memory, and a software driver last.
    ///
    /// # Errors
    /// When there is none, or none that is wanted.
    pub(crate) async fn find(&self) -> Result<wgpu::Adapter, GpuError> {
        // OpenGL only where there is nothing better: looking for it, some libraries write complaints to the terminal.
        let best = adapters(wgpu::Backends::PRIMARY).await;
        let found = if best.is_empty() { adapters(wgpu::Backends::GL).await } else { best };
        self.among(found, wgpu::Adapter::get_info)
    }

    /// The first of those wanted.
    fn among<A>(&self, adapters: Vec<A>, info: impl Fn(&A) -> wgpu::AdapterInfo) -> Result<A, GpuError> {
        let names: Vec<String> = adapters.iter().map(|adapter| info(adapter).name).collect();
        let Some(first) = names.first() else { return Err(GpuError::NoAdapter) };
        let is_named = |name: &str| {
            let wanted = self.name.as_deref().unwrap_or_default().to_lowercase();
            name.to_lowercase().contains(&wanted)
        };
        let missing = match &self.name {
            Some(wanted) if !names.iter().any(|name| is_named(name)) => {
                GpuError::NoSuchAdapter { wanted: wanted.clone(), present: names.join(", ") }
            }
            _ => GpuError::OnlySoftware(first.clone()),
        };
        let is_wanted = |adapter: &A| {
            let info = info(adapter);
            is_named(&info.name) && (self.software || !is_software(&info))
        };
        adapters.into_iter().find(is_wanted).ok_or(missing)
    }
}

/// The cards that can be driven in one of these ways, the best first.
async fn adapters(backends: wgpu::Backends) -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        flags: wgpu::InstanceFlags::empty(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let mut adapters = instance.enumerate_adapters(backends).await;
    adapters.sort_by_key(|adapter| rank(&adapter.get_info()));
    adapters
}

/// Whether it computes on the CPU.
pub(crate) fn is_software(info: &wgpu::AdapterInfo) -> bool {
    info.device_type == wgpu::DeviceType::Cpu
}

/// The order of preference, the best first.
fn rank(info: &wgpu::AdapterInfo) -> u8 {
    match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn card(name: &str, device_type: wgpu::DeviceType) -> wgpu::AdapterInfo {
        let mut info = wgpu::AdapterInfo::new(device_type, wgpu::Backend::Vulkan);
        info.name = name.to_owned();
        info
    }

    fn chosen(choice: &GpuChoice, mut cards: Vec<wgpu::AdapterInfo>) -> Result<String, GpuError> {
        cards.sort_by_key(rank);
        choice.among(cards, Clone::clone).map(|info| info.name)
    }

    #[test]
    fn a_card_of_its_own_comes_first_and_software_only_when_asked() {
        use wgpu::DeviceType::{Cpu, DiscreteGpu, IntegratedGpu};
        let cards = vec![card("llvmpipe", Cpu), card("Iris", IntegratedGpu), card("GeForce", DiscreteGpu)];
        let any = GpuChoice::default();
        assert_eq!(chosen(&any, cards.clone()), Ok("GeForce".to_owned()));
        let named = GpuChoice { name: Some("iris".to_owned()), ..GpuChoice::default() };
        assert_eq!(chosen(&named, cards.clone()), Ok("Iris".to_owned()));
        let software = vec![card("llvmpipe", Cpu)];
        assert_eq!(chosen(&any, software.clone()), Err(GpuError::OnlySoftware("llvmpipe".to_owned())));
        let asked = GpuChoice { software: true, ..GpuChoice::default() };
        assert_eq!(chosen(&asked, software), Ok("llvmpipe".to_owned()));
        assert_eq!(chosen(&any, Vec::new()), Err(GpuError::NoAdapter));
        let unknown = GpuChoice { name: Some("Voodoo".to_owned()), software: true };
        let error = chosen(&unknown, cards).unwrap_err().to_string();
        assert!(error.contains("Voodoo") && error.contains("GeForce, Iris, llvmpipe"), "{error}");
    }
}
