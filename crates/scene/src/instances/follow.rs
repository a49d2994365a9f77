//! Brings instances up to date with what they are instances of: first the bodies that are instances of none, then those
//! that only need these, and so on (Kahn 1962, Topological Sorting of Large Networks). Nothing is gone through as often
//! as it is repeated: ten groups of ten instances each may be ten thousand million bodies.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use crate::Scene;
use crate::body::Body;
use crate::compound::{BodyPart, Instance, SharedForm, each_part_mut};
use crate::material::MaterialChoice;
use crate::shape::Shape;

/// An instance that cannot be.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InstanceFault {
    /// The body that is one or that has a part that is one.
    pub(crate) body: usize,
    /// The name of the body that it would be an instance of.
    pub(crate) of: String,
    /// Why it cannot be.
    pub(crate) problem: InstanceProblem,
}

/// Why an instance cannot be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum InstanceProblem {
    /// The scene has no body of the name.
    Unknown,
    /// The body would be or contain an instance of itself.
    OfItself,
    /// Parts are nested deeper than [`Shape::MAX_DEPTH`].
    TooDeep,
    /// A union, an intersection or a difference has more than [`Shape::MAX_PARTS`] parts.
    TooManyParts {
        /// The kind of the whole.
        shape: Shape,
        /// How many it has.
        count: u64,
    },
    /// A surface would be joined, which has no inside.
    SurfaceWithin {
        /// The kind of the whole.
        shape: Shape,
    },
    /// There are more than [`Scene::MAX_INSTANCED`] simple bodies.
    TooMany {
        /// How many there are.
        count: u64,
    },
}

/// How deep the parts of a body are nested, how many simple ones there are, and whether it is a surface or a group with one.
#[derive(Clone, Copy, Debug, Default)]
struct PartCount {
    depth: usize,
    simple: u64,
    has_surface: bool,
}

impl PartCount {
    /// Of a simple body.
    const SIMPLE: Self = Self { depth: 0, simple: 1, has_surface: false };
}

/// What instances take of a body.
struct Original {
    count: PartCount,
    shape: Shape,
    material: MaterialChoice,
    /// Made with the first instance.
    shared: Option<Arc<SharedForm>>,
}

impl Scene {
    /// The largest number of simple bodies that instances can make of a scene.
    pub const MAX_INSTANCED: u64 = 1 << 24;

    /// Whether any body is an instance or has a part that is one.
    pub fn has_instances(&self) -> bool {
        self.bodies.iter().any(Body::has_instances)
    }

    /// Gives all instances the shape and the parts of what they are instances of, and its material unless they have
    /// their own. Those that cannot be keep what they have: of bodies that the scene does not have, or of themselves.
    pub fn follow_instances(&mut self) {
        self.resolve_instances();
    }

    /// [`Self::follow_instances`]; the answer is what cannot be.
    pub(crate) fn resolve_instances(&mut self) -> Vec<InstanceFault> {
        let using: Vec<usize> = self.using_instances();
        if using.is_empty() { Vec::new() } else { InstanceFollower::new(self, using).run() }
    }

    /// The instances that cannot be.
    pub(crate) fn instance_faults(&self) -> Vec<InstanceFault> {
        self.clone().resolve_instances()
    }

    fn using_instances(&self) -> Vec<usize> {
        let bodies = self.bodies.iter().enumerate();
        bodies.filter(|(_, body)| body.has_instances()).map(|(index, _)| index).collect()
    }
}

/// The bodies of a scene that are instances, and what they need.
struct InstanceFollower<'s> {
    scene: &'s mut Scene,
    /// The places of the bodies that have a name.
    places: HashMap<String, usize>,
    /// What is known of bodies that are up to date.
    originals: HashMap<usize, Original>,
    /// The bodies that wait for others, and how many.
    waiting: HashMap<usize, usize>,
    /// The bodies that wait for a body.
    users: HashMap<usize, Vec<usize>>,
    /// The simple bodies so far, those that are hidden left out.
    simple: u64,
    faults: Vec<InstanceFault>,
}

impl<'s> InstanceFollower<'s> {
    fn new(scene: &'s mut Scene, using: Vec<usize>) -> Self {
        let mut places = HashMap::new();
        for (index, body) in scene.bodies.iter().enumerate().filter(|(_, body)| !body.name.is_empty()) {
            places.entry(body.name.clone()).or_insert(index);
        }
        let mut follower = Self {
            scene,
            places,
            originals: HashMap::new(),
            waiting: HashMap::new(),
            users: HashMap::new(),
            simple: 0,
            faults: Vec::new(),
        };
        for index in using {
            follower.enlist(index);
        }
        follower
    }

    /// Notes what a body waits for.
    fn enlist(&mut self, index: usize) {
        let Some(body) = self.scene.bodies.get(index) else { return };
        let names: HashSet<&str> = body.instances().map(|instance| instance.of.as_str()).collect();
        let mut unknown: Vec<&str> = Vec::new();
        for name in names {
            match self.places.get(name) {
                Some(&place) => {
                    *self.waiting.entry(index).or_default() += 1;
                    self.users.entry(place).or_default().push(index);
                }
                None => unknown.push(name),
            }
        }
        unknown.sort_unstable();
        let fault =
            |of: &str| InstanceFault { body: index, of: of.to_owned(), problem: InstanceProblem::Unknown };
        self.faults.extend(unknown.into_iter().map(fault));
        self.waiting.entry(index).or_default();
    }

    fn run(mut self) -> Vec<InstanceFault> {
        let needed = self.users.keys().filter(|place| !self.waiting.contains_key(place));
        let mut ready: Vec<usize> = needed.copied().collect();
        ready.extend(self.waiting.iter().filter(|(_, needs)| **needs == 0).map(|(index, _)| *index));
        // The order of hash tables differs from run to run; that of what is told must not.
        ready.sort_unstable();
        while let Some(index) = ready.pop() {
            self.waiting.remove(&index);
            self.follow(index);
            for user in self.users.remove(&index).unwrap_or_default() {
                if let Some(needs) = self.waiting.get_mut(&user) {
                    *needs -= 1;
                    if *needs == 0 {
                        ready.push(user);
                    }
                }
            }
        }
        self.tell_circles();
        self.faults.sort_by(|one, other| (one.body, &one.of).cmp(&(other.body, &other.of)));
        self.faults
    }

    /// Brings a body up to date whose originals are.
    fn follow(&mut self, index: usize) {
        let Some(body) = self.scene.bodies.get(index) else { return };
        let first = body.instances().next().map(|instance| instance.of.clone());
        let mut problem = None;
        let mut count = self.count(body, &mut problem);
        if let Some(of) = first {
            if problem.is_none() && !body.hidden {
                let all = self.simple.saturating_add(count.simple);
                if all > Scene::MAX_INSTANCED {
                    problem = Some(InstanceProblem::TooMany { count: all });
                } else {
                    self.simple = all;
                }
            }
            if let Some(problem) = problem {
                self.faults.push(InstanceFault { body: index, of, problem });
                count = PartCount::default();
            } else {
                let mut new = body.clone();
                self.update(&mut new);
                if self.scene.bodies.get(index) != Some(&new)
                    && let Some(old) = self.scene.bodies.get_mut(index)
                {
                    *old = new;
                }
            }
        }
        if let Some(body) = self.scene.bodies.get(index) {
            // What an instance shares can be passed on, unless its material is another one.
            let shared = body.instance.as_ref().filter(|instance| !instance.has_own_material);
            let shared = shared.map(|instance| Arc::clone(&instance.shared));
            let original =
                Original { count, shape: body.sized_shape(), material: body.material.clone(), shared };
            self.originals.insert(index, original);
        }
    }

    fn update(&mut self, body: &mut Body) {
        let mut own = body.instance.take();
        if let Some(instance) = &mut own
            && let Some((shape, material)) = self.look_up(instance, Some(&body.material))
        {
            body.shape = shape;
            body.material = material.unwrap_or_else(|| std::mem::take(&mut body.material));
        }
        body.instance = own;
        each_part_mut(&mut body.parts, &mut |part: &mut BodyPart| {
            if let Some(instance) = &mut part.instance
                && let Some((shape, material)) = self.look_up(instance, part.material.as_ref())
            {
                part.shape = shape;
                part.material = material.or(part.material.take());
            }
        });
    }

    /// Gives an instance, which has a material now, the parts of its original. The shape of that, and its material unless
    /// the instance has its own.
    fn look_up(
        &mut self,
        instance: &mut Instance,
        material: Option<&MaterialChoice>,
    ) -> Option<(Shape, Option<MaterialChoice>)> {
        let place = *self.places.get(&instance.of)?;
        let original = self.originals.get_mut(&place)?;
        let body = self.scene.bodies.get(place)?;
        let shared = original.shared.get_or_insert_with(|| {
            let (old, form) = (&instance.shared, body.form());
            let is_same = old.material.as_ref() == Some(&body.material)
                && old.parts == form.parts
                && old.parametric.as_deref() == form.parametric();
            match is_same {
                true => Arc::clone(old),
                false => Arc::new(SharedForm {
                    parts: form.parts.to_vec(),
                    parametric: form.parametric().map(|shape| Box::new(*shape)),
                    material: Some(body.material.clone()),
                }),
            }
        });
        let old = instance.shared.material.as_ref();
        let is_given = |own: &MaterialChoice| *own != original.material && old.is_some_and(|old| own != old);
        instance.has_own_material = material.is_some_and(|own| instance.has_own_material || is_given(own));
        instance.shared = Arc::clone(shared);
        Some((original.shape, (!instance.has_own_material).then(|| original.material.clone())))
    }

    /// Counts the parts of a body; `problem` is the first that is found.
    fn count(&self, body: &Body, problem: &mut Option<InstanceProblem>) -> PartCount {
        let count = match &body.instance {
            Some(instance) => self.count_of(instance),
            None => self.count_parts(body.shape, &body.parts, problem),
        };
        if count.depth > Shape::MAX_DEPTH {
            problem.get_or_insert(InstanceProblem::TooDeep);
        }
        count
    }

    fn count_of(&self, instance: &Instance) -> PartCount {
        let original = self.places.get(&instance.of).and_then(|place| self.originals.get(place));
        original.map_or(PartCount::SIMPLE, |original| original.count)
    }

    fn count_parts(
        &self,
        shape: Shape,
        parts: &[BodyPart],
        problem: &mut Option<InstanceProblem>,
    ) -> PartCount {
        if !shape.is_compound() {
            return PartCount::SIMPLE;
        }
        let mut count = PartCount { depth: 1, simple: 0, has_surface: shape.is_surface() };
        for part in parts {
            let inner = match &part.instance {
                Some(instance) => self.count_of(instance),
                None => self.count_parts(part.shape, &part.parts, problem),
            };
            count.depth = count.depth.max(1 + inner.depth);
            count.simple = count.simple.saturating_add(inner.simple);
            if inner.has_surface && shape != Shape::Group {
                problem.get_or_insert(InstanceProblem::SurfaceWithin { shape });
            }
            count.has_surface |= inner.has_surface;
        }
        if shape != Shape::Group && count.simple > Shape::MAX_PARTS as u64 {
            problem.get_or_insert(InstanceProblem::TooManyParts { shape, count: count.simple });
        }
        count
    }

    /// Tells the bodies that wait for each other, and leaves out those that only wait for them.
    fn tell_circles(&mut self) {
        loop {
            let is_needed = |index: &usize| {
                self.users
                    .get(index)
                    .is_some_and(|users| users.iter().any(|user| self.waiting.contains_key(user)))
            };
            let idle: Vec<usize> = self.waiting.keys().copied().filter(|index| !is_needed(index)).collect();
            if idle.is_empty() {
                break;
            }
            for index in idle {
                self.waiting.remove(&index);
            }
        }
        for index in self.waiting.keys() {
            let Some(body) = self.scene.bodies.get(*index) else { continue };
            let waits = |of: &str| self.places.get(of).is_some_and(|place| self.waiting.contains_key(place));
            let of = body.instances().map(|instance| instance.of.as_str()).find(|of| waits(of));
            let of = of.unwrap_or_default().to_owned();
            self.faults.push(InstanceFault { body: *index, of, problem: InstanceProblem::OfItself });
        }
    }
}
