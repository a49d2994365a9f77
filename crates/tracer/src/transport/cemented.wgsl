// Twin of transport/cemented.rs: one interface between the media of two bodies, or none.

// The row where the indices by wavelength in these media begin, or NO_ROWS.
fn indices_in(media: ptr<function, Media>) -> u32 {
    if !DISPERSES || (*media).count == 0u {
        return NO_ROWS;
    }
    let last = (*media).bodies[(*media).count - 1u];
    if last >= WAVES {
        return NO_ROWS;
    }
    return material_of(last).indices;
}

// What becomes of the surface of a cemented contact: where light goes on as in one body, there is none. Elsewhere light is
// split into its colors if either body does so.
fn cement(at: ptr<function, SurfaceInteraction>, media: ptr<function, Media>) {
    var beyond = *media;
    let ratio = media_cross(&beyond, (*at).start, (*at).contact);
    let own = indices_in(media);
    let others = indices_in(&beyond);
    if ratio == 1.0 && (!DISPERSES || !is_white(media) || own == others) {
        (*at).ambient = vec3(0.0);
        (*at).diffuse = vec3(0.0);
        (*at).reflected = vec3(0.0);
        (*at).material.law = LAW_NOTHING;
        (*at).material.diffuse = 0.0;
        (*at).material.specular = 0.0;
        (*at).material.alpha = 0.0;
        (*at).material.indices = NO_ROWS;
    } else if (*at).material.indices == NO_ROWS {
        (*at).material.indices = select(own, others, own == NO_ROWS);
    }
}
