//! Sweeps and their reports. No time is asserted: counts of rays are.

use std::time::Duration;

use catoptric_lab::Machine;
use catoptric_lab::cloud::grown;
use catoptric_lab::measure::{
    Axis, GrowthLaw, MeasureError, MeasurePlan, MeasuredPoint, Measurement, PictureQuestion, PointTimes,
    measure, series,
};
use catoptric_lab::report::{Language, MeasurementReport, study};
use catoptric_picture::decode;
use catoptric_scene::{
    Body, Camera, Example, Material, MaterialChoice, Phong, Placement, Projection, Scene, Shape, Tracing,
    read,
};
use catoptric_tracer::raster::MethodKind;
use catoptric_tracer::{AcceleratorChoice, RayCounts, RenderControl, RenderScene, RenderSettings, render};
use glam::DVec3;

/// Half-silvered panes, one behind the other, seen along their normals from the middle: at each
/// face a ray gives two, and none leaves before many generations.
fn panes() -> Scene {
    let pane = |number: i32| Body {
        shape: Shape::Cube { size: DVec3::new(1000.0, 1000.0, 0.5) },
        placement: Placement::at(DVec3::new(0.0, 0.0, f64::from(number) + 0.5)),
        material: MaterialChoice::Inline(Box::new(Material::Phong(Phong {
            ambient: 0.1,
            reflection: Some(0.5),
            transmission: 0.5,
            ior: 1.5,
            ..Phong::default()
        }))),
        ..Body::default()
    };
    Scene {
        camera: Camera {
            position: DVec3::ZERO,
            target: DVec3::NEG_Z,
            projection: Projection::Parallel { height: 1.0 },
            ..Camera::default()
        },
        tracing: Tracing { generations: 6, threshold: 0.0 },
        bodies: (-20..20).map(pane).collect(),
        ..Scene::default()
    }
}

fn plan(scene: Scene, vary: &str) -> MeasurePlan {
    MeasurePlan {
        scene,
        name: "a {scene} & more".to_owned(),
        variant: MethodKind::Whitted.method().into(),
        settings: RenderSettings { width: 32, height: 18, samples: 1 },
        threads: 2,
        axes: Axis::read(vary, 2).unwrap(),
        questions: Vec::new(),
        rounds: 3,
        least_time: Duration::ZERO,
    }
}

fn run(plan: &MeasurePlan) -> Measurement {
    measure(plan, &RenderControl::default(), &mut |_| {}).unwrap()
}

#[test]
fn rays_double_with_each_generation_where_each_gives_two() {
    let plan = plan(panes(), "generations=1,2,3,4,5,6,7,8");
    let measured = run(&plan);
    for (point, generations) in measured.points.iter().zip(1..) {
        assert_eq!(point.rays.total(), 32 * 18 * ((1 << generations) - 1), "{generations}");
        assert_eq!((point.generations, point.runs.len()), (generations, 3));
    }
    let curves = series(&measured);
    let law = curves[0].rays.as_ref().unwrap();
    assert_eq!(law.law, GrowthLaw::Geometric);
    assert!((law.coefficient("q").unwrap().value - 2.0).abs() < 1e-3, "{law:?}");
}

#[test]
fn weak_mirrors_bound_the_growth() {
    let mut scene = Example::find("whitted").unwrap().load().unwrap().scene;
    scene.tracing.threshold = 0.02;
    let measured = run(&plan(scene, "generations=1,2,3,4,5,6,8,10,12,16"));
    let rays: Vec<u64> = measured.points.iter().map(|point| point.rays.total()).collect();
    assert_eq!(rays[7..], [rays[7]; 3], "no ray is worth following after ten generations: {rays:?}");
    assert_eq!(series(&measured)[0].rays.as_ref().unwrap().law, GrowthLaw::Bounded, "{rays:?}");
}

#[test]
fn every_combination_is_measured_once_a_round_and_told() {
    let scene = Example::find("four-bodies").unwrap().load().unwrap().scene;
    let plan = plan(scene, "bodies=2,5,40,search=hierarchy,one-by-one");
    let mut told = 0;
    let measured = measure(&plan, &RenderControl::default(), &mut |progress| {
        told += 1;
        assert_eq!((progress.done, progress.total), (told, 24));
        assert_eq!(progress.left.is_some(), told > 6);
    });
    let measured = measured.unwrap();
    assert!(measured.complete && told == 24);
    let found: Vec<(String, String, usize)> = measured
        .points
        .iter()
        .map(|point| (point.values[0].to_string(), point.values[1].to_string(), point.bodies))
        .collect();
    let expected = |bodies: usize, search: &str| (bodies.to_string(), search.to_owned(), bodies);
    let of = |search| [2, 5, 40].map(|bodies| expected(bodies, search));
    assert_eq!(found, [of("hierarchy"), of("one-by-one")].concat());
    // However bodies are found, the same rays are traced.
    for (one, other) in measured.points.iter().zip(&measured.points[3..]) {
        assert_eq!(one.rays, other.rays);
    }
    assert_eq!(series(&measured).len(), 2);
}

#[test]
fn the_picture_does_not_depend_on_the_search() {
    let scene = grown(&Example::find("four-bodies").unwrap().load().unwrap().scene, 150);
    let settings = RenderSettings { width: 48, height: 27, samples: 1 };
    let picture = |search| {
        let render_scene = RenderScene::build_with(&scene, search).unwrap();
        render(&render_scene, settings, &RenderControl::default()).unwrap().picture
    };
    assert!(picture(AcceleratorChoice::Quickest) == picture(AcceleratorChoice::OneByOne));
}

#[test]
fn what_was_measured_before_a_cancellation_is_kept() {
    let plan = plan(panes(), "size=16x9,32x18");
    let control = RenderControl::default();
    let measured = measure(&plan, &control, &mut |progress| {
        if progress.done == 5 {
            control.cancel();
        }
    });
    let measured = measured.unwrap();
    assert!(!measured.complete);
    assert_eq!(measured.points.iter().map(|point| point.runs.len()).sum::<usize>(), 3);
    let control = RenderControl::default();
    control.cancel();
    assert!(matches!(measure(&plan, &control, &mut |_| {}), Err(MeasureError::Cancelled)));
}

#[test]
fn plans_that_make_no_sense_are_refused() {
    let refused = |vary: &str| {
        measure(&plan(panes(), vary), &RenderControl::default(), &mut |_| {}).unwrap_err().to_string()
    };
    assert!(refused("fineness=2,3").contains("the method whitted has no fineness to vary"));
    assert!(refused("cube-map-size=2,3").contains("the method whitted has no cube-map-size to vary"));
    let mut many = plan(panes(), "bodies,search");
    for axis in &mut many.axes {
        axis.values = vec![axis.values[0].clone(); 500];
    }
    assert!(matches!(
        measure(&many, &RenderControl::default(), &mut |_| {}),
        Err(MeasureError::Points(250_000))
    ));
    let none = MeasurePlan { axes: Vec::new(), ..plan(panes(), "size") };
    assert!(matches!(measure(&none, &RenderControl::default(), &mut |_| {}), Err(MeasureError::Axis(_))));
}

/// Measurements whose times follow a known law exactly.
fn synthetic(vary: &str, time: impl Fn(&MeasuredPoint) -> f64) -> Measurement {
    let axes = Axis::read(vary, 4).unwrap();
    let points = axes[0].values.iter().map(|value| {
        let mut point = MeasuredPoint {
            values: vec![value.clone()],
            bodies: 5,
            settings: RenderSettings { width: 32, height: 18, samples: 1 },
            generations: 6,
            threads: 2,
            method: "whitted".to_owned(),
            rays: RayCounts { primary: 576, ..RayCounts::default() },
            answers: Vec::new(),
            repeats: 1,
            runs: Vec::new(),
        };
        let middle = time(&point);
        // Eleven runs about the middle, the last far off.
        point.runs = (0..11)
            .map(|round| {
                let off = if round == 10 { 3.0 } else { 1.0 + 0.001 * (f64::from(round) - 4.5) };
                PointTimes { round, prepare: 1.25, draw: middle * off, passes: Vec::new() }
            })
            .collect();
        point
    });
    let points = points.collect();
    let machine = Machine {
        processor: "Processor_1 & 50 %".to_owned(),
        cores: Some(1),
        threads: 2,
        memory_bytes: 3 << 29,
        system: "System".to_owned(),
        program: "catoptric".to_owned(),
    };
    Measurement {
        name: "sphere_flake".to_owned(),
        keys: vec![None; axes.len()],
        axes,
        questions: Vec::new(),
        points,
        rounds: 11,
        complete: true,
        machine,
    }
}

fn text(study: &MeasurementReport, name: &str) -> String {
    let (_, bytes) = study.files.iter().find(|(found, _)| found == name).unwrap();
    String::from_utf8(bytes.clone()).unwrap()
}

#[test]
fn a_study_holds_all_in_both_languages() {
    let measured = synthetic("size", |point| 0.5 + 2e-5 * point.values[0].number().unwrap());
    for (language, median, law) in [
        (Language::English, "0.500 + 2.00·10⁻⁵·C", "linear"),
        (Language::Russian, "0,500 + 2,00·10⁻⁵·C", "линейный"),
    ] {
        let study = study(&measured, language).unwrap();
        let names: Vec<&str> = study.files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["runs.csv", "points.csv", "time.png", "time.svg", "report.md", "report.tex"]);
        // The middle of eleven is the sixth: 0.05 % above.
        assert!(study.laws[0].starts_with(law) && study.laws[0].contains(median), "{:?}", study.laws);
        let svg = text(&study, "time.svg");
        let document = roxmltree::Document::parse(&svg).unwrap();
        let rings = document
            .descendants()
            .filter(|node| node.attribute("fill") == Some("none") && node.has_tag_name("circle"));
        assert_eq!(rings.count(), 7, "an outlier at each point");
        let (_, png) = study.files.iter().find(|(name, _)| name == "time.png").unwrap();
        assert_eq!(decode(png).unwrap().width(), 1440);
        let markdown = text(&study, "report.md");
        assert!(markdown.contains("![") && markdown.contains("(time.svg)") && markdown.contains(median));
        assert!(markdown.contains("sphere\\_flake") && markdown.contains("Processor_1 & 50 %"));
        assert!(!markdown.contains("{scene}") && !markdown.contains("{points}") && !markdown.contains("{n}"));
        let latex = text(&study, "report.tex");
        assert!(latex.contains("sphere\\_flake") && latex.contains("Processor\\_1 \\& 50 \\%"));
        for begin in ["table", "tabular", "figure"] {
            let count = |word: &str| latex.matches(&format!("\\{word}{{{begin}}}")).count();
            assert!(count("begin") > 0 && count("begin") == count("end"), "{begin}");
        }
        // Tables for programs are the same in every language.
        let csv = text(&study, "points.csv");
        let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(rows.len(), 8);
        assert!(rows.iter().all(|row| row.len() == rows[0].len()));
        let column = rows[0].iter().position(|head| *head == "median_ms").unwrap();
        assert!((rows[1][column].parse::<f64>().unwrap() - 0.788).abs() < 0.001, "{csv}");
        assert_eq!(text(&study, "runs.csv").lines().count(), 1 + 7 * 11);
    }
}

#[test]
fn known_laws_are_found_and_named() {
    let law = |vary: &str, time: &dyn Fn(f64) -> f64| {
        let measured = synthetic(vary, |point| time(point.values[0].number().unwrap()));
        let curves = series(&measured);
        let fit = curves[0].law.clone().unwrap();
        assert!(fit.r_squared > 0.999, "{vary}: {fit:?}");
        fit
    };
    assert_eq!(law("size", &|c| 1.0 + 1e-4 * c).law, GrowthLaw::Linear);
    let power = law("bodies", &|n| 3.0 * n.powf(0.35));
    assert!((power.coefficient("α").unwrap().value - 0.35).abs() < 1e-3);
    assert_eq!(
        law("generations=1,2,3,4,5,6,7,8,9,10", &|k| 9.0 - 8.0 * 0.4_f64.powf(k)).law,
        GrowthLaw::Bounded
    );
    assert_eq!(law("generations=1,2,3,4,5,6,7,8,9,10", &|k| 1.0 + 2.0_f64.powf(k)).law, GrowthLaw::Geometric);
    let amdahl = law("threads=1,2,4,8", &|p| 2.0 + 30.0 / p);
    assert!((amdahl.coefficient("a").unwrap().value - 2.0).abs() < 0.01);
}

/// A scene whose light is that of one light alone, and answers to all questions.
fn lit() -> MeasurePlan {
    let text = "format = 'catoptric/1'\n[environment]\nbackground = [0, 0, 0]\nambient = [0, 0, 0]\n\
                [[lights]]\nname = 'lamp'\n[[bodies]]\nname = 'ball'\nposition = [0, 1, 0]\n\
                [[bodies]]\nshape = 'plane'\n";
    MeasurePlan {
        questions: PictureQuestion::read("mean,pixel:16,9,flip,rays").unwrap(),
        rounds: 1,
        ..plan(read(text).into_result().unwrap().value, "lights.lamp.intensity=0,0.5,1,2")
    }
}

#[test]
fn light_grows_with_the_intensity_of_its_only_source() {
    let measured = run(&lit());
    let answers = |question: usize| -> Vec<&[f64]> {
        measured.points.iter().map(|point| point.answers[question].as_slice()).collect()
    };
    for question in [0, 1] {
        let light = answers(question);
        assert!(light[2][3] > 0.01, "{light:?}");
        for (answer, intensity) in light.iter().zip([0.0, 0.5, 1.0, 2.0]) {
            for (part, one) in answer.iter().zip(light[2]) {
                assert!((part - intensity * one).abs() <= 1e-6 * one, "{light:?}");
            }
        }
    }
    let flip = answers(2);
    assert_eq!(flip[0], [0.0]);
    assert!(flip[1][0] > 0.01 && flip[1][0] < flip[2][0], "{flip:?}");
    for (answer, point) in answers(3).into_iter().zip(&measured.points) {
        assert_eq!(answer[0], f64::from(32 * 18));
        assert_eq!(answer[4], point.rays.total() as f64);
    }
    assert_eq!(measured.keys[0].map(|key| key.name), Some("intensity"));
    assert!(series(&measured)[0].law.is_none());
}

#[test]
fn each_curve_has_a_first_picture_of_its_own() {
    let plan = MeasurePlan {
        axes: Axis::read("bodies.ball.radius=0.5,0.5,1,size=32x18,16x16", 2).unwrap(),
        questions: vec![PictureQuestion::Flip],
        ..lit()
    };
    let measured = run(&plan);
    let flip: Vec<f64> = measured.points.iter().map(|point| point.answers[0][0]).collect();
    assert!(flip[0] == 0.0 && flip[1] == 0.0 && flip[3] == 0.0 && flip[4] == 0.0, "{flip:?}");
    assert!(flip[2] > 0.01 && flip[5] > 0.01, "{flip:?}");
}

#[test]
fn a_value_of_the_scene_is_set_before_the_scene_grows() {
    let plan = MeasurePlan {
        axes: Axis::read("bodies=2,30,tracing.generations=1,4", 2).unwrap(),
        questions: Vec::new(),
        ..lit()
    };
    let found: Vec<(usize, u32)> =
        run(&plan).points.iter().map(|point| (point.bodies, point.generations)).collect();
    assert_eq!(found, [(2, 1), (30, 1), (2, 4), (30, 4)]);
}

#[test]
fn what_a_picture_answers_is_reported() {
    let plan = MeasurePlan { axes: Axis::read("bodies.ball.radius=0.25..1:4", 2).unwrap(), ..lit() };
    let measured = run(&plan);
    for (language, said) in [(Language::English, "meters"), (Language::Russian, "метры")] {
        let study = study(&measured, language).unwrap();
        let names: Vec<&str> = study.files.iter().map(|(name, _)| name.as_str()).collect();
        let possible = MeasurementReport::names(&measured.questions);
        assert!(names.iter().all(|name| possible.iter().any(|possible| possible == name)), "{names:?}");
        for stem in ["time", "rays", "mean", "pixel-16-9", "flip"] {
            let svg = text(&study, &format!("{stem}.svg"));
            assert!(roxmltree::Document::parse(&svg).is_ok() && svg.contains(said), "{stem}");
        }
        let markdown = text(&study, "report.md");
        assert!(markdown.contains(&format!("| bodies.ball.radius, {said} |")), "{markdown}");
        assert!(markdown.contains("bodies.ball.radius") && markdown.contains("(mean.svg)"), "{markdown}");
        assert!(!markdown.contains("law fitted") && !markdown.contains("подобранный закон"), "{markdown}");
        let law = study.laws.join("\n");
        assert!(law.contains(["No law is expected", "закон не предполагается"][language as usize]), "{law}");
        let csv = text(&study, "points.csv");
        let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
        assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{csv}");
        assert_eq!(
            rows.iter().map(|row| row[0]).collect::<Vec<_>>(),
            ["bodies.ball.radius", "0.25", "0.5", "0.75", "1"]
        );
        let column = rows[0].iter().position(|head| *head == "mean_luminance").unwrap();
        assert_eq!(rows[1][column], measured.points[0].answers[0][3].to_string());
        assert!(rows[0].ends_with(&["pixel_16_9_luminance", "flip"]), "{csv}");
    }
}

#[test]
fn values_and_questions_that_make_no_sense_are_refused() {
    let refused = |vary: &str, questions: &str| {
        let questions = PictureQuestion::read(questions).unwrap();
        let plan = MeasurePlan { axes: Axis::read(vary, 2).unwrap(), questions, ..lit() };
        measure(&plan, &RenderControl::default(), &mut |_| {}).unwrap_err().to_string()
    };
    for (vary, questions, said) in [
        (
            "bodies.ball.radius=1,0",
            "mean",
            "bodies.ball.radius cannot be 0: `radius` is `0`, but must be greater than 0",
        ),
        (
            "bodies.bal.radius=1",
            "mean",
            "bodies.bal.radius cannot be 1: `bodies` has no element `bal`; did you mean",
        ),
        ("bodies.ball.shape=cub", "mean", "bodies.ball.shape cannot be \"cub\": `shape` is `cub`"),
        (
            "environment.picture=none.png",
            "mean",
            "there is no picture none.png; the path begins in the current directory",
        ),
        ("size=32x18,8x8", "pixel:9,3", "pixel:9,3 is asked, but the picture has 8x8 pixels"),
        ("size=32x18,8x8", "flip", "flip compares pictures of one size"),
    ] {
        let error = refused(vary, questions);
        assert!(error.starts_with(said), "{vary}: {error}");
    }
}
