//! Every shader that a stage may need is sound, which naga tells without a card.

use catoptric_tracer::twin::{ENTRY_POINT, Physical, Specialization, shader};
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// The shader as naga has it, or why it is none.
pub(crate) fn parsed(source: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(&module)
        .map_err(|error| error.emit_to_string(source))?;
    Ok(module)
}

/// What stages may have of physical materials.
const PHYSICAL: [Physical; 7] = [
    Physical::LAWS,
    Physical::METALS,
    Physical::FACETS,
    Physical::ABSORBS,
    Physical::DISPERSES,
    Physical::BALLS,
    Physical::ALL,
];

/// Few bodies and many, without transparency and with it, and each shape alone.
pub(crate) fn kinds() -> Vec<Specialization> {
    let mut kinds = Vec::new();
    for depth in [0, 1, 9] {
        for (media, stack) in [(0, 0), (1, 4), (16, 64)] {
            for shapes in [0, 1, 2, 4, 8, 16, 32, 63] {
                let asks_each_start = media > 0 && shapes == 63;
                let checkers = shapes % 2 == 1;
                let plain = Specialization {
                    shapes,
                    depth,
                    media,
                    stack,
                    checkers,
                    asks_each_start,
                    physical: Physical::NOTHING,
                };
                kinds.push(plain);
                if [0, 63].contains(&shapes) {
                    kinds.extend(PHYSICAL.map(|physical| Specialization { physical, ..plain }));
                }
            }
        }
    }
    kinds
}

#[test]
fn every_kind_of_shader_is_valid() {
    for kind in kinds() {
        match parsed(&shader(&kind)) {
            Ok(module) => assert!(module.entry_points.iter().any(|entry| entry.name == ENTRY_POINT)),
            Err(error) => panic!("{kind:?}: {error}"),
        }
    }
}

/// The test itself can fail.
#[test]
fn a_broken_shader_is_noticed() {
    let source = shader(&Specialization::default());
    let wrong_type = source.replacen("fn largest(vector: vec3<f32>)", "fn largest(vector: vec2<f32>)", 1);
    assert!(parsed(&source).is_ok() && wrong_type != source);
    assert!(parsed(&wrong_type).is_err());
    let missing = source.replacen("const POINT_ROUNDING", "const POINT", 1);
    assert!(parsed(&missing).unwrap_err().contains("POINT_ROUNDING"));
}

#[test]
fn the_shader_that_develops_is_valid() {
    let module = parsed(catoptric_picture::Development::SHADER);
    assert!(module.is_ok(), "{module:?}");
}
