//! Finding scenes by path or by name.

use std::path::Path;

use anyhow::{Result, bail};
use catoptric_scene::{Example, Loaded, load};

/// A scene as the user named it.
pub(crate) struct Named {
    /// For messages: the path, or the example's name.
    pub name: String,
    pub loaded: Loaded,
}

/// Loads the scene file at the path `name`, or the built-in scene of that name.
///
/// A file wins over a built-in scene, so that nothing of the user's is hidden.
pub(crate) fn scene(name: &str) -> Result<Named> {
    let path = Path::new(name);
    let named = |loaded| Named { name: name.to_owned(), loaded };
    if path.exists() {
        return Ok(named(load(path)?));
    }
    if let Some(example) = Example::find(name) {
        return Ok(named(example.load()?));
    }
    let looks_like_path = path.extension().is_some() || path.components().count() > 1;
    if looks_like_path {
        // The error of reading it says what is wrong with it.
        return Ok(named(load(path)?));
    }
    match Example::nearest(name) {
        Some(near) => {
            bail!("there is no file and no built-in scene \"{name}\"; did you mean \"{}\"?", near.name)
        }
        None => {
            bail!("there is no file and no built-in scene \"{name}\"; `catoptric examples` lists the scenes")
        }
    }
}
