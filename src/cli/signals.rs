//! Signals that end a run: the first asks it to stop with what has converged, a second ends the program at once.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag;

use crate::error::Stop;

/// Passes SIGINT, SIGTERM and SIGHUP on to `stop`. One that is ignored, as by `nohup` or in the background of a script, stays
/// so.
pub(super) fn watch(stop: &Stop) {
    let ignored = ignored();
    let asked = Arc::new(AtomicBool::new(false));
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        if ignored >> (signal - 1) & 1 == 1 {
            continue;
        }
        // a signal that cannot be watched ends the program as it would without
        let _ = flag::register_conditional_shutdown(signal, 128 + signal, asked.clone());
        let _ = flag::register(signal, asked.clone());
        let _ = flag::register_usize(signal, stop.number(), signal as usize);
    }
}

/// The signals that are ignored, a bit each from the first on; none where the system does not tell.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
