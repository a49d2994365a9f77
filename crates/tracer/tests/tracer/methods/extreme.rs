//! Scenes at the ends of what the format allows, by all methods: every picture comes to an end, and every light in it is a
//! number.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

use catoptric_scene::Scene;
use catoptric_scene::format::keys;
use catoptric_scene::format::read;
use catoptric_scene::format::spec::{KeySpec, Kind, Limits, TableSpec, When};
use catoptric_tracer::raster::{Method, MethodKind, draw};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// So much of a processor's time no picture of a few pixels takes, by far; a hang takes all there is.
const MOST_SECONDS: u64 = 120;
/// Scenes that are tried.
const SCENES: usize = 300;

struct Dice(TestRng);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        (self.0.next_u64() % limit.max(1) as u64) as usize
    }

    fn share(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number of this range: often an end, 0 or 1, else any power of ten as likely as another, or something usual.
    fn number(&mut self, Limits { min, max }: Limits) -> f64 {
        let within = |value: f64| value.clamp(min, max);
        match self.below(10) {
            0 => min,
            1 => max,
            2 => within(0.0),
            3 => within(1.0),
            4..=6 => {
                let least = if min > 0.0 { min.log10() } else { -9.0 };
                let size = 10.0_f64.powf(least + self.share() * (max.log10() - least));
                within(if min < 0.0 && self.below(2) == 0 { -size } else { size })
            }
            _ => within(4.0 * self.share() - if min < 0.0 { 2.0 } else { 0.0 }),
        }
    }

    fn numbers(&mut self, limits: Limits) -> String {
        let [x, y, z] = [(); 3].map(|()| self.number(limits));
        // Bodies that stand in each other are of more interest than those apart.
        if self.below(3) == 0 { format!("[{x:e}, {x:e}, {x:e}]") } else { format!("[{x:e}, {y:e}, {z:e}]") }
    }

    fn value(&mut self, key: &KeySpec) -> Option<String> {
        Some(match key.kind {
            // Deep trees of glass have no end that could be waited for.
            Kind::Integer(limits) => {
                format!("{}", self.number(Limits::new(limits.min, limits.max.min(7.0))) as i64)
            }
            Kind::Number(limits) => format!("{:e}", self.number(limits)),
            Kind::Vector(limits) | Kind::Color(limits) => self.numbers(limits),
            Kind::NumberOrVector(limits) if self.below(2) == 0 => format!("{:e}", self.number(limits)),
            Kind::NumberOrVector(limits) => self.numbers(limits),
            Kind::Choice(words) => format!("\"{}\"", words.get(self.below(words.len()))?),
            Kind::Flag => format!("{}", self.below(3) == 0),
            Kind::Table(table) | Kind::NameOrTable(table) => {
                format!("{{ {} }}", self.table(table).join(", "))
            }
            // The parts of a body.
            Kind::List(table) => {
                let parts = 0..=self.below(3);
                let parts: Vec<String> =
                    parts.map(|_| format!("{{ {} }}", self.table(table).join(", "))).collect();
                format!("[{}]", parts.join(", "))
            }
            Kind::Version(_) | Kind::Text | Kind::File | Kind::Named(_) => return None,
        })
    }

    /// Some keys of a table, with values.
    fn table(&mut self, table: &'static TableSpec) -> Vec<String> {
        let mut chosen: Vec<(&str, String)> = Vec::new();
        let is_choice = |key: &&KeySpec| matches!(key.kind, Kind::Choice(_));
        let (choices, others): (Vec<&KeySpec>, Vec<&KeySpec>) =
            table.keys.iter().partition(|key| is_choice(key));
        for key in choices.into_iter().chain(others) {
            // Shapes and models are mostly chosen, hidden things make no picture.
            let wanted = match key.kind {
                // What has parts needs them.
                Kind::List(_) => true,
                Kind::Choice(_) => self.below(4) > 0,
                _ => self.below(2) == 0,
            };
            let is_excluded = chosen.iter().any(|(name, _)| key.excludes.contains(name))
                || table.keys.iter().any(|other| {
                    other.excludes.contains(&key.name) && chosen.iter().any(|(name, _)| *name == other.name)
                });
            let applies = match key.when {
                When::Always => true,
                When::Choice { choice, values } => {
                    let value =
                        chosen.iter().find(|(name, _)| *name == choice).map(|(_, value)| value.as_str());
                    let default = table.key(choice).and_then(|key| match key.default {
                        catoptric_scene::format::spec::Default::Text(word) => Some(word),
                        _ => None,
                    });
                    let value = value.map(|value| value.trim_matches('"')).or(default);
                    value.is_some_and(|value| values.contains(&value))
                }
            };
            if !wanted || is_excluded || !applies || key.name == "hidden" {
                continue;
            }
            let Some(value) = self.value(key) else { continue };
            chosen.push((key.name, value));
            if let Some(needed) = key.requires.and_then(|name| table.key(name))
                && !chosen.iter().any(|(name, _)| *name == needed.name)
                && let Some(value) = self.value(needed)
            {
                chosen.push((needed.name, value));
            }
        }
        chosen.into_iter().map(|(name, value)| format!("{name} = {value}")).collect()
    }

    /// An item of a list of the scene.
    fn item(&mut self, name: &str, table: &'static TableSpec) -> String {
        format!("[[{name}]]\n{}\n", self.table(table).join("\n"))
    }

    fn scene(&mut self) -> String {
        let mut text = "format = \"catoptric/1\"\n".to_owned();
        for (name, table) in
            [("camera", &keys::CAMERA), ("environment", &keys::ENVIRONMENT), ("tracing", &keys::TRACING)]
        {
            text += &format!("[{name}]\n{}\n", self.table(table).join("\n"));
        }
        for (name, table, most) in [("lights", &keys::LIGHT, 3), ("bodies", &keys::BODY, 5)] {
            for _ in 0..=self.below(most) {
                // Sizes often do not fit each other: what is refused is made once more.
                let first = self.item(name, table);
                let is_right = read(&format!("format = \"catoptric/1\"\n{first}")).into_result().is_ok();
                text += &if is_right { first } else { self.item(name, table) };
            }
        }
        text
    }
}

/// What the thread that draws says: which of the system's threads it is, what it draws next, and what is wrong.
enum Word {
    Thread(String),
    Next(String),
    Wrong(String),
}

/// The seconds that a thread of this process has had of a processor; `None` where the system does not tell.
fn seconds_of(thread: &str) -> Option<u64> {
    let had = std::fs::read_to_string(format!("/proc/{thread}/schedstat")).ok()?;
    Some(had.split(' ').next()?.parse::<u64>().ok()? / 1_000_000_000)
}

/// Draws scenes in a thread, and watches that it goes on. The program is ended where it does not: nothing else would end the
/// thread.
fn watched(work: impl FnOnce(&Sender<Word>) + Send + 'static) {
    let (sender, receiver) = channel();
    let drawing = std::thread::spawn(move || {
        let own = std::fs::read_link("/proc/thread-self").map(|path| path.display().to_string());
        sender.send(Word::Thread(own.unwrap_or_default())).unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().unwrap();
        pool.install(|| work(&sender));
    });
    let (mut thread, mut drawn, mut before, mut wrong) = (String::new(), String::new(), 0, Vec::new());
    loop {
        match receiver.recv_timeout(Duration::from_secs(1)) {
            Ok(Word::Thread(own)) => {
                thread = own;
                if seconds_of(&thread).is_none() {
                    eprintln!(
                        "skipped: the watch over the processor's time, since the system does not tell it"
                    );
                }
            }
            Ok(Word::Next(scene)) => {
                drawn = scene;
                before = seconds_of(&thread).unwrap_or(0);
            }
            Ok(Word::Wrong(what)) => wrong.push(what),
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => {
                if seconds_of(&thread).is_some_and(|had| had >= before + MOST_SECONDS) {
                    eprintln!("no end after {MOST_SECONDS} s of a processor's time:\n{drawn}");
                    std::process::exit(101);
                }
            }
        }
    }
    drawing.join().unwrap();
    assert!(wrong.is_empty(), "{} pictures are wrong, the first:\n{}", wrong.len(), wrong[0]);
}

/// Draws a scene by all methods.
fn draw_all(text: &str, scene: &Scene, (width, height): (u32, u32), sender: &Sender<Word>) {
    let render_scene = RenderScene::build(scene).unwrap();
    for kind in MethodKind::ALL {
        sender.send(Word::Next(format!("{kind}\n{text}"))).unwrap();
        let mut method = kind.method();
        if let Method::CubeMap(settings) = &mut method {
            settings.size = 4;
        }
        let settings = RenderSettings { width, height, samples: 2 };
        let drawing = draw(&render_scene, &method, settings, &RenderControl::default()).unwrap();
        let mut parts = drawing.picture.pixels().iter().flatten();
        if let Some(part) = parts.find(|part| !part.is_finite()) {
            sender.send(Word::Wrong(format!("{part} by {kind}\n{text}"))).unwrap();
        }
    }
}

#[test]
fn extreme_scenes_give_finite_pictures_by_all_methods() {
    let scenes = std::env::var("EXTREME_SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(SCENES);
    let seed = std::env::var("EXTREME_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(34_u8);
    watched(move |sender| {
        let mut dice = Dice(TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]));
        let mut accepted = 0;
        for _ in 0..scenes {
            let text = dice.scene();
            let size = [(6, 4), (1, 1), (2, 2), (9, 3)][dice.below(4)];
            let Ok(read) = read(&text).into_result() else { continue };
            accepted += 1;
            draw_all(&text, &read.value, size, sender);
        }
        assert!(2 * accepted > scenes, "only {accepted} of {scenes} scenes were accepted");
    });
}

/// Marches that once counted their steps from a place that rounding had carried far away, and other ends of ranges.
#[test]
fn known_extremes_come_to_an_end_with_finite_light() {
    const SCENES: [(&str, (u32, u32)); 5] = [
        (
            "[camera]\nposition = [0, 0, 15653.500727504002]\ntarget = [-3e+00, 0, 0]\n\
             [materials.m3]\nmodel = \"coated\"\n\
             [[bodies]]\nshape = \"cylinder\"\nradius = 8e-02\nbase = [-3e+00, 0, 0]\ntop = [0, 0, 0]\n\
             scale = [3e+07, 2e+02, 1.33e+07]\nmaterial = \"m3\"",
            (2, 2),
        ),
        (
            "[camera]\nposition=[0.0, 1.0, -4.0101059069219005]\nfov=0.001\n\
             [[bodies]]\nshape=\"cone\"\nradius=1000000000.0\n\
             base=[4.133621335763493, -1.315384764209008, -2.908538324429305]\n\
             top=[2.0, 1000002.9927344345, 0.2882058641909071]\n\
             material={model=\"coated\",color=[1, 0.815657, 1000000.0],ior=0.5,roughness=0.3}",
            (1, 1),
        ),
        ("[[bodies]]\nmaterial={model=\"coated\",color=[1,1,1],ior=0.01}\n[[lights]]", (40, 30)),
        (
            "[camera]\nposition=[0.1,0,0]\ntarget=[1,0,0]\n[tracing]\ngenerations=64\n\
             [[bodies]]\nmaterial={reflection=1e6,color=[1e6,0,1],specular=1e6}\n\
             [[lights]]\nposition=[0,0.2,0]\nintensity=1e6\ncolor=[1e6,0,1]\nfalloff=\"inverse-square\"",
            (8, 6),
        ),
        (
            "[[bodies]]\nmaterial={model=\"mirror\",roughness=1e-9,reflection=1e6,color=[1e6,0,1]}\n\
             [[bodies]]\nshape=\"plane\"\nmaterial={model=\"dielectric\",roughness=1e-5,ior=100}\n[[lights]]\nradius=1e-9",
            (20, 15),
        ),
    ];
    watched(|sender| {
        for (text, size) in SCENES {
            let text = format!("format = \"catoptric/1\"\n{text}\n");
            let scene = read(&text).into_result().unwrap().value;
            draw_all(&text, &scene, size, sender);
        }
    });
}
