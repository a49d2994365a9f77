//! The ways of drawing reflections and their settings.

use std::path::PathBuf;

use anyhow::{Result, bail};
use catoptric_tracer::raster::{
    CubeMapSettings, LightModel, Method, MethodKind, ShadingSettings, SsrFallback, SsrSettings,
};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
#[command(next_help_heading = "How reflections are drawn")]
pub(crate) struct MethodArguments {
    /// How reflections are found
    #[arg(long, default_value = "whitted", value_parser = methods())]
    pub method: MethodKind,
    /// flat, gouraud, phong: parts of a quarter of a circle and of a cube's edge, 1 to 128 [default: 8]
    #[arg(long, value_name = "N")]
    pub fineness: Option<u32>,
    /// flat, gouraud, phong: bodies shade each other
    #[arg(long)]
    pub shadows: bool,
    /// flat, gouraud, phong: which of the local terms count [default: phong]
    #[arg(long, value_enum)]
    pub model: Option<LocalModel>,
    /// ssr: from one look at the depths to the next, pixels, 0.25 to 256 [default: 1]
    #[arg(long, value_name = "PIXELS")]
    pub ssr_step: Option<f64>,
    /// ssr: how thick surfaces are taken to be, meters [default: 0.1]
    #[arg(long, value_name = "METERS")]
    pub ssr_thickness: Option<f64>,
    /// ssr: how far reflected rays are followed, meters [default: 1000]
    #[arg(long, value_name = "METERS")]
    pub ssr_range: Option<f64>,
    /// ssr: how often the step in which a surface was met is halved, 0 to 32 [default: 8]
    #[arg(long, value_name = "N")]
    pub ssr_refine: Option<u32>,
    /// ssr: what is reflected where the screen has nothing [default: background]
    #[arg(long, value_enum)]
    pub ssr_fallback: Option<FallbackChoice>,
    /// cube-map: edge of each of the six faces, pixels, 1 to 4096 [default: 256]
    #[arg(long, value_name = "PIXELS")]
    pub cube_size: Option<u32>,
    /// cube-map: correct for the place on the body, as if the surroundings were painted on a box
    #[arg(long)]
    pub parallax: bool,
    /// ssr, cube-map: write the layers of the geometry buffer and the unfolded cube maps into this folder
    #[arg(long, value_name = "FOLDER")]
    pub layers: Option<PathBuf>,
}

/// Which of the local terms count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LocalModel {
    /// Ambient and diffuse light
    Lambert,
    /// Highlights too
    Phong,
}

/// What is reflected where the screen has nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FallbackChoice {
    /// The scene's background
    Background,
    /// What a cube map of the body shows
    CubeMap,
}

impl MethodArguments {
    /// The method with its settings. Options that it does not have are refused, as are values out of range.
    pub(crate) fn chosen(&self) -> Result<Method> {
        self.refuse_of_others()?;
        let method = match self.method.method() {
            Method::Whitted => Method::Whitted,
            Method::Flat(_) => Method::Flat(self.shading()),
            Method::Gouraud(_) => Method::Gouraud(self.shading()),
            Method::Phong(_) => Method::Phong(self.shading()),
            Method::Ssr(_) => Method::Ssr(self.screen()),
            Method::CubeMap(_) => Method::CubeMap(self.cube_map()),
        };
        method.check()?;
        Ok(method)
    }

    fn refuse_of_others(&self) -> Result<()> {
        use MethodKind::{CubeMap, Flat, Gouraud, Phong, Ssr};
        let maps_screen = self.method == Ssr && self.ssr_fallback == Some(FallbackChoice::CubeMap);
        let shading: &[MethodKind] = &[Flat, Gouraud, Phong];
        let maps: &[MethodKind] = if maps_screen { &[CubeMap, Ssr] } else { &[CubeMap] };
        let options = [
            ("--fineness", self.fineness.is_some(), shading),
            ("--shadows", self.shadows, shading),
            ("--model", self.model.is_some(), shading),
            ("--ssr-step", self.ssr_step.is_some(), &[Ssr]),
            ("--ssr-thickness", self.ssr_thickness.is_some(), &[Ssr]),
            ("--ssr-range", self.ssr_range.is_some(), &[Ssr]),
            ("--ssr-refine", self.ssr_refine.is_some(), &[Ssr]),
            ("--ssr-fallback", self.ssr_fallback.is_some(), &[Ssr]),
            ("--cube-size", self.cube_size.is_some(), maps),
            ("--parallax", self.parallax, maps),
            ("--layers", self.layers.is_some(), &[Ssr, CubeMap]),
        ];
        for (option, is_given, kinds) in options {
            if is_given && !kinds.contains(&self.method) {
                let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
                let hint = match option {
                    "--cube-size" | "--parallax" if self.method == Ssr => {
                        "; add --ssr-fallback cube-map, or leave it out".to_owned()
                    }
                    _ => format!("; leave it out, or give --method {}", names[0]),
                };
                bail!(
                    "{option} has no meaning for the method {}: it is for {}{hint}",
                    self.method,
                    names.join(", ")
                );
            }
        }
        Ok(())
    }

    fn shading(&self) -> ShadingSettings {
        let default = ShadingSettings::default();
        ShadingSettings {
            fineness: self.fineness.unwrap_or(default.fineness),
            shadows: self.shadows,
            model: match self.model {
                Some(LocalModel::Lambert) => LightModel::Lambert,
                Some(LocalModel::Phong) | None => LightModel::Phong,
            },
        }
    }

    fn screen(&self) -> SsrSettings {
        let default = SsrSettings::default();
        SsrSettings {
            step_pixels: self.ssr_step.unwrap_or(default.step_pixels),
            thickness: self.ssr_thickness.unwrap_or(default.thickness),
            range: self.ssr_range.unwrap_or(default.range),
            refinements: self.ssr_refine.unwrap_or(default.refinements),
            fallback: match self.ssr_fallback {
                Some(FallbackChoice::CubeMap) => SsrFallback::CubeMap(self.cube_map()),
                Some(FallbackChoice::Background) | None => SsrFallback::Background,
            },
        }
    }

    fn cube_map(&self) -> CubeMapSettings {
        let default = CubeMapSettings::default();
        CubeMapSettings { size: self.cube_size.unwrap_or(default.size), parallax: self.parallax }
    }
}

fn methods() -> impl TypedValueParser<Value = MethodKind> {
    let value = |kind: MethodKind| {
        PossibleValue::new(kind.name()).help(match kind {
            MethodKind::Whitted => "Whitted's tree of rays",
            MethodKind::Ssr => "Reflected rays marched over the screen",
            MethodKind::CubeMap => "Reflections looked up in pictures of the surroundings",
            MethodKind::Phong => "Faces, normals interpolated; nothing reflects",
            MethodKind::Gouraud => "Faces, intensities interpolated; nothing reflects",
            MethodKind::Flat => "Faces of one intensity each; nothing reflects",
        })
    };
    PossibleValuesParser::new(MethodKind::ALL.map(value)).map(|name| {
        MethodKind::ALL.into_iter().find(|kind| kind.name() == name).unwrap_or(MethodKind::Whitted)
    })
}
