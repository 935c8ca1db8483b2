//! The one error of the program: what is wrong, where, and what would have been right; and what it warns of.

mod clean;
mod stop;
mod warning;

pub use clean::{clean, short_line, short_message};
pub use stop::Stop;
pub use warning::{Code, Warning};

use std::path::PathBuf;

/// Result of everything that can fail on input or environment.
pub type Result<T> = std::result::Result<T, Error>;

/// Everything that ends a run. The variant decides the exit code, the values make the message.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A wrong value, key or name in a text file the user wrote (scene, path, study).
    #[error("{at}: {what}; {help}")]
    Text {
        /// Position in a file.
        at: Box<At>,
        /// The fault there.
        what: String,
        /// The remedy.
        help: String,
    },
    /// A geometry or mesh file that cannot be used.
    #[error("{}: {what}; {help}", file.display())]
    Mesh {
        /// The `.geo` or `.msh` file.
        file: PathBuf,
        /// Its fault.
        what: String,
        /// The remedy.
        help: String,
    },
    /// gmsh read the geometry and refused it.
    #[error("{}: gmsh {outcome}\n{}", file.display(), indent(tail))]
    Gmsh {
        /// The `.geo` file.
        file: PathBuf,
        /// End of gmsh, such as "ended with exit code 1".
        outcome: String,
        /// The last lines gmsh printed.
        tail: Vec<String>,
    },
    /// Two sides that cannot be joined.
    #[error("interface {name}: {what}; {help}")]
    Interface {
        /// Name of the interface in the scene.
        name: String,
        /// The fault.
        what: String,
        /// The remedy.
        help: String,
    },
    /// A body that the supports and interfaces do not hold.
    #[error(
        "{subdomain} can move freely: {mode}; hold it with \"fix\" or \"displace\", or join it by an interface with stiffness in that direction"
    )]
    FreeBody {
        /// Name of the subdomain.
        subdomain: String,
        /// The free rigid motion, such as "translation in x".
        mode: String,
    },
    /// Equilibrium was not found; what converged before is on disk.
    #[error("step \"{step}\", increment {increment}: no equilibrium, {reason}; kept {kept} increments")]
    NoEquilibrium {
        /// Name of the step.
        step: String,
        /// Number of the increment within its step, from 1.
        increment: usize,
        /// Why the solution was given up.
        reason: String,
        /// Converged increments on disk.
        kept: usize,
    },
    /// A signal asked the run to end; what converged before is on disk.
    #[error("stopped by {}; {kept}", signal_name(*signal))]
    Stopped {
        /// Number of the signal.
        signal: u8,
        /// Results on disk, and the way to go on.
        kept: String,
    },
    /// A results folder that cannot be used.
    #[error("{}: {what}; {help}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The fault.
        what: String,
        /// The remedy.
        help: String,
    },
    /// A checkpoint from which this run cannot go on.
    #[error("{}: {what}; {help}", file.display())]
    Checkpoint {
        /// The checkpoint, or the folder without one.
        file: PathBuf,
        /// The difference.
        what: String,
        /// The remedy.
        help: String,
    },
    /// A program that midplane needs is missing, was killed or ran out of time.
    #[error("{program}: {what}; {help}")]
    Program {
        /// Name of the program.
        program: String,
        /// The event.
        what: String,
        /// Help.
        help: String,
    },
    /// The file system refused.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// The attempt, such as "write".
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's answer.
        source: std::io::Error,
    },
}

/// A place in a text file.
#[derive(Debug, Clone, Default)]
pub struct At {
    /// The file.
    pub file: PathBuf,
    /// Line from 1, 0 if the place is the whole file.
    pub line: usize,
    /// Path of the key, such as `interfaces.interface.side_b`; empty for the whole file.
    pub key: String,
    /// The text of the file, for the excerpt below the message.
    pub text: String,
    /// Byte range in `text`.
    pub span: std::ops::Range<usize>,
    /// True if the text has the key itself, not only one above it.
    pub stated: bool,
}

impl std::fmt::Display for At {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.file.display())?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        if !self.key.is_empty() {
            let space = if self.file.as_os_str().is_empty() { "" } else { " " };
            write!(f, "{space}{}", short_line(&self.key))?;
        }
        Ok(())
    }
}

impl Error {
    /// Exit code of the program: 2 bad input, 3 no equilibrium, 4 environment, 128 + its number after a signal.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Text { .. }
            | Error::Mesh { .. }
            | Error::Gmsh { .. }
            | Error::Interface { .. }
            | Error::FreeBody { .. }
            | Error::Checkpoint { .. } => 2,
            Error::NoEquilibrium { .. } => 3,
            Error::Stopped { signal, .. } => 128 + signal,
            Error::Program { .. } | Error::Folder { .. } => 4,
            // a file the user named and that is not there is bad input; a full disk is the environment
            Error::Io { action, source, .. } if *action == "read" => match source.kind() {
                std::io::ErrorKind::NotFound
                | std::io::ErrorKind::IsADirectory
                | std::io::ErrorKind::NotADirectory
                | std::io::ErrorKind::InvalidData => 2,
                _ => 4,
            },
            Error::Io { .. } => 4,
        }
    }

    /// The end by a signal before anything was written.
    pub fn stopped(signal: u8) -> Error {
        Error::Stopped { signal, kept: "nothing was written".into() }
    }

    /// Shorthand for a mesh error.
    pub fn mesh(file: impl Into<PathBuf>, what: impl Into<String>, help: impl Into<String>) -> Error {
        Error::Mesh { file: file.into(), what: what.into(), help: help.into() }
    }

    /// Shorthand for an error of a results folder.
    pub fn folder(folder: impl Into<PathBuf>, what: impl Into<String>, help: impl Into<String>) -> Error {
        Error::Folder { folder: folder.into(), what: what.into(), help: help.into() }
    }

    /// Shorthand for a file system error.
    pub fn io(action: &'static str, path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Error {
        let path = path.into();
        move |source| Error::Io { action, path, source }
    }
}

/// More names than these come after the one that is meant.
const MANY: usize = 10;

/// "there is a, b, c. Did you mean \"b\"?": the help for a name that is not among `available`.
pub fn name_help<'a>(wanted: &str, available: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<&str> = available.into_iter().collect();
    if names.is_empty() {
        return "there are none".into();
    }
    let many = names.len() > MANY;
    let close = names
        .iter()
        .map(|name| (strsim::damerau_levenshtein(&wanted.to_lowercase(), &name.to_lowercase()), name))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, name)| {
            let length = name.chars().count();
            *distance <= 1 + length / 3 && *distance < length
        });
    if let Some((_, name)) = close
        && many
    {
        return format!("did you mean \"{name}\"? There is {}", names.join(", "));
    }
    let mut help = format!("there is {}", names.join(", "));
    if let Some((_, name)) = close {
        help.push_str(&format!(". Did you mean \"{name}\"?"));
    }
    help
}

/// The name of a signal that ends runs.
fn signal_name(signal: u8) -> String {
    match signal {
        1 => "SIGHUP".into(),
        2 => "Ctrl-C".into(),
        15 => "SIGTERM".into(),
        other => format!("signal {other}"),
    }
}

fn indent(lines: &[String]) -> String {
    lines.iter().map(|line| format!("    {line}")).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_gets_a_suggestion_and_a_foreign_one_does_not() {
        assert_eq!(name_help("botom", ["bottom", "top"]), "there is bottom, top. Did you mean \"bottom\"?");
        assert_eq!(name_help("zzz", ["bottom", "top"]), "there is bottom, top");
        assert_eq!(name_help("zzz", []), "there are none");
    }
}
