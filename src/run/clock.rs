//! Where the time goes.

use std::time::Instant;

/// Seconds by stage, in the order the stages first began.
#[derive(Debug, Clone)]
pub struct Clock {
    start: Instant,
    since: Instant,
    current: &'static str,
    stages: Vec<(&'static str, f64)>,
}

impl Clock {
    /// Starts with a stage.
    pub fn new(stage: &'static str) -> Clock {
        let now = Instant::now();
        Clock { start: now, since: now, current: stage, stages: Vec::new() }
    }

    /// Ends the current stage and begins another.
    pub fn begin(&mut self, stage: &'static str) {
        let now = Instant::now();
        let seconds = (now - self.since).as_secs_f64();
        match self.stages.iter_mut().find(|(name, _)| *name == self.current) {
            Some((_, sum)) => *sum += seconds,
            None => self.stages.push((self.current, seconds)),
        }
        (self.since, self.current) = (now, stage);
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
