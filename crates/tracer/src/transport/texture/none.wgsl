// Twin of texture.rs for stages without textures.

fn color_at(color: vec3<f32>, body: u32, in_body: vec3<f32>) -> vec3<f32> {
    return color;
}
