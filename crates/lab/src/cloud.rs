//! A cloud of bodies of four shapes, for measuring what many bodies cost: alone, or around the bodies of a scene.

use catoptric_scene::{
    Anchor, Body, Camera, Color, Environment, Light, Material, MaterialChoice, NamedMaterial, Phong,
    Placement, Projection, Scene, Shape, Tracing,
};
use glam::DVec3;

use crate::random::Random;

const MATERIALS: u64 = 16;
/// Edge of the cube that holds the bodies' origins, meters.
const EDGE: f64 = 10.0;

/// Spheres, cubes, cylinders and cones in equal parts. Their sizes are 0.3 to 0.6 of the edge of the cube that each has
/// to itself on average, so that the cloud stays as dense for any number.
pub fn cloud(bodies: usize) -> Scene {
    let mut random = Random::new(1);
    let materials = materials("m", &mut random);
    let spacing = EDGE / (bodies.max(1) as f64).cbrt();
    Scene {
        camera: Camera {
            position: DVec3::new(9.0, 7.0, 14.0),
            target: DVec3::ZERO,
            projection: Projection::Perspective { fov_degrees: 38.0 },
            ..Camera::default()
        },
        tracing: Tracing { generations: 4, threshold: 0.0 },
        environment: Environment {
            background: Color::new(0.2, 0.35, 0.6),
            ambient: Color::WHITE,
            ..Environment::default()
        },
        lights: vec![
            Light { position: DVec3::new(8.0, 14.0, 10.0), ..Light::default() },
            Light {
                name: "fill".to_owned(),
                position: DVec3::new(6.0, 5.0, 3.0),
                color: Color::new(1.0, 0.9, 0.8),
                intensity: 0.5,
                ..Light::default()
            },
        ],
        bodies: (0..bodies)
            .map(|number| {
                let (size, within) = (spacing * random.number(0.3, 0.6), DVec3::splat(EDGE / 2.0));
                body(number, size, [-within, within], "m", &mut random)
            })
            .collect(),
        materials,
    }
}

/// The scene with this many bodies that are not hidden, deterministically: the first ones of its own as far as they go,
/// then bodies of a cloud.
///
/// The cloud fills the box around the scene's own bounded bodies, or a cube of 10 m about the camera's target if there
/// are none, as [`cloud`] does: spheres, cubes, cylinders and cones in equal parts, of 0.3 to 0.6 of the edge of the
/// cube that each has to itself on average. So the share of the box that they fill does not depend on their number.
pub fn grown(scene: &Scene, bodies: usize) -> Scene {
    let shown = |body: &&Body| !body.hidden;
    let own: Vec<Body> = scene.bodies.iter().filter(shown).take(bodies).cloned().collect();
    let added = bodies.saturating_sub(own.len());
    let [low, high] = extent(scene).unwrap_or_else(|| {
        let half = DVec3::splat(EDGE / 2.0);
        [scene.camera.target - half, scene.camera.target + half]
    });
    let edges = (high - low).max(DVec3::splat(1e-6));
    let spacing = (edges.x * edges.y * edges.z / added.max(1) as f64).cbrt();
    let mut random = Random::new(1);
    let mut grown = Scene { bodies: own.into(), ..scene.clone() };
    grown.materials.extend(materials(GROWN, &mut random));
    grown.bodies.extend((0..added).map(|number| {
        let size = (spacing * random.number(0.3, 0.6)).min(edges.min_element());
        body(number, size, [low, high], GROWN, &mut random)
    }));
    grown
}

/// The names of the materials of added bodies begin with this, which no name in a file can.
const GROWN: &str = "\u{1}cloud ";

/// The box around the visible bounded bodies of a scene, from sizes that are never too small.
fn extent(scene: &Scene) -> Option<[DVec3; 2]> {
    let boxes = scene.bodies.iter().filter(|body| !body.hidden).filter_map(|body| {
        let corners = body.box_corners()?.into_iter();
        Some(corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], corner| {
            [low.min(corner), high.max(corner)]
        }))
    });
    boxes.reduce(|[low, high], [other_low, other_high]| [low.min(other_low), high.max(other_high)])
}

/// Sixteen materials that reflect a little, named by number.
fn materials(prefix: &str, random: &mut Random) -> Vec<NamedMaterial> {
    let material = |number| NamedMaterial {
        name: format!("{prefix}{number}"),
        material: Material::Phong(Phong {
            pattern: Color::from(random.vector(0.2, 1.0).to_array()).into(),
            diffuse: 0.6,
            specular: 0.5,
            shininess: 60.0,
            reflection: Some(0.3),
            ..Phong::default()
        }),
    };
    (0..MATERIALS).map(material).collect()
}

/// A body of this size in a box, of one of the materials named by a prefix.
fn body(number: usize, size: f64, [low, high]: [DVec3; 2], prefix: &str, random: &mut Random) -> Body {
    let shape = match number % 4 {
        0 => Shape::Sphere { radius: size / 2.0 },
        1 => Shape::Cube { size: DVec3::splat(size) },
        2 => Shape::Cylinder { radius: size / 3.0, height: size },
        _ => Shape::Cone { radius: size / 2.0, top_radius: 0.0, height: size },
    };
    let mut between = |low, high| random.number(low, high);
    let position = DVec3::new(between(low.x, high.x), between(low.y, high.y), between(low.z, high.z));
    let rotation_degrees = random.vector(-180.0, 180.0);
    Body {
        shape,
        placement: Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE },
        material: MaterialChoice::Named(format!("{prefix}{}", random.below(MATERIALS))),
        ..Body::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_grows_by_itself_first_and_within_its_box() {
        let own = |x: f64| Body { placement: Placement::at(DVec3::new(x, 0.0, 0.0)), ..Body::default() };
        let hidden = Body { hidden: true, placement: Placement::at(DVec3::splat(99.0)), ..Body::default() };
        let floor = Body { shape: Shape::Plane, ..Body::default() };
        let scene = Scene { bodies: [floor, hidden, own(-2.0), own(2.0)].into(), ..Scene::default() };
        assert_eq!(extent(&scene), Some([DVec3::new(-3.0, -1.0, -1.0), DVec3::new(3.0, 1.0, 1.0)]));
        for count in [0, 1, 2, 3] {
            assert_eq!(grown(&scene, count).bodies.len(), count);
        }
        let large = grown(&scene, 1000);
        assert_eq!(large, grown(&scene, 1000), "always the same");
        assert_eq!(large.bodies.len(), 1000);
        assert_eq!(large.bodies[2], scene.bodies[3]);
        for body in large.bodies.iter().skip(3) {
            let origin = body.placement.origin();
            assert!(
                origin.cmpge(DVec3::new(-3.0, -1.0, -1.0)).all()
                    && origin.cmple(DVec3::new(3.0, 1.0, 1.0)).all()
            );
            assert!(large.material(&body.material).is_some());
        }
        // The volume that the bodies have to themselves does not depend on their number.
        let volume = |scene: &Scene| {
            let cubes = scene.bodies.iter().skip(3).filter_map(|body| match body.shape {
                Shape::Cube { size } => Some(size.x * size.y * size.z),
                _ => None,
            });
            cubes.sum::<f64>()
        };
        let (some, many) = (volume(&large), volume(&grown(&scene, 20_000)));
        assert!((some / many - 1.0).abs() < 0.1, "{some} {many}");
    }

    #[test]
    fn an_empty_scene_grows_about_what_the_camera_looks_at() {
        let scene = grown(&Scene::default(), 8);
        let target = scene.camera.target;
        assert!(scene.bodies.iter().all(|body| body.placement.origin().distance(target) < 10.0));
    }
}
