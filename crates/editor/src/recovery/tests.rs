use std::fs::{self, File};
use std::process::{Command, Stdio};
use std::time::Duration;

use super::*;

fn snapshot(text: &str) -> Snapshot {
    Snapshot {
        original_path: Some(PathBuf::from("/home/a b/сцена 100%.toml")),
        title: "Two\nlines, сцена".to_owned(),
        text: text.to_owned(),
    }
}

fn files(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

/// Leaves what a killed program leaves: the lock is free, the files stay.
fn kill(mut session: Session) {
    drop(session.lock.take());
    std::mem::forget(session);
}

#[test]
fn an_editor_that_ends_well_leaves_nothing() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("new/folder");
    let mut session = Session::start(&folder).unwrap();
    session.write(&snapshot("a")).unwrap();
    let mut other = Session::start(&folder).unwrap();
    other.clear().unwrap();
    assert!(orphans(&folder).is_empty(), "both are running");
    assert_eq!(files(&folder), 3);
    session.clear().unwrap();
    assert_eq!(files(&folder), 2);
    session.write(&snapshot("b")).unwrap();
    drop((session, other));
    assert_eq!(files(&folder), 0);
}

#[test]
fn what_is_left_behind_comes_back_until_it_is_discarded() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut first = Session::start(folder).unwrap();
    first.write(&snapshot("old")).unwrap();
    first.write(&snapshot("# first\r\n\nformat = 1\n")).unwrap();
    let first_document = first.document.clone();
    kill(first);
    File::options()
        .append(true)
        .open(&first_document)
        .unwrap()
        .set_modified(SystemTime::now() - Duration::from_secs(60))
        .unwrap();
    let mut second = Session::start(folder).unwrap();
    let unnamed = Snapshot { original_path: None, ..snapshot("") };
    second.write(&unnamed).unwrap();
    kill(second);
    let running = Session::start(folder).unwrap();

    let found = orphans(folder);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].read().unwrap(), unnamed);
    assert_eq!(found[1].read().unwrap(), snapshot("# first\r\n\nformat = 1\n"));
    assert!(found[0].written() > found[1].written());
    assert!(orphans(folder).is_empty(), "whoever has found them holds them");
    drop(found);
    let mut found = orphans(folder);
    assert_eq!(found.len(), 2, "looking takes nothing away");
    found.remove(0).discard().unwrap();
    drop(found);
    let found = orphans(folder);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].path(), first_document);
    drop((found, running));
    assert_eq!(files(folder), 2);
    // Where the lock file got lost, the document is none the less there.
    fs::remove_file(first_document.with_extension("lock")).unwrap();
    assert_eq!(orphans(folder).len(), 1);
}

#[test]
fn a_session_killed_without_a_document_leaves_nothing_in_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let running = Session::start(folder).unwrap();
    let mut saved = Session::start(folder).unwrap();
    saved.write(&snapshot("saved since")).unwrap();
    saved.clear().unwrap();
    kill(saved);
    kill(Session::start(folder).unwrap());
    assert_eq!(files(folder), 3);
    assert!(orphans(folder).is_empty());
    assert_eq!(files(folder), 1);
    assert!(running.lock_path.exists());
}

#[test]
fn a_document_can_be_left_behind_on_purpose() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Session::start(folder.path()).unwrap();
    session.write(&snapshot("kept")).unwrap();
    assert!(orphans(folder.path()).is_empty());
    session.leave_behind();
    assert_eq!(orphans(folder.path())[0].read().unwrap(), snapshot("kept"));
}

#[test]
fn garbage_is_passed_over_and_left() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("notes.toml"), "format = 1\n").unwrap();
    fs::write(folder.join("empty.toml"), "").unwrap();
    fs::write(folder.join("binary.toml"), [0xff, 0xfe, 0x00]).unwrap();
    fs::write(folder.join("alone.lock"), "").unwrap();
    fs::create_dir(folder.join("folder.toml")).unwrap();
    fs::write(folder.join("bad.toml"), b"# catoptric recovery 1\n# path %zz\n\xff").unwrap();
    fs::write(folder.join("odd.toml"), "# catoptric recovery 1\n# path %zz\n# title %").unwrap();
    let found = orphans(folder);
    assert_eq!(found.len(), 2);
    let texts: Vec<_> = found.iter().map(|orphan| orphan.read().map(|snapshot| snapshot.text).ok()).collect();
    assert!(texts.contains(&None) && texts.contains(&Some("# path %zz\n# title %".to_owned())), "{texts:?}");
    drop(found);
    assert_eq!(files(folder), 9, "seven entries and two locks");
    assert!(orphans(&folder.join("none")).is_empty());
    Session::start(&folder.join("notes.toml")).unwrap_err();
}

const CHILD_FOLDER: &str = "CATOPTRIC_TEST_RECOVERY_FOLDER";

/// Run by the test below in a process of its own.
#[test]
fn child_that_never_ends() {
    let Some(folder) = std::env::var_os(CHILD_FOLDER) else { return };
    let mut session = Session::start(Path::new(&folder)).unwrap();
    session.write(&snapshot("from the child")).unwrap();
    loop {
        std::thread::park();
    }
}

#[test]
fn a_killed_process_leaves_an_orphan() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["recovery::tests::child_that_never_ends", "--exact"])
        .env(CHILD_FOLDER, folder)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let has_written = || {
        fs::read_dir(folder)
            .unwrap()
            .any(|entry| entry.unwrap().path().extension().is_some_and(|extension| extension == DOCUMENT))
    };
    while !has_written() {
        assert!(child.try_wait().unwrap().is_none(), "the child has ended");
        std::thread::sleep(Duration::from_millis(5));
    }
    let while_running = orphans(folder).len();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(while_running, 0);
    let found = orphans(folder);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].read().unwrap(), snapshot("from the child"));
}
