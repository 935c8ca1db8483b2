//! A text that grows by whole lines and is whole at every moment, whoever looks and whatever ends the program.
//!
//! ```text
//! file      rows up to k              ──► lacks k + 1, hidden
//! hidden    rows up to k − 1, + k, + k + 1  ──► file
//! ```
//!
//! An addition goes to the hidden copy, which lacks the one before as well; then both exchange their names. So every byte is
//! written twice, however long the text is, and whoever opens the file has until the second addition to read it.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::files::{HIDDEN, write_whole};

/// Length of a text without its end [bytes], and its CRC-32.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TextLength {
    bytes: u64,
    checksum: u32,
}

/// The length of a text that grows, kept up to date.
#[derive(Debug, Clone, Default)]
pub(super) struct Measured {
    pub(super) bytes: u64,
    hasher: Hasher,
}

impl Measured {
    /// The length of a text.
    pub(super) fn of(text: &str) -> Measured {
        let mut measured = Measured::default();
        measured.add(text);
        measured
    }

    /// Counts what was added.
    pub(super) fn add(&mut self, text: &str) {
        self.bytes += text.len() as u64;
        self.hasher.update(text.as_bytes());
    }

    /// The length so far.
    pub(super) fn length(&self) -> TextLength {
        TextLength { bytes: self.bytes, checksum: self.hasher.clone().finalize() }
    }
}

/// A text that grows.
#[derive(Debug)]
pub(super) struct Growing {
    path: PathBuf,
    /// The end that every state of the text has, such as closing tags.
    end: &'static str,
    /// Its length without the end.
    measured: Measured,
    file: File,
    /// The copy, once something was added, and the text that it lacks.
    hidden: Option<File>,
    lacks: String,
}

impl Growing {
    /// Writes the first state of a text.
    pub(super) fn create(path: &Path, text: &str, end: &'static str) -> Result<Growing> {
        write_whole(path, format!("{text}{end}").as_bytes())?;
        let file = open(path)?;
        let (measured, hidden, lacks) = (Measured::of(text), None, String::new());
        Ok(Growing { path: path.into(), end, measured, file, hidden, lacks })
    }

    /// Goes back to a length that the text has had.
    pub(super) fn reopen(path: &Path, length: TextLength, end: &'static str) -> Result<Growing> {
        let text = beginning(path, length)?.ok_or_else(|| changed(path))?;
        Growing::create(path, &text, end)
    }

    /// Adds whole lines.
    pub(super) fn add(&mut self, text: &str) -> Result<()> {
        let written = self.exchange(text).map_err(Error::io("write", &self.path));
        if written.is_err() {
            self.forget();
        }
        written
    }

    fn exchange(&mut self, text: &str) -> std::io::Result<()> {
        let [hidden, spare] = self.hidden_paths();
        let mut copy = match self.hidden.take() {
            Some(copy) => copy,
            None => {
                std::fs::copy(&self.path, &hidden)?;
                File::options().read(true).write(true).open(&hidden)?
            }
        };
        let start = self.measured.bytes - self.lacks.len() as u64;
        copy.seek(SeekFrom::Start(start))?;
        copy.write_all(format!("{}{text}{}", self.lacks, self.end).as_bytes())?;
        // where there are no links the next addition copies it anew
        let linked = std::fs::hard_link(&self.path, &spare).is_ok();
        std::fs::rename(&hidden, &self.path)?;
        let before = std::mem::replace(&mut self.file, copy);
        self.lacks = String::new();
        if linked {
            std::fs::rename(&spare, &hidden)?;
            self.hidden = Some(before);
            self.lacks = text.into();
        }
        self.measured.add(text);
        Ok(())
    }

    /// Its length so far.
    pub(super) fn length(&self) -> TextLength {
        self.measured.length()
    }

    /// The same file in another folder, into which it is about to be moved.
    pub(super) fn moves_to(&mut self, folder: &Path) {
        self.forget();
        if let Some(name) = self.path.file_name() {
            self.path = folder.join(name);
        }
    }

    fn hidden_paths(&self) -> [PathBuf; 2] {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        ["copy", "spare"].map(|which| self.path.with_file_name(format!("{HIDDEN}{which}-{name}")))
    }

    /// Removes the copy.
    fn forget(&mut self) {
        (self.hidden, self.lacks) = (None, String::new());
        // what resists is removed by the next run
        self.hidden_paths().into_iter().for_each(|path| drop(std::fs::remove_file(path)));
    }
}

impl Drop for Growing {
    fn drop(&mut self) {
        self.forget();
    }
}

/// Somebody has changed a file while a run was at work.
pub(super) fn changed(path: &Path) -> Error {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Error::folder(folder, format!("{name} was changed in between"), "run without --resume to begin anew")
}

/// The beginning of a file, if it is there as it was written.
pub(super) fn beginning(path: &Path, TextLength { bytes, checksum }: TextLength) -> Result<Option<String>> {
    let mut text = Vec::new();
    match File::open(path).and_then(|file| file.take(bytes).read_to_end(&mut text)) {
        Ok(_) => {}
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Error::io("read", path)(error)),
    }
    let same = text.len() as u64 == bytes && crc32fast::hash(&text) == checksum;
    Ok(String::from_utf8(text).ok().filter(|_| same))
}

fn open(path: &Path) -> Result<File> {
    File::options().read(true).write(true).open(path).map_err(Error::io("write", path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_opens_a_text_has_a_whole_one_while_lines_are_added() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let row = |k: usize| format!("{k:08},{}\n", "x".repeat(150 + k % 40));
        let mut text = Growing::create(&path, "head\n", "end\n").unwrap();
        let mut expected = String::from("head\n");
        for k in 0..300 {
            let mut opened = File::open(&path).unwrap();
            text.add(&row(k)).unwrap();
            let mut seen = String::new();
            opened.read_to_string(&mut seen).unwrap();
            assert!(seen == format!("{expected}end\n"), "opened before line {k} came");
            expected.push_str(&row(k));
            assert!(std::fs::read_to_string(&path).unwrap() == format!("{expected}end\n"), "line {k}");
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "the file and its copy");
        }
        let length = text.length();
        text.add("more\n").unwrap();
        drop(text);
        let mut text = Growing::reopen(&path, length, "end\n").unwrap();
        text.add("other\n").unwrap();
        text.add("third\n").unwrap();
        drop(text);
        assert!(std::fs::read_to_string(&path).unwrap() == format!("{expected}other\nthird\nend\n"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        std::fs::write(&path, "HEAD\n").unwrap();
        assert_eq!(beginning(&path, length).unwrap(), None);
        assert!(Growing::reopen(&path, length, "").is_err());
    }

    #[test]
    fn nothing_is_rewritten() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let mut text = Growing::create(&path, "head\n", "").unwrap();
        let written = || {
            let io = std::fs::read_to_string("/proc/thread-self/io").unwrap_or_default();
            io.lines().find_map(|line| line.strip_prefix("wchar: ")?.parse::<u64>().ok())
        };
        let Some(before) = written() else { return }; // only Linux tells
        (0..2000).for_each(|_| text.add(&"x".repeat(99)).unwrap());
        let bytes = written().unwrap() - before;
        assert!(bytes < 3 * 2000 * 99, "{bytes} for {}", 2000 * 99);
    }
}
