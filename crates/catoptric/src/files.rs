//! The files of a command: what it reads is never written over, however it is named.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::time::Instant;
use std::{fmt, fs};

use anyhow::{Context as _, Result, anyhow, bail};
use catoptric_picture::{Picture, SampleDepth, SaveOptions};
use catoptric_platform::files::{
    FileId, WriteError, check_directory, check_writable, directory_of_file, is_terminal,
};
use catoptric_scene::Scene;
use catoptric_store::file_of_image;

use crate::interrupt;
use crate::output::milliseconds;

/// The files that a command reads and writes.
#[derive(Debug, Default)]
pub(crate) struct CommandFiles {
    inputs: Vec<KnownFile>,
    outputs: Vec<KnownFile>,
    /// Directories that are made when the first file is written into them.
    directories: Vec<PathBuf>,
}

/// A file by its name, and by what it is.
#[derive(Debug)]
struct KnownFile {
    path: PathBuf,
    id: FileId,
}

/// Standard output goes to this file, which the command reads: nothing may be printed.
#[derive(Debug)]
pub(crate) struct OutputIsInput(PathBuf);

impl fmt::Display for OutputIsInput {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.0.display();
        write!(
            out,
            "standard output goes to {path}, which the same command reads; redirect it to another file"
        )
    }
}

impl std::error::Error for OutputIsInput {}

impl CommandFiles {
    /// Adds a file that the command reads, which may be the name of a built-in scene as well.
    ///
    /// # Errors
    /// If the command writes that file too, or its standard output goes there.
    pub(crate) fn add_input(&mut self, path: &Path) -> Result<()> {
        let Some(id) = FileId::of_input(path) else { return Ok(()) };
        if let Some(output) = self.outputs.iter().find(|output| output.id == id) {
            return Err(written_over(&output.path, path));
        }
        if FileId::of_output(Path::new("-")).is_some_and(|output| output == id) {
            return Err(OutputIsInput(path.to_owned()).into());
        }
        self.inputs.push(KnownFile { path: path.to_owned(), id });
        Ok(())
    }

    /// Adds the pictures of a scene that was read from the file at `path`.
    ///
    /// # Errors
    /// Those of [`Self::add_input`].
    pub(crate) fn add_pictures(&mut self, scene: &Scene, path: &Path) -> Result<()> {
        let folder = directory_of_file(path);
        let mut known = HashSet::new();
        for image in scene.images() {
            // Very many bodies may share one.
            if known.insert(image.path())
                && let Some(file) = file_of_image(image, folder)
            {
                self.add_input(&file)?;
            }
        }
        Ok(())
    }

    /// Adds a file that the command will write, and asks, before the work begins, whether it can be written.
    ///
    /// # Errors
    /// If it cannot, or if the command reads this file or writes another output there.
    pub(crate) fn add_output(&mut self, path: &Path) -> Result<()> {
        if let Some(id) = FileId::of_output(path) {
            if self.outputs.iter().any(|output| output.path == path) {
                return Err(written_twice(path, path));
            }
            self.check_free(path)?;
            self.outputs.push(KnownFile { path: path.to_owned(), id });
        }
        Ok(interrupt::undisturbed(|| check_writable(path))?)
    }

    /// Adds a picture that the command will write; see [`Self::add_output`].
    ///
    /// # Errors
    /// Those of [`Self::add_output`], and a terminal as the target, which would take the bytes for text and commands.
    pub(crate) fn add_picture_output(&mut self, path: &Path) -> Result<()> {
        if is_terminal(path) {
            bail!(
                "a terminal cannot show the bytes of a picture; give a file with -o, or redirect the output"
            );
        }
        self.add_output(path)
    }

    /// Adds a directory that files of these names, and perhaps others, are written into, and asks whether they can be.
    /// It is made when the first of them is written.
    ///
    /// # Errors
    /// If they cannot, or if the command reads one of them or writes another output there.
    pub(crate) fn add_directory(
        &mut self,
        directory: &Path,
        names: impl IntoIterator<Item = String>,
    ) -> Result<()> {
        let is_possible = interrupt::undisturbed(|| check_directory(directory));
        is_possible.with_context(|| format!("cannot make the directory {}", directory.display()))?;
        for name in names {
            let path = directory.join(name);
            self.check_free(&path)?;
            // Inputs that are only known later, such as the pictures of the scene, are compared with it too.
            if let Some(id) = FileId::of_output(&path) {
                self.outputs.push(KnownFile { path, id });
            }
        }
        self.directories.push(directory.to_owned());
        Ok(())
    }

    /// Writes a file, whole or not at all.
    ///
    /// # Errors
    /// If it cannot be written, or if the command has read it.
    pub(crate) fn write(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        self.write_by(path, || catoptric_platform::files::write_bytes(path, bytes))
    }

    /// Writes a picture, whole or not at all; returns the milliseconds spent on developing and on writing it.
    ///
    /// # Errors
    /// Those of [`Self::write`], and too little memory to develop the picture.
    pub(crate) fn write_picture(
        &self,
        path: &Path,
        options: &SaveOptions,
        picture: &Picture,
    ) -> Result<(f64, f64)> {
        options.check_size(picture.width(), picture.height())?;
        let start = Instant::now();
        let prepared = options.prepare(picture)?;
        let develop = if options.depth() == SampleDepth::Linear { 0.0 } else { milliseconds(start) };
        let start = Instant::now();
        self.write_by(path, || prepared.write(path))?;
        Ok((develop, milliseconds(start)))
    }

    /// Has `write` write the file, and the directory made if it is one of those that are.
    fn write_by(&self, path: &Path, write: impl FnOnce() -> Result<(), WriteError>) -> Result<()> {
        // What only the work has told, such as the number of a layer, is not known before.
        self.check_free(path)?;
        let directory = path.parent().filter(|parent| self.directories.iter().any(|made| made == parent));
        let made_and_written = || {
            // Together, so that no empty directory stays behind.
            if let Some(directory) = directory {
                fs::create_dir_all(directory)
                    .map_err(|source| WriteError::Io { path: path.to_owned(), source })?;
            }
            write()
        };
        Ok(interrupt::while_writing(path, made_and_written)?)
    }

    /// Refuses a file that the command reads, or that is another one of its outputs.
    fn check_free(&self, path: &Path) -> Result<()> {
        let Some(id) = FileId::of_output(path) else { return Ok(()) };
        if let Some(input) = self.inputs.iter().find(|input| input.id == id) {
            return Err(written_over(path, &input.path));
        }
        match self.outputs.iter().find(|output| output.id == id && output.path != path) {
            Some(other) => Err(written_twice(path, &other.path)),
            None => Ok(()),
        }
    }
}

fn written_over(output: &Path, input: &Path) -> anyhow::Error {
    anyhow!(
        "cannot write {}: the same command uses this file{}; give another name",
        output.display(),
        also_called(output, input)
    )
}

fn written_twice(output: &Path, other: &Path) -> anyhow::Error {
    anyhow!(
        "cannot write {}: the same command writes something else there{}; give another name",
        output.display(),
        also_called(output, other)
    )
}

/// The other name of the file, if it has one.
fn also_called(path: &Path, other: &Path) -> String {
    if path == other { String::new() } else { format!(", as {}", other.display()) }
}
