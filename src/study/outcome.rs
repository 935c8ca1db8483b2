//! Outcome of a point, as it is kept on disk.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// Status of a point that has reached the limit that is sought.
pub(super) const LIMIT: &str = "limit";

/// A point that was run.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PointOutcome {
    /// Its number, from 0.
    pub point: usize,
    /// Digest of all that decides it: an outcome with another is run again.
    pub key: String,
    /// Its settings on top of the scene.
    pub settings: Vec<String>,
    /// "done", "limit" (no equilibrium beyond the load factor that is measured), "stopped" (no equilibrium), or "refused".
    pub status: String,
    /// Why it is not done.
    pub message: String,
    /// Measures by name; absent ones are null.
    pub values: IndexMap<String, Option<f64>>,
    /// Sizes and counts.
    pub counts: IndexMap<String, f64>,
    /// Method by which the equations were solved.
    pub strategy: String,
    /// Seconds of every repeat: of the whole process where it has one of its own.
    pub seconds: Vec<f64>,
    /// Processor time of every repeat that had a process of its own, the mesher not counted [s].
    pub processor: Vec<f64>,
    /// Seconds by stage of every repeat.
    pub stages: Vec<IndexMap<String, f64>>,
    /// Most memory of a process of its own [bytes].
    pub peak_memory: Option<u64>,
    /// Data of others that the first repeat used.
    pub reused: Vec<String>,
}

impl PointOutcome {
    /// The same, without what was left out because it could not be taken.
    pub fn value(&self, measure: &str) -> f64 {
        self.values.get(measure).copied().flatten().unwrap_or(f64::NAN)
    }

    /// True if it went to its end, or to the limit that is sought.
    pub fn done(&self) -> bool {
        self.status == "done" || self.status == LIMIT
    }

    /// Fastest, median and (slowest − fastest)/median of the repeats [s].
    pub fn times(&self) -> [f64; 3] {
        let (first, last) =
            self.seconds.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &s| (a.min(s), b.max(s)));
        let middle = median(self.seconds.iter().copied());
        [first, middle, (last - first) / middle]
    }

    /// Median processor time [s].
    pub fn processor_time(&self) -> f64 {
        median(self.processor.iter().copied())
    }

    /// Median seconds of a stage.
    pub fn stage(&self, name: &str) -> f64 {
        median(self.stages.iter().map(|stages| stages.get(name).copied().unwrap_or(0.0)))
    }
}

/// The median; not a number where there is none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n => 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_spread_of_the_repeats() {
        let empty = IndexMap::new();
        let outcome = PointOutcome {
            point: 0,
            key: String::new(),
            settings: Vec::new(),
            status: "done".into(),
            message: String::new(),
            values: IndexMap::new(),
            counts: empty,
            strategy: String::new(),
            seconds: vec![4.0, 2.0, 3.0, 5.0],
            processor: vec![1.0, 3.0],
            stages: vec![IndexMap::from([("solve".to_string(), 1.0)]), IndexMap::new()],
            peak_memory: None,
            reused: Vec::new(),
        };
        assert_eq!(outcome.times(), [2.0, 3.5, 3.0 / 3.5]);
        assert_eq!((outcome.stage("solve"), outcome.processor_time()), (0.5, 2.0));
    }
}
