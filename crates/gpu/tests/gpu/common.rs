//! Scenes, and the card that the tests share.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use catoptric_gpu::{Gpu, GpuChoice, wait};
use catoptric_platform::threads;
use catoptric_scene::{Example, Scene, Shape};
use catoptric_tracer::RenderScene;

/// A card of the test's own; `None` if there is none, which is told (not captured, as the output of tests is).
pub(crate) fn own_card(test: &str) -> Option<Arc<Gpu>> {
    match wait(Gpu::open(&GpuChoice { software: true, name: None })) {
        Ok(gpu) => Some(Arc::new(gpu)),
        Err(error) => {
            let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {test}: {error}");
            None
        }
    }
}

/// How many cards tests share. A software driver compiles shaders, which takes most of the time, on one thread for each
/// device: several devices keep several cores busy.
const SHARED: usize = 2;

/// All cards that tests share; none if there is no card.
pub(crate) fn cards(test: &str) -> &'static [Arc<Gpu>] {
    static CARDS: OnceLock<Vec<Arc<Gpu>>> = OnceLock::new();
    let cards =
        CARDS.get_or_init(|| (0..SHARED).map_while(|_| own_card("the cards that tests share")).collect());
    if cards.is_empty() {
        let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {test}: no graphics card or software driver");
    }
    cards
}

/// One of the cards that tests share, by turns.
pub(crate) fn card(test: &str) -> Option<Arc<Gpu>> {
    static TURN: AtomicUsize = AtomicUsize::new(0);
    let cards = cards(test);
    cards.get(TURN.fetch_add(1, Ordering::Relaxed) % cards.len().max(1)).cloned()
}

pub(crate) fn stage_of(scene: &Scene) -> RenderScene {
    RenderScene::build(scene).unwrap()
}

pub(crate) fn reference(name: &str) -> Scene {
    load(&references_folder().join(format!("{name}.toml")))
}

fn references_folder() -> PathBuf {
    tests_folder().join("reference")
}

fn tests_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests")
}

fn load(path: &Path) -> Scene {
    catoptric_store::load(path).unwrap().scene
}

/// Every reference scene, every scene that is held against Mitsuba's pictures, and every example, by name.
pub(crate) fn all_scenes() -> Vec<(String, Scene)> {
    let mut scenes = scenes_in(&references_folder(), "reference");
    scenes.retain(|(name, _)| !is_left_out(name));
    for (name, mut scene) in scenes_in(&tests_folder().join("mitsuba"), "mitsuba") {
        // They ask for trees that no driver on the processor grows in one go.
        scene.tracing.generations = scene.tracing.generations.min(8);
        scenes.push((name, scene));
    }
    let examples = Example::ALL.iter().map(|example| (example.name, example.load().unwrap().scene));
    let examples = examples.filter(|(_, scene)| !scene.bodies.iter().any(|body| is_joined(body.shape)));
    scenes.extend(examples.map(|(name, scene)| (format!("example {name}"), scene)));
    scenes
}

fn is_joined(shape: Shape) -> bool {
    matches!(shape, Shape::Union | Shape::Intersection | Shape::Difference)
}

/// A software driver compiles the shader of a scene of joined bodies for seconds: what these and the examples show is in
/// others too, and in tests of their own.
fn is_left_out(name: &str) -> bool {
    const DRAWN: [&str; 3] = ["joined-common-face", "joined-inside-glass", "joined-parallel"];
    name.contains(" joined-") && !DRAWN.iter().any(|drawn| name.ends_with(drawn))
}

fn scenes_in(folder: &Path, kind: &str) -> Vec<(String, Scene)> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    files.iter().map(|path| (format!("{kind} {}", path.file_stem().unwrap().display()), load(path))).collect()
}

/// A device as a window has it.
pub(crate) fn shared_device() -> Option<(wgpu::Device, wgpu::Queue)> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    threads::wait(async {
        let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await.ok()?;
        adapter.request_device(&wgpu::DeviceDescriptor::default()).await.ok()
    })?
}
