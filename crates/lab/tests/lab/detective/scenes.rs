//! Scenes of spheres and planes that show every mistake.

use catoptric_scene::{Scene, read};

const BALLS: &str = r##"format = 'catoptric/1'
camera = { position = [0.6, 1.7, 6.0], target = [0.1, 0.9, 0.0], fov = 38.0 }
environment = { background = [0.1, 0.16, 0.3], ambient = [0.9, 0.9, 0.9] }
lights = [
    { position = [-4.0, 6.0, 5.0], intensity = 0.8, color = [1.0, 0.95, 0.9] },
    { position = [5.0, 3.0, 2.0], intensity = 0.35 },
]
[[bodies]]
shape = 'plane'
material = { color = [0.8, 0.75, 0.6], diffuse = 0.7, specular = 0.0, reflection = 0.1, checker = { color = [0.25, 0.3, 0.35], size = 0.7 } }
[[bodies]]
name = 'red'
shape = 'sphere'
position = [-1.3, 1.0, 0.2]
material = { color = [0.9, 0.15, 0.1], diffuse = 0.8, specular = 0.7, shininess = 18.0, reflection = 0.15 }
[[bodies]]
name = 'mirror'
shape = 'sphere'
radius = 0.8
position = [1.0, 0.8, -0.6]
material = { color = [0.2, 0.3, 0.2], diffuse = 0.3, specular = 0.5, shininess = 40.0, reflection = 0.7 }
[[bodies]]
shape = 'sphere'
radius = 0.4
position = [0.2, 0.4, 1.5]
material = { color = [0.1, 0.3, 0.9], diffuse = 0.9, specular = 0.6, shininess = 10.0, reflection = 0.0 }
"##;

const GLASS: &str = r##"format = 'catoptric/1'
camera = { position = [-1.0, 2.2, 5.5], target = [0.0, 0.7, 0.0], fov = 40.0 }
environment = { background = [0.25, 0.4, 0.6], ambient = [0.8, 0.85, 1.0] }
lights = [{ position = [-3.0, 7.0, 3.0], intensity = 1.0 }]
[[bodies]]
shape = 'plane'
material = { color = [0.7, 0.7, 0.65], ambient = 0.15, diffuse = 0.7, reflection = 0.0, checker = { color = [0.2, 0.2, 0.5], size = 0.9 } }
[[bodies]]
name = 'glass'
shape = 'sphere'
radius = 0.9
position = [-0.9, 0.95, 0.9]
material = { color = [0.1, 0.1, 0.1], ambient = 0.1, diffuse = 0.1, specular = 0.6, shininess = 25.0, reflection = 0.15, transmission = 0.85, ior = 1.5 }
[[bodies]]
name = 'egg'
shape = 'sphere'
position = [1.3, 0.6, 0.3]
rotation = [0.0, 0.0, 30.0]
scale = [1.2, 0.5, 0.8]
material = { color = [0.9, 0.5, 0.1], diffuse = 0.8, specular = 0.5, shininess = 20.0, reflection = 0.1 }
[[bodies]]
name = 'far'
shape = 'sphere'
radius = 0.8
position = [0.3, 0.8, -2.2]
material = { color = [0.2, 0.8, 0.3], diffuse = 0.6, specular = 0.5, shininess = 15.0, reflection = 0.35 }
"##;

const BRIGHT: &str = r##"format = 'catoptric/1'
camera = { position = [0.0, 1.4, 7.0], target = [0.2, 1.0, 0.0], fov = 33.0 }
environment = { background = [0.05, 0.05, 0.08], ambient = [1.0, 1.0, 1.0] }
lights = [
    { position = [-5.0, 5.0, 6.0], intensity = 1.1 },
    { position = [3.0, 7.0, 5.0], intensity = 0.9, color = [1.0, 0.8, 0.6] },
]
[[bodies]]
shape = 'plane'
material = { color = [0.9, 0.9, 0.9], diffuse = 0.8, specular = 0.2, shininess = 30.0, reflection = 0.4 }
[[bodies]]
name = 'wall'
shape = 'plane'
position = [0.0, 0.0, -4.0]
rotation = [90.0, 0.0, 0.0]
material = { color = [0.5, 0.6, 0.9], diffuse = 0.6, reflection = 0.0 }
[[bodies]]
name = 'white'
shape = 'sphere'
position = [-1.1, 1.0, 0.0]
material = { color = [0.95, 0.9, 0.95], diffuse = 0.9, specular = 0.8, shininess = 12.0, reflection = 0.4 }
[[bodies]]
name = 'disc'
shape = 'sphere'
position = [1.3, 1.1, 0.4]
rotation = [20.0, 0.0, -25.0]
scale = [0.5, 1.1, 0.9]
material = { color = [0.6, 0.2, 0.5], diffuse = 0.8, specular = 0.6, shininess = 14.0, reflection = 0.3 }
"##;

/// All bodies, clear ones and lamps that fall off.
const FALLING: &str = r##"format = 'catoptric/1'
camera = { position = [2.5, 3.0, 7.5], target = [0.0, 0.8, 0.0], fov = 36.0 }
environment = { background = [0.35, 0.3, 0.45], ambient = [1.0, 0.9, 0.8] }
tracing = { generations = 4 }
lights = [
    { position = [-3.0, 5.0, 4.0], intensity = 3.5, color = [1.0, 0.8, 0.6], falloff = 'linear' },
    { position = [4.0, 4.0, -1.0], intensity = 2.0, color = [0.6, 0.8, 1.0], falloff = 'linear', falloff_constant = 0.5 },
]
[[bodies]]
shape = 'plane'
material = { color = [0.7, 0.7, 0.65], ambient = 0.2, diffuse = 0.7, reflection = 0.2, checker = { color = [0.3, 0.2, 0.2], size = 1.4 } }
[[bodies]]
name = 'glass'
shape = 'sphere'
radius = 0.8
position = [-1.3, 0.85, 1.6]
material = { color = [0.1, 0.1, 0.1], ambient = 0.1, diffuse = 0.1, specular = 0.6, shininess = 25.0, reflection = 0.2, transmission = 0.8, tint = [0.9, 0.7, 0.8], ior = 1.5 }
[[bodies]]
name = 'block'
shape = 'cube'
size = [0.9, 1.2, 0.7]
position = [1.4, 0.8, 1.0]
rotation = [20.0, 25.0, 10.0]
material = { color = [0.2, 0.4, 0.3], ambient = 0.2, diffuse = 0.4, specular = 0.3, shininess = 30.0, reflection = 0.15, transmission = 0.6, ior = 1.3 }
[[bodies]]
name = 'tilted'
shape = 'cylinder'
radius = 0.45
height = 1.7
position = [1.9, 0.5, -1.7]
rotation = [-25.0, 0.0, 35.0]
scale = [1.0, 1.0, 1.4]
material = { color = [0.9, 0.3, 0.2], ambient = 0.2, diffuse = 0.8, specular = 0.5, shininess = 20.0, reflection = 0.1, checker = { color = [0.9, 0.8, 0.7], size = 0.4 } }
[[bodies]]
name = 'backdrop'
shape = 'plane'
position = [0.0, 0.0, -6.0]
rotation = [-90.0, 0.0, 0.0]
material = { color = [0.5, 0.6, 0.8], ambient = 0.2, diffuse = 0.7, reflection = 0.0 }
[[bodies]]
name = 'hat'
shape = 'cone'
radius = 0.9
height = 1.6
position = [-0.6, 0.01, -1.5]
material = { color = [0.3, 0.8, 0.3], ambient = 0.2, diffuse = 0.7, specular = 0.4, shininess = 16.0, reflection = 0.2 }
[[bodies]]
name = 'bucket'
shape = 'cone'
radius = 0.35
top_radius = 0.6
height = 0.9
position = [0.1, 0.01, 2.4]
material = { color = [0.8, 0.7, 0.2], ambient = 0.2, diffuse = 0.7, specular = 0.4, shininess = 12.0, reflection = 0.1 }
"##;

/// A room of planes, of which some are seen from below, with wide highlights and lamps that fall off.
const ROOM: &str = r##"format = 'catoptric/1'
camera = { position = [0.3, 1.6, 6.0], target = [0.0, 1.3, 0.0], fov = 46.0 }
environment = { background = [0.1, 0.1, 0.3], ambient = [0.9, 1.0, 0.8] }
tracing = { generations = 4 }
lights = [
    { position = [-1.5, 3.2, 3.0], intensity = 9.0, color = [1.0, 0.6, 0.4], falloff = 'inverse-square' },
    { position = [2.2, 2.4, 1.5], intensity = 1.6, color = [0.5, 0.7, 1.0], falloff = 'linear' },
]
[[bodies]]
shape = 'plane'
material = { color = [0.6, 0.6, 0.7], ambient = 0.15, diffuse = 0.7, specular = 0.4, shininess = 6.0, reflection = 0.25, checker = { color = [0.3, 0.25, 0.2], size = 0.8 } }
[[bodies]]
name = 'ceiling'
shape = 'plane'
position = [0.0, 4.0, 0.0]
material = { color = [0.8, 0.8, 0.7], ambient = 0.15, diffuse = 0.7, reflection = 0.0 }
[[bodies]]
name = 'wall'
shape = 'plane'
position = [0.0, 0.0, -3.5]
rotation = [-90.0, 0.0, 0.0]
material = { color = [0.7, 0.5, 0.5], ambient = 0.15, diffuse = 0.8, specular = 0.3, shininess = 4.0, reflection = 0.1, checker = { color = [0.4, 0.5, 0.6], size = 1.1 } }
[[bodies]]
name = 'ball'
shape = 'sphere'
radius = 0.9
position = [-1.1, 0.92, 0.4]
material = { color = [0.9, 0.4, 0.2], ambient = 0.2, diffuse = 0.6, specular = 0.9, shininess = 3.0, reflection = 0.3 }
[[bodies]]
name = 'drum'
shape = 'cylinder'
radius = 0.6
height = 1.3
position = [1.2, 0.02, -0.4]
material = { color = [0.3, 0.5, 0.9], ambient = 0.2, diffuse = 0.6, specular = 0.8, shininess = 4.0, reflection = 0.2 }
[[bodies]]
name = 'cone'
shape = 'cone'
radius = 0.5
height = 1.1
position = [0.3, 0.02, 2.0]
material = { color = [0.4, 0.8, 0.4], ambient = 0.2, diffuse = 0.6, specular = 0.8, shininess = 5.0, reflection = 0.2 }
"##;

/// The inside of a large cube, with tinted glass and bright lamps.
const CELLAR: &str = r##"format = 'catoptric/1'
camera = { position = [-1.5, 2.1, 6.0], target = [0.1, 1.2, 0.0], fov = 44.0 }
environment = { background = [0.3, 0.2, 0.1], ambient = [1.0, 0.9, 1.0] }
tracing = { generations = 5 }
lights = [
    { position = [2.5, 3.4, 3.0], intensity = 3.4, color = [0.5, 1.0, 0.7], falloff = 'linear' },
    { position = [-2.4, 3.0, 2.0], intensity = 11.0, color = [1.0, 0.6, 0.5], falloff = 'inverse-square' },
]
[[bodies]]
name = 'walls'
shape = 'cube'
size = [9.0, 4.4, 14.0]
position = [0.0, 2.2, 1.0]
material = { color = [0.7, 0.7, 0.6], ambient = 0.15, diffuse = 0.8, specular = 0.3, shininess = 5.0, reflection = 0.15, checker = { color = [0.3, 0.3, 0.45], size = 1.3, position = [0.17, 0.23, 0.31] } }
[[bodies]]
name = 'tinted'
shape = 'sphere'
radius = 0.9
position = [-1.0, 1.0, 1.4]
material = { color = [0.1, 0.1, 0.1], ambient = 0.1, diffuse = 0.2, specular = 0.7, shininess = 8.0, reflection = 0.2, transmission = 0.8, tint = [0.6, 0.9, 1.0], ior = 1.45 }
[[bodies]]
name = 'white'
shape = 'sphere'
radius = 0.8
scale = [1.3, 0.8, 1.0]
rotation = [0.0, 30.0, 15.0]
position = [1.2, 1.1, -0.4]
material = { color = [1.0, 0.9, 0.5], ambient = 0.3, diffuse = 0.9, specular = 0.9, shininess = 3.0, reflection = 0.5 }
[[bodies]]
name = 'pillar'
shape = 'cylinder'
radius = 0.35
height = 1.6
position = [0.4, 0.02, 2.2]
material = { color = [0.9, 0.5, 0.8], ambient = 0.2, diffuse = 0.7, specular = 0.8, shininess = 4.0, reflection = 0.2 }
[[bodies]]
name = 'glass block'
shape = 'cube'
size = [0.8, 0.9, 0.6]
position = [1.6, 0.5, 2.4]
rotation = [0.0, 35.0, 0.0]
material = { color = [0.2, 0.2, 0.1], ambient = 0.1, diffuse = 0.2, specular = 0.4, shininess = 12.0, reflection = 0.2, transmission = 0.7, tint = [1.0, 0.7, 0.7], ior = 1.35 }
"##;

/// A lamp behind bodies of wide highlights, and glass that is weighed by the angle.
const BACKLIT: &str = r##"format = 'catoptric/1'
camera = { position = [0.4, 1.5, 6.0], target = [0.1, 0.9, 0.0], fov = 36.0 }
environment = { background = [0.3, 0.35, 0.5], ambient = [0.8, 0.8, 0.9] }
tracing = { generations = 4 }
lights = [
    { position = [0.8, 3.5, -6.0], intensity = 0.9, color = [1.0, 0.9, 0.7] },
    { position = [-5.0, 4.0, 2.0], intensity = 0.3 },
]
[[bodies]]
shape = 'plane'
material = { color = [0.5, 0.6, 0.5], ambient = 0.15, diffuse = 0.7, reflection = 0.1, checker = { color = [0.7, 0.6, 0.5], size = 0.8 } }
[[bodies]]
name = 'glass'
shape = 'sphere'
radius = 0.9
position = [-1.1, 0.95, 0.8]
material = { color = [0.1, 0.1, 0.1], ambient = 0.1, diffuse = 0.1, specular = 0.5, shininess = 20.0, reflection = 0.8, transmission = 0.9, ior = 1.5, fresnel = 'schlick' }
[[bodies]]
name = 'ball'
shape = 'sphere'
position = [1.1, 1.0, -0.2]
material = { color = [0.8, 0.3, 0.3], ambient = 0.2, diffuse = 0.6, specular = 0.9, shininess = 3.0, reflection = 0.1 }
[[bodies]]
name = 'drum'
shape = 'cylinder'
radius = 0.4
height = 1.2
position = [0.3, 0.02, 1.6]
material = { color = [0.3, 0.4, 0.8], ambient = 0.2, diffuse = 0.7, specular = 0.8, shininess = 4.0, reflection = 0.1 }
"##;

fn read_scene(text: &str) -> Scene {
    read(text).into_result().unwrap().value
}

/// The text of a scene of [`scenes`].
pub(crate) fn text_of(scene: usize) -> &'static str {
    [BALLS, GLASS, BRIGHT, FALLING, ROOM, CELLAR, BACKLIT][scene]
}

/// The scenes.
pub(crate) fn scenes() -> Vec<Scene> {
    (0..7).map(|scene| read_scene(text_of(scene))).collect()
}

/// Scenes of all simple bodies: upright, turned and scaled, with a lamp among them.
pub(crate) fn cases() -> Vec<Scene> {
    let all = [
        include_str!("cases/mirrors.toml"),
        include_str!("cases/transforms.toml"),
        include_str!("cases/low-lamp.toml"),
    ];
    all.map(read_scene).into()
}
