//! Bodies that several runs of one process share: a study of k by k meshes condenses 2k bodies, not 2k².

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sha2::{Digest, Sha256};

use super::{CondensedSubdomain, NotPositiveDefinite, Substructure, TooLarge};
use crate::assembly::BoundSubdomain;

/// All that decides a body and its separator, as a digest.
type SubdomainDigest = [u8; 32];

/// Bodies by what decides them: points, cells, material, thickness, nodes on interfaces.
#[derive(Debug)]
pub struct SubdomainCache {
    subdomains: Mutex<HashMap<SubdomainDigest, Arc<Substructure>>>,
    /// Memory that may still be filled [bytes].
    room: AtomicUsize,
}

impl SubdomainCache {
    /// A cache that keeps about this many bytes of bodies and condensations, the first that come.
    pub fn new(room: usize) -> SubdomainCache {
        SubdomainCache { subdomains: Mutex::default(), room: AtomicUsize::new(room) }
    }

    /// The body, made unless it is there; true if it was.
    pub(super) fn subdomain(
        &self,
        components: usize,
        subdomain: &BoundSubdomain,
        thickness: f64,
        joined: &[bool],
    ) -> Result<(Arc<Substructure>, bool), TooLarge> {
        let key = key(subdomain, thickness, joined);
        if let Some(known) = self.subdomains().get(&key) {
            return Ok((known.clone(), true));
        }
        let new = Arc::new(Substructure::new(components, subdomain, thickness, joined)?);
        // its stiffness has no more entries than its condensation
        if self.take_room(new.bytes()) {
            self.subdomains().insert(key, new.clone());
        }
        Ok((new, false))
    }

    /// True if so many bytes may be kept.
    fn take_room(&self, bytes: usize) -> bool {
        let take = |room: usize| room.checked_sub(bytes);
        self.room.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_ok()
    }

    fn subdomains(&self) -> MutexGuard<'_, HashMap<SubdomainDigest, Arc<Substructure>>> {
        self.subdomains.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The body's condensation, made unless it was kept; true if it was.
    pub(super) fn condensed(
        &self,
        subdomain: &Substructure,
        constrained: Vec<bool>,
    ) -> Result<(Arc<CondensedSubdomain>, bool), NotPositiveDefinite> {
        if let Some(kept) = subdomain.kept(&constrained) {
            return Ok((kept, true));
        }
        let condensed = Arc::new(subdomain.condense(constrained)?);
        if self.take_room(subdomain.bytes()) {
            subdomain.keep(&condensed);
        }
        Ok((condensed, false))
    }
}

fn key(subdomain: &BoundSubdomain, thickness: f64, joined: &[bool]) -> SubdomainDigest {
    let mut hash = Sha256::new();
    let mut numbers = |part: &mut dyn Iterator<Item = u64>| {
        let bytes: Vec<u8> = part.flat_map(u64::to_le_bytes).collect();
        hash.update((bytes.len() as u64).to_le_bytes()); // so that parts cannot run into each other
        hash.update(bytes);
    };
    let (mesh, e) = (&subdomain.mesh, &subdomain.elasticity);
    let material = [e.c11, e.c12, e.c33, thickness];
    numbers(&mut material.into_iter().map(f64::to_bits));
    numbers(&mut mesh.points.as_flattened().iter().map(|x| x.to_bits()));
    numbers(&mut mesh.cells.shapes.iter().map(|&shape| shape as u64));
    numbers(&mut mesh.cells.nodes.iter().map(|&node| node as u64));
    numbers(&mut joined.iter().map(|&joined| u64::from(joined)));
    hash.finalize().into()
}
