//! The color pipeline of ꟻLIP: what colors the eye can tell apart at this distance (section 4.1).

use super::color::{hunt_lab_from_linear, hyab, linear_from_ycxcz};
use crate::compare::plane::{Plane, kernel};
use crate::compare::too_little_memory;
use crate::picture::{Picture, SizeError};

/// Contrast sensitivity as sums of Gaussians a·√(π/b)·exp(−π² x²/b), x in degrees (table 1 of the paper): for
/// lightness, red–green, and blue–yellow, whose second Gaussian is the last.
const LIGHTNESS: (f64, f64) = (1.0, 0.0047);
const RED_GREEN: (f64, f64) = (1.0, 0.0053);
const BLUE_YELLOW: [(f64, f64); 2] = [(34.1, 0.04), (13.5, 0.025)];

/// The exponent of color differences, and the bend of the scale to 0…1 (section 4.1.4).
const EXPONENT: f64 = 0.7;
const BEND_AT: f64 = 0.4;
const BEND_TO: f64 = 0.95;

/// The difference of the filtered colors in each pixel, 0…1; the pictures are in YCxCz.
pub(super) fn color_difference(
    reference: &Picture,
    test: &Picture,
    density: f64,
) -> Result<Plane, SizeError> {
    let (reference, test) = (filtered(reference, density)?, filtered(test, density)?);
    let green = hunt_lab_from_linear([0.0, 1.0, 0.0]);
    let blue = hunt_lab_from_linear([0.0, 0.0, 1.0]);
    let largest = hyab(green, blue).powf(EXPONENT);
    let mut pairs = test.pixels().iter();
    Plane::of(&reference, |reference| {
        let test = pairs.next().unwrap_or(reference);
        let [reference, test] =
            [reference, test].map(|&color| hunt_lab_from_linear(linear_from_ycxcz(color)));
        spread(hyab(reference, test).powf(EXPONENT), largest) as f32
    })
}

/// Differences up to 0.4 of the largest take 0.95 of the scale.
fn spread(difference: f64, largest: f64) -> f64 {
    let bend = BEND_AT * largest;
    if difference < bend {
        BEND_TO / bend * difference
    } else {
        BEND_TO + (difference - bend) / (largest - bend) * (1.0 - BEND_TO)
    }
}

/// The pixels that the filters reach to each side: three standard deviations of the widest.
pub(super) fn radius(density: f64) -> usize {
    let widest = BLUE_YELLOW[0].1;
    let deviation = (widest / (2.0 * std::f64::consts::PI * std::f64::consts::PI)).sqrt();
    (3.0 * deviation * density).ceil() as usize
}

/// The picture as the eye resolves it.
fn filtered(picture: &Picture, density: f64) -> Result<Picture, SizeError> {
    let memory = || too_little_memory(picture);
    let pi_squared = std::f64::consts::PI * std::f64::consts::PI;
    let radius = radius(density);
    let bell = |b: f64| kernel(radius, |x| (-pi_squared * (x / density) * (x / density) / b).exp());
    // A Gaussian of the plane is the product of two of the line. What its weight is among others of the same channel,
    // its sum decides before it is normalized.
    let smooth = |plane: &Plane, terms: &[(f64, f64)]| -> Option<Plane> {
        let weights = terms.iter().map(|&(a, b)| {
            let sum: f64 = bell(b).iter().sum();
            a * (std::f64::consts::PI / b).sqrt() * sum * sum
        });
        let weights: Vec<f64> = weights.collect();
        let total: f64 = weights.iter().sum();
        let mut sum: Option<Plane> = None;
        for (&(_, b), weight) in terms.iter().zip(&weights) {
            let line = crate::compare::plane::normalized(&bell(b));
            let part = (weight / total) as f32;
            let scaled: Vec<f32> = line.iter().map(|value| value * part).collect();
            let term = plane.filtered(&line, &scaled)?;
            sum = Some(match sum {
                Some(sum) => sum.combine([&term], |sum, [term]| sum + term),
                None => term,
            });
        }
        sum
    };
    let lightness = smooth(&Plane::of(picture, |[y, _, _]| *y)?, &[LIGHTNESS]).ok_or_else(memory)?;
    let red_green = smooth(&Plane::of(picture, |[_, cx, _]| *cx)?, &[RED_GREEN]).ok_or_else(memory)?;
    let blue_yellow = smooth(&Plane::of(picture, |[_, _, cz]| *cz)?, &BLUE_YELLOW).ok_or_else(memory)?;
    let mut result = Picture::new(picture.width(), picture.height())?;
    let planes = lightness.values().iter().zip(red_green.values()).zip(blue_yellow.values());
    for (pixel, ((y, cx), cz)) in result.pixels_mut().iter_mut().zip(planes) {
        *pixel = [*y, *cx, *cz];
    }
    Ok(result)
}
