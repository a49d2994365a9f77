//! Pictures on bodies.

pub(crate) mod lookup;
pub(crate) mod solid;

use catoptric_scene::Pattern;

use crate::geometry::shape::CanonicalShape;
use crate::geometry::shape::solid::PicturePlace;
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
        let PicturePlace { u, v, repeats } = shape.kind.solid().picture_place(shape.cone_ratio, point);
        self.0.at(u, v, repeats.map(|repeats| if repeats { AddressMode::Repeats } else { AddressMode::Ends }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shape::ShapeKind;

    fn of(kind: ShapeKind, point: [f32; 3]) -> [f32; 2] {
        let PicturePlace { u, v, .. } = kind.solid().picture_place(0.5, point);
        [u, v]
    }

    #[test]
    fn pictures_are_seen_upright_from_outside() {
        use ShapeKind::{Cone, Cube, Cylinder, Paraboloid, Plane, Sphere};
        let expected = [
            (Sphere, [0.0, 0.0, 1.0], [0.5, 0.5]),
            (Sphere, [1.0, 0.0, 0.0], [0.75, 0.5]),
            (Sphere, [0.0, 1.0, 0.0], [0.5, 0.0]),
            (Cylinder, [-1.0, 0.25, 0.0], [0.25, 0.75]),
            (Cylinder, [0.5, 1.0, 0.5], [0.75, 0.75]),
            (Cylinder, [0.5, 0.0, 0.5], [0.75, 0.25]),
            (Cone, [0.0, 0.5, 0.75], [0.5, 0.5]),
            (Cone, [0.25, 1.0, 0.0], [0.75, 0.5]),
            (Paraboloid, [-0.5, 0.25, 0.0], [0.25, 0.5]),
            (Paraboloid, [0.5, 1.0, 0.5], [0.75, 0.75]),
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
