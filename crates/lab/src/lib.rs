//! Experiments on a scene. No window: the program and the studio show what is found here.

pub mod audit;
pub mod depth;
pub mod exact;
pub mod maps;
