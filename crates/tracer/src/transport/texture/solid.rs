//! Patterns that fill space, seen from a body.

use catoptric_scene::{PatternSpace, SolidKind, SolidTexture};
use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::body::{inverse_linear, is_diagonal, mul, rows, scale_plus};
use crate::geometry::canonical::CanonicalBody;
use crate::geometry::space::RenderSpace;
use crate::simd::vector::Vector;
use crate::simd::{Float32, MOST_LANES, Width, Word as _};
use crate::transport::color::linear_rgb;

/// A pattern in a body's frame: one of those that a material has within each other. They stand in a row, each before
/// those within it.
///
/// Only the parity of the cells counts, so the whole cells between the world's origin and the body's are counted once
/// in double precision; what is left for single precision is the part within the body, and a face that lies on a
/// border of cells keeps to one side of it wherever the body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SolidNode {
    kind: SolidKind,
    /// From the body's frame to cells, without the origin's whole cells.
    cells_from_body: [[f32; 3]; 3],
    /// Whether the cells lie along the axes of that frame.
    aligned: bool,
    offset: [f32; 3],
    /// Rings: how far their middle lies away along -x, in cells, if so far that single precision would blur them, else 0.
    far: f32,
    /// Parity of the origin's whole cells.
    odd_origin: bool,
    /// The second color.
    color: [f32; 3],
    /// The places in the row of the patterns that stand for the first and the second color; 0 for none.
    within: [u8; 2],
    /// Whose second color its first one is, by the place in the row plus 1; 0 if it is the material's color.
    first_of: u8,
    /// How many there are in the row, from the outermost on.
    count: u8,
}

impl SolidNode {
    /// A point on the border of two cells (a floor at y = 0) belongs to the one above.
    pub(crate) const BORDER: f32 = 1e-6;
    /// A middle of rings that is further away, in cells, is parted into whole rings and the rest: there, the radius in single
    /// precision would be off by 6⋅10⁻⁵ of a ring, and by more beyond.
    const FAR_RINGS: f64 = 1024.0;
    /// The most patterns that a material has: two within each, down to the deepest.
    pub(crate) const MOST: usize = (1 << SolidTexture::MAX_DEPTH) - 1;

    /// The patterns of a body in a scene's space of rays; whether the body is there [in double
    /// precision](crate::geometry::body::RenderBody::is_double).
    pub(crate) fn row(
        solid: &SolidTexture,
        body: &CanonicalBody,
        space: &RenderSpace,
        is_double: bool,
    ) -> Vec<Self> {
        let mut row = Vec::new();
        let in_space = PatternSpace::ALL.map(|of| pattern_from(of, body, space, is_double));
        add(solid, in_space, 0, &mut row);
        let count = row.len() as u8;
        if let Some(outermost) = row.first_mut() {
            outermost.count = count;
        }
        row
    }

    fn new(solid: &SolidTexture, space_from_body: &DAffine3, first_of: u8) -> Self {
        let placement = solid.placement().world_from_body();
        let cells_from_space = DAffine3::from_scale(DVec3::splat(solid.size.recip())) * placement.inverse();
        let mut transform = cells_from_space * *space_from_body;
        let radius = transform.translation.x.hypot(transform.translation.z);
        let is_far = solid.kind == SolidKind::Rings && radius > Self::FAR_RINGS;
        if is_far {
            // Rings do not change when they turn about their middle: now it lies in the direction -x.
            let (sin, cos) = (transform.translation.z / radius, transform.translation.x / radius);
            let turn = DMat3::from_cols(DVec3::new(cos, 0.0, -sin), DVec3::Y, DVec3::new(sin, 0.0, cos));
            transform = DAffine3 { matrix3: turn * transform.matrix3, translation: radius * DVec3::X };
        }
        let origin = transform.translation;
        // Near rings are counted from their middle.
        let whole = if solid.kind == SolidKind::Rings && !is_far { DVec3::ZERO } else { origin.floor() };
        let cells = if solid.kind == SolidKind::Stripes { whole.x } else { whole.element_sum() };
        let cells_from_body = rows(&transform.matrix3);
        Self {
            kind: solid.kind,
            cells_from_body,
            aligned: is_diagonal(&cells_from_body),
            offset: (origin - whole).as_vec3().to_array(),
            far: if is_far { whole.x as f32 } else { 0.0 },
            odd_origin: cells.rem_euclid(2.0) == 1.0,
            color: linear_rgb(solid.color),
            within: [0; 2],
            first_of,
            count: 1,
        }
    }

    /// The row of patterns that begins at this place of a list; none where there is none.
    pub(crate) fn row_at(solids: &[Self], place: u32) -> &[Self] {
        let row = solids.get(place as usize..).unwrap_or_default();
        row.get(..row.first().map_or(0, |outermost| usize::from(outermost.count))).unwrap_or_default()
    }

    /// Whether it is a checkerboard and nothing else.
    pub(crate) fn is_checker_alone(&self) -> bool {
        self.kind == SolidKind::Checker && self.count == 1
    }

    /// As the shaders read it: three rows with their offsets, the second color with the parity of the origin's whole
    /// cells, and kind, count, and the places in the row.
    pub(crate) fn rows(&self) -> [[f32; 4]; 6] {
        let Self { cells_from_body: [x, y, z], offset, far, odd_origin, color, .. } = *self;
        let border = if self.kind == SolidKind::Rings { 0.0 } else { Self::BORDER };
        let row = |[a, b, c]: [f32; 3], axis: usize| [a, b, c, offset[axis] + border];
        let [red, green, blue] = color;
        let [first, second] = self.within.map(f32::from);
        let kind = f32::from(self.kind as u8);
        [
            row(x, 0),
            row(y, 1),
            row(z, 2),
            [red, green, blue, f32::from(odd_origin)],
            [kind, f32::from(self.count), first, second],
            [f32::from(self.first_of), far, 0.0, 0.0],
        ]
    }

    /// A point in cells, but for the origin's whole ones; `border` is added to each.
    #[inline(always)]
    fn cells<R: Float32>(&self, point: Vector<R>, border: f32) -> Vector<R> {
        let offset = self.offset.map(|offset| offset + border);
        if self.aligned {
            let [a, b, c] = self.cells_from_body;
            scale_plus([a[0], b[1], c[2]], point, offset)
        } else {
            mul(&self.cells_from_body, point).plus_all(offset)
        }
    }

    /// How much of the second color a point has: one given in the body's frame, or for a body in double precision in the
    /// space of the rays; beyond 2²² cells, what single precision makes of that.
    #[inline(always)]
    fn second<R: Float32>(&self, point: Vector<R>) -> SecondColor<R> {
        /// 1.5·2²³ leaves no room for a fraction: what is added to it stands in the low bits of the sum.
        const ROUND: f32 = 12_582_912.0;
        let origin = ROUND + f32::from(self.odd_origin);
        let is_odd = match self.kind {
            SolidKind::Gradient => {
                let x = self.cells(point, Self::BORDER).x;
                return SecondColor::Share(x - x.floor());
            }
            SolidKind::Rings => {
                let cells = self.cells(point, 0.0);
                ((self.radius(cells) + Self::BORDER).floor() + origin).to_word().has(1)
            }
            SolidKind::Stripes => (self.cells(point, Self::BORDER).x.floor() + origin).to_word().has(1),
            SolidKind::Checker => {
                let cells = self.cells(point, Self::BORDER).map(R::floor);
                let x = (cells.x + origin).to_word();
                let y = (cells.y + ROUND).to_word();
                let z = (cells.z + ROUND).to_word();
                x.plus(y).plus(z).has(1)
            }
        };
        SecondColor::Where(is_odd)
    }

    /// How far from the middle of rings a point in cells is, but for the whole rings up to a far body.
    #[inline(always)]
    fn radius<R: Float32>(&self, Vector { x, z, .. }: Vector<R>) -> R {
        let across = z * z;
        if self.far == 0.0 {
            return x.times_plus(x, across).sqrt();
        }
        // √(q² + z²) - q, as it has no difference of near numbers, with q the whole way along x.
        let q = x + self.far;
        let whole = q.times_plus(q, across).sqrt();
        let beyond = R::select(q.gt(q.like(0.0)), across / (whole + q), whole - q);
        x + beyond
    }

    /// The share of the second color at a point.
    #[inline(always)]
    pub(crate) fn share<R: Float32>(&self, point: Vector<R>) -> R {
        match self.second(point) {
            SecondColor::Share(share) => share,
            SecondColor::Where(points) => R::select(points, point.x.like(1.0), point.x.like(0.0)),
        }
    }
}

/// The second color of points.
enum SecondColor<R: Float32> {
    /// Those that have it; the others have the first.
    Where(R::Mask),
    /// The share that each has of it.
    Share(R),
}

/// Adds a pattern and those within it to a row; returns its place there.
fn add(solid: &SolidTexture, in_space: [DAffine3; 2], first_of: u8, row: &mut Vec<SolidNode>) -> u8 {
    let place = row.len();
    let space_from_body = match solid.space {
        PatternSpace::World => &in_space[0],
        PatternSpace::Body => &in_space[1],
    };
    row.push(SolidNode::new(solid, space_from_body, first_of));
    let own = place as u8 + 1;
    let mut inner = |inner: &Option<Box<SolidTexture>>, first_of: u8| {
        // A scene that was not checked may have more.
        let inner = inner.as_ref().filter(|inner| row.len() + inner.all().len() <= SolidNode::MOST);
        inner.map_or(0, |inner| add(inner, in_space, first_of, row))
    };
    let within = [inner(&solid.first, first_of), inner(&solid.second, own)];
    if let Some(node) = row.get_mut(place) {
        node.within = within;
    }
    place as u8
}

/// The colors of a body whose patterns begin at this place of the list, at points as [`SolidNode::share`] has them;
/// `own` is the color of the material there.
#[inline(always)]
pub(crate) fn patterned<W: Width>(
    w: W,
    solids: &[SolidNode],
    place: u32,
    own: Vector<W::R>,
    point: Vector<W::R>,
) -> Vector<W::R> {
    let Some(outermost) = solids.get(place as usize) else { return own };
    if outermost.count > 1 {
        return nested::<W>(w, solids, place, own, point);
    }
    let second = Vector::splat(w.real(0.0), outermost.color);
    match outermost.second(point) {
        SecondColor::Share(share) => own.plus_times(second - own, share),
        SecondColor::Where(points) => Vector::select(points, second, own),
    }
}

/// [`patterned`] for patterns within patterns, one point after the other.
#[cold]
#[inline(never)]
fn nested<W: Width>(
    w: W,
    solids: &[SolidNode],
    place: u32,
    own: Vector<W::R>,
    point: Vector<W::R>,
) -> Vector<W::R> {
    let row = SolidNode::row_at(solids, place);
    let stored = |vector: Vector<W::R>| {
        [vector.x, vector.y, vector.z].map(|numbers| {
            let mut lanes = [0.0; MOST_LANES];
            numbers.store(&mut lanes);
            lanes
        })
    };
    let ([mut red, mut green, mut blue], [x, y, z]) = (stored(own), stored(point));
    for lane in 0..W::LANES {
        let point = Vector::new(x[lane], y[lane], z[lane]);
        [red[lane], green[lane], blue[lane]] = color_of(row, [red[lane], green[lane], blue[lane]], point);
    }
    Vector::new(w.load(&red), w.load(&green), w.load(&blue))
}

/// The color at a point: those of all patterns of a row by their shares.
fn color_of(row: &[SolidNode], own: [f32; 3], point: Vector<f32>) -> [f32; 3] {
    let mut shares = [0.0_f32; SolidNode::MOST];
    shares[0] = 1.0;
    let mut sum = [0.0; 3];
    for (place, node) in row.iter().enumerate() {
        let share = shares.get(place).copied().unwrap_or_default();
        if share == 0.0 {
            continue;
        }
        let second = node.share(point);
        let first_of = usize::from(node.first_of).checked_sub(1).and_then(|place| row.get(place));
        let colors = [first_of.map_or(own, |other| other.color), node.color];
        for ((share, within), color) in
            [share * (1.0 - second), share * second].into_iter().zip(node.within).zip(colors)
        {
            match shares.get_mut(usize::from(within)) {
                Some(inner) if within > 0 => *inner = share,
                _ => (0..3).for_each(|part| sum[part] += color[part] * share),
            }
        }
    }
    sum
}

/// From where points are known to the space of a pattern, meters.
fn pattern_from(
    of: PatternSpace,
    canonical: &CanonicalBody,
    space: &RenderSpace,
    is_double: bool,
) -> DAffine3 {
    let world_from_canonical = canonical.world_from_canonical;
    if is_double {
        // In the body's own frame single precision is too rough; in the space of the rays it is not.
        let world_from_render = DAffine3::from_translation(space.origin);
        return match of {
            PatternSpace::World => world_from_render,
            PatternSpace::Body => {
                let canonical_from_world = DAffine3::from_mat3(inverse_linear(&world_from_canonical.matrix3))
                    * DAffine3::from_translation(-world_from_canonical.translation);
                meters_from_canonical(&world_from_canonical) * canonical_from_world * world_from_render
            }
        };
    }
    // The frame of a plane may have been moved within it.
    let moved = if canonical.is_plane() { space.frame_near(canonical) } else { None };
    let (frame, shift) = moved.unwrap_or((world_from_canonical, DVec3::ZERO));
    match of {
        PatternSpace::World => frame,
        PatternSpace::Body => {
            meters_from_canonical(&world_from_canonical) * DAffine3::from_translation(shift)
        }
    }
}

/// From a body's frame to one in its place, along its axes, but in meters: what is left of its transform without rotation.
fn meters_from_canonical(world_from_canonical: &DAffine3) -> DAffine3 {
    let linear = world_from_canonical.matrix3;
    let sizes = DVec3::new(linear.x_axis.length(), linear.y_axis.length(), linear.z_axis.length());
    DAffine3::from_mat3(DMat3::from_diagonal(sizes))
}
