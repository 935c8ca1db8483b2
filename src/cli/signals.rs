//! Signals that end a run: the first asks it to stop with what has converged, one that comes later ends the program at once.

use std::time::{Duration, Instant};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::exit;

use crate::error::Stop;

/// Signals so near to the first say the same: `timeout` sends two, the kernel one per thread of a parent that dies.
const ONE_WISH: Duration = Duration::from_millis(500);

/// Passes SIGINT, SIGTERM and SIGHUP on to `stop`. One that is ignored, as by `nohup` or in the background of a script, stays
/// so.
pub(super) fn watch(stop: &Stop) {
    let ignored = ignored();
    let watched = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // signals that cannot be watched end the program as they would without
    let Ok(mut signals) = Signals::new(watched) else { return };
    let stop = stop.clone();
    std::thread::spawn(move || {
        let mut first: Option<Instant> = None;
        for signal in signals.forever() {
            match first {
                None => {
                    stop.request(u8::try_from(signal).unwrap_or(u8::MAX));
                    first = Some(Instant::now());
                }
                Some(first) if first.elapsed() > ONE_WISH => exit(128 + signal),
                Some(_) => {}
            }
        }
    });
}

/// The signals that are ignored, a bit each from the first on; none where the system does not tell.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
