//! gmsh as a subprocess: no shell, no pipe that could fill up, no option files of the user, never without an end.

use std::ffi::OsString;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use crate::error::{Error, Result};

/// The mesher and how long it may take.
#[derive(Debug)]
pub struct Gmsh {
    /// Name or path of the program.
    program: PathBuf,
    /// Time limit of one run.
    limit: Duration,
    version: OnceLock<String>,
}

/// Values handed to a .geo with -setnumber.
pub(super) type Parameters = [(String, f64)];

/// Settings that the reader relies on, and one thread so that the mesh does not depend on their number.
const SETTINGS: [&str; 16] = [
    "-2",
    "-format",
    "msh41",
    "-bin",
    "-nt",
    "1",
    "-nopopup",
    "-setnumber",
    "Mesh.SaveParametric",
    "0",
    "-setnumber",
    "Mesh.Renumber",
    "1",
    "-setnumber",
    "Mesh.SaveAll",
    "0",
];
/// Lines of gmsh's output that an error quotes.
const TAIL: usize = 12;
/// How late the end of gmsh may be noticed.
const LONGEST_PAUSE: Duration = Duration::from_millis(20);

impl Default for Gmsh {
    fn default() -> Gmsh {
        Gmsh::new("gmsh", Duration::from_secs(600))
    }
}

impl Gmsh {
    /// A mesher by name or path, with a time limit for each run.
    pub fn new(program: impl Into<PathBuf>, limit: Duration) -> Gmsh {
        Gmsh { program: program.into(), limit, version: OnceLock::new() }
    }

    /// The version gmsh states; asked once.
    pub fn version(&self) -> Result<&str> {
        if let Some(version) = self.version.get() {
            return Ok(version);
        }
        let folder = tempfile::tempdir().map_err(Error::io("create a folder in", std::env::temp_dir()))?;
        let ended = self.start(folder.path(), folder.path(), &["--version".into()])?;
        let stated = ended.lines.iter().rev().find(|line| !line.trim().is_empty());
        match stated {
            Some(version) if ended.status.success() => {
                Ok(self.version.get_or_init(|| version.trim().to_string()))
            }
            _ => Err(self.broken(format!("--version {}", outcome(ended.status)), "is it gmsh?")),
        }
    }

    /// Meshes `geo` (an absolute path) into `folder`; returns the file written there.
    pub(super) fn mesh(&self, geo: &Path, parameters: &Parameters, folder: &Path) -> Result<PathBuf> {
        let mesh = folder.join("mesh.msh");
        let mut arguments = vec![geo.as_os_str().to_owned()];
        arguments.extend(options(parameters));
        arguments.extend(["-o".into(), mesh.as_os_str().to_owned()]);
        let ended = self.start(geo.parent().unwrap_or(Path::new("/")), folder, &arguments)?;
        let complained = ended.lines.iter().any(|line| line.starts_with("Error   :"));
        if ended.status.code().is_none() {
            return Err(self.broken(outcome(ended.status), "was it short of memory?"));
        }
        let refused = |outcome: String| Error::Gmsh { file: geo.into(), outcome, tail: tail(&ended.lines) };
        if !ended.status.success() {
            return Err(refused(outcome(ended.status)));
        }
        if complained {
            return Err(refused("reported errors, though it ended with exit code 0".into()));
        }
        if !mesh.is_file() {
            return Err(refused("ended with exit code 0 and wrote no mesh".into()));
        }
        Ok(mesh)
    }

    /// Runs gmsh in `here`, with its output and its home in `folder`.
    fn start(&self, here: &Path, folder: &Path, arguments: &[OsString]) -> Result<Ended> {
        let log = folder.join("gmsh.log");
        let home = folder.join("home");
        std::fs::create_dir_all(&home).map_err(Error::io("create", &home))?;
        let output = File::create(&log).map_err(Error::io("create", &log))?;
        let errors = output.try_clone().map_err(Error::io("create", &log))?;
        let child = Command::new(&self.program)
            .args(arguments)
            .current_dir(here)
            .env("GMSH_HOME", &home) // else ~/.gmshrc and ~/.gmsh-options would change the mesh
            .stdin(Stdio::null())
            .stdout(output)
            .stderr(errors)
            .spawn();
        let mut child = child.map_err(|source| self.unavailable(&source))?;
        let waited = wait(&mut child, self.limit);
        if !matches!(waited, Ok(Some(_))) {
            // killing fails only if it has ended by itself
            let _ = child.kill();
            let _ = child.wait();
        }
        let lines = || {
            let text = std::fs::read(&log).unwrap_or_default();
            String::from_utf8_lossy(&text).lines().map(str::to_string).collect::<Vec<_>>()
        };
        match waited {
            Ok(Some(status)) => Ok(Ended { status, lines: lines() }),
            Ok(None) => {
                let last = lines().pop().unwrap_or_else(|| "nothing".into());
                let what = format!(
                    "was still running after {} s and was stopped; it last said: {last}",
                    self.limit.as_secs_f64()
                );
                Err(self.broken(what, "use a coarser mesh or a longer time limit"))
            }
            Err(source) => Err(self.broken(
                format!("cannot be waited for: {source}"),
                "start midplane where SIGCHLD is not ignored",
            )),
        }
    }

    fn unavailable(&self, source: &std::io::Error) -> Error {
        match source.kind() {
            std::io::ErrorKind::NotFound => self.broken(
                "not found".into(),
                "install gmsh (Debian: apt install gmsh) or add its folder to PATH",
            ),
            _ => self.broken(
                format!("cannot be started: {source}"),
                "check that the file is an executable program",
            ),
        }
    }

    fn broken(&self, what: String, cure: &str) -> Error {
        Error::Program { program: self.program.display().to_string(), what, cure: cure.into() }
    }
}

/// The exit status, or nothing if `limit` passes first. Asks now and then: a signal handler would concern all threads.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        let Some(left) = limit.checked_sub(start.elapsed()) else { return Ok(None) };
        std::thread::sleep(pause.min(left));
        pause = (2 * pause).min(LONGEST_PAUSE);
    }
}

/// All options of a run but the file names.
pub(super) fn options(parameters: &Parameters) -> Vec<OsString> {
    let mut options: Vec<OsString> = SETTINGS.iter().map(OsString::from).collect();
    for (name, value) in parameters {
        // {:e} prints the shortest text that reads back as the same number
        options.extend(["-setnumber".into(), name.into(), format!("{value:e}").into()]);
    }
    options
}

struct Ended {
    status: ExitStatus,
    lines: Vec<String>,
}

/// "ended with exit code 1", "was killed by signal 9".
fn outcome(status: ExitStatus) -> String {
    use std::os::unix::process::ExitStatusExt;
    match (status.code(), status.signal()) {
        (Some(code), _) => format!("ended with exit code {code}"),
        (None, Some(signal)) => format!("was killed by signal {signal}"),
        (None, None) => "ended without an exit code".into(),
    }
}

/// What gmsh said that matters: its errors if there are any, else its last lines.
fn tail(lines: &[String]) -> Vec<String> {
    let loud = |line: &&String| line.starts_with("Error") || line.starts_with("Warning");
    let mut kept: Vec<&String> = lines.iter().filter(loud).collect();
    if kept.is_empty() {
        kept = lines.iter().collect();
    }
    let from = kept.len().saturating_sub(TAIL);
    kept[from..].iter().map(|line| (*line).clone()).collect()
}
