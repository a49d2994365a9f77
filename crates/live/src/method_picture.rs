//! Pictures by other methods than Whitted's, and what outlives them.

use std::borrow::Cow;

use catoptric_picture::{Picture, SizeError};
use catoptric_tracer::RenderScene;
use catoptric_tracer::raster::{
    CubeMapSettings, CubeMaps, GBufferLayer, Method, MethodError, MethodOutput, PassName, SsrFallback,
};

use crate::request::DisplayContent;
use crate::status::LiveError;

/// Cube maps of no more bytes are kept for when the method is chosen again.
const KEPT: u64 = 256 << 20;

/// The newest picture of a method.
pub(crate) struct MethodPicture {
    pub(crate) drawing: MethodOutput,
    pub(crate) size: [u32; 2],
    pub(crate) samples: u32,
}

/// The cube maps that outlive a picture.
#[derive(Default)]
pub(crate) struct CubeMapStore {
    pub(crate) whole: CubeMaps,
    /// The coarse maps made while bodies move.
    pub(crate) rough: CubeMaps,
    pub(crate) bytes: u64,
}

impl CubeMapStore {
    /// Lets go of maps that are large and that the method has no use for.
    pub(crate) fn change_to(&mut self, method: &Method) {
        if maps_of(method).is_none() && self.bytes > KEPT {
            *self = Self::default();
        }
    }
}

impl MethodPicture {
    /// What is to be seen of it, and what that is.
    pub(crate) fn seen(
        &self,
        render_scene: &RenderScene,
        wanted: DisplayContent,
    ) -> Result<(Cow<'_, Picture>, DisplayContent), SizeError> {
        let found = match wanted {
            DisplayContent::Picture => None,
            DisplayContent::Layer(layer) => {
                self.drawing.layer(render_scene, layer)?.map(|picture| (picture, wanted))
            }
            DisplayContent::UnfoldedCube(body) => unfolded(&self.drawing, render_scene, body)?,
        };
        Ok(match found {
            Some((picture, shows)) => (Cow::Owned(picture), shows),
            None => (Cow::Borrowed(&self.drawing.picture), DisplayContent::Picture),
        })
    }

    /// What each pass took, milliseconds.
    pub(crate) fn passes(&self) -> Vec<(PassName, f64)> {
        self.drawing.passes.iter().map(|(name, time)| (*name, 1e3 * time.as_secs_f64())).collect()
    }
}

/// The unfolded cube map of a body, or else the first there is.
pub(crate) fn unfolded(
    drawing: &MethodOutput,
    render_scene: &RenderScene,
    wanted: Option<usize>,
) -> Result<Option<(Picture, DisplayContent)>, SizeError> {
    let maps = drawing.maps(render_scene);
    let of_body = maps.iter().find(|(body, _)| Some(*body) == wanted);
    let Some((body, map)) = of_body.or(maps.first()) else { return Ok(None) };
    Ok(Some((map.unfolded()?, DisplayContent::UnfoldedCube(Some(*body)))))
}

/// Whether it is light that is seen, to be developed as the picture is.
pub(crate) fn has_light(shows: DisplayContent) -> bool {
    !matches!(shows, DisplayContent::Layer(layer) if !matches!(layer, GBufferLayer::Lit | GBufferLayer::Reflected))
}

/// The settings of the cube maps that a method uses.
pub(crate) fn maps_of(method: &Method) -> Option<CubeMapSettings> {
    match method {
        Method::CubeMap(maps) => Some(*maps),
        Method::Ssr(ssr) => match ssr.fallback {
            SsrFallback::CubeMap(maps) => Some(maps),
            SsrFallback::Background => None,
        },
        Method::Whitted | Method::Flat(_) | Method::Gouraud(_) | Method::Phong(_) => None,
    }
}

impl From<MethodError> for LiveError {
    fn from(error: MethodError) -> Self {
        match error {
            MethodError::Setting(error) => Self::Setting(error),
            MethodError::Size(error) => Self::Size(error),
            MethodError::TooManyCubeMaps { bodies, size, .. } => Self::TooManyCubeMaps { bodies, size },
            // None of these comes from drawing a view.
            error @ (MethodError::Cancelled | MethodError::SizeMismatch { .. }) => {
                Self::Fault(error.to_string())
            }
        }
    }
}
