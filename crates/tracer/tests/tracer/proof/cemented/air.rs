//! Contacts without and with cement, beside each other.

use super::*;

/// A scene that says nothing of contacts is drawn as what says air, bit by bit, and where nothing touches cement changes nothing.
#[test]
fn air_is_the_default() {
    let bodies =
        || [ball(0.7, v(0.2, 0.4, 0.0), milky(1.5)), block(v(1.0, 0.5, 1.0), v(-0.9, -0.3, 0.3), clear(1.6))];
    let default = on_show(bodies());
    let mut air = default.clone();
    air.bodies.iter_mut().for_each(|body| body.contact = BodyContact::Air);
    assert!(picture(&default, 60, 45) == picture(&air, 60, 45));
    assert!(picture(&cemented(air), 60, 45) == picture(&default, 60, 45));
    // Only the order differs in which shadow rays multiply what surfaces let through.
    let cemented = picture(&cemented(default.clone()), 60, 45);
    assert_equal_but_for_rounding(&cemented, &picture(&default, 60, 45), 0.0);
}

#[test]
fn two_slabs_are_one_slab() {
    let materials: [Material; 5] = [
        clear(1.5).into(),
        stained(1.6).into(),
        milky(1.5).into(),
        Phong { fresnel: catoptric_scene::FresnelTerm::Schlick, ..milky(1.4) }.into(),
        colorful(1.6, 30.0).into(),
    ];
    for (number, material) in materials.iter().enumerate() {
        let [two, one] = slabs(material, 1.0, 0.0);
        let one = picture(&on_show(one), 120, 90);
        let joined = picture(&cemented(on_show(two.clone())), 120, 90);
        assert_equal_but_for_rounding(&joined, &one, 0.002);
        assert!(apart(&picture(&on_show(two.clone()), 120, 90), &one) > 0.04, "material {number}");
        // It is enough that one of them says so.
        let mut own = two;
        own[1].contact = BodyContact::Cemented;
        assert_equal_but_for_rounding(&picture(&on_show(own), 120, 90), &joined, 0.0);
    }
}
