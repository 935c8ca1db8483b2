//! Memory: how much a run takes, how much there is, and the refusal of what does not fit.

use crate::error::Error;

/// More dofs than the factor's indices can hold.
pub(super) fn too_large(dofs: usize) -> Error {
    Error::Program {
        program: "midplane".into(),
        what: format!("the factor of {dofs} dofs has more than 2147483647 entries"),
        cure: "use coarser meshes".into(),
    }
}
