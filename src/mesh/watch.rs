//! A mesher at work: its group, the limits that end it, its end.

use std::path::Path;
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use super::log;
use crate::error::Stop;

/// Largest size of the output of a run [bytes].
const LONGEST_LOG: u64 = 64 << 20;
/// Largest delay in noticing the end of a mesher.
const LONGEST_PAUSE: Duration = Duration::from_millis(20);

/// Whatever a mesher starts belongs to its group and ends with it.
#[cfg(unix)]
pub(super) fn in_its_own_group(command: &mut Command) {
    use std::os::unix::process::CommandExt;
    command.process_group(0);
}

#[cfg(not(unix))]
pub(super) fn in_its_own_group(_: &mut Command) {}

/// Kills the mesher and what it has started; one that has `ended` is there no more.
pub(super) fn kill_group(child: &mut Child, ended: bool) {
    #[cfg(unix)]
    if let Some(group) = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw) {
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
    if !ended {
        let _ = child.kill();
    }
}

/// The limit that ended a run in words, if it was that of a file or of the output in `log`.
pub(super) fn exceeded(status: ExitStatus, log: &Path) -> Option<String> {
    let printed = std::fs::metadata(log).map_or(0, |log| log.len());
    if printed > LONGEST_LOG {
        return Some(format!("had printed {} MB and was stopped", printed >> 20));
    }
    (log::signal(status) == Some(log::FILE_SIZE)).then(|| "wrote a file without end".into())
}

/// Memory for one run: three quarters of all, where the system tells [bytes].
#[cfg(target_os = "linux")]
pub(super) fn memory() -> u64 {
    let system = rustix::system::sysinfo();
    (system.totalram as u64).saturating_mul(system.mem_unit.into()) / 4 * 3
}

#[cfg(not(target_os = "linux"))]
pub(super) fn memory() -> u64 {
    u64::MAX
}

/// The exit status, or nothing if `limit` passes first or somebody wants it to stop. Asks now and then: a signal handler would concern all threads.
pub(super) fn wait(
    child: &mut Child,
    limit: Duration,
    stop: &Stop,
    log: &Path,
) -> std::io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if stop.requested().is_some() {
            return Ok(None);
        }
        if std::fs::metadata(log).is_ok_and(|log| log.len() > LONGEST_LOG) {
            kill_group(child, false);
            return child.wait().map(Some);
        }
        let Some(left) = limit.checked_sub(start.elapsed()) else { return Ok(None) };
        std::thread::sleep(pause.min(left));
        pause = (2 * pause).min(LONGEST_PAUSE);
    }
}
