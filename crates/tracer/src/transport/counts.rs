//! Rays counted by kind.

use std::ops::{Add, AddAssign};

/// How many rays of each kind were traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the eye.
    pub primary: u64,
    /// Towards a light, to see what lies between.
    pub shadow: u64,
    /// Mirrored, total internal reflection included.
    pub reflected: u64,
    /// Bent into or out of a transparent body.
    pub refracted: u64,
}

impl RayCounts {
    /// All kinds together.
    pub fn total(&self) -> u64 {
        self.primary + self.shadow + self.reflected + self.refracted
    }
}

impl Add for RayCounts {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.primary += other.primary;
        self.shadow += other.shadow;
        self.reflected += other.reflected;
        self.refracted += other.refracted;
    }
}

impl std::ops::Sub for RayCounts {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            primary: self.primary - other.primary,
            shadow: self.shadow - other.shadow,
            reflected: self.reflected - other.reflected,
            refracted: self.refracted - other.refracted,
        }
    }
}
