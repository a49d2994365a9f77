//! Bodies that touch each other.

use glam::DVec3;

use crate::Scene;
use crate::body::Body;
use crate::contact::{BodyContact, Contact};

impl Scene {
    /// Boxes that are so near each other meet, as a share of the size of their coordinates.
    const TOUCH: f64 = 1e-6;

    /// The bodies that may touch the one at a place, one of the two being clear: those with a box along the axes of the world
    /// that meets its own. What is hidden touches nothing.
    pub fn contacts_of(&self, index: usize) -> impl Iterator<Item = usize> {
        let own = self.bodies.get(index).filter(|body| !body.hidden);
        let own = own.map(|body| (self.is_clear(body), world_box(body)));
        let touches = move |&(other, body): &(usize, &Body)| {
            own.is_some_and(|(is_clear, own)| {
                other != index
                    && !body.hidden
                    && (is_clear || self.is_clear(body))
                    && own.zip(world_box(body)).is_none_or(|(own, other)| meet(own, other))
            })
        };
        self.bodies.iter().enumerate().filter(touches).map(|(other, _)| other)
    }

    /// Whether the scene or a body that is not hidden says that bodies which touch are cemented, and one of them is clear.
    pub fn has_cemented(&self) -> bool {
        let shown = || self.bodies.iter().filter(|body| !body.hidden);
        let is_said = self.environment.contact == Contact::Cemented
            || shown().any(|body| body.contact == BodyContact::Cemented);
        is_said && shown().any(|body| self.is_clear(body))
    }

    /// Whether light passes a body or a part of it.
    fn is_clear(&self, body: &Body) -> bool {
        let passes =
            |choice| self.material(choice).is_some_and(|material| material.lets_through().most > 0.0);
        body.materials().any(passes)
    }
}

/// The corners of a box around a body along the axes of the world, meters; `None` for what has no end.
fn world_box(body: &Body) -> Option<[DVec3; 2]> {
    let corners = body.box_corners()?;
    let [min, max] = [DVec3::min, DVec3::max].map(|pick| corners.into_iter().reduce(pick));
    Some([min?, max?])
}

fn meet([min, max]: [DVec3; 2], [other_min, other_max]: [DVec3; 2]) -> bool {
    let corners = [min, max, other_min, other_max];
    let slack =
        Scene::TOUCH * corners.into_iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    min.cmple(other_max + slack).all() && other_min.cmple(max + slack).all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Dielectric, MaterialChoice};
    use crate::placement::Placement;
    use crate::shape::Shape;

    #[test]
    fn bodies_that_may_touch_have_boxes_that_meet_and_one_is_clear() {
        let cube = |x: f64, is_clear: bool| Body {
            shape: Shape::Cube { size: DVec3::ONE },
            placement: Placement::at(DVec3::X * x),
            material: if is_clear {
                MaterialChoice::own(Dielectric::default())
            } else {
                MaterialChoice::default()
            },
            ..Body::default()
        };
        let floor = Body { shape: Shape::Plane, ..Body::default() };
        let hidden = Body { hidden: true, ..cube(0.5, true) };
        let bodies =
            [cube(0.0, true), cube(1.0 + 1e-9, false), cube(2.0, false), cube(3.0, true), floor, hidden];
        let scene = Scene { bodies: bodies.into(), ..Scene::default() };
        let found = |index| scene.contacts_of(index).collect::<Vec<_>>();
        assert_eq!([0, 1, 2, 3, 4].map(found), [vec![1, 4], vec![0], vec![3], vec![2, 4], vec![0, 3]]);
        assert_eq!((found(5), found(9)), (vec![], vec![]));
    }
}
