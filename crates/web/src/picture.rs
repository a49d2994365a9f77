//! Pictures that scripts of the page ask for.

use std::io;
use std::sync::Arc;

use catoptric_live::{DisplayContent, JobError, RenderJob};
use catoptric_picture::{EncodeError, FormatError, PictureFormat, SaveOptions, SizeError};
use catoptric_scene::{Diagnostics, Example, Scene};
use catoptric_tracer::RenderSettings;
use catoptric_tracer::raster::{GBufferLayer, Method, MethodKind};
use serde::Deserialize;

/// What a script wants drawn: the open scene or a built-in one, through its own camera.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct PictureOrder {
    /// Pixels across.
    width: u32,
    /// Pixels down.
    height: u32,
    /// Samples per pixel; 1 by default.
    #[serde(default = "one_sample")]
    samples: u32,
    /// A built-in scene instead of the open one.
    example: Option<String>,
    /// A layer behind the picture, such as `body`, instead of the traced picture.
    layer: Option<String>,
    /// The file's format by its extension; `png` by default.
    #[serde(default = "usual_format")]
    format: String,
}

fn one_sample() -> u32 {
    1
}

fn usual_format() -> String {
    "png".to_owned()
}

/// A picture that is being drawn for a script.
pub(crate) struct ScriptPicture {
    job: RenderJob,
    options: SaveOptions,
}

/// The reason why a script gets no picture.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ScriptPictureError {
    /// The order cannot be read.
    #[error("{0}")]
    Order(#[from] serde_json::Error),
    /// There is no such scene.
    #[error("there is no built-in scene {0:?}")]
    Example(String),
    /// A built-in scene has a fault.
    #[error(transparent)]
    Scene(#[from] Diagnostics),
    /// There is no such layer.
    #[error("there is no layer {name:?}; there are {known}")]
    Layer { name: String, known: String },
    /// There is no such format.
    #[error("there is no picture format {0:?}")]
    UnknownFormat(String),
    /// The format does not take it.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// Too many samples.
    #[error("{0} samples: there may be 1 to {most}", most = RenderSettings::MAX_SAMPLES)]
    Samples(u32),
    /// The browser gives no thread.
    #[error("{0}")]
    Thread(#[from] io::Error),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The memory for its codes is not there.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The file cannot be made.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

impl ScriptPicture {
    /// Starts to draw what `order` says, a [`PictureOrder`] as JSON; `open` is the open scene.
    ///
    /// # Errors
    /// When the order cannot be read or done.
    pub(crate) fn start(open: &Arc<Scene>, order: &str) -> Result<Self, ScriptPictureError> {
        let order: PictureOrder = serde_json::from_str(order)?;
        let format = PictureFormat::of_extension(&order.format);
        let format = format.ok_or_else(|| ScriptPictureError::UnknownFormat(order.format.clone()))?;
        let options = SaveOptions::new(format, None)?;
        options.check_size(order.width, order.height)?;
        if !(1..=RenderSettings::MAX_SAMPLES).contains(&order.samples) {
            return Err(ScriptPictureError::Samples(order.samples));
        }
        let scene = match order.example {
            None => Arc::clone(open),
            Some(name) => match Example::find(&name) {
                Some(example) => Arc::new(example.load()?.scene),
                None => return Err(ScriptPictureError::Example(name)),
            },
        };
        let (method, shows) = match order.layer {
            None => (Method::Whitted, DisplayContent::Picture),
            Some(name) => (MethodKind::Ssr.method(), DisplayContent::Layer(layer_of(name)?)),
        };
        let settings = RenderSettings { width: order.width, height: order.height, samples: order.samples };
        let job = RenderJob::drawn(scene, method, shows, settings, None, 0)?;
        Ok(Self { job, options })
    }

    /// The bytes of the file, once, when there are any.
    ///
    /// # Errors
    /// When the picture could not be drawn or encoded.
    pub(crate) fn take(&self) -> Result<Option<Vec<u8>>, ScriptPictureError> {
        let Some(result) = self.job.take_result() else { return Ok(None) };
        Ok(Some(self.options.prepare(&result?.picture)?.encode()?))
    }

    /// How long it was traced.
    pub(crate) fn milliseconds(&self) -> f64 {
        self.job.progress().tracing.as_secs_f64() * 1000.0
    }
}

fn layer_of(name: String) -> Result<GBufferLayer, ScriptPictureError> {
    let known = GBufferLayer::ALL.map(GBufferLayer::name).join(", ");
    let layer = GBufferLayer::ALL.into_iter().find(|layer| layer.name() == name);
    layer.ok_or(ScriptPictureError::Layer { name, known })
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use catoptric_picture::decode;

    use super::*;

    fn drawn(order: &str) -> Result<Vec<u8>, ScriptPictureError> {
        let open = Example::find("four-bodies").unwrap().load().unwrap().scene;
        let picture = ScriptPicture::start(&Arc::new(open), order)?;
        loop {
            match picture.take()? {
                Some(bytes) => return Ok(bytes),
                None => thread::sleep(Duration::from_millis(1)),
            }
        }
    }

    #[test]
    fn the_open_scene_and_others_are_drawn_in_the_size_asked_for() {
        let size = |order: &str| {
            let picture = decode(&drawn(order).unwrap()).unwrap();
            (picture.width(), picture.height())
        };
        assert_eq!(size(r#"{"width": 16, "height": 9}"#), (16, 9));
        assert_eq!(
            size(r#"{"width": 8, "height": 4, "example": "whitted", "layer": "body", "format": "exr"}"#),
            (8, 4)
        );
    }

    #[test]
    fn orders_that_cannot_be_done_say_why() {
        let said = |order: &str| drawn(order).unwrap_err().to_string();
        assert!(said(r#"{"width": 0, "height": 9}"#).contains("is empty"));
        assert!(said(r#"{"width": 1000000, "height": 1000000, "format": "exr"}"#).contains("is too large"));
        assert!(said(r#"{"width": 8, "height": 8, "samples": 0}"#).contains("0 samples"));
        assert!(said(r#"{"width": 8, "height": 8, "example": "nothing"}"#).contains("\"nothing\""));
        assert!(said(r#"{"width": 8, "height": 8, "layer": "smell"}"#).contains("depth, normal"));
        assert!(said(r#"{"width": 8, "height": 8, "format": "doc"}"#).contains("\"doc\""));
        assert!(said(r#"{"width": 8}"#).contains("height"));
    }
}
