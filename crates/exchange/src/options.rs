//! How scenes are read, and what comes of it.

use catoptric_scene::{Diagnostics, Scene};

use crate::dialect::Dialect;

/// The longest file that is read, bytes: 16 MiB.
pub const LONGEST_FILE: usize = 16 << 20;

/// The size of a picture that neither the file nor the options give, pixels.
pub const DEFAULT_SIZE: [u32; 2] = [1280, 720];

/// How a scene of another program is read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImportOptions {
    /// What miniRT programs do differently. Default what the school's subject says.
    pub dialect: Dialect,
    /// Whether what a scene cannot say is replaced by what comes nearest, or left out, with a warning for each.
    /// Default false: it is an error.
    pub is_approximate: bool,
    /// Width and height of the picture, pixels, instead of those of the file: a horizontal angle of view depends on
    /// them.
    pub size: Option<[u32; 2]>,
}

/// A scene that was read from a file of another program.
#[derive(Clone, Debug)]
pub struct ImportedScene {
    /// The scene.
    pub scene: Scene,
    /// What was interpreted (notes), and what could not be taken over exactly (warnings).
    pub report: Diagnostics,
    /// The size of the picture that the file or the options ask for, pixels.
    pub size: Option<[u32; 2]>,
}
