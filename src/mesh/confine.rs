//! Confinement of the mesher: a geometry is a program, and may come from a stranger.
//!
//! ```text
//! reads     the folder of the scene and of the .geo, folders the user lists, those of the system and of gmsh
//! writes    its private folder
//! starts    nothing
//! ```
//!
//! The kernel sees to that (Landlock), where it can; limits on memory, the size of files and the log hold everywhere. A thread confines
//! itself and starts the mesher, which inherits it.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};

use super::program::Program;

/// Files of the mesher end at this size [bytes].
const LARGEST_FILE: u64 = 8 << 30;
/// Folders of the system in which programs, libraries and their data are, and devices that hold nothing.
pub(super) const SYSTEM: [&str; 16] = [
    "/usr",
    "/bin",
    "/lib",
    "/lib32",
    "/lib64",
    "/opt",
    "/nix/store",
    "/gnu/store",
    "/etc/ld.so.cache",
    "/etc/ld.so.conf",
    "/etc/ld.so.conf.d",
    "/etc/fonts",
    "/etc/localtime",
    "/sys/devices/system/cpu",
    "/dev/urandom",
    "/dev/zero",
];
/// Variables of the environment that the mesher inherits.
const ENVIRONMENT: [&str; 4] = ["LD_LIBRARY_PATH", "OMP_NUM_THREADS", "VIRTUAL_ENV", "TZ"];

/// Rights of the mesher.
#[derive(Debug)]
pub(super) struct Confinement<'a> {
    /// The folder in which it works and writes.
    pub(super) private: &'a Path,
    /// The folder in which it works if it is trusted.
    pub(super) here: &'a Path,
    /// Folders and files that it may read, beside those of the system.
    pub(super) readable: Vec<PathBuf>,
    /// Memory that it may take [bytes].
    pub(super) memory: u64,
    /// False for a geometry that the user trusts: it may do what the user may, within the limits.
    pub(super) confined: bool,
}

impl Confinement<'_> {
    /// Starts the mesher; also true if the kernel confines it.
    pub(super) fn start(&self, mut command: Command, program: &Program) -> io::Result<(Child, bool)> {
        if self.confined {
            command.current_dir(self.private);
            self.own_environment(&mut command);
        } else {
            command.current_dir(self.here).env("GMSH_HOME", self.private.join("home"));
        }
        let started = || {
            let kept = self.confined && restrict(self, program);
            command.spawn().map(|child| (child, kept))
        };
        let started = std::thread::scope(|scope| scope.spawn(started).join());
        let (child, kept) = started.unwrap_or_else(|_| Err(io::Error::other("a thread has failed")))?;
        limit(&child, self.memory);
        Ok((child, kept))
    }

    /// Nothing of the user's environment but what libraries need; home and temporary files are in the private folder.
    fn own_environment(&self, command: &mut Command) {
        command.env_clear();
        for name in ENVIRONMENT {
            if let Some(value) = std::env::var_os(name) {
                command.env(name, value);
            }
        }
        if let Some(path) = std::env::var_os("PATH") {
            let absolute = std::env::split_paths(&path).filter(|folder| folder.is_absolute());
            if let Ok(path) = std::env::join_paths(absolute) {
                command.env("PATH", path);
            }
        }
        let home = self.private.join("home");
        command.env("GMSH_HOME", &home).env("HOME", home).env("TMPDIR", self.private).env("LC_ALL", "C");
    }
}

/// Confines this thread and what it starts from now on. True if the kernel does that.
#[cfg(target_os = "linux")]
fn restrict(confinement: &Confinement, program: &Program) -> bool {
    use landlock::{
        ABI, Access, AccessFs, AccessNet, Ruleset, RulesetAttr, RulesetCreatedAttr, RulesetStatus, Scope,
        path_beneath_rules,
    };
    let abi = ABI::V6;
    let read = AccessFs::ReadFile | AccessFs::ReadDir;
    let write = read
        | AccessFs::WriteFile
        | AccessFs::Truncate
        | AccessFs::MakeReg
        | AccessFs::MakeDir
        | AccessFs::RemoveFile
        | AccessFs::RemoveDir;
    let libraries = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    let libraries: Vec<PathBuf> = std::env::split_paths(&libraries).filter(|p| p.is_absolute()).collect();
    let system = SYSTEM.iter().map(PathBuf::from).chain(beside(&program.path)).chain(libraries);
    let system: Vec<PathBuf> = system.collect();
    let started: &[PathBuf] = if program.starts_others { &system } else { &[] };
    let confined = || {
        Ruleset::default()
            .handle_access(AccessFs::from_all(abi))?
            .handle_access(AccessNet::from_all(abi))?
            .scope(Scope::from_all(abi))?
            .create()?
            .add_rules(path_beneath_rules(&system, read))?
            .add_rules(path_beneath_rules(&confinement.readable, read))?
            .add_rules(path_beneath_rules(&program.executed, read | AccessFs::Execute))?
            .add_rules(path_beneath_rules(started, read | AccessFs::Execute))?
            .add_rules(path_beneath_rules([confinement.private], write))?
            .add_rules(path_beneath_rules(["/dev/null"], AccessFs::ReadFile | AccessFs::WriteFile))?
            .restrict_self()
    };
    confined().is_ok_and(|status: landlock::RestrictionStatus| status.ruleset != RulesetStatus::NotEnforced)
}

#[cfg(not(target_os = "linux"))]
fn restrict(_: &Confinement, _: &Program) -> bool {
    false
}

/// Folders of a program that is not of the system, with its libraries and their data.
#[cfg(target_os = "linux")]
fn beside(program: &Path) -> Vec<PathBuf> {
    let whole = std::fs::canonicalize(program).unwrap_or_else(|_| program.into());
    let mut found = Vec::new();
    for file in [program, &whole] {
        let Some(folder) = file.parent() else { continue };
        if let Some(prefix) = folder.parent().filter(|_| folder.ends_with("bin")) {
            found.extend(["bin", "lib", "lib64", "share", "pyvenv.cfg"].map(|name| prefix.join(name)));
        }
    }
    found
}

/// Limits the memory and the files of a process.
#[cfg(target_os = "linux")]
fn limit(child: &Child, memory: u64) {
    use rustix::process::{Pid, Resource, Rlimit, prlimit};
    let Some(pid) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) else { return };
    for (resource, most) in [(Resource::As, memory), (Resource::Fsize, LARGEST_FILE), (Resource::Core, 0)] {
        let limit = Rlimit { current: Some(most), maximum: Some(most) };
        // one that has ended already needs none
        let _ = prlimit(Some(pid), resource, limit);
    }
}

#[cfg(not(target_os = "linux"))]
fn limit(_: &Child, _: u64) {}
