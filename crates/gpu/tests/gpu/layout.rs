//! The bytes that Rust writes are where the shaders read them.

use std::sync::Arc;

use catoptric_picture::Picture;
use catoptric_scene::{
    Body, BodyPart, Camera, Color, Environment, Image, Light, Material, MaterialChoice, Pattern, Phong,
    Placement, Projection, Scene, Shape, Sky, SolidTexture, Surroundings,
};
use catoptric_tracer::shaders::{
    AtlasTexel, CameraRaysBytes, FILM_HEAD, FILM_PIXEL, FrameUniforms, PhysicalFeatures, SceneArrays,
    ShaderSpecialization, WavelengthUniforms, shader, tile_rays,
};
use catoptric_tracer::{RenderScene, SceneChanges};
use glam::DVec3;
use naga::{ArraySize, Module, TypeInner};

use crate::shaders::parsed;

fn module(depth: u32) -> Module {
    parsed(&shader(&ShaderSpecialization { depth, shapes: 127, ..ShaderSpecialization::default() })).unwrap()
}

/// The offset of each member of a struct, and the size of all.
fn layout(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
    let named = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let TypeInner::Struct { members, span } = &named.unwrap().1.inner else { panic!("{name} is no struct") };
    let members = members.iter().map(|member| (member.name.clone().unwrap(), member.offset));
    (members.collect(), *span)
}

fn offset(module: &Module, name: &str, member: &str) -> usize {
    let (members, _) = layout(module, name);
    members.iter().find(|(found, _)| found == member).unwrap().1 as usize
}

fn number(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn word(bytes: &[u8], at: usize) -> u32 {
    number(bytes, at).to_bits()
}

/// A scene in which every number is another one.
fn scene(bodies: usize) -> Scene {
    let material = Material::Phong(Phong {
        pattern: Pattern {
            color: Color { r: 0.11, g: 0.12, b: 0.13 },
            solid: Some(SolidTexture { size: 0.5, ..SolidTexture::default() }),
            ..Pattern::default()
        },
        ambient: 0.14,
        diffuse: 0.15,
        specular: 0.16,
        shininess: 17.0,
        reflection: Some(0.18),
        transmission: 0.5,
        ior: 1.9,
        ..Phong::default()
    });
    let body = |index: usize| {
        let mut body =
            Body { material: MaterialChoice::Inline(Box::new(material.clone())), ..Body::default() };
        body.placement = body.placement.moved_by(DVec3::new(3.0 * index as f64, 2.0, 1.0));
        body
    };
    let light = Light { position: DVec3::new(21.0, 22.0, 23.0), intensity: 0.5, ..Light::default() };
    Scene { bodies: (0..bodies).map(body).collect(), lights: vec![light], ..Scene::default() }
}

#[test]
fn records_have_the_size_of_the_shaders() {
    let (few, many) = (module(0), module(4));
    let (two, hundred) = (RenderScene::build(&scene(2)).unwrap(), RenderScene::build(&scene(100)).unwrap());
    let arrays = SceneArrays(&two);
    assert_eq!(layout(&few, "Body").1 as usize * 2, arrays.bodies().len());
    assert_eq!(layout(&few, "Material").1 as usize, arrays.materials().len());
    assert_eq!(layout(&few, "Solid").1 as usize * 2, arrays.solids().len());
    assert_eq!(layout(&few, "Light").1 as usize, arrays.lights().len());
    assert_eq!(arrays.boxes().len(), 2 * 16);
    assert_eq!(arrays.scene_order(true).len(), 2 * 8);
    assert_eq!(SceneArrays(&hundred).boxes().len() % layout(&many, "Box").1 as usize, 0);
    assert_eq!(layout(&few, "Frame").1 as usize, size_of::<FrameUniforms>());
    assert_eq!(layout(&few, "CameraRays").1 as usize, size_of::<CameraRaysBytes>());
    assert_eq!(u64::from(layout(&few, "Pixel").1), FILM_PIXEL);
    assert_eq!(offset(&few, "Film", "pixels") as u64, FILM_HEAD);
}

#[test]
fn physical_records_are_read_where_they_are_written() {
    let special = ShaderSpecialization {
        shapes: 127,
        physical: PhysicalFeatures::ALL,
        media: 1,
        ..ShaderSpecialization::default()
    };
    let physical = parsed(&shader(&special)).unwrap();
    let mut scene = scene(2);
    scene.lights[0].radius = 0.7;
    let render_scene = RenderScene::build(&scene).unwrap();
    let lights = SceneArrays(&render_scene).lights();
    assert_eq!(layout(&physical, "Light").1 as usize, lights.len());
    let of_light = |member| number(&lights, offset(&physical, "Light", member));
    assert_eq!(["position", "power", "radius"].map(of_light), [21.0, 0.5, 0.7]);
    // Rows of four words; the order of the first three is that of plain materials.
    let materials = SceneArrays(&render_scene).materials();
    assert_eq!(materials.len(), 6 * 16);
    let places = [0, 12, 16, 28, 32, 36, 40, 44];
    let numbers = places.map(|place| number(&materials, place));
    assert_eq!(numbers, [0.11, 0.14, 0.5, 1.9, 0.15, 0.16, 17.0, 0.18]);
    let waves = physical.global_variables.iter().find(|(_, of)| of.name.as_deref() == Some("sample_waves"));
    let TypeInner::Array { size: ArraySize::Constant(count), stride, .. } =
        physical.types[waves.unwrap().1.ty].inner
    else {
        panic!("waves are an array of one length");
    };
    assert_eq!((count.get() * stride) as usize, size_of::<WavelengthUniforms>());
}

#[test]
fn bodies_and_materials_are_read_where_they_are_written() {
    let few = module(0);
    let scene = scene(2);
    let render_scene = RenderScene::build(&scene).unwrap();
    let arrays = SceneArrays(&render_scene);
    let at = |member| offset(&few, "Body", member);
    let first = render_scene.scene_index(0).unwrap();
    assert_eq!(number(arrays.bodies(), at("origin")), 3.0 * first as f32);
    assert_eq!(number(arrays.bodies(), at("origin") + 4), 2.0);
    assert_eq!(number(arrays.bodies(), at("parameter")), 1.0);
    // A sphere, along the axes of the world, transparent.
    // Rays pass, light is filtered, and nothing but air keeps it from being cemented.
    assert_eq!(word(arrays.bodies(), at("kind_and_passage")), 13 << 16 | 1 << 8);
    let materials = arrays.materials();
    let of_material = |member| number(&materials, offset(&few, "Material", member));
    let members =
        ["color", "ambient", "filter_color", "ior", "diffuse", "specular", "shininess", "reflection"];
    assert_eq!(members.map(of_material), [0.11, 0.14, 0.5, 1.9, 0.15, 0.16, 17.0, 0.18]);
    let lights = arrays.lights();
    let of_light = |member| number(&lights, offset(&few, "Light", member));
    assert_eq!(["position", "power"].map(of_light), [21.0, 0.5]);
    let order = arrays.scene_order(true);
    assert_eq!(word(&order, 0) as usize, first);
    assert_eq!(word(&order, 4) as usize, first, "equal volumes keep the order of the scene");
}

/// A ball, a group of a ball, and a ball cut by one and by two that are in common.
fn compound() -> Scene {
    let ball = |x: f64| BodyPart { placement: Placement::at(DVec3::new(x, 0.0, 0.0)), ..BodyPart::default() };
    let common = BodyPart { shape: Shape::Intersection, parts: vec![ball(0.5), ball(0.6)], ..ball(0.0) };
    let body = |shape, parts| Body { shape, parts, ..Body::default() };
    let cut = vec![ball(0.0), ball(1.0), common];
    let bodies = [Body::default(), body(Shape::Group, vec![ball(9.0)]), body(Shape::Difference, cut)];
    Scene { bodies: bodies.into(), ..Scene::default() }
}

#[test]
fn joined_bodies_are_read_where_they_are_written() {
    let render_scene = RenderScene::build(&compound()).unwrap();
    let order: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&SceneArrays(&render_scene).scene_order(true));
    let frame = FrameUniforms::new(&render_scene, render_scene.camera(), [70, 40]);
    let frame = bytemuck::bytes_of(&frame);
    let few = module(0);
    let word_of = |member| word(frame, offset(&few, "Frame", member)) as usize;
    let whole = (0..3).find(|&index| render_scene.scene_index(index) == Some(2)).unwrap();
    let (numbers, records): (Vec<u32>, Vec<u32>) =
        order.iter().map(|&[number, place]| (number, place)).unzip();
    // Three bodies, the whole and one member of the group among them, and four parts.
    assert_eq!((word_of("bodies"), word_of("scene_bodies")), (3, 3));
    for (place, number) in numbers.iter().take(7).enumerate() {
        let in_scene = match number {
            0..3 => *number,
            member => numbers[(word_of("members") as u32).wrapping_add(*member) as usize],
        };
        assert_eq!(render_scene.scene_index(place as u32), Some(in_scene as usize), "{number}");
    }
    assert_eq!(records[3..7], [whole, whole | 1 << 31, whole | 1 << 31, whole | 1 << 31]);
    let record = records[whole as usize] as usize;
    assert_eq!(order[record..record + 2], [[3, 4], [0b1110, 0]]);
    assert_eq!(order[record + 2][1], 2, "gates");
    // Outside of one of the last two; and that, in the first and outside of the second.
    assert_eq!(order[record + 3..], [[0b1100, 0], [1, 0], [0b0011, 0], [0, 1]]);
}

#[test]
fn frames_and_rays_are_read_where_they_are_written() {
    let few = module(0);
    let mut scene = scene(2);
    scene.camera = Camera { projection: Projection::Parallel { height: 4.0 }, ..scene.camera };
    let render_scene = RenderScene::build(&scene).unwrap();
    let frame = FrameUniforms::new(&render_scene, render_scene.camera(), [140, 80]).dispatch(5, 1, 2);
    let bytes = bytemuck::bytes_of(&frame);
    let word_of = |member| word(bytes, offset(&few, "Frame", member));
    let members = ["tiles_across", "first_tile", "bounded", "bodies", "lights", "samples_done", "samples"];
    assert_eq!(members.map(word_of), [3, 5, 2, 2, 1, 1, 2]);
    assert_eq!(
        number(bytes, offset(&few, "Frame", "places")),
        (0.5_f64 + 0.754_877_666_246_692_8).fract() as f32
    );
    let rays = tile_rays(render_scene.camera(), [140, 80]);
    assert_eq!(rays.len(), 6);
    let bytes = bytemuck::bytes_of(&rays[0]);
    assert_eq!(word(bytes, offset(&few, "CameraRays", "is_parallel")), 1);
    let across: Vec<f32> =
        (0..3).map(|axis| number(bytes, offset(&few, "CameraRays", "across") + 4 * axis)).collect();
    let length = across.iter().map(|part| part * part).sum::<f32>().sqrt();
    assert!((length - 4.0 / 80.0).abs() < 1e-6, "{across:?}");
}

#[test]
fn skies_are_read_where_they_are_written() {
    let few = module(0);
    let mut scene = scene(2);
    let at = |frame: &FrameUniforms, member| number(bytemuck::bytes_of(frame), offset(&few, "Frame", member));
    let members = ["background", "horizon", "nadir", "turn"];
    let frame_of = |scene: &Scene| {
        let render_scene = RenderScene::build(scene).unwrap();
        FrameUniforms::new(&render_scene, render_scene.camera(), [70, 40])
    };
    scene.environment.background = Color::gray(0.31);
    assert_eq!(members.map(|member| at(&frame_of(&scene), member)), [0.31, 0.0, 0.0, 0.0]);
    let sky = Sky { zenith: Color::gray(0.25), horizon: Color::gray(0.5), nadir: Color::gray(0.75) };
    scene.environment =
        Environment { surroundings: Surroundings::Sky(sky), strength: 2.0, ..scene.environment };
    assert_eq!(members.map(|member| at(&frame_of(&scene), member)), [0.5, 1.0, 1.5, 0.0]);
    scene.environment.surroundings = Surroundings::Picture(picture(2, 1));
    scene.environment.rotation_degrees = -90.0;
    assert_eq!(members.map(|member| at(&frame_of(&scene), member)), [2.0, 0.0, 0.0, 0.75]);
    let ambient = at(&frame_of(&scene), "ambient");
    assert_eq!(f64::from(ambient), scene.environment.ambient.r);
}

/// A picture whose pixels are numbered from 1.
fn picture(width: u32, height: u32) -> Image {
    let numbered = |x: u32, y: u32| [(1 + y * width + x) as f32, 0.5, -0.0];
    Image::with_pixels("numbered", Arc::new(Picture::from_fn(width, height, numbered).unwrap()))
}

#[test]
fn pictures_lie_where_their_records_point() {
    let mut scene = scene(3);
    let [around, first, second] = [picture(3, 2), picture(100, 90), picture(1, 5)];
    scene.environment.surroundings = Surroundings::Picture(around.clone());
    let textures = [Some(first.clone()), Some(second.clone()), Some(around), Some(first), None];
    let of = |texture| Body {
        material: MaterialChoice::Inline(Box::new(Material::Phong(Phong {
            pattern: Pattern { texture, ..Pattern::default() },
            ..Phong::default()
        }))),
        ..Body::default()
    };
    scene.bodies = textures.map(of).into();
    let render_scene = RenderScene::build(&scene).unwrap();
    let pictures = SceneArrays(&render_scene).pictures();
    assert_eq!(pictures.rows(), 2, "3 records and 9011 pixels");
    let texels: Vec<AtlasTexel> =
        pictures.pieces(1).inspect(|piece| assert_eq!(piece.len(), 8192)).flatten().collect();
    assert_eq!(texels, pictures.pieces(7).flatten().collect::<Vec<_>>());
    assert_eq!(texels[0], [3, 3, 2, 0]);
    let mut sizes = Vec::new();
    for &[start, width, height, _] in &texels[..3] {
        sizes.push([width, height]);
        let last = texels[(start + width * height - 1) as usize];
        assert_eq!(texels[start as usize], [1.0, 0.5, -0.0, 0.0].map(f32::to_bits));
        assert_eq!(last, [(width * height) as f32, 0.5, -0.0, 0.0].map(f32::to_bits));
    }
    // In the place of the colors stand the numbers of the records.
    let few = module(0);
    let materials = SceneArrays(&render_scene).materials();
    let size = layout(&few, "Material").1 as usize;
    let place = |material: &[u8]| number(material, offset(&few, "Material", "color"));
    let found: Vec<f32> = materials.chunks(size).map(place).collect();
    let widths: Vec<u32> =
        found.iter().filter(|color| **color < 0.0).map(|color| sizes[(-1.0 - color) as usize][0]).collect();
    assert_eq!(widths, [100, 1, 3]);
    assert_eq!(found[3], Pattern::default().color.r as f32);
}

#[test]
fn changes_are_ranges_of_bytes() {
    let render_scene = RenderScene::build(&scene(100)).unwrap();
    let arrays = SceneArrays(&render_scene);
    let changes = SceneChanges { bodies: [2..4, 7..8].into(), nodes: vec![1, 2] };
    let [bodies, boxes, order] = arrays.parts(&changes);
    let body = arrays.bodies().len() / 100;
    assert_eq!(bodies, [2 * body..4 * body, 7 * body..8 * body]);
    assert_eq!(boxes, [256..512, 512..768]);
    assert_eq!(order, [16..32, 56..64]);
}
