// For scenes without joined bodies.

fn is_joined(index: u32) -> bool {
    return false;
}

fn has_no_inside(index: u32) -> bool {
    return false;
}

fn whole_of(start: u32) -> u32 {
    return start;
}

fn volume_order(body: u32) -> u32 {
    return scene_order[body].y;
}

fn joined_contains(index: u32, point: vec3<f32>) -> bool {
    return false;
}

fn joined_meeting(index: u32, ray: Ray, media: ptr<function, Media>, part: ptr<function, u32>) -> BodyIntersection {
    return NO_MEETING;
}

fn filter_through_joined(index: u32, ray: Ray, media: ptr<function, Media>, distance: f32) -> vec3<f32> {
    return vec3(1.0);
}
