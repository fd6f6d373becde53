//! Files are read only where they are ordinary ones, and written all or nothing.

#![cfg(unix)]

use std::fs;
use std::io::ErrorKind;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::process::{Command, ExitStatus};

use rayloom_files::{open, read, read_text, write};

/// Names the file that a child process writes.
const TARGET: &str = "RAYLOOM_TEST_TARGET";
/// More than a child process may write.
const LONG: usize = 1 << 20;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn what_is_no_ordinary_file_is_refused_at_once_and_called_by_its_name() {
    let folder = folder();
    let within = |name: &str| folder.path().join(name);
    let made = Command::new("mkfifo").arg(within("fifo")).status().expect("mkfifo");
    assert!(made.success());
    let _socket = UnixListener::bind(within("socket")).expect("a socket");
    symlink(within("fifo"), within("link to a fifo")).expect("a link");
    symlink("nowhere", within("broken")).expect("a link");
    for (path, told) in [
        (within("fifo"), "FIFO"),
        (within("link to a fifo"), "FIFO"),
        (within("socket"), "socket"),
        (folder.path().to_owned(), "folder"),
        ("/dev/zero".into(), "device"),
        (within("broken"), "a link to nowhere"),
    ] {
        let error = open(&path).expect_err("refused").to_string();
        assert!(error.contains(told), "{}: {error}", path.display());
    }
    assert_eq!(open(&within("missing")).expect_err("refused").kind(), ErrorKind::NotFound);
}

#[test]
fn no_more_is_read_than_a_file_may_have() {
    let folder = folder();
    let file = folder.path().join("file");
    fs::write(&file, "12345").expect("written");
    assert_eq!(read(&file, 5).expect("read"), b"12345");
    let error = read(&file, 4).expect_err("refused").to_string();
    assert!(error.contains("5 bytes long, and at most 4 bytes"), "{error}");
    fs::write(&file, [b'a', 0xff]).expect("written");
    assert!(read_text(&file, 5).expect_err("refused").to_string().contains("no UTF-8 text: byte 1"));
    // Where there is nothing but holes, nothing is taken for them.
    fs::File::create(&file).and_then(|file| file.set_len(1 << 40)).expect("a sparse file");
    assert_eq!(read(&file, 1 << 20).expect_err("refused").kind(), ErrorKind::FileTooLarge);
}

#[test]
fn links_and_permissions_stay() {
    let folder = folder();
    let within = |name: &str| folder.path().join(name);
    write(&within("file"), b"new").expect("written");
    fs::set_permissions(within("file"), fs::Permissions::from_mode(0o640)).expect("permissions");
    symlink("file", within("link")).expect("a link");
    symlink("link", within("link to a link")).expect("a link");
    symlink("later", within("early")).expect("a link");
    write(&within("link to a link"), b"newer").expect("written");
    write(&within("early"), b"late").expect("written");
    assert_eq!(names(folder.path()), ["early", "file", "later", "link", "link to a link"]);
    assert_eq!(
        (fs::read(within("file")).ok(), fs::read(within("later")).ok()),
        (Some(b"newer".into()), Some(b"late".into()))
    );
    assert_eq!(fs::metadata(within("file")).expect("a file").permissions().mode() & 0o777, 0o640);
    assert!(within("link").is_symlink() && within("early").is_symlink());
    symlink("circle", within("circle")).expect("a link");
    assert!(write(&within("circle"), b"").expect_err("refused").to_string().contains("circle"));
    assert_eq!(write(folder.path(), b"").expect_err("refused").kind(), ErrorKind::IsADirectory);
    write(Path::new("/dev/null"), b"nothing").expect("written");
    assert!(!Path::new("/dev/null").is_file(), "the device was replaced");
}

/// Run by the tests below in processes of their own.
#[test]
#[ignore = "a part of other tests"]
fn child_writes() {
    let target = std::env::var_os(TARGET).expect("a file to write");
    let written = write(Path::new(&target), &vec![7; LONG]);
    std::process::exit(if written.is_ok() { 0 } else { 3 });
}

/// Writes in a process that may write half of it, as if the disk were full; with `killed` the system ends it right there.
fn write_half(target: &Path, killed: bool) -> ExitStatus {
    let program = std::env::current_exe().expect("this program");
    let ignoring = if killed { "" } else { "trap '' XFSZ; " };
    // In blocks of 512 bytes.
    let script =
        format!("{ignoring}ulimit -c 0; ulimit -f {}; exec \"$0\" --exact child_writes --ignored", LONG / 1024);
    Command::new("sh").arg("-c").arg(script).arg(program).env(TARGET, target).status().expect("a process")
}

#[test]
fn a_full_disk_leaves_the_old_file() {
    let folder = folder();
    let file = folder.path().join("file");
    fs::write(&file, "old").expect("written");
    assert_eq!(write_half(&file, false).code(), Some(3));
    assert_eq!(fs::read(&file).expect("read"), b"old");
    assert_eq!(names(folder.path()), ["file"]);
}

#[test]
fn a_kill_leaves_the_old_file_and_the_next_write_clears_what_is_left() {
    let folder = folder();
    let file = folder.path().join("file");
    fs::write(&file, "old").expect("written");
    assert_eq!(write_half(&file, true).code(), None, "it was not killed");
    assert_eq!(fs::read(&file).expect("read"), b"old");
    assert_eq!(names(folder.path()).len(), 2, "it was killed too early");
    // What another program is still writing stays.
    let other = folder.path().join(".rayloom-other.unfinished");
    let writing = fs::File::create(&other).expect("a file");
    writing.lock().expect("locked");
    write(&folder.path().join("another"), b"new").expect("written");
    assert_eq!(names(folder.path()), [".rayloom-other.unfinished", "another", "file"]);
}
