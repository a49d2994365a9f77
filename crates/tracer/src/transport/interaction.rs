//! The points that rays met, with all that shading needs.

use crate::geometry::body::RenderBody;
use crate::geometry::query::PacketHits;
use crate::geometry::ray::{INWARDS, RayPacket};
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::scene::RenderScene;
use crate::transport::surface::conductor_table::ConductorTable;
use crate::transport::surface::fresnel;
use crate::transport::surface::material::{MaterialModel, RenderMaterial};

/// The points that rays side by side met. Of rays that met nothing, the numbers mean nothing.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceInteraction<W: Width> {
    pub(crate) t: W::R,
    pub(crate) body: W::W,
    /// The body, and [`INWARDS`] where the ray came from within: the start of rays on this side.
    pub(crate) start: W::W,
    pub(crate) position: Vector<W::R>,
    /// Unit normal facing the ray.
    pub(crate) normal: Vector<W::R>,
    /// k_a·C·I_a.
    pub(crate) ambient: Vector<W::R>,
    /// k_d·C.
    pub(crate) diffuse: Vector<W::R>,
    /// k_s.
    pub(crate) specular: W::R,
    /// Exponent n.
    pub(crate) shininess: W::R,
    /// k_r, or what is reflected under this angle; of what is clear, only the crossing tells.
    pub(crate) reflection: W::R,
    /// The reflectance of what reflects in color, of each channel.
    sheen: Vector<W::R>,
    /// k_t·τ.
    pub(crate) filter: Vector<W::R>,
    /// Rays that met something transparent.
    pub(crate) transparent: W::M,
    /// Those that met something that answers a light.
    pub(crate) answers: W::M,
    /// Those that met something with a highlight.
    pub(crate) glossy: W::M,
    /// Those that met the boundary of a clear body.
    pub(crate) clear: W::M,
    /// Those that met a body that splits light into its colors.
    pub(crate) disperses: W::M,
    /// Those that met facets.
    pub(crate) rough: W::M,
    /// The width of their slopes, α.
    pub(crate) alpha: W::R,
    /// Those that met something that reflects in color.
    pub(crate) colored: W::M,
    /// Those that met a coat.
    coated: W::M,
    /// The index of air divided by that of the coat.
    coat_ratio: W::R,
}

impl<W: Width> SurfaceInteraction<W> {
    /// Points of which nothing but these numbers is known yet.
    #[inline(always)]
    fn nothing(w: W, t: W::R, body: W::W, start: W::W) -> Self {
        let (zero, none) = (w.real(0.0), w.mask(0));
        let nowhere = Vector::new(zero, zero, zero);
        Self {
            t,
            body,
            start,
            position: nowhere,
            normal: nowhere,
            ambient: nowhere,
            diffuse: nowhere,
            specular: zero,
            shininess: zero,
            reflection: zero,
            sheen: nowhere,
            filter: nowhere,
            transparent: none,
            answers: none,
            glossy: none,
            clear: none,
            disperses: none,
            rough: none,
            alpha: zero,
            colored: none,
            coated: none,
            coat_ratio: w.real(1.0),
        }
    }

    /// Points on surfaces, each as if its body had the color 1, seen along `direction`; `start` is the body of each, with
    /// [`INWARDS`] on its inner side.
    pub(crate) fn at_points(
        w: W,
        scene: &RenderScene,
        start: W::W,
        (position, normal): (Vector<W::R>, Vector<W::R>),
        direction: Vector<W::R>,
        lanes: W::M,
    ) -> Self {
        let (mut starts, mut bodies) = ([0; MOST_LANES], [0; MOST_LANES]);
        start.store(&mut starts);
        for (body, start) in bodies.iter_mut().zip(starts) {
            *body = start & !INWARDS;
        }
        let body = w.load_words(&bodies);
        let mut all = Self { position, normal, ..Self::nothing(w, w.real(0.0), body, start) };
        let white = Vector::splat(w.real(0.0), [1.0; 3]);
        let mut left = lanes.bits();
        while left != 0 {
            let index = bodies[left.trailing_zeros() as usize % MOST_LANES];
            let same = body.is(index) & lanes;
            left &= !same.bits();
            let body = scene.geometry.body(index);
            let ground = Vector::splat(w.real(0.0), scene.material(body).color);
            all.set_material::<true, false>(w, scene, body, (white, ground), direction, same);
        }
        all
    }

    /// Looks at the bodies one after the other: rays side by side mostly meet the same.
    #[inline(always)]
    pub(crate) fn new<const FULL: bool>(
        w: W,
        scene: &RenderScene,
        rays: &RayPacket<W>,
        hits: &PacketHits<W>,
    ) -> Self {
        let leaving = W::W::select(hits.leaving, w.word(INWARDS), w.word(0));
        let mut all = Self::nothing(w, hits.t, hits.body, hits.body.or(leaving));
        let mut bodies = [0; MOST_LANES];
        hits.body.store(&mut bodies);
        let mut left = hits.hit.bits();
        let next = |left: &mut u32| {
            let index = bodies[left.trailing_zeros() as usize % MOST_LANES];
            let same = hits.body.is(index) & hits.hit;
            *left &= !same.bits();
            (index, same)
        };
        if left != 0 {
            let (index, same) = next(&mut left);
            all.look_at::<FULL, true>(w, scene, index, rays, hits, same);
        }
        while left != 0 {
            let (index, same) = next(&mut left);
            all.look_at::<FULL, false>(w, scene, index, rays, hits, same);
        }
        all
    }

    /// Takes up what rays `lanes` find on a body. The `FIRST` one may write the numbers of all rays; others write theirs even
    /// where they are 0.
    #[inline(always)]
    fn look_at<const FULL: bool, const FIRST: bool>(
        &mut self,
        w: W,
        scene: &RenderScene,
        index: u32,
        rays: &RayPacket<W>,
        hits: &PacketHits<W>,
        lanes: W::M,
    ) {
        let body = scene.geometry.body(index);
        let material = scene.material(body);
        let zero = w.real(0.0);
        let line = (rays.origin, rays.direction);
        let point = scene.geometry.point_on_face(w, (index, body), line, hits.t, hits.leaving, hits.face);
        let mut color = Vector::splat(zero, material.color);
        if FULL {
            color = material.color_at(w, body, point.in_body, lanes);
        }
        if let Some(checker) = scene.checkers.get(body.checker as usize) {
            color = Vector::select(
                checker.is_odd(point.on_checker(body)),
                Vector::splat(zero, checker.color),
                color,
            );
        }
        let select = |own: Vector<W::R>, old| if FIRST { own } else { Vector::select(lanes, own, old) };
        self.position = select(point.in_world, self.position);
        self.normal = select(point.normal, self.normal);
        self.set_material::<FULL, FIRST>(w, scene, body, (color, color), rays.direction, lanes);
    }

    /// Takes up what the material of a body of this color answers where rays `lanes` met it. Light that goes to and fro
    /// below a coat takes the color of `ground` on its way.
    #[inline(always)]
    fn set_material<const FULL: bool, const FIRST: bool>(
        &mut self,
        w: W,
        scene: &RenderScene,
        body: &RenderBody,
        (color, ground): (Vector<W::R>, Vector<W::R>),
        direction: Vector<W::R>,
        lanes: W::M,
    ) {
        let material = scene.material(body);
        let zero = w.real(0.0);
        let select = |own: Vector<W::R>, old| if FIRST { own } else { Vector::select(lanes, own, old) };
        let real = |own: f32, old| if FIRST { w.real(own) } else { W::R::select(lanes, w.real(own), old) };
        let has = |coefficient: f32| coefficient != 0.0;
        if has(material.ambient) || !FIRST {
            let ambient = scene.ambient.map(|light| light * material.ambient);
            self.ambient = select(color.times_all(ambient), self.ambient);
        }
        if has(material.diffuse) || !FIRST {
            self.diffuse = select(color * w.real(material.diffuse), self.diffuse);
        }
        if has(material.specular) || !FIRST {
            self.specular = real(material.specular, self.specular);
            self.shininess = real(material.shininess, self.shininess);
        }
        if has(material.specular) {
            self.glossy = self.glossy | lanes;
        }
        if has(material.diffuse) || has(material.specular) {
            self.answers = self.answers | lanes;
        }
        self.reflection = real(material.reflection, self.reflection);
        if FULL && !matches!(material.law, MaterialModel::Constant) {
            self.add_lobes(w, material, (color, ground, scene.ambient), direction, lanes);
        }
        if body.is_transparent() {
            self.transparent = self.transparent | lanes;
            self.filter = select(Vector::splat(zero, material.filter), self.filter);
        }
    }

    /// Takes up what rays `lanes` find on a surface that reflects by a law of its own.
    #[cold]
    #[inline(never)]
    fn add_lobes(
        &mut self,
        w: W,
        material: &RenderMaterial,
        (color, ground, ambient): (Vector<W::R>, Vector<W::R>, [f32; 3]),
        direction: Vector<W::R>,
        lanes: W::M,
    ) {
        w.run(
            #[inline(always)]
            || {
                let one = w.real(1.0);
                if material.alpha > 0.0 {
                    self.rough = self.rough | lanes;
                    self.answers = self.answers | lanes;
                    self.alpha = W::R::select(lanes, w.real(material.alpha), self.alpha);
                }
                let cos = (-self.normal.dot(direction)).min(one).max(w.real(0.0));
                match &material.law {
                    MaterialModel::Constant => {}
                    MaterialModel::Dielectric => {
                        self.clear = self.clear | lanes;
                        if material.dispersion.is_some() {
                            self.disperses = self.disperses | lanes;
                        }
                    }
                    MaterialModel::Mirror => self.color(color * w.real(material.reflection), lanes),
                    MaterialModel::Conductor(curve) => self.color(curve_at(w, curve, cos), lanes),
                    MaterialModel::Coat(coat) => {
                        let share = fresnel(cos, w.real(coat.ratio));
                        self.reflection = W::R::select(lanes, share, self.reflection);
                        self.coated = self.coated | lanes;
                        self.coat_ratio = W::R::select(lanes, w.real(coat.ratio), self.coat_ratio);
                        let [color, ground] = [color, ground].map(|color| color.map(|part| part.min(one)));
                        // Between ground and coat light goes to and fro, and leaves a little of itself each time.
                        let again = ground.map(|part| one / (one - part + part * coat.lets_out));
                        let below = color.times(again) * ((one - share) * coat.spread);
                        self.diffuse = Vector::select(lanes, below, self.diffuse);
                        let even = ambient.map(|light| light * material.ambient * coat.lets_in);
                        self.ambient = Vector::select(lanes, below.times_all(even), self.ambient);
                    }
                }
            },
        );
    }

    /// What is reflected under another angle: the normals of rough surfaces were turned.
    #[inline(always)]
    pub(crate) fn set_microfacet_normal(&mut self, w: W, scene: &RenderScene, direction: Vector<W::R>) {
        let one = w.real(1.0);
        let cos = (-self.normal.dot(direction)).min(one).max(w.real(0.0));
        let coated = self.rough & self.coated;
        if coated.any() {
            self.reflection = W::R::select(coated, fresnel(cos, self.coat_ratio), self.reflection);
        }
        let colored = self.rough & self.colored;
        if colored.any() {
            let mut bodies = [0; MOST_LANES];
            self.body.store(&mut bodies);
            let mut left = colored.bits();
            while left != 0 {
                let index = bodies[left.trailing_zeros() as usize % MOST_LANES];
                let same = self.body.is(index) & colored;
                left &= !same.bits();
                if let MaterialModel::Conductor(curve) = &scene.material(scene.geometry.body(index)).law {
                    self.sheen = Vector::select(same, curve_at(w, curve, cos), self.sheen);
                }
            }
        }
    }

    fn color(&mut self, sheen: Vector<W::R>, lanes: W::M) {
        self.colored = self.colored | lanes;
        self.sheen = Vector::select(lanes, sheen, self.sheen);
    }

    /// What is reflected, of each channel.
    #[inline(always)]
    pub(crate) fn reflected(&self, reflection: W::R) -> Vector<W::R> {
        let mut reflected = Vector::new(reflection, reflection, reflection);
        if self.colored.any() {
            reflected = Vector::select(self.colored, self.sheen, reflected);
        }
        reflected
    }

    /// What the ground scatters of light that falls in under an angle of this cosine: k_d·C·(n̂·L̂), or what a coat leaves
    /// of it.
    #[inline(always)]
    pub(crate) fn eval_diffuse(&self, cos: W::R) -> Vector<W::R> {
        let all = self.diffuse * cos;
        if !self.coated.any() {
            return all;
        }
        let one = cos.like(1.0);
        let passed = one - fresnel(cos.min(one).max(cos.like(0.0)), self.coat_ratio);
        Vector::select(self.coated, all * passed, all)
    }

    /// Rays that met the surface of a rough clear body from within.
    #[inline(always)]
    pub(crate) fn rough_interior(&self) -> W::M {
        self.rough & self.clear & self.leaves()
    }

    /// Rays that met the surface from within.
    #[inline(always)]
    pub(crate) fn leaves(&self) -> W::M {
        self.start.has(INWARDS)
    }

    /// Rays from here to the side that the incoming rays came from.
    #[inline(always)]
    pub(crate) fn rays_on_this_side(&self, direction: Vector<W::R>) -> RayPacket<W> {
        RayPacket { origin: self.position, direction, start: self.start }
    }

    /// Rays from here to the other side of the surface.
    #[inline(always)]
    pub(crate) fn rays_on_far_side(&self, direction: Vector<W::R>) -> RayPacket<W> {
        let other = self.start.plus(self.start.like(INWARDS));
        RayPacket { origin: self.position, direction, start: other }
    }
}

/// The reflectances of a metal under angles of these cosines.
fn curve_at<W: Width>(w: W, curve: &ConductorTable, cos: W::R) -> Vector<W::R> {
    let mut cosines = [0.0; MOST_LANES];
    cos.store(&mut cosines);
    let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
    for (lane, cos) in cosines.into_iter().enumerate().take(W::LANES) {
        [red[lane], green[lane], blue[lane]] = curve.at(cos);
    }
    Vector::new(w.load(&red), w.load(&green), w.load(&blue))
}
