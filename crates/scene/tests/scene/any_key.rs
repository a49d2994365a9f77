//! Every key of any scene, set to any value that it can have.

use catoptric_scene::format::spec::{KeySpec, Kind, Limits};
use catoptric_scene::{
    Body, Dielectric, Material, MaterialChoice, Model, NamedMaterial, RefractiveIndex, Scene, SceneEdit,
    SceneKey, ScenePath, SceneValue, read, write,
};
use proptest::prelude::*;

/// Random numbers by S. Vigna's splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// A number of a range: its ends, or something between, in any order of magnitude.
    fn number(&mut self, Limits { min, max }: Limits) -> f64 {
        let part = self.next() as f64 / u64::MAX as f64;
        let between = match self.below(4) {
            0 => min,
            1 => max,
            2 => min + (max - min) * part,
            _ => max * 1e-12_f64.powf(part),
        };
        between.clamp(min, max)
    }

    /// A valid value of a key.
    fn value(&mut self, scene: &Scene, key: &KeySpec) -> SceneValue {
        match key.kind {
            Kind::Text => format!("name {}", self.next()).as_str().into(),
            Kind::File => ["builtin:grid", "a/b.png"][self.below(2)].into(),
            Kind::Flag => (self.below(2) == 0).into(),
            Kind::Choice(words) => words[self.below(words.len())].into(),
            Kind::Number(limits) => self.number(limits).into(),
            Kind::Integer(limits) => self.number(limits).round().into(),
            Kind::NumberOrVector(limits) if self.below(2) == 0 => self.number(limits).into(),
            Kind::Vector(limits) | Kind::NumberOrVector(limits) | Kind::Color(limits) => {
                [self.number(limits), self.number(limits), self.number(limits)].into()
            }
            Kind::NameOrTable(_) => scene.materials[self.below(scene.materials.len())].name.as_str().into(),
            Kind::Version(_) | Kind::Table(_) | Kind::Named(_) | Kind::List(_) => panic!("no value"),
        }
    }
}

/// Whether another value of the key leaves all other keys as they are.
fn stands_alone(key: &KeySpec) -> bool {
    !matches!(key.kind, Kind::Choice(_) | Kind::NameOrTable(_))
        && key.excludes.is_empty()
        && key.requires.is_none()
}

/// How errors of rules between several values begin.
const RULES: [&str; 18] = [
    "`target` and",
    "`up` is",
    "`base` and `top` are",
    "`focal_length` ",
    "`inner_radius` is not smaller",
    "`thickness` is not smaller",
    "the rim of this",
    "a face with a radius",
    "the faces of this lens",
    "the ball of a face",
    "a lens whose index",
    "no lens of this",
    "this union has",
    "this intersection has",
    "this difference has",
    "a surface has no inside",
    "the first part of a surface",
    "the corners `a`",
];

/// Sets a random value of a key, and holds the scene against what must be true then.
fn check_key(before: &Scene, key: &SceneKey, random: &mut Random) -> Result<(), TestCaseError> {
    let SceneKey { path, spec, value: old } = key;
    // Few names are those of bodies.
    if spec.name == "instance_of" {
        return Ok(());
    }
    let value = random.value(before, spec);
    let partner = spec.requires.map(|partner| {
        let text = path.to_string();
        let (table, _) = text.rsplit_once('.').unwrap();
        format!("{table}.{partner}").parse::<ScenePath>().unwrap()
    });
    let mut edits = vec![SceneEdit { path: path.clone(), value: Some(value.clone()) }];
    if let Some(partner) = partner.filter(|partner| before.get(partner).is_err()) {
        let other = match spec.name {
            "layer" => "builtin:grid".into(),
            "ior" => 2.0.into(),
            _ => [1.0, 2.0, 3.0].into(),
        };
        edits.push(SceneEdit { path: partner, value: Some(other) });
    }
    let mut scene = before.clone();
    if let Err(error) = scene.edit(&edits) {
        // Only the rules between several values are left to be broken.
        let error = error.to_string();
        prop_assert!(
            RULES.iter().any(|rule| error.starts_with(rule)) || error.contains("needs at least one part"),
            "{path} = {value}: {error}"
        );
        prop_assert_eq!(&scene, before);
        return Ok(());
    }
    let renamed = (*spec.name == *"name").then(|| {
        let text = path.to_string();
        let list = match text.rsplit_once(".parts.") {
            Some((whole, _)) => format!("{whole}.parts"),
            None => text.split('.').next().unwrap().to_owned(),
        };
        format!("{list}.{value}.name").parse::<ScenePath>().unwrap()
    });
    let path = renamed.as_ref().unwrap_or(path);
    let read_back = scene.get(path);
    let three_equal = matches!(value, SceneValue::Vector([a, b, c]) if a == b && b == c);
    match (&spec.kind, &value) {
        (Kind::NumberOrVector(_), SceneValue::Vector([number, ..])) if three_equal => {
            prop_assert_eq!(read_back, Ok((*number).into()));
        }
        _ => prop_assert_eq!(read_back, Ok(value.clone()), "{}", path),
    }
    prop_assert_eq!(scene.check(), vec![], "{} = {}", path, value);
    let text = write(&scene);
    let reading = read(&text);
    prop_assert!(!reading.diagnostics.has_errors(), "{} = {}: {}", path, value, reading.diagnostics);
    prop_assert_eq!(&reading.scene, &scene, "{} = {}", path, value);
    match old {
        Some(old) if stands_alone(spec) && renamed.is_none() => {
            let kept = |key: &SceneKey| key.path == *path || scene.get(&key.path).ok() == key.value;
            let changed = before.keys().find(|key| !kept(key));
            prop_assert!(changed.is_none(), "{} = {} changes {:?}", path, value, changed);
            scene.set(path, old.clone()).unwrap();
        }
        None if stands_alone(spec) => {
            let text = path.to_string();
            let table =
                ["environment.sky", ".checker", ".stripes", ".rings", ".gradient"].iter().find_map(|table| {
                    let end = text.find(table)? + table.len();
                    text.get(..end).filter(|_| before.get(path).is_err())
                });
            scene.unset(&table.unwrap_or(&text).parse().unwrap()).unwrap();
        }
        _ => return Ok(()),
    }
    prop_assert_eq!(&scene, before, "{} = {}", path, value);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_set_at_any_key_is_read_back(scene in crate::common::scene(), seed in any::<u64>()) {
        let mut scene = scene;
        if scene.materials.is_empty() {
            scene.materials.push(NamedMaterial { name: "m".to_owned(), material: Material::default() });
        }
        // Half of the keys for each of two threads: it takes long.
        let keys: Vec<SceneKey> = scene.keys().collect();
        let (few, rest) = keys.split_at(keys.len() / 2);
        let check_half = |keys: &[SceneKey], seed| {
            let mut random = Random(seed);
            keys.iter().try_for_each(|key| check_key(&scene, key, &mut random))
        };
        let both = std::thread::scope(|scope| {
            let other = scope.spawn(|| check_half(few, seed));
            [check_half(rest, !seed), other.join().unwrap()]
        });
        for checked in both {
            checked?;
        }
    }

    #[test]
    fn another_model_is_what_the_studio_makes_of_it(material in crate::common::material()) {
        let own = |material| {
            let body = Body { material: MaterialChoice::own(material), ..Body::default() };
            Scene { bodies: [body].into(), ..Scene::default() }
        };
        for model in Model::ALL {
            let mut scene = own(material.clone());
            scene.set(&"bodies.0.material.model".parse().unwrap(), model.key()).unwrap();
            // The index of a substance is no value of the scene.
            let is_substance = |dielectric: &Dielectric| matches!(dielectric.index, RefractiveIndex::Substance(_));
            if !matches!(&material, Material::Dielectric(dielectric) if is_substance(dielectric)) {
                prop_assert_eq!(scene, own(material.with_model(model)));
            }
        }
    }
}
