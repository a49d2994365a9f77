//! The transfer functions of PNG: from codes to light.

use super::DecodeError;
use crate::srgb;

/// A transfer function: from display values 0…1 to light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Transfer {
    /// The transfer function of sRGB.
    Srgb,
    /// Light is the display value to this power; 1 is linear.
    Power(f64),
    /// The camera curve of Rec. 709, 601 and 2020.
    Rec709,
}

impl Transfer {
    /// From the chunks of the file, in the order of precedence of the PNG specification, third edition, section 4.3:
    /// `cICP`, then `iCCP` and `sRGB` (both taken as sRGB), then `gAMA`.
    ///
    /// # Errors
    /// Names the transfer function if it cannot be undone here.
    pub(super) fn of(info: &png::Info<'_>) -> Result<Self, DecodeError> {
        if let Some(points) = &info.coding_independent_code_points {
            if !points.is_video_full_range_image {
                return Err(unsupported("narrow-range codes (16 to 235)"));
            }
            if let Some(transfer) = Self::of_code_point(points.transfer_function)? {
                return Ok(transfer);
            }
        }
        // The value that PNG asks writers of sRGB to put beside the sRGB chunk; older writers put it alone.
        const SRGB_GAMMA: u32 = 45455;
        Ok(match info.gama_chunk.map(png::ScaledFloat::into_scaled) {
            Some(gamma)
                if info.srgb.is_none()
                    && info.icc_profile.is_none()
                    && gamma != 0
                    && gamma.abs_diff(SRGB_GAMMA) > 1 =>
            {
                Self::Power(100_000.0 / f64::from(gamma))
            }
            _ => Self::Srgb,
        })
    }

    /// The meaning of a number of ITU-T H.273, table 3; `None` for "unspecified".
    fn of_code_point(code: u8) -> Result<Option<Self>, DecodeError> {
        match code {
            1 | 6 | 14 | 15 => Ok(Some(Self::Rec709)),
            2 => Ok(None),
            4 => Ok(Some(Self::Power(2.2))),
            5 => Ok(Some(Self::Power(2.8))),
            8 => Ok(Some(Self::Power(1.0))),
            13 => Ok(Some(Self::Srgb)),
            16 => Err(unsupported("the transfer function PQ (SMPTE ST 2084)")),
            18 => Err(unsupported("the transfer function HLG (ARIB STD-B67)")),
            other => Err(unsupported(&format!("the transfer function number {other} of ITU-T H.273"))),
        }
    }

    /// The light of a display value of 0…1.
    fn light(self, display: f64) -> f64 {
        match self {
            Self::Srgb => srgb::decode(display),
            Self::Power(exponent) => display.powf(exponent),
            // ITU-R BT.709-6, item 1.2, solved for the light.
            Self::Rec709 if display < 0.081 => display / 4.5,
            Self::Rec709 => ((display + 0.099) / 1.099).powf(1.0 / 0.45),
        }
    }

    /// The light of every code from 0 to `maximum`.
    pub(super) fn table(self, maximum: u16) -> Vec<f32> {
        (0..=maximum).map(|code| self.light(f64::from(code) / f64::from(maximum)) as f32).collect()
    }
}

fn unsupported(what: &str) -> DecodeError {
    DecodeError::Unsupported {
        reason: format!(
            "the PNG picture has {what}, which is not read; write it with sRGB or linear codes, or as EXR"
        ),
    }
}
