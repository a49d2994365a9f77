//! The tree of one sample, with the sums of its branches.

use catoptric_tracer::{BranchOutcome, RayKind, RayRecord, SurfaceRecord};
use glam::{DVec2, DVec3, Vec3};

use super::sum::ExactSum;

/// The relation of a ray to its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NodeKind {
    /// From the eye.
    Primary,
    /// Mirrored, with the weight k_r.
    Reflected,
    /// All light mirrored inside a denser medium, with the weight 1.
    TotallyReflected,
    /// Bent into or out of a transparent body, with the weight k_t·τ.
    Refracted,
}

impl NodeKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Primary, Self::Reflected, Self::TotallyReflected, Self::Refracted];

    /// The kind's name in JSON: `primary`, `reflected`, `totally-reflected` or `refracted`.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Reflected => "reflected",
            Self::TotallyReflected => "totally-reflected",
            Self::Refracted => "refracted",
        }
    }
}

/// A ray of the tree, and what grows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The ray with its numbers, as the renderer has them. Places of rays in it are places in [`RayTree::nodes`].
    pub ray: RayRecord,
    /// What it is to the ray before.
    pub kind: NodeKind,
    /// The coefficient between the ray before and this one: k_r, 1 or k_t·τ, or what Fresnel's formulas give; 1 for the
    /// primary ray.
    pub coefficient: Vec3,
    /// The rays that go on from its end, the reflected one first.
    pub children: Vec<usize>,
    /// What it adds to the pixel together with all that grows from it: the exact sum of [`RayRecord::light`], rounded
    /// once to double precision.
    pub brings: DVec3,
    /// The light that comes along this ray: its local terms, and the light of its children times their coefficients.
    pub radiance: DVec3,
    /// Between the ray and the normal where it ends, radians, 0 to π/2.
    pub incidence: Option<f64>,
    /// Between the refracted ray and the normal, radians; `None` without refraction.
    pub refraction: Option<f64>,
}

impl Node {
    /// How the surface at its end answers, if it meets one.
    pub fn answer(&self) -> Option<&SurfaceRecord> {
        self.ray.answer.as_ref()
    }

    /// The rays that white light was split into at its end, by rising wavelength, if it was.
    pub fn waves(&self, tree: &RayTree) -> Option<Vec<usize>> {
        let is_wave = |child: &usize| {
            let child = tree.nodes.get(*child);
            child.is_some_and(|child| child.kind == NodeKind::Refracted && child.ray.wavelength.is_some())
        };
        let waves: Vec<usize> = self.children.iter().copied().filter(is_wave).collect();
        (self.ray.wavelength.is_none() && !waves.is_empty()).then_some(waves)
    }

    /// Every body that has to do with it: met, flown in, or in the way of its lights.
    pub(super) fn bodies(&self) -> impl Iterator<Item = (usize, Option<usize>)> {
        let lights = self.answer().into_iter().flat_map(|answer| &answer.lights);
        let crossings = lights.filter_map(|light| light.shadow.as_ref()).flat_map(|shadow| &shadow.crossings);
        let met = self.ray.hit.map(|hit| (hit.body, hit.part));
        let media = self.ray.media.iter().map(|body| (*body, None));
        let contact = self.answer().and_then(SurfaceRecord::contact);
        let joined = contact.into_iter().flat_map(|contact| contact.bodies).map(|body| (body, None));
        let crossed = crossings.flat_map(|crossing| {
            [(crossing.body, crossing.part)].into_iter().chain(crossing.into.map(|body| (body, None)))
        });
        met.into_iter().chain(media).chain(joined).chain(crossed)
    }

    /// The largest channel of its weight.
    pub fn largest_weight(&self) -> f32 {
        self.ray.weight.max_element()
    }
}

/// All rays of one sample of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct RayTree {
    /// The sample's number, from 0.
    pub sample: u32,
    /// Where it lies in the pixel, 0 to 1, right and down from the upper left corner.
    pub offset: DVec2,
    /// The rays, each after its parent, the whole reflected branch of a hit before the refracted one. The first is the
    /// primary ray.
    pub nodes: Vec<Node>,
    /// The light of the sample: the exact sum, rounded once to single precision.
    pub light: Vec3,
    /// How many rays the renderer follows that are not here, not counting those that grow from them.
    pub left_out: usize,
}

impl RayTree {
    /// The tree, and whether the renderer comes to its light in whatever order it adds.
    pub(super) fn new(sample: u32, offset: DVec2, rays: Vec<RayRecord>) -> (Self, bool) {
        let mut nodes: Vec<Node> = Vec::with_capacity(rays.len());
        for ray in rays {
            let place = nodes.len();
            let (kind, coefficient) = match ray.parent.and_then(|parent| nodes.get_mut(parent)) {
                Some(parent) => {
                    parent.children.push(place);
                    relation(&ray, parent)
                }
                None => (NodeKind::Primary, Vec3::ONE),
            };
            nodes.push(Node::new(ray, kind, coefficient));
        }
        let left_out = nodes.iter().filter_map(Node::answer).flat_map(branches);
        let left_out = left_out.filter(|fate| *fate == BranchOutcome::LeftOut).count();
        let total = sum_up(&mut nodes);
        let light = Vec3::from(total.each_ref().map(|sum| sum.value() as f32));
        (Self { sample, offset, nodes, light, left_out }, total.iter().all(ExactSum::is_certain))
    }

    /// The exact sum of the light of all its rays, rounded to double precision: what the primary ray brings.
    pub fn sum(&self) -> DVec3 {
        self.nodes.first().map_or(DVec3::ZERO, |root| root.brings)
    }

    /// The last generation that any ray has.
    pub fn generations(&self) -> u32 {
        self.nodes.iter().map(|node| node.ray.generation).max().unwrap_or(0)
    }

    /// How many shadow rays were sent.
    pub fn shadow_rays(&self) -> usize {
        let answers = self.nodes.iter().filter_map(Node::answer);
        answers.flat_map(|answer| &answer.lights).filter(|light| light.shadow.is_some()).count()
    }
}

fn branches(answer: &SurfaceRecord) -> [BranchOutcome; 2] {
    [answer.reflected.fate, answer.refracted.fate]
}

fn relation(ray: &RayRecord, parent: &Node) -> (NodeKind, Vec3) {
    let Some(answer) = parent.answer() else { return (NodeKind::Primary, Vec3::ONE) };
    match ray.kind {
        RayKind::Primary => (NodeKind::Primary, Vec3::ONE),
        RayKind::Refracted => (NodeKind::Refracted, ray.coefficient),
        RayKind::Reflected if answer.interface.is_some_and(|interface| interface.is_total) => {
            (NodeKind::TotallyReflected, ray.coefficient)
        }
        RayKind::Reflected => (NodeKind::Reflected, ray.coefficient),
    }
}

impl Node {
    fn new(ray: RayRecord, kind: NodeKind, coefficient: Vec3) -> Self {
        let incidence = ray.hit.map(|hit| {
            let direction = Vec3::from(ray.ray.direction).as_dvec3();
            let normal = hit.normal.as_dvec3();
            // The arc tangent keeps its digits where the arc cosine loses them, near 0.
            direction.cross(normal).length().atan2(-direction.dot(normal))
        });
        let interface = ray.answer.as_ref().and_then(|answer| answer.interface);
        let refraction = incidence.zip(interface).filter(|(_, interface)| !interface.is_total);
        let refraction = refraction.map(|(incidence, interface)| {
            (f64::from(interface.ratio) * incidence.sin()).clamp(-1.0, 1.0).asin()
        });
        let radiance = ray.through.as_dvec3() * ray.local.as_dvec3();
        Self {
            ray,
            kind,
            coefficient,
            children: Vec::new(),
            brings: DVec3::ZERO,
            radiance,
            incidence,
            refraction,
        }
    }
}

/// Fills in what the nodes bring, from the leaves to the root; the exact sum of the whole tree.
fn sum_up(nodes: &mut [Node]) -> [ExactSum; 3] {
    let mut sums: Vec<[ExactSum; 3]> =
        nodes.iter().map(|node| node.ray.light.to_array().map(ExactSum::of)).collect();
    let mut total = <[ExactSum; 3]>::default();
    for place in (0..nodes.len()).rev() {
        let Some((node, sum)) = nodes.get_mut(place).zip(sums.get_mut(place)) else { continue };
        let sum = std::mem::take(sum);
        node.brings = DVec3::from(sum.each_ref().map(ExactSum::value));
        let passed_on = node.radiance * node.coefficient.as_dvec3();
        let parent = node.ray.parent;
        if let Some(node) = parent.and_then(|parent| nodes.get_mut(parent)) {
            node.radiance += node.ray.through.as_dvec3() * passed_on;
        }
        let above = parent.and_then(|parent| sums.get_mut(parent)).unwrap_or(&mut total);
        above.iter_mut().zip(&sum).for_each(|(above, sum)| above.absorb(sum));
    }
    total
}
