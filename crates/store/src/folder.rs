//! The pictures of a scene in the files of a folder.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, Weak};

use catoptric_picture::Picture;
use catoptric_platform::files::{self, FileStamp};
use catoptric_scene::{ImageFault, ImageSource, Resources, UnreadableKind};

use crate::image_path::file_of;

/// Pictures in files, whose relative paths begin at a folder.
#[derive(Clone, Copy, Debug)]
pub struct Folder<'a>(Option<&'a Path>);

impl<'a> Folder<'a> {
    /// Paths begin at `folder`, that of a scene file, or without one where the program was started.
    pub fn new(folder: Option<&'a Path>) -> Self {
        Self(folder)
    }

    /// Paths begin where the program was started.
    pub fn current() -> Self {
        Self(None)
    }
}

impl Resources for Folder<'_> {
    fn picture(&self, source: &ImageSource) -> Result<Arc<Picture>, ImageFault> {
        read_or_share(&file_of(source.path(), self.0), source)
    }
}

/// The state of a file when it was read, and its content, while that is in use.
type CachedFile = (FileStamp, Weak<Picture>);

/// A file and the layer that is read of it.
type FileLayer = (PathBuf, Option<String>);

static KEPT: LazyLock<Mutex<HashMap<FileLayer, CachedFile>>> = LazyLock::new(Mutex::default);

fn read_or_share(file: &Path, source: &ImageSource) -> Result<Arc<Picture>, ImageFault> {
    let status = files::status(file).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => ImageFault::Missing(file.display().to_string()),
        _ => ImageFault::Unreadable { reason: error.to_string(), kind: UnreadableKind::Other },
    })?;
    if !status.is_file {
        // Opening a pipe would wait, in the studio too, until someone writes into it.
        return Err(ImageFault::NotAFile);
    }
    let stamp = FileStamp::from(status);
    let layer = source.layer().map(str::to_owned);
    let name = (files::canonical(file).unwrap_or_else(|_| file.to_owned()), layer);
    let shared = {
        let kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        kept.get(&name).filter(|kept| kept.0 == stamp).and_then(|kept| kept.1.upgrade())
    };
    if let Some(shared) = shared {
        return Ok(shared);
    }
    let picture = source.pixels_from(|options| options.read(file))?;
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    kept.retain(|_, (_, picture)| picture.strong_count() > 0);
    kept.insert(name, (stamp, Arc::downgrade(&picture)));
    Ok(picture)
}
