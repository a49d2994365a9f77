//! Arbitrary valid scenes.

use catoptric_optics::{CLEAR, METALS};
use catoptric_scene::{
    Anchor, Attenuation, Body, BodyContact, BodyPart, BodyShape, Camera, Coated, Color, Conductor, Contact,
    Dielectric, Environment, Falloff, FresnelTerm, Image, ImageSource, Instance, Light, Material,
    MaterialChoice, Matte, MetalOptics, Mirror, Model, NamedMaterial, ParaboloidDepth, Pattern, PatternSpace,
    Phong, Placement, Projection, RefractiveIndex, Scene, Shadow, Shape, ShapeKind, Sky, SolidKind,
    SolidTexture, Surroundings, ThinDielectric, Tracing, VisibleSide,
};
use glam::DVec3;
use proptest::prelude::*;

fn amount() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(1.0),
        Just(0.1),
        0.0..1e6f64,
        (-300.0..5.9f64).prop_map(|power| 10f64.powf(power))
    ]
}

fn length() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(1.0),
        Just(0.5),
        Just(1e9),
        Just(1e-9),
        (-8.9..8.9f64).prop_map(|power| 10f64.powf(power))
    ]
}

fn place() -> impl Strategy<Value = DVec3> {
    let number = || prop_oneof![Just(0.0), Just(-1.5), Just(1e-7), -1e9..1e9f64, -10.0..10.0f64];
    (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn lengths() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        length().prop_map(DVec3::splat),
        (length(), length(), length()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    ]
}

fn color() -> impl Strategy<Value = Color> {
    prop_oneof![
        Just(Color::WHITE),
        any::<[u8; 3]>().prop_map(Color::from_srgb8),
        (amount(), amount(), amount()).prop_map(|(r, g, b)| Color::new(r, g, b))
    ]
}

fn camera() -> impl Strategy<Value = Camera> {
    let projection = prop_oneof![
        (0.001..179.9f64).prop_map(|fov_degrees| Projection::Perspective { fov_degrees }),
        length().prop_map(|height| Projection::Parallel { height })
    ];
    (place(), place(), place(), projection).prop_map(|(position, target, up, projection)| {
        let camera = Camera { position, target, up, projection };
        let scene = Scene { camera, ..Scene::default() };
        if scene.check().is_empty() { camera } else { Camera { projection, ..Camera::default() } }
    })
}

fn solid() -> impl Strategy<Value = SolidTexture> {
    let choices = (
        proptest::sample::select(SolidKind::ALL.to_vec()),
        proptest::sample::select(PatternSpace::ALL.to_vec()),
    );
    let leaf = (choices, color(), length(), place(), place(), lengths()).prop_map(
        |((kind, space), color, size, position, turn, scale)| SolidTexture {
            size,
            space,
            position,
            rotation_degrees: turn.clamp(DVec3::splat(-1e6), DVec3::splat(1e6)),
            scale,
            ..SolidTexture::new(kind, color)
        },
    );
    leaf.prop_recursive(SolidTexture::MAX_DEPTH as u32 - 1, 6, 2, |inner| {
        let within = || proptest::option::of(inner.clone().prop_map(Box::new));
        (inner.clone(), within(), within()).prop_map(|(outer, first, second)| SolidTexture {
            first,
            second,
            ..outer
        })
    })
}

fn pattern() -> impl Strategy<Value = Pattern> {
    (color(), proptest::option::of(image()), proptest::option::of(solid()))
        .prop_map(|(color, texture, solid)| Pattern { color, texture, solid })
}

fn reflection() -> impl Strategy<Value = Option<f64>> {
    proptest::option::of(amount())
}

fn ior() -> impl Strategy<Value = f64> {
    0.01..100.0f64
}

fn phong() -> impl Strategy<Value = Material> {
    let coefficients = [amount(), amount(), amount(), amount(), amount()];
    let fresnel = proptest::sample::select(FresnelTerm::ALL.to_vec());
    (pattern(), coefficients, reflection(), ior(), color(), fresnel).prop_map(
        |(pattern, [ambient, diffuse, specular, shininess, transmission], reflection, ior, tint, fresnel)| {
            let own = Phong { ambient, diffuse, specular, shininess, transmission, ..Phong::default() };
            Phong { pattern, reflection, ior, tint, fresnel, ..own }.into()
        },
    )
}

fn dielectric() -> impl Strategy<Value = Material> {
    let own = (ior(), 1.0..1e6f64).prop_map(|(ior, abbe)| RefractiveIndex::Own { ior, abbe });
    let substance = proptest::sample::select(CLEAR.iter().collect::<Vec<_>>());
    let index = prop_oneof![own, substance.prop_map(RefractiveIndex::Substance)];
    let attenuation = (0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64, length())
        .prop_map(|(r, g, b, distance)| Attenuation { color: Color::new(r, g, b), distance });
    (index, any::<bool>(), attenuation, 0.0..1.0f64).prop_map(
        |(index, dispersion, attenuation, roughness)| {
            Dielectric { index, dispersion, attenuation, roughness }.into()
        },
    )
}

fn conductor() -> impl Strategy<Value = Material> {
    let metal = proptest::sample::select(METALS.iter().collect::<Vec<_>>()).prop_map(MetalOptics::Metal);
    let index = (0.001..100.0f64, 0.0..100.0f64)
        .prop_map(|(n, k)| MetalOptics::Index { n: DVec3::new(n, 1.0, 1.5), k: DVec3::new(0.0, k, 3.0) });
    (prop_oneof![metal, index], 0.0..1.0f64)
        .prop_map(|(metal, roughness)| Conductor { metal, roughness }.into())
}

fn mirror() -> impl Strategy<Value = Material> {
    (pattern(), reflection(), 0.0..1.0f64)
        .prop_map(|(pattern, reflection, roughness)| Mirror { pattern, reflection, roughness }.into())
}

fn matte() -> impl Strategy<Value = Material> {
    (pattern(), amount()).prop_map(|(pattern, ambient)| Matte { pattern, ambient }.into())
}

fn coated() -> impl Strategy<Value = Material> {
    (pattern(), amount(), ior(), 0.0..1.0f64)
        .prop_map(|(pattern, ambient, ior, roughness)| Coated { pattern, ambient, ior, roughness }.into())
}

fn thin_dielectric() -> impl Strategy<Value = Material> {
    (ior(), color()).prop_map(|(ior, tint)| ThinDielectric { ior, tint }.into())
}

pub(crate) fn material() -> impl Strategy<Value = Material> {
    let of_model = |model| match model {
        Model::Phong => phong().boxed(),
        Model::Dielectric => dielectric().boxed(),
        Model::Conductor => conductor().boxed(),
        Model::Mirror => mirror().boxed(),
        Model::Matte => matte().boxed(),
        Model::Coated => coated().boxed(),
        Model::ThinDielectric => thin_dielectric().boxed(),
    };
    // On the heap: what many of them make is more than a thread's stack holds.
    let default = Just(Material::default()).boxed();
    proptest::strategy::Union::new(std::iter::once(default).chain(Model::ALL.map(of_model))).boxed()
}

fn shape_and_anchor() -> BoxedStrategy<(Shape, Anchor)> {
    let frame = || {
        (place(), place()).prop_map(|(position, turn)| Anchor::Frame {
            position,
            rotation_degrees: turn.clamp(DVec3::splat(-1e6), DVec3::splat(1e6)),
        })
    };
    let framed = prop_oneof![
        length().prop_map(|radius| Shape::Sphere { radius }),
        lengths().prop_map(|size| Shape::Cube { size }),
        (length(), length()).prop_map(|(radius, height)| Shape::Cylinder { radius, height }),
        (length(), length(), length()).prop_map(|(radius, top_radius, height)| Shape::Cone {
            radius,
            top_radius,
            height
        }),
        (length(), length()).prop_map(|(radius, height)| Shape::Paraboloid {
            radius,
            depth: ParaboloidDepth::Height(height)
        }),
        (0.01..100.0_f64, 0.01..100.0_f64).prop_map(|(radius, length)| Shape::Paraboloid {
            radius,
            depth: ParaboloidDepth::FocalLength(length)
        }),
        Just(Shape::Plane),
    ];
    let on_axis =
        (place(), place(), length(), 0..3_u32).prop_filter_map("no axis", |(base, top, radius, which)| {
            let height = base.distance(top);
            let shape = match which {
                0 => Shape::Cone { radius, top_radius: 0.0, height },
                1 => Shape::Paraboloid { radius, depth: ParaboloidDepth::Height(height) },
                _ => Shape::Cylinder { radius, height },
            };
            let anchor = Anchor::Axis { base, top };
            let body = Body { shape, placement: Placement { anchor, scale: DVec3::ONE }, ..Body::default() };
            let scene = Scene { bodies: [body].into(), ..Scene::default() };
            scene.check().is_empty().then_some((shape, anchor))
        });
    prop_oneof![3 => (framed, frame()), 1 => on_axis].boxed()
}

fn light() -> impl Strategy<Value = Light> {
    let falloff = prop_oneof![
        Just(Falloff::None),
        Just(Falloff::InverseSquare),
        (0.0..1e9f64).prop_map(|constant| Falloff::Linear { constant })
    ];
    let flags = any::<[bool; 2]>();
    (name(), place(), color(), amount(), falloff, 0.0..1e9f64, flags).prop_map(
        |(name, position, color, intensity, falloff, radius, [hidden, locked])| Light {
            name,
            position,
            color,
            intensity,
            falloff,
            radius,
            hidden,
            locked,
        },
    )
}

fn around() -> impl Strategy<Value = Surroundings> {
    let sky = (color(), color(), color())
        .prop_map(|(zenith, horizon, nadir)| Surroundings::Sky(Sky { zenith, horizon, nadir }));
    let picture = image().prop_map(Surroundings::Picture);
    prop_oneof![Just(Surroundings::Even), sky, picture]
}

fn image() -> impl Strategy<Value = Image> {
    let path = prop_oneof![Just("builtin:grid".to_owned()), "[a-c \"'\\\\/.ж]{1,6}"];
    (path, proptest::option::of("[a-cA. \"ж]{0,5}"))
        .prop_map(|(path, layer)| Image::from_source(ImageSource::new(path, layer.map(Into::into))))
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof![Just(String::new()), "[a-d]", "[a-c \"'\\\\#=.\\]ж\u{7f}\n\t\u{1}]{1,4}"]
}

/// Boxed, since a strategy of strategies fills the stack.
fn choice() -> BoxedStrategy<MaterialChoice> {
    prop_oneof![
        any::<u8>().prop_map(|index| MaterialChoice::Named(index.to_string())),
        material().prop_map(|material| MaterialChoice::Inline(Box::new(material)))
    ]
    .boxed()
}

/// A lens, a tube or another shape that numbers make of parts.
fn parametric() -> impl Strategy<Value = BodyShape> {
    let kind = proptest::sample::select(ShapeKind::PARAMETRIC.to_vec());
    (kind, 0.01..100.0, 0.5..1.0, 0..4u32).prop_map(|(kind, factor, share, variant)| {
        let mut shape = kind.body_shape();
        let set = |shape: &mut BodyShape, keys: &[(&str, f64)]| {
            keys.iter().for_each(|(key, value)| shape.set_number(key, *value));
        };
        match (kind, variant) {
            (ShapeKind::Lens, 0) => set(&mut shape, &[("front_radius", 0.0), ("thickness", share)]),
            (ShapeKind::Lens, 1) => set(&mut shape, &[("focal_length", -1.0 - share), ("ior", 1.4 + share)]),
            (ShapeKind::Lens, 2) => set(&mut shape, &[("focal_length", 2.0), ("front_radius", 1.0 + share)]),
            (ShapeKind::MirrorDish, 0) => shape.set_word("profile", "spherical"),
            (ShapeKind::MirrorDish, 1) => set(&mut shape, &[("curvature_radius", 1.0 + share)]),
            (ShapeKind::Bowl, 0) => set(&mut shape, &[("height", 0.9 * share)]),
            (ShapeKind::Prism, sides) => set(&mut shape, &[("sides", f64::from(3 + sides))]),
            (ShapeKind::OpenCone, 0) => set(&mut shape, &[("top_radius", share)]),
            (ShapeKind::Rectangle, 0) => set(&mut shape, &[("width", share)]),
            (ShapeKind::Triangle, 0) => shape.set_vector("a", DVec3::new(share, 1.0, 2.0)),
            (ShapeKind::Disc, 0) => shape.set_word("visible_side", "outer"),
            (ShapeKind::OpenCylinder, 0) => shape.set_word("visible_side", "inner"),
            (ShapeKind::Wedge, 0) => shape.set_vector("size", DVec3::new(share, 1.0, 2.0)),
            _ => {}
        }
        shape.scaled(factor)
    })
}

/// A part of a body: mostly a simple one.
fn part() -> impl Strategy<Value = BodyPart> {
    let simple = (name(), shape_and_anchor(), lengths(), proptest::option::of(choice())).prop_map(
        |(name, (shape, anchor), scale, material)| {
            let placement = Placement { anchor, scale };
            BodyPart { name, shape, placement, material, ..BodyPart::default() }
        },
    );
    let parametric = (name(), parametric(), place(), lengths(), proptest::option::of(choice())).prop_map(
        |(name, shape, position, scale, material)| {
            let body = Body::of_shape(shape);
            let placement = Placement { scale, ..Placement::at(position) };
            let (shape, parts, parametric) = (body.shape, body.parts, body.parametric);
            BodyPart { name, shape, placement, material, parts, parametric, instance: None }
        },
    );
    let alone = prop_oneof![4 => simple, 1 => parametric];
    alone.prop_recursive(3, 12, 3, |inner| {
        let shapes = vec![
            Shape::Union,
            Shape::Intersection,
            Shape::Difference,
            Shape::SURFACE,
            Shape::Surface { side: VisibleSide::Inner },
            Shape::Group,
        ];
        let parts = proptest::collection::vec(inner, 1..4);
        (name(), proptest::sample::select(shapes), place(), lengths(), proptest::option::of(choice()), parts)
            .prop_map(|(name, shape, position, scale, material, parts)| BodyPart {
                name,
                shape: if can_be_joined(shape, &parts) { shape } else { Shape::Group },
                placement: Placement { scale, ..Placement::at(position) },
                material,
                parts: unique(parts, |part| &mut part.name),
                ..BodyPart::default()
            })
    })
}

/// Surfaces are of simple shapes, and stand alone.
fn can_be_joined(shape: Shape, parts: &[BodyPart]) -> bool {
    fn has_surface(part: &BodyPart) -> bool {
        part.shape.is_surface() || part.shape == Shape::Group && part.parts.iter().any(has_surface)
    }
    !parts.iter().any(has_surface) && (!shape.is_surface() || !parts[0].shape.is_compound())
}

fn body() -> BoxedStrategy<Body> {
    let contact = proptest::sample::select(BodyContact::ALL.to_vec());
    (part(), choice(), any::<[bool; 2]>(), proptest::sample::select(Shadow::ALL.to_vec()), contact)
        .prop_map(|(part, own, [hidden, locked], shadow, contact)| {
            let BodyPart { name, shape, placement, material, parts, parametric, instance } = part;
            let material = material.unwrap_or(own);
            let flags = Body { hidden, shadow, contact, locked, ..Body::default() };
            Body { name, shape, placement, material, parts, parametric, instance, ..flags }
        })
        .boxed()
}

fn unique<T>(mut list: Vec<T>, name: impl Fn(&mut T) -> &mut String) -> Vec<T> {
    let mut seen = std::collections::HashSet::new();
    for item in &mut list {
        let name = name(item);
        if !name.is_empty() && !seen.insert(name.clone()) {
            name.clear();
        }
    }
    list
}

pub(crate) fn scene() -> impl Strategy<Value = Scene> {
    let materials = proptest::collection::vec((name(), material()), 0..4);
    let lights = proptest::collection::vec(light(), 0..4);
    let bodies = proptest::collection::vec(body(), 0..5);
    let around = (around(), -1e6..=1e6f64, amount());
    let contact = proptest::sample::select(Contact::ALL.to_vec());
    let surroundings = (camera(), color(), color(), around, contact, 1..=64u32, 0.0..=1.0f64);
    let instances = proptest::collection::vec((place(), any::<[bool; 2]>()), 0..3);
    let lists = (materials, lights, bodies, instances);
    (surroundings, lists).prop_map(|(surroundings, (materials, lights, bodies, instances))| {
        let (camera, background, ambient, around, contact, generations, threshold) = surroundings;
        let (surroundings, rotation_degrees, strength) = around;
        let materials =
            materials.into_iter().map(|(name, material)| NamedMaterial { name, material }).collect();
        let mut materials = unique(materials, |named| &mut named.name);
        materials.retain(|named| !named.name.is_empty());
        let mut bodies = unique(bodies, |body| &mut body.name);
        for body in &mut bodies {
            // A number stands for one of the materials.
            body.each_material_mut(&mut |choice| {
                let MaterialChoice::Named(name) = choice else { return };
                let index: usize = name.parse().unwrap();
                match materials.get(index % materials.len().max(1)) {
                    Some(named) => name.clone_from(&named.name),
                    None => *choice = MaterialChoice::default(),
                }
            });
        }
        let original = bodies.first().map(|body| body.name.clone()).filter(|name| !name.is_empty());
        if let Some(original) = original {
            let instance = |(position, [own, hidden]): (DVec3, [bool; 2])| Body {
                placement: Placement::at(position),
                hidden,
                instance: Some(Instance::new(original.clone(), own)),
                ..Body::default()
            };
            bodies.extend(instances.into_iter().map(instance));
        }
        let mut scene = Scene {
            camera,
            environment: Environment {
                background,
                ambient,
                surroundings,
                rotation_degrees,
                strength,
                contact,
            },
            tracing: Tracing { generations, threshold },
            materials,
            lights: unique(lights, |light| &mut light.name),
            bodies: bodies.into(),
        };
        scene.follow_instances();
        scene
    })
}
