//! `catoptric diff`

use anyhow::Result;
use catoptric_picture::{
    BitDepth, Comparison, Development, Difference, HeatMap, check_writable, heat_map, read, write_png,
};
use serde_json::json;

use super::Outcome;
use crate::arguments::DiffArguments;
use crate::output::print;

pub(crate) fn run(arguments: &DiffArguments) -> Result<Outcome> {
    if let Some(path) = &arguments.heat {
        check_writable(path)?;
    }
    let (a, b) = (read(&arguments.a)?, read(&arguments.b)?);
    let comparison = Comparison { clamp: !arguments.unclamped, bound: arguments.tolerance };
    let difference = comparison.compare(&a, &b)?;
    if let Some(path) = &arguments.heat {
        let options = HeatMap { clamp: comparison.clamp, ..HeatMap::default() };
        let map = heat_map(&a, &b, &options)?;
        write_png(path, &Development::default().develop(&map, BitDepth::Eight)?)?;
    }
    let equal = difference.share_above <= arguments.allow;
    let size = [a.width(), a.height()];
    print(&if arguments.json {
        as_json(&difference, arguments, size, equal)
    } else {
        as_text(&difference, arguments, size, equal)
    })?;
    Ok(if equal { Outcome::Done } else { Outcome::Failed })
}

fn as_json(difference: &Difference, arguments: &DiffArguments, size: [u32; 2], equal: bool) -> String {
    let finite = |value: f64| value.is_finite().then_some(value);
    let value = json!({
        "width": size[0],
        "height": size[1],
        "max": finite(difference.max),
        "mean": finite(difference.mean),
        "rmse": finite(difference.rmse),
        "psnr_db": finite(difference.psnr_db),
        "tolerance": arguments.tolerance,
        "pixels_above": difference.above,
        "share_above": difference.share_above,
        "share_allowed": arguments.allow,
        "pixels_not_a_number": difference.not_a_number,
        "worst_pixel": difference.worst,
        "equal": equal,
    });
    format!("{value:#}\n")
}

fn as_text(difference: &Difference, arguments: &DiffArguments, size: [u32; 2], equal: bool) -> String {
    let worst = match difference.worst {
        Some([x, y]) => format!(" at pixel {x},{y}"),
        None => String::new(),
    };
    let not_a_number = match difference.not_a_number {
        0 => String::new(),
        count => format!("not a number  {count} pixels\n"),
    };
    format!(
        "largest       {:.6}{worst}\nmean          {:.6}\nRMSE          {:.6}\nPSNR          {:.2} dB\n\
         above {:.5} {} of {} pixels, {:.4} %\n{not_a_number}{}\n",
        difference.max,
        difference.mean,
        difference.rmse,
        difference.psnr_db,
        arguments.tolerance,
        difference.above,
        u64::from(size[0]) * u64::from(size[1]),
        100.0 * difference.share_above,
        if equal { "equal within the tolerance" } else { "different" },
    )
}
