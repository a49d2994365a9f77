//! What the pointer does in the picture: choosing, carrying, pulling, turning the view.

use catoptric_editor::{Item, Selection};
use catoptric_scene::Camera;
use egui::{CursorIcon, Key, Modifiers, PointerButton, Pos2, Response, Ui, Vec2};
use glam::DVec2;

use super::camera_navigation::{self, CameraNavigation};
use super::drag_payload::{DragPayload, place_of};
use super::gizmo::change::GizmoChange;
use super::gizmo::handle_drag::{DragAmount, DragPrecision, HandleDrag};
use super::gizmo::{Gizmo, GizmoHandle};
use super::item_drag::ItemDrag;
use super::light_aim::LightAim;
use super::visible_picture::{PointerTarget, VisiblePicture};
use crate::command::Tool;
use crate::context::Cx;

/// How near to the last click another one asks for the body behind, points.
const SAME_PLACE: f32 = 4.0;

/// The action of the pointer in the picture.
#[derive(Debug, Default)]
pub(crate) enum PointerAction {
    /// Nothing.
    #[default]
    Open,
    /// Turns the view about its target.
    Orbit,
    /// Pans the view.
    Pan,
    /// Turns the camera in place, while keys move it.
    Look,
    /// Drags bodies, lights or the camera.
    Carry(Box<ActiveDrag<ItemDrag>>),
    /// Drags a handle of the gizmo.
    Pull(Box<ActiveDrag<HandleDrag>>),
    /// Drags a light by its highlight or its shadow.
    Aim(Box<ActiveDrag<LightAim>>),
    /// A cancelled drag whose button is still down.
    GivenUp,
}

/// A drag that is under way.
#[derive(Debug)]
pub(crate) struct ActiveDrag<T> {
    pub(crate) by: T,
    load: DragPayload,
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
    pub(crate) hand: PointerAction,
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
        (sight, response): (&VisiblePicture, &Response),
        gizmo: Option<&Gizmo>,
        travel: &mut CameraNavigation,
    ) {
        if response.drag_started() {
            self.take(ui, cx, sight, gizmo);
        }
        self.fly_beside(ui, cx, response, travel);
        if !matches!(self.hand, PointerAction::Open) {
            // In a slow frame the pointer has moved on before it was released.
            self.drag(ui, cx, sight);
            if !ui.input(|input| input.pointer.any_down()) {
                cx.view.is_moving = false;
                self.hand = PointerAction::Open;
                self.last = None;
                cx.editor.settle();
            }
        }
        let button = |button| response.clicked_by(button);
        if let Some(pos) = response.interact_pointer_pos() {
            if button(PointerButton::Primary) && cx.view.is_auditing {
                super::pixel_pick::click(ui, cx, sight, pos);
            } else if button(PointerButton::Primary) && cx.view.is_aiming {
                self.click_to_aim(ui, cx, sight, pos);
            } else if button(PointerButton::Primary) {
                self.click(ui, cx, sight, pos);
            } else if button(PointerButton::Secondary) {
                self.choose_for_menu(cx, sight, pos);
            }
        }
        self.hover(ui, cx, (sight, response), gizmo);
    }

    /// Whether the button that was released just now has only pointed, so that it opens the menu.
    pub(crate) fn opens_menu(&self) -> bool {
        !self.has_flown
    }

    /// Decides at the beginning of a drag what the hand does.
    fn take(&mut self, ui: &Ui, cx: &mut Cx<'_>, sight: &VisiblePicture, gizmo: Option<&Gizmo>) {
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
        let at = sight.at(origin);
        if is_primary && cx.view.is_aiming {
            self.hand = aim(cx, sight, at, true).unwrap_or(turns);
            return;
        }
        // While pixels are pinned, drags look at their rays from all sides.
        let holds = is_primary && !cx.view.is_auditing;
        self.hand = match holds.then(|| sight.target(cx, gizmo, at)) {
            Some(PointerTarget::Handle(handle)) => pull(cx, sight, gizmo, handle, at),
            Some(PointerTarget::Mark(item)) => carry(cx, sight, (item, None), at, modifiers.alt),
            Some(PointerTarget::Body { index, point }) => {
                carry(cx, sight, (Item::Body(index), Some(point)), at, modifiers.alt)
            }
            _ => None,
        }
        .unwrap_or(turns);
    }

    /// Whether the right button is down in the picture, so that the keys of flight count.
    pub(crate) fn flies_beside(&self, ui: &Ui, response: &Response) -> bool {
        let is_down = ui.input(|input| input.pointer.secondary_down());
        let is_here = response.is_pointer_button_down_on() || response.dragged();
        is_down && is_here && !matches!(self.hand, PointerAction::GivenUp)
    }

    /// The keys of flight count while the right button is down.
    fn fly_beside(&mut self, ui: &Ui, cx: &mut Cx<'_>, response: &Response, travel: &mut CameraNavigation) {
        if ui.input(|input| input.pointer.button_pressed(PointerButton::Secondary)) {
            self.has_flown = false;
        }
        if self.flies_beside(ui, response) && travel.fly_keys(ui, cx) {
            self.has_flown = true;
            if matches!(self.hand, PointerAction::Orbit) {
                self.hand = PointerAction::Look;
            }
        }
    }

    /// A frame of a drag.
    fn drag(&mut self, ui: &Ui, cx: &mut Cx<'_>, sight: &VisiblePicture) {
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            cx.editor.abandon();
            if let (Some(before), Some(free)) = (self.free_before, &mut cx.view.free_camera) {
                *free = before;
            }
            self.hand = PointerAction::GivenUp;
        }
        let (pos, modifiers) = ui.input(|input| (input.pointer.latest_pos(), input.modifiers));
        let Some(pos) = pos else { return };
        let way = self.last.map_or(Vec2::ZERO, |last| pos - last);
        self.last = Some(pos);
        let care = DragPrecision { snaps: modifiers.command || modifiers.ctrl, is_fine: modifiers.shift };
        let slow = if care.is_fine { 0.1 } else { 1.0 };
        let step = slow * DVec2::new(f64::from(way.x), f64::from(way.y));
        cx.view.is_moving = true;
        match &mut self.hand {
            PointerAction::Open => {}
            PointerAction::GivenUp => cx.view.is_moving = false,
            PointerAction::Orbit if way != Vec2::ZERO => camera_navigation::orbit(cx, way),
            PointerAction::Pan if way != Vec2::ZERO => camera_navigation::pan(cx, sight, way),
            PointerAction::Look if way != Vec2::ZERO => camera_navigation::look(cx, way),
            PointerAction::Orbit | PointerAction::Pan | PointerAction::Look => {}
            PointerAction::Carry(held) => {
                held.at += step;
                if let Some(way) = held.by.to(&sight.lens, held.at, modifiers.alt, care) {
                    held.load.apply(cx.editor, &GizmoChange::Move(way));
                    held.amount = Some(carried(way));
                }
            }
            PointerAction::Aim(held) => {
                if let Some(place) = held.by.to(sight, sight.at(pos)) {
                    held.amount = held.load.bring_to(cx.editor, place).map(carried);
                }
            }
            PointerAction::Pull(held) => {
                held.at += step;
                if let Some((change, amount)) = held.by.to(&sight.lens, held.at, care) {
                    held.load.apply(cx.editor, &change);
                    held.amount = Some(amount);
                }
            }
        }
    }

    /// Chooses what is under the pointer: at the same place as before, what is behind.
    fn click(&mut self, ui: &Ui, cx: &mut Cx<'_>, sight: &VisiblePicture, pos: Pos2) {
        let modifiers = ui.input(|input| input.modifiers);
        let things = sight.things_at(cx, sight.at(pos));
        let is_again = self
            .click
            .is_some_and(|click| click.pos.distance(pos) <= SAME_PLACE && click.camera == sight.camera);
        self.click = Some(LastClick { pos, camera: sight.camera });
        cx.editor.settle();
        let mut selection = cx.editor.selection().clone();
        let toggles = modifiers.shift || modifiers.command || modifiers.ctrl;
        match things.first() {
            Some(first) if toggles => selection.toggle(*first),
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
    fn click_to_aim(&mut self, ui: &Ui, cx: &mut Cx<'_>, sight: &VisiblePicture, pos: Pos2) {
        let at = sight.at(pos);
        if matches!(sight.target(cx, None, at), PointerTarget::Mark(_) | PointerTarget::Arrow(_)) {
            return self.click(ui, cx, sight, pos);
        }
        if let Some(PointerAction::Aim(held)) = aim(cx, sight, at, false)
            && let Some(place) = held.by.to(sight, at)
        {
            held.load.bring_to(cx.editor, place);
            cx.editor.settle();
        }
    }

    /// The menu is about what is under the pointer.
    fn choose_for_menu(&self, cx: &mut Cx<'_>, sight: &VisiblePicture, pos: Pos2) {
        let things = sight.things_at(cx, sight.at(pos));
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
        (sight, response): (&VisiblePicture, &Response),
        gizmo: Option<&Gizmo>,
    ) {
        let before = self.over;
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let is_open = matches!(self.hand, PointerAction::Open);
        let at = pointer.filter(|_| is_open && response.hovered()).map(|pos| sight.at(pos));
        self.over = at.map(|at| sight.target(cx, gizmo, at));
        // Also behind handles: those of a selected body stand in its middle.
        cx.view.seen = at.and_then(|at| sight.seen_at(at));
        let body = |over| if let Some(PointerTarget::Body { index, .. }) = over { Some(index) } else { None };
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
        let scene = cx.editor.scene();
        match (&self.hand, self.over) {
            (PointerAction::Orbit | PointerAction::Look, _) => Some(CursorIcon::AllScroll),
            (PointerAction::Pan, _) => Some(CursorIcon::Move),
            (PointerAction::Carry(_) | PointerAction::Pull(_) | PointerAction::Aim(_), _) => {
                Some(CursorIcon::Grabbing)
            }
            (PointerAction::GivenUp, _) => None,
            (PointerAction::Open, Some(PointerTarget::Arrow(_))) => Some(CursorIcon::PointingHand),
            (PointerAction::Open, Some(_)) if cx.view.is_auditing || cx.view.is_aiming => {
                Some(CursorIcon::Crosshair)
            }
            (PointerAction::Open, Some(PointerTarget::Handle(_))) => Some(CursorIcon::Grab),
            (PointerAction::Open, Some(PointerTarget::Mark(item))) => {
                Some(grab_or_point(item.is_locked(scene)))
            }
            (PointerAction::Open, Some(PointerTarget::Body { index, .. })) => {
                Some(grab_or_point(Item::Body(index).is_locked(scene)))
            }
            (PointerAction::Open, _) => None,
        }
    }
}

fn grab_or_point(is_locked: bool) -> CursorIcon {
    if is_locked { CursorIcon::PointingHand } else { CursorIcon::Grab }
}

/// The parts of a move that are worth telling.
fn carried(way: glam::DVec3) -> DragAmount {
    let is_upright = way.y != 0.0;
    let is_level = way.x != 0.0 || way.z != 0.0 || !is_upright;
    DragAmount::Meters([
        Some(way.x).filter(|_| is_level),
        Some(way.y).filter(|_| is_upright),
        Some(way.z).filter(|_| is_level),
    ])
}

/// Takes hold of a thing: it is selected, and all that is selected goes with it. Locked things stay.
fn carry(
    cx: &mut Cx<'_>,
    sight: &VisiblePicture,
    (item, grabbed): (Item, Option<glam::DVec3>),
    at: DVec2,
    is_upright: bool,
) -> Option<PointerAction> {
    if item.is_locked(cx.editor.scene()) {
        return None;
    }
    if cx.editor.selection().contains(item) {
        // It becomes the primary one, as it leads the others.
        let mut selection = cx.editor.selection().clone();
        selection.add(item);
        cx.editor.select(selection);
    } else {
        cx.editor.select(item);
    }
    let scene = cx.editor.scene();
    let lead = place_of(scene, item)?;
    let is_free = cx.view.free_camera.is_some();
    let load = DragPayload::take(scene, cx.editor.selection(), is_free, "edit-move")?;
    let by = ItemDrag::begin(grabbed.unwrap_or(lead), lead, &sight.lens, at, is_upright);
    Some(PointerAction::Carry(Box::new(ActiveDrag { by, load, at, amount: None })))
}

/// Takes hold of a light by what it does at a place: the selected one, or else the first that is shown and not locked.
fn aim(cx: &mut Cx<'_>, sight: &VisiblePicture, at: DVec2, by_shadow: bool) -> Option<PointerAction> {
    let scene = cx.editor.scene();
    let is_free = |item: &Item| !item.is_locked(scene) && !item.is_hidden(scene);
    let all = (0..scene.lights.len()).map(Item::Light);
    let selected = cx.editor.selection().lights().map(Item::Light).find(is_free);
    let item = selected.or_else(|| all.into_iter().find(is_free))?;
    let Item::Light(light) = item else { return None };
    let by = LightAim::begin(sight, scene, light, at, by_shadow)?;
    if cx.editor.selection().primary() != Some(item) {
        cx.editor.select(item);
    }
    let load = DragPayload::take(cx.editor.scene(), &item.into(), false, "edit-aim-light")?;
    Some(PointerAction::Aim(Box::new(ActiveDrag { by, load, at, amount: None })))
}

/// Takes hold of a handle.
fn pull(
    cx: &Cx<'_>,
    sight: &VisiblePicture,
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
    let load = DragPayload::take(cx.editor.scene(), cx.editor.selection(), is_free, key)?;
    let by = HandleDrag::begin(gizmo, handle, &sight.lens, at)?;
    Some(PointerAction::Pull(Box::new(ActiveDrag { by, load, at, amount: None })))
}

/// The gizmo at what is selected and can be moved; its center is in the middle of the things' places.
pub(crate) fn gizmo(cx: &Cx<'_>) -> Option<Gizmo> {
    if !cx.settings.shows_handles || cx.view.is_auditing || cx.view.is_aiming {
        return None;
    }
    let scene = cx.editor.scene();
    let selection: &Selection = cx.editor.selection();
    let has_place = |item: &Item| match item {
        Item::Camera => cx.view.free_camera.is_some(),
        other => !other.is_locked(scene) && !other.is_hidden(scene),
    };
    let placed: Vec<(Item, glam::DVec3)> =
        selection.iter().filter(has_place).filter_map(|item| Some((item, place_of(scene, item)?))).collect();
    let (primary, lead) = *placed.last()?;
    let pivot = placed.iter().map(|(_, place)| place).sum::<glam::DVec3>() / placed.len() as f64;
    let own = match primary {
        Item::Body(index) => scene.bodies.get(index).map(|body| {
            let turn = body.placement.rotation();
            [turn.x_axis, turn.y_axis, turn.z_axis]
        }),
        _ => None,
    };
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
