//! A graphics card that draws in place of the processor. A task of its own drives it, since on a page neither the card nor
//! what lies on it can leave the worker where the card was opened.

mod picture;
mod port;
mod renderer;
mod source;

pub use picture::CardPicture;
pub(crate) use port::{CardFilm, CardNews, CardPort, CardState, NoAnswer};
pub use source::CardSource;
