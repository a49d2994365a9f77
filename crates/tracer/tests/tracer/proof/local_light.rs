//! The local terms: ambient, Lambert, Phong, falloff, shadows, the checkerboard.

use catoptric_scene::{
    Anchor, Attenuation, Body, BodyPart, Color, Dielectric, Falloff, Material, MaterialChoice, Pattern,
    Phong, Placement, Scene, Shadow, Shape, SolidTexture,
};
use catoptric_tracer::surface::phong_highlight;
use glam::{DVec3, Vec3, Vec3A};

use crate::proof::common::{
    assert_close, assert_light, ball, block, camera, center, chalk, glass, light, plane, scene, v,
};

/// A floor of `material` seen at (x, 0, 0) from straight above, with other bodies and lights to be added.
fn floor_seen_at(x: f64, material: impl Into<Material>) -> Scene {
    let mut scene = scene(vec![plane(DVec3::ZERO, 0.0, material)]);
    scene.camera = camera(v(x, 50.0, 0.0), v(x, 0.0, 0.0), 1.0);
    scene.camera.up = DVec3::NEG_Z;
    scene
}

#[test]
fn lambert_and_the_three_laws_of_falloff() {
    let material = Phong { pattern: Color::new(0.9, 0.5, 0.1).into(), ambient: 0.0, diffuse: 0.7, ..chalk() };
    let height = 3.0;
    for x in [0.0, 1.0, 4.0, 20.0] {
        let d = f64::hypot(x, height);
        let laws = [
            (Falloff::None, 1.0),
            (Falloff::Linear { constant: 1.0 }, 1.0 / (d + 1.0)),
            (Falloff::Linear { constant: 0.25 }, 1.0 / (d + 0.25)),
            (Falloff::InverseSquare, 1.0 / (d * d)),
        ];
        for (falloff, at_d) in laws {
            let mut scene = floor_seen_at(x, material.clone());
            let mut lamp = light(v(0.0, height, 0.0), 2.5, falloff);
            lamp.color = Color::new(1.0, 0.8, 0.6);
            scene.lights = vec![lamp];
            let strength = 0.7 * 2.5 * (height / d) * at_d;
            assert_light(center(&scene), [0.9 * strength, 0.5 * 0.8 * strength, 0.1 * 0.6 * strength]);
        }
    }
}

#[test]
fn lights_add_and_ambient_light_needs_none() {
    let material = Phong { pattern: Color::new(0.2, 0.4, 0.8).into(), ambient: 0.3, diffuse: 0.5, ..chalk() };
    let mut scene = floor_seen_at(0.0, material);
    scene.environment.ambient = Color::new(1.0, 0.5, 0.25);
    assert_light(center(&scene), [0.06, 0.06, 0.06]);
    scene.lights =
        vec![light(v(0.0, 5.0, 0.0), 1.0, Falloff::None), light(v(3.0, 4.0, 0.0), 0.5, Falloff::None)];
    let diffuse = 0.5 * (1.0 + 0.5 * 0.8);
    assert_light(center(&scene), [0.06 + 0.2 * diffuse, 0.06 + 0.4 * diffuse, 0.06 + 0.8 * diffuse]);
}

#[test]
fn a_light_at_the_horizon_or_below_adds_nothing() {
    let shiny = Phong { specular: 1.0, reflection: Some(0.0), ..chalk() };
    for y in [0.0, -1.0] {
        let mut scene = floor_seen_at(0.0, shiny.clone());
        scene.lights = vec![light(v(4.0, y, 0.0), 1.0, Falloff::None)];
        assert_eq!(center(&scene), Vec3::ZERO);
    }
    // A light in the very point that is seen.
    let mut scene = floor_seen_at(0.0, shiny);
    scene.lights = vec![light(DVec3::ZERO, 1.0, Falloff::InverseSquare)];
    assert!(center(&scene).is_finite());
}

#[test]
fn highlights_are_powers_of_the_cosine_and_not_colored_by_the_body() {
    // Seen from above, light at this angle from the vertical: the mirrored direction is as far off on the other side.
    for shininess in [1.0, 8.0, 32.0, 200.0] {
        for degrees in [0.0_f64, 5.0, 20.0, 60.0, 89.0] {
            let material = Material::Phong(Phong {
                pattern: Color::new(1.0, 0.0, 0.0).into(),
                ambient: 0.0,
                diffuse: 0.0,
                specular: 0.5,
                reflection: Some(0.0),
                shininess,
                ..Phong::default()
            });
            let mut scene = floor_seen_at(0.0, material);
            let (sin, cos) = degrees.to_radians().sin_cos();
            scene.lights = vec![light(6.0 * v(sin, cos, 0.0), 1.0, Falloff::None)];
            let highlight = 0.5 * cos.powf(shininess);
            for channel in center(&scene).to_array() {
                // The power multiplies the cosine's relative error by the exponent.
                let tolerance = (3e-7 * shininess + 1e-6) * highlight;
                assert_close(f64::from(channel), highlight, tolerance + 1e-7);
            }
        }
    }
}

#[test]
fn what_a_highlight_leaves_out_is_invisible() {
    for step in 0..=1000 {
        let angle = f64::from(step) * 0.1_f64.to_radians();
        let to_light = v(angle.sin(), angle.cos(), 0.0).as_vec3a();
        for n in [0.0_f32, 1.0, 50.0, 1000.0, 1e6] {
            let exact = if angle.cos() > 0.0 { angle.cos().powf(f64::from(n)) } else { 0.0 };
            let actual = f64::from(phong_highlight(Vec3A::Y.into(), to_light.into(), Vec3A::Y.into(), n));
            assert_close(actual, exact, 1e-7 + 2e-7 * f64::from(n) * exact.max(1e-7));
        }
    }
}

/// A white floor seen at the origin under a light of strength 1 straight above, with `bodies` in the way.
fn under(bodies: Vec<Body>) -> Vec3 {
    let mut scene = floor_seen_at(0.0, chalk());
    // Seen from the side, past the bodies.
    scene.camera = camera(v(30.0, 1.0, 0.0), DVec3::ZERO, 1.0);
    scene.lights = vec![light(v(0.0, 10.0, 0.0), 1.0, Falloff::None)];
    scene.bodies.extend(bodies);
    center(&scene)
}

fn filter_of(transmission: f64, tint: [f64; 3]) -> Phong {
    Phong { transmission, tint: Color::from(tint), ..glass(1.5) }
}

#[test]
fn opaque_bodies_shade_and_glass_filters_once_per_surface() {
    assert_light(under(vec![]), [1.0; 3]);
    assert_light(under(vec![ball(1.0, v(0.0, 4.0, 0.0), chalk())]), [0.0; 3]);
    let tinted = filter_of(0.8, [1.0, 0.5, 0.25]);
    let twice = [0.64, 0.16, 0.04];
    assert_light(under(vec![ball(1.0, v(0.0, 4.0, 0.0), tinted.clone())]), twice);
    assert_light(under(vec![block(v(2.0, 0.01, 2.0), v(0.0, 4.0, 0.0), tinted.clone())]), twice);
    // A half-space of glass above has one surface.
    assert_light(under(vec![plane(v(0.0, 4.0, 0.0), 180.0, tinted.clone())]), [0.8, 0.4, 0.2]);
    // One ball inside another, and two in a row.
    let both = twice.map(|filter| filter * filter);
    assert_light(under([1.0, 0.5].map(|r| ball(r, v(0.0, 4.0, 0.0), tinted.clone())).to_vec()), both);
    assert_light(under([3.0, 6.0].map(|y| ball(1.0, v(0.0, y, 0.0), tinted.clone())).to_vec()), both);
    // Glass and then an opaque body, in either order of the scene.
    let pair = [ball(1.0, v(0.0, 3.0, 0.0), tinted), ball(1.0, v(0.0, 6.0, 0.0), chalk())];
    assert_light(under(pair.to_vec()), [0.0; 3]);
    assert_light(under(vec![pair[1].clone(), pair[0].clone()]), [0.0; 3]);
}

#[test]
fn a_floor_is_seen_and_lit_through_glass_that_stands_on_it() {
    // Bodies that touch have a film of air between them: both faces count, on the way of the eye and of the light.
    let mut scene = floor_seen_at(0.0, chalk());
    scene.lights = vec![light(v(0.0, 10.0, 0.0), 1.0, Falloff::None)];
    scene.bodies.push(block(v(2.0, 3.0, 2.0), v(0.0, 1.5, 0.0), filter_of(0.8, [1.0, 0.5, 0.25])));
    assert_light(center(&scene), [0.8, 0.4, 0.2].map(|filter: f64| filter.powi(4)));
}

#[test]
fn only_what_lies_between_shades() {
    // Behind the light, around it, touching it, beside the way.
    assert_light(under(vec![ball(1.0, v(0.0, 12.0, 0.0), chalk())]), [1.0; 3]);
    assert_light(under(vec![ball(1.0, v(0.0, 11.0, 0.0), chalk())]), [1.0; 3]);
    assert_light(under(vec![ball(1.0, v(1.001, 5.0, 0.0), chalk())]), [1.0; 3]);
    assert_light(under(vec![ball(1.0, v(0.999, 5.0, 0.0), chalk())]), [0.0; 3]);
    assert_light(under(vec![ball(0.5, v(0.0, 9.9, 0.0), chalk())]), [0.0; 3]);
    // A light in a ball of glass shines through one surface.
    assert_light(under(vec![ball(0.5, v(0.0, 10.2, 0.0), filter_of(0.5, [1.0; 3]))]), [0.5; 3]);
    // A body below the floor.
    assert_light(under(vec![ball(1.0, v(0.0, -1.5, 0.0), chalk())]), [1.0; 3]);
}

#[test]
fn many_bodies_shade_as_few_do() {
    // Past the number at which the search changes its method: a column of glass and a field of bystanders.
    let tinted = filter_of(0.9, [1.0, 0.5, 0.8]);
    let mut bodies: Vec<Body> =
        (0..6).map(|k| ball(0.3, v(0.0, 2.0 + f64::from(k), 0.0), tinted.clone())).collect();
    bodies.extend((0..200).map(|k| ball(0.2, v(-3.0 - f64::from(k % 20), 1.0, f64::from(k / 20)), chalk())));
    let crossings = 12;
    let filter = [0.9_f64, 0.45, 0.72].map(|filter| filter.powi(crossings));
    let light = under(bodies);
    for (actual, expected) in light.to_array().iter().zip(filter) {
        assert_close(f64::from(*actual), expected, 1e-5 * expected);
    }
}

#[test]
fn a_lit_ball_does_not_shade_its_own_bright_side() {
    // Seen along the light, every point of every visible side is lit with n·L.
    for radius in [1e-3, 1.0, 1e3] {
        let mut scene = scene(vec![ball(radius, DVec3::ZERO, chalk())]);
        for degrees in [0.0_f64, 30.0, 60.0, 80.0, 89.0, 89.9] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let n = v(sin, 0.0, cos);
            scene.camera = camera(radius * (n + 5.0 * DVec3::Z), radius * n, 1.0);
            scene.lights = vec![light(1e5 * radius * DVec3::Z, 1.0, Falloff::None)];
            let light = f64::from(center(&scene).x);
            // Near the rim the point that the camera's ray meets is known to √ε only.
            assert_close(light, cos, 4e-6 / cos.max(1e-3));
        }
    }
}

#[test]
fn inside_a_body_its_own_surface_filters_once() {
    let inner = Phong { pattern: Color::WHITE.into(), diffuse: 1.0, ..filter_of(0.5, [1.0, 0.6, 0.2]) };
    let mut scene = scene(vec![ball(2.0, DVec3::ZERO, inner), ball(0.5, DVec3::ZERO, chalk())]);
    scene.tracing.generations = 1;
    scene.camera = camera(v(0.0, 0.0, 1.5), DVec3::ZERO, 1.0);
    // An opaque ball in glass, eye in the glass, light outside: one crossing.
    scene.lights = vec![light(v(0.0, 0.0, 10.0), 1.0, Falloff::None)];
    assert_light(center(&scene), [0.5, 0.3, 0.1]);
    // Light in the glass: none.
    scene.lights[0].position = v(0.0, 0.0, 1.7);
    assert_light(center(&scene), [1.0; 3]);
    // The glass seen from within: a light inside shines on it, one outside does not.
    scene.camera.target = v(0.0, 0.0, 5.0);
    assert_light(center(&scene), [1.0; 3]);
    scene.lights[0].position = v(0.0, 0.0, 10.0);
    assert_light(center(&scene), [0.0; 3]);
}

#[test]
fn seen_from_within_an_opaque_body_is_lit_from_within() {
    let mut scene = scene(vec![block(v(4.0, 4.0, 4.0), DVec3::ZERO, chalk())]);
    scene.camera = camera(DVec3::ZERO, DVec3::NEG_Z, 1.0);
    scene.lights = vec![light(v(0.0, 0.0, 1.0), 1.0, Falloff::None)];
    assert_light(center(&scene), [1.0; 3]);
    scene.lights[0].position.z = 5.0;
    assert_light(center(&scene), [0.0; 3]);
}

#[test]
fn checkers_count_cells_of_the_world() {
    let checker = Some(SolidTexture { color: Color::BLACK, size: 0.5, ..SolidTexture::default() });
    let material = Material::Phong(Phong {
        pattern: Pattern { color: Color::WHITE, solid: checker, ..Pattern::default() },
        ambient: 1.0,
        diffuse: 0.0,
        ..Phong::default()
    });
    for x in -12_i32..12 {
        let mut scene = floor_seen_at(0.25 + 0.5 * f64::from(x), material.clone());
        scene.camera.position.z = 0.1;
        scene.camera.target.z = 0.1;
        // The floor at y = 0 belongs to the cells above it, and z = 0.1 to cell 0.
        let expected = if x.rem_euclid(2) == 0 { 1.0 } else { 0.0 };
        assert_light(center(&scene), [expected; 3]);
    }
}

#[test]
fn a_face_on_a_border_of_cells_belongs_to_the_cell_above_it() {
    // The top of a box, on the border, below it by rounding, and really below it.
    let tops =
        [(0.5, 0.0), (1.0, 1.0), (-0.5, 0.0), (37.5, 0.0), (0.499_999_8, 0.0), (0.499_995, 1.0), (-0.2, 0.0)];
    let checker = Some(SolidTexture { color: Color::BLACK, size: 0.5, ..SolidTexture::default() });
    let material = Material::Phong(Phong {
        pattern: Pattern { color: Color::WHITE, solid: checker, ..Pattern::default() },
        ambient: 1.0,
        diffuse: 0.0,
        ..Phong::default()
    });
    for step in 0..200 {
        let height = 0.1 + 0.013 * f64::from(step);
        for (top, expected) in tops {
            let mut scene =
                scene(vec![block(v(0.4, height, 0.4), v(0.25, top - 0.5 * height, 0.25), material.clone())]);
            scene.camera = camera(v(0.25, 50.0, 0.25), v(0.25, 0.0, 0.25), 1.0);
            scene.camera.up = DVec3::NEG_Z;
            assert_eq!(center(&scene), Vec3::splat(expected), "height {height}, top {top}");
        }
    }
}

#[test]
fn what_meets_nothing_brings_the_background() {
    let mut scene = scene(vec![]);
    scene.environment.background = Color::new(0.1, 2.0, 30.0);
    assert_eq!(center(&scene), Vec3::new(0.1, 2.0, 30.0));
}

/// All light passes what is to cast no shadow, and none what is to cast a full one, whatever it is made of: alone and among
/// many bodies, simple and of parts.
#[test]
fn bodies_cast_the_shadows_that_they_should() {
    let part = |shape, at| BodyPart { shape, placement: Placement::at(at), ..BodyPart::default() };
    let of_parts = |shape| Body {
        shape,
        parts: vec![part(Shape::SPHERE, DVec3::ZERO), part(Shape::CUBE, v(0.0, 0.6, 0.0))],
        placement: Placement::at(v(0.0, 3.0, 0.0)),
        ..Body::default()
    };
    // Its inside is above.
    let anchor = Anchor::Frame { position: v(0.0, 3.0, 0.0), rotation_degrees: v(180.0, 0.0, 0.0) };
    let placement = Placement { anchor, ..Placement::default() };
    let ceiling = Body { shape: Shape::Plane, placement, ..Body::default() };
    let absorbing = Dielectric {
        attenuation: Attenuation { color: Color::from([0.2, 0.5, 0.9]), distance: 2.0 },
        ..Dielectric::default()
    };
    let materials: [Material; 3] =
        [chalk().into(), Phong { transmission: 0.5, ..glass(1.5) }.into(), absorbing.into()];
    let shapes = [
        ball(1.0, v(0.0, 3.0, 0.0), chalk()),
        of_parts(Shape::Union),
        of_parts(Shape::Intersection),
        of_parts(Shape::SURFACE),
        of_parts(Shape::Group),
        ceiling,
    ];
    for (material, shape) in
        materials.iter().flat_map(|material| shapes.iter().map(move |shape| (material, shape)))
    {
        for crowd in [0, 100] {
            let shade = |shadow| {
                let mut scene = floor_seen_at(0.0, chalk());
                scene.lights = vec![light(v(0.0, 9.0, 0.0), 1.0, Falloff::None)];
                // The camera is below what is between the floor and the lamp.
                scene.camera.position.y = 1.0;
                let others = (0..crowd).map(|at| ball(1.0, v(20.0 + 3.0 * f64::from(at), 1.0, 0.0), chalk()));
                let material = MaterialChoice::own(material.clone());
                scene.bodies.extend(others.chain([Body { material, shadow, ..shape.clone() }]));
                center(&scene)
            };
            assert_light(shade(Shadow::None), [1.0; 3]);
            assert_light(shade(Shadow::Full), [0.0; 3]);
            let filtered = shade(Shadow::Filtered);
            let is_opaque = *material == materials[0];
            assert!(
                filtered.max_element() < 0.99 && (filtered.min_element() > 0.0) != is_opaque,
                "{:?}",
                shape.shape
            );
        }
    }
}
