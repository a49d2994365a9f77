//! The open document: a scene, what is selected in it, how it became what it is, and what can be done to it.
//!
//! An [`Editor`] is all that a user interface needs to change a scene: gestures that become one undo step when they
//! end ([`Editor::change`], [`Editor::settle`]), discrete acts for menus, shortcuts and a command palette
//! ([`Action`]), and saving that keeps a file's comments. There is no user interface here, and no thread.
//!
//! ```
//! use catoptric_editor::{Action, Editor, Item, NewBodyPlacement};
//! use catoptric_scene::{Scene, ShapeKind};
//! use glam::DVec3;
//!
//! let mut editor = Editor::new(Scene::default());
//! let placement = NewBodyPlacement::at(DVec3::X);
//! editor.apply(Action::AddBody { shape: ShapeKind::Sphere, placement, name: "Ball".to_owned() })?;
//! assert_eq!(editor.selection().primary(), Some(Item::Body(0)));
//! editor.apply(Action::Undo)?;
//! assert!(!editor.is_changed());
//! # Ok::<(), catoptric_editor::ActionError>(())
//! ```

mod action;
pub mod bounds;
mod document;
mod fragment;
mod history;
mod names;
pub mod navigate;
mod new_body;
pub mod recovery;
mod selection;

pub use action::{Action, ActionError};
pub use document::{Editor, Label, RefusedChange, SceneWriter};
pub use new_body::NewBodyPlacement;
pub use selection::{Item, Selection};
