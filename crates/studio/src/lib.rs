#![doc = include_str!("../README.md")]

mod app;
mod audit;
mod card;
mod command;
mod compare;
mod context;
mod dialogs;
mod documents;
mod exact;
mod example_note;
mod exports;
mod first_steps;
mod held_keys;
mod help;
mod history;
pub mod host;
mod images;
mod inspector;
mod latest;
mod layout;
mod manual;
mod maps;
mod materials;
mod measure;
mod menu;
mod methods;
mod notices;
mod outliner;
mod palette;
mod panes;
mod picture_frame;
mod pictures;
mod problems;
mod run;
mod scripts;
mod settings;
mod shapes;
mod shortcuts;
mod status_bar;
mod texts;
mod theme;
mod thumbnails;
mod typeset;
mod view;
mod viewport;
mod widgets;
mod window;

pub use app::{StartDocument, Studio};
pub use command::{
    AuditCommand, Command, CommandGroup, CommandStyle, CompareCommand, MeasureCommand, Tool, ZoomStep,
};
pub use images::ImageUse;
pub use layout::Pane;
pub use methods::MethodSettings;
pub use pictures::{PictureKind, RenderChoices};
pub use settings::{LastScene, Settings, Theme};
pub use texts::{Language, Texts};
#[doc(hidden)]
pub use window::{InjectedLoss, open_with_fault};
pub use window::{Interruption, StudioError, open, prepare as prepare_window};
