//! Reports: pages, tables and plots, in English or Russian.

pub(crate) mod html;
mod language;
mod page;

mod plot;
mod raster;
mod study;
mod tables;
mod texts;

pub use language::{Language, UnknownLanguage};

pub use page::{PageError, Settings, page};
pub use plot::{Curve, Mark, Plot, PlotAxis, Scale, Tick};
pub use raster::{RasterError, rasterize};
pub use study::{Study, law_lines, machine_rows, study, time_plot};
