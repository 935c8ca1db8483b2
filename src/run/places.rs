//! Names of checkpoints, and their places in a history.

use serde::{Deserialize, Serialize};

/// Folder of the checkpoints in that of the results.
pub(super) const FOLDER: &str = "checkpoint";
/// Name of the last of them.
pub(super) const LATEST: &str = "checkpoint/latest";
/// Name of the checkpoint at the end of a step, counted from 1.
pub(super) fn of_step(step: usize) -> String {
    format!("{FOLDER}/step_{step:04}")
}

/// Place of a checkpoint in its history.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct CheckpointPlace {
    /// Number of its increment over all steps.
    pub(super) increment: usize,
    /// Number of the step under way, from 0, and true if none of it has been done.
    pub(super) step: usize,
    pub(super) between: bool,
}
