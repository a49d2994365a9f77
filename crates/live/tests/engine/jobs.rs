//! Final renders.

use std::sync::Arc;
use std::time::{Duration, Instant};

use catoptric_live::{JobError, RenderJob};
use catoptric_scene::{Body, MaterialChoice, Scene};
use catoptric_tracer::{RenderControl, RenderOutput, RenderScene, RenderSettings, render};

use crate::{endless, four_bodies};

const SETTINGS: RenderSettings = RenderSettings { width: 70, height: 40, samples: 3 };

fn result(job: &RenderJob) -> Result<RenderOutput, JobError> {
    let start = Instant::now();
    while !job.progress().is_finished {
        assert!(start.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(2));
    }
    let result = job.take_result().unwrap();
    assert!(job.take_result().is_none(), "a result is taken once");
    result
}

#[test]
fn a_job_makes_the_picture_of_a_render() {
    for generations in [None, Some(1), Some(3)] {
        let job = RenderJob::start(four_bodies(), SETTINGS, generations, 2).unwrap();
        let found = result(&job).unwrap();
        let progress = job.progress();
        assert_eq!((progress.fraction, progress.remaining), (1.0, Some(Duration::ZERO)));
        assert_eq!(job.progress().elapsed, progress.elapsed);
        let render_scene = RenderScene::build(&four_bodies()).unwrap();
        let render_scene =
            if let Some(limit) = generations { render_scene.with_generations(limit) } else { render_scene };
        let expected = render(&render_scene, SETTINGS, &RenderControl::default()).unwrap();
        assert!(found.picture == expected.picture);
        assert_eq!(found.counts, expected.counts);
    }
}

#[test]
fn a_job_is_cancelled_and_dropped_at_any_moment() {
    let job = RenderJob::start(endless(), SETTINGS, None, 2).unwrap();
    assert!(job.take_result().is_none());
    assert_eq!(job.progress().fraction, 0.0);
    job.cancel();
    assert_eq!(result(&job).unwrap_err(), JobError::Cancelled);
    drop(RenderJob::start(endless(), SETTINGS, None, 0).unwrap());
}

#[test]
fn what_cannot_be_rendered_is_an_error() {
    for (width, height) in [(0, 5), (u32::MAX, u32::MAX)] {
        let job =
            RenderJob::start(four_bodies(), RenderSettings { width, height, samples: 1 }, None, 1).unwrap();
        assert!(matches!(result(&job), Err(JobError::Size(_))));
    }
    let gold = Body { material: MaterialChoice::Named("gold".into()), ..Body::default() };
    let scene = Arc::new(Scene { bodies: [gold].into(), ..Scene::default() });
    let job = RenderJob::start(scene, SETTINGS, None, 1).unwrap();
    assert!(matches!(result(&job), Err(JobError::Stage(_))));
}
