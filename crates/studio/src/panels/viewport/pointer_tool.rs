//! The pointer in the picture: selecting, dragging things and handles, turning the view.

use catoptric_editor::{Item, PartPath, Selection};
use catoptric_scene::Camera;
use egui::{CursorIcon, Key, Modifiers, PointerButton, Pos2, Response, Ui, Vec2};
use glam::DVec2;

use super::camera_navigation::{self, CameraNavigation};
use super::drag_payload::{DragPayload, place_of, place_of_part};
use super::gizmo::change::GizmoChange;
use super::gizmo::handle_drag::{DragAmount, DragPrecision, HandleDrag};
use super::gizmo::{Gizmo, GizmoHandle};
use super::item_drag::ItemDrag;
use super::light_aim::LightAim;
use super::part_pick::{next_part, part_at};
use super::scene_view::{PointerTarget, SceneView};
use crate::panels::outliner::body_of;
use crate::state::command::Tool;
use crate::state::context::Cx;

/// How near to the last click another one asks for the body behind, points.
const SAME_PLACE: f32 = 4.0;

/// The action of the pointer in the picture.
#[derive(Debug, Default)]
pub(crate) enum PointerAction {
    /// Nothing.
    #[default]
    Idle,
    /// Turns the view about its target.
    Orbit,
    /// Pans the view.
    Pan,
    /// Turns the camera in place, while keys move it.
    Look,
    /// Drags bodies, lights or the camera.
    DragItem(Box<ActiveDrag<ItemDrag>>),
    /// Drags a handle of the gizmo.
    DragHandle(Box<ActiveDrag<HandleDrag>>),
    /// Drags a light by its highlight or its shadow.
    AimLight(Box<ActiveDrag<LightAim>>),
    /// A cancelled drag whose button is still down.
    Cancelled,
}

/// A drag that is under way.
#[derive(Debug)]
pub(crate) struct ActiveDrag<T> {
    pub(crate) drag: T,
    payload: DragPayload,
    /// Where the pointer would be if it always went at full speed.
    at: DVec2,
    /// How much was changed.
    pub(crate) amount: Option<DragAmount>,
}

/// The last click, to recognize another one at the same place.
#[derive(Clone, Copy, Debug)]
struct LastClick {
    pos: Pos2,
    camera: Camera,
}

/// The state of the pointer in the picture.
#[derive(Debug, Default)]
pub(crate) struct PointerTool {
    pub(crate) action: PointerAction,
    /// Where the pointer was in the last frame of a drag.
    last: Option<Pos2>,
    /// The free view's camera at the beginning of the drag.
    free_before: Option<Camera>,
    click: Option<LastClick>,
    /// Whether the right button has been used to fly.
    has_flown: bool,
    /// What the pointer is over.
    pub(crate) over: Option<PointerTarget>,
}

impl PointerTool {
    /// A frame of the pointer.
    pub(crate) fn act(
        &mut self,
        ui: &Ui,
        cx: &mut Cx<'_>,
        (scene_view, response): (&SceneView, &Response),
        gizmo: Option<&Gizmo>,
        navigation: &mut CameraNavigation,
    ) {
        if response.drag_started() {
            self.take(ui, cx, scene_view, gizmo);
        }
        self.fly_beside(ui, cx, response, navigation);
        if !matches!(self.action, PointerAction::Idle) {
            // In a slow frame the pointer has moved on before it was released.
            self.drag(ui, cx, scene_view);
            if !ui.input(|input| input.pointer.any_down()) {
                cx.view.is_moving = false;
                self.action = PointerAction::Idle;
                self.last = None;
                cx.editor.settle();
            }
        }
        let button = |button| response.clicked_by(button);
        if let Some(pos) = response.interact_pointer_pos() {
            if button(PointerButton::Primary) && cx.view.is_auditing {
                super::pixel_pick::click(ui, cx, scene_view, pos);
            } else if button(PointerButton::Primary) && cx.view.is_aiming {
                self.click_to_aim(ui, cx, scene_view, pos);
            } else if button(PointerButton::Primary) {
                self.click(ui, cx, scene_view, pos);
            } else if button(PointerButton::Secondary) {
                self.choose_for_menu(cx, scene_view, pos);
            }
        }
        self.hover(ui, cx, (scene_view, response), gizmo);
    }

    /// Whether the button that was released just now has only pointed, so that it opens the menu.
    pub(crate) fn opens_menu(&self) -> bool {
        !self.has_flown
    }

    /// Chooses the action at the beginning of a drag.
    fn take(&mut self, ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView, gizmo: Option<&Gizmo>) {
        let (origin, is_primary, is_middle, modifiers) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.press_origin(), pointer.primary_down(), pointer.middle_down(), input.modifiers)
        });
        let Some(origin) = origin else { return };
        cx.editor.settle();
        self.last = Some(origin);
        self.free_before = cx.view.free_camera;
        self.click = None;
        let turns = if modifiers.shift || is_middle { PointerAction::Pan } else { PointerAction::Orbit };
        let at = scene_view.at(origin);
        if is_primary && cx.view.is_aiming {
            self.action = aim_light(cx, scene_view, at, true).unwrap_or(turns);
            return;
        }
        // While pixels are pinned, drags look at their rays from all sides.
        let holds = is_primary && !cx.view.is_auditing;
        self.action = match holds.then(|| scene_view.target(cx, gizmo, at)) {
            Some(PointerTarget::Handle(handle)) => drag_handle(cx, scene_view, gizmo, handle, at),
            Some(PointerTarget::Mark(item)) => drag_item(cx, scene_view, (item, None), at, modifiers.alt),
            Some(PointerTarget::Body { item, point }) => {
                drag_item(cx, scene_view, (item, Some(point)), at, modifiers.alt)
            }
            _ => None,
        }
        .unwrap_or(turns);
    }

    /// Whether the right button is down in the picture, so that the keys of flight count.
    pub(crate) fn flies_beside(&self, ui: &Ui, response: &Response) -> bool {
        let is_down = ui.input(|input| input.pointer.secondary_down());
        let is_here = response.is_pointer_button_down_on() || response.dragged();
        is_down && is_here && !matches!(self.action, PointerAction::Cancelled)
    }

    /// The keys of flight count while the right button is down.
    fn fly_beside(
        &mut self,
        ui: &Ui,
        cx: &mut Cx<'_>,
        response: &Response,
        navigation: &mut CameraNavigation,
    ) {
        if ui.input(|input| input.pointer.button_pressed(PointerButton::Secondary)) {
            self.has_flown = false;
        }
        if self.flies_beside(ui, response) && navigation.fly_keys(ui, cx) {
            self.has_flown = true;
            if matches!(self.action, PointerAction::Orbit) {
                self.action = PointerAction::Look;
            }
        }
    }

    /// A frame of a drag.
    fn drag(&mut self, ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView) {
        // Two fingers scale the view; what the first one has begun is not meant.
        let is_pinched = !matches!(self.action, PointerAction::Cancelled)
            && ui.input(|input| input.multi_touch().is_some());
        if is_pinched || ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            cx.editor.abandon();
            if let (Some(before), Some(free)) = (self.free_before, &mut cx.view.free_camera) {
                *free = before;
            }
            self.action = PointerAction::Cancelled;
        }
        let (pos, modifiers) = ui.input(|input| (input.pointer.latest_pos(), input.modifiers));
        let Some(pos) = pos else { return };
        let way = self.last.map_or(Vec2::ZERO, |last| pos - last);
        self.last = Some(pos);
        let precision =
            DragPrecision { snaps: modifiers.command || modifiers.ctrl, is_fine: modifiers.shift };
        let slow = if precision.is_fine { 0.1 } else { 1.0 };
        let step = slow * DVec2::new(f64::from(way.x), f64::from(way.y));
        cx.view.is_moving = true;
        match &mut self.action {
            PointerAction::Idle => {}
            PointerAction::Cancelled => cx.view.is_moving = false,
            PointerAction::Orbit if way != Vec2::ZERO => camera_navigation::orbit(cx, way),
            PointerAction::Pan if way != Vec2::ZERO => camera_navigation::pan(cx, scene_view, way),
            PointerAction::Look if way != Vec2::ZERO => camera_navigation::look(cx, way),
            PointerAction::Orbit | PointerAction::Pan | PointerAction::Look => {}
            PointerAction::DragItem(active) => {
                active.at += step;
                if let Some(way) = active.drag.to(&scene_view.projector, active.at, modifiers.alt, precision)
                {
                    active.payload.apply(cx.editor, &GizmoChange::Move(way));
                    active.amount = Some(moved_amount(way));
                }
            }
            PointerAction::AimLight(active) => {
                if let Some(place) = active.drag.to(scene_view, scene_view.at(pos)) {
                    active.amount = active.payload.bring_to(cx.editor, place).map(moved_amount);
                }
            }
            PointerAction::DragHandle(active) => {
                active.at += step;
                if let Some((change, amount)) = active.drag.to(&scene_view.projector, active.at, precision) {
                    active.payload.apply(cx.editor, &change);
                    active.amount = Some(amount);
                }
            }
        }
    }

    /// Chooses what is under the pointer: at the same place as before, what is behind.
    fn click(&mut self, ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView, pos: Pos2) {
        let modifiers = ui.input(|input| input.modifiers);
        let things = scene_view.things_at(cx, scene_view.at(pos));
        let is_again = self
            .click
            .is_some_and(|click| click.pos.distance(pos) <= SAME_PLACE && click.camera == scene_view.camera);
        self.click = Some(LastClick { pos, camera: scene_view.camera });
        cx.editor.settle();
        let mut selection = cx.editor.selection().clone();
        let toggles = modifiers.shift || modifiers.command || modifiers.ctrl;
        let part = things.first().filter(|_| !toggles).and_then(|first| {
            clicked_part(cx, scene_view, (*first, scene_view.at(pos)), (modifiers.alt, is_again))
        });
        match things.first() {
            Some(first) if toggles => selection.toggle(*first),
            Some(first) if part.is_some() => {
                selection = Selection::of_part(*first, part.unwrap_or(PartPath::WHOLE));
            }
            Some(first) => {
                let chosen = selection.primary().filter(|_| is_again);
                let place = things.iter().position(|thing| Some(*thing) == chosen);
                let behind = place.and_then(|place| things.get(place + 1));
                selection.set(*behind.unwrap_or(first));
            }
            None if toggles => {}
            None => selection.clear(),
        }
        cx.editor.select(selection);
    }

    /// Puts the highlight of the light that is aimed where a click is; clicks on lights choose them.
    fn click_to_aim(&mut self, ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView, pos: Pos2) {
        let at = scene_view.at(pos);
        if matches!(scene_view.target(cx, None, at), PointerTarget::Mark(_) | PointerTarget::Arrow(_)) {
            return self.click(ui, cx, scene_view, pos);
        }
        if let Some(PointerAction::AimLight(active)) = aim_light(cx, scene_view, at, false)
            && let Some(place) = active.drag.to(scene_view, at)
        {
            active.payload.bring_to(cx.editor, place);
            cx.editor.settle();
        }
    }

    /// The menu is about what is under the pointer.
    fn choose_for_menu(&self, cx: &mut Cx<'_>, scene_view: &SceneView, pos: Pos2) {
        let things = scene_view.things_at(cx, scene_view.at(pos));
        if let Some(first) = things.first().filter(|_| self.opens_menu())
            && !things.iter().any(|thing| cx.editor.selection().contains(*thing))
        {
            cx.editor.settle();
            cx.editor.select(*first);
        }
    }

    /// Finds out what is under the pointer, and shows with the cursor what a drag would do.
    fn hover(
        &mut self,
        ui: &Ui,
        cx: &mut Cx<'_>,
        (scene_view, response): (&SceneView, &Response),
        gizmo: Option<&Gizmo>,
    ) {
        let before = self.over;
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let is_open = matches!(self.action, PointerAction::Idle);
        let at = pointer.filter(|_| is_open && response.hovered()).map(|pos| scene_view.at(pos));
        self.over = at.map(|at| scene_view.target(cx, gizmo, at));
        // Also behind handles: those of a selected body stand in its middle.
        cx.view.seen = at.and_then(|at| scene_view.seen_at(at));
        let body = |over| if let Some(PointerTarget::Body { item, .. }) = over { Some(item) } else { None };
        if self.over.is_some() {
            cx.view.hovered_body = body(self.over);
        } else if before.is_some() {
            // Elsewhere, other panels tell what is under the pointer.
            cx.view.hovered_body = None;
        }
        if let Some(icon) = self.cursor(cx) {
            ui.ctx().set_cursor_icon(icon);
        }
    }

    fn cursor(&self, cx: &Cx<'_>) -> Option<CursorIcon> {
        let edited = cx.editor.edited();
        match (&self.action, self.over) {
            (PointerAction::Orbit | PointerAction::Look, _) => Some(CursorIcon::AllScroll),
            (PointerAction::Pan, _) => Some(CursorIcon::Move),
            (PointerAction::DragItem(_) | PointerAction::DragHandle(_) | PointerAction::AimLight(_), _) => {
                Some(CursorIcon::Grabbing)
            }
            (PointerAction::Cancelled, _) => None,
            (PointerAction::Idle, Some(PointerTarget::Arrow(_))) => Some(CursorIcon::PointingHand),
            (PointerAction::Idle, Some(_)) if cx.view.is_auditing || cx.view.is_aiming => {
                Some(CursorIcon::Crosshair)
            }
            (PointerAction::Idle, Some(PointerTarget::Handle(_))) => Some(CursorIcon::Grab),
            (PointerAction::Idle, Some(PointerTarget::Mark(item) | PointerTarget::Body { item, .. })) => {
                Some(grab_or_point(edited.is_locked(item)))
            }
            (PointerAction::Idle, _) => None,
        }
    }
}

/// The part that a click on a body selects; `None` for the whole. With Alt it is the innermost at once, else only a body
/// that is selected alone is looked into. At the same place again, what lies behind comes after the innermost.
fn clicked_part(
    cx: &Cx<'_>,
    scene_view: &SceneView,
    (item, at): (Item, DVec2),
    (is_deep, is_again): (bool, bool),
) -> Option<PartPath> {
    let body = body_of(cx.editor.edited(), item)?;
    let hit = scene_view.body_at(at)?;
    let met = part_at(body, hit.position)?;
    let selection = cx.editor.selection();
    let is_entered = selection.primary() == Some(item) && selection.len() == 1;
    let meant = selection.part().unwrap_or(PartPath::WHOLE);
    match (is_deep, is_entered) {
        (true, _) => Some(met),
        (false, true) => Some(next_part(meant, met)).filter(|next| *next != meant || !is_again),
        (false, false) => None,
    }
}

fn grab_or_point(is_locked: bool) -> CursorIcon {
    if is_locked { CursorIcon::PointingHand } else { CursorIcon::Grab }
}

/// The parts of a move that are worth telling.
fn moved_amount(way: glam::DVec3) -> DragAmount {
    let is_upright = way.y != 0.0;
    let is_level = way.x != 0.0 || way.z != 0.0 || !is_upright;
    DragAmount::Meters([
        Some(way.x).filter(|_| is_level),
        Some(way.y).filter(|_| is_upright),
        Some(way.z).filter(|_| is_level),
    ])
}

/// Begins the drag of a thing: it is selected, and the whole selection moves with it. Locked things stay.
fn drag_item(
    cx: &mut Cx<'_>,
    scene_view: &SceneView,
    (item, grabbed): (Item, Option<glam::DVec3>),
    at: DVec2,
    is_upright: bool,
) -> Option<PointerAction> {
    if cx.editor.edited().is_locked(item) {
        return None;
    }
    if let Some(grabbed) = grabbed.filter(|grabbed| is_meant(cx, item, *grabbed)) {
        let lead = place_of_part(cx.editor.edited(), cx.editor.selection())?;
        let payload = DragPayload::take(cx.editor.edited(), cx.editor.selection(), false, "edit-move")?;
        let drag = ItemDrag::begin(grabbed, lead, &scene_view.projector, at, is_upright);
        return Some(PointerAction::DragItem(Box::new(ActiveDrag { drag, payload, at, amount: None })));
    }
    if cx.editor.selection().contains(item) {
        // It becomes the primary one, as it leads the others.
        let mut selection = cx.editor.selection().clone();
        selection.add(item);
        cx.editor.select(selection);
    } else {
        cx.editor.select(item);
    }
    let edited = cx.editor.edited();
    let lead = place_of(edited, item)?;
    let is_free = cx.view.free_camera.is_some();
    let payload = DragPayload::take(edited, cx.editor.selection(), is_free, "edit-move")?;
    let drag = ItemDrag::begin(grabbed.unwrap_or(lead), lead, &scene_view.projector, at, is_upright);
    Some(PointerAction::DragItem(Box::new(ActiveDrag { drag, payload, at, amount: None })))
}

/// Whether a point of a body lies on the part that is meant.
fn is_meant(cx: &Cx<'_>, item: Item, point: glam::DVec3) -> bool {
    let meant = cx.editor.selection().part().filter(|_| cx.editor.selection().primary() == Some(item));
    let met = body_of(cx.editor.edited(), item).and_then(|body| part_at(body, point));
    met.zip(meant).is_some_and(|(met, meant)| met.is_within(meant))
}

/// Begins to aim a light by its highlight or shadow: the selected one, else the first that is visible and not locked.
fn aim_light(cx: &mut Cx<'_>, scene_view: &SceneView, at: DVec2, by_shadow: bool) -> Option<PointerAction> {
    let edited = cx.editor.edited();
    let is_free =
        |item: &Item| matches!(item, Item::Light(_)) && !edited.is_locked(*item) && !edited.is_hidden(*item);
    let selected = cx.editor.selection().iter().find(is_free);
    let item = selected.or_else(|| edited.lights().find(is_free))?;
    let drag = LightAim::begin(scene_view, place_of(edited, item)?, at, by_shadow)?;
    if cx.editor.selection().primary() != Some(item) {
        cx.editor.select(item);
    }
    let payload = DragPayload::take(cx.editor.edited(), &item.into(), false, "edit-aim-light")?;
    Some(PointerAction::AimLight(Box::new(ActiveDrag { drag, payload, at, amount: None })))
}

/// Begins the drag of a handle.
fn drag_handle(
    cx: &Cx<'_>,
    scene_view: &SceneView,
    gizmo: Option<&Gizmo>,
    handle: GizmoHandle,
    at: DVec2,
) -> Option<PointerAction> {
    let gizmo = *gizmo?;
    let key = match gizmo.tool {
        Tool::Move => "edit-move",
        Tool::Rotate => "edit-rotate",
        Tool::Scale => "edit-scale",
    };
    let is_free = cx.view.free_camera.is_some();
    let payload = DragPayload::take(cx.editor.edited(), cx.editor.selection(), is_free, key)?;
    let drag = HandleDrag::begin(gizmo, handle, &scene_view.projector, at)?;
    Some(PointerAction::DragHandle(Box::new(ActiveDrag { drag, payload, at, amount: None })))
}

/// The gizmo at what is selected and can be moved; its center is in the middle of the things' places.
pub(crate) fn gizmo(cx: &Cx<'_>) -> Option<Gizmo> {
    if !cx.settings.shows_handles || cx.view.is_auditing || cx.view.is_aiming {
        return None;
    }
    let edited = cx.editor.edited();
    let selection: &Selection = cx.editor.selection();
    let has_place = |item: &Item| match item {
        Item::Camera => cx.view.free_camera.is_some(),
        other => !edited.is_locked(*other) && !edited.is_hidden(*other),
    };
    let placed: Vec<(Item, glam::DVec3)> =
        selection.iter().filter(has_place).filter_map(|item| Some((item, place_of(edited, item)?))).collect();
    let (primary, mut lead) = *placed.last()?;
    let mut pivot = placed.iter().map(|(_, place)| place).sum::<glam::DVec3>() / placed.len() as f64;
    if let Some(place) = place_of_part(edited, selection) {
        (lead, pivot) = (place, place);
    }
    let own = body_of(edited, primary).map(|body| {
        let turn = selection.part().unwrap_or(PartPath::WHOLE).rotation(body);
        [turn.x_axis, turn.y_axis, turn.z_axis]
    });
    // A point has neither turns nor sizes.
    let is_point = matches!(placed.as_slice(), [(Item::Light(_), _)]);
    let tool = match (cx.view.tool, primary) {
        _ if is_point => Tool::Move,
        (Tool::Scale, Item::Camera) => Tool::Move,
        (tool, _) => tool,
    };
    let local = own.filter(|_| cx.view.is_gizmo_local);
    Some(Gizmo { tool, pivot, axes: local.unwrap_or(glam::DVec3::AXES), is_local: local.is_some(), lead })
}
