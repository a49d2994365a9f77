//! How much light surfaces reflect, and in which color: the physics of smooth boundaries, without rays or scenes.
//!
//! - [`fresnel`]: exact reflectances of dielectrics and conductors, by angle and polarization.
//! - [`Dispersion`]: refractive index by wavelength; [`CLEAR`] substances with the sources of their coefficients.
//! - [`Metal`]: measured complex indices; [`METALS`].
//! - [`observer`]: from spectra to linear sRGB, as the CIE's observer of 1931 sees them by daylight.
//!
//! Everything is computed in double precision. Wavelengths are nanometers in vacuum, angles are given by their cosines
//! to the normal, reflectances are shares of power, 0 to 1.
//!
//! ```
//! use catoptric_optics::{fresnel, Metal};
//!
//! // A glass pane reflects 4 % of the light that falls on it straight.
//! assert!((fresnel::dielectric(1.0, 1.5).mean() - 0.04).abs() < 1e-12);
//! let [red, _, blue] = Metal::named("gold").ok_or("no gold")?.reflectance(1.0, 1.0);
//! assert!(red > 2.0 * blue);
//! # Ok::<(), &str>(())
//! ```

mod clear;
mod dispersion;
pub mod fresnel;
mod metal;
pub mod observer;

pub use clear::{CLEAR, ClearSubstance};
pub use dispersion::{Dispersion, FraunhoferLines};
pub use metal::{METALS, Metal};
