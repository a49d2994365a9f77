#![doc = include_str!("../README.md")]

mod folder;
mod image_path;
mod scene_file;

pub use folder::Folder;
pub use image_path::{file_of_image, moved_path, moved_relative_path, path_from};
pub use scene_file::{LoadError, load, load_partly, read_file, save};
