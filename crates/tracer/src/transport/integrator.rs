//! Integrators: each says what light reaches the eye along a ray.

pub(crate) mod whitted;
