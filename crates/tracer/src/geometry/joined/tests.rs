use catoptric_scene::{Body, BodyPart};
use proptest::prelude::*;

use super::*;

/// Any tree of parts, some of them without any parts of their own.
fn any_part() -> impl Strategy<Value = BodyPart> {
    let simple = Just(BodyPart { shape: Shape::CUBE, ..BodyPart::default() });
    simple.prop_recursive(6, 24, 4, |inner| {
        let shapes = [Shape::Union, Shape::Intersection, Shape::Difference, Shape::Group];
        (prop::sample::select(shapes.to_vec()), prop::collection::vec(inner, 0..4))
            .prop_map(|(shape, parts)| BodyPart { shape, parts, ..BodyPart::default() })
    })
}

/// Whether a point lies in a form, given whether it lies in the next part, and in the one after that.
fn is_in(form: &Form<'_>, bits: &mut u64) -> bool {
    let mut each = form.parts.iter().map(|part| is_in(&part.form(), bits)).collect::<Vec<_>>().into_iter();
    match form.shape {
        Shape::Union | Shape::Group => each.any(|is_in| is_in),
        Shape::Intersection | Shape::Surface { .. } => !form.parts.is_empty() && each.all(|is_in| is_in),
        Shape::Difference => each.next().unwrap_or(false) && !each.any(|is_in| is_in),
        _ => {
            let bit = *bits & 1;
            *bits >>= 1;
            bit == 1
        }
    }
}

fn tree_of(shape: Shape, parts: Vec<BodyPart>) -> JoinTree {
    JoinTree::of(&Body { shape, parts, ..Body::default() }.form())
}

proptest! {
    #[test]
    fn gates_are_the_tree(part in any_part(), bits in any::<u64>()) {
        let body = Body { shape: Shape::Difference, parts: vec![part.clone(), part], ..Body::default() };
        let tree = JoinTree::of(&body.form());
        prop_assume!(tree.parts <= 64);
        for bits in [bits, 0, u64::MAX] {
            prop_assert_eq!(tree.holds(bits), is_in(&body.form(), &mut bits.clone()));
        }
    }
}

#[test]
fn what_is_cut_from_a_common_part_has_one_gate() {
    let part = |shape, parts| BodyPart { shape, parts, ..BodyPart::default() };
    let cubes = |count| vec![part(Shape::CUBE, Vec::new()); count];
    let die =
        [part(Shape::Intersection, cubes(2)), part(Shape::Union, cubes(4)), part(Shape::CUBE, Vec::new())];
    let tree = tree_of(Shape::Difference, die.into());
    assert_eq!(tree.gates(), [JoinGate { parts: 0b111_1111, depth: 0, needs_all: true }]);
    assert_eq!(tree.inverted(), 0b111_1100);
    assert_eq!(
        tree_of(Shape::Intersection, Vec::new()).gates(),
        [JoinGate { parts: 0, depth: 0, needs_all: false }]
    );
}
