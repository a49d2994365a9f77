//! Where a line crosses a body, by the formulas of any textbook, in double precision: the quadratic as it stands, and
//! every candidate checked against the shape's extent. Slow and plain, and independent of the tracer.

use catoptric_scene::Shape;
use glam::{DVec3, dvec3};

/// A crossing: the line's parameter and the outward unit normal.
pub(crate) type Crossing = (f64, DVec3);

/// The crossings of the line `o + t·d` with the surface of `shape` in its own frame, in order of t: none, one (plane)
/// or two.
pub(crate) fn crossings(shape: &Shape, o: DVec3, d: DVec3) -> Vec<Crossing> {
    let mut all = match *shape {
        Shape::Sphere { radius } => {
            let roots = quadratic(d.dot(d), 2.0 * o.dot(d), o.dot(o) - radius * radius);
            roots.into_iter().map(|t| (t, (o + t * d) / radius)).collect()
        }
        Shape::Cube { size } => cube(0.5 * size, o, d),
        Shape::Cylinder { radius, height } => frustum(radius, radius, height, o, d),
        Shape::Cone { radius, top_radius, height } => frustum(radius, top_radius, height, o, d),
        Shape::Paraboloid { radius, depth } => paraboloid(radius, depth.height(radius), o, d),
        Shape::Plane if d.y == 0.0 => Vec::new(),
        Shape::Plane => vec![(-o.y / d.y, DVec3::Y)],
        Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } | Shape::Group => {
            unreachable!("compound bodies are asked part by part")
        }
    };
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    if all.len() > 2 {
        // Through an edge or a rim the same point is found on both faces.
        all = vec![all[0], all[all.len() - 1]];
    }
    all
}

/// The first and last parameter of the line in a bounded shape.
pub(crate) fn span(shape: &Shape, o: DVec3, d: DVec3) -> Option<(f64, f64)> {
    let all = crossings(shape, o, d);
    Some((all.first()?.0, all.last()?.0))
}

/// A function that is negative inside the shape, positive outside, and about the distance near the surface.
pub(crate) fn implicit(shape: &Shape, p: DVec3) -> f64 {
    match *shape {
        Shape::Sphere { radius } => p.length() - radius,
        Shape::Cube { size } => (p.abs() - 0.5 * size).max_element(),
        Shape::Cylinder { radius, height } => frustum_implicit(radius, radius, height, p),
        Shape::Cone { radius, top_radius, height } => frustum_implicit(radius, top_radius, height, p),
        Shape::Paraboloid { radius, depth } => {
            let height = depth.height(radius);
            let level = (p.x * p.x + p.z * p.z) / (radius * radius) - p.y / height;
            let slope = dvec3(2.0 * p.x, 0.0, 2.0 * p.z) / (radius * radius) - DVec3::Y / height;
            (level / slope.length()).max(p.y - height)
        }
        Shape::Plane => p.y,
        Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } | Shape::Group => {
            unreachable!("compound bodies are asked part by part")
        }
    }
}

/// The real roots of a·t² + b·t + c.
fn quadratic(a: f64, b: f64, c: f64) -> Vec<f64> {
    if a == 0.0 {
        return if b == 0.0 { Vec::new() } else { vec![-c / b] };
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return Vec::new();
    }
    let root = discriminant.sqrt();
    vec![(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]
}

/// What rounding may put a point on an edge beside its face.
fn edge(o: DVec3) -> f64 {
    1e-14 * (1.0 + o.length())
}

fn cube(half: DVec3, o: DVec3, d: DVec3) -> Vec<Crossing> {
    let mut all = Vec::new();
    let edge = edge(o);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let t = (side * half[axis] - o[axis]) / d[axis];
            let at = o + t * d;
            let others_inside = (0..3).all(|other| other == axis || at[other].abs() <= half[other] + edge);
            if t.is_finite() && others_inside {
                let mut normal = DVec3::ZERO;
                normal[axis] = side;
                all.push((t, normal));
            }
        }
    }
    all
}

fn frustum(base: f64, top: f64, height: f64, o: DVec3, d: DVec3) -> Vec<Crossing> {
    let edge = edge(o);
    let slope = (top - base) / height;
    let (r, dr) = (base + slope * o.y, slope * d.y);
    let roots = quadratic(
        d.x * d.x + d.z * d.z - dr * dr,
        2.0 * (o.x * d.x + o.z * d.z - r * dr),
        o.x * o.x + o.z * o.z - r * r,
    );
    let mut all = Vec::new();
    for t in roots {
        let at = o + t * d;
        if (-edge..=height + edge).contains(&at.y) {
            let around = DVec3::new(at.x, 0.0, at.z).normalize_or_zero();
            all.push((t, (around - slope * DVec3::Y).normalize_or(DVec3::Y)));
        }
    }
    for (y, radius, normal) in [(0.0, base, DVec3::NEG_Y), (height, top, DVec3::Y)] {
        let t = (y - o.y) / d.y;
        let at = o + t * d;
        if t.is_finite() && at.x.hypot(at.z) <= radius + edge {
            all.push((t, normal));
        }
    }
    all
}

fn paraboloid(radius: f64, height: f64, o: DVec3, d: DVec3) -> Vec<Crossing> {
    let edge = edge(o);
    let (across, along) = (1.0 / (radius * radius), 1.0 / height);
    let roots = quadratic(
        across * (d.x * d.x + d.z * d.z),
        2.0 * across * (o.x * d.x + o.z * d.z) - along * d.y,
        across * (o.x * o.x + o.z * o.z) - along * o.y,
    );
    let mut all = Vec::new();
    for t in roots {
        let at = o + t * d;
        if at.y <= height + edge {
            all.push((t, dvec3(2.0 * across * at.x, -along, 2.0 * across * at.z).normalize()));
        }
    }
    let t = (height - o.y) / d.y;
    let at = o + t * d;
    if t.is_finite() && at.x.hypot(at.z) <= radius + edge {
        all.push((t, DVec3::Y));
    }
    all
}

fn frustum_implicit(base: f64, top: f64, height: f64, p: DVec3) -> f64 {
    let slope = (top - base) / height;
    let side = (p.x.hypot(p.z) - (base + slope * p.y)) / (1.0 + slope * slope).sqrt();
    side.max(-p.y).max(p.y - height)
}
