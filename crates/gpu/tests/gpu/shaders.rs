//! Every shader that a scene may need is sound, which naga tells without a card.

use catoptric_tracer::shaders::{
    ENTRY_POINT, EnvironmentKind, PhysicalFeatures, ShaderSpecialization, shader,
};
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// The shader as naga has it, or why it is none.
pub(crate) fn parsed(source: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(&module)
        .map_err(|error| error.emit_to_string(source))?;
    Ok(module)
}

/// What scenes may have of physical materials.
const PHYSICAL: [PhysicalFeatures; 8] = [
    PhysicalFeatures::LAWS,
    PhysicalFeatures::METALS,
    PhysicalFeatures::FACETS,
    PhysicalFeatures::ABSORBS,
    PhysicalFeatures::DISPERSES,
    PhysicalFeatures::BALLS,
    PhysicalFeatures::CEMENTED,
    PhysicalFeatures::ALL,
];

/// Few bodies and many, without transparency and with it, and each shape alone.
pub(crate) fn kinds() -> Vec<ShaderSpecialization> {
    let mut kinds = Vec::new();
    for depth in [0, 1, 9] {
        for (media, stack) in [(0, 0), (1, 4), (16, 64)] {
            for shapes in [0, 1, 2, 4, 8, 16, 32, 64, 127] {
                let asks_each_start = media > 0 && shapes == 127;
                let plain = ShaderSpecialization {
                    shapes,
                    depth,
                    media,
                    stack,
                    shadowless: shapes == 127,
                    solids: shapes % 2 == 1,
                    any_solids: depth == 1,
                    asks_each_start,
                    physical: PhysicalFeatures::NOTHING,
                    sky: EnvironmentKind::Even,
                    textures: false,
                    parts: 0,
                    members: false,
                };
                kinds.push(plain);
                kinds.extend(with_pictures(plain));
                if [0, 127].contains(&shapes) {
                    kinds.extend(PHYSICAL.map(|physical| ShaderSpecialization { physical, ..plain }));
                    kinds.extend(with_pictures(ShaderSpecialization {
                        physical: PhysicalFeatures::ALL,
                        ..plain
                    }));
                    let members = ShaderSpecialization { members: true, ..plain };
                    kinds.extend([0, 1, 64].map(|parts| ShaderSpecialization { parts, ..members }));
                    kinds.push(ShaderSpecialization { parts: 4, physical: PhysicalFeatures::ALL, ..members });
                }
            }
        }
    }
    kinds
}

/// A kind of scene with each sky and with textures.
fn with_pictures(kind: ShaderSpecialization) -> [ShaderSpecialization; 4] {
    let all = [
        (EnvironmentKind::Gradient, false),
        (EnvironmentKind::Picture, false),
        (EnvironmentKind::Even, true),
        (EnvironmentKind::Picture, true),
    ];
    all.map(|(sky, textures)| ShaderSpecialization { sky, textures, ..kind })
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

/// Numbers of single precision whose digits name one beyond the largest, `3.4028235e38f`, are rounded to it by naga and
/// refused by Tint, Chromium's compiler.
#[test]
fn no_number_is_beyond_single_precision() {
    let words = |source: &str| -> Vec<String> {
        let is_within = |c: char| c.is_ascii_alphanumeric() || c == '.' || c == '_';
        source.split(|c| !is_within(c)).map(str::to_owned).collect()
    };
    let is_beyond = |word: &String| {
        let digits = word.strip_suffix('f').filter(|digits| !digits.starts_with("0x")).unwrap_or(word);
        let is_number = digits.starts_with(|first: char| first.is_ascii_digit());
        is_number && digits.parse::<f64>().is_ok_and(|number| number.abs() > f64::from(f32::MAX))
    };
    assert!(is_beyond(&"3.4028235e38f".to_owned()));
    for kind in kinds() {
        let beyond: Vec<String> = words(&shader(&kind)).into_iter().filter(is_beyond).collect();
        assert!(beyond.is_empty(), "{kind:?}: {beyond:?}");
    }
}

/// Scenes without pictures pay nothing for them.
#[test]
fn shaders_without_pictures_know_nothing_of_them() {
    for physical in [PhysicalFeatures::NOTHING, PhysicalFeatures::ALL] {
        let even = ShaderSpecialization { physical, ..ShaderSpecialization::default() };
        for own in ["pictures: texture", "fn image_at", "fn texture_place", "fn angle_of"] {
            assert!(!shader(&even).contains(own), "{own}");
            assert!(shader(&ShaderSpecialization { textures: true, ..even }).contains(own), "{own}");
            assert!(
                !shader(&ShaderSpecialization { sky: EnvironmentKind::Gradient, ..even }).contains(own),
                "{own}"
            );
        }
    }
}

/// Scenes without joined bodies pay nothing for them.
#[test]
fn shaders_without_joined_bodies_know_nothing_of_them() {
    let none = ShaderSpecialization::default();
    for own in ["fn joined_walk", "part_spans", "fn gates_hold"] {
        assert!(!shader(&none).contains(own), "{own}");
        assert!(shader(&ShaderSpecialization { parts: 2, ..none }).contains(own), "{own}");
    }
}

/// The test itself can fail.
#[test]
fn a_broken_shader_is_noticed() {
    let source = shader(&ShaderSpecialization::default());
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
