//! Exact answers in words and as JSON.

use std::fmt::Write as _;

use catoptric_scene::{Scene, quoted_name};
use glam::DVec3;
use serde_json::{Value, json};

use super::{ExactAnswer, ExactAnswers, ExactDeviation, Inapplicable};

impl ExactAnswers {
    pub(super) fn name_bodies(&mut self, scene: &Scene) {
        let mut places: Vec<usize> = self.answers.iter().flat_map(bodies_of).collect();
        places.extend(
            self.inapplicable.iter().flat_map(|reason| [reason.body()].into_iter().chain(reason.other())),
        );
        places.sort_unstable();
        places.dedup();
        let name = |place: usize| match scene.bodies.get(place) {
            Some(body) if !body.name.is_empty() => quoted_name(&body.name),
            Some(body) => format!("{} {}", body.body_shape().key(), place + 1),
            None => format!("body {}", place + 1),
        };
        self.names = places.into_iter().map(|place| (place, name(place))).collect();
    }

    /// The name in quotes, or shape and number, of a body that an answer is about.
    pub fn body(&self, body: usize) -> &str {
        let found = self.names.binary_search_by_key(&body, |entry| entry.0).ok();
        found.and_then(|place| self.names.get(place)).map_or("", |entry| entry.1.as_str())
    }

    /// The name in quotes, or the number, of a light, by its place in the scene.
    pub fn light(&self, light: usize) -> &str {
        self.lights.get(light).map_or("", String::as_str)
    }
}

fn bodies_of(answer: &ExactAnswer) -> Vec<usize> {
    match *answer {
        ExactAnswer::PlaneImage { mirror, body, .. }
        | ExactAnswer::SphereImage { mirror, body, .. }
        | ExactAnswer::ReflectionPoint { mirror, body, .. } => vec![mirror, body],
        ExactAnswer::Ring { mirrors: [first, second], body, .. } => vec![first, second, body],
        ExactAnswer::Focus { body, .. }
        | ExactAnswer::LensFocus { body, .. }
        | ExactAnswer::Highlight { body, .. } => vec![body],
        ExactAnswer::DishFocus { mirror, .. } => vec![mirror],
    }
}

/// The answers in words and numbers: plain text in English.
pub fn to_text(answers: &ExactAnswers) -> String {
    let mut text = String::new();
    for answer in &answers.answers {
        write_answer(&mut text, answers, answer);
    }
    for reason in &answers.inapplicable {
        let _ = writeln!(text, "{}", inapplicable(answers, *reason));
    }
    if answers.answers.is_empty() && answers.inapplicable.is_empty() {
        text.push_str(
            "There are no mirrors, lenses, glass balls or highlights here that have an exact answer.\n",
        );
    }
    if answers.is_cut {
        text.push_str("There are more bodies than were looked at.\n");
    }
    text
}

fn inapplicable(names: &ExactAnswers, reason: Inapplicable) -> String {
    let body = names.body(reason.body());
    let other = reason.other().map_or("", |other| names.body(other));
    match reason {
        Inapplicable::RoughMirror { .. } => format!("The mirror {body} is rough: it has no image points."),
        Inapplicable::CurvedMirror { .. } => {
            format!("The mirror {body} is neither flat nor a ball: the mirror equation does not apply.")
        }
        Inapplicable::OfParts { .. } => {
            format!("The body {body} is joined of parts: no formula here knows where it sends light.")
        }
        Inapplicable::ObjectInFocus { .. } => {
            format!("{other} stands in the focus of the mirror {body}: its image is infinitely far away.")
        }
        Inapplicable::RoughLens { .. } => format!("{body} is rough: it has no focal point."),
        Inapplicable::UnevenLens { .. } => {
            format!("{body} is not scaled evenly: the formula of a ball does not apply.")
        }
        Inapplicable::SharedLens { .. } => {
            format!("{body} and {other} overlap: the formula of a lens in air does not apply.")
        }
        Inapplicable::WeakLens { .. } => {
            format!("The index of {body} is near 1: it hardly bends light, and its focal point is far away.")
        }
        Inapplicable::FocusInside { .. } => {
            format!("The index of {body} is 2 or more: rays meet within it, before they leave it.")
        }
    }
}

fn write_answer(text: &mut String, names: &ExactAnswers, answer: &ExactAnswer) {
    let mut title = |title: String| {
        let _ = writeln!(text, "{title}");
    };
    match answer {
        ExactAnswer::PlaneImage { mirror, body, image, .. } => {
            title(format!("Image of {} in the plane mirror {}", names.body(*body), names.body(*mirror)));
            compare(text, "image", image);
        }
        ExactAnswer::SphereImage { mirror, body, image, .. } => {
            title(format!(
                "Image of {} in the spherical mirror {}, by the mirror equation",
                names.body(*body),
                names.body(*mirror)
            ));
            compare(text, "image", image);
        }
        ExactAnswer::ReflectionPoint { mirror, body, point, .. } => {
            title(format!(
                "Where the eye sees {} in the spherical mirror {} (Alhazen's problem)",
                names.body(*body),
                names.body(*mirror)
            ));
            compare(text, "point", point);
        }
        ExactAnswer::Focus { body, focal_length, paraxial, marginal } => {
            title(format!("Focal point of {}: {focal_length:.6} m from its center", names.body(*body)));
            compare(text, "paraxial", paraxial);
            if let Some(marginal) = marginal {
                compare(text, "marginal", marginal);
            }
        }
        ExactAnswer::LensFocus { body, focal_length, paraxial, marginal } => {
            title(format!("Focal point of the lens {}: focal length {focal_length:.6} m", names.body(*body)));
            compare(text, "paraxial", paraxial);
            if let Some(marginal) = marginal {
                compare(text, "marginal", marginal);
            }
        }
        ExactAnswer::DishFocus { mirror, profile, focal_length, is_virtual, near, marginal } => {
            let kind = if *is_virtual { "Virtual focus" } else { "Focus" };
            let (profile, mirror) = (profile.key(), names.body(*mirror));
            title(format!("{kind} of the {profile} mirror {mirror}: {focal_length:.6} m from its vertex"));
            compare(text, "near axis", near);
            compare(text, "marginal", marginal);
        }
        ExactAnswer::Highlight { body, light, point: at, off } => {
            title(format!("Highlight of {} on {}", names.light(*light), names.body(*body)));
            let off = off.map_or_else(
                || "the tracer meets another point".to_owned(),
                |off| format!("off by {:.1e}° in the tracer", off.to_degrees()),
            );
            let _ = writeln!(text, "  point      {}  {off}", point(*at));
        }
        ExactAnswer::Ring { mirrors: [first, second], body, angle, images, .. } => {
            title(format!(
                "{} of {} between {} and {}, which stand at {:.3}°",
                if images.len() == 1 { "1 image".to_owned() } else { format!("{} images", images.len()) },
                names.body(*body),
                names.body(*first),
                names.body(*second),
                angle.to_degrees()
            ));
            for image in images {
                let miss = image.miss.map_or_else(
                    || "not seen from here".to_owned(),
                    |miss| format!("the tracer passes it by {miss:.1e} m"),
                );
                let times = if image.reflections == 1 { "reflection " } else { "reflections" };
                let _ = writeln!(
                    text,
                    "  image      {}  {} {times}  {miss}",
                    point(image.position),
                    image.reflections
                );
            }
        }
    }
}

fn compare(text: &mut String, what: &str, compared: &ExactDeviation) {
    let found = match (compared.found, compared.difference()) {
        (Some(found), Some(difference)) => format!("tracer {}  difference {difference:.1e} m", point(found)),
        _ => "the tracer's rays go elsewhere".to_owned(),
    };
    let _ = writeln!(text, "  {what:<10} {}  {found}", point(compared.exact));
}

fn point(at: DVec3) -> String {
    // Minus nothing is nothing.
    let [x, y, z] = at.to_array().map(|part| (part * 1e6).round() / 1e6 + 0.0);
    format!("({x:.6}, {y:.6}, {z:.6})")
}

/// The answers as JSON, with the keys of the document of the command line.
pub fn to_json(answers: &ExactAnswers) -> Value {
    let list: Vec<Value> = answers.answers.iter().map(|answer| one(answers, answer)).collect();
    let inapplicable: Vec<Value> = answers
        .inapplicable
        .iter()
        .map(|reason| {
            let body = |place: usize| json!({ "index": place, "name": answers.body(place) });
            json!({ "kind": reason.key(), "body": body(reason.body()), "other": reason.other().map(body) })
        })
        .collect();
    json!({ "answers": list, "inapplicable": inapplicable, "cut": answers.is_cut })
}

fn one(names: &ExactAnswers, answer: &ExactAnswer) -> Value {
    let body = |place: &usize| json!({ "index": place, "name": names.body(*place) });
    match answer {
        ExactAnswer::PlaneImage { mirror, body: of, object, image } => json!({
            "kind": "plane-image", "mirror": body(mirror), "body": body(of),
            "object": object.to_array(), "image": compared(image),
        }),
        ExactAnswer::SphereImage { mirror, body: of, object, image } => json!({
            "kind": "sphere-image", "mirror": body(mirror), "body": body(of),
            "object": object.to_array(), "image": compared(image),
        }),
        ExactAnswer::ReflectionPoint { mirror, body: of, object, point } => json!({
            "kind": "reflection-point", "mirror": body(mirror), "body": body(of),
            "object": object.to_array(), "point": compared(point),
        }),
        ExactAnswer::Focus { body: of, focal_length, paraxial, marginal } => json!({
            "kind": "focus", "body": body(of), "focal_length": focal_length,
            "paraxial": compared(paraxial), "marginal": marginal.as_ref().map(compared),
        }),
        ExactAnswer::LensFocus { body: of, focal_length, paraxial, marginal } => json!({
            "kind": "lens-focus", "body": body(of), "focal_length": focal_length,
            "paraxial": compared(paraxial), "marginal": marginal.as_ref().map(compared),
        }),
        ExactAnswer::DishFocus { mirror, profile, focal_length, is_virtual, near, marginal } => json!({
            "kind": format!("{}-focus", profile.key()), "mirror": body(mirror), "focal_length": focal_length,
            "virtual": is_virtual, "near": compared(near), "marginal": compared(marginal),
        }),
        ExactAnswer::Highlight { body: of, light, point, off } => json!({
            "kind": "highlight", "body": body(of),
            "light": { "index": light, "name": names.light(*light) },
            "point": point.to_array(), "off_degrees": off.map(f64::to_degrees),
        }),
        ExactAnswer::Ring { mirrors: [first, second], body: of, object, angle, images } => {
            let images: Vec<Value> = images
                .iter()
                .map(|image| {
                    json!({
                        "position": image.position.to_array(),
                        "reflections": image.reflections,
                        "miss": image.miss,
                    })
                })
                .collect();
            json!({
                "kind": "ring", "mirrors": [body(first), body(second)], "body": body(of),
                "object": object.to_array(), "angle_degrees": angle.to_degrees(), "images": images,
            })
        }
    }
}

fn compared(compared: &ExactDeviation) -> Value {
    json!({
        "exact": compared.exact.to_array(),
        "found": compared.found.map(|found| found.to_array()),
        "difference": compared.difference(),
    })
}
