//! The command line's grammar.

mod method;

use std::net::{IpAddr, Ipv4Addr};
use std::num::IntErrorKind;
use std::path::PathBuf;
use std::str::FromStr;

use catoptric_exchange::{Dialect, ForeignFormat};
use catoptric_lab::Variant;
use catoptric_lab::detective::Verdict;
use catoptric_lab::maps::MapKind;
use catoptric_lab::measure::MeasurePlan;
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, PictureFormat, ToneCurve};
use catoptric_scene::{SceneEdit, Tracing};
use catoptric_tracer::RenderSettings;
use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueEnum, value_parser};

use crate::output_kind::{OutputKind, format_names};

pub(crate) use method::MethodArguments;

/// A laboratory for reflections from geometric bodies.
#[derive(Debug, Parser)]
#[command(name = "catoptric", version, propagate_version = true, disable_help_subcommand = true)]
#[command(after_help = "\
Examples:
  catoptric render whitted -o whitted.png --samples 16
  catoptric examples four-bodies -o my.toml
  catoptric check my.toml
  catoptric render my.toml -o my.exr --size 1920x1080

Exit status: 0 done, 1 a comparison failed, 2 the input is wrong, 130 interrupted.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Open the studio (also what happens without a command)
    Studio(StudioArguments),
    /// Draw a scene into a picture
    Render(RenderArguments),
    /// Find all problems of scene files, with line and column
    Check(CheckArguments),
    /// Tell every number behind a pixel
    Audit(AuditArguments),
    /// Tell how two pictures differ
    Diff(DiffArguments),
    /// Draw a scene in several ways and hold them against the first, or tell what is wrong in a picture of it
    Compare(CompareArguments),
    /// Measure how the time of a picture grows, and name the law
    Measure(MeasureArguments),
    /// Convert a picture, or write a scene in its standard form
    Convert(ConvertArguments),
    /// Serve the laboratory to a browser on this machine
    Serve(ServeArguments),
    /// List the built-in scenes, or write one
    Examples(ExamplesArguments),
    /// Print a script for the tab key of a shell: commands, options, scenes, addresses of their values
    Completions(CompletionsArguments),
    /// Print the manual page
    Man(ManArguments),
    /// Print help on the program or a command
    Help(HelpArguments),
}

/// Values instead of those of the scene file.
#[derive(Debug, Args)]
pub(crate) struct SetArguments {
    /// Set a value of the scene, such as bodies.ball.radius=0.5 or camera.position.y=2; nothing after the = takes it away;
    /// pictures are found from the current directory; may be given again (`check --keys` lists the addresses)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub edits: Vec<SceneEdit>,
    #[command(flatten)]
    pub import: ImportArguments,
}

/// How scenes of other ray tracers are taken over.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct ImportArguments {
    /// What a miniRT program does otherwise than most, words separated by commas: radius, base, cone-base, cone-angle,
    /// cone-height-first, vertical-fov, left-handed, added-reflection
    #[arg(long, value_name = "WORDS", default_value_t, hide_default_value = true)]
    pub dialect: Dialect,
    /// Of a scene of another ray tracer, replace what cannot be taken over by what comes nearest, or leave it out
    #[arg(long)]
    pub approximate: bool,
}

/// How linear light becomes what a display shows.
#[derive(Debug, Args)]
pub(crate) struct DevelopmentArguments {
    /// Exposure in stops: each doubles the light; linear formats (.exr, .hdr, .pfm) stay as they are
    #[arg(long, value_name = "EV", default_value_t = 0.0, allow_negative_numbers = true, value_parser = finite)]
    pub exposure: f64,
    /// How light beyond white is fitted in; linear formats stay as they are; none by default, linear-codes for a scene of
    /// another ray tracer
    #[arg(long, value_name = "CURVE", value_parser = tone_curves())]
    pub tone_curve: Option<ToneCurve>,
    /// Bits per channel of a PNG (8 or 16) or a TIFF (16, 8, or 32 for linear light in floats)
    #[arg(long, value_name = "BITS", value_parser = ["8", "16", "32"])]
    pub bits: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct StudioArguments {
    /// A scene file, or the name of a built-in scene; without it, the scene that was open last
    #[arg(value_name = "SCENE")]
    pub scene: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct RenderArguments {
    /// A scene file, or the name of a built-in scene
    pub scene: PathBuf,
    /// The picture to write; its extension decides: .png, .jpg, .webp, .tif (display), .exr, .hdr or .pfm (linear light); -
    /// for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// The format to write, such as png or exr, whatever the name of the file says; streams get a PNG by default
    #[arg(long, value_name = "FORMAT", value_parser = picture_format)]
    pub format: Option<PictureFormat>,
    /// The quality of a JPEG, 1 to 100; 92 by default
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(1..=100))]
    pub quality: Option<u8>,
    /// Width and height in pixels; 1280x720 by default, or what a scene of another ray tracer asks for
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    #[command(flatten)]
    pub backend: BackendArguments,
    /// Number of threads, 1 to 1024; all cores by default
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Samples per pixel, 1 to 65536; one goes through the pixel's center
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=i64::from(RenderSettings::MAX_SAMPLES)))]
    pub samples: u32,
    /// Generations of rays, 1 to 64, instead of the scene's
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=i64::from(Tracing::MAX_GENERATIONS)))]
    pub generations: Option<u32>,
    #[command(flatten)]
    pub set: SetArguments,
    /// Show a map over the picture instead of the picture itself
    #[arg(long, value_name = "NAME", value_parser = maps(), conflicts_with = "stats")]
    pub map: Option<MapKind>,
    #[command(flatten)]
    pub development: DevelopmentArguments,
    /// Write times, rays and memory as JSON; - for standard output
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// No progress, no warnings, no summary
    #[arg(short, long)]
    pub quiet: bool,
    #[command(flatten)]
    pub method: MethodArguments,
}

#[derive(Debug, Args)]
#[command(after_help = "\
The findings go to standard output, and after them a line with the verdict on each file.

Exit status: 0 all can be used, 2 some cannot.")]
pub(crate) struct CheckArguments {
    /// Scene files, or names of built-in scenes
    #[arg(required = true)]
    pub scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub set: SetArguments,
    /// List the addresses of all values, what stands there, what it means and its limits
    #[arg(long)]
    pub keys: bool,
}

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("what").required(true).args(["pixel", "exact"]))]
#[command(after_help = "\
Examples:
  catoptric audit whitted --pixel 545,330
  catoptric audit whitted --pixel 545,330 --svg tree.svg
  catoptric audit ring-of-images --exact")]
pub(crate) struct AuditArguments {
    /// A scene file, or the name of a built-in scene
    pub scene: PathBuf,
    /// Column and row of the pixel, from 0 at the upper left
    #[arg(long, value_name = "X,Y")]
    pub pixel: Option<Pixel>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720")]
    pub size: Size,
    /// Samples per pixel, 1 to 65536; a tree of rays for each
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=i64::from(RenderSettings::MAX_SAMPLES)))]
    pub samples: u32,
    /// Generations of rays, 1 to 64, instead of the scene's
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=i64::from(Tracing::MAX_GENERATIONS)))]
    pub generations: Option<u32>,
    #[command(flatten)]
    pub set: SetArguments,
    /// Show rays up to N steps from the eye only; the sum has all
    #[arg(long, value_name = "N")]
    pub depth: Option<usize>,
    /// Print JSON
    #[arg(long, conflicts_with_all = ["dot", "svg"])]
    pub json: bool,
    /// Write the tree of rays for Graphviz; - for standard output
    #[arg(long, value_name = "FILE", requires = "pixel", conflicts_with = "svg")]
    pub dot: Option<PathBuf>,
    /// Write the tree of rays as a drawing; - for standard output
    #[arg(long, value_name = "FILE", requires = "pixel")]
    pub svg: Option<PathBuf>,
    /// Hold the images of mirrors, focal points and highlights against their formulas
    #[arg(long, conflicts_with_all = ["dot", "svg"])]
    pub exact: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Exit status: 0 equal within the tolerance, 1 different, 2 they cannot be compared.")]
pub(crate) struct DiffArguments {
    /// A picture of any format that is read
    pub a: PathBuf,
    /// Another picture of the same size
    pub b: PathBuf,
    /// The layer to read of EXR pictures with several
    #[arg(long, value_name = "NAME")]
    pub layer: Option<String>,
    /// Write a picture of where they differ
    #[arg(long, value_name = "OUT.png")]
    pub heat: Option<PathBuf>,
    /// Print the numbers as JSON
    #[arg(long)]
    pub json: bool,
    /// The largest difference of a channel that counts as equal, in linear light
    #[arg(long, value_name = "D", default_value = "1/255", allow_negative_numbers = true, value_parser = fraction)]
    pub tolerance: f64,
    /// The share of pixels that may differ by more, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, allow_negative_numbers = true, value_parser = share)]
    pub allow: f64,
    /// Compare values beyond 0 to 1 too, instead of clamping them as a display does
    #[arg(long)]
    pub unclamped: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
The first picture is the truth. A method is one of whitted, ssr, cube-map, phong, gouraud, flat, with settings such as
ssr:range=5:fallback=cube-map or whitted:generations=2:samples=16.

A scene and pictures without methods: each picture, by whatever ray tracer, is held against the exact one, and what is
systematically different is found by trying it. Exit status then: 0 right, 1 different, 2 it cannot be compared.

A class is marked from a folder with a folder or files of each student, or from a table with the columns
student,scene,picture. Pictures are called as their scenes. Results: a page, CSV, JUnit, Gradescope, Submitty.

Examples:
  catoptric compare whitted --methods whitted,ssr,cube-map,phong
  catoptric compare hall-of-mirrors --methods whitted,whitted:generations=4 -o hall --language ru
  catoptric compare --pictures reference.exr,mine.exr
  catoptric compare scene.rt --pictures mine.ppm
  catoptric compare --class submissions --scenes scenes --rubric rubric.toml")]
pub(crate) struct CompareArguments {
    /// A scene file, or the name of a built-in scene; can be left out when only pictures are compared, or a class is marked
    #[arg(value_name = "SCENE", required_unless_present_any = ["pictures", "class"])]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub set: SetArguments,
    /// The ways of drawing, the first of which is the truth
    #[arg(
        long,
        value_name = "METHODS",
        value_delimiter = ',',
        requires = "scene",
        required_unless_present_any = ["pictures", "class"]
    )]
    pub methods: Vec<Variant>,
    /// Picture files to compare too, separated by commas, all of one size; may be given again
    #[arg(long, value_name = "FILES")]
    pub pictures: Vec<PathBuf>,
    /// The layer to read of EXR pictures with several
    #[arg(long, value_name = "NAME", requires = "pictures")]
    pub layer: Option<String>,
    /// Mark a class: a folder with the pictures of each student, or a table student,scene,picture (CSV)
    #[arg(long, value_name = "CLASS", conflicts_with_all = ["methods", "pictures", "pixels"])]
    pub class: Option<PathBuf>,
    /// The scenes of a class in a folder: files, folders of them or built-in ones; those in the folder by default
    #[arg(long, value_name = "SCENES", num_args = 1.., requires = "class", conflicts_with_all = ["scene", "methods", "pictures"])]
    pub scenes: Vec<PathBuf>,
    /// What pictures of a class are worth and mistakes cost (TOML)
    #[arg(long, value_name = "RUBRIC", requires = "class", conflicts_with_all = ["methods", "pictures"])]
    pub rubric: Option<PathBuf>,
    /// The directory for the report, the pictures and the numbers; compared by default, marked for a class, and none for
    /// pictures without methods
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Width and height in pixels; 640x360 by default, or for pictures without methods what their scene asks for
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    /// Samples per pixel, 1 to 65536
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=i64::from(RenderSettings::MAX_SAMPLES)))]
    pub samples: u32,
    /// Number of threads, 1 to 1024; all cores by default
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// How often each is drawn for its time, after a first time that is not counted, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = value_parser!(u32).range(1..=1000))]
    pub runs: u32,
    /// The largest difference of a channel that counts as equal, in linear light, 1/255 by default; for pictures without
    /// methods in codes, 2/255 by default, and 8/255 for a JPEG; with 0 codes must be the same, at edges, too
    #[arg(long, value_name = "D", allow_negative_numbers = true, value_parser = fraction)]
    pub tolerance: Option<f64>,
    /// For pictures without methods, the share of pixels at edges that may differ by more, 0 to 1; apart from edges only
    /// single pixels may
    #[arg(long, value_name = "SHARE", default_value_t = Verdict::ALLOWED, allow_negative_numbers = true, value_parser = share)]
    pub allow: f64,
    /// For pictures without methods, print what was found as JSON
    #[arg(long, conflicts_with = "methods")]
    pub json: bool,
    /// For pictures without methods, audit so many of the worst pixels
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with_all = ["methods", "json"])]
    pub pixels: usize,
    /// The language of the report: en or ru
    #[arg(long, value_name = "LANGUAGE", default_value_t = Language::English)]
    pub language: Language,
    #[command(flatten)]
    pub development: DevelopmentArguments,
    /// No progress, no warnings, no summary
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
What to vary is one of bodies, generations, size, samples, threads, method, fineness, cube-map-size, search, or the
address of a value of the scene such as bodies.ball.radius, or two of them separated by a comma; values follow a = sign,
those of an address also as FROM..TO:COUNT. Ctrl-C ends the measurement and keeps what was measured.

Examples:
  catoptric measure whitted --vary size
  catoptric measure whitted --vary bodies,search -o bodies --language ru
  catoptric measure hall-of-mirrors --vary generations=1,2,4,8,16,32
  catoptric measure whitted --vary lights.0.intensity=0..2:9 --answers mean,pixel:160,90,flip,rays")]
pub(crate) struct MeasureArguments {
    /// A scene file, or the name of a built-in scene
    pub scene: PathBuf,
    #[command(flatten)]
    pub set: SetArguments,
    /// What to vary, one parameter or two, each with its values or the usual ones
    #[arg(long, value_name = "PARAMETERS")]
    pub vary: String,
    /// What the pictures answer beside their time: mean (light), pixel:X,Y, flip (against the first) and rays, separated by
    /// commas
    #[arg(long, value_name = "ANSWERS")]
    pub answers: Option<String>,
    /// The directory for the report, the plots and the tables
    #[arg(short, long, value_name = "DIR", default_value = "study")]
    pub output: PathBuf,
    /// The method, unless it is varied
    #[arg(long, value_name = "METHOD", default_value = "whitted")]
    pub method: Variant,
    /// Width and height in pixels, unless they are varied
    #[arg(long, value_name = "WxH", default_value = "320x180")]
    pub size: Size,
    /// Samples per pixel, 1 to 65536, unless they are varied
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=i64::from(RenderSettings::MAX_SAMPLES)))]
    pub samples: u32,
    /// Number of threads, 1 to 1024, unless it is varied; all cores by default
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// How often each point is measured, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = MeasurePlan::ROUNDS, value_parser = value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// The language of the report: en or ru
    #[arg(long, value_name = "LANGUAGE", default_value_t = Language::English)]
    pub language: Language,
    /// No progress, no warnings, no summary
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ConvertArguments {
    /// A picture of any format that is read, or a scene (.toml, .rt, .yml, .nff); - for standard input
    #[arg(value_name = "IN")]
    pub from: PathBuf,
    /// What to write; its extension decides; - for standard output
    #[arg(value_name = "OUT")]
    pub to: PathBuf,
    /// The format to write, such as png, exr, toml or rt, whatever the name of the file says
    #[arg(long, value_name = "FORMAT", value_parser = format)]
    pub format: Option<OutputKind>,
    /// Width and height of the picture in pixels, for scenes of other ray tracers
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    #[command(flatten)]
    pub import: ImportArguments,
    /// The layer to read of an EXR with several
    #[arg(long, value_name = "NAME")]
    pub layer: Option<String>,
    /// The quality of a JPEG, 1 to 100; 92 by default
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(1..=100))]
    pub quality: Option<u8>,
    #[command(flatten)]
    pub development: DevelopmentArguments,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  catoptric serve --open
  catoptric serve public --port 9000")]
pub(crate) struct ServeArguments {
    /// The directory to serve; without it target/web, which `cargo xtask web` makes
    #[arg(value_name = "DIR")]
    pub directory: Option<PathBuf>,
    /// The address of this machine to listen at; with another than a loopback address, other machines can read the
    /// directory
    #[arg(long, value_name = "ADDR", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    pub address: IpAddr,
    /// The port to listen at, 0 for any; without it, the first free one from 8080 on
    #[arg(long, value_name = "N")]
    pub port: Option<u16>,
    /// Open the page in the browser
    #[arg(long)]
    pub open: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExamplesArguments {
    /// The scene to write; without it, all are listed
    pub name: Option<String>,
    /// Where to write it, instead of standard output
    #[arg(short, long, value_name = "FILE.toml", requires = "name")]
    pub output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// For which shell
    pub shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArguments {
    /// The command to explain, such as render; without it, the program
    pub command: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct HelpArguments {
    /// The command to explain, such as render; without it, the program
    pub command: Option<String>,
}

/// What does the work, and by which card.
#[derive(Debug, Args)]
pub(crate) struct BackendArguments {
    /// What does the work
    #[arg(long, value_enum, default_value_t = Backend::Auto)]
    pub backend: Backend,
    /// Part of the name of the graphics card to use
    #[arg(long, value_name = "NAME", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    pub gpu: Option<String>,
    /// Let a driver that computes on the processor count as a graphics card
    #[arg(long)]
    pub software_gpu: bool,
}

/// What does the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Backend {
    /// A graphics card if there is one that can draw the scene, else the processor
    Auto,
    /// The processor
    Cpu,
    /// A graphics card, or nothing
    Gpu,
}

/// Width and height of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub width: u32,
    pub height: u32,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let unclear = || "give width and height in pixels, such as 1280x720".to_owned();
        let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(unclear)?;
        let side = |text: &str| match text.trim().parse::<u32>() {
            Ok(0) => Err("both sides must be at least 1 pixel".to_owned()),
            Ok(pixels) => Ok(pixels),
            Err(error) if *error.kind() == IntErrorKind::PosOverflow => {
                Err(format!("a side has at most {} pixels", Picture::MAX_SIDE))
            }
            Err(_) => Err(unclear()),
        };
        Ok(Self { width: side(width)?, height: side(height)? })
    }
}

impl From<Size> for [u32; 2] {
    fn from(Size { width, height }: Size) -> Self {
        [width, height]
    }
}

/// A pixel of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pixel {
    pub x: u32,
    pub y: u32,
}

impl FromStr for Pixel {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers =
            text.split_once(',').and_then(|(x, y)| x.trim().parse().ok().zip(y.trim().parse().ok()));
        let (x, y) = numbers.ok_or("give column and row, such as 640,360")?;
        Ok(Self { x, y })
    }
}

fn format(text: &str) -> Result<OutputKind, String> {
    OutputKind::named(text).ok_or_else(|| {
        format!(
            "give {}, toml, {}",
            format_names(),
            ForeignFormat::ALL.map(|format| format.extensions().join(", ")).join(", ")
        )
    })
}

fn picture_format(text: &str) -> Result<PictureFormat, String> {
    let written = PictureFormat::of_extension(text).filter(|format| format.is_written());
    written.ok_or_else(|| format!("give one of {}", format_names()))
}

fn maps() -> impl clap::builder::TypedValueParser<Value = MapKind> {
    use clap::builder::TypedValueParser as _;
    PossibleValuesParser::new(MapKind::ALL.map(MapKind::name))
        .map(|name| MapKind::ALL.into_iter().find(|kind| kind.name() == name).unwrap_or_default())
}

/// A number or a quotient such as 1/255, not negative.
fn fraction(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once('/') {
        Some((above, below)) => number(above).zip(number(below)).map(|(above, below)| above / below),
        None => number(text),
    };
    match value {
        Some(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("give a number of 0 or more, such as 0.01 or 1/255".to_owned()),
    }
}

/// A part of the whole.
fn share(text: &str) -> Result<f64, String> {
    match fraction(text) {
        Ok(value) if value <= 1.0 => Ok(value),
        _ => Err("give a number from 0 to 1, such as 0.001 or 1/1000".to_owned()),
    }
}

fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err("give a number, such as -1.5".to_owned()),
    }
}

fn tone_curves() -> impl clap::builder::TypedValueParser<Value = ToneCurve> {
    use clap::builder::TypedValueParser as _;
    PossibleValuesParser::new(ToneCurve::ALL.map(ToneCurve::name))
        .map(|name| name.parse().unwrap_or_default())
}
