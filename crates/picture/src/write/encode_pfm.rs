//! Portable float maps.

use catoptric_platform::files::Sink;

use super::EncodeError;
use crate::picture::Picture;

/// Writes the linear light bit by bit, with little-endian numbers: three to a pixel, the bottom row first (Debevec 2001).
pub(super) fn encode_pfm_to(sink: &mut dyn Sink, picture: &Picture) -> Result<(), EncodeError> {
    write!(sink, "PF\n{} {}\n-1.0\n", picture.width(), picture.height())?;
    let mut bytes = Vec::new();
    for row in picture.rows().rev() {
        bytes.clear();
        bytes.extend(row.iter().flatten().flat_map(|value| value.to_le_bytes()));
        sink.write_all(&bytes)?;
    }
    Ok(())
}
