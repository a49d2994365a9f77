//! Everything has room: in windows of every size, in both languages, for everything that can be selected.

use std::collections::BTreeSet;

use catoptric_editor::{Action, Label};
use catoptric_scene::{
    Attenuation, Body, Color, Conductor, Dielectric, Falloff, Material, MaterialChoice, MetalOptics, Model,
    Pattern, Phong, ScenePart, Shape, Sky, SolidTexture, Surroundings,
};
use catoptric_studio::host::Host as _;
use catoptric_studio::{CameraCommand, Command, Pane, StartDocument, Studio, WindowCommand};
use egui::epaint::ClippedShape;
use egui::{Rect, Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;

use crate::kit::item_at;
use crate::kit::{TestHost, studio_with};

type Window = Harness<'static, Studio>;

/// Sizes of windows, points, at two zooms.
const SIZES: [[f32; 2]; 6] =
    [[800.0, 500.0], [800.0, 600.0], [1024.0, 768.0], [1280.0, 720.0], [1920.0, 1080.0], [3840.0, 2160.0]];
const ZOOMS: [f32; 2] = [1.0, 1.5];

fn open(language: &str) -> Window {
    let host = TestHost::new();
    let text = format!(r#"{{"language": "{language}", "is_hint_dismissed": true, "viewport_samples": 1}}"#);
    std::fs::write(host.settings_path().unwrap(), text).unwrap();
    studio_with(host, StartDocument::Example("four-bodies".to_owned()))
}

/// A change of the scene that shows other rows, and what is selected then.
struct Case {
    name: &'static str,
    change: fn(&mut Window) -> Vec<ScenePart>,
}

fn body(window: &Window, name: &str) -> usize {
    window.state().editor().scene().bodies.iter().position(|body| body.name == name).unwrap()
}

fn change_sphere(window: &mut Window, change: impl Fn(&mut Body)) -> Vec<ScenePart> {
    let index = body(window, "sphere");
    let editor = window.state_mut().editor_mut();
    editor.select_parts([ScenePart::Body(index)]);
    let _ = editor.apply(Action::MakeMaterialUnique);
    editor.change_body(index, Label::new("edit-shape", ""), change).unwrap();
    editor.settle();
    vec![ScenePart::Body(index)]
}

fn shaped(window: &mut Window, shape: Shape) -> Vec<ScenePart> {
    change_sphere(window, |body| body.shape = shape)
}

fn made_of(window: &mut Window, change: impl Fn(&mut Material)) -> Vec<ScenePart> {
    change_sphere(window, |body| {
        let mut material = Material::default();
        change(&mut material);
        body.material = MaterialChoice::Inline(Box::new(material));
    })
}

fn around(window: &mut Window, surroundings: &Surroundings) -> Vec<ScenePart> {
    let editor = window.state_mut().editor_mut();
    let label = Label::new("edit-surroundings", "");
    editor.change_environment(label, |own| own.surroundings = surroundings.clone()).unwrap();
    editor.settle();
    vec![ScenePart::Environment]
}

const CASES: [Case; 19] = [
    Case { name: "nothing", change: |_| Vec::new() },
    Case { name: "sphere", change: |window| shaped(window, Shape::SPHERE) },
    Case { name: "cube", change: |window| shaped(window, Shape::CUBE) },
    Case { name: "cylinder", change: |window| shaped(window, Shape::CYLINDER) },
    Case { name: "cone", change: |window| shaped(window, Shape::CONE) },
    Case { name: "plane", change: |window| shaped(window, Shape::Plane) },
    Case {
        name: "several",
        change: |window| vec![ScenePart::Body(body(window, "sphere")), ScenePart::Body(body(window, "cube"))],
    },
    Case {
        name: "locked",
        change: |window| {
            let part = ScenePart::Body(body(window, "cube"));
            let item = item_at(window.state(), part);
            window.state_mut().editor_mut().apply(Action::SetLocked { item, locked: true }).unwrap();
            vec![part]
        },
    },
    Case {
        name: "glass of Phong",
        change: |window| {
            made_of(window, |material| {
                *material = Material::Phong(Phong {
                    pattern: Pattern {
                        color: Color::new(0.123_456, 0.234_567, 0.345_678),
                        solid: Some(SolidTexture::default()),
                        ..Pattern::default()
                    },
                    transmission: 0.85,
                    ior: 1.517,
                    reflection: Some(0.123_456),
                    tint: Color::new(0.9, 0.812_345, 0.7),
                    ..Phong::default()
                });
            })
        },
    },
    Case {
        name: "dielectric",
        change: |window| {
            made_of(window, |material| {
                let color = Color::new(0.123_456, 0.9, 0.345_678);
                let attenuation = Attenuation { color, ..Attenuation::default() };
                *material = Dielectric { dispersion: true, attenuation, ..Dielectric::default() }.into();
            })
        },
    },
    Case { name: "metal", change: |window| made_of(window, |material| *material = Model::Conductor.into()) },
    Case {
        name: "own metal",
        change: |window| {
            made_of(window, |material| {
                let (n, k) = (DVec3::new(0.143, 0.375, 1.442), DVec3::new(3.983, 2.386, 1.603));
                let metal = MetalOptics::Index { n, k };
                *material = Conductor { metal, ..Conductor::default() }.into();
            })
        },
    },
    Case { name: "mirror", change: |window| made_of(window, |material| *material = Model::Mirror.into()) },
    Case { name: "matte", change: |window| made_of(window, |material| *material = Model::Matte.into()) },
    Case { name: "coated", change: |window| made_of(window, |material| *material = Model::Coated.into()) },
    Case {
        name: "light",
        change: |window| {
            let editor = window.state_mut().editor_mut();
            let far = |light: &mut catoptric_scene::Light| light.falloff = Falloff::Linear { constant: 1.25 };
            editor.change_lights([0], Label::new("edit-falloff", ""), |_, light| far(light)).unwrap();
            editor.settle();
            vec![ScenePart::Light(0)]
        },
    },
    Case { name: "material", change: |_| vec![ScenePart::Material(0)] },
    Case { name: "sky", change: |window| around(window, &Surroundings::Sky(Sky::default())) },
    Case { name: "tracing", change: |_| vec![ScenePart::Tracing] },
];

fn show(window: &mut Window, size: [f32; 2], zoom: f32, items: &[ScenePart]) {
    window.set_size(vec2(size[0], size[1]) / zoom);
    window.state_mut().editor_mut().select_parts(items.iter().copied());
    window.run_steps(4);
}

/// The roles of what can be used or read.
const USED: [Role; 11] = [
    Role::Button,
    Role::SpinButton,
    Role::Slider,
    Role::CheckBox,
    Role::RadioButton,
    Role::ComboBox,
    Role::TextInput,
    Role::ColorWell,
    Role::Label,
    Role::DisclosureTriangle,
    Role::TreeItem,
];

/// What lies across the left or right edge of its panel or of the window.
fn cut_controls(window: &Window) -> Vec<String> {
    let screen = window.ctx.content_rect();
    let studio = window.state();
    let panels: Vec<Rect> = [Pane::Outliner, Pane::Inspector, Pane::Viewport]
        .into_iter()
        .filter_map(|pane| studio.pane_rect(pane))
        .collect();
    let tabs = tab_texts(window);
    let mut cut = Vec::new();
    for node in window.query_all_by(|node| USED.contains(&node.role())) {
        let rect = node.rect();
        let own = node.accesskit_node();
        let name = own.label().or(own.value()).unwrap_or_default();
        // Tabs that have no room are reached by the arrows of their bar.
        if tabs.iter().any(|tab| name.ends_with(tab)) {
            continue;
        }
        // What is scrolled out of view stays within the sides of its panel.
        let center = rect.center();
        let is_in = |panel: &&Rect| {
            let is_beside_bars = panel.y_range().contains(center.y) || center.y > screen.bottom();
            panel.x_range().contains(center.x) && is_beside_bars
        };
        let room = panels.iter().find(is_in).map_or(screen, |panel| panel.intersect(screen));
        let is_cut = rect.left() < room.left() - 0.5 || rect.right() > room.right() + 0.5;
        if is_cut || !rect.is_finite() {
            cut.push(format!("{:?} {name:?} {rect} in {room}", node.accesskit_node().role()));
        }
    }
    cut
}

/// The names of tabs, and the sign of a cross.
fn tab_texts(window: &Window) -> Vec<String> {
    let texts = window.state().texts();
    let names = Pane::ALL.iter().map(|pane| texts.get(pane.key()).to_owned());
    names.chain([egui_material_icons::icons::ICON_CLOSE.codepoint.to_owned()]).collect()
}

/// The texts that are drawn with an ellipsis, and those that are cut at their sides.
fn cut_texts(window: &Window) -> (BTreeSet<String>, BTreeSet<String>) {
    fn visit(shape: &egui::Shape, clip: Rect, elided: &mut BTreeSet<String>, cut: &mut BTreeSet<String>) {
        match shape {
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| visit(shape, clip, elided, cut)),
            egui::Shape::Text(text) => {
                let rect = text.visual_bounding_rect();
                if !rect.is_positive() || !clip.is_positive() || !clip.y_range().contains(rect.center().y) {
                    return;
                }
                let words = text.galley.job.text.clone();
                if text.galley.elided {
                    elided.insert(words);
                } else if rect.left() < clip.left() - 1.5 || rect.right() > clip.right() + 1.5 {
                    cut.insert(format!("{words} {rect} in {clip}"));
                }
            }
            _ => {}
        }
    }
    let (mut elided, mut cut) = (BTreeSet::new(), BTreeSet::new());
    for ClippedShape { clip_rect, shape, .. } in &window.output().shapes {
        visit(shape, *clip_rect, &mut elided, &mut cut);
    }
    let tabs = tab_texts(window);
    cut.retain(|text| !tabs.iter().any(|tab| text.starts_with(tab)));
    (elided, cut)
}

fn everything_fits(language: &str) {
    let mut window = open(language);
    let mut faults: Vec<String> = Vec::new();
    for Case { name, change } in CASES {
        let items = change(&mut window);
        for size in SIZES {
            for zoom in ZOOMS {
                show(&mut window, size, zoom, &items);
                let place = format!("{name} at {size:?}, zoom {zoom}");
                faults.extend(cut_controls(&window).into_iter().map(|what| format!("{place}: {what}")));
                let (elided, cut) = cut_texts(&window);
                faults.extend(cut.into_iter().map(|what| format!("{place}: text {what}")));
                if size[0] >= 1280.0 && zoom == 1.0 {
                    faults.extend(elided.into_iter().map(|what| format!("{place}: elided {what}")));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn everything_fits_in_english() {
    everything_fits("english");
}

#[test]
fn everything_fits_in_russian() {
    everything_fits("russian");
}

/// However long a name is, what stands beside it keeps its place.
#[test]
fn long_names_push_nothing_out() {
    let mut window = open("russian");
    let long = "очень длинное имя ".repeat(20);
    let index = body(&window, "sphere");
    let editor = window.state_mut().editor_mut();
    for part in [ScenePart::Body(index), ScenePart::Light(0), ScenePart::Material(0)] {
        let item = editor.edited().item(part).unwrap();
        editor.apply(Action::Rename { item, name: long.clone() }).unwrap();
    }
    for item in [ScenePart::Body(index), ScenePart::Light(0), ScenePart::Material(0)] {
        for size in SIZES {
            for zoom in ZOOMS {
                show(&mut window, size, zoom, &[item]);
                assert_eq!(cut_controls(&window), Vec::<String>::new(), "{item:?} {size:?} {zoom}");
            }
        }
    }
}

/// Panels keep their width in points, and the picture takes what the window has more.
#[test]
fn a_wide_window_widens_the_picture() {
    let mut window = open("english");
    let widths = |window: &mut Window, size| {
        show(window, size, 1.0, &[]);
        [Pane::Outliner, Pane::Viewport, Pane::Inspector]
            .map(|pane| window.state().pane_rect(pane).unwrap().width())
    };
    let [outliner, _, inspector] = widths(&mut window, [1280.0, 720.0]);
    for size in [[1920.0, 1080.0], [3840.0, 2160.0]] {
        let [left, picture, right] = widths(&mut window, size);
        assert!((left - outliner).abs() < 1.0 && (right - inspector).abs() < 1.0, "{size:?}: {left} {right}");
        assert!(picture > size[0] - outliner - inspector - 10.0);
    }
    let [_, picture, right] = widths(&mut window, [800.0, 500.0]);
    assert!(picture >= 300.0 && right >= 200.0, "{picture} {right}");
    let [left, _, right] = widths(&mut window, [1280.0, 720.0]);
    assert_eq!([left, right], [outliner, inspector], "a small window does not change them for good");
}

/// The panels of the drawer can be used in the smallest window.
#[test]
fn the_drawer_fits_a_small_window() {
    let mut faults = Vec::new();
    for language in ["english", "russian"] {
        let mut window = open(language);
        for pane in [Pane::Problems, Pane::Audit, Pane::Compare, Pane::Measure, Pane::Materials] {
            window.state_mut().run(WindowCommand::TogglePane(pane));
            for zoom in ZOOMS {
                show(&mut window, [800.0, 500.0], zoom, &[]);
                let rect = window.state().pane_rect(pane).unwrap();
                assert!(rect.width() > 150.0 && rect.height() > 50.0, "{language} {pane:?} {zoom}: {rect}");
                let cut = cut_controls(&window).into_iter();
                faults.extend(cut.map(|what| format!("{language} {pane:?} {zoom}: {what}")));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The manual, the note and the row for a new folder have room in the smallest window.
#[test]
fn what_opens_over_a_small_window_fits() {
    let mut faults = Vec::new();
    for language in ["english", "russian"] {
        let mut window = open(language);
        for command in ["help.manual", "help.example-note", "file.open"] {
            window.state_mut().run(Command::from_name(command).unwrap().clone());
            for zoom in ZOOMS {
                show(&mut window, [800.0, 500.0], zoom, &[]);
                window.run_steps(3);
                let screen = window.ctx.content_rect();
                let buttons = window.query_all_by_role(Role::Button).map(|node| node.rect());
                let out = buttons.filter(|rect| rect.left() < -0.5 || rect.right() > screen.right() + 0.5);
                faults.extend(out.map(|rect| format!("{language} {command:?} {zoom}: {rect} in {screen}")));
            }
            for _ in 0..3 {
                window.key_press(egui::Key::Escape);
                window.run_steps(2);
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// On a telephone the bar over the picture is one row, whose end is reached by scrolling and by Tab.
#[test]
fn the_bar_over_the_picture_of_a_telephone_is_one_row() {
    for language in ["english", "russian"] {
        let mut window = open(language);
        window.state_mut().run(CameraCommand::ToggleFreeView);
        show(&mut window, [390.0, 844.0], 1.0, &[]);
        let texts = window.state().texts();
        let [first, last] = ["command-tool-move", "command-toggle-fly"].map(|key| texts.get(key).to_owned());
        let button = |window: &Window, name: &str| {
            window.get_all_by_role_and_label(Role::Button, name).next().unwrap().rect()
        };
        let picture = window.state().pane_rect(Pane::Viewport).unwrap();
        let (begin, end) = (button(&window, &first), button(&window, &last));
        assert_eq!(begin.y_range(), end.y_range(), "{language}");
        // With the badge of the free view below.
        assert!(begin.bottom() < picture.top() + 50.0, "{language}: {begin} in {picture}");
        assert!(
            begin.left() >= picture.left() && end.right() > picture.right(),
            "{language}: {end} in {picture}"
        );
        window.get_all_by_role_and_label(Role::Button, &last).next().unwrap().focus();
        window.run_steps(8);
        let end = button(&window, &last);
        assert!(picture.contains_rect(end), "{language}: {end} in {picture}");
    }
}
