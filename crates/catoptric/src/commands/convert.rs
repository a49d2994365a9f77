//! `catoptric convert`

use anyhow::{Result, bail};
use catoptric_picture::{check_writable, read};
use catoptric_scene::{load, save, write};

use super::Outcome;
use crate::arguments::ConvertArguments;
use crate::output::{Kind, write_picture};

pub(crate) fn run(arguments: &ConvertArguments) -> Result<Outcome> {
    let ConvertArguments { from, to, development } = arguments;
    check_writable(to)?;
    match (Kind::of(from), Kind::of(to)) {
        (Some(Kind::Scene), Some(Kind::Scene)) => save(to, &write(&load(from)?.scene))?,
        (Some(Kind::Scene), Some(Kind::Png | Kind::Exr)) => {
            bail!("{} is a scene: `catoptric render` makes a picture of it", from.display())
        }
        (_, Some(Kind::Png | Kind::Exr)) => {
            write_picture(to, Kind::of_picture(to)?, &read(from)?, development)?;
        }
        (_, Some(Kind::Scene)) => bail!("{} is no scene file (.toml)", from.display()),
        (_, None) => {
            bail!("cannot tell the format of {}: give a name that ends in .png, .exr or .toml", to.display())
        }
    }
    Ok(Outcome::Done)
}
