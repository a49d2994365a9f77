//! Rays side by side and rays by themselves have the same outcome.

use std::path::Path;

use super::*;
use crate::lanes::One;

const SIZE: (usize, usize) = (90, 50);

/// The light of a picture's pixels, traced in one width, and the rays that it took.
fn trace(stage: &Stage, mut trace: impl FnMut(Sample<'_, '_>) -> bool) -> (Vec<DVec3>, RayCounts) {
    let control = Control::default();
    let mut tracer = TileTracer::new(stage, stage.camera(), &control);
    let size = DVec2::new(SIZE.0 as f64, SIZE.1 as f64);
    let mut light = Vec::new();
    for place in Place::all(SIZE.0, SIZE.1) {
        tracer.sums.clear();
        tracer.sums.resize(place.pixels(), [0.0; 3]);
        assert!(trace(Sample { tracer: &mut tracer, place, size, sample: 1 }));
        light.extend(tracer.sums.iter().copied().map(DVec3::from));
    }
    (light, tracer.counts())
}

/// Only the order differs in which the light of a pixel's rays is summed, in double precision.
#[test]
fn all_widths_trace_the_same_picture() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
    for name in ["whitted", "corridor", "transforms", "coloured-glass", "inside", "parallel", "cloud"] {
        let scene = catoptric_scene::load(folder.join(format!("{name}.toml"))).unwrap().scene;
        let stage = Stage::prepare(&scene).unwrap();
        let (alone, rays) = trace(&stage, |sample| sample.run(One));
        for (lanes_name, lanes) in Lanes::all() {
            let (wide, wide_rays) = trace(&stage, |sample| lanes.run(sample));
            assert_eq!(wide_rays, rays, "{name}, {lanes_name}");
            let off =
                wide.iter().zip(&alone).filter(|(a, b)| (**a - **b).abs().max_element() > 1e-12).count();
            assert_eq!(off, 0, "{name}, {lanes_name}: pixels that differ");
        }
    }
}

#[test]
fn a_block_at_the_border_has_no_pixels_beyond_it() {
    let place = Place { x: 64, y: 0, width: 3, height: 2 };
    let block = Block::new(One);
    assert_eq!(block.pixels(place, 2, 1).0, 1);
    assert_eq!(block.pixels(place, 3, 1).0, 0);
}
