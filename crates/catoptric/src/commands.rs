//! One file a command.

pub mod check;
pub mod convert;
pub mod diff;
pub mod examples;
pub mod manual;
pub mod render;

/// How a command ended when nothing went wrong with the program itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Exit status 0.
    Done,
    /// A comparison failed: exit status 1.
    Failed,
    /// The input is wrong, and that has been said: exit status 2.
    WrongInput,
    /// Exit status 130.
    Interrupted,
}
