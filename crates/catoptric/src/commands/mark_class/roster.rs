//! The pictures of a class and their scenes: from a folder, or from a table.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, anyhow, bail};
use catoptric_exchange::ForeignFormat;
use catoptric_lab::marking::{ClassFolder, ClassTable, Submission, file_names};
use catoptric_picture::PictureFormat;
use catoptric_scene::{Example, decode};
use catoptric_store::{LoadError, read_file};

use crate::arguments::CompareArguments;
use crate::console::{color_on, say_colored};
use crate::files::CommandFiles;

/// A scene of the class.
pub(super) struct ClassScene {
    /// What it is called: its file without folder and extension.
    pub name: String,
    /// Its file, or the name of a built-in scene.
    pub path: PathBuf,
}

/// What there is to be marked.
pub(super) struct Roster {
    /// From where the paths of pictures start.
    pub folder: PathBuf,
    pub scenes: Vec<ClassScene>,
    /// The pictures, those of a student together.
    pub submissions: Vec<Submission>,
    /// Pictures that belong to no scene.
    pub left_over: Vec<String>,
}

impl Roster {
    /// Folders within each other that are looked into.
    const MOST_FOLDERS: usize = 8;
    /// Files of a folder that are looked at.
    const MOST_FILES: usize = 100_000;

    /// Finds out which pictures there are at `class`; what lies in `output` is none of them.
    pub(super) fn read(
        class: &Path,
        arguments: &CompareArguments,
        output: &Path,
        files: &mut CommandFiles,
    ) -> Result<Self> {
        if class.is_dir() {
            return Self::of_folder(class, arguments, output);
        }
        if arguments.scene.is_some() || !arguments.scenes.is_empty() {
            bail!("{} is a table, which names the scenes itself", class.display());
        }
        Self::of_table(class, arguments, files)
    }

    /// The students' names, fit for files, each once.
    pub(super) fn students(&self) -> Vec<String> {
        let mut names: Vec<&str> = self.submissions.iter().map(|own| own.student.as_str()).collect();
        names.dedup();
        file_names(names)
    }

    fn of_folder(class: &Path, arguments: &CompareArguments, output: &Path) -> Result<Self> {
        let listed = [arguments.scene.as_slice(), &arguments.scenes].concat();
        let scenes = match listed.as_slice() {
            [] => scene_files(class)?,
            listed => listed_scenes(listed)?,
        };
        if scenes.is_empty() {
            bail!("{} has no scene file in it; name the scenes with --scenes", class.display());
        }
        if let Some([one, other]) = same_names(&scenes) {
            bail!(
                "{} and {} have the same name, by which pictures are found; name one of them with --scenes",
                one.path.display(),
                other.path.display()
            );
        }
        let beside = listed.iter().filter(|path| path.is_dir()).cloned().chain([output.to_owned()]);
        let beside: Vec<PathBuf> = beside.filter_map(|path| path.canonicalize().ok()).collect();
        let mut walk = FolderWalk { beside, students: Vec::new(), pictures: Vec::new(), seen: 0 };
        walk.enter(class, "", 0).with_context(|| format!("cannot read {}", class.display()))?;
        let names: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
        let folder = class.canonicalize().unwrap_or_else(|_| class.to_owned());
        let folder = folder.file_name().unwrap_or(class.as_os_str()).to_string_lossy();
        let ClassFolder { submissions, left_over } =
            ClassFolder::new(&folder, &walk.students, &walk.pictures, &names);
        if submissions.is_empty() {
            bail!("{} has neither folders nor pictures of students in it", class.display());
        }
        Ok(Self { folder: class.to_owned(), scenes, submissions, left_over })
    }

    fn of_table(path: &Path, arguments: &CompareArguments, files: &mut CommandFiles) -> Result<Self> {
        let text = read_text(path, files)?;
        let table = match ClassTable::read(&text) {
            Ok(table) => table,
            Err(diagnostics) => {
                return Err(LoadError::Diagnostics { path: path.to_owned(), text, diagnostics }.into());
            }
        };
        if !arguments.quiet && !table.warnings.is_empty() {
            let name = path.display().to_string();
            say_colored(&table.warnings.render(&name, &text, color_on(&std::io::stderr())));
        }
        if table.submissions.is_empty() {
            bail!("{} has no rows", path.display());
        }
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let mut scenes: Vec<ClassScene> = Vec::new();
        let mut submissions = table.submissions;
        let mut listed: Vec<String> = Vec::new();
        for submission in &submissions {
            if !listed.contains(&submission.scene) {
                listed.push(submission.scene.clone());
                let beside = folder.join(&submission.scene);
                let is_built_in = Example::find(&submission.scene).is_some() && !beside.exists();
                let path = if is_built_in { PathBuf::from(&submission.scene) } else { beside };
                scenes.push(ClassScene { name: stem(&path), path });
            }
        }
        // Scenes of one name keep the paths that the table has.
        if same_names(&scenes).is_some() {
            scenes.iter_mut().zip(&listed).for_each(|(scene, listed)| scene.name.clone_from(listed));
        }
        for submission in &mut submissions {
            let at = listed.iter().position(|listed| *listed == submission.scene);
            if let Some(scene) = at.and_then(|at| scenes.get(at)) {
                submission.scene.clone_from(&scene.name);
            }
        }
        Ok(Self { folder, scenes, submissions, left_over: Vec::new() })
    }
}

/// The text of a file.
pub(super) fn read_text(path: &Path, files: &mut CommandFiles) -> Result<String> {
    const LONGEST: usize = 1 << 24;
    files.add_input(path)?;
    decode(read_file(path, LONGEST)?).map_err(|(diagnostics, text)| {
        LoadError::Diagnostics { path: path.to_owned(), text, diagnostics }.into()
    })
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn is_scene(path: &Path) -> bool {
    let is_own = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    (is_own || ForeignFormat::of_path(path).is_some()) && path.is_file()
}

/// The scene files of a folder, by their names.
fn scene_files(folder: &Path) -> Result<Vec<ClassScene>> {
    let entries = fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| is_scene(path));
    paths.sort();
    Ok(paths.into_iter().map(|path| ClassScene { name: stem(&path), path }).collect())
}

/// The scenes that are named: files, folders of them, or built-in ones.
fn listed_scenes(listed: &[PathBuf]) -> Result<Vec<ClassScene>> {
    let mut scenes = Vec::new();
    for path in listed {
        let is_built_in = path.to_str().and_then(Example::find).is_some();
        if path.is_dir() && !is_built_in {
            let own = scene_files(path)?;
            if own.is_empty() {
                return Err(anyhow!("{} has no scene file in it", path.display()));
            }
            scenes.extend(own);
        } else {
            scenes.push(ClassScene { name: stem(path), path: path.clone() });
        }
    }
    Ok(scenes)
}

/// Two scenes of one name, whatever the case of its letters.
fn same_names(scenes: &[ClassScene]) -> Option<[&ClassScene; 2]> {
    let lower = |scene: &ClassScene| scene.name.to_lowercase();
    scenes.iter().enumerate().find_map(|(at, one)| {
        let other = scenes.iter().skip(at + 1).find(|other| lower(other) == lower(one))?;
        Some([one, other])
    })
}

/// Collects what lies in the folder of a class.
struct FolderWalk {
    /// Folders that do not belong to it.
    beside: Vec<PathBuf>,
    students: Vec<String>,
    pictures: Vec<String>,
    seen: usize,
}

impl FolderWalk {
    fn enter(&mut self, folder: &Path, name: &str, depth: usize) -> std::io::Result<()> {
        let mut entries: Vec<fs::DirEntry> = fs::read_dir(folder)?.collect::<Result<_, _>>()?;
        entries.sort_by_key(fs::DirEntry::file_name);
        for entry in entries {
            let path = entry.path();
            let own = entry.file_name().to_string_lossy().into_owned();
            self.seen += 1;
            // Of archives from a Mac, and what is hidden.
            if own.starts_with('.') || own == "__MACOSX" || self.seen > Roster::MOST_FILES {
                continue;
            }
            let inner = if name.is_empty() { own.clone() } else { format!("{name}/{own}") };
            // Links to folders may lead anywhere, in circles, too.
            if entry.file_type()?.is_dir() {
                let is_beside = path.canonicalize().is_ok_and(|path| self.beside.contains(&path));
                if is_beside || depth >= Roster::MOST_FOLDERS {
                    continue;
                }
                if depth == 0 {
                    self.students.push(own);
                }
                self.enter(&path, &inner, depth + 1)?;
            } else if PictureFormat::of_path(&path).is_some() && path.is_file() {
                self.pictures.push(inner);
            }
        }
        Ok(())
    }
}
