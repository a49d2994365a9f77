//! Glass in a grid, for measuring trees of many generations: spheres, or lenses.

use catoptric_scene::{
    Anchor, Body, BodyShape, Camera, Color, Lens, LensCurvature, Light, Material, MaterialChoice,
    NamedMaterial, ParametricShape, Pattern, Phong, Placement, Projection, Scene, Shape, SolidTexture,
    Tracing,
};
use glam::DVec3;

const GLASS: &str = "glass";
const RADIUS: f64 = 0.5;
/// Distance of neighboring centers.
const SPACING: f64 = 1.2;

/// 27 spheres of the glass of the reference scene `whitted`, 3×3×3, over its checkered floor without reflection.
pub(crate) fn glass_grid() -> Scene {
    let steps = [-SPACING, 0.0, SPACING];
    let spheres = steps.into_iter().flat_map(|y| {
        let row = move |z| steps.map(move |x| DVec3::new(x, y, z));
        steps.into_iter().flat_map(row).map(|at| Body {
            shape: Shape::Sphere { radius: RADIUS },
            placement: Placement::at(at + DVec3::Y * (SPACING + 0.6)),
            material: MaterialChoice::Named(GLASS.to_owned()),
            ..Body::default()
        })
    });
    over_floor(spheres)
}

/// 1,000 biconvex lenses of that glass, 10×10×10, each turned its own way.
pub(crate) fn lens_grid() -> Scene {
    const SIDE: u32 = 10;
    let step = 3.0 * SPACING / f64::from(SIDE);
    let curvature = LensCurvature::Radii { front: 0.75 * step, back: -0.75 * step };
    let lens = Lens { radius: 0.42 * step, thickness: 0.3 * step, curvature };
    let shape = BodyShape::Parametric(ParametricShape::Lens(lens));
    let lenses = (0..SIDE.pow(3)).map(|number| {
        let place = |divisor: u32| f64::from(number / divisor % SIDE) - 0.5 * f64::from(SIDE - 1);
        let at = step * DVec3::new(place(1), place(SIDE * SIDE), place(SIDE));
        let turn = 137.5 * f64::from(number);
        let rotation_degrees = DVec3::new(turn % 360.0, 0.7 * turn % 360.0, 0.0);
        let anchor = Anchor::Frame { position: at + DVec3::Y * (SPACING + 0.6), rotation_degrees };
        Body {
            placement: Placement { anchor, scale: DVec3::ONE },
            material: MaterialChoice::Named(GLASS.to_owned()),
            ..Body::of_shape(shape)
        }
    });
    over_floor(lenses)
}

/// Bodies of glass over the floor.
fn over_floor(glass_bodies: impl Iterator<Item = Body>) -> Scene {
    let floor = Material::Phong(Phong {
        pattern: Pattern {
            color: Color::gray(0.85),
            solid: Some(SolidTexture { color: Color::gray(0.2), size: 1.0, ..SolidTexture::default() }),
            ..Pattern::default()
        },
        diffuse: 0.7,
        ..Phong::default()
    });
    let glass = Material::Phong(Phong {
        pattern: Color::WHITE.into(),
        ambient: 0.0,
        diffuse: 0.04,
        specular: 0.6,
        shininess: 120.0,
        reflection: Some(0.15),
        transmission: 0.8,
        ..Phong::default()
    });
    let mut bodies = vec![Body {
        name: "floor".to_owned(),
        shape: Shape::Plane,
        material: MaterialChoice::Inline(Box::new(floor)),
        ..Body::default()
    }];
    bodies.extend(glass_bodies);
    Scene {
        camera: Camera {
            position: DVec3::new(3.0, 3.4, 7.0),
            target: DVec3::new(0.0, 1.6, 0.0),
            projection: Projection::Perspective { fov_degrees: 34.0 },
            ..Camera::default()
        },
        tracing: Tracing { generations: 10, threshold: 0.0 },
        materials: vec![NamedMaterial { name: GLASS.to_owned(), material: glass }],
        lights: vec![
            Light { name: "key".to_owned(), ..Light::default() },
            Light {
                name: "fill".to_owned(),
                position: DVec3::new(6.0, 5.0, 3.0),
                color: Color::new(1.0, 0.9, 0.8),
                intensity: 0.5,
                ..Light::default()
            },
        ],
        bodies: bodies.into(),
        ..Scene::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spheres_stand_apart_above_the_floor() {
        let scene = glass_grid();
        assert!(scene.check().is_empty(), "{:?}", scene.check());
        let centers: Vec<DVec3> = scene.bodies.iter().skip(1).map(|body| body.placement.origin()).collect();
        assert_eq!(centers.len(), 27);
        for (index, center) in centers.iter().enumerate() {
            assert!(center.y > RADIUS);
            assert!(centers[..index].iter().all(|other| center.distance(*other) > 2.0 * RADIUS));
        }
    }

    #[test]
    fn the_lenses_stand_apart_above_the_floor() {
        let scene = lens_grid();
        assert!(scene.check().is_empty(), "{:?}", scene.check());
        assert_eq!(scene.bodies.len(), 1001);
        let step = 3.0 * SPACING / 10.0;
        for body in scene.bodies.iter().skip(1) {
            let corners = body.box_corners().unwrap();
            let middle = corners.into_iter().sum::<DVec3>() / 8.0;
            assert!(
                corners.into_iter().all(|corner| corner.distance(middle) < 0.65 * step && corner.y > 0.0)
            );
        }
    }

    #[test]
    fn glass_floor_and_lights_are_those_of_whitted() {
        let file = xtask::root().join("tests/reference/whitted.toml");
        let whitted = catoptric_store::load(file).unwrap().scene;
        let scene = glass_grid();
        let material = |name: &str| {
            let body = whitted.bodies.iter().find(|body| body.name == name).unwrap();
            whitted.material(&body.material).unwrap().clone()
        };
        assert_eq!(scene.materials[0].material, material("glass"));
        assert_eq!(scene.lights, whitted.lights);
        let floor = scene.material(&scene.bodies[0].material).and_then(Material::as_phong).unwrap();
        assert_eq!(Material::Phong(Phong { reflection: Some(0.15), ..floor.clone() }), material("floor"));
    }
}
