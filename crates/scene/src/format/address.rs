//! Single values of a scene by their address, such as `bodies.ball.position.y`: what can be said of them is what the
//! table of the format says.

mod completion;
mod edit;
mod error;
mod listing;
mod part;
mod path;
mod resolve;
mod value;

pub use completion::AddressCompletion;
pub use edit::SceneEdit;
pub use error::AddressError;
pub use listing::SceneKey;
pub(crate) use part::part_step;
pub use path::ScenePath;
pub use value::SceneValue;

use crate::Scene;
use crate::format::spec::KeySpec;
use crate::part::ScenePart;
use resolve::Address;

impl Scene {
    /// The value at an address, also where it is at its default: one number for three equal factors, linear components
    /// for a color.
    ///
    /// ```
    /// use catoptric_scene::{Scene, SceneValue};
    /// let scene = Scene::default();
    /// assert_eq!(scene.get(&"camera.fov".parse()?)?, SceneValue::Number(27.0));
    /// assert_eq!(scene.get(&"camera.position.z".parse()?)?, SceneValue::Number(8.0));
    /// # Ok::<(), catoptric_scene::AddressError>(())
    /// ```
    ///
    /// # Errors
    /// When there is no such value: the element or key does not exist, the key has no meaning for a choice of its table,
    /// or it is absent without a default.
    pub fn get(&self, path: &ScenePath) -> Result<SceneValue, AddressError> {
        Address::resolve(self, path)
            .and_then(|address| address.value(self))
            .map_err(|found| AddressError::new(path, found))
    }

    /// Sets the value at an address as a scene file would. Only the element is looked at, however many others there
    /// are; their names are where the address or the value is a name.
    ///
    /// - A choice (`shape`, `model`, `projection`, `falloff`) keeps the values that the new word knows too and drops the
    ///   others. Without `base` and `top`, a body stands at the origin.
    /// - A key takes the place of those that it excludes, such as `substance` of `ior` and `abbe`. The reverse is an
    ///   error until the stronger key is [taken away](Self::unset).
    /// - A key of a `sky` or a pattern that is absent makes one.
    /// - A new picture is not opened; [`Self::open_images`] does that.
    ///
    /// ```
    /// let mut scene = catoptric_scene::Scene::default();
    /// scene.set(&"camera.fov".parse()?, 40.0)?;
    /// let refused = scene.set(&"camera.fov".parse()?, 300.0).unwrap_err();
    /// assert!(refused.to_string().starts_with("`fov` is `300`, but must be at most 179.9"));
    /// # Ok::<(), catoptric_scene::AddressError>(())
    /// ```
    ///
    /// # Errors
    /// What a file with this value would be refused for; the scene is as it was then.
    pub fn set(&mut self, path: &ScenePath, value: impl Into<SceneValue>) -> Result<(), AddressError> {
        self.edit(&[SceneEdit { path: path.clone(), value: Some(value.into()) }])
    }

    /// Takes the key at an address away: back to its default, or to nothing for a texture, a sky or a name. Keys that
    /// need it go with it, and of a choice those that its default does not know.
    ///
    /// # Errors
    /// Those of [`Self::set`].
    pub fn unset(&mut self, path: &ScenePath) -> Result<(), AddressError> {
        self.edit(&[SceneEdit { path: path.clone(), value: None }])
    }

    /// Sets several values in their order. Those of one element that follow each other are set together, for some keys
    /// need each other: `base` and `top`, `n` and `k`.
    ///
    /// # Errors
    /// Those of [`Self::set`]; nothing is set then.
    pub fn edit(&mut self, edits: &[SceneEdit]) -> Result<(), AddressError> {
        edit::apply(self, edits)
    }

    /// The key of the format at an address, whether it has a value or not.
    ///
    /// # Errors
    /// When the address leads nowhere.
    pub fn key(&self, path: &ScenePath) -> Result<&'static KeySpec, AddressError> {
        let address = Address::resolve(self, path).map_err(|found| AddressError::new(path, found))?;
        Ok(address.key)
    }

    /// All addresses that have a meaning in the scene as it is, with their present values: camera, environment, tracing,
    /// materials, lights, bodies, each in the order of the format.
    pub fn keys(&self) -> impl Iterator<Item = SceneKey> + '_ {
        listing::keys(self)
    }

    /// What an address that begins with `typed` can become, at most `most` in the order of [`Self::keys`]: whole
    /// addresses if they are not more, else their beginnings up to the next point at which they part. `addresses` tells
    /// which of a key are meant.
    ///
    /// ```
    /// let scene = catoptric_scene::Scene::default();
    /// let found = scene.completions("camera.pos", 20, &|key| vec![key.path.clone()]);
    /// assert_eq!(found[0].text, "camera.position");
    /// ```
    pub fn completions(
        &self,
        typed: &str,
        most: usize,
        addresses: &dyn Fn(&SceneKey) -> Vec<ScenePath>,
    ) -> Vec<AddressCompletion> {
        completion::completions(self, typed, most, addresses)
    }

    /// The addresses of one part, as in [`Self::keys`]; none where there is no such part.
    pub fn keys_of(&self, part: ScenePart) -> Vec<SceneKey> {
        listing::keys_of(self, part, [])
    }

    /// The addresses of a part of a joined body: `places` lead to it, the first among the parts of the whole, each further
    /// one among those of the last. None where there is no such part.
    pub fn keys_of_nested(&self, whole: ScenePart, places: impl IntoIterator<Item = usize>) -> Vec<SceneKey> {
        listing::keys_of(self, whole, places)
    }
}
