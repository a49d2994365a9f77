//! The worker's end of the way to a card.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};

use catoptric_gpu::GpuError;
use catoptric_picture::Development;
use catoptric_platform::threads::{self, Orders};
use catoptric_platform::time::Instant;
use catoptric_tracer::shaders::UnsupportedOnGpu;
use catoptric_tracer::{RenderCamera, RenderControl, RenderScene};

use super::renderer::{CardAnswer, CardOrder, CardPass, CardRenderer, ShownPicture};
use super::source::CardSource;
use crate::pace::milliseconds_since;

/// A graphics card as the worker knows it: orders go to the task that drives it, answers come back. Dropping it lets the
/// card go.
pub(crate) struct CardPort {
    orders: Arc<Orders<CardOrder>>,
    desk: Arc<Desk>,
    /// Whether the worker waits for answers.
    waits: bool,
    /// What in the present scene it cannot draw.
    pub(crate) refused: Option<GpuError>,
}

/// A film on a card.
#[derive(Debug)]
pub(crate) struct CardFilm {
    /// What the card knows it by.
    slot: Arc<()>,
    size: [u32; 2],
    samples: u32,
}

/// The state of a card.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum CardState {
    Opening,
    /// It is open, and has this name.
    Open(String),
    Failed(GpuError),
}

/// News of a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CardNews {
    /// It is open, has failed, or can draw what it could not before.
    Ready,
    /// It has answered a worker that does not wait.
    Answered,
}

/// The reason why there is no answer.
pub(crate) enum NoAnswer {
    /// It comes later: then the same is asked again.
    Yet,
    Gpu(GpuError),
}

/// Where the task puts its answers.
struct Desk {
    state: Mutex<DeskState>,
    /// Rings when there is an answer.
    bell: Condvar,
    tell: Box<dyn Fn(CardNews) + Send + Sync>,
}

struct DeskState {
    card: CardState,
    /// Whether the task has let go of the card.
    has_ended: bool,
    order: OrderState,
}

/// How far the last order is.
enum OrderState {
    None,
    UnderWay(OrderKey, Option<WorkUnderWay>),
    Answered(OrderKey, Result<CardAnswer, GpuError>),
}

/// Tracing for an order.
struct WorkUnderWay {
    control: Arc<RenderControl>,
    since: Instant,
}

/// What an order is for: who asks for the same again means the same order.
enum OrderKey {
    /// The state of the scene, and the camera.
    Prepare(u64, Box<RenderCamera>),
    Sample(Weak<()>),
    Develop(Weak<()>, u32, Development),
}

impl CardPort {
    /// Has a card opened, and tells when that is done. A worker that may wait waits for answers; another one is told of
    /// them.
    pub(crate) fn open(
        source: CardSource,
        waits: bool,
        tell: impl Fn(CardNews) + Send + Sync + 'static,
    ) -> Self {
        let state = DeskState { card: CardState::Opening, has_ended: false, order: OrderState::None };
        let desk = Desk { state: Mutex::new(state), bell: Condvar::new(), tell: Box::new(tell) };
        let (orders, desk) = (Arc::new(Orders::default()), Arc::new(desk));
        let (task_orders, task_desk) = (Arc::clone(&orders), Arc::clone(&desk));
        let started = threads::start_task("card", move || drive(source, task_orders, task_desk, waits));
        if let Err(error) = started {
            desk.lock().has_ended = true;
            desk.set_state(CardState::Failed(GpuError::NotOpened(error.to_string())));
        }
        Self { orders, desk, waits, refused: None }
    }

    /// Its state.
    pub(crate) fn state(&self) -> CardState {
        self.desk.lock().card.clone()
    }

    /// Forgets what it could not draw, if it may be able to now: another scene, or from elsewhere.
    pub(crate) fn look_again(&mut self, is_other_scene: bool) {
        let is_of_eye = matches!(self.refused, Some(GpuError::Unsupported(UnsupportedOnGpu::EyeMedia(_))));
        if is_other_scene || is_of_eye {
            self.refused = None;
        }
    }

    /// Whether an answer is still to come that nobody waits for.
    pub(crate) fn is_busy(&self) -> bool {
        matches!(self.desk.lock().order, OrderState::UnderWay(..))
    }

    /// Has what is under way come to an end soon. Gives the pixels that were traced and how long that took, milliseconds,
    /// the first time.
    pub(crate) fn cancel(&self) -> Option<(u64, f64)> {
        let state = self.desk.lock();
        let OrderState::UnderWay(_, Some(work)) = &state.order else { return None };
        let is_first = !work.control.is_cancelled();
        work.control.cancel();
        is_first.then(|| (work.control.pixels_done(), milliseconds_since(work.since)))
    }

    /// Whether there is an answer that nobody has taken.
    pub(crate) fn has_answer(&self) -> bool {
        matches!(self.desk.lock().order, OrderState::Answered(..))
    }

    /// Forgets an answer that nobody has taken: it may be otherwise now.
    pub(crate) fn forget_answer(&self) {
        let mut state = self.desk.lock();
        if matches!(state.order, OrderState::Answered(..)) {
            state.order = OrderState::None;
        }
    }

    /// Sends what is new of a scene. False while its shader is compiled; the worker is told when that is done.
    pub(crate) fn prepare(
        &self,
        render_scene: &Arc<RenderScene>,
        camera: &RenderCamera,
    ) -> Result<bool, NoAnswer> {
        let key = OrderKey::Prepare(render_scene.state(), Box::new(camera.clone()));
        let order = || CardOrder::Prepare { render_scene: Arc::clone(render_scene), camera: camera.clone() };
        match self.ask(key, order, None)? {
            CardAnswer::Prepared(is_ready) => Ok(is_ready),
            _ => Err(NoAnswer::Yet),
        }
    }

    /// Adds a sample to every pixel of a film.
    pub(crate) fn sample(
        &self,
        film: &mut CardFilm,
        render_scene: &Arc<RenderScene>,
        camera: &RenderCamera,
        control: &Arc<RenderControl>,
    ) -> Result<CardPass, NoAnswer> {
        let slot = Arc::downgrade(&film.slot);
        let order = || CardOrder::Sample {
            film: Weak::clone(&slot),
            size: film.size,
            render_scene: Arc::clone(render_scene),
            camera: camera.clone(),
            control: Arc::clone(control),
        };
        let key = OrderKey::Sample(Weak::clone(&slot));
        match self.ask(key, order, Some(Arc::clone(control)))? {
            CardAnswer::Sampled(pass) => {
                film.samples = pass.samples;
                Ok(pass)
            }
            _ => Err(NoAnswer::Yet),
        }
    }

    /// Makes a film visible.
    pub(crate) fn develop(
        &self,
        film: &CardFilm,
        development: &Development,
    ) -> Result<ShownPicture, NoAnswer> {
        let slot = Arc::downgrade(&film.slot);
        let key = OrderKey::Develop(Weak::clone(&slot), film.samples, *development);
        let order = || CardOrder::Develop { film: slot, development: *development };
        match self.ask(key, order, None)? {
            CardAnswer::Developed(shown) => Ok(shown),
            _ => Err(NoAnswer::Yet),
        }
    }

    /// The answer to an order, which is given unless it was before.
    fn ask(
        &self,
        key: OrderKey,
        order: impl FnOnce() -> CardOrder,
        control: Option<Arc<RenderControl>>,
    ) -> Result<CardAnswer, NoAnswer> {
        let mut state = self.desk.lock();
        match std::mem::replace(&mut state.order, OrderState::None) {
            OrderState::Answered(known, answer) if known == key => return answer.map_err(NoAnswer::Gpu),
            OrderState::UnderWay(known, work) => {
                if let (false, Some(work)) = (known == key, &work) {
                    work.control.cancel();
                }
                state.order = OrderState::UnderWay(known, work);
                return Err(NoAnswer::Yet);
            }
            // Nobody wants the answer to something else any more.
            OrderState::Answered(..) | OrderState::None => {}
        }
        if let CardState::Failed(error) = &state.card {
            return Err(NoAnswer::Gpu(error.clone()));
        }
        let work = control.map(|control| WorkUnderWay { control, since: Instant::now() });
        state.order = OrderState::UnderWay(key, work);
        self.orders.send(order());
        if !self.waits {
            return Err(NoAnswer::Yet);
        }
        loop {
            match std::mem::replace(&mut state.order, OrderState::None) {
                OrderState::Answered(_, answer) => return answer.map_err(NoAnswer::Gpu),
                unfinished => state.order = unfinished,
            }
            state = self.desk.bell.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl Drop for CardPort {
    fn drop(&mut self) {
        let _ = self.cancel();
        self.orders.close();
        // A driver must not be at work when the program ends.
        let mut state = self.desk.lock();
        while self.waits && !state.has_ended {
            state = self.desk.bell.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl CardFilm {
    /// A film without light.
    pub(crate) fn new(size: [u32; 2]) -> Self {
        Self { slot: Arc::new(()), size, samples: 0 }
    }

    /// Width and height, pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Samples that every pixel has.
    pub(crate) fn samples(&self) -> u32 {
        self.samples
    }

    /// Forgets all light.
    pub(crate) fn clear(&mut self) {
        *self = Self::new(self.size);
    }
}

impl Desk {
    fn lock(&self) -> MutexGuard<'_, DeskState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set_state(&self, card: CardState) {
        self.lock().card = card;
        self.bell.notify_all();
        (self.tell)(CardNews::Ready);
    }

    fn answer(&self, answer: Result<CardAnswer, GpuError>) {
        let mut state = self.lock();
        if let OrderState::UnderWay(key, _) = std::mem::replace(&mut state.order, OrderState::None) {
            state.order = OrderState::Answered(key, answer);
        }
        drop(state);
        self.bell.notify_all();
    }
}

/// Opens a card and does what is ordered until there are no more orders.
async fn drive(source: CardSource, orders: Arc<Orders<CardOrder>>, desk: Arc<Desk>, waits: bool) {
    let _end = TaskEnd(&desk);
    let ready = Arc::clone(&desk);
    let mut renderer = match CardRenderer::open(source, Arc::new(move || (ready.tell)(CardNews::Ready))).await
    {
        Ok(renderer) => renderer,
        Err(error) => return desk.set_state(CardState::Failed(error)),
    };
    desk.set_state(CardState::Open(renderer.name().to_owned()));
    while let Some(order) = orders.next().await {
        // The order is gone before the answer comes: the worker may change the scene in place then.
        let answer = renderer.fulfil(order).await;
        desk.answer(answer);
        if !waits {
            (desk.tell)(CardNews::Answered);
        }
    }
}

/// Says that the card draws no more when the task ends and has let go of it, also by a panic.
struct TaskEnd<'a>(&'a Desk);

impl Drop for TaskEnd<'_> {
    fn drop(&mut self) {
        let lost = GpuError::Lost("nothing drives it any more".to_owned());
        let mut state = self.0.lock();
        state.has_ended = true;
        if !matches!(state.card, CardState::Failed(_)) {
            state.card = CardState::Failed(lost.clone());
        }
        drop(state);
        self.0.answer(Err(lost));
        (self.0.tell)(CardNews::Ready);
    }
}

impl PartialEq for OrderKey {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Prepare(state, camera), Self::Prepare(other, seen)) => state == other && camera == seen,
            (Self::Sample(film), Self::Sample(other)) => film.ptr_eq(other),
            (Self::Develop(film, samples, how), Self::Develop(other, count, otherwise)) => {
                film.ptr_eq(other) && samples == count && how == otherwise
            }
            _ => false,
        }
    }
}
