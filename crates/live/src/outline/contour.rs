//! The border of a region of the plane of which it can only be asked whether a point is inside.
//!
//! Marching squares (Lorensen, Cline 1987) on a lattice; crossings are found by halving and corners by refining.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;
use rayon::prelude::*;

use super::area::Area;

/// How exactly crossings are found, pixels.
const PRECISION: f64 = 0.04;

/// A point of a border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BorderPoint {
    /// On the border.
    pub(super) at: DVec2,
    /// Close by, inside.
    pub(super) inside: DVec2,
}

/// One line of a border.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    pub(super) points: Vec<BorderPoint>,
    /// False if it ends where the area does.
    pub(super) closed: bool,
}

/// The edge of the lattice that runs from the point (column, row) to the right or down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct LatticeEdge {
    row: usize,
    column: usize,
    down: bool,
}

/// All lines of the border of a region within an area, the inside on the same side of each.
pub(super) fn contours(area: &Area, is_inside: &(impl Fn(DVec2) -> bool + Sync)) -> Vec<Contour> {
    let lattice = Lattice::sample(area, is_inside);
    let steps = lattice.steps(is_inside);
    let edges: BTreeSet<LatticeEdge> = steps.iter().flat_map(|&(from, to)| [from, to]).collect();
    let edges: Vec<LatticeEdge> = edges.into_iter().collect();
    let crossings: BTreeMap<LatticeEdge, BorderPoint> =
        edges.into_par_iter().map(|edge| (edge, lattice.crossing(edge, is_inside))).collect();
    chains(&steps)
        .into_par_iter()
        .map(|(edges, closed)| {
            let points = edges.iter().filter_map(|edge| crossings.get(edge)).copied().collect();
            refined(&Contour { points, closed }, is_inside)
        })
        .collect()
}

/// The lattice over the area, with its points inside the region.
struct Lattice<'a> {
    area: &'a Area,
    rows: Vec<LatticeRow>,
}

/// A row of the lattice. Outside of its span nothing is inside and nothing is kept: most of the bounding box of a
/// slanted rod.
struct LatticeRow {
    start: usize,
    inside: Vec<bool>,
}

impl LatticeRow {
    fn end(&self) -> usize {
        self.start + self.inside.len()
    }
}

impl<'a> Lattice<'a> {
    fn sample(area: &'a Area, is_inside: &(impl Fn(DVec2) -> bool + Sync)) -> Self {
        let sample_row = |row: usize| {
            let span = area.span(row);
            let start = span.start;
            LatticeRow { start, inside: span.map(|column| is_inside(area.point(column, row))).collect() }
        };
        Self { area, rows: (0..area.rows()).into_par_iter().map(sample_row).collect() }
    }

    fn at(&self, column: usize, row: usize) -> bool {
        let Some(row) = self.rows.get(row) else { return false };
        // A column before the start wraps to one beyond the end.
        row.inside.get(column.wrapping_sub(row.start)).copied().unwrap_or(false)
    }

    /// The steps of the border through the cells, from edge to edge.
    fn steps(&self, is_inside: &impl Fn(DVec2) -> bool) -> Vec<(LatticeEdge, LatticeEdge)> {
        let mut steps = Vec::new();
        let last_column = self.area.columns().saturating_sub(1);
        for (row, (upper, lower)) in self.rows.iter().zip(self.rows.iter().skip(1)).enumerate() {
            let start = upper.start.min(lower.start).saturating_sub(1);
            let end = upper.end().max(lower.end()).min(last_column);
            for column in start..end {
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| self.at(column + x, row + y));
                if corners == [corners[0]; 4] {
                    continue;
                }
                let center =
                    || is_inside(0.5 * (self.area.point(column, row) + self.area.point(column + 1, row + 1)));
                let top = LatticeEdge { row, column, down: false };
                let left = LatticeEdge { row, column, down: true };
                let right = LatticeEdge { row, column: column + 1, down: true };
                let bottom = LatticeEdge { row: row + 1, column, down: false };
                let [first, second] = steps_of_cell(corners, center, [top, right, bottom, left]);
                steps.extend(first.into_iter().chain(second));
            }
        }
        steps
    }

    fn crossing(&self, edge: LatticeEdge, is_inside: &impl Fn(DVec2) -> bool) -> BorderPoint {
        let LatticeEdge { row, column, down } = edge;
        let ends = [
            self.area.point(column, row),
            self.area.point(column + usize::from(!down), row + usize::from(down)),
        ];
        let [inside, outside] = if self.at(column, row) { ends } else { [ends[1], ends[0]] };
        halved(inside, outside, is_inside)
    }
}

/// The border between a point inside and one outside.
fn halved(mut inside: DVec2, mut outside: DVec2, is_inside: &impl Fn(DVec2) -> bool) -> BorderPoint {
    // The count ends what the limits of precision would not.
    for _ in 0..32 {
        if inside.distance_squared(outside) <= PRECISION * PRECISION {
            break;
        }
        let middle = 0.5 * (inside + outside);
        *(if is_inside(middle) { &mut inside } else { &mut outside }) = middle;
    }
    BorderPoint { at: 0.5 * (inside + outside), inside }
}

/// The steps through one cell, whose corners are given clockwise from the upper left, as its edges are from the top.
/// A step (dx, dy) has the outside on the side of (dy, -dx).
fn steps_of_cell(
    corners: [bool; 4],
    center: impl Fn() -> bool,
    [top, right, bottom, left]: [LatticeEdge; 4],
) -> [Option<(LatticeEdge, LatticeEdge)>; 2] {
    let one = |from, to| [Some((from, to)), None];
    let two = |first, second| [Some(first), Some(second)];
    match corners.map(u8::from) {
        [1, 0, 0, 0] => one(top, left),
        [0, 1, 0, 0] => one(right, top),
        [0, 0, 1, 0] => one(bottom, right),
        [0, 0, 0, 1] => one(left, bottom),
        [1, 1, 0, 0] => one(right, left),
        [0, 1, 1, 0] => one(bottom, top),
        [0, 0, 1, 1] => one(left, right),
        [1, 0, 0, 1] => one(top, bottom),
        [0, 1, 1, 1] => one(left, top),
        [1, 0, 1, 1] => one(top, right),
        [1, 1, 0, 1] => one(right, bottom),
        [1, 1, 1, 0] => one(bottom, left),
        [1, 0, 1, 0] if center() => two((top, right), (bottom, left)),
        [1, 0, 1, 0] => two((top, left), (bottom, right)),
        [0, 1, 0, 1] if center() => two((left, top), (right, bottom)),
        [0, 1, 0, 1] => two((right, top), (left, bottom)),
        _ => [None, None],
    }
}

/// Joins steps to lines, and says of each whether it is closed.
fn chains(steps: &[(LatticeEdge, LatticeEdge)]) -> Vec<(Vec<LatticeEdge>, bool)> {
    let mut next: BTreeMap<LatticeEdge, LatticeEdge> = steps.iter().copied().collect();
    let ends: BTreeSet<LatticeEdge> = next.values().copied().collect();
    let open: Vec<LatticeEdge> = next.keys().filter(|start| !ends.contains(start)).copied().collect();
    let mut chains = Vec::new();
    let mut follow = |start: LatticeEdge, next: &mut BTreeMap<LatticeEdge, LatticeEdge>| {
        let mut chain = vec![start];
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            at = to;
            if at == start {
                return chains.push((chain, true));
            }
            chain.push(at);
        }
        chains.push((chain, false));
    };
    for start in open {
        follow(start, &mut next);
    }
    while let Some((&start, _)) = next.first_key_value() {
        follow(start, &mut next);
    }
    chains
}

/// Adds points where a straight piece would leave the border, as at corners.
fn refined(contour: &Contour, is_inside: &impl Fn(DVec2) -> bool) -> Contour {
    let count = contour.points.len();
    let pieces = if contour.closed { count } else { count.saturating_sub(1) };
    let mut points = Vec::with_capacity(count);
    let following = contour.points.iter().cycle().skip(1);
    for (index, (from, to)) in contour.points.iter().zip(following).enumerate() {
        points.push(*from);
        if index < pieces {
            refine(from.at, to.at, MAX_DEPTH, is_inside, &mut points);
        }
    }
    Contour { points, closed: contour.closed }
}

/// How often a piece is halved at most: a narrow tip is climbed step by step.
const MAX_DEPTH: u32 = 12;

/// Pieces shorter than this are not halved, pixels.
const SHORTEST: f64 = 0.2;

/// Adds the points that are missing between two.
///
/// The way of a corner off the chord is at most twice that of the border at the chord's middle, which is what is
/// measured.
fn refine(
    from: DVec2,
    to: DVec2,
    depth: u32,
    is_inside: &impl Fn(DVec2) -> bool,
    points: &mut Vec<BorderPoint>,
) {
    let chord = to - from;
    let length = chord.length();
    if depth == 0 || length < SHORTEST {
        return;
    }
    let outwards = DVec2::new(chord.y, -chord.x) / length;
    let middle = 0.5 * (from + to);
    let reach = 1.25 * PRECISION * outwards;
    let (low, high) = (is_inside(middle - reach), is_inside(middle + reach));
    if low && !high {
        return;
    }
    let (direction, wanted) = if low { (outwards, false) } else { (-outwards, true) };
    let Some(beyond) = search(middle, direction, wanted, is_inside) else { return };
    let before = middle - direction * reach.length();
    let found = if low { halved(before, beyond, is_inside) } else { halved(beyond, before, is_inside) };
    refine(from, found.at, depth - 1, is_inside, points);
    points.push(found);
    refine(found.at, to, depth - 1, is_inside, points);
}

/// The first of growing steps at which being inside is as wanted.
fn search(from: DVec2, direction: DVec2, wanted: bool, is_inside: &impl Fn(DVec2) -> bool) -> Option<DVec2> {
    (0..7).map(|step| from + 0.125 * f64::from(1 << step) * direction).find(|&at| is_inside(at) == wanted)
}

#[cfg(test)]
mod tests {
    use catoptric_scene::Shape;
    use glam::DVec3;

    use super::super::tests::one_body;
    use super::*;

    fn area(cell: f64) -> Area {
        Area::whole(DVec2::new(200.0, 100.0), cell)
    }

    #[test]
    fn the_lattice_of_a_thin_rod_across_a_large_view_is_small() {
        let size = DVec2::new(3840.0, 2160.0);
        for degrees in [0.0, 3.0, 29.0, 60.0, 88.0] {
            let shape = Shape::Cube { size: DVec3::new(6.0, 5e-4, 5e-4) };
            let (render_scene, area) = one_body(shape, DVec3::Y, DVec3::new(0.0, 0.0, degrees), size);
            let is_inside =
                |at: DVec2| render_scene.closest_hit(&render_scene.camera().ray(at, size)).is_some();
            let lattice = Lattice::sample(&area, &is_inside);
            let kept: usize = lattice.rows.iter().map(|row| row.inside.len()).sum();
            let whole = area.columns() * area.rows();
            assert!(kept < 200_000, "{kept} points of {whole} are kept at {degrees}°");
            assert!(lattice.rows.iter().any(|row| row.inside.contains(&true)));
        }
    }

    #[test]
    fn a_disc_has_one_closed_line_of_its_radius() {
        let center = DVec2::new(90.3, 47.7);
        for radius in [3.0, 20.0, 40.0] {
            let found = contours(&area(2.0), &|at| at.distance(center) <= radius);
            assert_eq!(found.len(), 1);
            assert!(found[0].closed);
            for point in &found[0].points {
                assert!((point.at.distance(center) - radius).abs() < PRECISION);
                assert!(point.inside.distance(center) <= radius && point.inside.distance(point.at) < 0.1);
            }
            let length: f64 = found[0]
                .points
                .iter()
                .zip(found[0].points.iter().cycle().skip(1))
                .map(|(one, other)| one.at.distance(other.at))
                .sum();
            assert!((length / (std::f64::consts::TAU * radius) - 1.0).abs() < 0.02, "{length}");
        }
    }

    #[test]
    fn corners_are_found() {
        let corner = |at: DVec2| at.x >= 50.7 && at.x <= 120.1 && at.y >= 20.4 && at.y <= 77.3;
        let found = contours(&area(4.0), &corner);
        assert_eq!(found.len(), 1);
        for (x, y) in [(50.7, 20.4), (50.7, 77.3), (120.1, 20.4), (120.1, 77.3)] {
            let near = |point: &BorderPoint| point.at.distance(DVec2::new(x, y));
            let nearest = found[0].points.iter().map(near).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.2, "({x}, {y}) is missed by {nearest}");
        }
    }

    #[test]
    fn what_the_area_cuts_stays_open_and_what_fills_it_has_no_border() {
        let found = contours(&area(4.0), &|at| at.y > 33.3);
        assert_eq!(found.len(), 1);
        let line = &found[0];
        assert!(!line.closed && line.points.iter().all(|point| (point.at.y - 33.3).abs() < PRECISION));
        let [first, last] = [line.points[0].at.x, line.points[line.points.len() - 1].at.x];
        assert_eq!((first.min(last), first.max(last)), (0.0, 200.0));
        assert_eq!(contours(&area(4.0), &|_| true), []);
        assert_eq!(contours(&area(4.0), &|_| false), []);
    }

    #[test]
    fn regions_that_meet_at_a_corner_and_holes_have_lines_of_their_own() {
        let checkers = |at: DVec2| (at.x < 101.0) != (at.y < 51.0);
        assert_eq!(contours(&area(4.0), &checkers).len(), 2);
        let center = DVec2::new(100.0, 50.0);
        let ring = contours(&area(4.0), &|at| (20.0..30.0).contains(&at.distance(center)));
        assert_eq!(ring.iter().map(|line| line.closed).collect::<Vec<_>>(), [true, true]);
    }
}
