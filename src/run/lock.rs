//! The lock of a results folder: held as long as a run is at work there, by the system, which lets go when the run ends however it
//! ends.

use std::fs::{File, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::{Error, Result};
use crate::files::HIDDEN;

/// A run that was killed holds its lock until the system has cleared it away.
const GRACE: Duration = Duration::from_millis(50);

/// A lock; given back when dropped.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    /// The system's lock hangs on the open file.
    file: File,
}

impl Lock {
    /// Takes the lock of a folder, or says who holds it. None if the folder has gone in between.
    pub(crate) fn take(folder: &Path) -> Result<Option<Lock>> {
        let path = folder.join(format!("{HIDDEN}lock"));
        loop {
            let opened = File::options().read(true).write(true).create(true).truncate(false).open(&path);
            let mut file = match opened {
                Ok(file) => file,
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
                Err(error) => return Err(Error::io("write to", folder)(error)),
            };
            match within(GRACE, || file.try_lock()) {
                Err(TryLockError::WouldBlock) => {
                    let help = "wait for its end, or choose another folder with -o";
                    return Err(Error::folder(folder, holder(&mut file), help));
                }
                // a file system without locks: as good as it gets
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            if !is_still(&file, &path) {
                continue; // the one before has removed it while this one waited
            }
            // for people only
            let _ =
                file.set_len(0).and_then(|()| file.rewind()).and_then(|()| file.write_all(own().as_bytes()));
            return Ok(Some(Lock { path, file }));
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // before it is let go, so that nobody has taken it yet; one that stays is taken by the next run
        if is_still(&self.file, &self.path) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Tries again for a time.
fn within<E>(time: Duration, attempt: impl Fn() -> std::result::Result<(), E>) -> std::result::Result<(), E> {
    let begun = Instant::now();
    loop {
        match attempt() {
            Err(_) if begun.elapsed() < time => std::thread::sleep(Duration::from_millis(10)),
            ended => return ended,
        }
    }
}

/// True if the path still names this file.
#[cfg(unix)]
fn is_still(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |data: std::fs::Metadata| (data.dev(), data.ino());
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(own), Ok(there)) => number(own) == number(there),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_still(_: &File, path: &Path) -> bool {
    path.is_file()
}

/// This process, as the others read it.
fn own() -> String {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    format!("process {} on {}: midplane {}\n", std::process::id(), host(), arguments.join(" "))
}

#[cfg(unix)]
fn host() -> String {
    rustix::system::uname().nodename().to_string_lossy().into_owned()
}

#[cfg(not(unix))]
fn host() -> String {
    "this machine".into()
}

fn holder(file: &mut File) -> String {
    let mut text = String::new();
    let _ = file.rewind().and_then(|()| file.read_to_string(&mut text)); // told without, if it cannot be read
    format!("another run is at work there, {}", text.trim()).trim_end_matches(", ").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_one_run_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let lock = Lock::take(folder.path()).unwrap().unwrap();
        let refused = Lock::take(folder.path()).unwrap_err();
        assert_eq!(refused.exit_code(), 4);
        let said = refused.to_string();
        assert!(said.contains(&format!("process {} on ", std::process::id())), "{said}");
        drop(lock);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left of it");
        // what a killed run leaves
        std::fs::write(folder.path().join(".midplane-lock"), "process 1 on nowhere: midplane run").unwrap();
        assert!(Lock::take(folder.path()).unwrap().is_some());
        assert!(Lock::take(&folder.path().join("gone")).unwrap().is_none());
    }
}
