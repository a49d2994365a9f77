//! Notes about a scene in which nothing is wrong.

use catoptric_lab::depth::{ALLOWED_LOSS, DepthBound, DepthMeasure, Excess, ExcessKind, excesses};
use catoptric_lab::work::RayEstimate;
use catoptric_scene::{Scene, quoted_name};
use catoptric_tracer::{Control, RenderSettings, Stage};
use glam::UVec2;

/// The most notes on one scene.
const MOST: usize = 10;

/// Notes on a scene, a line each: materials that send on more light than they get, mirrors that need more generations, and
/// trees that have very many rays.
pub(crate) fn on_scene(name: &str, scene: &Scene) -> String {
    let mut notes: Vec<String> = excesses(scene).iter().map(of_excess).collect();
    if let Ok(stage) = Stage::prepare(scene) {
        notes.extend(of_bound(scene, &DepthBound::of(scene, &stage)));
        let work = RayForecast::of(&stage, RenderSettings { width: 1280, height: 720, samples: 1 });
        notes.extend(work.and_then(|work| work.warning));
        notes.extend(stage.target_beside(scene).map(of_target));
    }
    let more = notes.len().saturating_sub(MOST);
    notes.truncate(MOST);
    if more > 0 {
        notes.push(format!("and {more} more"));
    }
    notes.iter().map(|note| format!("{name}: note: {note}\n")).collect()
}

/// The rays of a picture, as far as they are known before it is traced.
pub(crate) struct RayForecast {
    /// About so many, of all kinds.
    pub(crate) rays: f64,
    /// What to say of them, if they are very many.
    pub(crate) warning: Option<String>,
}

impl RayForecast {
    /// Estimates the rays on the threads of the current rayon pool; `None` where no tree forks: then it has no more rays
    /// than generations, but for those to lights.
    pub(crate) fn of(stage: &Stage, settings: RenderSettings) -> Option<Self> {
        if !stage.forks() {
            return None;
        }
        let size = UVec2::new(settings.width, settings.height);
        let estimate = RayEstimate::of(stage, stage.camera(), size, &Control::default()).ok()?;
        let pixels = u64::from(size.x) * u64::from(size.y);
        let rays = estimate.of_picture(pixels, settings.samples);
        let warning = if estimate.is_worth_a_warning() { warning(stage, settings, &estimate) } else { None };
        Some(Self { rays, warning })
    }
}

/// What to say of very many rays.
fn warning(stage: &Stage, settings: RenderSettings, estimate: &RayEstimate) -> Option<String> {
    let RenderSettings { width, height, samples } = settings;
    let pixels = u64::from(width) * u64::from(height);
    let mut warning = format!(
        "with {} generations and the threshold {} a picture of {width}x{height} takes about {} rays, {} for each pixel",
        stage.generations(),
        stage.threshold(),
        magnitude(estimate.of_picture(pixels, samples)),
        magnitude(estimate.of_picture(1, samples))
    );
    let threshold = RayEstimate::ADVISED_THRESHOLD;
    if f64::from(stage.threshold()) < threshold {
        let limits = (stage.generations(), threshold as f32);
        let size = UVec2::new(width, height);
        let with = RayEstimate::within(stage, stage.camera(), size, limits, &Control::default()).ok()?;
        warning += &format!(
            "; `threshold = {threshold}` would take {}",
            magnitude(with.of_picture(pixels, samples))
        );
    }
    Some(warning)
}

/// A large number in two digits, as one reads it.
fn magnitude(number: f64) -> String {
    const UNITS: [(f64, &str); 3] = [(1e9, " billion"), (1e6, " million"), (1e3, " thousand")];
    let two_digits = |number: f64| {
        let unit = 10.0_f64.powf(number.abs().max(1.0).log10().floor() - 1.0);
        (number / unit).round() * unit
    };
    if number >= 1e15 {
        return format!("{number:.1e}");
    }
    let number = two_digits(number);
    match UNITS.iter().find(|(unit, _)| number >= *unit) {
        Some((unit, name)) => format!("{}{name}", rounded(number / unit)),
        None => rounded(number),
    }
}

fn of_target(distance: f64) -> String {
    let distance = if distance < 1e5 { rounded(distance) } else { format!("{distance:.1e}") };
    format!(
        "the camera's target is {distance} m away from the nearest body: edges may be off by parts of a pixel; put the \
         target where something is seen"
    )
}

fn of_excess(excess: &Excess) -> String {
    let name =
        excess.name.as_ref().map_or_else(|| "a body's own material".to_owned(), |name| quoted_name(name));
    let amount = rounded(excess.amount);
    match excess.kind {
        ExcessKind::Surface { channel, diffuse, reflection, transmission } => format!(
            "{name} sends on {amount} times the light it gets, in {}: diffuse {} + reflection {} + transmission {}",
            ["red", "green", "blue"].get(channel).unwrap_or(&"one channel"),
            rounded(diffuse),
            rounded(reflection),
            rounded(transmission)
        ),
        ExcessKind::Highlight => {
            format!(
                "{name}: its highlight sends on {amount} times the light it gets, 2 specular / (shininess + 2)"
            )
        }
    }
}

fn of_bound(scene: &Scene, bound: &DepthBound) -> Option<String> {
    let enough = bound.generations.filter(|&enough| enough > scene.tracing.generations)?;
    let name = |place: &usize| match scene.bodies.get(*place) {
        Some(body) if !body.name.is_empty() => quoted_name(&body.name),
        _ => format!("body {}", place + 1),
    };
    let cycle: Vec<String> = bound.cycle.iter().map(name).collect();
    Some(format!(
        "{} may pass on {} of the light from each generation to the next: {enough} generations would surely leave out \
         less than 1/512, the scene has {}",
        cycle.join(" and "),
        rounded(bound.factor),
        scene.tracing.generations
    ))
}

/// What a render says of the generations it had.
pub(crate) fn on_depth(measure: &DepthMeasure, limit: u32) -> String {
    let lost =
        (limit as usize).checked_sub(1).and_then(|place| measure.losses.get(place)).copied().unwrap_or(0.0);
    let more = if measure.is_complete { "" } else { " or more" };
    if lost >= ALLOWED_LOSS {
        format!(
            "up to {} of light is missing in a pixel behind {limit} generations; {}{more} would leave out less than 1/512",
            rounded(lost),
            measure.generations
        )
    } else {
        format!("{}{more} generations would do: less than 1/512 of light is missing", measure.generations)
    }
}

/// To four places, without needless zeros.
fn rounded(number: f64) -> String {
    format!("{}", (number * 1e4).round() / 1e4)
}
