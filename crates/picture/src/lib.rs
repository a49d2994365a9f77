//! Linear-light pictures.
