//! Pictures on bodies.

pub(crate) mod checker;
pub(crate) mod lookup;

use std::f32::consts::{PI, TAU};

use catoptric_scene::Pattern;

use crate::geometry::shape::{CanonicalShape, ShapeKind};
use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, Mask as _, Width};
use crate::transport::texture::lookup::{AddressMode, ImageLookup};

/// A picture on the body, in the place of its color.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ImageTexture(ImageLookup);

impl ImageTexture {
    /// The texture of a pattern, once its pixels are known.
    pub(crate) fn new(pattern: &Pattern) -> Option<Self> {
        pattern.texture.as_ref().and_then(ImageLookup::new).map(Self)
    }

    pub(crate) fn image(&self) -> &ImageLookup {
        &self.0
    }

    /// The colors where rays `lanes` met a body, at these points of its own frame.
    #[cold]
    #[inline(never)]
    pub(crate) fn colors<W: Width>(
        &self,
        w: W,
        shape: CanonicalShape,
        in_body: Vector<W::R>,
        lanes: W::M,
    ) -> Vector<W::R> {
        let [mut x, mut y, mut z] = [[0.0; MOST_LANES]; 3];
        in_body.x.store(&mut x);
        in_body.y.store(&mut y);
        in_body.z.store(&mut z);
        let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
        let asked = lanes.bits();
        for lane in (0..W::LANES).filter(|lane| asked >> lane & 1 == 1) {
            [red[lane], green[lane], blue[lane]] = self.color(shape, [x[lane], y[lane], z[lane]]);
        }
        Vector::new(w.load(&red), w.load(&green), w.load(&blue))
    }

    fn color(&self, shape: CanonicalShape, point: [f32; 3]) -> [f32; 3] {
        let (u, v, beyond) = place(shape, point);
        self.0.at(u, v, beyond)
    }
}

/// Points of a cap may be this far from its level by rounding.
pub(crate) const LEVEL: f32 = 1e-6;

/// Where a point of a body's surface lies in the picture: its middle is where z is largest, seen upright from outside.
fn place(shape: CanonicalShape, [x, y, z]: [f32; 3]) -> (f32, f32, AddressMode) {
    let around = || 0.5 + x.atan2(z) / TAU;
    // A square as wide as 2, seen from its front.
    let flat = |right: f32, down: f32| (0.5 + 0.5 * right, 0.5 + 0.5 * down, AddressMode::Ends);
    match shape.kind {
        ShapeKind::Sphere | ShapeKind::Ellipsoid => {
            (around(), 0.5 - y.atan2((x * x + z * z).sqrt()) / PI, AddressMode::Repeats)
        }
        ShapeKind::Cube => {
            let [far_x, far_y, far_z] = [x, y, z].map(f32::abs);
            if far_x > far_y.max(far_z) {
                flat(-z * x.signum(), -y)
            } else if far_y > far_z {
                flat(x, z * y.signum())
            } else {
                flat(x * z.signum(), -y)
            }
        }
        ShapeKind::Cylinder | ShapeKind::Cone if y >= 1.0 - LEVEL => {
            let radius = if shape.kind == ShapeKind::Cone { shape.cone_ratio } else { 1.0 };
            flat(x / radius.max(LEVEL), z / radius.max(LEVEL))
        }
        ShapeKind::Cylinder | ShapeKind::Cone if y <= LEVEL => flat(x, -z),
        ShapeKind::Cylinder | ShapeKind::Cone => (around(), 1.0 - y, AddressMode::Repeats),
        ShapeKind::Plane => (x, z.rem_euclid(1.0), AddressMode::Repeats),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kind: ShapeKind, point: [f32; 3]) -> [f32; 2] {
        let (u, v, _) = place(CanonicalShape { kind, cone_ratio: 0.5 }, point);
        [u, v]
    }

    #[test]
    fn pictures_are_seen_upright_from_outside() {
        use ShapeKind::{Cone, Cube, Cylinder, Plane, Sphere};
        let expected = [
            (Sphere, [0.0, 0.0, 1.0], [0.5, 0.5]),
            (Sphere, [1.0, 0.0, 0.0], [0.75, 0.5]),
            (Sphere, [0.0, 1.0, 0.0], [0.5, 0.0]),
            (Cylinder, [-1.0, 0.25, 0.0], [0.25, 0.75]),
            (Cylinder, [0.5, 1.0, 0.5], [0.75, 0.75]),
            (Cylinder, [0.5, 0.0, 0.5], [0.75, 0.25]),
            (Cone, [0.0, 0.5, 0.75], [0.5, 0.5]),
            (Cone, [0.25, 1.0, 0.0], [0.75, 0.5]),
            // The upper right corner of each face.
            (Cube, [1.0, 1.0, 1.001], [1.0, 0.0]),
            (Cube, [-1.0, 1.0, -1.001], [1.0, 0.0]),
            (Cube, [1.001, 1.0, -1.0], [1.0, 0.0]),
            (Cube, [-1.001, 1.0, 1.0], [1.0, 0.0]),
            (Cube, [1.0, 1.001, -1.0], [1.0, 0.0]),
            (Cube, [1.0, -1.001, 1.0], [1.0, 0.0]),
            (Plane, [2.25, 0.0, -0.75], [2.25, 0.25]),
        ];
        for (kind, point, exact) in expected {
            let found = of(kind, point);
            let is_near = found.into_iter().zip(exact).all(|(found, exact)| (found - exact).abs() < 1e-3);
            assert!(is_near, "{kind:?} at {point:?}: {found:?}, not {exact:?}");
        }
    }
}
