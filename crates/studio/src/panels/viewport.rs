//! The viewport: the traced scene, with handles, outlines and rays drawn over it.

mod answers;
mod camera_navigation;
mod camera_transition;
mod compass;
mod covered;
mod dashes;
mod drag_payload;
mod gizmo;
mod handles;
mod item_drag;
mod labels;
mod light_aim;
mod menu;
mod offscreen;
mod overlay_lines;
mod part_lines;
mod part_pick;
mod picture;
mod pixel_pick;
mod placing;
mod pointer_tool;
mod rays;
mod scene_view;
mod steering;
mod toolbar;

use std::sync::Arc;

use catoptric_editor::Action;
use catoptric_live::Live;
use catoptric_scene::Camera;
use catoptric_tracer::RenderScene;
use egui::accesskit::Role;
use egui::emath::GuiRounding as _;
use egui::{
    Align2, EventFilter, Key, Modifiers, Popup, Rect, Response, Sense, Stroke, StrokeKind, Ui, Visuals,
    WidgetInfo, vec2,
};

use crate::base::{picture_frame, plates, theme};
use crate::panels::maps;
use crate::panels::outliner::{item_name, part_name, path_title};
use crate::state::command::Command;
use crate::state::context::Cx;
use camera_navigation::CameraNavigation;
use covered::CoveredPicture;
pub(crate) use covered::ROOM as ROOM_BELOW_PIXEL;
use gizmo::{Gizmo, GizmoHandle};
use picture::ViewportPicture;
pub(crate) use picture::why;
pub(crate) use placing::{place_for_light, placement_for_body};
use pointer_tool::{PointerAction, PointerTool};
use scene_view::{PointerTarget, SceneView};
use steering::KeyListener;

/// The state of the viewport.
#[derive(Default)]
pub(crate) struct Viewport {
    picture: ViewportPicture,
    size_in_pixels: Option<[u32; 2]>,
    rect: Option<Rect>,
    /// The part of it that no panel covers.
    visible: Option<Rect>,
    covered: Option<CoveredPicture>,
    /// How far the bar over the picture reached down in the last frame, points.
    bar: f32,
    pointer_tool: PointerTool,
    navigation: CameraNavigation,
    transition: Option<camera_transition::CameraTransition>,
    /// The first revision of the document. Pictures and prepared scenes of earlier ones are of another document.
    first_revision: u64,
}

impl Viewport {
    /// The size for which a picture is wanted, once the panel has been drawn.
    pub(crate) fn size_in_pixels(&self) -> Option<[u32; 2]> {
        self.size_in_pixels
    }

    /// Where the whole picture is in the window; a panel may cover a part of it.
    pub(crate) fn rect(&self) -> Option<Rect> {
        self.rect
    }

    /// Where the picture is seen in the window.
    pub(crate) fn visible_rect(&self) -> Option<Rect> {
        self.visible
    }

    /// Keeps the picture at its size and place while a panel opens over a part of it, with `shown` in view.
    pub(crate) fn keep_in_place(&mut self, context: &egui::Context, shown: egui::Pos2) {
        let window = context.content_rect().size();
        self.covered = self.rect.map(|whole| CoveredPicture::new(whole, shown, window));
    }

    /// Fits the picture into what no panel covers.
    pub(crate) fn fit(&mut self) {
        self.covered = None;
    }

    /// Ends all drags and key presses, since another document has come, which begins with this revision.
    pub(crate) fn begin_document(&mut self, revision: u64) {
        self.first_revision = revision;
        self.pointer_tool = PointerTool::default();
        self.navigation.stop();
        self.transition = None;
        self.covered = None;
    }

    /// Whether something of this revision is of the open document. For a moment the picture is still that of the one before.
    fn is_of_document(&self, revision: u64) -> bool {
        revision >= self.first_revision
    }

    /// The scene of the document as it is prepared for rays, once it is.
    pub(crate) fn render_scene(&self, live: &Live) -> Option<Arc<RenderScene>> {
        let (revision, render_scene) = live.render_scene()?;
        self.is_of_document(revision).then_some(render_scene)
    }

    /// Lets the eye follow a jump of the camera; returns whether there is a way to go.
    pub(crate) fn glide(&mut self, before: Camera, now: Camera) -> bool {
        self.transition = camera_transition::CameraTransition::new(before, now);
        self.transition.is_some()
    }

    /// Width over height.
    pub(crate) fn aspect(&self) -> f64 {
        self.size_in_pixels.map_or(1.0, |[width, height]| f64::from(width.max(1)) / f64::from(height.max(1)))
    }

    /// The device of the window is another.
    pub(crate) fn forget_textures(&mut self) {
        self.picture = ViewportPicture::default();
    }

    /// Finds out where the picture is in its tile of the layout.
    fn measure(&mut self, ui: &Ui, cx: &Cx<'_>, tile: Rect) -> Rect {
        // Without a pixel to keep in view, and through the scene's camera, all of the picture counts.
        if cx.audit.pin().is_none() || cx.view.free_camera.is_none() {
            self.covered = None;
        }
        let window = ui.ctx().content_rect().size();
        let kept = self.covered.as_mut().and_then(|covered| covered.place(tile, window));
        if kept.is_none() {
            self.covered = None;
        }
        // A pixel of the picture is one of the screen.
        let rect = kept.unwrap_or(tile).round_to_pixels(ui.ctx().pixels_per_point());
        (self.rect, self.visible) = (Some(rect), Some(rect.intersect(tile)));
        let pixels = (rect.size() * ui.ctx().pixels_per_point()).round().max(egui::Vec2::ZERO);
        self.size_in_pixels = Some([pixels.x as u32, pixels.y as u32]);
        rect
    }

    /// Where the eye is on its way to where the camera has jumped.
    fn ease(&mut self, ui: &Ui, cx: &mut Cx<'_>) {
        let camera = cx.view.camera(cx.editor.scene());
        let time = ui.input(|input| input.time);
        cx.view.eased = self.transition.as_mut().and_then(|transition| transition.now(&camera, time));
        if cx.view.eased.is_none() {
            self.transition = None;
        } else {
            cx.view.is_moving = true;
            ui.ctx().request_repaint();
        }
    }
}

/// Draws the picture and handles the pointer and the keys in it.
pub(crate) fn viewport_ui(ui: &mut Ui, cx: &mut Cx<'_>, viewport: &mut Viewport) {
    let (tile, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    let tile = tile.round_to_pixels(ui.ctx().pixels_per_point());
    let rect = viewport.measure(ui, cx, tile);
    ui.shrink_clip_rect(tile);
    viewport.ease(ui, cx);
    let seen_before = cx.view.seen.take();
    let painter = ui.painter_at(rect);
    let frame = viewport.picture.show(&painter, rect, cx, theme::palette(ui.visuals()));
    // What is drawn over the picture has the same colors in every theme, as the picture has.
    let palette = theme::palette(&Visuals::dark());
    // All that is drawn over the picture sees it as the picture was seen, also while the camera is ahead of it.
    let own = frame.as_ref().filter(|frame| viewport.is_of_document(frame.revision));
    let camera = own.map_or_else(|| cx.view.camera(cx.editor.scene()), |frame| frame.camera);
    let scene_view = SceneView::new(viewport.render_scene(cx.live), rect, (tile, viewport.bar), camera);
    if frame.as_deref().is_some_and(picture::is_apart) {
        // Nothing can be picked in it, and nothing belongs over it.
        viewport.pointer_tool = PointerTool::default();
        viewport.navigation.settle(ui, cx);
        tell(ui, cx, &response);
        viewport.bar = toolbar::toolbar_ui(ui, cx, tile);
        return;
    }
    act(ui, cx, viewport, (&scene_view, &response));
    if cx.view.seen != seen_before {
        // A panel drawn before this one tells of it as well.
        ui.ctx().request_repaint();
    }
    if cx.view.free_camera.is_none() && !cx.view.is_alone {
        picture_frame::paint(&painter, rect, cx.settings.picture_aspect());
    }
    maps::draw(&painter, cx, rect, camera);
    if let Some(frame) = &frame {
        overlay_lines::grid(&painter, rect, frame, palette);
        if cx.settings.shows_handles {
            overlay_lines::outlines(&painter, rect, frame, palette);
        }
    }
    if cx.settings.shows_handles {
        part_lines::draw(&painter, &scene_view, cx, palette);
    }
    cx.audit.update_hidden_parts(ui.ctx(), cx.live, camera);
    rays::draw(&painter, &scene_view, cx);
    over_picture(&painter, cx, viewport, &scene_view, palette);
    answers::answers_ui(ui, cx, &scene_view);
    tell(ui, cx, &response);
    if !cx.view.is_alone {
        viewport.bar = toolbar::toolbar_ui(ui, cx, tile);
        compass::compass_ui(ui, cx, &scene_view);
    }
    maps::legend_ui(ui, cx, rect, scene_view.visible);
    notes(ui, cx, viewport, &scene_view);
}

/// Handles the pointer and the keys.
fn act(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    viewport: &mut Viewport,
    (scene_view, response): (&SceneView, &Response),
) {
    let Viewport { pointer_tool, navigation, .. } = viewport;
    let listener = if cx.view.is_flying || pointer_tool.flies_beside(ui, response) {
        KeyListener::Flight
    } else if listens(ui, response) {
        KeyListener::Picture
    } else {
        KeyListener::Nobody
    };
    navigation.listen(ui, cx, listener);
    if cx.view.is_flying {
        pointer_tool.action = PointerAction::Idle;
        pointer_tool.over = None;
        navigation.fly(ui, cx);
    } else {
        navigation.land(ui, cx);
        let gizmo = pointer_tool::gizmo(cx);
        pointer_tool.act(ui, cx, (scene_view, response), gizmo.as_ref(), navigation);
        if response.contains_pointer() {
            navigation.wheel(ui, cx, scene_view);
        }
        if listener == KeyListener::Picture {
            keys(ui, cx);
            navigation.keys(ui, cx, scene_view);
        }
        if pointer_tool.opens_menu() {
            response.context_menu(|ui| menu::menu_ui(ui, cx));
        }
    }
    navigation.settle(ui, cx);
    let is_busy = !matches!(viewport.pointer_tool.action, PointerAction::Idle);
    if response.has_focus() {
        // Arrows move the camera, and Esc cancels the drag.
        let filter =
            EventFilter { tab: false, horizontal_arrows: true, vertical_arrows: true, escape: is_busy };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        // While a panel has the keyboard, only the panel itself knows when its gesture is over.
        if !is_busy && !cx.view.is_moving && !ui.input(|input| input.pointer.any_down()) {
            cx.editor.settle();
        }
    }
}

/// Whether keys are for the picture: when it has the focus, or nothing has.
fn listens(ui: &Ui, response: &Response) -> bool {
    let focused = ui.memory(egui::Memory::focused);
    let is_free = ui.memory(|memory| memory.allows_interaction(ui.layer_id()));
    is_free && focused.is_none_or(|id| id == response.id) && !Popup::is_any_open(ui.ctx())
}

/// The keys that choose the next or the last thing.
fn keys(ui: &Ui, cx: &mut Cx<'_>) {
    let (next, previous) = ui.input_mut(|input| {
        let next = input.consume_key(Modifiers::CTRL, Key::Tab)
            || input.consume_key(Modifiers::NONE, Key::CloseBracket);
        let previous = input.consume_key(Modifiers::CTRL | Modifiers::SHIFT, Key::Tab)
            || input.consume_key(Modifiers::NONE, Key::OpenBracket);
        (next, previous)
    });
    if next {
        cx.run(Command::Edit(Action::SelectNext));
    }
    if previous {
        cx.run(Command::Edit(Action::SelectPrevious));
    }
}

/// Draws lights, camera and gizmo.
fn over_picture(
    painter: &egui::Painter,
    cx: &Cx<'_>,
    viewport: &Viewport,
    scene_view: &SceneView,
    palette: &theme::ThemeColors,
) {
    let over = viewport.pointer_tool.over;
    let hovered = if let Some(PointerTarget::Mark(item) | PointerTarget::Arrow(item)) = over {
        Some(item)
    } else {
        None
    };
    handles::draw(painter, scene_view, cx, hovered, palette);
    offscreen::draw(painter, scene_view, cx, hovered, palette);
    let pulled: Option<(Gizmo, GizmoHandle)> = match &viewport.pointer_tool.action {
        PointerAction::DragHandle(active) => {
            gizmo::draw::ghost(painter, scene_view, &active.drag, palette);
            // It goes with what it moves, and keeps its axes while it turns.
            let pivot = pointer_tool::gizmo(cx).map_or(active.drag.gizmo.pivot, |gizmo| gizmo.pivot);
            Some((Gizmo { pivot, ..active.drag.gizmo }, active.drag.handle))
        }
        _ => None,
    };
    let active = match (pulled, over) {
        (Some((_, handle)), _) | (None, Some(PointerTarget::Handle(handle))) => Some(handle),
        _ => None,
    };
    // A thing that is dragged by itself needs no handles meanwhile.
    let at_rest = || {
        pointer_tool::gizmo(cx)
            .filter(|_| !matches!(viewport.pointer_tool.action, PointerAction::DragItem(_)))
    };
    if let Some(gizmo) = pulled.map(|pulled| pulled.0).or_else(at_rest) {
        gizmo::draw::draw(painter, scene_view, &gizmo, active, palette);
    }
}

/// Tells what is seen to those who do not see it, and shows the focus.
fn tell(ui: &Ui, cx: &Cx<'_>, response: &Response) {
    response.widget_info(|| {
        let scene = cx.editor.scene();
        let names: Vec<String> =
            cx.editor.selected_parts().map(|part| part_name(cx.texts, scene, part).into_owned()).collect();
        let names = match (cx.editor.selection().primary(), cx.editor.selection().part()) {
            (Some(item), Some(path)) => {
                vec![path_title(cx.texts, cx.editor.edited(), (item, path)).into_owned()]
            }
            _ => names,
        };
        let label = if names.is_empty() {
            cx.t("viewport-picture").to_owned()
        } else {
            cx.texts.with("viewport-picture-selected", &[("names", names.join(", ").into())])
        };
        WidgetInfo::labeled(Role::Image, true, label)
    });
    if response.has_focus() {
        let stroke = Stroke::new(2.0, theme::palette(ui.visuals()).accent);
        ui.painter().rect_stroke(response.rect, 0.0, stroke, StrokeKind::Inside);
    }
}

/// Short texts: what is being changed, what is under the pointer, how to fly.
fn notes(ui: &Ui, cx: &mut Cx<'_>, viewport: &Viewport, scene_view: &SceneView) {
    /// How long the pointer rests before a label names the thing under it, seconds.
    const REST: f32 = 0.5;
    let palette = theme::palette(ui.visuals());
    let painter = ui.painter_at(scene_view.visible);
    let (pointer, rest) =
        ui.input(|input| (input.pointer.latest_pos(), input.pointer.time_since_last_movement()));
    let amount = match &viewport.pointer_tool.action {
        PointerAction::DragItem(active) => active.amount,
        PointerAction::DragHandle(active) => active.amount,
        PointerAction::AimLight(active) => active.amount,
        _ => None,
    };
    let over = match viewport.pointer_tool.over {
        Some(PointerTarget::Mark(item) | PointerTarget::Arrow(item) | PointerTarget::Body { item, .. }) => {
            Some(item)
        }
        _ => None,
    };
    if cx.view.is_auditing {
        pixel_pick::note(ui, cx, scene_view, palette);
    } else if let (Some(amount), Some(pointer)) = (amount, pointer) {
        let grain = scene_view.projector.meters_per_point(scene_view.camera.target);
        let text = labels::amount_text(cx.texts, amount, grain);
        plates::beside_pointer(&painter, scene_view.visible, pointer, &text, palette);
    } else if let (Some(item), Some(pointer), false) =
        (over.filter(|_| cx.maps.kind.is_none()), pointer, Popup::is_any_open(ui.ctx()))
    {
        if rest >= REST {
            let name = item_name(cx.texts, cx.editor.edited(), item);
            let text = match viewport.pointer_tool.over {
                Some(PointerTarget::Arrow(_)) => {
                    cx.texts.with("viewport-out-of-view", &[("name", name.into_owned().into())])
                }
                _ => name.into_owned(),
            };
            plates::beside_pointer(&painter, scene_view.visible, pointer, &text, palette);
        } else {
            let left = std::time::Duration::from_secs_f32(REST - rest);
            ui.ctx().request_repaint_after(left);
        }
    }
    if cx.view.is_measuring {
        let at = scene_view.visible.center_bottom() - vec2(0.0, 14.0);
        let text = cx.t("viewport-measuring");
        plates::plate(&painter, scene_view.visible, at, Align2::CENTER_BOTTOM, text, palette);
    }
    hint(&painter, cx, &viewport.pointer_tool.action, scene_view, palette);
}

/// Says what to do next in a mode of the picture.
fn hint(
    painter: &egui::Painter,
    cx: &Cx<'_>,
    action: &PointerAction,
    scene_view: &SceneView,
    palette: &theme::ThemeColors,
) {
    let text = if cx.view.is_flying {
        // Lines break between the keys, not within what is said of one.
        let parts = cx.t("viewport-fly-hint").split(" · ").map(|part| part.replace(' ', "\u{a0}"));
        parts.collect::<Vec<_>>().join("  ·  ")
    } else if cx.view.is_auditing && cx.audit.pin().is_none() {
        cx.t("viewport-audit-hint").to_owned()
    } else if cx.view.is_aiming {
        let key = match action {
            PointerAction::AimLight(active) if active.drag.is_by_shadow() => "viewport-aim-shadow",
            PointerAction::AimLight(_) => "viewport-aim-highlight",
            _ => "viewport-aim-hint",
        };
        cx.t(key).to_owned()
    } else {
        return;
    };
    // Below the bar, where no other panel floats, and beside the compass.
    let room = scene_view.clear.shrink2(vec2(compass::WIDTH, 0.0));
    let at = room.center_top() + vec2(0.0, 10.0);
    plates::plate(painter, room, at, Align2::CENTER_TOP, &text, palette);
}
