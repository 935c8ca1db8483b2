//! Patterns of subdomains in the keys of a step: each stands for the names that fit it. A name counts before a pattern.

use indexmap::IndexMap;

use super::named::{is_pattern, matching};
use super::{Gravity, Scene};
use crate::error::Result;

impl Scene {
    /// Puts the names of subdomains in place of the patterns of `body_force`, `gravity`, `temperature` and `strain`.
    pub(super) fn name_parts(&mut self) -> Result<()> {
        for number in 0..self.steps.len() {
            let index = number.to_string();
            let step = &self.steps[number];
            let body_force = self.named_parts(&index, "body_force", &step.body_force)?;
            let temperature = self.named_parts(&index, "temperature", &step.temperature)?;
            let strain = self.named_parts(&index, "strain", &step.strain)?;
            let gravity = match &step.gravity {
                Some(Gravity::Parts(parts)) => {
                    Some(Gravity::Parts(self.named_parts(&index, "gravity", parts)?))
                }
                other => other.clone(),
            };
            let step = &mut self.steps[number];
            (step.body_force, step.temperature, step.strain, step.gravity) =
                (body_force, temperature, strain, gravity);
        }
        Ok(())
    }

    fn named_parts<T: Clone>(
        &self,
        index: &str,
        key: &str,
        stated: &IndexMap<String, T>,
    ) -> Result<IndexMap<String, T>> {
        let mut named: IndexMap<String, T> = IndexMap::new();
        let mut by: IndexMap<String, &str> = IndexMap::new();
        for (pattern, value) in stated {
            if !is_pattern(pattern) {
                named.insert(pattern.clone(), value.clone());
                continue;
            }
            let path = ["steps", index, key, pattern.as_str()];
            for b in matching(self, &path, pattern)? {
                let Some((name, _)) = self.subdomains.get_index(b) else { continue };
                if stated.contains_key(name) {
                    continue;
                }
                if let Some(other) = by.insert(name.clone(), pattern) {
                    let what = format!("\"{other}\" and \"{pattern}\" both fit {name}");
                    return Err(self.source.error_at(
                        &path,
                        what,
                        "keep one of them, or give the name itself",
                    ));
                }
                named.insert(name.clone(), value.clone());
            }
        }
        Ok(named)
    }
}
