//! A request to stop, by a signal of the system or by whoever runs the program as a library.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A request to stop that all parts of a run share; none at first.
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicUsize>);

impl Stop {
    /// Asks everybody who shares it to stop, for the signal of this number.
    pub fn request(&self, signal: u8) {
        self.0.store(signal.into(), Ordering::Relaxed);
    }

    /// The signal that asked to stop, if one did.
    pub fn requested(&self) -> Option<u8> {
        match self.0.load(Ordering::Relaxed) {
            0 => None,
            signal => u8::try_from(signal).ok(),
        }
    }
}
