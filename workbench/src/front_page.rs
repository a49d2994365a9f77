//! The front page of the laboratory in a browser: what it is, and all built-in scenes with their pictures.

mod images;
mod page;
mod words;

use std::fs;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use catoptric_platform::files::write_bytes;
use catoptric_scene::{Example, Language};
use clap::Args;
use xtask::root;

use images::{CARD, FIRST, FIRST_SCENE};

#[derive(Debug, Args)]
pub(crate) struct FrontPageArguments {
    /// Where to write it, beside the studio; target/web by default
    #[arg(value_name = "DIR")]
    directory: Option<PathBuf>,
    /// Samples per pixel
    #[arg(long, default_value_t = 64)]
    samples: u32,
}

pub(crate) fn run(arguments: &FrontPageArguments) -> Result<()> {
    let directory = arguments.directory.clone().unwrap_or_else(|| root().join("target/web"));
    let pictures = directory.join("pictures");
    fs::create_dir_all(&pictures).with_context(|| pictures.display().to_string())?;
    for (file, html) in Language::ALL.map(page::page) {
        write_bytes(&directory.join(file), html.as_bytes())?;
    }
    write_bytes(&directory.join(page::STYLE.0), page::STYLE.1.as_bytes())?;
    write_bytes(&directory.join("examples.js"), page::examples_script().as_bytes())?;
    fs::copy(root().join("crates/web/page/icon.png"), directory.join("icon.png"))?;
    for example in Example::ALL {
        println!("{}", example.name);
        let file = pictures.join(format!("{}.jpg", example.name));
        write_bytes(&file, &CARD.of(example, arguments.samples)?)?;
    }
    let first = Example::find(FIRST_SCENE).context("the scene of the large picture")?;
    write_bytes(&pictures.join("first.jpg"), &FIRST.of(first, arguments.samples)?)?;
    println!("{}", directory.display());
    Ok(())
}
