//! The mesher as a file: where it is, and what the system starts to run it.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A program that may be started.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Program {
    /// Its file.
    pub(super) path: PathBuf,
    /// Files that the system executes with it: the loader of shared libraries, the interpreter of a script.
    pub(super) executed: Vec<PathBuf>,
    /// True for a script that may start anything, such as one of a shell.
    pub(super) starts_others: bool,
}

/// Finds a program: one with a folder in its name is that file; any other is sought in the folders of `PATH` that are absolute, so
/// that nothing beside a scene is started by accident.
pub(super) fn find(name: &Path, path: Option<&OsStr>) -> Option<Program> {
    let file = match name.components().count() {
        0 => return None,
        1 => {
            let folders = std::env::split_paths(path?).filter(|folder| folder.is_absolute());
            folders.map(|folder| folder.join(name)).find(|file| is_executable(file))?
        }
        _ => name.to_path_buf(),
    };
    Some(Program::of(&file))
}

impl Program {
    fn of(file: &Path) -> Program {
        let path = file.to_path_buf();
        let whole = |path: PathBuf| std::fs::canonicalize(&path).unwrap_or(path);
        let start = beginning(file);
        let mut executed = vec![whole(path.clone())];
        let mut starts_others = false;
        if let Some(line) = start.strip_prefix(b"#!") {
            let line = String::from_utf8_lossy(line.split(|byte| *byte == b'\n').next().unwrap_or_default());
            let interpreter = PathBuf::from(line.split_whitespace().next().unwrap_or_default());
            let name = interpreter.file_name().unwrap_or_default().to_string_lossy().into_owned();
            starts_others = !name.starts_with("python");
            let interpreter = whole(interpreter);
            executed.extend(loader(&beginning(&interpreter)).map(whole));
            executed.push(interpreter);
        } else {
            executed.extend(loader(&start).map(whole));
        }
        Program { path, executed, starts_others }
    }
}

/// The first bytes of a file, enough for the head of a program.
fn beginning(file: &Path) -> Vec<u8> {
    use std::io::Read;
    let mut start = Vec::new();
    // one that cannot be read is not started either
    let _ = std::fs::File::open(file).and_then(|file| file.take(1 << 14).read_to_end(&mut start));
    start
}

/// The loader that an ELF program of 64 bits names (segment PT_INTERP).
fn loader(elf: &[u8]) -> Option<PathBuf> {
    let number = |at: usize, bytes: usize| -> Option<usize> {
        let field = elf.get(at..at + bytes)?;
        Some(field.iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte)))
    };
    if !elf.starts_with(b"\x7fELF\x02\x01") {
        return None;
    }
    let (table, size, count) = (number(32, 8)?, number(54, 2)?, number(56, 2)?);
    for k in 0..count {
        let segment = table.checked_add(k * size)?;
        if number(segment, 4)? == 3 {
            let (from, length) = (number(segment + 8, 8)?, number(segment + 32, 8)?);
            let name = elf.get(from..from.checked_add(length)?)?;
            let name = name.split(|byte| *byte == 0).next()?;
            return Some(PathBuf::from(String::from_utf8_lossy(name).into_owned()));
        }
    }
    None
}

#[cfg(unix)]
fn is_executable(file: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    std::fs::metadata(file).is_ok_and(|data| data.is_file() && data.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_executable(file: &Path) -> bool {
    file.is_file()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bare_name_is_sought_in_absolute_folders_only() {
        let folder = tempfile::tempdir().unwrap();
        let beside = folder.path().join("sh");
        std::fs::write(&beside, "#!/bin/sh\n").unwrap();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            std::fs::set_permissions(&beside, std::fs::Permissions::from_mode(0o755)).unwrap();
        }
        let find = |name: &str, path: &str| find(Path::new(name), Some(OsStr::new(path)));
        assert!(find("sh", ".:").is_none(), "one beside");
        assert_eq!(find("sh", ".::/bin").unwrap().path, Path::new("/bin/sh"));
        let own = find(&beside.display().to_string(), "/bin").unwrap();
        assert_eq!(own.path, beside);
        assert!(own.starts_others && own.executed.len() >= 2, "{own:?}");
        assert!(find("no_such_program", "/bin:/usr/bin").is_none());
    }

    #[test]
    fn the_loader_of_a_program_is_read() {
        let Ok(this) = std::env::current_exe() else { return };
        if !beginning(&this).starts_with(b"\x7fELF\x02\x01") {
            return;
        }
        let found = loader(&beginning(&this)).unwrap();
        assert!(found.is_absolute() && found.exists(), "{}", found.display());
        assert_eq!(loader(b"\x7fELF\x02\x01"), None);
    }
}
