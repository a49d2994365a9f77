//! An open graphics card.

use std::sync::Arc;

use crate::choice::{GpuChoice, is_software};
use crate::error::GpuError;
use crate::pipelines::{Pipelines, STORED};
use crate::watch::LossWatch;

/// An open graphics card, with the shaders compiled so far.
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    info: GpuInfo,
    pub(crate) pipelines: Pipelines,
    pub(crate) watch: Arc<LossWatch>,
}

/// The name, interface and driver of a graphics card.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GpuInfo {
    /// The name that its maker gives it.
    pub name: String,
    /// The interface by which it is driven, such as `Vulkan`.
    pub interface: String,
    /// The driver and its version, as far as they are known.
    pub driver: String,
    /// Whether it is a driver that computes on the CPU.
    pub is_software: bool,
}

impl Gpu {
    /// Opens a graphics card.
    ///
    /// # Errors
    /// When there is none, none that is wanted, or it lacks something.
    pub async fn open(choice: &GpuChoice) -> Result<Self, GpuError> {
        let adapter = choice.find().await?;
        let info = adapter.get_info();
        check_compute(&adapter)?;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("catoptric"),
            required_features: adapter.features() & Self::wanted_features(),
            required_limits: adapter.limits(),
            ..wgpu::DeviceDescriptor::default()
        };
        let opened = adapter.request_device(&descriptor).await;
        let (device, queue) = opened.map_err(|error| GpuError::NotOpened(error.to_string()))?;
        // Errors are looked for where they arise; one that arises elsewhere must not end the program.
        device.on_uncaptured_error(Arc::new(|_| {}));
        let watch = LossWatch::over(&device, || {});
        if cfg!(target_family = "wasm") {
            // Not every answer is waited for there.
            watch.mind_errors();
        }
        Self::new(device, queue, &info, watch)
    }

    /// Draws with a device that others, such as a window, use too. From now on its loss is recorded here.
    ///
    /// # Errors
    /// When it lacks something.
    pub fn on(device: wgpu::Device, queue: wgpu::Queue) -> Result<Self, GpuError> {
        let watch = LossWatch::over(&device, || {});
        Self::watched(device, queue, watch)
    }

    /// Draws with a device of others that is watched already.
    ///
    /// # Errors
    /// When it lacks something.
    pub fn watched(
        device: wgpu::Device,
        queue: wgpu::Queue,
        watch: Arc<LossWatch>,
    ) -> Result<Self, GpuError> {
        let info = device.adapter_info();
        Self::new(device, queue, &info, watch)
    }

    /// Features that are used where a card has them.
    pub fn wanted_features() -> wgpu::Features {
        wgpu::Features::TIMESTAMP_QUERY
    }

    fn new(
        device: wgpu::Device,
        queue: wgpu::Queue,
        info: &wgpu::AdapterInfo,
        watch: Arc<LossWatch>,
    ) -> Result<Self, GpuError> {
        check_limits(&device.limits(), &info.name)?;
        let driver = format!("{} {}", info.driver, info.driver_info).trim().to_owned();
        let info = GpuInfo {
            name: info.name.clone(),
            interface: info.backend.to_string(),
            driver,
            is_software: is_software(info),
        };
        let pipelines = Pipelines::new(&device);
        let gpu = Self { device, queue, info, pipelines, watch };
        gpu.check_alive()?;
        Ok(gpu)
    }

    /// Calls the card so where it is told of: browsers say little of a card to the program itself.
    #[must_use]
    pub fn with_name(mut self, name: String) -> Self {
        self.info.name = name;
        self
    }

    /// What is known of the card.
    pub fn info(&self) -> &GpuInfo {
        &self.info
    }

    /// Gives the card back, whatever it is doing; all further work fails.
    pub fn destroy(&self) {
        self.watch.destroy();
    }

    /// Fails if the card is lost.
    pub(crate) fn check_alive(&self) -> Result<(), GpuError> {
        self.watch.lost().map_or(Ok(()), |message| Err(GpuError::Lost(message.to_owned())))
    }

    /// Takes note that the card is lost.
    pub(crate) fn lose(&self, message: &str) -> GpuError {
        self.watch.lose(message);
        GpuError::Lost(self.watch.lost().unwrap_or(message).to_owned())
    }

    /// What `act` does with the device, or the error that the driver has about it. `bytes` of memory are taken by it.
    pub(crate) async fn guarded<T>(
        &self,
        bytes: u64,
        act: impl FnOnce(&wgpu::Device) -> T,
    ) -> Result<T, GpuError> {
        self.check_alive()?;
        // The scopes are a stack: other work on a page must not come before all are taken away again.
        let (done, faults, memory) = {
            let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
            let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
            let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
            let done = act(&self.device);
            (done, [internal.pop(), validation.pop()], memory.pop())
        };
        let [internal, validation] = faults;
        let faults = [internal.await, validation.await];
        let memory = memory.await;
        if memory.is_some() || faults.iter().any(Option::is_some) {
            // That the card is lost may show as another fault first; it is told when the device is looked at.
            self.look()?;
        }
        self.check_alive()?;
        if memory.is_some() {
            return Err(GpuError::OutOfMemory(bytes));
        }
        match faults.into_iter().flatten().next() {
            Some(fault) => Err(GpuError::Refused(one_line(&fault.to_string()))),
            None => Ok(done),
        }
    }

    /// What `act` does with the device, where nothing goes wrong unless the card is lost. A page does not wait for the
    /// driver's word on that, which takes a turn of its worker; there an error is a loss.
    pub(crate) async fn trusted<T>(&self, act: impl FnOnce(&wgpu::Device) -> T) -> Result<T, GpuError> {
        if cfg!(target_family = "wasm") {
            self.check_alive()?;
            return Ok(act(&self.device));
        }
        self.guarded(0, act).await
    }

    /// Memory on the card.
    ///
    /// # Errors
    /// When it is too large for the card, or there is too little left.
    pub(crate) async fn buffer(
        &self,
        what: &'static str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, GpuError> {
        let limits = self.device.limits();
        let mut limit = limits.max_buffer_size;
        if usage.contains(wgpu::BufferUsages::STORAGE) {
            limit = limit.min(limits.max_storage_buffer_binding_size);
        }
        if bytes > limit {
            return Err(GpuError::TooLarge { card: self.info.name.clone(), what, bytes, limit });
        }
        let descriptor =
            wgpu::BufferDescriptor { label: Some(what), size: bytes, usage, mapped_at_creation: false };
        self.guarded(bytes, |device| device.create_buffer(&descriptor)).await
    }
}

fn one_line(words: &str) -> String {
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn check_compute(adapter: &wgpu::Adapter) -> Result<(), GpuError> {
    let flags = adapter.get_downlevel_capabilities().flags;
    if flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS) {
        return Ok(());
    }
    Err(GpuError::Missing { card: adapter.get_info().name, what: "compute shaders" })
}

fn check_limits(limits: &wgpu::Limits, card: &str) -> Result<(), GpuError> {
    let lacks = |what| Err(GpuError::Missing { card: card.to_owned(), what });
    if limits.max_compute_invocations_per_workgroup < 64 || limits.max_compute_workgroup_size_x < 64 {
        return lacks("compute shaders of 64 threads to a group");
    }
    if limits.max_storage_buffers_per_shader_stage < *STORED.end() {
        return lacks("eight storage buffers to a shader");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_card_without_room_for_the_shader_is_refused() {
        let limits = wgpu::Limits::downlevel_webgl2_defaults();
        let error = check_limits(&limits, "an old card").unwrap_err().to_string();
        assert!(error.contains("an old card") && error.contains("compute shaders"), "{error}");
        assert_eq!(check_limits(&wgpu::Limits::default(), "a card"), Ok(()));
        let few = wgpu::Limits { max_storage_buffers_per_shader_stage: 4, ..wgpu::Limits::default() };
        assert!(check_limits(&few, "a card").is_err());
    }
}
