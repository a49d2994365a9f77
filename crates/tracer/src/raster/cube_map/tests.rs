//! Directions find their pixels, and edges do not show.

use super::*;

/// A map of which each pixel has the light that `light` gives for the direction of its middle.
fn painted(size: u32, light: impl Fn(DVec3) -> DVec3) -> CubeMap {
    let mut map = CubeMap::empty(DVec3::ZERO, size).unwrap();
    let place = |at: i32| f64::from(2 * at + 1) / f64::from(size) - 1.0;
    for (face, axes) in FACES.iter().enumerate() {
        let sides = || -1..=size as i32;
        for (x, y) in sides().flat_map(|y| sides().map(move |x| (x, y))) {
            let direction = axes.forward + axes.forward.cross(axes.up) * place(x) - axes.up * place(y);
            let index = map.index(face, x as isize, y as isize);
            map.pixels[index] = light(direction.normalize()).as_vec3().to_array();
        }
    }
    map
}

fn directions() -> impl Iterator<Item = DVec3> {
    // The spiral of equal areas (Vogel 1979).
    const COUNT: u32 = 4000;
    (0..COUNT).map(|index| {
        let z = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(COUNT);
        let (sin, cos) = (f64::from(index) * 2.399_963_229_728_653).sin_cos();
        DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    })
}

#[test]
fn faces_look_where_they_should() {
    for (index, axes) in FACES.iter().enumerate() {
        let map = painted(4, |_| DVec3::ZERO);
        assert_eq!(map.spots(ScalarWidth, axes.forward.as_vec3().into()).faces[0] as usize, index);
    }
}

#[test]
fn interpolated_light_is_that_of_the_direction() {
    // Twice the pixels, a quarter of the error: at edges and corners too.
    for (size, allowed) in [(8, 2e-2), (16, 5e-3), (64, 3.2e-4)] {
        let map = painted(size, |direction| direction);
        let corners = [DVec3::ONE, DVec3::new(1.0, 1.0, 0.0), DVec3::new(-1.0, 0.0, 1.0)];
        for direction in directions().chain(corners) {
            let direction = direction.normalize();
            let light = map.light(3.0 * direction.as_vec3()).as_dvec3();
            assert!((light - direction).length() < allowed, "{size}: {light} for {direction}");
        }
    }
}

#[test]
fn the_unfolded_cube_joins_its_faces() {
    let map = painted(16, |direction| direction);
    let picture = map.unfolded().unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 48));
    let at = |x, y| Vec3::from(picture.pixel(x, y).unwrap());
    // Along the middle row, and over the top and bottom of the face towards -Z, directions change step by step.
    let row: Vec<Vec3> = (0..64).map(|x| at(x, 24)).collect();
    let column: Vec<Vec3> = (0..48).map(|y| at(24, y)).collect();
    for line in [row, column] {
        assert!(line.windows(2).all(|pair| pair[0].distance(pair[1]) < 0.14));
    }
    assert!(at(24, 24).z < -0.99 && at(40, 24).x > 0.99 && at(24, 8).y > 0.99);
    assert_eq!(at(0, 0), Vec3::ZERO);
}

#[test]
fn strange_directions_find_some_pixel() {
    let map = painted(2, |direction| direction);
    for direction in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::splat(1e-40), Vec3::X * f32::MAX] {
        let _ = map.light(direction);
    }
}
