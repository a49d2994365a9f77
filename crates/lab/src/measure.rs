//! The time of a picture by its parameters: sweeps of one or two parameters, and the law behind them.

mod answer;
mod axis;
mod law;
mod least_squares;
mod parameter;
mod run;
mod series;
mod statistics;

pub use answer::{PictureQuestion, QuestionError};
pub use axis::{Axis, AxisError, Variable};
pub use law::{Coefficient, Fit, GrowthLaw, best_growth, fit};
pub use parameter::{Parameter, Value};
pub use run::{MeasureError, MeasurePlan, MeasuredPoint, Measurement, PointTimes, SweepProgress, measure};
pub use series::{Series, series};
pub use statistics::{Summary, summarize};
