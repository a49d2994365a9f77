//! The audit of a pixel: pinned with the pointer, read in the panel, seen in space.

use catoptric_editor::Label;
use catoptric_scene::{Color, Environment};
use catoptric_studio::host::Host as _;
use catoptric_studio::{
    AuditCommand, CameraCommand, Command, Language, Pane, StartDocument, Studio, WindowCommand,
};
use egui::{Event, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio_with, wait_until};

/// A studio with the audit tool over Whitted's scene, and the place of its glass sphere.
struct Auditor {
    harness: Harness<'static, Studio>,
    host: TestHost,
}

impl Auditor {
    fn new() -> Self {
        let host = TestHost::new();
        let mut harness = studio_with(host.clone(), StartDocument::Example("whitted".to_owned()));
        harness.set_size(Vec2::new(1500.0, 1500.0));
        harness.run_steps(2);
        let mut auditor = Self { harness, host };
        auditor.run(Command::Audit(AuditCommand::Tool));
        auditor.wait_for_picture();
        auditor
    }

    fn run(&mut self, command: impl Into<Command>) {
        self.harness.state_mut().run(command);
        self.harness.run_steps(3);
    }

    /// Until the picture shows the document as it is, in its present size.
    fn wait_for_picture(&mut self) {
        wait_until(&mut self.harness, "the picture", |studio| {
            let revision = studio.editor().revision();
            let rect = studio.viewport_rect().unwrap();
            let size = [rect.width() as u32, rect.height() as u32];
            let frame = studio.live().latest();
            let is_there = frame.is_some_and(|frame| frame.revision == revision && frame.view_size == size);
            is_there && studio.live().status().is_idle
        });
        self.harness.run_steps(3);
    }

    /// A place in the picture, from shares of its width and height.
    fn place(&self, x: f32, y: f32) -> Pos2 {
        let rect = self.harness.state().viewport_rect().unwrap();
        (rect.min + vec2(x, y) * rect.size()).round() + Vec2::splat(0.25)
    }

    /// A place in what is seen of the picture.
    fn visible_place(&self, x: f32, y: f32) -> Pos2 {
        let rect = self.harness.state().visible_rect().unwrap();
        (rect.min + vec2(x, y) * rect.size()).round() + Vec2::splat(0.25)
    }

    /// Column and row of the picture at a place of the window.
    fn pixel_at(&self, pos: Pos2) -> [u32; 2] {
        let at = pos - self.harness.state().viewport_rect().unwrap().min;
        [at.x.floor() as u32, at.y.floor() as u32]
    }

    fn is_panel_seen(&self) -> bool {
        let pane = self.harness.state().pane_rect(Pane::Audit);
        pane.is_some() && self.harness.query_by_label("Slow light").is_some()
    }

    fn click(&mut self, pos: Pos2) {
        let event = |pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        for event in [Event::PointerMoved(pos), event(true), event(false)] {
            self.harness.event(event);
            self.harness.step();
        }
        self.harness.run_steps(2);
    }

    /// Turns the wheel over the list.
    fn scroll(&mut self, points: f32) {
        let rect = self.harness.state().pane_rect(Pane::Audit).unwrap();
        self.harness.event(Event::PointerMoved(rect.center()));
        self.harness.event(Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: vec2(0.0, points),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        self.harness.step();
    }

    /// Pins the pixel at a place, and waits for its rays.
    fn pin(&mut self, pos: Pos2) {
        self.click(pos);
        self.wait_for("Ray", |names| names.iter().any(|name| name.starts_with("1: ")));
    }

    /// The names of all rows of the list, rays and terms.
    fn rows(&self) -> Vec<String> {
        use egui::accesskit::Role;
        let nodes = self.harness.root().children_recursive();
        let is_row = |role| matches!(role, Role::TreeItem | Role::Label);
        nodes
            .filter(|node| is_row(node.accesskit_node().role()))
            .filter_map(|node| node.accesskit_node().label().or_else(|| node.accesskit_node().value()))
            .collect()
    }

    fn wait_for(&mut self, what: &str, condition: impl Fn(&[String]) -> bool) {
        for _ in 0..2000 {
            self.harness.step();
            if condition(&self.rows()) {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        panic!("waited in vain: {what}: {:#?}", self.rows());
    }

    /// The only row that begins so.
    fn row(&self, start: &str) -> String {
        let rows = self.rows();
        let found: Vec<&String> = rows.iter().filter(|row| row.starts_with(start)).collect();
        assert_eq!(found.len(), 1, "{start}: {rows:#?}");
        found[0].clone()
    }

    fn press(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.harness.run_steps(3);
    }

    fn is_selected(&self, start: &str) -> bool {
        let row = self.row(start);
        self.harness.get_by_label(&row).accesskit_node().is_selected() == Some(true)
    }

    fn missing(&self) -> Vec<String> {
        self.harness.state().texts().missing()
    }
}

#[test]
fn numbers_have_the_decimal_sign_of_the_language() {
    let mut audit = Auditor::new();
    audit.pin(audit.place(0.4, 0.45));
    for (language, foreign) in [(Language::English, b','), (Language::Russian, b'.')] {
        audit.run(WindowCommand::Language(language));
        let rows = audit.rows();
        let has_foreign = |row: &&String| {
            row.as_bytes()
                .windows(3)
                .any(|three| three[1] == foreign && three[0].is_ascii_digit() && three[2].is_ascii_digit())
        };
        assert_eq!(rows.iter().find(has_foreign), None, "{language:?}");
        assert!(rows.len() > 20, "{rows:?}");
    }
}

#[test]
fn a_pixel_is_pinned_and_its_rays_are_read() {
    let mut audit = Auditor::new();
    let steps = audit.harness.state().editor().steps_done();
    audit.pin(audit.place(0.4, 0.45));
    assert!(audit.row("Pixel ").contains(" of "), "{:?}", audit.rows());
    assert_eq!(audit.row("exact sum"), "exact sum of the rays");
    // The terms of the primary ray are open at first.
    assert!(audit.row("Ambient:").contains("k_a C I_a = "));
    assert!(audit.row("Adds:").contains(" = "));
    audit.press("Fold ray 1");
    assert!(!audit.rows().iter().any(|row| row.starts_with("Ambient:")));
    audit.press("Terms of ray 2");
    assert!(audit.row("Way:").starts_with("Way: from ("), "{:?}", audit.rows());
    let ray = audit.row("2: ");
    audit.press(&ray);
    assert!(audit.is_selected("2: ") && !audit.is_selected("1: "));
    // Pinning leaves the document as it was.
    assert_eq!(audit.harness.state().editor().steps_done(), steps);
    audit.run(Command::Audit(AuditCommand::Copy));
    audit.run(Command::Audit(AuditCommand::Release));
    assert!(!audit.rows().iter().any(|row| row.starts_with("1: ")));
    assert_eq!(audit.missing(), Vec::<String>::new());
}

#[test]
fn the_panel_opens_with_the_first_pixel_which_stays_under_the_pointer() {
    for (x, y) in [(0.3, 0.2), (0.5, 0.5), (0.7, 0.6)] {
        let mut audit = Auditor::new();
        let whole = audit.harness.state().viewport_rect().unwrap();
        assert!(!audit.is_panel_seen() && audit.harness.state().visible_rect() == Some(whole));
        assert!(
            audit.harness.query_by_label_contains("Click a pixel").is_none(),
            "it is painted over the picture"
        );
        let view = |audit: &Auditor| {
            let frame = audit.harness.state().live().latest().unwrap();
            (frame.camera, frame.view_size)
        };
        let (pos, before) = (audit.place(x, y), view(&audit));
        let pixel = audit.pixel_at(pos);
        audit.pin(pos);
        audit.wait_for_picture();
        let seen = audit.harness.state().visible_rect().unwrap();
        assert!(audit.is_panel_seen() && seen.height() < 0.75 * whole.height(), "{seen}");
        assert!(seen.contains(pos), "{pos} in {seen}");
        let [pinned, _] = audit.harness.state().audited_pixel().unwrap();
        assert_eq!((pinned, audit.pixel_at(pos)), (pixel, pixel));
        assert_eq!(view(&audit), before, "the picture is the same, and no other was traced");
        // Another pixel moves nothing either.
        let rect = audit.harness.state().viewport_rect();
        let other = audit.visible_place(0.2, 0.9);
        audit.pin(other);
        assert_eq!(audit.harness.state().viewport_rect(), rect);
        assert_eq!(audit.harness.state().audited_pixel().unwrap()[0], audit.pixel_at(other));
        // At the end the picture is fitted to its panel again.
        audit.run(Command::Audit(AuditCommand::Release));
        let rect = audit.harness.state().viewport_rect().unwrap();
        assert_eq!(audit.harness.state().visible_rect(), Some(rect));
        assert!(seen.contains_rect(rect), "{rect} in {seen}");
    }
}

#[test]
fn a_pixel_at_the_lower_edge_stays_in_view() {
    let mut audit = Auditor::new();
    let whole = audit.harness.state().viewport_rect().unwrap();
    let pos = audit.place(0.5, 0.97);
    let pixel = audit.pixel_at(pos);
    audit.pin(pos);
    let studio = audit.harness.state();
    let (rect, seen) = (studio.viewport_rect().unwrap(), studio.visible_rect().unwrap());
    let at = rect.min + vec2(pixel[0] as f32, pixel[1] as f32);
    assert!(seen.contains(at), "{at} in {seen}");
    assert_eq!(rect.size(), whole.size());
    assert_eq!(studio.audited_pixel().unwrap()[0], pixel);
    // What is brought into view is not brought under the panel.
    audit.run(Command::Camera(CameraCommand::FrameAll));
    let rect = audit.harness.state().viewport_rect().unwrap();
    assert!(audit.is_panel_seen() && seen.contains_rect(rect), "{rect} in {seen}");
    // With the tool the panel goes, and comes again.
    audit.run(Command::Audit(AuditCommand::Tool));
    assert!(!audit.is_panel_seen());
    assert_eq!(audit.harness.state().visible_rect(), Some(whole));
    audit.run(Command::Audit(AuditCommand::Tool));
    assert!(audit.is_panel_seen());
    // A panel that was opened before the tool stays.
    audit.run(Command::Audit(AuditCommand::Release));
    audit.run(Command::Audit(AuditCommand::Tool));
    audit.run(WindowCommand::TogglePane(Pane::Audit));
    audit.press("Choose the audit tool");
    assert!(audit.harness.query_by_label_contains("Click a pixel of the picture").is_some());
}

#[test]
fn a_ray_is_chosen_in_space_while_the_camera_of_the_audit_stays() {
    let mut audit = Auditor::new();
    audit.pin(audit.place(0.4, 0.45));
    let pixel = audit.row("Pixel ");
    let camera = audit.harness.state().editor().scene().camera;
    // A drag turns the view, with the free camera.
    let (from, to) = (audit.visible_place(0.9, 0.6), audit.visible_place(0.66, 0.72));
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let mut events = vec![Event::PointerMoved(from), button(from, true)];
    events.extend((1..=8).map(|step| Event::PointerMoved(from.lerp(to, step as f32 / 8.0))));
    events.push(button(to, false));
    for event in events {
        audit.harness.event(event);
        audit.harness.step();
    }
    audit.wait_for_picture();
    assert_eq!(audit.harness.state().editor().scene().camera, camera);
    assert_eq!(audit.row("Pixel "), pixel);
    let ends = audit.harness.state().audit_ray_in_window(2).expect("the third ray is seen");
    audit.press("Fold ray 1");
    audit.click(ends[0].lerp(ends[1], 0.35));
    assert!(audit.is_selected("3: "), "{:#?}", audit.rows());
    assert_eq!(audit.row("Pixel "), pixel, "a click on a ray pins no pixel");
    // Back to where it was pinned: the picture is the scene camera's again.
    audit.run(Command::Audit(AuditCommand::View));
    wait_until(&mut audit.harness, "the view back", |studio| {
        studio.live().latest().is_some_and(|frame| frame.camera.position == camera.position)
    });
}

#[test]
fn generations_are_stepped_through_and_slow_light_runs() {
    let mut audit = Auditor::new();
    audit.pin(audit.place(0.4, 0.45));
    audit.press("Fold ray 1");
    let all = audit.row("Generations 1 to ");
    assert!(!all.starts_with("Generations 1 to 1 of"), "{all}");
    while audit.row("Generations 1 to ") != all.replacen(&all[17..18], "1", 1) {
        audit.press("A generation less");
    }
    assert!(!audit.rows().iter().any(|row| row.starts_with("2: ")));
    audit.press("A generation more");
    assert!(audit.rows().iter().any(|row| row.starts_with("2: ")));
    audit.press("All rays");
    assert_eq!(audit.row("Generations 1 to "), all);
    let path = |audit: &Auditor| audit.harness.get_by_label("Path").accesskit_node().numeric_value().unwrap();
    let whole = path(&audit);
    audit.press("Slow light");
    let start = path(&audit);
    assert!(start < whole);
    audit.harness.run_steps(4);
    let later = path(&audit);
    assert!(later > start && later < whole, "{start} {later} {whole}");
    audit.press("Slow light");
    let at_rest = path(&audit);
    audit.harness.run_steps(4);
    assert_eq!(path(&audit), at_rest);
    audit.press("All rays");
    assert_eq!(path(&audit), whole);
}

#[test]
fn a_changed_coefficient_is_marked() {
    let mut audit = Auditor::new();
    audit.pin(audit.place(0.85, 0.9));
    let before = audit.row("Ambient:");
    let studio = audit.harness.state_mut();
    let label = Label::new("edit-ambient-light", "");
    let half = |own: &mut Environment| own.ambient = Color::new(0.1, 0.1, 0.1);
    studio.editor_mut().change_environment(label, half).unwrap();
    studio.editor_mut().settle();
    audit.wait_for("another ambient term", |rows| {
        rows.iter().any(|row| row.starts_with("Ambient:") && *row != before && row.contains("; was "))
    });
}

#[test]
fn the_tree_is_saved_as_a_drawing_in_russian() {
    let mut audit = Auditor::new();
    audit.run(WindowCommand::Language(Language::Russian));
    audit.pin(audit.place(0.4, 0.45));
    assert!(audit.row("Пиксель ").contains(" из "));
    assert!(audit.row("1: ").starts_with("1: первичный – "));
    assert!(audit.row("Фоновый свет:").contains("k_a C I_a = "));
    assert!(audit.row("Поколения с 1 по ").contains(" из "));
    let path = audit.host.path("rays.svg");
    audit.host.answer(Some(path.clone()));
    audit.run(Command::Audit(AuditCommand::Save));
    wait_until(&mut audit.harness, "the drawing", |_| path.exists());
    assert!(std::fs::read_to_string(&path).unwrap().starts_with("<svg "));
    assert!(audit.host.settings_path().is_some());
    assert_eq!(audit.missing(), Vec::<String>::new());
}

/// How long it takes until a tree of more than 2^12 rays is listed and drawn, and how long its frames take then.
#[test]
#[ignore = "a measurement"]
fn how_long_a_large_tree_takes() {
    use std::time::Instant;
    let host = TestHost::new();
    let path = host.path("panes.toml");
    catoptric_store::save(&path, &catoptric_scene::write(&panes(14))).unwrap();
    let mut harness = studio_with(host.clone(), StartDocument::File(path));
    harness.set_size(Vec2::new(1500.0, 900.0));
    harness.run_steps(2);
    let mut audit = Auditor { harness, host };
    audit.run(Command::Audit(AuditCommand::Tool));
    // Nobody has to wait until it is refined.
    wait_until(&mut audit.harness, "a picture", |studio| {
        let bodies = studio.editor().scene().bodies.len();
        bodies == 14
            && studio.live().latest().is_some_and(|frame| frame.revision == studio.editor().revision())
    });
    let clicked = Instant::now();
    audit.click(audit.place(0.5, 0.5));
    while audit.harness.state().audit_rays().is_none() {
        let start = Instant::now();
        audit.harness.step();
        println!(
            "the frame that lists them, if it is the last: {:.1} ms",
            1e3 * start.elapsed().as_secs_f64()
        );
    }
    println!("from the click on: {:.1} ms", 1e3 * clicked.elapsed().as_secs_f64());
    let start = Instant::now();
    audit.harness.step();
    println!("a frame: {:.1} ms", 1e3 * start.elapsed().as_secs_f64());
    // Far down and back.
    for delta in [-60_000.0, 30_000.0, -30_000.0] {
        let start = Instant::now();
        audit.scroll(delta);
        println!("a frame of scrolling: {:.1} ms", 1e3 * start.elapsed().as_secs_f64());
    }
    println!("{} rays", audit.harness.state().audit_rays().unwrap_or(0));
}

/// Panes of glass one behind the other, at whose faces every ray gives two.
fn panes(count: usize) -> catoptric_scene::Scene {
    use catoptric_scene::{Body, Material, MaterialChoice, Phong, Placement, Scene, Shape};
    use glam::DVec3;
    let glass =
        Material::Phong(Phong { reflection: Some(0.4), transmission: 0.5, ior: 1.5, ..Phong::default() });
    let pane = |place: usize| Body {
        shape: Shape::Cube { size: DVec3::new(40.0, 40.0, 0.1) },
        placement: Placement::at(-0.3 * place as f64 * DVec3::Z),
        material: MaterialChoice::Inline(Box::new(glass.clone())),
        ..Body::default()
    };
    let mut scene = Scene { bodies: (0..count).map(pane).collect(), ..Scene::default() };
    scene.lights.push(catoptric_scene::Light::default());
    (scene.tracing.generations, scene.tracing.threshold) = (15, 0.0);
    scene
}

#[test]
fn links_bring_the_pixel_along() {
    let mut audit = Auditor::new();
    let links = std::sync::Arc::<std::sync::Mutex<Vec<String>>>::default();
    audit.host.links = Some(std::sync::Arc::clone(&links));
    let mut harness = studio_with(audit.host.clone(), StartDocument::Example("whitted".to_owned()));
    harness.set_size(Vec2::new(1500.0, 1500.0));
    harness.run_steps(2);
    audit.harness = harness;
    audit.run(Command::Audit(AuditCommand::Tool));
    audit.wait_for_picture();
    let place = audit.visible_place(0.5, 0.5);
    audit.pin(place);
    let pixel = audit.harness.state().audited_pixel().unwrap();
    audit.run(catoptric_studio::FileCommand::CopyLink);
    let view = links.lock().unwrap().pop().unwrap();
    let mut other = studio_with(TestHost::new(), StartDocument::Link(view));
    wait_until(&mut other, "the audit", |studio| studio.audit_rays().is_some());
    assert_eq!(other.state().audited_pixel(), Some(pixel));
    assert_eq!(other.state().audit_rays(), audit.harness.state().audit_rays());
}
