//! `flat`, `gouraud`, `phong` against the traced local picture.

use std::collections::BTreeSet;

use catoptric_scene::{
    Anchor, Body, BodyPart, Coated, Color, Conductor, Example, Light, Material, MaterialChoice, MetalOptics,
    Pattern, Phong, Placement, Projection, Scene, Shape, ShapeKind, SolidTexture,
};
use catoptric_tracer::RenderScene;
use catoptric_tracer::raster::{LightModel, Method, ShadingSettings};
use glam::DVec3;

use crate::methods::common::*;

fn fine(fineness: u32) -> ShadingSettings {
    ShadingSettings { fineness, ..ShadingSettings::default() }
}

/// A glossy ball that fills the picture, with its outline outside of it.
fn close_ball() -> RenderScene {
    let ball = ball(1.0, v(0.1, 0.0, -0.2), glossy());
    let scene = scene(
        vec![ball],
        camera(v(0.0, 0.3, 4.0), v(0.1, 0.0, 0.0), 14.0),
        vec![light(v(3.0, 4.0, 5.0), 0.8)],
    );
    render_scene(&scene).with_generations(1)
}

/// All shapes, glossy, apart from each other, with nothing in each other's light.
fn all_shapes(projection: Projection) -> Scene {
    let material = glossy();
    let bodies = vec![
        ball(0.8, v(-3.0, 0.9, 0.0), material.clone()),
        turned(Shape::CUBE, v(-1.0, 0.8, 0.0), v(20.0, 30.0, 0.0), material.clone()),
        turned(Shape::CYLINDER, v(0.8, 0.3, 0.0), v(15.0, 0.0, 20.0), material.clone()),
        turned(Shape::CONE, v(2.4, 0.3, 0.0), v(0.0, 0.0, -20.0), material.clone()),
        turned(
            Shape::Cone { radius: 0.3, top_radius: 0.6, height: 1.0 },
            v(3.6, 0.3, 0.0),
            v(-40.0, 0.0, 0.0),
            material.clone(),
        ),
        turned(Shape::PARABOLOID, v(-0.2, 1.6, -0.6), v(60.0, 0.0, 10.0), material.clone()),
        body(Shape::Plane, DVec3::ZERO, chalk(0.5, 0.6, 0.5)),
    ];
    let mut camera = camera(v(0.0, 2.5, 9.0), v(0.0, 0.6, 0.0), 30.0);
    camera.projection = projection;
    scene(bodies, camera, vec![light(v(-2.0, 9.0, 9.0), 0.8)])
}

fn errors(
    render_scene: &RenderScene,
    method: fn(ShadingSettings) -> Method,
    finenesses: [u32; 3],
) -> [f64; 3] {
    let truth = traced(render_scene, size(160, 120));
    finenesses
        .map(|fineness| rmse(&drawn(render_scene, method(fine(fineness)), size(160, 120)).picture, &truth))
}

/// Twice the fineness divides the error by `least` to `most`.
#[track_caller]
fn assert_rate(errors: [f64; 3], least: f64, most: f64) {
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((least..=most).contains(&ratio), "{errors:?}: {ratio}");
    }
}

#[test]
fn phong_and_gouraud_converge_quadratically_and_flat_linearly() {
    let render_scene = close_ball();
    // Interpolation along a chord of angle h is off by h²/8; a constant by h/2.
    assert_rate(errors(&render_scene, Method::Phong, [16, 32, 64]), 3.4, 4.6);
    assert_rate(errors(&render_scene, Method::Gouraud, [32, 64, 128]), 3.2, 4.8);
    assert_rate(errors(&render_scene, Method::Flat, [32, 64, 128]), 1.7, 2.3);
}

#[test]
fn fine_phong_is_the_traced_local_picture() {
    let parallel = Projection::Parallel { height: 5.0 };
    for projection in [Projection::Perspective { fov_degrees: 30.0 }, parallel] {
        let render_scene = render_scene(&all_shapes(projection)).with_generations(1);
        let settings = ShadingSettings { fineness: 128, shadows: true, ..ShadingSettings::default() };
        let (truth, phong) = (
            traced(&render_scene, size(240, 160)),
            drawn(&render_scene, Method::Phong(settings), size(240, 160)),
        );
        let pairs = truth.pixels().iter().zip(phong.picture.pixels());
        let off = pairs.filter(|(a, b)| differs(a, b, 2.0 / 255.0)).count();
        // Outlines and edges of shadows may fall on the other side of a pixel's center.
        assert!(off <= 240 * 160 / 500, "{projection:?}: {off} pixels are off");
        assert!(phong.counts.shadow > 0);
    }
}

#[test]
fn where_faces_are_the_bodies_phong_is_the_traced_picture_however_coarse() {
    let bodies = vec![
        turned(Shape::CUBE, v(0.0, 1.0, 0.0), v(20.0, 30.0, 10.0), glossy()),
        body(
            Shape::Plane,
            DVec3::ZERO,
            checkered(
                chalk(0.7, 0.7, 0.6),
                SolidTexture { color: Color::gray(0.1), size: 0.7, ..SolidTexture::default() },
            ),
        ),
    ];
    // The floor reaches the horizon and goes under the eye.
    let scene =
        scene(bodies, camera(v(0.0, 1.5, 6.0), v(0.0, 1.2, 0.0), 60.0), vec![light(v(-2.0, 6.0, 5.0), 0.8)]);
    let render_scene = render_scene(&scene).with_generations(1);
    let settings = ShadingSettings { fineness: 1, shadows: true, ..ShadingSettings::default() };
    for samples in [1, 3] {
        let settings_of_both = catoptric_tracer::RenderSettings { samples, ..size(200, 150) };
        let truth = traced(&render_scene, settings_of_both);
        let phong = drawn(&render_scene, Method::Phong(settings), settings_of_both).picture;
        let off = truth.pixels().iter().zip(phong.pixels()).filter(|(a, b)| differs(a, b, 1e-4)).count();
        assert!(off <= 200 * 150 / 500, "{off} pixels are off with {samples} samples");
    }
}

#[test]
fn flat_faces_have_one_value_each() {
    let render_scene = close_ball();
    let picture = drawn(&render_scene, Method::Flat(fine(4)), size(200, 150)).picture;
    let values: BTreeSet<[u32; 3]> = picture.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect();
    // No more values than faces on the near side, and not one alone.
    assert!((10..=8 * 16 / 2).contains(&values.len()), "{} values", values.len());
    // Every value fills a region without gaps: a face is convex, so in each row it is one run.
    for row in picture.rows() {
        let mut runs: Vec<[u32; 3]> = row.iter().map(|pixel| pixel.map(f32::to_bits)).collect();
        runs.dedup();
        let different: BTreeSet<_> = runs.iter().collect();
        assert_eq!(different.len(), runs.len());
    }
}

#[test]
fn a_checkered_flat_face_has_one_intensity_on_two_colors() {
    let checkered = Material::Phong(Phong {
        pattern: Pattern {
            color: Color::gray(0.75),
            solid: Some(SolidTexture { color: Color::gray(0.25), size: 0.25, ..SolidTexture::default() }),
            ..Pattern::default()
        },
        ambient: 0.0,
        diffuse: 1.0,
        ..Phong::default()
    });
    let cube = block(v(2.0, 2.0, 2.0), DVec3::ZERO, checkered);
    let scene =
        scene(vec![cube], camera(v(0.0, 0.0, 6.0), DVec3::ZERO, 10.0), vec![light(v(1.0, 2.0, 9.0), 1.0)]);
    let picture = drawn(&render_scene(&scene), Method::Flat(fine(1)), size(100, 100)).picture;
    let values: BTreeSet<u32> = picture.pixels().iter().map(|pixel| pixel[0].to_bits()).collect();
    let values: Vec<f32> = values.into_iter().map(f32::from_bits).collect();
    let [dark, bright] = values[..] else { panic!("{values:?}") };
    assert!((bright / dark - 3.0).abs() < 1e-5);
}

#[test]
fn gouraud_loses_a_highlight_between_vertices() {
    // The highlight lies in the middle of a cube's face, which one part has no vertex near.
    let shiny = Phong { shininess: 200.0, ..glossy() };
    let cube = block(v(2.0, 2.0, 2.0), DVec3::ZERO, shiny);
    let scene =
        scene(vec![cube], camera(v(0.0, 0.0, 6.0), DVec3::ZERO, 10.0), vec![light(v(0.0, 0.0, 9.0), 1.0)]);
    let render_scene = render_scene(&scene);
    let brightest = |method| {
        let picture = drawn(&render_scene, method, size(50, 50)).picture;
        picture.pixels().iter().map(|pixel| pixel[2]).fold(0.0, f32::max)
    };
    let (phong, gouraud) = (brightest(Method::Phong(fine(1))), brightest(Method::Gouraud(fine(1))));
    assert!(phong > gouraud + 0.5, "{phong} and {gouraud}");
    let lambert = ShadingSettings { model: LightModel::Lambert, ..fine(1) };
    assert!(brightest(Method::Phong(lambert)) < phong - 0.5);
}

#[test]
fn shadows_are_left_out_unless_asked_for() {
    let render_scene = render_scene(&scene(
        vec![
            block(v(1.0, 0.1, 1.0), v(0.0, 2.0, 0.0), glossy()),
            body(Shape::Plane, DVec3::ZERO, chalk(1.0, 1.0, 1.0)),
        ],
        camera(v(0.0, 1.0, 8.0), DVec3::ZERO, 20.0),
        vec![light(v(0.0, 8.0, 0.0), 1.0)],
    ));
    let at_origin = |shadows| {
        let settings = ShadingSettings { shadows, ..fine(8) };
        let drawing = drawn(&render_scene, Method::Phong(settings), size(101, 101));
        assert_eq!(drawing.counts.shadow > 0, shadows);
        drawing.picture.pixel(50, 50).unwrap()[0]
    };
    assert!(at_origin(false) > 0.8);
    assert!(at_origin(true) < 0.11);
}

#[test]
fn seen_from_within_the_inner_side_is_lit() {
    let room = block(v(8.0, 8.0, 8.0), DVec3::ZERO, glossy());
    let scene = scene(
        vec![room],
        camera(v(0.5, 0.2, 1.0), v(0.0, 0.0, -4.0), 80.0),
        vec![light(v(0.0, 1.0, 0.0), 1.0)],
    );
    let render_scene = render_scene(&scene).with_generations(1);
    let truth = traced(&render_scene, size(120, 90));
    for shading in [Method::Phong(fine(16)), Method::Gouraud(fine(64))] {
        assert!(
            rmse(&drawn(&render_scene, shading, size(120, 90)).picture, &truth) < 2e-3,
            "{}",
            shading.name()
        );
    }
}

#[test]
fn the_bytes_do_not_depend_on_the_threads() {
    for example in ["four-bodies", "sphereflake"] {
        let render_scene = render_scene(&Example::find(example).unwrap().load().unwrap().scene);
        for method in [Method::Flat(fine(3)), Method::Gouraud(fine(3)), Method::Phong(fine(3))] {
            let on = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| drawn(&render_scene, method, size(97, 61)).picture)
            };
            assert!(on(1) == on(3), "{}", method.name());
        }
    }
}

/// Physical materials and lights that are balls are lit as traced ones: on the flat faces of a cube nothing is lost by
/// interpolation, and each pixel has the sample of the light that the traced one has.
#[test]
fn physical_materials_are_lit_as_traced_ones() {
    let gold = MetalOptics::Metal(catoptric_optics::Metal::named("gold").unwrap());
    let rough = Material::Conductor(Conductor { metal: gold, roughness: 0.5 });
    let coated = Material::Coated(Coated {
        pattern: Color::new(0.3, 0.6, 0.8).into(),
        roughness: 0.3,
        ..Coated::default()
    });
    for material in [rough, coated] {
        let lamp = Light { radius: 0.4, ..light(v(2.0, 3.0, 4.0), 1.5) };
        let cube = turned(Shape::CUBE, DVec3::ZERO, v(25.0, 35.0, 0.0), material);
        let scene = scene(vec![cube], camera(v(0.0, 0.0, 6.0), DVec3::ZERO, 25.0), vec![lamp]);
        let render_scene = render_scene(&scene).with_generations(1);
        let truth = traced(&render_scene, size(120, 90));
        let seen = bodies_seen(&render_scene, size(120, 90));
        let drawing = drawn(&render_scene, Method::Phong(fine(8)), size(120, 90));
        let pairs = truth.pixels().iter().zip(drawing.picture.pixels()).zip(seen);
        let of_cube: Vec<_> = pairs.filter(|(_, seen)| seen.is_some()).map(|(pair, _)| pair).collect();
        let off = of_cube.iter().filter(|(traced, drawn)| differs(traced, drawn, 1e-3)).count();
        // Pixels on the outline and on edges show one face or the other.
        assert!(of_cube.len() > 1000 && off < of_cube.len() / 50, "{off} of {}", of_cube.len());
        assert!(of_cube.iter().any(|(traced, _)| traced.iter().any(|part| *part > 0.05)), "it is lit");
    }
}

/// So many fine balls do not go into one batch of faces: whichever batch is drawn last, the nearest face is seen.
#[test]
fn batches_hide_each_other_in_any_order() {
    let ball_at = |step: f64| {
        let color = chalk(0.1 + 0.1 * step, 0.9 - 0.1 * step, 0.5);
        ball(0.8, v(0.4 * step - 1.2, 0.1 * step, -1.5 * step), color)
    };
    let mut bodies: Vec<_> = (0..8).map(|step| ball_at(f64::from(step))).collect();
    let picture_of = |bodies: Vec<_>, method: Method| {
        let camera = camera(v(0.0, 0.3, 7.0), DVec3::ZERO, 30.0);
        let scene = scene(bodies, camera, vec![light(v(3.0, 4.0, 5.0), 0.8)]);
        let settings = catoptric_tracer::RenderSettings { samples: 2, ..size(120, 90) };
        drawn(&render_scene(&scene), method, settings).picture
    };
    for method in [Method::Flat, Method::Phong].map(|method| method(fine(128))) {
        let in_order = picture_of(bodies.clone(), method);
        bodies.reverse();
        assert_eq!(picture_of(bodies.clone(), method), in_order);
        bodies.reverse();
        assert_ne!(picture_of(bodies[..7].to_vec(), method), in_order);
    }
}

/// The faces of joined bodies show what the traced bodies do: no film where parts have a face in common, nothing of what is
/// cut away, no gaps between the faces of parts.
#[test]
fn joined_bodies_have_their_shape_in_all_three() {
    let part =
        |shape: Shape, at: DVec3| BodyPart { shape, placement: Placement::at(at), ..BodyPart::default() };
    let of = |color: [f64; 3], part: BodyPart| {
        let [r, g, b] = color;
        BodyPart { material: Some(MaterialChoice::own(glow(r, g, b))), ..part }
    };
    let joined = |shape: Shape, parts: Vec<BodyPart>, at: DVec3| Body {
        shape,
        parts,
        placement: Placement::at(at),
        material: MaterialChoice::own(glow(0.9, 0.2, 0.1)),
        ..Body::default()
    };
    let pip = |at: DVec3| of([0.1, 0.9, 0.2], part(Shape::Sphere { radius: 0.4 }, at));
    let die = joined(
        Shape::Difference,
        vec![
            part(Shape::Cube { size: DVec3::splat(1.6) }, DVec3::ZERO),
            pip(DVec3::new(0.3, 0.9, 0.2)),
            pip(DVec3::new(0.1, -0.2, 0.95)),
        ],
        DVec3::new(-1.8, 0.9, 0.0),
    );
    let tube = joined(
        Shape::Difference,
        vec![
            part(Shape::Cylinder { radius: 0.8, height: 1.2 }, DVec3::ZERO),
            of([0.1, 0.3, 0.9], part(Shape::Cylinder { radius: 0.6, height: 1.2 }, DVec3::ZERO)),
        ],
        DVec3::new(0.2, 0.0, 0.4),
    );
    let lens = joined(
        Shape::Intersection,
        vec![
            part(Shape::Sphere { radius: 1.4 }, DVec3::new(0.0, 0.0, -1.0)),
            of([0.8, 0.8, 0.1], part(Shape::Sphere { radius: 1.4 }, DVec3::new(0.0, 0.0, 1.0))),
        ],
        DVec3::new(2.0, 1.0, 0.2),
    );
    let open = |kind: ShapeKind, at: DVec3, turn: DVec3| {
        let anchor = Anchor::Frame { position: at, rotation_degrees: turn };
        let placement = Placement { anchor, scale: DVec3::ONE };
        let material = MaterialChoice::own(glow(0.7, 0.5, 0.9));
        Body { placement, material, ..Body::of_shape(kind.body_shape()) }
    };
    let pipe = open(ShapeKind::OpenCylinder, DVec3::new(-0.9, 0.0, 1.9), v(0.0, 0.0, -20.0));
    let sail = open(ShapeKind::Triangle, DVec3::new(1.1, 0.6, 1.6), v(80.0, 20.0, 0.0));
    let mut channel = open(ShapeKind::OpenCylinder, DVec3::new(0.9, 1.9, 1.2), v(0.0, 0.0, -70.0));
    channel.change_shape(|shape| shape.set_word("visible_side", "inner"));
    let dome = joined(
        Shape::SURFACE,
        vec![
            part(Shape::Sphere { radius: 0.7 }, DVec3::ZERO),
            of([0.1, 0.3, 0.9], part(Shape::Cube { size: v(1.0, 2.0, 2.0) }, v(0.2, 0.2, 0.4))),
        ],
        DVec3::new(-2.6, 2.3, 0.2),
    );
    let floor = body(Shape::Plane, DVec3::ZERO, glow(0.3, 0.4, 0.5));
    let scene = scene(
        vec![die, tube, lens, pipe, sail, channel, dome, floor],
        camera(v(0.6, 3.6, 6.0), v(0.0, 0.6, 0.0), 42.0),
        Vec::new(),
    );
    let render_scene = render_scene(&scene).with_generations(1);
    let truth = traced(&render_scene, size(240, 160));
    for method in [Method::Flat, Method::Gouraud, Method::Phong] {
        let found = drawn(&render_scene, method(fine(32)), size(240, 160)).picture;
        let pairs = found.pixels().iter().zip(truth.pixels());
        let off = pairs.filter(|(found, truth)| differs(found, truth, 0.02)).count();
        assert!(off < 240 * 160 / 200, "{off} pixels show something else");
    }
}
