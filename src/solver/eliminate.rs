//! The elimination of all interiors; bodies that are alike and held alike are condensed once.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError};

use faer::Mat;
use rayon::prelude::*;

use super::equal::Rotation;
use super::{Condensation, Continuum, NotPositiveDefinite};

impl Continuum {
    /// True if two sets of supports differ on interfaces only, so that one condensation serves both.
    pub fn serves(&self, condensation: &Condensation, constrained: &[bool]) -> bool {
        let inside = self.places.iter().zip(condensation.constrained.iter().zip(constrained));
        inside.filter(|(place, _)| place.is_none()).all(|(_, (a, b))| a == b)
    }

    /// Eliminates the interiors under the supports that are not on interfaces.
    pub fn condense(&self, constrained: &[bool]) -> Result<Condensation, NotPositiveDefinite> {
        let constrained: Vec<bool> = constrained
            .iter()
            .zip(&self.places)
            .map(|(&constrained, place)| constrained && place.is_none())
            .collect();
        // bodies that are alike and held alike are condensed once
        let mut jobs: Vec<(usize, Vec<bool>)> = Vec::new();
        let mut known: HashMap<(usize, &[bool]), usize> = HashMap::new();
        let mut job_of = Vec::new();
        for (b, dofs) in self.dofs.iter().enumerate() {
            let held = &constrained[dofs.clone()];
            job_of.push(*known.entry((self.likes[b].first, held)).or_insert_with(|| {
                jobs.push((b, held.to_vec()));
                jobs.len() - 1
            }));
        }
        let condense = |(b, held): (usize, Vec<bool>)| {
            let subdomain = &self.subdomains[b];
            match &self.cache {
                Some(cache) => cache.condensed(subdomain, held),
                None => subdomain.condense(held).map(|new| (Arc::new(new), false)),
            }
        };
        let made: Vec<_> = jobs.into_par_iter().map(condense).collect();
        let made = made.into_iter().collect::<Result<Vec<_>, NotPositiveDefinite>>()?;
        let (mut subdomains, mut schurs) = (Vec::new(), Vec::new());
        let mut turned: HashMap<_, Arc<Mat<f64>>> = HashMap::new();
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        for (b, &job) in job_of.iter().enumerate() {
            let (condensed, there) = &made[job];
            found.factors.extend(there.then_some(b));
            let rotation = self.likes[b].rotation.as_ref();
            let schur = turned.entry((job, rotation.map(Rotation::bits))).or_insert_with(|| match rotation {
                Some(rotation) => Arc::new(rotation.turned(&condensed.schur)),
                None => condensed.schur.clone(),
            });
            schurs.push(schur.clone());
            subdomains.push(condensed.clone());
        }
        drop(found);
        Ok(Condensation { constrained, subdomains, schurs })
    }
}
