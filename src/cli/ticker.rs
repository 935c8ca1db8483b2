//! A line now and then while an increment takes long, for those who read a log in place of a bar.

use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::time::Duration;

use super::printer::Printer;
use crate::history::{PartNow, StageNow};

/// Time without a line after which one tells what is under way.
const SILENCE: Duration = Duration::from_secs(20);

/// Tells what is under way after a time without lines, until it is dropped.
pub(super) struct Ticker(Sender<()>);

impl Ticker {
    /// Starts for a run whose stage this is.
    pub(super) fn start(stage: StageNow, printer: Printer) -> Ticker {
        Ticker::every(SILENCE, move || printer.out(&under_way(stage.name(), stage.part())))
    }

    fn every(silence: Duration, tell: impl Fn() + Send + 'static) -> Ticker {
        let (send, received) = mpsc::channel();
        std::thread::spawn(move || {
            loop {
                match received.recv_timeout(silence) {
                    Ok(()) => {}
                    Err(RecvTimeoutError::Timeout) => tell(),
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
        });
        Ticker(send)
    }

    /// Something else has been told.
    pub(super) fn told(&self) {
        // its thread lives as long as it does
        let _ = self.0.send(());
    }
}

/// A stage, and how far its increment has come.
pub(super) fn under_way(stage: &str, PartNow { load_factor, parts, iterations }: PartNow) -> String {
    match parts + iterations {
        0 => format!("{:<8} {stage}", "..."),
        _ => format!("{:<8} {stage} at {load_factor:.6}, {parts} parts, {iterations} iterations", "..."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_in_silence_only() {
        let (send, lines) = mpsc::channel();
        let ticker = Ticker::every(Duration::from_millis(200), move || send.send(()).unwrap());
        for _ in 0..20 {
            std::thread::sleep(Duration::from_millis(20));
            ticker.told();
        }
        assert!(lines.try_recv().is_err(), "told all the time, and a line all the same");
        assert!(lines.recv_timeout(Duration::from_secs(10)).is_ok());
        drop(ticker);
        let part = PartNow { load_factor: 0.25, parts: 3, iterations: 40 };
        assert_eq!(under_way("solve", part), "...      solve at 0.250000, 3 parts, 40 iterations");
        assert_eq!(under_way("factor", PartNow::default()), "...      factor");
    }
}
