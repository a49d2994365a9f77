//! Marks for the pictures of a class: each is held against its scene, and its mistakes cost points.
//!
//! A [`ClassFolder`] or a [`ClassTable`] tells which picture is whose, a [`Rubric`] what mistakes cost. What the
//! [detective](crate::detective) finds becomes a [`SubmissionCheck`]; all of them become [`ClassMarks`], which are written as
//! a page, as tables, and as other programs read them.

mod evidence;
mod files;
mod marks;
mod page;
mod rubric;
mod submissions;

pub use evidence::{Evidence, ExactPicture, ShownPicture, WorstPlace};
pub use files::file_names;
pub use marks::{
    ClassMarks, Deduction, FoundMistake, MistakeFrequency, PictureMark, StudentMarks, SubmissionCheck,
    SubmissionOutcome, UNEXPLAINED,
};
pub use page::class_page;
pub use rubric::Rubric;
pub use submissions::{ClassFolder, ClassTable, Submission};
