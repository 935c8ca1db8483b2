//! gmsh as a subprocess: confined, no shell, no pipe that could fill up, no option files of the user, never without an end.

use std::ffi::OsString;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::OnceLock;
use std::time::Duration;

use super::confine::Confinement;
use super::watch::{exceeded, in_its_own_group, kill_group, memory, wait};
use super::{log, program};
use crate::error::{Error, Result, Stop};

/// The mesher and how long it may take.
#[derive(Debug)]
pub struct Gmsh {
    /// Name or path of the program.
    program: PathBuf,
    /// Time limit of one run.
    limit: Duration,
    version: OnceLock<String>,
    /// A request to stop, which ends it.
    stop: Stop,
    /// Folders that a geometry may read, beside its own.
    readable: Vec<PathBuf>,
    /// Geometries may do what the user may.
    trusting: bool,
    /// Memory of one run [bytes].
    memory: u64,
    /// Whether the kernel confines it, once it has been started.
    kept: OnceLock<bool>,
}

/// A run of gmsh.
#[derive(Debug)]
pub(super) struct Task<'a> {
    /// The .geo, or the .msh of an earlier format; absolute, as the user has it.
    pub(super) file: &'a Path,
    /// Values handed to a .geo with -setnumber.
    pub(super) parameters: &'a [(String, f64)],
    /// True for a file that holds a mesh already.
    pub(super) conversion: bool,
}

/// Settings that the reader relies on, and one thread so that the mesh does not depend on their number.
const SETTINGS: [&str; 12] = [
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
];
/// The same settings as gmsh reads them after the .geo: whatever the .geo sets, these hold.
const AFTERWARDS: &str = "\
Mesh.Format = 1;
Mesh.MshFileVersion = 4.1;
Mesh.Binary = 1;
Mesh.SaveParametric = 0;
Mesh.Renumber = 1;
Mesh.PartitionSplitMeshFiles = 0;
General.NumThreads = 1;
Mesh.MaxNumThreads1D = 1;
Mesh.MaxNumThreads2D = 1;
";
/// File of the output of a run.
const LOG: &str = "gmsh.log";

impl Default for Gmsh {
    fn default() -> Gmsh {
        Gmsh::new("gmsh", Duration::from_secs(600))
    }
}

impl Gmsh {
    /// A mesher by name or path, with a time limit for each run.
    pub fn new(program: impl Into<PathBuf>, limit: Duration) -> Gmsh {
        let program: PathBuf = program.into();
        // gmsh works elsewhere: a path, unlike a bare name, is relative to where midplane runs
        let is_path = program.components().count() > 1;
        let program = if is_path { std::path::absolute(&program).unwrap_or(program) } else { program };
        Gmsh {
            program,
            limit,
            version: OnceLock::new(),
            stop: Stop::default(),
            readable: Vec::new(),
            trusting: false,
            memory: memory(),
            kept: OnceLock::new(),
        }
    }

    /// The same, with folders that geometries may read; one that is `trusting` lets them do what the user may.
    pub fn allowing(self, readable: &[PathBuf], trusting: bool) -> Gmsh {
        let whole = |folder: &PathBuf| std::fs::canonicalize(folder).unwrap_or_else(|_| folder.clone());
        Gmsh { readable: readable.iter().map(whole).collect(), trusting, ..self }
    }

    /// The same with so much memory for one run [bytes].
    pub fn within(self, memory: u64) -> Gmsh {
        Gmsh { memory, ..self }
    }

    /// False if a geometry was meshed that the kernel does not confine, though it is not trusted.
    pub fn is_confined(&self) -> bool {
        self.trusting || *self.kept.get().unwrap_or(&true)
    }

    /// True if geometries may do what the user may.
    pub(super) fn is_trusting(&self) -> bool {
        self.trusting
    }

    /// Folders that a geometry may read: its own, those of the scene, and those that the user lists.
    pub(super) fn readable(&self, geo: &Path) -> Vec<PathBuf> {
        let own = geo.parent().map(Path::to_path_buf);
        let whole = std::fs::canonicalize(geo).ok().and_then(|geo| geo.parent().map(Path::to_path_buf));
        self.readable.iter().cloned().chain(own).chain(whole).collect()
    }

    /// The same, ended when it is asked to stop.
    pub fn until(self, stop: &Stop) -> Gmsh {
        Gmsh { stop: stop.clone(), ..self }
    }

    /// The version gmsh states; asked once.
    pub fn version(&self) -> Result<&str> {
        if let Some(version) = self.version.get() {
            return Ok(version);
        }
        let folder = tempfile::tempdir().map_err(Error::io("create a folder in", std::env::temp_dir()))?;
        let ended = self.start(folder.path(), folder.path(), Vec::new(), &["--version".into()])?;
        let stated = ended.lines.iter().rev().find(|line| !line.trim().is_empty());
        match stated {
            Some(version) if ended.status.success() => {
                Ok(self.version.get_or_init(|| version.trim().to_string()))
            }
            _ => Err(self.broken(format!("--version {}", log::outcome(ended.status)), "is it gmsh?")),
        }
    }

    /// Writes the mesh of a task into `folder` and returns its file; gmsh reads `source`, which is the file of the task
    /// or a copy of it in `mirror`.
    pub(super) fn mesh(&self, task: &Task, source: &Path, mirror: &Path, folder: &Path) -> Result<PathBuf> {
        let (mesh, settings) = (folder.join("mesh.msh"), folder.join("settings.geo"));
        std::fs::write(&settings, task.afterwards()).map_err(Error::io("write", &settings))?;
        let mut arguments = vec![source.as_os_str().to_owned(), settings.as_os_str().to_owned()];
        arguments.extend(task.options());
        arguments.extend(["-o".into(), mesh.as_os_str().to_owned()]);
        let file = task.file;
        let here = file.parent().unwrap_or(Path::new("/"));
        let ended = self.start(here, folder, self.readable(file), &arguments);
        let mut ended = ended.map_err(|error| of_file(file, error))?;
        let mirror = mirror.display().to_string();
        if let Some(end) = exceeded(ended.status, &folder.join(LOG)) {
            return Err(of_file(file, self.broken(end, "is it a geometry that ends?")));
        }
        ended.lines.iter_mut().for_each(|line| *line = line.replace(&mirror, ""));
        let complained = ended.lines.iter().any(|line| line.starts_with("Error   :"));
        if ended.status.code().is_none() {
            let what = format!("{} while \"{}\"", log::outcome(ended.status), log::stage(&ended.lines));
            return Err(of_file(file, self.broken(what, log::crash_help(ended.status))));
        }
        let refused =
            |outcome: String| Error::Gmsh { file: file.into(), outcome, tail: log::quoted(&ended.lines) };
        if !ended.status.success() {
            return Err(refused(log::outcome(ended.status)));
        }
        if complained {
            return Err(refused("reported errors, though it ended with exit code 0".into()));
        }
        if !mesh.symlink_metadata().is_ok_and(|data| data.is_file()) {
            return Err(refused("ended with exit code 0 and wrote no mesh".into()));
        }
        Ok(mesh)
    }

    /// Runs gmsh, with its output and its home in `folder`; one that is trusted works in `here`.
    fn start(
        &self,
        here: &Path,
        folder: &Path,
        readable: Vec<PathBuf>,
        arguments: &[OsString],
    ) -> Result<Ended> {
        let program = program::find(&self.program, std::env::var_os("PATH").as_deref())
            .ok_or_else(|| self.unavailable(&std::io::ErrorKind::NotFound.into()))?;
        let log = folder.join(LOG);
        let home = folder.join("home");
        std::fs::create_dir_all(&home).map_err(Error::io("create", &home))?;
        let output = File::create(&log).map_err(Error::io("create", &log))?;
        let errors = output.try_clone().map_err(Error::io("create", &log))?;
        let mut command = Command::new(&program.path);
        in_its_own_group(&mut command);
        // a home of its own: else ~/.gmshrc and ~/.gmsh-options would change the mesh
        command.args(arguments).stdin(Stdio::null()).stdout(output).stderr(errors);
        let (private, memory, confined) = (folder, self.memory, !self.trusting);
        let confinement = Confinement { private, here, readable, memory, confined };
        let started = confinement.start(command, &program);
        let (mut child, kept) = started.map_err(|source| self.unavailable(&source))?;
        let _ = self.kept.set(kept); // every run is the same
        let waited = wait(&mut child, self.limit, &self.stop, &log);
        let ended = matches!(waited, Ok(Some(_)));
        // what it has left behind ends with it; killing fails only if there is nothing
        kill_group(&mut child, ended);
        if !ended {
            let _ = child.wait();
        }
        if let Some(signal) = self.stop.requested() {
            return Err(Error::stopped(signal));
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

    fn broken(&self, what: String, help: &str) -> Error {
        Error::Program { program: self.program.display().to_string(), what, help: help.into() }
    }
}

impl Task<'_> {
    /// All options of the run but the file names.
    pub(super) fn options(&self) -> Vec<OsString> {
        let mut options: Vec<OsString> = vec![if self.conversion { "-save".into() } else { "-2".into() }];
        options.extend(SETTINGS.iter().map(OsString::from));
        for (name, value) in self.parameters {
            // {:e} prints the shortest text that reads back as the same number
            options.extend(["-setnumber".into(), name.into(), format!("{value:e}").into()]);
        }
        options
    }

    /// The settings that gmsh reads last. All that a mesh file holds is kept; of a geometry, what groups hold.
    pub(super) fn afterwards(&self) -> String {
        format!("{AFTERWARDS}Mesh.SaveAll = {};\n", u8::from(self.conversion))
    }
}

/// A failure of the program, told of a file.
fn of_file(file: &Path, error: Error) -> Error {
    match error {
        Error::Program { program, what, help } => {
            Error::Program { program: file.display().to_string(), what: format!("{program} {what}"), help }
        }
        other => other,
    }
}

struct Ended {
    status: ExitStatus,
    lines: Vec<String>,
}
