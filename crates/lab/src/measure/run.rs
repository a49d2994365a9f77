//! Runs the measurements.

use std::borrow::Cow;
use std::collections::HashMap;

use catoptric_picture::{CompareError, Picture};
use catoptric_platform::time::{Duration, Instant};
use catoptric_scene::format::spec::KeySpec;
use catoptric_scene::{AddressError, ImageError, ImageFault, Scene, ScenePath, SceneValue};
use catoptric_store::Folder;
use catoptric_tracer::raster::{Method, MethodError, PassName, draw};
use catoptric_tracer::{
    AcceleratorChoice, RayCounts, RenderControl, RenderScene, RenderSettings, SceneBuildError,
};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::answer::PictureQuestion;
use super::axis::{Axis, AxisError, MOST_POINTS, Variable};
use super::parameter::{Parameter, Value};
use crate::cloud::grown;
use crate::machine::Machine;
use crate::random::Random;
use crate::variant::Variant;

/// The plan of a measurement.
#[derive(Clone, Debug)]
pub struct MeasurePlan {
    /// The scene; what varies is changed in copies of it.
    pub scene: Scene,
    /// What the scene is called in the report.
    pub name: String,
    /// The method, unless it is varied.
    pub variant: Variant,
    /// Size and samples, unless they are varied.
    pub settings: RenderSettings,
    /// The number of threads, unless it is varied; 0 takes all.
    pub threads: usize,
    /// What is varied: one parameter, or two, the second of which makes a curve for each of its values.
    pub axes: Vec<Axis>,
    /// What is asked of the picture of each point.
    pub questions: Vec<PictureQuestion>,
    /// How often each point is measured, at least once. Eleven give the second least and the second greatest time as the
    /// interval of the median.
    pub rounds: u32,
    /// A point quicker than this is drawn several times in a row, whose mean is one measurement: clocks and threads that
    /// wake up must not count. The number is found in the warm-up and at most 1000.
    pub least_time: Duration,
}

impl MeasurePlan {
    /// How often each point is measured, if nothing is said.
    pub const ROUNDS: u32 = 11;
    /// The least time of a measurement, if nothing is said.
    pub const LEAST_TIME: Duration = Duration::from_millis(20);
    /// The most points.
    pub const MOST_POINTS: usize = MOST_POINTS;
}

/// The reason why nothing could be measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// The parameters do not go together.
    #[error(transparent)]
    Axis(#[from] AxisError),
    /// A parameter says nothing of the method.
    #[error("the method {method} has no {parameter} to vary; choose another method")]
    Meaningless {
        /// The parameter.
        parameter: Parameter,
        /// The method's name.
        method: String,
    },
    /// A value of the scene cannot be set.
    #[error("{} cannot be {value}: {source}", source.path())]
    Setting {
        /// What it should be.
        value: SceneValue,
        /// Why not.
        source: AddressError,
    },
    /// A picture that a value of the scene names cannot be opened.
    #[error(transparent)]
    Image(ImageError),
    /// A value of the scene names a picture that does not exist; a path of a value begins in the current directory.
    #[error("there is no picture {0}; the path begins in the current directory")]
    MissingImage(String),
    /// A pixel that is asked for is not in the picture.
    #[error(
        "{question} is asked, but the picture has {width}x{height} pixels; columns and rows count from 0"
    )]
    Pixel {
        /// What is asked.
        question: PictureQuestion,
        /// The picture's width.
        width: u32,
        /// The picture's height.
        height: u32,
    },
    /// Pictures of different sizes have no difference.
    #[error(
        "flip compares pictures of one size; vary the size as the second parameter, or ask for something else"
    )]
    Sizes,
    /// Pictures cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// Too many points.
    #[error("{0} points are too many to measure: at most {most}", most = MeasurePlan::MOST_POINTS)]
    Points(usize),
    /// The scene cannot be prepared.
    #[error(transparent)]
    Stage(#[from] SceneBuildError),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The threads cannot be started.
    #[error("cannot start {threads} threads; ask for fewer")]
    Threads {
        /// How many.
        threads: usize,
        /// Why.
        source: rayon::ThreadPoolBuildError,
    },
    /// Cancelled before every point was measured once.
    #[error("cancelled before anything was measured")]
    Cancelled,
}

/// The times of one round at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTimes {
    /// In which round, from 0.
    pub round: u32,
    /// The time to prepare the scene, milliseconds.
    pub prepare: f64,
    /// The time to draw the picture, milliseconds: the sum of the passes.
    pub draw: f64,
    /// The time of each pass, milliseconds.
    pub passes: Vec<(PassName, f64)>,
}

/// A combination of values and its measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredPoint {
    /// The value of each axis.
    pub values: Vec<Value>,
    /// How many bodies were drawn.
    pub bodies: usize,
    /// Size and samples.
    pub settings: RenderSettings,
    /// The limit of generations.
    pub generations: u32,
    /// The number of threads.
    pub threads: usize,
    /// The method's name with its settings.
    pub method: String,
    /// The rays of one picture: the same in every run.
    pub rays: RayCounts,
    /// What the picture answers to each question, as many numbers as its columns.
    pub answers: Vec<Vec<f64>>,
    /// How often the picture is drawn for one measurement.
    pub repeats: u32,
    /// The measurements, round by round; the warm-up is none of them.
    pub runs: Vec<PointTimes>,
}

/// The progress of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct SweepProgress<'a> {
    /// Pictures measured, those of the warm-up counted.
    pub done: usize,
    /// All there will be.
    pub total: usize,
    /// The time since the start.
    pub elapsed: Duration,
    /// The time that the rest will take, once every point was drawn.
    pub left: Option<Duration>,
    /// What was measured so far.
    pub points: &'a [MeasuredPoint],
}

/// The result of a sweep.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// What the scene is called.
    pub name: String,
    /// What was varied.
    pub axes: Vec<Axis>,
    /// The key of the format behind each axis, where that varies a value of the scene.
    pub keys: Vec<Option<&'static KeySpec>>,
    /// What was asked of each picture.
    pub questions: Vec<PictureQuestion>,
    /// The points; those of the first axis are next to each other.
    pub points: Vec<MeasuredPoint>,
    /// How many rounds were asked for.
    pub rounds: u32,
    /// Whether all of them were made.
    pub complete: bool,
    /// Where it was measured.
    pub machine: Machine,
}

impl MeasurePlan {
    /// The key of the format behind each axis, where that varies a value of the scene.
    pub fn keys(&self) -> Vec<Option<&'static KeySpec>> {
        let key = |axis: &Axis| match &axis.variable {
            Variable::Parameter(_) => None,
            Variable::Setting(path) => self.scene.key(path).ok(),
        };
        self.axes.iter().map(key).collect()
    }
}

/// Measures what `plan` says.
///
/// Every point is first drawn once without being counted: caches and threads get warm, and it is found how often to
/// draw it for one measurement. Then round follows round, and in each round all points are measured once in an order
/// shuffled anew (always the same for the same plan), so that whatever drifts, such as the processor's clock, hits all
/// alike. Each measurement prepares the scene again, and the scene is made again for each: the memory is that of one.
///
/// `watch` gets the progress after each measurement. When `control` is cancelled, what was measured is kept.
///
/// # Errors
/// When the plan makes no sense, a picture cannot be drawn, or it is cancelled before each point was measured once.
pub fn measure(
    plan: &MeasurePlan,
    control: &RenderControl,
    watch: &mut dyn FnMut(&SweepProgress<'_>),
) -> Result<Measurement, MeasureError> {
    let works = works(plan)?;
    check_questions(plan, &works)?;
    let rounds = plan.rounds.max(1);
    let mut sweep = Sweep {
        plan,
        control,
        pools: HashMap::new(),
        points: Vec::new(),
        costs: Vec::new(),
        first: None,
        total: works.len() * (rounds as usize + 1),
        done: 0,
        start: Instant::now(),
    };
    let outcome = sweep.run(&works, rounds, watch);
    let complete = match outcome {
        Ok(()) => true,
        Err(MeasureError::Method(MethodError::Cancelled)) => false,
        Err(error) => return Err(error),
    };
    if !complete
        && (sweep.points.len() < works.len() || sweep.points.iter().any(|point| point.runs.is_empty()))
    {
        return Err(MeasureError::Cancelled);
    }
    Ok(Measurement {
        name: plan.name.clone(),
        axes: plan.axes.clone(),
        keys: plan.keys(),
        questions: plan.questions.clone(),
        points: sweep.points,
        rounds,
        complete,
        machine: Machine::here(),
    })
}

/// The settings that a point is drawn with.
struct PointSetup {
    values: Vec<Value>,
    /// Values of the scene.
    scene_values: Vec<(ScenePath, SceneValue)>,
    bodies: Option<usize>,
    variant: Variant,
    settings: RenderSettings,
    threads: usize,
    search: AcceleratorChoice,
}

/// Refuses questions that no picture of the plan can answer.
fn check_questions(plan: &MeasurePlan, works: &[PointSetup]) -> Result<(), MeasureError> {
    for &question in &plan.questions {
        for work in works {
            let RenderSettings { width, height, .. } = work.settings;
            if let PictureQuestion::Pixel([x, y]) = question
                && (x >= width || y >= height)
            {
                return Err(MeasureError::Pixel { question, width, height });
            }
        }
        let is_varied = plan.axes.first().is_some_and(|axis| axis.variable == Parameter::Size.into());
        if question == PictureQuestion::Flip && is_varied {
            return Err(MeasureError::Sizes);
        }
    }
    Ok(())
}

/// All combinations of values.
fn works(plan: &MeasurePlan) -> Result<Vec<PointSetup>, MeasureError> {
    Axis::check(&plan.axes)?;
    let counts = plan.axes.iter().map(|axis| axis.values.len());
    let count = counts.fold(1_usize, usize::saturating_mul);
    if count > MeasurePlan::MOST_POINTS {
        return Err(MeasureError::Points(count));
    }
    let mut combinations: Vec<Vec<(&Variable, Value)>> = vec![Vec::new()];
    // The last axis first, so that the values of the first are next to each other.
    for axis in plan.axes.iter().rev() {
        combinations = combinations
            .iter()
            .flat_map(|rest| {
                axis.values
                    .iter()
                    .map(move |value| [vec![(&axis.variable, value.clone())], rest.clone()].concat())
            })
            .collect();
    }
    combinations.iter().map(|values| PointSetup::new(plan, values)).collect()
}

impl PointSetup {
    fn new(plan: &MeasurePlan, values: &[(&Variable, Value)]) -> Result<Self, MeasureError> {
        let mut work = Self {
            values: values.iter().map(|(_, value)| value.clone()).collect(),
            scene_values: Vec::new(),
            bodies: None,
            variant: plan.variant.clone(),
            settings: plan.settings,
            threads: plan.threads,
            search: AcceleratorChoice::Quickest,
        };
        // A method comes first: it brings its own settings.
        let method = Variable::from(Parameter::Method);
        let (methods, others): (Vec<_>, Vec<_>) =
            values.iter().partition(|(variable, _)| **variable == method);
        for (variable, value) in methods.into_iter().chain(others) {
            work.set(variable, value)?;
        }
        work.scene(plan)?;
        work.variant.method.check().map_err(MethodError::from)?;
        if let Some(samples) = work.variant.samples {
            work.settings.samples = samples;
        }
        Ok(work)
    }

    fn set(&mut self, variable: &Variable, value: &Value) -> Result<(), MeasureError> {
        let parameter = match variable {
            Variable::Parameter(parameter) => *parameter,
            Variable::Setting(path) => {
                let value = match value {
                    Value::Setting(value) => value.clone(),
                    other => other.to_string().as_str().into(),
                };
                self.scene_values.push((path.clone(), value));
                return Ok(());
            }
        };
        if !Axis::applies(parameter, &self.variant.method) {
            return Err(MeasureError::Meaningless { parameter, method: self.variant.name.clone() });
        }
        match (parameter, value) {
            (Parameter::Bodies, Value::Count(count)) => self.bodies = Some(*count as usize),
            (Parameter::Generations, Value::Count(count)) => self.variant.generations = Some(*count),
            (Parameter::Samples, Value::Count(count)) => {
                (self.settings.samples, self.variant.samples) = (*count, None);
            }
            (Parameter::Threads, Value::Count(count)) => self.threads = *count as usize,
            (Parameter::Size, Value::Size([width, height])) => {
                (self.settings.width, self.settings.height) = (*width, *height);
            }
            (Parameter::Method, Value::Method(variant)) => self.variant = variant.clone(),
            (Parameter::Search, Value::Search(search)) => self.search = *search,
            (Parameter::Fineness | Parameter::CubeMapSize, Value::Count(count)) => {
                match &mut self.variant.method {
                    Method::Flat(shading) | Method::Gouraud(shading) | Method::Phong(shading) => {
                        shading.fineness = *count;
                    }
                    Method::CubeMap(map) => map.size = *count,
                    Method::Whitted | Method::Ssr(_) => {}
                }
            }
            (_, value) => {
                let (value, expected) = (value.to_string(), "a value of another parameter".to_owned());
                return Err(AxisError::Value { variable: variable.clone(), value, expected }.into());
            }
        }
        Ok(())
    }

    /// The scene with the values of this point, and with as many bodies.
    fn scene<'a>(&self, plan: &'a MeasurePlan) -> Result<Cow<'a, Scene>, MeasureError> {
        let mut scene = Cow::Borrowed(&plan.scene);
        for (path, value) in &self.scene_values {
            let set = scene.to_mut().set(path, value.clone());
            set.map_err(|source| MeasureError::Setting { value: value.clone(), source })?;
        }
        if let Cow::Owned(scene) = &mut scene
            && let Err(errors) = scene.open_images(&Folder::current())
            && let Some(error) = errors.into_iter().next()
        {
            return Err(match error.fault {
                ImageFault::Missing(file) => MeasureError::MissingImage(file),
                _ => MeasureError::Image(error),
            });
        }
        Ok(scene)
    }
}

/// A sweep under way.
struct Sweep<'a> {
    plan: &'a MeasurePlan,
    control: &'a RenderControl,
    pools: HashMap<usize, ThreadPool>,
    points: Vec<MeasuredPoint>,
    /// The seconds that a measurement of each point took last, with making and preparing the scene.
    costs: Vec<f64>,
    /// The first picture of the present curve.
    first: Option<Picture>,
    total: usize,
    done: usize,
    start: Instant,
}

impl Sweep<'_> {
    fn run(
        &mut self,
        works: &[PointSetup],
        rounds: u32,
        watch: &mut dyn FnMut(&SweepProgress<'_>),
    ) -> Result<(), MeasureError> {
        for work in works {
            self.warm_up(work)?;
            self.tell(watch, 0);
        }
        let mut random = Random::new(0);
        let mut order: Vec<usize> = (0..works.len()).collect();
        for round in 0..rounds {
            shuffle(&mut order, &mut random);
            for &index in &order {
                let repeats = self.points.get(index).map_or(1, |point| point.repeats);
                let Some(work) = works.get(index) else { continue };
                let start = Instant::now();
                let drawn = self.draw(work, repeats)?;
                if let (Some(point), Some(cost)) = (self.points.get_mut(index), self.costs.get_mut(index)) {
                    point.runs.push(PointTimes { round, ..drawn.run });
                    *cost = start.elapsed().as_secs_f64();
                }
                self.tell(watch, rounds);
            }
        }
        Ok(())
    }

    /// Counts a measurement and says how far it is.
    fn tell(&mut self, watch: &mut dyn FnMut(&SweepProgress<'_>), rounds: u32) {
        self.done += 1;
        let left = (rounds > 0).then(|| {
            let rest = self.points.iter().zip(&self.costs);
            let rest =
                rest.map(|(point, cost)| cost * (f64::from(rounds) - point.runs.len() as f64).max(0.0));
            Duration::try_from_secs_f64(rest.sum()).unwrap_or(Duration::MAX)
        });
        watch(&SweepProgress {
            done: self.done,
            total: self.total,
            elapsed: self.start.elapsed(),
            left,
            points: &self.points,
        });
    }

    /// Draws a point for the first time, and finds how often to draw it for a measurement.
    fn warm_up(&mut self, work: &PointSetup) -> Result<(), MeasureError> {
        let first = self.draw(work, 1)?;
        let wanted = self.plan.least_time.as_secs_f64() * 1e3 / first.run.draw.max(1e-6);
        let repeats = wanted.ceil().clamp(1.0, 1000.0) as u32;
        let PointResult { run, rays, picture, bodies, generations, threads } = first;
        let answers = picture.map(|picture| self.answers(picture, rays)).transpose()?.unwrap_or_default();
        self.costs.push((run.prepare + run.draw * f64::from(repeats)) / 1e3);
        self.points.push(MeasuredPoint {
            values: work.values.clone(),
            bodies,
            settings: work.settings,
            generations,
            threads,
            method: work.variant.name.clone(),
            rays,
            answers,
            repeats,
            runs: Vec::new(),
        });
        Ok(())
    }

    /// What the picture of the next point answers.
    fn answers(&mut self, picture: Picture, rays: RayCounts) -> Result<Vec<Vec<f64>>, MeasureError> {
        let along = self.plan.axes.first().map_or(1, |axis| axis.values.len().max(1));
        let first = self.first.take().filter(|_| !self.points.len().is_multiple_of(along));
        let questions = self.plan.questions.iter();
        let answers: Result<Vec<Vec<f64>>, CompareError> = questions
            .map(|question| question.answer(&picture, rays, first.as_ref().unwrap_or(&picture)))
            .collect();
        let answers = answers?;
        self.first = Some(first.unwrap_or(picture));
        Ok(answers)
    }

    /// Makes the scene of a point, prepares it and draws it so many times.
    fn draw(&mut self, work: &PointSetup, repeats: u32) -> Result<PointResult, MeasureError> {
        let scene = work.scene(self.plan)?;
        let grown = work.bodies.map(|bodies| grown(&scene, bodies));
        let scene = grown.as_ref().unwrap_or(&scene);
        let control = self.control;
        let pool = self.pool(work.threads)?;
        let start = Instant::now();
        let render_scene = pool.install(|| RenderScene::build_with(scene, work.search))?;
        let prepare = start.elapsed().as_secs_f64() * 1e3;
        let render_scene = match work.variant.generations {
            Some(generations) => render_scene.with_generations(generations),
            None => render_scene,
        };
        let mut drawn = PointResult {
            run: PointTimes { round: 0, prepare, draw: 0.0, passes: Vec::new() },
            rays: RayCounts::default(),
            picture: None,
            bodies: render_scene.body_count(),
            generations: render_scene.generations(),
            threads: pool.current_num_threads(),
        };
        for _ in 0..repeats.max(1) {
            // One picture at a time takes memory.
            drawn.picture = None;
            let drawing =
                pool.install(|| draw(&render_scene, &work.variant.method, work.settings, control))?;
            drawn.rays = drawing.counts;
            drawn.run.add(&drawing.passes, f64::from(repeats.max(1)));
            drawn.picture = Some(drawing.picture);
        }
        Ok(drawn)
    }

    /// The threads, started once for each number of them.
    fn pool(&mut self, threads: usize) -> Result<&ThreadPool, MeasureError> {
        use std::collections::hash_map::Entry;
        match self.pools.entry(threads) {
            Entry::Occupied(entry) => Ok(entry.into_mut()),
            Entry::Vacant(entry) => {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build();
                Ok(entry.insert(pool.map_err(|source| MeasureError::Threads { threads, source })?))
            }
        }
    }
}

/// The times and counts of drawing a point once.
struct PointResult {
    run: PointTimes,
    rays: RayCounts,
    /// The last picture.
    picture: Option<Picture>,
    bodies: usize,
    generations: u32,
    threads: usize,
}

impl PointTimes {
    /// Adds the passes of one of so many drawings.
    fn add(&mut self, passes: &[(PassName, Duration)], repeats: f64) {
        for (name, time) in passes {
            let time = time.as_secs_f64() * 1e3 / repeats;
            self.draw += time;
            match self.passes.iter_mut().find(|(known, _)| known == name) {
                Some((_, sum)) => *sum += time,
                None => self.passes.push((*name, time)),
            }
        }
    }
}

/// Shuffles by R. Durstenfeld, 1964.
fn shuffle(order: &mut [usize], random: &mut Random) {
    for last in (1..order.len()).rev() {
        order.swap(last, random.below(last as u64 + 1) as usize);
    }
}
