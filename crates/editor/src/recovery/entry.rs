//! The file of one document: a scene file whose first lines are comments that tell where it came from.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use catoptric_platform::files::read_start;

use super::Snapshot;

const FIRST_LINE: &str = "# catoptric recovery 1\n";
const PATH: &str = "# path ";
const TITLE: &str = "# title ";

/// The text of the file. Its lines are `# path` (left out when there is none) and `# title`, percent-encoded.
pub(super) fn to_text(snapshot: &Snapshot) -> String {
    let mut out = String::from(FIRST_LINE);
    if let Some(path) = &snapshot.original_path {
        push_line(&mut out, PATH, path.as_os_str().as_encoded_bytes());
    }
    push_line(&mut out, TITLE, snapshot.title.as_bytes());
    out.push_str(&snapshot.text);
    out
}

/// What such a text says. Lines that are missing say nothing.
pub(super) fn from_text(text: &str) -> Snapshot {
    let mut snapshot = Snapshot::default();
    let mut rest = text.strip_prefix(FIRST_LINE).unwrap_or(text);
    if let Some((path, after)) = line(rest, PATH) {
        snapshot.original_path = path_from_bytes(path);
        rest = after;
    }
    if let Some((title, after)) = line(rest, TITLE) {
        snapshot.title = String::from_utf8_lossy(&title).into_owned();
        rest = after;
    }
    rest.clone_into(&mut snapshot.text);
    snapshot
}

/// Whether the file at this path is one of these, by its first line.
pub(super) fn is_one(path: &Path) -> bool {
    read_start(path, FIRST_LINE.len() as u64).is_ok_and(|first| first == FIRST_LINE.as_bytes())
}

fn push_line(out: &mut String, key: &str, bytes: &[u8]) {
    out.push_str(key);
    for byte in bytes {
        if byte.is_ascii_graphic() && *byte != b'%' {
            out.push(char::from(*byte));
        } else {
            let _ = write!(out, "%{byte:02x}");
        }
    }
    out.push('\n');
}

/// The decoded value of the first line, if it has this key, and the text after it.
fn line<'t>(text: &'t str, key: &str) -> Option<(Vec<u8>, &'t str)> {
    let (value, rest) = text.strip_prefix(key)?.split_once('\n')?;
    let mut bytes = Vec::with_capacity(value.len());
    let mut left = value.bytes();
    while let Some(byte) = left.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let mut digit = || left.next().and_then(|digit| char::from(digit).to_digit(16));
        let (high, low) = (digit()?, digit()?);
        bytes.push(u8::try_from(16 * high + low).ok()?);
    }
    Some((bytes, rest))
}

#[cfg(unix)]
fn path_from_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt;
    Some(std::ffi::OsString::from_vec(bytes).into())
}

/// Elsewhere a path is Unicode but in rare cases, whose document has no path then.
#[cfg(not(unix))]
fn path_from_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    String::from_utf8(bytes).ok().map(PathBuf::from)
}
