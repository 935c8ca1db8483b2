//! What became of a point, as it is kept on disk.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// A point that was run.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Outcome {
    /// Its number, from 0.
    pub point: usize,
    /// Digest of all that decides it: an outcome with another is run again.
    pub key: String,
    /// Its settings on top of the scene.
    pub settings: Vec<String>,
    /// "done", "stopped" (no equilibrium), or "refused".
    pub status: String,
    /// Why it is not done.
    pub message: String,
    /// Measures by name; absent ones are null.
    pub values: IndexMap<String, Option<f64>>,
    /// Sizes and counts.
    pub counts: IndexMap<String, f64>,
    /// How the equations were solved.
    pub strategy: String,
    /// Seconds of every repeat: of the whole process where it has one of its own.
    pub seconds: Vec<f64>,
    /// Seconds by stage of every repeat.
    pub stages: Vec<IndexMap<String, f64>>,
    /// Most memory of a process of its own [bytes].
    pub peak_memory: Option<u64>,
    /// What the first repeat found that others had left.
    pub reused: Vec<String>,
}

impl Outcome {
    /// The same, without what was left out because it could not be taken.
    pub fn value(&self, measure: &str) -> f64 {
        self.values.get(measure).copied().flatten().unwrap_or(f64::NAN)
    }

    /// True if it went to its end.
    pub fn done(&self) -> bool {
        self.status == "done"
    }

    /// Fastest, median and (slowest − fastest)/median of the repeats [s].
    pub fn times(&self) -> [f64; 3] {
        let mut sorted = self.seconds.clone();
        sorted.sort_by(f64::total_cmp);
        let (Some(&first), Some(&last)) = (sorted.first(), sorted.last()) else { return [f64::NAN; 3] };
        let n = sorted.len();
        let median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
        [first, median, (last - first) / median]
    }

    /// Median seconds of a stage.
    pub fn stage(&self, name: &str) -> f64 {
        let mut of: Vec<f64> =
            self.stages.iter().map(|stages| stages.get(name).copied().unwrap_or(0.0)).collect();
        of.sort_by(f64::total_cmp);
        match of.len() {
            0 => f64::NAN,
            n => 0.5 * (of[(n - 1) / 2] + of[n / 2]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_spread_of_the_repeats() {
        let empty = IndexMap::new();
        let outcome = Outcome {
            point: 0,
            key: String::new(),
            settings: Vec::new(),
            status: "done".into(),
            message: String::new(),
            values: IndexMap::new(),
            counts: empty,
            strategy: String::new(),
            seconds: vec![4.0, 2.0, 3.0, 5.0],
            stages: vec![IndexMap::from([("solve".to_string(), 1.0)]), IndexMap::new()],
            peak_memory: None,
            reused: Vec::new(),
        };
        assert_eq!(outcome.times(), [2.0, 3.5, 3.0 / 3.5]);
        assert_eq!(outcome.stage("solve"), 0.5);
    }
}
