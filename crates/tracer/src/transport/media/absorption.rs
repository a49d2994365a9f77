//! What the media on the way to a light leave of it.
//!
//! Light is absorbed by the medium entered last only, as it is on the ways of the tree's rays. Shadow rays come to the
//! bodies on their way in any order: each notes the part of the ray that lies within, and afterwards those parts are put
//! into the order in which the ray enters them.

use std::cmp::Ordering;
use std::ops::Range;

use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::media::MediumStacks;
use crate::transport::media::shadow_crossings::ShadowCrossings;
use crate::transport::scene::RenderScene;
use crate::transport::surface::exponential;

/// A part of a ray that lies within a transparent body: one at most, unless that is joined of others.
#[derive(Clone, Copy, Debug)]
struct MediumInterval {
    /// The ray's place among those side by side, or its number in a stream.
    ray: u32,
    /// The body's place in the scene.
    body: u32,
    /// Where it begins, the ray's parameter.
    enter: f32,
    /// Where it ends, not beyond the light.
    exit: f32,
    /// Whether the ray starts in the body.
    is_within: bool,
}

/// The parts of shadow rays that lie within transparent bodies: working memory of one light after the other.
#[derive(Debug, Default)]
pub(crate) struct MediumIntervals {
    list: Vec<MediumInterval>,
    /// The intervals that a ray is in, the one entered last at the end.
    open: Vec<MediumInterval>,
    /// What rays cross where bodies may be cemented.
    pub(crate) crossings: ShadowCrossings,
}

impl MediumIntervals {
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Gives the intervals from number `first` on, of rays side by side, the numbers that these rays have in a stream.
    #[inline(always)]
    pub(crate) fn name_rays(&mut self, first: usize, numbers: &[u32]) {
        for interval in self.list.iter_mut().skip(first) {
            interval.ray = numbers.get(interval.ray as usize).copied().unwrap_or(interval.ray);
        }
    }

    /// Notes where rays enter a body, and from where on they are in it if they start there.
    ///
    /// Few scenes absorb: what is given copies leaves the loop over bodies as it is.
    #[cold]
    #[inline(never)]
    pub(crate) fn note<W: Width>(
        &mut self,
        body: u32,
        (entering, enter): (W::M, W::R),
        (within, exit): (W::M, W::R),
    ) {
        let [mut enters, mut exits] = [[0.0; MOST_LANES]; 2];
        enter.store(&mut enters);
        exit.store(&mut exits);
        let (entering, within) = (entering.bits(), within.bits());
        for lane in (0..W::LANES).filter(|lane| (entering | within) >> lane & 1 == 1) {
            let is_within = within >> lane & 1 == 1;
            let enter = if is_within { 0.0 } else { enters[lane] };
            self.list.push(MediumInterval { ray: lane as u32, body, enter, exit: exits[lane], is_within });
        }
    }

    /// Notes that a ray is in a body from one parameter to another, from its start if it starts there.
    pub(crate) fn note_one(&mut self, body: u32, ray: u32, way: Range<f32>, is_within: bool) {
        self.list.push(MediumInterval { ray, body, enter: way.start, exit: way.end, is_within });
    }

    /// What is left of the light that comes along rays side by side, which start in these media. Forgets all intervals.
    #[cold]
    #[inline(never)]
    pub(crate) fn left_after<W: Width>(
        &mut self,
        w: W,
        scene: &RenderScene,
        (table, media): (&MediumStacks, W::W),
    ) -> Vector<W::R> {
        let mut lists = [0; MOST_LANES];
        media.store(&mut lists);
        let mut losses = [[0.0; MOST_LANES]; 3];
        self.each_loss(
            scene,
            |ray| (table, lists[ray as usize % MOST_LANES]),
            |ray, loss| {
                for (all, loss) in losses.iter_mut().zip(loss) {
                    all[ray as usize % MOST_LANES] = loss;
                }
            },
        );
        let [red, green, blue] = losses;
        w.run(
            #[inline(always)]
            || {
                Vector::new(w.load(&red), w.load(&green), w.load(&blue)).map(
                    #[inline(always)]
                    |loss: W::R| exponential(-loss),
                )
            },
        )
    }

    /// Shows `take` each ray of a stream with what is left of its light; `media_of` tells the media where it starts. Forgets
    /// all intervals.
    pub(crate) fn each_left(
        &mut self,
        scene: &RenderScene,
        table: &MediumStacks,
        media_of: impl Fn(u32) -> u32,
        mut take: impl FnMut(u32, Vector<f32>),
    ) {
        self.each_loss(
            scene,
            |ray| (table, media_of(ray)),
            |ray, loss| take(ray, Vector::splat(0.0, loss).map(|loss| exponential(-loss))),
        );
    }

    /// Shows `take` each ray with the negative logarithm of what is left of its light.
    fn each_loss<'t>(
        &mut self,
        scene: &RenderScene,
        media_of: impl Fn(u32) -> (&'t MediumStacks, u32),
        mut take: impl FnMut(u32, [f32; 3]),
    ) {
        let Self { list, open, .. } = self;
        sort_by_ray(list);
        for of_ray in list.chunk_by_mut(|a, b| a.ray == b.ray) {
            let ray = of_ray.first().map_or(0, |interval| interval.ray);
            if of_ray.len() > 1 {
                let (table, media) = media_of(ray);
                sort_by_entry(of_ray, scene, (table, media));
            }
            take(ray, loss_of(scene, of_ray, open));
        }
        list.clear();
    }
}

/// Not within what is compiled for each width: a sort is much code.
fn sort_by_ray(list: &mut [MediumInterval]) {
    list.sort_unstable_by_key(|interval| interval.ray);
}

fn sort_by_entry(of_ray: &mut [MediumInterval], scene: &RenderScene, media: (&MediumStacks, u32)) {
    of_ray.sort_unstable_by(|a, b| in_order_of_entry(scene, media, a, b));
}

/// Which of two intervals a ray in these media enters first: those that it starts in come before others, in the order of
/// its list; of bodies entered at once, the first of the scene.
fn in_order_of_entry(
    scene: &RenderScene,
    (table, media): (&MediumStacks, u32),
    a: &MediumInterval,
    b: &MediumInterval,
) -> Ordering {
    // The list begins with the body entered last. Who is in a body by rounding only has come there last of all.
    let place = |body: u32| table.bodies(media).position(|other| other == body);
    b.is_within.cmp(&a.is_within).then_with(|| {
        if a.is_within {
            place(b.body).cmp(&place(a.body)).then_with(|| scene.geometry.scene_order(a.body, b.body))
        } else {
            a.enter.total_cmp(&b.enter).then_with(|| scene.geometry.scene_order(a.body, b.body))
        }
    })
}

/// The negative logarithm of what is left of light on its way through intervals in the order of entry: in each place, the
/// body entered last absorbs.
fn loss_of(scene: &RenderScene, intervals: &[MediumInterval], open: &mut Vec<MediumInterval>) -> [f32; 3] {
    let mut loss = [0.0; 3];
    let mut at = 0.0;
    open.clear();
    let ends = intervals.iter().skip(1).map(|next| next.enter).chain([f32::INFINITY]);
    for (interval, end) in intervals.iter().zip(ends) {
        at = interval.enter.max(at);
        open.push(*interval);
        // What is left before the next one is entered is left for good.
        while let Some(last) = open.last() {
            let until = last.exit.min(end);
            if until > at {
                let absorption = scene.material(scene.geometry.body(last.body)).absorption;
                for (loss, absorption) in loss.iter_mut().zip(absorption) {
                    *loss += absorption * (until - at);
                }
                at = until;
            }
            if last.exit > end {
                break;
            }
            open.pop();
        }
    }
    loss
}
