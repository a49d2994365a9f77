//! `catoptric diff`

use std::path::Path;

use anyhow::{Context as _, Result, bail};
use catoptric_picture::{
    CompareError, Comparison, Difference, Flip, HeatMap, Picture, PictureFormat, SaveOptions, heat_map, ssim,
};
use catoptric_platform::files::FileId;
use serde_json::json;

use super::CommandOutcome;
use crate::arguments::DiffArguments;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::layers::LayerReader;
use crate::output::format_for_output;

pub(crate) fn run(arguments: &DiffArguments) -> Result<CommandOutcome> {
    let mut files = CommandFiles::default();
    files.add_input(&arguments.a)?;
    files.add_input(&arguments.b)?;
    if let Some(path) = &arguments.heat {
        check_heat(path)?;
        files.add_picture_output(path)?;
    }
    let mut layers = LayerReader::new(arguments.layer.as_deref());
    let (a, b) = (layers.read(&arguments.a)?, layers.read(&arguments.b)?);
    layers.finish()?;
    let names = || format!("cannot compare {} and {}", arguments.a.display(), arguments.b.display());
    let comparison = Comparison { clamp: !arguments.unclamped, bound: arguments.tolerance };
    let difference = comparison.compare(&a, &b).with_context(names)?;
    if let Some(path) = &arguments.heat {
        let options = HeatMap { clamp: comparison.clamp, ..HeatMap::default() };
        let map = heat_map(&a, &b, &options).with_context(names)?;
        files.write_picture(path, &SaveOptions::new(PictureFormat::Png, None)?, &map)?;
    }
    let perceived = PerceivedDifference::of(&a, &b).with_context(names)?;
    let equal = difference.share_above <= arguments.allow;
    let size = [a.width(), a.height()];
    print(&if arguments.json {
        as_json(&difference, &perceived, arguments, size, equal)
    } else {
        as_text(&difference, &perceived, arguments, size, equal)
    })?;
    Ok(if equal { CommandOutcome::Done } else { CommandOutcome::Failed })
}

/// Refuses a heat map that would not be a PNG, or that would run into the numbers.
fn check_heat(path: &Path) -> Result<()> {
    if !matches!(format_for_output(path, None), Ok(PictureFormat::Png)) {
        bail!("a heat map is a PNG picture: give {} a name that ends in .png", path.display());
    }
    let output = FileId::of_output(path);
    if output.is_some() && output == FileId::of_output(Path::new("-")) {
        bail!("cannot write the heat map to {}: the numbers go there; give another name", path.display());
    }
    Ok(())
}

/// The ꟻLIP difference of two pictures.
struct PerceivedDifference {
    /// `None` when they are too small for it.
    ssim: Option<f64>,
    flip: f64,
}

impl PerceivedDifference {
    fn of(a: &Picture, b: &Picture) -> Result<Self, CompareError> {
        let ssim = match ssim(a, b) {
            Err(CompareError::TooSmall { .. }) => None,
            other => Some(other?),
        };
        Ok(Self { ssim, flip: Flip::default().compare(a, b)?.mean() })
    }
}

fn as_json(
    difference: &Difference,
    perceived: &PerceivedDifference,
    arguments: &DiffArguments,
    size: [u32; 2],
    equal: bool,
) -> String {
    let finite = |value: f64| value.is_finite().then_some(value);
    let value = json!({
        "width": size[0],
        "height": size[1],
        "max": finite(difference.max),
        "mean": finite(difference.mean),
        "rmse": finite(difference.rmse),
        "psnr_db": finite(difference.psnr_db),
        "ssim": perceived.ssim,
        "flip": perceived.flip,
        "tolerance": arguments.tolerance,
        "pixels_above": difference.above,
        "share_above": difference.share_above,
        "share_allowed": arguments.allow,
        "pixels_not_a_number": difference.not_a_number,
        "worst_pixel": difference.worst,
        "equal": equal,
    });
    json_text(&value)
}

fn as_text(
    difference: &Difference,
    perceived: &PerceivedDifference,
    arguments: &DiffArguments,
    size: [u32; 2],
    equal: bool,
) -> String {
    let worst = match difference.worst {
        Some([x, y]) => format!(" at pixel {x},{y}"),
        None => String::new(),
    };
    let not_a_number = match difference.not_a_number {
        0 => String::new(),
        1 => "not a number   1 pixel\n".to_owned(),
        number => format!("not a number   {number} pixels\n"),
    };
    let psnr = match difference.psnr_db {
        psnr if psnr.is_finite() => format!("{psnr:.2} dB"),
        _ if difference.rmse == 0.0 => "infinite".to_owned(),
        _ => "none".to_owned(),
    };
    let ssim =
        perceived.ssim.map_or_else(|| "none, below 11x11 pixels".to_owned(), |ssim| format!("{ssim:.6}"));
    format!(
        "largest        {:.6}{worst}\nmean           {:.6}\nRMSE           {:.6}\nPSNR           {psnr}\n\
         SSIM           {ssim}\nFLIP           {:.6}\n\
         above {:.5}  {} of {} pixels, {:.4} %\n{not_a_number}{}\n",
        difference.max,
        difference.mean,
        difference.rmse,
        perceived.flip,
        arguments.tolerance,
        difference.above,
        u64::from(size[0]) * u64::from(size[1]),
        100.0 * difference.share_above,
        if equal { "equal within the tolerance" } else { "different" },
    )
}
