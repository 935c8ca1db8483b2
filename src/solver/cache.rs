//! Bodies that several runs of one process share: a study of k by k densities condenses 2k bodies, not 2k².

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sha2::{Digest, Sha256};

use super::{CondensedSubdomain, NotPositiveDefinite, Substructure, TooLarge};
use crate::assembly::Body;

/// All that decides a body and its border, as a digest.
type SubdomainDigest = [u8; 32];

/// Bodies by what decides them: points, cells, material, thickness, nodes on joints.
#[derive(Debug)]
pub struct SubdomainCache {
    bodies: Mutex<HashMap<SubdomainDigest, Arc<Substructure>>>,
    /// Memory that may still be filled [bytes].
    room: AtomicUsize,
}

impl SubdomainCache {
    /// A shelf that keeps about this many bytes of condensations, the first that come.
    pub fn new(room: usize) -> SubdomainCache {
        SubdomainCache { bodies: Mutex::default(), room: AtomicUsize::new(room) }
    }

    /// The body, made unless it is there; true if it was.
    pub(super) fn body(
        &self,
        components: usize,
        body: &Body,
        thickness: f64,
        joined: &[bool],
    ) -> Result<(Arc<Substructure>, bool), TooLarge> {
        let key = key(body, thickness, joined);
        if let Some(known) = self.bodies().get(&key) {
            return Ok((known.clone(), true));
        }
        let new = Arc::new(Substructure::new(components, body, thickness, joined)?);
        self.bodies().insert(key, new.clone());
        Ok((new, false))
    }

    fn bodies(&self) -> MutexGuard<'_, HashMap<SubdomainDigest, Arc<Substructure>>> {
        self.bodies.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The body's condensation, made unless it was kept; true if it was.
    pub(super) fn condensed(
        &self,
        body: &Substructure,
        held: Vec<bool>,
    ) -> Result<(Arc<CondensedSubdomain>, bool), NotPositiveDefinite> {
        if let Some(kept) = body.kept(&held) {
            return Ok((kept, true));
        }
        let condensed = Arc::new(body.condense(held)?);
        let bytes = body.bytes();
        let take = |room: usize| room.checked_sub(bytes);
        if self.room.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_ok() {
            body.keep(&condensed);
        }
        Ok((condensed, false))
    }
}

fn key(body: &Body, thickness: f64, joined: &[bool]) -> SubdomainDigest {
    let mut hash = Sha256::new();
    let mut numbers = |part: &mut dyn Iterator<Item = u64>| {
        let bytes: Vec<u8> = part.flat_map(u64::to_le_bytes).collect();
        hash.update((bytes.len() as u64).to_le_bytes()); // so that parts cannot run into each other
        hash.update(bytes);
    };
    let (mesh, e) = (&body.mesh, &body.elasticity);
    let material = [e.c11, e.c12, e.c33, thickness];
    numbers(&mut material.into_iter().map(f64::to_bits));
    numbers(&mut mesh.points.as_flattened().iter().map(|x| x.to_bits()));
    numbers(&mut mesh.cells.shapes.iter().map(|&shape| shape as u64));
    numbers(&mut mesh.cells.nodes.iter().map(|&node| node as u64));
    numbers(&mut joined.iter().map(|&joined| u64::from(joined)));
    hash.finalize().into()
}
