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

/// The scenes.
pub(super) fn scenes() -> Vec<Scene> {
    [BALLS, GLASS, BRIGHT].map(|text| read(text).into_result().unwrap().value).into()
}
