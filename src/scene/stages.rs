//! Parts that come and go: which subdomains are there in every step.

use super::Scene;
use super::named::matching;
use crate::error::Result;

/// Changes of a step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepStage {
    /// True for every subdomain that is there in the step.
    pub present: Vec<bool>,
    /// Subdomains that come in it.
    pub activated: Vec<usize>,
    /// Subdomains that go in it.
    pub removed: Vec<usize>,
    /// Share of their forces on their neighbours that is still held at the start and at the end of the step, for those that
    /// have gone and are not wholly let go before.
    pub left: Vec<LeftShare>,
}

/// Share of the forces of a part that has gone that is still held in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftShare {
    /// Number of the subdomain.
    pub subdomain: usize,
    /// Share at the start of the step.
    pub from: f64,
    /// Share at its end.
    pub to: f64,
}

impl Scene {
    /// The stages of all steps; empty if all parts are always there.
    pub fn stages(&self) -> Result<Vec<StepStage>> {
        let count = self.subdomains.len();
        if self.steps.iter().all(|step| step.activate.is_empty() && step.deactivate.is_empty()) {
            return Ok(Vec::new());
        }
        let mut present = self.there_at_first()?;
        let mut left = vec![0.0; count];
        let mut stages = Vec::new();
        for (number, step) in self.steps.iter().enumerate() {
            let index = number.to_string();
            let name = |b: usize| self.subdomains.get_index(b).map_or("", |(name, _)| name.as_str());
            let mut stage = StepStage::default();
            let before = left.clone();
            for (k, pattern) in step.activate.iter().enumerate() {
                let path = ["steps", &index, "activate", &k.to_string()];
                for b in matching(self, &path, pattern)? {
                    let refused = if present[b] {
                        Some(("is there already", "activate what is not there"))
                    } else if left[b] > 0.0 {
                        Some(("is not wholly let go", "deactivate it to 1.0 first"))
                    } else {
                        None
                    };
                    if let Some((what, help)) = refused {
                        return Err(self.source.error_at(&path, format!("\"{}\" {what}", name(b)), help));
                    }
                    present[b] = true;
                    stage.activated.push(b);
                }
            }
            for (pattern, &share) in &step.deactivate {
                let path = ["steps", &index, "deactivate", pattern];
                let error_at = |what: String, help: &str| Err(self.source.error_at(&path, what, help));
                if !(share > 0.0 && share <= 1.0) {
                    return error_at(format!("{share} is no share"), "it lies above 0 and not above 1");
                }
                for b in matching(self, &path, pattern)? {
                    if stage.activated.contains(&b) {
                        return error_at(
                            format!("\"{}\" comes in this step", name(b)),
                            "give it one duty in a step",
                        );
                    }
                    if present[b] {
                        stage.removed.push(b);
                        (present[b], left[b]) = (false, 1.0);
                    } else if 1.0 - share >= left[b] {
                        let what = format!(
                            "\"{}\" is not there, and {} of its forces are let go",
                            name(b),
                            1.0 - left[b]
                        );
                        return error_at(what, "give a larger share to let go more");
                    }
                    let from = if stage.removed.contains(&b) { 1.0 } else { before[b] };
                    stage.left.push(LeftShare { subdomain: b, from, to: 1.0 - share });
                    left[b] = 1.0 - share;
                }
            }
            // what was held in part goes on being held
            for b in (0..count).filter(|&b| left[b] > 0.0) {
                if !stage.left.iter().any(|share| share.subdomain == b) {
                    stage.left.push(LeftShare { subdomain: b, from: left[b], to: left[b] });
                }
            }
            stage.present = present.clone();
            stages.push(stage);
        }
        Ok(stages)
    }

    /// Subdomains that are there together, at one time or another.
    pub fn times(&self) -> Result<Vec<Vec<bool>>> {
        let mut times = vec![self.there_at_first()?];
        for stage in self.stages()? {
            if !times.contains(&stage.present) {
                times.push(stage.present);
            }
        }
        Ok(times)
    }

    /// Subdomains that are there before the first step: all but those that are first mentioned by `activate`.
    pub fn there_at_first(&self) -> Result<Vec<bool>> {
        let mut mentioned = vec![None; self.subdomains.len()];
        for (number, step) in self.steps.iter().enumerate() {
            let index = number.to_string();
            let come = step.activate.iter().map(|pattern| ("activate", pattern));
            for (key, pattern) in come.chain(step.deactivate.keys().map(|pattern| ("deactivate", pattern))) {
                for b in matching(self, &["steps", &index, key], pattern)? {
                    mentioned[b].get_or_insert(key);
                }
            }
        }
        Ok(mentioned.into_iter().map(|key| key != Some("activate")).collect())
    }
}
