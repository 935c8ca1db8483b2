//! Results on disk: fields as VTU and PVD, history.csv, summary.json. Never feeds back.
//!
//! Every file is complete or absent at every moment: it is written aside and renamed. The manifest lists them all.

mod fields;
mod files;
mod geometry;
mod growing;
mod manifest;
mod pvd;
mod vtu;
mod writer;

pub use files::{csv_field, write_json};
pub use geometry::write_geometry;
pub use manifest::{Listing, MANIFEST, check_free};
pub use writer::{HistoryRow, TextLengths, Writer, collection, files_once};

use serde::{Deserialize, Serialize};

use crate::continuum::Stresses;
use crate::law::{self, Local};
use crate::problem::WaterFields;

/// One state of the model, as it is written.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Snapshot {
    /// Displacement of every dof [length].
    pub u: Vec<f64>,
    /// Stresses of every body; a checkpoint leaves them out, since displacements decide them.
    #[serde(skip)]
    pub stresses: Vec<Stresses>,
    /// Jump (n, t, s) at the law points of every interface [length].
    pub jumps: Vec<Vec<Local>>,
    /// Traction (n, t, s) at the law points of every interface [stress].
    pub tractions: Vec<Vec<Local>>,
    /// State of the law points of every interface; empty for an elastic one.
    pub states: Vec<Vec<law::State>>,
    /// Parts that are there.
    pub presence: Presence,
    /// Water in the interfaces.
    pub water: WaterFields,
}

/// Data of a row beside its fields: field data of every file.
#[derive(Debug, Clone, Copy, Default)]
pub struct RowData {
    /// Number of the row over all steps, 0 for the unloaded state: the time of its files.
    pub row: usize,
    /// Number of the step, from 1; 0 before the first.
    pub step: usize,
    /// Load factor in it.
    pub load_factor: f64,
    /// Elastic energy, dissipated energy, energy released by snaps and external work so far [force × length].
    pub energies: [f64; 4],
}

/// Parts that are there, where some come and go; empty where all are there, always.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Presence {
    /// True for a subdomain that is there.
    pub parts: Vec<bool>,
    /// True for an interface of which a part is not there.
    pub absent: Vec<bool>,
    /// Jumps from which those of the law points of an interface count: those at which its part came; empty for none [length].
    pub origins: Vec<Vec<Local>>,
}

impl Presence {
    /// True for an interface of which a part is not there.
    #[inline]
    pub fn is_absent(&self, interface: usize) -> bool {
        self.absent.get(interface).is_some_and(|absent| *absent)
    }

    /// A jump as the law counts it.
    #[inline]
    pub fn counted(&self, interface: usize, point: usize, jump: Local) -> Local {
        match self.origins.get(interface).and_then(|origins| origins.get(point)) {
            Some(origin) => jump - origin,
            None => jump,
        }
    }
}
