//! What is worth knowing of a scene, though nothing is wrong with it.

use catoptric_lab::depth::{ALLOWED_LOSS, DepthBound, DepthMeasure, Excess, ExcessKind, excesses};
use catoptric_scene::Scene;
use catoptric_tracer::Stage;

/// The most notes on one scene.
const MOST: usize = 10;

/// Notes on a scene, a line each: materials that send on more light than they get, and mirrors that need more
/// generations.
pub(crate) fn on_scene(name: &str, scene: &Scene) -> String {
    let mut notes: Vec<String> = excesses(scene).iter().map(of_excess).collect();
    if let Ok(stage) = Stage::prepare(scene) {
        notes.extend(of_bound(scene, &DepthBound::of(scene, &stage)));
    }
    let more = notes.len().saturating_sub(MOST);
    notes.truncate(MOST);
    if more > 0 {
        notes.push(format!("and {more} more"));
    }
    notes.iter().map(|note| format!("{name}: note: {note}\n")).collect()
}

fn of_excess(excess: &Excess) -> String {
    let name =
        excess.name.as_ref().map_or_else(|| "a body's own material".to_owned(), |name| format!("\"{name}\""));
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
        Some(body) if !body.name.is_empty() => format!("\"{}\"", body.name),
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
