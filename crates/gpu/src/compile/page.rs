//! Compiling on a page. A browser that is told to make a pipeline at once draws nothing meanwhile, not even other pages;
//! `wgpu` cannot tell it otherwise. It makes no pipeline twice, so each is asked for beside other work before.

use std::io;
use std::sync::Arc;

use catoptric_tracer::shaders::ShaderSpecialization;
use js_sys::{Array, Object, Promise, Reflect};
use wasm_bindgen::prelude::*;

use crate::card::Gpu;
use crate::pipelines::layout_entries;

#[wasm_bindgen]
extern "C" {
    /// `GPUDevice` of WebGPU, <https://www.w3.org/TR/webgpu/#gpudevice>.
    type GPUDevice;

    #[wasm_bindgen(method, js_name = createShaderModule)]
    fn create_shader_module(this: &GPUDevice, descriptor: &Object) -> JsValue;

    #[wasm_bindgen(method, js_name = createBindGroupLayout)]
    fn create_bind_group_layout(this: &GPUDevice, descriptor: &Object) -> JsValue;

    #[wasm_bindgen(method, js_name = createPipelineLayout)]
    fn create_pipeline_layout(this: &GPUDevice, descriptor: &Object) -> JsValue;

    #[wasm_bindgen(method, js_name = createComputePipelineAsync)]
    fn create_compute_pipeline_async(this: &GPUDevice, descriptor: &Object) -> Promise;
}

pub(super) fn prepare(
    gpu: Arc<Gpu>,
    special: ShaderSpecialization,
    ready: impl FnOnce() + Send + 'static,
) -> io::Result<()> {
    js_sys::futures::spawn_local(async move {
        let _ = gpu.prepare_for(special).await;
        ready();
    });
    Ok(())
}

/// Compiles a shader, without others having to wait for that. Without what this gives it would have to be done again.
pub(super) async fn compile_ahead(device: &wgpu::Device, source: &str, entry: &str) -> Option<JsValue> {
    let device: &GPUDevice = device.as_webgpu()?.unchecked_ref();
    let entries: Array = layout_entries().iter().map(|entry| JsValue::from(binding(entry))).collect();
    let group = device.create_bind_group_layout(&object(&[("entries", entries.into())]));
    let layout = device.create_pipeline_layout(&object(&[("bindGroupLayouts", Array::of1(&group).into())]));
    let module = device.create_shader_module(&object(&[("code", source.into())]));
    let stage = object(&[("module", module), ("entryPoint", entry.into())]);
    let pipeline = object(&[("layout", layout), ("compute", stage.into())]);
    // What is wrong with it is told when it is asked for again.
    device.create_compute_pipeline_async(&pipeline).await.ok()
}

/// `GPUBindGroupLayoutEntry`, as `wgpu` asks for it.
fn binding(entry: &wgpu::BindGroupLayoutEntry) -> Object {
    const COMPUTE: u32 = 4;
    let (kind, description) = match entry.ty {
        wgpu::BindingType::Buffer { ty, .. } => {
            let name = match ty {
                wgpu::BufferBindingType::Uniform => "uniform",
                wgpu::BufferBindingType::Storage { read_only: true } => "read-only-storage",
                wgpu::BufferBindingType::Storage { read_only: false } => "storage",
            };
            ("buffer", object(&[("type", name.into())]))
        }
        _ => ("texture", object(&[("sampleType", "uint".into())])),
    };
    object(&[("binding", entry.binding.into()), ("visibility", COMPUTE.into()), (kind, description.into())])
}

fn object(members: &[(&str, JsValue)]) -> Object {
    let object = Object::new();
    for (key, value) in members {
        // A fresh object takes every property.
        let _ = Reflect::set(&object, &(*key).into(), value);
    }
    object
}
