//! Reading several pictures, of which some may have layers.

use std::path::Path;

use catoptric_picture::{DecodeError, Picture, ReadError, ReadOptions};

/// Reads pictures by one choice of layer: files without named layers are read as they are, but one file must have it.
pub(crate) struct LayerReader {
    options: ReadOptions,
    /// True once a file had the layer.
    has_found: bool,
    /// Why the first file without named layers did not have it.
    missing: Option<ReadError>,
}

impl LayerReader {
    pub(crate) fn new(layer: Option<&str>) -> Self {
        let options = ReadOptions { layer: layer.map(str::to_owned), ..ReadOptions::default() };
        Self { options, has_found: layer.is_none(), missing: None }
    }

    /// Reads a picture.
    pub(crate) fn read(&mut self, path: &Path) -> Result<Picture, ReadError> {
        match self.options.read(path) {
            Err(error) if is_without_layers(&error) && path.is_file() => {
                self.missing.get_or_insert(error);
                catoptric_picture::read(path)
            }
            read => {
                self.has_found |= read.is_ok();
                read
            }
        }
    }

    /// Refuses the choice if no file had the layer.
    pub(crate) fn finish(self) -> Result<(), ReadError> {
        match self.missing {
            Some(error) if !self.has_found => Err(error),
            _ => Ok(()),
        }
    }
}

/// True if the file has no named layers at all.
fn is_without_layers(error: &ReadError) -> bool {
    let ReadError::Decode { source: DecodeError::NoSuchLayer { layers, .. }, .. } = error else {
        return false;
    };
    layers.is_empty()
}
