//! The errors of a graphics card.

use catoptric_picture::SizeError;
use catoptric_tracer::shaders::UnsupportedOnGpu;

/// The reason why a graphics card does not draw. The CPU can draw in its place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GpuError {
    /// No graphics card was found, and no driver that does its work.
    #[error("no graphics card with Vulkan, Metal, DirectX 12 or OpenGL ES 3.1 was found")]
    NoAdapter,
    /// There is only a driver that computes on the CPU.
    #[error(
        "no graphics card was found, only the software driver \"{0}\", which is used when it is asked for"
    )]
    OnlySoftware(String),
    /// No card has the name that was asked for.
    #[error("no graphics card is called \"{wanted}\"; there is: {present}")]
    NoSuchAdapter {
        /// The part of a name that was asked for.
        wanted: String,
        /// The names that there are.
        present: String,
    },
    /// The card or its driver lacks something.
    #[error("\"{card}\" lacks {what}")]
    Missing {
        /// The card's name.
        card: String,
        /// What it lacks.
        what: &'static str,
    },
    /// The driver does not open the card.
    #[error("the graphics card cannot be opened: {0}")]
    NotOpened(String),
    /// More than the card allows in one piece.
    #[error("{what} of {bytes} bytes {verb} too large for \"{card}\", which allows {limit}", verb = verb(what))]
    TooLarge {
        /// The card's name.
        card: String,
        /// What is too large.
        what: &'static str,
        /// The size of the buffer.
        bytes: u64,
        /// The largest size.
        limit: u64,
    },
    /// The card has too little memory left.
    #[error("the graphics card has too little memory left for {0} bytes")]
    OutOfMemory(u64),
    /// The card was taken away, or its driver gave up.
    #[error("the graphics card was lost: {0}")]
    Lost(String),
    /// A piece of work took so long that the card must be taken for hung.
    #[error("the graphics card has not answered for {0} seconds")]
    NoAnswer(u64),
    /// What the card cannot draw.
    #[error(transparent)]
    Unsupported(#[from] UnsupportedOnGpu),
    /// The picture cannot have this size, or the computer has too little memory for it.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The work was cancelled.
    #[error("the render was cancelled")]
    Cancelled,
    /// Here no thread can wait for the card.
    #[error("a page cannot wait for a graphics card")]
    CannotWait,
    /// The driver refuses what should be right.
    #[error("the graphics driver refuses the work: {0}")]
    Refused(String),
}

/// Whether this much of something is, or are.
fn verb(what: &str) -> &'static str {
    if what.ends_with('s') { "are" } else { "is" }
}
