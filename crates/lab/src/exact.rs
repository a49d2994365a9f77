//! Exact answers: where images of mirrors, focal points and highlights must be, and where the tracer has them.
//!
//! Each is worked out in double precision from the laws of optics, and by the tracer with the bodies concerned alone,
//! so that nothing is in the way. The pictures that belong to them need not show them: an image may be hidden.

mod dishes;
mod geometry;
mod inapplicable;
mod lenses;
mod mirrors;
mod probe;
mod report;
mod spheres;
mod thick_lenses;

use catoptric_scene::{Body, Camera, DishProfile, Projection, Scene, Shape};
use glam::DVec3;

use geometry::Viewpoint;
pub use geometry::{
    alhazen, ball_crossing, ball_focal_length, lens_crossing, mirrored, ring_of_images, sphere_image,
};
pub use inapplicable::Inapplicable;
pub use report::{to_json, to_text};

/// An answer of optics, and the tracer's. Places of bodies and lights are those in the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum ExactAnswer {
    /// The virtual image of a body's center in a plane mirror: as far behind the mirror as the body is before it.
    PlaneImage {
        /// The mirror.
        mirror: usize,
        /// The body.
        body: usize,
        /// The body's center.
        object: DVec3,
        /// The image.
        image: ExactDeviation,
    },
    /// The images of a body's center in two plane mirrors.
    Ring {
        /// The mirrors.
        mirrors: [usize; 2],
        /// The body.
        body: usize,
        /// The body's center.
        object: DVec3,
        /// The angle between the mirrors, radians.
        angle: f64,
        /// All images.
        images: Vec<RingImage>,
    },
    /// The image of a body's center in a spherical mirror, for rays near the line through both centers.
    SphereImage {
        /// The mirror.
        mirror: usize,
        /// The body.
        body: usize,
        /// The body's center.
        object: DVec3,
        /// The image; behind the surface it is virtual.
        image: ExactDeviation,
    },
    /// The point of a spherical mirror where the eye sees a body's center (Alhazen's problem).
    ReflectionPoint {
        /// The mirror.
        mirror: usize,
        /// The body.
        body: usize,
        /// The body's center.
        object: DVec3,
        /// The point on the mirror.
        point: ExactDeviation,
    },
    /// Where a ball of glass gathers yellow light that comes along the line from the eye through its center.
    Focus {
        /// The ball.
        body: usize,
        /// The distance from its center for rays near that line, meters: n·R/(2(n − 1)).
        focal_length: f64,
        /// The focal point.
        paraxial: ExactDeviation,
        /// Where a ray [`MARGINAL`] radii from the line crosses it; `None` if it does so within the ball.
        marginal: Option<ExactDeviation>,
    },
    /// Where a lens gathers yellow light that comes along its axis from the side of the eye, or where that seems to come
    /// from.
    LensFocus {
        /// The lens.
        body: usize,
        /// Its focal length by the lensmaker's equation for thick lenses, meters; below 0 if it spreads light.
        focal_length: f64,
        /// The focal point, for rays near the axis.
        paraxial: ExactDeviation,
        /// Where a ray [`MARGINAL`] of the rim's radius from the axis crosses it, by Snell's law at both faces; `None` if
        /// it does not come through both.
        marginal: Option<ExactDeviation>,
    },
    /// The focus of a mirror that is a paraboloid of revolution or a spherical dish: light along the axis is mirrored to
    /// it or, by the outside, as if it came from it. No ray misses that of a paraboloid, near the axis or far; what a
    /// sphere mirrors crosses the axis the nearer to the vertex, the farther it came from the axis.
    DishFocus {
        /// The mirror.
        mirror: usize,
        /// Its curve.
        profile: DishProfile,
        /// The distance from the vertex, meters: R²/(4H) of a paraboloid with the radius R of the rim and the height H, half
        /// the radius of curvature of a sphere.
        focal_length: f64,
        /// Whether the light is mirrored by the outside, and the focus lies behind the mirror.
        is_virtual: bool,
        /// Where a ray a tenth of the rim's radius from the axis crosses it.
        near: ExactDeviation,
        /// Where a ray [`MARGINAL`] of the rim's radius from the axis crosses it.
        marginal: ExactDeviation,
    },
    /// The point of a body where the eye sees the middle of a light mirrored: the middle of its highlight.
    Highlight {
        /// The body.
        body: usize,
        /// The light.
        light: usize,
        /// The point.
        point: DVec3,
        /// The angle that the tracer has there between the mirrored light and the way to the eye, radians: 0 but for
        /// rounding. `None` if it finds another point or none.
        off: Option<f64>,
    },
}

impl ExactAnswer {
    /// Whether the tracer has an answer, too.
    pub fn is_found(&self) -> bool {
        match self {
            Self::PlaneImage { image, .. } | Self::SphereImage { image, .. } => image.found.is_some(),
            Self::ReflectionPoint { point, .. } => point.found.is_some(),
            Self::Focus { paraxial, marginal, .. } | Self::LensFocus { paraxial, marginal, .. } => {
                paraxial.found.or(marginal.as_ref().and_then(|marginal| marginal.found)).is_some()
            }
            Self::DishFocus { near, marginal, .. } => near.found.or(marginal.found).is_some(),
            Self::Highlight { off, .. } => off.is_some(),
            Self::Ring { images, .. } => images.iter().any(|image| image.miss.is_some()),
        }
    }
}

/// How far from the axis the marginal rays of [`ExactAnswer::Focus`], [`ExactAnswer::LensFocus`] and
/// [`ExactAnswer::DishFocus`] run, in radii.
pub const MARGINAL: f64 = 0.7;

/// A point by the laws of optics, and by the tracer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactDeviation {
    /// By the law, meters.
    pub exact: DVec3,
    /// By the tracer; `None` if its rays go elsewhere.
    pub found: Option<DVec3>,
}

impl ExactDeviation {
    /// How far apart they are, meters.
    pub fn difference(&self) -> Option<f64> {
        self.found.map(|found| found.distance(self.exact))
    }
}

/// An image of the ring between two plane mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingImage {
    /// Where it stands.
    pub position: DVec3,
    /// How many reflections make it.
    pub reflections: u32,
    /// How far the tracer's ray from the eye towards the image passes the body's center after its reflections, meters;
    /// `None` if the eye does not see this image, as the mirrors end.
    pub miss: Option<f64>,
}

/// The exact answers of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExactAnswers {
    /// The answers, in the order of kinds.
    pub answers: Vec<ExactAnswer>,
    /// What has no such answer though it seems to have one.
    pub inapplicable: Vec<Inapplicable>,
    /// What bodies and lights are called, by their place.
    names: Vec<(usize, String)>,
    lights: Vec<String>,
    /// Whether there are more mirrors, bodies, balls or highlights than were looked at.
    pub is_cut: bool,
}

/// What reflects less is no mirror to look into.
const LEAST_MIRROR: f64 = 0.25;

/// The most mirrors, bodies before them, and bodies with highlights that are examined.
const MOST: usize = 8;

/// The exact answers that a scene has, for the strongest of its mirrors and the first of its other bodies: those that
/// the tracer has an answer to as well.
pub fn answers(scene: &Scene) -> ExactAnswers {
    let mut answers = answers_for(scene, None);
    answers.answers.retain(ExactAnswer::is_found);
    answers
}

/// The exact answers for one body that is mirrored, focuses light or has a highlight, or for all. Answers that the
/// tracer cannot follow, because a mirror ends too soon, are included.
pub fn answers_for(scene: &Scene, body: Option<usize>) -> ExactAnswers {
    let setting = ExactSetup::new(scene, body);
    let mut found = AnswerCollector { answers: Vec::new(), inapplicable: setting.rough_and_curved.clone() };
    mirrors::answer(&setting, &mut found.answers);
    spheres::answer(&setting, &mut found);
    lenses::answer(&setting, &mut found);
    thick_lenses::answer(&setting, &mut found);
    dishes::answer(&setting, &mut found.answers);
    let lights = scene.lights.iter().enumerate().map(|(place, light)| match light.name.as_str() {
        "" => format!("light {}", place + 1),
        name => catoptric_scene::quoted_name(name),
    });
    let mut answers = ExactAnswers {
        answers: found.answers,
        inapplicable: found.inapplicable,
        names: Vec::new(),
        lights: lights.collect(),
        is_cut: setting.is_cut,
    };
    answers.name_bodies(scene);
    answers
}

/// Collects the answers while the scene is examined.
struct AnswerCollector {
    answers: Vec<ExactAnswer>,
    inapplicable: Vec<Inapplicable>,
}

/// The mirrors, lenses and bodies that answers are computed for.
struct ExactSetup<'a> {
    scene: &'a Scene,
    /// Smooth opaque mirrors, the strongest first.
    mirrors: Vec<PlacedBody<'a>>,
    /// Mirrors that no formula is for.
    rough_and_curved: Vec<Inapplicable>,
    /// Bodies that may be seen in them.
    objects: Vec<PlacedBody<'a>>,
    /// Transparent balls.
    lenses: Vec<PlacedBody<'a>>,
    /// Transparent lenses of two faces.
    thick_lenses: Vec<PlacedBody<'a>>,
    /// Parabolic mirrors.
    dishes: Vec<PlacedBody<'a>>,
    /// Bodies with a highlight.
    glossy: Vec<PlacedBody<'a>>,
    is_cut: bool,
}

/// A body with its place in the scene and its center.
#[derive(Clone, Copy)]
struct PlacedBody<'a> {
    index: usize,
    body: &'a Body,
    center: DVec3,
}

impl<'a> ExactSetup<'a> {
    fn new(scene: &'a Scene, only: Option<usize>) -> Self {
        let mut setting = Self {
            scene,
            mirrors: Vec::new(),
            rough_and_curved: Vec::new(),
            objects: Vec::new(),
            lenses: Vec::new(),
            thick_lenses: Vec::new(),
            dishes: Vec::new(),
            glossy: Vec::new(),
            is_cut: false,
        };
        let mut others = Vec::new();
        for (index, body) in scene.bodies.iter().enumerate().filter(|(_, body)| !body.hidden) {
            let Some(material) = scene.material(&body.material) else { continue };
            let place = PlacedBody { index, body, center: body.middle() };
            let is_meant = only.is_none_or(|only| only == index);
            let is_clear = material.lets_through().most > 0.0;
            let reflection = material.reflects().straight;
            if reflection >= LEAST_MIRROR && !is_clear {
                match Inapplicable::of_mirror(index, body, material) {
                    None => setting.mirrors.push(place),
                    Some(reason) => others.push(reason),
                }
            }
            let is_around = scene.camera.position.distance(place.center) < extent(body);
            if is_meant && body.shape != Shape::Plane && !is_around && reflection < LEAST_MIRROR {
                keep(&mut setting.objects, place, &mut setting.is_cut);
            }
            let is_lens = is_clear && material.ior().is_some_and(|ior| ior > 1.0);
            if is_meant && is_lens && thick_lenses::lens_of(body).is_some() {
                keep(&mut setting.thick_lenses, place, &mut setting.is_cut);
            } else if is_meant && is_lens && body.shape.is_compound() {
                others.push(Inapplicable::OfParts { body: index });
            }
            if is_meant && is_lens && matches!(body.shape, Shape::Sphere { .. }) {
                keep(&mut setting.lenses, place, &mut setting.is_cut);
            }
            if is_meant && dishes::is_mirror(body, material) {
                keep(&mut setting.dishes, place, &mut setting.is_cut);
            }
            if is_meant && material.has_highlight() && !is_around {
                keep(&mut setting.glossy, place, &mut setting.is_cut);
            }
        }
        // A mirror that was asked for itself is told about, and those that something stands before.
        others.retain(|reason| !setting.objects.is_empty() || only == Some(reason.body()));
        setting.is_cut |= others.len() > MOST;
        others.truncate(MOST);
        setting.rough_and_curved = others;
        let strength = |place: &PlacedBody<'_>| {
            scene.material(&place.body.material).map_or(0.0, |material| material.reflects().straight)
        };
        setting.mirrors.sort_by(|a, b| strength(b).total_cmp(&strength(a)));
        setting.is_cut |= setting.mirrors.len() > MOST;
        setting.mirrors.truncate(MOST);
        setting
    }

    /// The direction in which a parallel camera looks; `None` for a perspective one.
    fn parallel_view(&self) -> Option<DVec3> {
        let Camera { position, target, projection, .. } = self.scene.camera;
        matches!(projection, Projection::Parallel { .. }).then(|| (target - position).normalize_or_zero())
    }

    /// Where the picture is seen from.
    fn viewpoint(&self) -> Viewpoint {
        match self.parallel_view() {
            Some(view) => Viewpoint::Far(-view),
            None => Viewpoint::Near(self.scene.camera.position),
        }
    }

    /// Where the picture's ray towards a point begins, and where it goes; `None` if the point lies behind the window of
    /// a parallel camera.
    fn sight(&self, point: DVec3) -> Option<(DVec3, DVec3)> {
        let eye = self.scene.camera.position;
        let Some(view) = self.parallel_view() else { return Some((eye, point - eye)) };
        let depth = (point - eye).dot(view);
        (depth > 0.0).then(|| (point - depth * view, view))
    }
}

fn keep<'a>(places: &mut Vec<PlacedBody<'a>>, place: PlacedBody<'a>, is_cut: &mut bool) {
    if places.len() < MOST { places.push(place) } else { *is_cut = true }
}

/// The radius of a body that is a ball in the world too, meters.
fn radius(body: &Body) -> Option<f64> {
    let Shape::Sphere { radius } = body.shape else { return None };
    let scale = body.placement.scale.abs();
    let is_even = (scale.max_element() - scale.min_element()) <= 1e-12 * scale.max_element();
    is_even.then_some(radius * scale.x)
}

/// How far a body reaches at most from its middle, meters.
fn extent(body: &Body) -> f64 {
    let shape = body.sized_shape();
    if shape.is_compound() {
        let middle = body.middle();
        let corners = body.box_corners();
        return corners.map_or(f64::INFINITY, |corners| {
            corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max)
        });
    }
    let own = shape
        .ball(DVec3::ONE)
        .map_or(f64::INFINITY, |(center, radius)| center.distance(shape.middle()) + radius);
    own * body.placement.scale.abs().max_element()
}
