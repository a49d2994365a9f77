//! `catoptric convert`

use anyhow::{Result, bail};
use catoptric_picture::read;
use catoptric_scene::{HasImages as _, Image, write};

use super::Outcome;
use crate::arguments::ConvertArguments;
use crate::input;
use crate::output::{Kind, check_output, write_picture, write_text};

pub(crate) fn run(arguments: &ConvertArguments) -> Result<Outcome> {
    let ConvertArguments { from, to, development } = arguments;
    match (Kind::of(from), Kind::of(to)) {
        (Some(Kind::Scene), Some(Kind::Scene)) => {
            check_output(to, &[from])?;
            let input = input::file(from)?;
            input.warn();
            let mut scene = input.loaded.scene;
            scene.edit_images(&mut |image| {
                if let Some(path) = Image::moved_path(image.path(), from.parent(), to.parent()) {
                    *image = image.with_path(path);
                }
            });
            write_text(to, &write(&scene))?;
        }
        (Some(Kind::Scene), Some(Kind::Picture(_))) => {
            bail!("{} is a scene: `catoptric render` makes a picture of it", from.display())
        }
        (_, Some(Kind::Picture(kind))) => {
            check_output(to, &[from])?;
            write_picture(to, kind, &read(from)?, development)?;
        }
        (_, Some(Kind::Scene)) => bail!(
            "cannot make a scene of {}: only a file that ends in .toml is one; `catoptric examples` writes the \
             built-in scenes",
            from.display()
        ),
        (_, None) => {
            bail!("cannot tell the format of {}: give a name that ends in .png, .exr or .toml", to.display())
        }
    }
    Ok(Outcome::Done)
}
