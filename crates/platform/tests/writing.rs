//! What can and cannot be written, on a real disk.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests may")]

use std::fs;
use std::path::Path;

use catoptric_platform::files::{WriteError, check_writable, write_bytes};

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn what_cannot_be_written_is_said_before_the_work_and_while_writing() {
    let directory = tempfile::tempdir().unwrap();
    let folder = directory.path();
    fs::write(folder.join("file"), "").unwrap();
    let check = |path: &Path| {
        let early = check_writable(path).unwrap_err();
        let late = write_bytes(path, b"x").unwrap_err();
        assert_eq!(early.to_string(), late.to_string());
        early
    };
    assert!(matches!(check(&folder.join("none/a.png")), WriteError::NoDirectory { .. }));
    assert!(matches!(check(&folder.join("file/a.png")), WriteError::NoDirectory { .. }));
    assert!(matches!(check(folder), WriteError::IsDirectory { .. }));
    assert!(matches!(check(Path::new("..")), WriteError::IsDirectory { .. }));
    assert!(matches!(check(Path::new("")), WriteError::NoName { .. }));
    assert!(matches!(check(&folder.join("new/")), WriteError::NoName { .. }));
    assert!(check_writable(&folder.join("new.png")).is_ok());
    assert!(check_writable(Path::new("name-alone.png")).is_ok());
    assert_eq!(names(folder), ["file"]);
}

#[test]
fn a_protected_file_is_respected() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("treasure.png");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    assert!(matches!(check_writable(&path), Err(WriteError::Protected { .. })));
    assert!(matches!(write_bytes(&path, b"new"), Err(WriteError::Protected { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"old");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn a_new_file_has_ordinary_permissions_and_a_replaced_one_keeps_its_own() {
        let directory = tempfile::tempdir().unwrap();
        let (ordinary, ours) = (directory.path().join("ordinary"), directory.path().join("ours"));
        fs::write(&ordinary, "").unwrap();
        write_bytes(&ours, b"").unwrap();
        assert_eq!(mode(&ours), mode(&ordinary));
        fs::set_permissions(&ours, fs::Permissions::from_mode(0o640)).unwrap();
        write_bytes(&ours, b"new").unwrap();
        assert_eq!(mode(&ours), 0o640);
    }

    #[test]
    fn symbolic_links_are_written_through() {
        let directory = tempfile::tempdir().unwrap();
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at("real")).unwrap();
        fs::write(at("real/picture"), "old").unwrap();
        symlink("real/picture", at("link")).unwrap();
        symlink("link", at("chain")).unwrap();
        symlink("real/not-yet", at("dangling")).unwrap();
        symlink("circle", at("circle")).unwrap();

        write_bytes(&at("chain"), b"new").unwrap();
        write_bytes(&at("dangling"), b"new").unwrap();
        assert_eq!(fs::read(at("real/picture")).unwrap(), b"new");
        assert_eq!(fs::read(at("real/not-yet")).unwrap(), b"new");
        assert!(fs::symlink_metadata(at("chain")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(at("link")).unwrap().is_symlink());
        assert!(matches!(check_writable(&at("circle")), Err(WriteError::Circle { .. })));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_device_is_written_to_and_not_replaced() {
        write_bytes(Path::new("/dev/null"), b"gone").unwrap();
        let full = write_bytes(Path::new("/dev/full"), b"too much");
        let Err(WriteError::Io { source, .. }) = full else { panic!("{full:?}") };
        assert_eq!(source.kind(), std::io::ErrorKind::StorageFull);
        for device in ["/dev/null", "/dev/full"] {
            assert!(!fs::metadata(device).unwrap().is_file());
        }
    }
}
