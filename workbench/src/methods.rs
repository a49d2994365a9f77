//! The documents' pictures of the methods: `docs/methods/`.

use anyhow::{Context as _, Result};
use catoptric_picture::{HeatMap, Picture, heat_map};
use catoptric_scene::Example;
use catoptric_tracer::raster::{
    CubeMapSettings, GBufferLayer, Method, MethodKind, MethodOutput, ShadingSettings, SsrSettings, draw,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use xtask::root;

use crate::gallery::write_jpeg;
use crate::sheet::Sheet;

/// Size of each picture, and how many times smaller it is on its sheet.
const SIZE: (u32, u32) = (960, 540);
const REDUCED: u32 = 2;
/// The difference that is lightest in the maps: an eighth of white, since the methods are far off.
const MOST: f64 = 0.125;

pub(crate) fn run() -> Result<()> {
    let folder = root().join("docs/methods");
    std::fs::create_dir_all(&folder).context("docs/methods")?;
    let example = Example::find("four-bodies").context("the example four-bodies")?;
    let render_scene = RenderScene::build(&example.load()?.scene)?;
    let truth = drawn(&render_scene, &Method::Whitted)?.picture;
    for kind in MethodKind::ALL.into_iter().filter(|kind| !kind.abilities().is_reference) {
        println!("{kind}");
        let mut drawings = vec![drawn(&render_scene, &shown(kind))?];
        if kind == MethodKind::CubeMap {
            let corrected = CubeMapSettings { parallax: true, ..CubeMapSettings::default() };
            drawings.push(drawn(&render_scene, &Method::CubeMap(corrected))?);
        }
        let mut sheet = Sheet::new(SIZE, REDUCED, 3);
        for drawing in &drawings {
            let heat = HeatMap { maximum: MOST, legend: false, ..HeatMap::default() };
            let difference = heat_map(&truth, &drawing.picture, &heat)?;
            [&truth, &drawing.picture, &difference].into_iter().for_each(|picture| sheet.add(picture));
        }
        write_jpeg(&folder.join(format!("{kind}.jpg")), &sheet.picture()?)?;
        let Some(drawing) = drawings.first() else { continue };
        if kind == MethodKind::Ssr {
            let mut sheet = Sheet::new(SIZE, REDUCED, 3);
            for layer in [
                GBufferLayer::Depth,
                GBufferLayer::Normal,
                GBufferLayer::Body,
                GBufferLayer::Coefficients,
                GBufferLayer::Lit,
                GBufferLayer::Reflected,
            ] {
                drawing.layer(&render_scene, layer)?.iter().for_each(|picture| sheet.add(picture));
            }
            write_jpeg(&folder.join("layers.jpg"), &sheet.picture()?)?;
        }
        if let Some((_, map)) = drawing.maps(&render_scene).first() {
            write_jpeg(&folder.join("unfolded.jpg"), &halved(&map.unfolded()?)?)?;
        }
    }
    Ok(())
}

/// The method as its page shows it: faces that can be seen.
fn shown(kind: MethodKind) -> Method {
    let coarse = ShadingSettings { fineness: 5, ..ShadingSettings::default() };
    match kind {
        MethodKind::Whitted => Method::Whitted,
        MethodKind::Flat => Method::Flat(coarse),
        MethodKind::Gouraud => Method::Gouraud(coarse),
        MethodKind::Phong => Method::Phong(coarse),
        MethodKind::Ssr => Method::Ssr(SsrSettings::default()),
        MethodKind::CubeMap => Method::CubeMap(CubeMapSettings::default()),
    }
}

fn drawn(render_scene: &RenderScene, method: &Method) -> Result<MethodOutput> {
    let settings = RenderSettings { width: SIZE.0, height: SIZE.1, samples: 1 };
    Ok(draw(render_scene, method, settings, &RenderControl::default())?)
}

/// The picture half as large.
fn halved(picture: &Picture) -> Result<Picture> {
    let mut sheet = Sheet::new((picture.width(), picture.height()), 2, 1);
    sheet.add(picture);
    sheet.picture()
}
