//! One file a command.

pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod diff;
pub(crate) mod examples;
pub(crate) mod manual;
pub(crate) mod render;

/// How a command ended when nothing went wrong with the program itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Exit status 0.
    Done,
    /// A comparison failed: exit status 1.
    Failed,
    /// The input is wrong, and that has been said: exit status 2.
    WrongInput,
    /// Exit status 130.
    Interrupted,
}
