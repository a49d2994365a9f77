//! The ground grid: lines in the plane y = 0, cut where bodies stand before them.

#[cfg(test)]
mod tests;

use catoptric_scene::{Camera, Projection};
use catoptric_tracer::{RenderCamera, RenderScene};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::frame::{GridKind, GridLine};
use crate::request::GridSpec;

/// Lines of a kind to each side of the middle.
const LINES: i64 = 20;

/// The step of the lines is at most this share of the camera's distance, and more than a tenth of it.
const STEP_SHARE: f64 = 0.25;

/// Pieces of a line, pixels: visibility and fading are looked at once on each.
const PIECE: f64 = 12.0;

/// Levels of strength; pieces of a line with the same one are joined.
const LEVELS: f64 = 12.0;

/// Lines closer to each other than this fade into the distance, pixels.
const CROWDED: f64 = 8.0;

/// The step and the middle of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
struct GridMeasures {
    /// Between the lines, meters: a power of ten.
    step: f64,
    /// How far the step is on its way to the next power, 0…1.
    progress: f64,
    /// The middle, x and z.
    middle: DVec2,
}

impl GridMeasures {
    fn new(camera: &Camera) -> Option<Self> {
        let distance = match camera.projection {
            Projection::Perspective { .. } => camera.position.distance(camera.target),
            Projection::Parallel { height } => 2.0 * height,
        };
        let power = (STEP_SHARE * distance).log10();
        let middle = DVec2::new(camera.target.x, camera.target.z);
        let step = 10_f64.powf(power.floor());
        let possible = (-9.0..=12.0).contains(&power) && (middle / step).abs().max_element() < 1e12;
        possible.then_some(Self { step, progress: power - power.floor(), middle })
    }

    /// The strength of the line of this number. Nothing jumps where the step becomes ten times as large.
    fn strength(&self, index: i64) -> f64 {
        match index {
            index if index % 100 == 0 => 1.0,
            index if index % 10 == 0 => 1.0 - 0.5 * self.progress,
            _ => 0.5 * (1.0 - self.progress),
        }
    }

    /// How far from the middle the line of this number is drawn, meters.
    fn reach(&self, index: i64) -> f64 {
        LINES as f64 * self.step * if index % 10 == 0 { 10_f64.powf(self.progress) } else { 1.0 }
    }
}

/// A line of the grid on the ground.
#[derive(Clone, Copy, Debug)]
struct GroundLine {
    ends: [DVec3; 2],
    /// Towards the next line of its kind.
    next: DVec3,
    kind: GridKind,
    strength: f64,
    reach: f64,
}

fn lines(spec: GridSpec, measures: &GridMeasures) -> Vec<GroundLine> {
    let step = measures.step;
    let mut lines = Vec::new();
    // Lines along X have a place on Z, and the other way around.
    for (along, across, axis) in
        [(DVec3::X, DVec3::Z, GridKind::AxisX), (DVec3::Z, DVec3::X, GridKind::AxisZ)]
    {
        let [middle, place] =
            [along, across].map(|way| measures.middle.x * way.x + measures.middle.y * way.z);
        let mut add = |at: f64, kind: GridKind, strength: f64, reach: f64, next: f64| {
            let half = (reach * reach - (at - place) * (at - place)).max(0.0).sqrt();
            let ends = [middle - half, middle + half].map(|end| end * along + at * across);
            lines.push(GroundLine { ends, next: next * across, kind, strength, reach });
        };
        let center = (place / step).round() as i64;
        let every = |step: i64| {
            let first = center.div_euclid(step) - LINES;
            (first..=first + 2 * LINES + 1).map(move |number| number * step)
        };
        if spec.axes {
            add(0.0, axis, 1.0, measures.reach(0), step);
        }
        if spec.lines {
            let minor = every(1).filter(|index| index % 10 != 0);
            let major = every(10);
            for index in minor.chain(major).filter(|&index| !(spec.axes && index == 0)) {
                let kind = if index % 10 == 0 { GridKind::Major } else { GridKind::Minor };
                let next = if index % 10 == 0 { 10.0 * step } else { step };
                add(index as f64 * step, kind, measures.strength(index), measures.reach(index), next);
            }
        }
    }
    lines.retain(|line| line.ends[0] != line.ends[1]);
    lines
}

/// The visible pieces of the grid in a view of `size` pixels; traced on the current rayon pool.
pub(crate) fn trace(
    spec: GridSpec,
    camera: &Camera,
    view: &RenderCamera,
    render_scene: &RenderScene,
    size: DVec2,
) -> Vec<GridLine> {
    let Some(measures) = GridMeasures::new(camera) else { return Vec::new() };
    let near = 1e-3 * measures.step;
    let cutter =
        LineClipper { eye: camera.position, near, middle: measures.middle, view, render_scene, size };
    lines(spec, &measures).par_iter().flat_map_iter(|line| cutter.pieces(line)).collect()
}

/// Clips lines at the view and behind bodies.
struct LineClipper<'a> {
    eye: DVec3,
    /// Depth of what is too close to be drawn, meters.
    near: f64,
    middle: DVec2,
    view: &'a RenderCamera,
    render_scene: &'a RenderScene,
    size: DVec2,
}

/// A segment of a line on the screen; places on it are numbers 0…1.
struct ScreenSegment {
    ends: [DVec3; 2],
    pixels: [DVec2; 2],
    /// Reciprocal depths: they grow evenly along the screen. Equal ones for a parallel projection.
    nearness: [f64; 2],
}

impl ScreenSegment {
    fn pixel(&self, place: f64) -> DVec2 {
        self.pixels[0].lerp(self.pixels[1], place)
    }

    fn point(&self, place: f64) -> DVec3 {
        let [one, other] = [(1.0 - place) * self.nearness[0], place * self.nearness[1]];
        self.ends[0].lerp(self.ends[1], other / (one + other))
    }
}

impl LineClipper<'_> {
    fn pieces(&self, line: &GroundLine) -> Vec<GridLine> {
        let Some((line_on_screen, [first, last])) = self.clipped(line) else { return Vec::new() };
        let length = line_on_screen.pixel(first).distance(line_on_screen.pixel(last));
        let count = (length / PIECE).ceil().clamp(1.0, 2000.0);
        let place = |number: f64| first + (last - first) * number / count;
        let mut pieces: Vec<GridLine> = Vec::new();
        let mut from = place(0.0);
        let mut from_visible = self.is_visible(&line_on_screen, from);
        for number in 1..=count as u32 {
            let to = place(f64::from(number));
            let to_visible = self.is_visible(&line_on_screen, to);
            let visible = match (from_visible, to_visible) {
                (true, true) => Some([from, to]),
                (false, false) => None,
                (true, false) => Some([from, self.change(&line_on_screen, from, to)]),
                (false, true) => Some([self.change(&line_on_screen, to, from), to]),
            };
            if let Some(ends) = visible {
                let middle = line_on_screen.point(0.5 * (ends[0] + ends[1]));
                let strength = ((line.strength * self.fade(line, middle) * LEVELS).round() / LEVELS) as f32;
                let [from, to] = ends.map(|end| line_on_screen.pixel(end).as_vec2());
                match pieces.last_mut() {
                    Some(last) if last.to == from && last.strength == strength => last.to = to,
                    _ if strength > 0.0 => pieces.push(GridLine { from, to, kind: line.kind, strength }),
                    _ => {}
                }
            }
            (from, from_visible) = (to, to_visible);
        }
        pieces
    }

    /// The part of a line before the eye, and between which places on it the view shows it.
    fn clipped(&self, line: &GroundLine) -> Option<(ScreenSegment, [f64; 2])> {
        let forward = self.view.axes()[2];
        let [start, end] = line.ends.map(|end| (end - self.eye).dot(forward));
        let at_near = line.ends[0].lerp(line.ends[1], (self.near - start) / (end - start));
        let ends = match (start > self.near, end > self.near) {
            (true, true) => line.ends,
            (true, false) => [line.ends[0], at_near],
            (false, true) => [at_near, line.ends[1]],
            (false, false) => return None,
        };
        let [(from, near), (to, far)] =
            [self.view.project(ends[0], self.size)?, self.view.project(ends[1], self.size)?];
        let nearness = if self.view.eye().is_some() { [1.0 / near, 1.0 / far] } else { [1.0; 2] };
        // Liang, Barsky 1984.
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for (start, way, size) in [(from.x, to.x - from.x, self.size.x), (from.y, to.y - from.y, self.size.y)]
        {
            if way == 0.0 {
                if !(0.0..=size).contains(&start) {
                    return None;
                }
                continue;
            }
            let [one, other] = [-start / way, (size - start) / way];
            first = first.max(one.min(other));
            last = last.min(one.max(other));
        }
        (first < last).then_some((ScreenSegment { ends, pixels: [from, to], nearness }, [first, last]))
    }

    /// Whether nothing stands before the line here. The surface on which it lies does not hide it.
    fn is_visible(&self, line: &ScreenSegment, place: f64) -> bool {
        const CONTACT: f64 = 1e-3;
        let ray = self.view.ray(line.pixel(place), self.size);
        let origin = self.view.world_from_render(ray.origin);
        let way = (line.point(place) - origin).dot(ray.direction.as_dvec3());
        self.render_scene.closest_hit(&ray).is_none_or(|hit| f64::from(hit.hit.t) >= way * (1.0 - CONTACT))
    }

    /// Where between a visible place and a hidden one the line vanishes.
    fn change(&self, line: &ScreenSegment, mut visible: f64, mut hidden: f64) -> f64 {
        for _ in 0..6 {
            let middle = 0.5 * (visible + hidden);
            *(if self.is_visible(line, middle) { &mut visible } else { &mut hidden }) = middle;
        }
        visible
    }

    /// How much of a line's strength is left at a point of it.
    fn fade(&self, line: &GroundLine, point: DVec3) -> f64 {
        let away = DVec2::new(point.x, point.z).distance(self.middle) / line.reach;
        let by_distance = (1.0 - away * away).max(0.0);
        let pixels = |point| self.view.project(point, self.size).map(|(at, _)| at);
        let gap = match (pixels(point), pixels(point + 1e-3 * line.next)) {
            (Some(one), Some(other)) => 1e3 * one.distance(other),
            _ => f64::INFINITY,
        };
        by_distance * (gap / CROWDED).min(1.0)
    }
}
