//! Cube maps that outlive a picture.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use catoptric_platform::time::{Duration, Instant};

use crate::geometry::body::RenderBody;
use crate::raster::cube_map::CubeMap;
use crate::raster::cube_map::proxy::center_of;
use crate::raster::error::{MOST_CUBE_MAP_BYTES, MethodError};
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::environment::EnvironmentLight;
use crate::transport::light::RenderLight;
use crate::transport::scene::RenderScene;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::texture::solid::SolidNode;

/// The cube maps of reflecting bodies, kept from picture to picture as long as nothing that they show has changed.
///
/// A map shows everything but its own body. So an edit of that body leaves its map as it is, unless it moves the body's
/// middle, and any other edit makes it anew. The camera does not matter.
#[derive(Debug, Default)]
pub struct CubeMaps {
    shown: Option<CubeMapInputs>,
    /// By the places of their bodies in the scene.
    maps: BTreeMap<usize, CubeMapBuild>,
}

/// A map, and what it took.
#[derive(Debug)]
struct CubeMapBuild {
    map: Arc<CubeMap>,
    time: Duration,
}

/// How many cube maps served a picture, and what they took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CubeMapUse {
    /// Maps that were rendered for this picture.
    pub built: u32,
    /// Maps that were there already.
    pub kept: u32,
    /// The time that all of them took when they were rendered; what this picture spent is in its passes.
    pub build_time: Duration,
    /// The memory of all of them.
    pub bytes: u64,
}

impl CubeMaps {
    /// The most memory that the maps of a picture may take, bytes: 2 GiB.
    pub const MOST_BYTES: u64 = MOST_CUBE_MAP_BYTES;

    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes sure that there are maps of these bodies of the scene, with faces of `size`² pixels. Returns the rays that it
    /// took.
    pub(crate) fn prepare(
        &mut self,
        scene: &RenderScene,
        bodies: &BTreeSet<u32>,
        size: u32,
        control: &RenderControl,
    ) -> Result<(CubeMapUse, RayCounts), MethodError> {
        let bytes = bodies.len() as u64 * CubeMap::bytes_of(size) as u64;
        if bytes > Self::MOST_BYTES {
            return Err(MethodError::TooManyCubeMaps { bodies: bodies.len(), size, bytes });
        }
        if bodies.is_empty() {
            return Ok(<(CubeMapUse, RayCounts)>::default());
        }
        self.drop_outdated(scene, bodies, size);
        let (mut made_use, mut counts) =
            (CubeMapUse { bytes, ..CubeMapUse::default() }, RayCounts::default());
        let missing =
            |index: &&u32| scene.number(**index).is_some_and(|place| !self.maps.contains_key(&place));
        let missing: Vec<u32> = bodies.iter().filter(missing).copied().collect();
        control.expect(missing.len() as u64 * CubeMap::pixels_of(size) as u64);
        for &index in &missing {
            let start = Instant::now();
            let (map, rays) = render_around(scene, index, size, control)?;
            counts += rays;
            if let Some(place) = scene.number(index) {
                self.maps.insert(place, CubeMapBuild { map: Arc::new(map), time: start.elapsed() });
            }
        }
        made_use.built = missing.len() as u32;
        made_use.kept = (bodies.len() - missing.len()) as u32;
        let used = bodies.iter().filter_map(|&index| self.maps.get(&scene.number(index)?));
        made_use.build_time = used.map(|made| made.time).sum();
        Ok((made_use, counts))
    }

    /// The map of the body of this [number](RenderScene::number), if there is one.
    pub(crate) fn get(&self, number: usize) -> Option<&Arc<CubeMap>> {
        self.maps.get(&number).map(|made| &made.map)
    }

    /// Drops the maps that show what has changed; and those that are not needed now, if all would take too much memory.
    fn drop_outdated(&mut self, scene: &RenderScene, needed: &BTreeSet<u32>, size: u32) {
        let shown = CubeMapInputs::of(scene);
        let changes =
            self.shown.as_ref().map_or(CubeMapInvalidation::Everything, |before| before.changes(&shown));
        self.shown = Some(shown);
        let needed: BTreeMap<usize, u32> =
            needed.iter().filter_map(|&index| Some((scene.number(index)?, index))).collect();
        let is_much =
            (self.maps.len() + needed.len()) as u64 * CubeMap::bytes_of(size) as u64 > Self::MOST_BYTES;
        self.maps.retain(|place, made| {
            let is_in_place = |&index: &u32| center_of(scene, index) == made.map.center();
            let stays = match needed.get(place) {
                Some(index) => is_in_place(index),
                // Of bodies that are not seen only an unchanged scene tells that they are in place.
                None => !is_much && changes.is_nothing(),
            };
            stays && made.map.size() == size && changes.spare(*place)
        });
    }
}

/// Renders the map of a body.
fn render_around(
    scene: &RenderScene,
    index: u32,
    size: u32,
    control: &RenderControl,
) -> Result<(CubeMap, RayCounts), MethodError> {
    CubeMap::render(&around(scene, index), center_of(scene, index), size, control)
}

/// What the map of a body shows: the scene without it. The first rays of a map are the second generation of a picture.
pub(crate) fn around(scene: &RenderScene, index: u32) -> RenderScene {
    scene.without(index).with_generations(scene.generations.saturating_sub(1))
}

/// All that maps can show.
#[derive(Debug)]
struct CubeMapInputs {
    /// By their places in the scene.
    bodies: BTreeMap<u32, (RenderBody, RenderMaterial, Vec<SolidNode>)>,
    lights: Arc<[RenderLight]>,
    /// Background and ambient light, then the limits of tracing.
    surroundings: (EnvironmentLight, [f32; 3], u32, f32),
}

/// What changed from one scene to another.
enum CubeMapInvalidation {
    Everything,
    /// The bodies at these places in the scene.
    Bodies(BTreeSet<u32>),
}

impl CubeMapInputs {
    fn of(scene: &RenderScene) -> Self {
        let body = |(body, place): (&RenderBody, &u32)| {
            let solids = SolidNode::row_at(&scene.solids, body.solid).to_vec();
            // Numbers of materials mean nothing from scene to scene.
            let plain = RenderBody { material: 0, solid: 0, ..*body };
            (*place, (plain, scene.material(body).clone(), solids))
        };
        Self {
            bodies: scene.geometry.bodies.iter().zip(&scene.geometry.numbers).map(body).collect(),
            lights: Arc::clone(&scene.lights),
            surroundings: (scene.sky.clone(), scene.ambient, scene.generations, scene.threshold),
        }
    }

    fn changes(&self, after: &Self) -> CubeMapInvalidation {
        if self.lights != after.lights || self.surroundings != after.surroundings {
            return CubeMapInvalidation::Everything;
        }
        let places = self.bodies.keys().chain(after.bodies.keys());
        CubeMapInvalidation::Bodies(
            places.filter(|place| self.bodies.get(place) != after.bodies.get(place)).copied().collect(),
        )
    }
}

impl CubeMapInvalidation {
    fn is_nothing(&self) -> bool {
        matches!(self, Self::Bodies(bodies) if bodies.is_empty())
    }

    /// Whether the map of the body at this place still is what it was.
    fn spare(&self, place: usize) -> bool {
        match self {
            Self::Everything => false,
            Self::Bodies(bodies) => bodies.iter().all(|&changed| changed as usize == place),
        }
    }
}
