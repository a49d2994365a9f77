//! Reports: pages, tables and plots, in English or Russian.

mod csv;
pub(crate) mod html;
mod language;
pub(crate) mod page;

mod plot;
mod raster;
mod study;
pub(crate) mod tables;
pub(crate) mod texts;

pub use csv::points_csv;
pub use language::{Language, UnknownLanguage};

pub use page::{PageError, PageSettings, page};
pub use plot::{Plot, PlotAxis, PlotCurve, PlotMark, Scale, Tick};
pub use raster::{RasterError, rasterize};
pub use study::{MeasurementFigure, MeasurementReport, figures, law_lines, machine_rows, study};
