//! Values by their addresses.

use catoptric_scene::format::spec::{Default, Kind};
use catoptric_scene::{
    AddressError, Body, Language, List, NoResources, Scene, SceneEdit, SceneKey, ScenePart, ScenePath,
    SceneValue, Shape, Surroundings, read,
};

const SCENE: &str = "
format = 'catoptric/1'
[materials.glass]
model = 'dielectric'
substance = 'water'
[materials.gold]
model = 'conductor'
[materials.'my wood']
color = [0.5, 0.4, 0.3]
[[lights]]
name = 'sun'
intensity = 2
[[lights]]
falloff = 'linear'
[[bodies]]
name = 'ball'
radius = 0.5
position = [1, 2, 3]
material = 'glass'
[[bodies]]
name = 'rod'
shape = 'cylinder'
base = [0, 0, 0]
top = [0, 2, 0]
material = { color = [0.1, 0.2, 0.3] }
[[bodies]]
name = '7'
shape = 'cube'
size = [1, 2, 3]
";

fn scene() -> Scene {
    read(SCENE).into_result().unwrap().value
}

fn path(text: &str) -> ScenePath {
    text.parse().unwrap()
}

fn get(scene: &Scene, at: &str) -> String {
    match scene.get(&path(at)) {
        Ok(value) => value.to_string(),
        Err(error) => error.to_string(),
    }
}

/// Sets values, each as `PATH=VALUE`, all together.
fn set(scene: &mut Scene, edits: &[&str]) -> Result<(), AddressError> {
    let edits: Result<Vec<SceneEdit>, AddressError> = edits.iter().map(|edit| edit.parse()).collect();
    scene.edit(&edits?)
}

#[test]
fn values_are_found_at_their_addresses() {
    let scene = scene();
    for (at, value) in [
        ("camera.fov", "27"),
        ("camera.position", "[0, 2.2, 8]"),
        ("environment.background.b", "0.6"),
        ("tracing.generations", "6"),
        ("materials.glass.substance", "\"water\""),
        ("materials.'my wood'.color.0", "0.5"),
        ("materials.\"my wood\".model", "\"phong\""),
        ("lights.sun.intensity", "2"),
        ("lights.0.intensity", "2"),
        ("lights.1.falloff_constant", "1"),
        ("bodies.ball.position.y", "2"),
        ("bodies.0.material", "\"glass\""),
        ("bodies.ball.scale", "1"),
        ("bodies.ball.scale.z", "1"),
        ("bodies.rod.top.1", "2"),
        ("bodies.rod.material.color.g", "0.2"),
        ("bodies.\"7\".size", "[1, 2, 3]"),
        ("bodies.2.hidden", "false"),
    ] {
        assert_eq!(get(&scene, at), value, "{at}");
    }
}

#[test]
fn an_address_without_a_value_says_why() {
    let scene = scene();
    for (at, said) in [
        ("camra.fov", "the scene has no key `camra`; did you mean `camera`?; the keys of the scene are"),
        ("format", "`format` is not a value of the scene"),
        ("camera", "`camera` is not one value, but several; the keys of the camera are `position`,"),
        ("bodies", "`bodies` is not one value, but several"),
        ("bodies.ball", "`ball` is not one value, but several; the keys of a body are"),
        (
            "bodies.bal.radius",
            "`bodies` has no element `bal`; did you mean `ball`?; an element of `bodies` has",
        ),
        (
            "bodies.7.radius",
            "`bodies` has no element `7`; an element of `bodies` has a name, or a number from 0 to 2",
        ),
        ("materials.glas.ior", "the material `glas` is not defined; did you mean `\"glass\"`?; defined are"),
        ("bodies.ball.radus", "a body has no key `radus`; did you mean `radius`?"),
        (
            "camera.height",
            "`height` is only for `projection` \"parallel\"; here `projection` is \"perspective\"",
        ),
        (
            "bodies.\"7\".radius",
            "`radius` is only for `shape` \"sphere\", \"cylinder\", \"cone\", \"paraboloid\", \"lens\", \"mirror-dish\", \"tube\", \
             \"ring\", \"bowl\", \"prism\", \"open-cylinder\", \"open-cone\" or \"disc\"",
        ),
        ("bodies.rod.position", "`position` cannot stand beside `base`; `base` sets this already"),
        ("materials.glass.ior", "`ior` cannot stand beside `substance`"),
        (
            "materials.gold.n",
            "`n` has no value here; `n` is the refractive index for red, green and blue light",
        ),
        ("environment.sky.zenith", "`sky` has no value here"),
        (
            "bodies.ball.material.ior",
            "the body shares the material `\"glass\"`; its values are under `materials.glass`",
        ),
        ("bodies.rod.material", "the body has a material of its own"),
        (
            "bodies.ball.position.w",
            "`position` has no part `w`; the parts of `position` are `x`, `y` and `z`",
        ),
        ("bodies.ball.position.x.y", "`position` has no part `y`"),
        ("bodies.ball.radius.x", "`radius` has no part `x`; `radius` is the radius"),
        ("environment.ambient.x", "the parts of `ambient` are `r`, `g` and `b`"),
    ] {
        assert!(
            get(&scene, at).starts_with(said) || get(&scene, at).contains(said),
            "{at}: {}",
            get(&scene, at)
        );
    }
    let empty = Scene::default();
    assert_eq!(get(&empty, "lights.0.color"), "`lights` has no element `0`; `lights` is empty");
    let refused = scene.get(&path("bodies.bal.radius")).unwrap_err();
    assert_eq!(refused.path(), "bodies.bal.radius");
    assert_eq!(refused.message(Language::Russian), "в `bodies` нет элемента `bal`");
    assert_eq!(refused.label(Language::Russian).as_deref(), Some("возможно, `ball`?"));
}

#[test]
fn what_no_file_could_say_is_refused_and_changes_nothing() {
    let before = scene();
    for (edits, said) in [
        (
            &["bodies.ball.radius=-1"][..],
            "`radius` is `-1`, but must be greater than 0; `radius` is the radius",
        ),
        (&["bodies.ball.position.y=inf"], "the y of `position` is `inf`, but must be a finite number"),
        (&["tracing.generations=1.5"], "`generations` is `1.5`, but must be a whole number"),
        (&["bodies.ball.radius=big"], "`radius` is a text, but must be a number"),
        (&["bodies.ball.shape=ball"], "`shape` is `ball`, but must be \"sphere\""),
        (&["bodies.ball.shape=cub"], "did you mean `\"cube\"`?"),
        (&["bodies.ball.material=glas"], "the material `glas` is not defined; did you mean `\"glass\"`?"),
        (&["bodies.ball.name=rod"], "two bodies have the name `rod`; give one of them another name"),
        (&["lights.1.name=sun"], "two lights have the name `sun`"),
        (&["camera.target=0, 2.2, 8"], "`target` and `position` of the camera are the same point"),
        (&["bodies.rod.top=0,0,0"], "`base` and `top` are the same point"),
        (&["bodies.rod.height=3"], "`height` cannot stand beside `base`; `base` sets this already"),
        (&["materials.glass.ior=1.4"], "`ior` cannot stand beside `substance`"),
        (&["materials.gold.n=1,1,1"], "`n` needs `k`"),
        (&["camera.height=3"], "`height` is only for `projection` \"parallel\""),
        (&["bodies.ball.position.x=left"], "a part of `position` must be a number"),
        (&["environment.sky=blue"], "`sky` is a text, but must be a table"),
        (&["environment.layer=A"], "`layer` needs `picture`"),
        (&["camera="], "`camera` is not one value, but several"),
        (&["bodies.ball.radius=2", "camera.fov=0"], "`fov` is `0`"),
        (&["bodies.rod.name=stick", "bodies.stick.radius=0", "bodies.ball.radius=2"], "`radius` is `0`"),
    ] {
        let mut scene = before.clone();
        let error = set(&mut scene, edits).unwrap_err();
        assert!(error.to_string().contains(said), "{edits:?}: {error}");
        assert_eq!(scene, before, "{edits:?}");
    }
    for (edit, said) in [
        ("radius", "`=` and a value are missing"),
        (
            "bodies..radius=1",
            "`bodies..radius=1` is not the address of a value; an address is keys and names",
        ),
        ("a=[1, 2]", "`[1, 2]` is not a value; a value is a number, three numbers"),
    ] {
        let error = edit.parse::<SceneEdit>().unwrap_err();
        assert!(error.to_string().starts_with(said), "{edit}: {error}");
    }
}

#[test]
fn several_changes_of_one_element_are_made_together() {
    let mut scene = scene();
    set(&mut scene, &["materials.gold.n=0.2, 0.9, 1.1", "materials.gold.k=3, 2, 2"]).unwrap();
    assert_eq!(get(&scene, "materials.gold.k"), "[3, 2, 2]");
    assert!(get(&scene, "materials.gold.metal").contains("cannot stand beside `n`"));
    set(&mut scene, &["materials.gold.n="]).unwrap();
    assert_eq!(scene, self::scene());
    set(&mut scene, &["bodies.ball.shape=cone", "bodies.ball.base=0,0,0", "bodies.ball.top=0,3,0"]).unwrap();
    assert_eq!(get(&scene, "bodies.ball.top.y"), "3");
    assert_eq!(get(&scene, "bodies.ball.radius"), "0.5");
    set(&mut scene, &["bodies.ball.name=tip", "bodies.tip.top_radius=0.25", "lights.0.hidden=true"]).unwrap();
    assert_eq!(
        (get(&scene, "bodies.tip.top_radius"), get(&scene, "lights.sun.hidden")),
        ("0.25".into(), "true".into())
    );
}

#[test]
fn a_choice_keeps_what_the_new_word_knows() {
    let mut scene = scene();
    set(&mut scene, &["bodies.ball.shape=cylinder"]).unwrap();
    assert_eq!(get(&scene, "bodies.ball.radius"), "0.5");
    assert_eq!(get(&scene, "bodies.ball.height"), "1");
    set(&mut scene, &["bodies.ball.shape=cube"]).unwrap();
    assert_eq!(
        (get(&scene, "bodies.ball.size"), get(&scene, "bodies.ball.position.z")),
        ("1".into(), "3".into())
    );
    set(&mut scene, &["lights.1.falloff_constant=4", "lights.1.falloff=none", "lights.1.falloff=linear"])
        .unwrap();
    assert_eq!(get(&scene, "lights.1.falloff_constant"), "1");
    set(&mut scene, &["camera.projection=parallel", "camera.height=3"]).unwrap();
    assert!(get(&scene, "camera.fov").starts_with("`fov` is only for `projection` \"perspective\""));
}

#[test]
fn a_choice_taken_away_is_as_one_set_to_its_default() {
    let mut start = scene();
    let edits = [
        "bodies.7.shape=paraboloid",
        "bodies.7.height=2",
        "bodies.ball.material=",
        "bodies.ball.material.model=coated",
        "bodies.ball.material.roughness=0.3",
        "lights.1.falloff_constant=4",
        "camera.projection=parallel",
        "camera.height=3",
    ];
    set(
        &mut start,
        &edits.map(|edit| edit.replace("bodies.7", "bodies.\"7\"")).each_ref().map(String::as_str),
    )
    .unwrap();
    let mut tried = 0;
    for key in start.keys().filter(|key| matches!(key.spec.kind, Kind::Choice(_))) {
        let Default::Text(word) = key.spec.default else { continue };
        // What is not there cannot be taken away.
        if key.value.is_none() {
            continue;
        }
        let [mut taken, mut chosen] = [start.clone(), start.clone()];
        taken.unset(&key.path).unwrap();
        chosen.set(&key.path, word).unwrap();
        assert_eq!(taken, chosen, "{}", key.path);
        assert_eq!(taken.check(), vec![], "{}", key.path);
        tried += usize::from(key.value != Some(word.into()));
    }
    // Two shapes, three models, a falloff and the projection are others than their defaults.
    assert_eq!(tried, 7);
}

#[test]
fn a_stronger_key_takes_the_place_of_weaker_ones_and_can_be_taken_away() {
    let mut scene = scene();
    set(&mut scene, &["materials.glass.substance=", "materials.glass.ior=1.4"]).unwrap();
    assert_eq!(get(&scene, "materials.glass.ior"), "1.4");
    set(&mut scene, &["materials.glass.substance=diamond"]).unwrap();
    assert!(get(&scene, "materials.glass.ior").contains("cannot stand beside"));
    set(&mut scene, &["environment.sky.zenith.r=0.9"]).unwrap();
    assert_eq!(get(&scene, "environment.sky.zenith"), "[0.9, 0.28, 0.65]");
    assert_eq!(get(&scene, "environment.sky.horizon.b"), "1");
    set(&mut scene, &["environment.picture=builtin:grid", "environment.layer=A"]).unwrap();
    assert!(get(&scene, "environment.sky.zenith").contains("`sky` has no value"));
    set(&mut scene, &["environment.picture="]).unwrap();
    assert_eq!(scene.environment.surroundings, Surroundings::Even);
    set(&mut scene, &["bodies.rod.material.checker.size=0.5", "bodies.rod.material.color=#ffffff"]).unwrap();
    assert_eq!(get(&scene, "bodies.rod.material.checker.color"), "[0.2, 0.2, 0.2]");
    assert_eq!(get(&scene, "bodies.rod.material.color"), "[1, 1, 1]");
    assert!(get(&scene, "bodies.rod.material.stripes.size").contains("`stripes` has no value"));
    set(&mut scene, &["bodies.rod.material.rings.second.stripes.size=0.1"]).unwrap();
    assert!(get(&scene, "bodies.rod.material.checker.size").contains("`checker` has no value"));
    assert_eq!(get(&scene, "bodies.rod.material.rings.second.stripes.scale"), "1");
    set(&mut scene, &["bodies.rod.material.rings="]).unwrap();
    assert!(get(&scene, "bodies.rod.material.rings.size").contains("`rings` has no value"));
    set(
        &mut scene,
        &["bodies.rod.material=glass", "bodies.ball.material=", "bodies.ball.material.diffuse=0"],
    )
    .unwrap();
    assert_eq!(scene.bodies[1].material.name(), Some("glass"));
    assert_eq!(get(&scene, "bodies.ball.material.diffuse"), "0");
}

#[test]
fn a_picture_that_stays_keeps_its_pixels() {
    let mut scene = scene();
    set(&mut scene, &["environment.picture=builtin:studio", "bodies.rod.material.texture=builtin:grid"])
        .unwrap();
    assert!(scene.images().all(|image| image.pixels().is_none()));
    scene.open_images(&NoResources).unwrap();
    set(&mut scene, &["environment.strength=2", "bodies.rod.radius=2"]).unwrap();
    assert!(scene.images().all(|image| image.pixels().is_some()));
    set(&mut scene, &["bodies.rod.material.texture=builtin:studio"]).unwrap();
    let opened: Vec<bool> = scene.images().map(|image| image.pixels().is_some()).collect();
    assert_eq!(opened, [true, false]);
}

#[test]
fn a_change_copies_only_the_neighbors_of_its_body() {
    let bodies: List<Body> =
        (0..5000).map(|index| Body { name: index.to_string(), ..Body::default() }).collect();
    let before = Scene { bodies, ..Scene::default() };
    let mut scene = before.clone();
    set(&mut scene, &["bodies.1234.radius=2"]).unwrap();
    assert_eq!(scene.bodies.unshared(&before.bodies).count(), List::<Body>::SLICE);
    assert_eq!(get(&scene, "bodies.\"1234\".radius"), "2");
}

#[test]
fn the_keys_of_a_scene_are_those_that_can_be_set() {
    let scene = scene();
    let keys: Vec<String> = scene.keys().map(|key| key.path.to_string()).collect();
    for present in [
        "camera.fov",
        "environment.sky.zenith",
        "environment.picture",
        "materials.\"my wood\".checker.size",
        "materials.glass.substance",
        "lights.1.falloff_constant",
        "bodies.rod.top",
        "bodies.rod.material.color",
        "bodies.\"7\".size",
    ] {
        assert!(keys.iter().any(|key| key == present), "{present}");
    }
    for absent in
        ["format", "camera.height", "materials.glass.ior", "bodies.rod.height", "bodies.ball.material.ior"]
    {
        assert!(!keys.iter().any(|key| key == absent), "{absent}");
    }
    for SceneKey { path, value, .. } in scene.keys() {
        assert_eq!(scene.get(&path).ok(), value, "{path}");
    }
}

#[test]
fn a_key_knows_its_unit_and_what_it_can_be() {
    let scene = scene();
    for (at, unit) in [
        ("bodies.ball.radius", Some("meters")),
        ("bodies.ball.position", Some("meters")),
        ("camera.fov", Some("degrees")),
        ("lights.1.falloff_constant", Some("meters")),
        ("lights.sun.radius", Some("meters")),
        ("bodies.ball.scale", None),
        ("lights.sun.intensity", None),
    ] {
        assert_eq!(scene.key(&path(at)).unwrap().unit(Language::English), unit, "{at}");
    }
    let key = |at: &str| scene.key(&path(at)).unwrap();
    assert_eq!(key("bodies.rod.rotation").unit(Language::Russian), Some("градусы"));
    assert_eq!(
        key("bodies.ball.shape").meaning(Language::English),
        "the shape of the body: \"sphere\", \"cube\", \"cylinder\", \"cone\", \"paraboloid\", \"plane\", \
         \"lens\", \"mirror-dish\", \"tube\", \"ring\", \"bowl\", \"prism\", \"wedge\", \"open-cylinder\", \"open-cone\", \"disc\", \
         \"rectangle\", \"triangle\", \"union\", \"intersection\", \"difference\", \"surface\" or \"group\""
    );
    assert_eq!(
        key("camera.position.x").meaning(Language::Russian),
        "точка наблюдения, метры (от -1e9 до 1e9)"
    );
}

/// A lens of two balls, one of them within a group.
fn lens() -> Scene {
    let text = "format = 'catoptric/1'\n[materials.glass]\n[[bodies]]\nname = 'lens'\nshape = 'intersection'\n\
                [[bodies.parts]]\nname = 'front'\nradius = 2\nmaterial = { ior = 1.6 }\n\
                [[bodies.parts]]\nshape = 'group'\n[[bodies.parts.parts]]\nradius = 3\nmaterial = 'glass'\n";
    read(text).into_result().unwrap().value
}

#[test]
fn parts_have_addresses() {
    let mut scene = lens();
    for (at, value) in [
        ("bodies.lens.parts.0.radius", "2"),
        ("bodies.lens.parts.front.material.ior", "1.6"),
        ("bodies.lens.parts.1.parts.0.radius", "3"),
        ("bodies.lens.parts.1.parts.0.material", "\"glass\""),
        ("bodies.lens.parts.1.position.y", "0"),
    ] {
        assert_eq!(get(&scene, at), value, "{at}");
    }
    let unchanged = scene.clone();
    for (edit, expected) in [
        ("bodies.lens.parts.2.radius=1", "`parts` has no element `2`"),
        ("bodies.lens.parts.frnt.radius=1", "`parts` has no element `frnt`"),
        ("bodies.lens.parts.0.hidden=true", "a part of a body has no key `hidden`"),
        ("bodies.lens.parts.0=1", "`0` is not one value, but several"),
        ("bodies.lens.parts=1", "`parts` is not one value, but several"),
        ("bodies.lens.parts.0.radius=-1", "`radius` is `-1`, but must be greater than 0"),
        ("bodies.lens.parts.1.parts.0.material.ior=2", "the body shares the material `\"glass\"`"),
        ("bodies.lens.parts.0.material=glas", "the material `glas` is not defined"),
        ("bodies.lens.shape=cube;bodies.lens.parts.0.radius=1", "`parts` is only for `shape`"),
    ] {
        let edits: Vec<&str> = edit.split(';').collect();
        let error = set(&mut scene, &edits).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{edit}: {error}");
        assert_eq!(scene, unchanged);
    }
    set(&mut scene, &["bodies.lens.parts.1.parts.0.radius=4", "bodies.lens.parts.front.shape=cube"]).unwrap();
    set(&mut scene, &["bodies.lens.parts.front.name=back", "bodies.lens.parts.1.material.ior=1.7"]).unwrap();
    assert_eq!(scene.bodies[0].parts[1].parts[0].shape, Shape::Sphere { radius: 4.0 });
    assert_eq!(
        (scene.bodies[0].parts[0].name.as_str(), scene.bodies[0].parts[0].shape),
        ("back", Shape::CUBE)
    );
    assert_eq!(get(&scene, "bodies.lens.parts.1.material.ior"), "1.7");
    scene.unset(&path("bodies.lens.parts.1.parts.0.material")).unwrap();
    assert_eq!(scene.bodies[0].parts[1].parts[0].material, None);
    set(&mut scene, &["bodies.lens.shape=cube"]).unwrap();
    assert!(scene.bodies[0].parts.is_empty());
    let error = set(&mut scene, &["bodies.lens.shape=union"]).unwrap_err().to_string();
    assert!(error.starts_with("a union needs at least one part"), "{error}");
}

#[test]
fn single_numbers_have_addresses() {
    let scene = scene();
    let numbers: Vec<String> =
        scene.keys().flat_map(|key| key.numbers()).map(|path| path.to_string()).collect();
    for address in
        ["camera.fov", "bodies.ball.position.y", "bodies.ball.radius", "materials.\"my wood\".color.b"]
    {
        assert!(numbers.iter().any(|number| number == address), "{address}");
    }
    for address in ["camera.position", "bodies.ball.shape", "bodies.ball.name", "materials.glass.abbe"] {
        assert!(numbers.iter().all(|number| number != address), "{address}");
    }
    for address in &numbers {
        assert!(matches!(scene.get(&path(address)), Ok(SceneValue::Number(_))), "{address}");
    }
    // A part has the addresses that begin with it.
    let ball = scene.keys_of(ScenePart::Body(0));
    assert!(!ball.is_empty() && ball.iter().all(|key| key.path.to_string().starts_with("bodies.ball.")));
    assert_eq!(scene.keys_of(ScenePart::Body(99)), []);
    let position = ball.iter().find(|key| key.spec.name == "position").unwrap();
    assert_eq!(position.component(1).map(|path| path.to_string()).as_deref(), Some("bodies.ball.position.y"));
    assert_eq!(position.component(3), None);
}
