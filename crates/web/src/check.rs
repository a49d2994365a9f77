//! Pictures of other ray tracers that a page holds against a scene.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use catoptric_exchange::{Dialect, ForeignFormat, ImportOptions, UnknownDialect};
use catoptric_lab::detective::{
    Detective, DetectiveError, DetectiveSettings, Mistake, ObservedPicture, Orientation, Verdict,
};
use catoptric_lab::marking::{Evidence, ExactPicture, WorstPlace};
use catoptric_lab::report::{Language, PageError, UnknownLanguage};
use catoptric_picture::{
    DecodeError, Development, Picture, PictureFormat, ToneCurve, UnknownToneCurve, decode,
};
use catoptric_platform::{files, threads};
use catoptric_scene::{Diagnostics, Example, Scene};
use catoptric_store::{LoadError, load};
use catoptric_tracer::{RenderControl, RenderError, RenderScene, RenderSettings, SceneBuildError, render};
use serde::Deserialize;
use serde_json::{Value, json};

/// What a script wants checked. Files lie in the store.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct CheckOrder {
    /// The file of the scene, or the name of a built-in one.
    scene: String,
    /// The file of the picture.
    picture: PathBuf,
    /// `en` or `ru`; `en` by default.
    #[serde(default)]
    language: Option<String>,
    /// The curve from light to codes; by default that of the scene's format.
    #[serde(default)]
    tone_curve: Option<String>,
    /// What a miniRT program does otherwise than most.
    #[serde(default)]
    dialect: String,
    /// The share of pixels that may differ; 0.01 by default.
    #[serde(default = "usual_share")]
    allow: f64,
}

fn usual_share() -> f64 {
    0.01
}

/// What was found.
#[derive(Debug)]
pub(crate) struct CheckReport {
    /// The verdict, the places of the rest and the worst pixel.
    pub(crate) json: String,
    /// PNG files: the picture, the exact one, and the neighborhoods of the worst pixel in both if there is one.
    pub(crate) pictures: Vec<Vec<u8>>,
}

/// A check for a script, under way.
#[derive(Debug)]
pub(crate) struct ScriptCheck {
    receiver: Receiver<Result<CheckReport, CheckFault>>,
}

/// The reason why a script gets no verdict.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CheckFault {
    /// The order cannot be read.
    #[error("{0}")]
    Order(#[from] serde_json::Error),
    /// There is no such language.
    #[error(transparent)]
    Language(#[from] UnknownLanguage),
    /// There is no such curve.
    #[error(transparent)]
    ToneCurve(#[from] UnknownToneCurve),
    /// There is no such dialect.
    #[error(transparent)]
    Dialect(#[from] UnknownDialect),
    /// The scene has errors.
    #[error("{name}:\n{diagnostics}")]
    Scene { name: String, diagnostics: Diagnostics },
    /// The file of the scene cannot be read.
    #[error(transparent)]
    Load(LoadError),
    /// The file of the picture cannot be read.
    #[error("{0}: {1}")]
    Read(String, io::Error),
    /// The file is no picture.
    #[error("{0}: {1}")]
    Decode(String, DecodeError),
    /// The scene cannot be prepared.
    #[error(transparent)]
    Build(#[from] SceneBuildError),
    /// The picture cannot be checked.
    #[error(transparent)]
    Detective(#[from] DetectiveError),
    /// The exact picture cannot be traced.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The pictures cannot be shown.
    #[error(transparent)]
    Show(#[from] PageError),
    /// The browser gives no thread.
    #[error("{0}")]
    Thread(io::Error),
    /// The work ended without an answer.
    #[error("the check was lost")]
    Lost,
}

impl ScriptCheck {
    /// Starts to check what `order` says, a [`CheckOrder`] as JSON: on a thread of its own, or at once where there are none.
    ///
    /// # Errors
    /// When the order cannot be read, or no thread is given.
    pub(crate) fn start(order: &str) -> Result<Self, CheckFault> {
        let order: CheckOrder = serde_json::from_str(order)?;
        let (sender, receiver) = mpsc::channel();
        let work = move || {
            // Who asked may have gone.
            let _ = sender.send(check(&order));
        };
        threads::start_or_do("check", work).map_err(CheckFault::Thread)?;
        Ok(Self { receiver })
    }

    /// What was found, once; `None` before that.
    ///
    /// # Errors
    /// When the picture could not be checked.
    pub(crate) fn take(&self) -> Result<Option<CheckReport>, CheckFault> {
        match self.receiver.try_recv() {
            Ok(report) => report.map(Some),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(CheckFault::Lost),
        }
    }
}

fn check(order: &CheckOrder) -> Result<CheckReport, CheckFault> {
    let language =
        order.language.as_deref().map(str::parse::<Language>).transpose()?.unwrap_or(Language::English);
    let curve = order.tone_curve.as_deref().map(str::parse::<ToneCurve>).transpose()?;
    let name = order.picture.display().to_string();
    let bytes =
        files::read_bytes(&order.picture, u64::MAX).map_err(|error| CheckFault::Read(name.clone(), error))?;
    let format = PictureFormat::of_content(&bytes);
    let picture = decode(&bytes).map_err(|error| CheckFault::Decode(name, error))?;
    drop(bytes);
    let size = [picture.width(), picture.height()];
    let (scene, expected_size, is_foreign) = scene_of(order, size)?;
    let settings =
        DetectiveSettings { expected_size, ..DetectiveSettings::of_file(format, curve, is_foreign) };
    let detective = Detective::new(&scene, settings)?;
    let control = RenderControl::default();
    let verdict = detective.check(&ObservedPicture::of_file(&picture, format), &control)?;
    let evidence = evidence(&scene, (&picture, format), &settings, &verdict)?;
    Ok(report(&scene, &verdict, evidence, order.allow, language))
}

/// The scene for a picture of a size, the size that its file asks for, and whether it is another program's.
fn scene_of(order: &CheckOrder, size: [u32; 2]) -> Result<(Scene, Option<[u32; 2]>, bool), CheckFault> {
    let path = Path::new(&order.scene);
    let failed = |error: LoadError| match error {
        LoadError::Diagnostics { diagnostics, .. } => {
            CheckFault::Scene { name: order.scene.clone(), diagnostics }
        }
        other => CheckFault::Load(other),
    };
    if let Some(example) = Example::find(&order.scene) {
        let name = order.scene.clone();
        let loaded = example.load().map_err(|diagnostics| CheckFault::Scene { name, diagnostics })?;
        return Ok((loaded.scene, None, false));
    }
    let Some(format) = ForeignFormat::of_path(path) else {
        return Ok((load(path).map_err(failed)?.scene, None, false));
    };
    let dialect: Dialect = order.dialect.parse()?;
    let read = |size: Option<[u32; 2]>| {
        let options = ImportOptions { dialect, is_approximate: false, size };
        catoptric_exchange::load(path, format, &options).map_err(failed)
    };
    let (loaded, expected) = read(None)?;
    // To another size another angle of view belongs; a picture that was transposed has the sides exchanged.
    let is_expected =
        expected.is_some_and(|[width, height]| size == [width, height] || size == [height, width]);
    let loaded = if is_expected { loaded } else { read(Some(size))?.0 };
    Ok((loaded.scene, expected, true))
}

fn evidence(
    scene: &Scene,
    (picture, format): (&Picture, Option<PictureFormat>),
    settings: &DetectiveSettings,
    verdict: &Verdict,
) -> Result<Evidence, CheckFault> {
    /// The longest side of the pictures on the page, pixels.
    const LONGEST_SIDE: u32 = 1280;
    let [width, height] = verdict.scene_size;
    let traced = RenderSettings { width, height, samples: 1 };
    let exact = render(&RenderScene::build(scene)?, traced, &RenderControl::default())?.picture;
    let exact = ExactPicture::new(&exact, &settings.development(), LONGEST_SIDE)?;
    let is_light = format.is_some_and(PictureFormat::is_of_light);
    let own = if is_light { settings.development() } else { Development::default() };
    let orientation = verdict.mistakes.iter().find_map(|mistake| match mistake {
        Mistake::Orientation(orientation) => Some(*orientation),
        _ => None,
    });
    Ok(Evidence::new(picture, &own, orientation.unwrap_or(Orientation::Upright), &exact)?)
}

fn report(
    scene: &Scene,
    verdict: &Verdict,
    evidence: Evidence,
    allowed: f64,
    language: Language,
) -> CheckReport {
    let is_right = verdict.is_right(allowed);
    let worst = evidence.worst.filter(|_| !is_right);
    let places: Vec<Value> = verdict
        .clusters
        .iter()
        .filter(|_| !is_right)
        .map(|cluster| {
            json!({
                "place": cluster.place(scene, language),
                "share": cluster.share_in_words(language),
                "stored": cluster.worst.stored,
                "pixel": cluster.worst.pixel,
                "found": cluster.worst.found,
                "expected": cluster.worst.expected,
            })
        })
        .collect();
    let mistakes: Vec<Value> = verdict
        .mistakes
        .iter()
        .map(|mistake| json!({ "key": mistake.key(), "words": mistake.words(language) }))
        .collect();
    let json = json!({
        "right": is_right,
        "sentence": verdict.sentence(scene, language),
        "mistakes": mistakes,
        "shareAgreeing": verdict.agreed_before,
        "shareExplained": verdict.agreed,
        "size": evidence.picture.size,
        "exactSize": evidence.exact.size,
        "places": places,
        "worst": worst.as_ref().map(worst_json),
    });
    let mut pictures = vec![evidence.picture.png, evidence.exact.png.clone()];
    pictures.extend(worst.into_iter().flat_map(|worst| worst.details.map(|detail| detail.png)));
    CheckReport { json: json.to_string(), pictures }
}

fn worst_json(worst: &WorstPlace) -> Value {
    json!({
        "stored": worst.stored,
        "pixel": worst.pixel,
        "found": worst.found,
        "exact": worst.exact,
        "middle": worst.middle,
    })
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use catoptric_picture::{BitDepth, write_png};

    use super::*;

    const BALL: &str =
        "R 32 24\nA 0.2 255,255,255\nC 0,0,6 0,0,-1 50\nL 2,6,6 0.7 255,255,255\nsp 0,0,0 3 255,102,51\n";

    fn checked(order: &Value) -> Result<Value, CheckFault> {
        let check = ScriptCheck::start(&order.to_string())?;
        loop {
            match check.take()? {
                Some(report) => {
                    assert!(report.pictures.iter().all(|png| decode(png).is_ok()));
                    let mut value: Value = serde_json::from_str(&report.json).unwrap();
                    value["pictures"] = report.pictures.len().into();
                    return Ok(value);
                }
                None => thread::sleep(Duration::from_millis(1)),
            }
        }
    }

    #[test]
    fn a_picture_is_held_against_its_scene() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("ball.rt"), BALL).unwrap();
        let options = ImportOptions { dialect: Dialect::default(), is_approximate: false, size: None };
        let (loaded, _) = catoptric_exchange::load(&at("ball.rt"), ForeignFormat::MiniRt, &options).unwrap();
        let settings = RenderSettings { width: 32, height: 24, samples: 1 };
        let exact = RenderScene::build(&loaded.scene).unwrap();
        let exact = render(&exact, settings, &RenderControl::default()).unwrap().picture;
        let codes = Development { tone_curve: ToneCurve::LinearCodes, ..Development::default() };
        let write = |name: &str, picture: &Picture| {
            write_png(&at(name), &codes.develop(picture, BitDepth::Eight).unwrap()).unwrap();
        };
        write("right.png", &exact);
        let flipped = Picture::from_fn(32, 24, |x, y| exact.pixel(x, 23 - y).unwrap()).unwrap();
        write("flipped.png", &flipped);
        let order =
            |picture: &str| json!({ "scene": at("ball.rt"), "picture": at(picture), "language": "ru" });
        let right = checked(&order("right.png")).unwrap();
        assert_eq!(
            (&right["right"], &right["pictures"], &right["worst"]),
            (&true.into(), &2.into(), &Value::Null)
        );
        let flipped = checked(&order("flipped.png")).unwrap();
        assert_eq!(flipped["mistakes"][0]["key"], "flipped-top-to-bottom", "{flipped}");
        assert_eq!(flipped["size"], json!([32, 24]));
        let broken = checked(&json!({ "scene": at("right.png"), "picture": at("right.png") }));
        assert!(broken.is_err());
        let no_picture = checked(&json!({ "scene": "whitted", "picture": at("ball.rt") })).unwrap_err();
        assert!(no_picture.to_string().contains("ball.rt"), "{no_picture}");
        assert!(checked(&json!({ "scene": "whitted" })).unwrap_err().to_string().contains("picture"));
    }
}
