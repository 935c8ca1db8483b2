//! Time by stage of a run.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Seconds by stage, in the order the stages first began.
#[derive(Debug, Clone)]
pub struct Clock {
    start: Instant,
    since: Instant,
    current: StageNow,
    stages: Vec<(&'static str, f64)>,
}

/// The stage under way, for whoever shows it beside the run, and how far the increment has come.
#[derive(Debug, Clone)]
pub struct StageNow(Arc<Mutex<ClockStage>>);

#[derive(Debug, Clone, Copy)]
struct ClockStage {
    name: &'static str,
    part: PartNow,
}

/// Position within an increment.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PartNow {
    /// Load factor in the step.
    pub load_factor: f64,
    /// Parts of the increment so far.
    pub parts: usize,
    /// Iterations of the increment so far.
    pub iterations: usize,
}

impl StageNow {
    /// Its name.
    pub fn name(&self) -> &'static str {
        self.lock().name
    }

    /// Position within the increment.
    pub fn part(&self) -> PartNow {
        self.lock().part
    }

    fn lock(&self) -> MutexGuard<'_, ClockStage> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clock {
    /// Starts with a stage.
    pub fn new(stage: &'static str) -> Clock {
        let now = Instant::now();
        let stage = ClockStage { name: stage, part: PartNow::default() };
        let current = StageNow(Arc::new(Mutex::new(stage)));
        Clock { start: now, since: now, current, stages: Vec::new() }
    }

    /// Ends the current stage and begins another.
    pub fn begin(&mut self, stage: &'static str) {
        let now = Instant::now();
        let seconds = (now - self.since).as_secs_f64();
        let ended = self.current.name();
        match self.stages.iter_mut().find(|(name, _)| *name == ended) {
            Some((_, sum)) => *sum += seconds,
            None => self.stages.push((ended, seconds)),
        }
        self.since = now;
        *self.current.lock() = ClockStage { name: stage, part: PartNow::default() };
    }

    /// Tells the position within an increment.
    pub fn tell(&self, part: PartNow) {
        self.current.lock().part = part;
    }

    /// The stage under way.
    pub fn now(&self) -> &StageNow {
        &self.current
    }

    /// Seconds of the stages that have ended.
    pub fn stages(&self) -> &[(&'static str, f64)] {
        &self.stages
    }

    /// Seconds since the start.
    pub fn total(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }
}

/// Processor time of this process, all its threads together [s]; absent where the system does not tell. It does not count
/// the time spent waiting for others on the machine.
pub fn processor() -> Option<f64> {
    let mut nanoseconds = 0;
    for task in std::fs::read_dir("/proc/self/task").ok()?.flatten() {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        nanoseconds += text.split_whitespace().next()?.parse::<u64>().ok()?;
    }
    Some(nanoseconds as f64 * 1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_takes_processor_time() {
        let Some(before) = processor() else { return }; // only Linux tells
        let mut sum = 0.0;
        while processor().is_some_and(|now| now < before + 0.01) {
            sum += (0..1000).map(f64::from).sum::<f64>();
        }
        assert!(sum > 0.0);
    }
}
