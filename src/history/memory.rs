//! Memory: how much the run has taken, how much there is, and the refusal of what does not fit.

use crate::error::{Error, Result};

/// Vectors, stresses and the fields being written, per dof [bytes], as measured.
const PER_DOF: u64 = 320;

/// Peak memory of this process so far [bytes]; absent where the system does not tell.
pub fn peak() -> Option<u64> {
    kilobytes("/proc/self/status", "VmHWM:")
}

/// Memory that can be had without swapping [bytes]; absent where the system does not tell.
pub fn available() -> Option<u64> {
    kilobytes("/proc/meminfo", "MemAvailable:")
}

/// A line such as "MemAvailable:   16000 kB" of a file of the kernel, in bytes.
fn kilobytes(file: &str, key: &str) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024 * kilobytes)
}

/// Memory that a run still needs once its matrix is analysed [bytes]: the factor with what it takes to make it, the
/// entries of the matrix that is factored, and what grows with the dofs.
pub(super) fn needed(factor: usize, matrix: usize, dofs: usize) -> u64 {
    (factor + size_of::<f64>() * matrix) as u64 + PER_DOF * dofs as u64
}

/// Refuses a run that needs more than there is.
pub(super) fn check_fits(dofs: usize, entries: usize, needed: u64, available: Option<u64>) -> Result<()> {
    match available {
        Some(available) if needed > available => Err(Error::Program {
            program: "midplane".into(),
            what: format!(
                "{dofs} dofs need another {} of memory, their factor has {:.1} million entries; {} are available",
                gigabytes(needed),
                entries as f64 * 1e-6,
                gigabytes(available)
            ),
            help: "use coarser meshes or a machine with more memory".into(),
        }),
        _ => Ok(()),
    }
}

/// More entries than the factor's indices can count.
pub(super) fn too_large(dofs: usize) -> Error {
    Error::Program {
        program: "midplane".into(),
        what: format!("the factor of {dofs} dofs has more than 2147483647 entries"),
        help: "use coarser meshes".into(),
    }
}

/// Bytes as people read them.
pub fn gigabytes(bytes: u64) -> String {
    let bytes = bytes as f64;
    if bytes < 1e9 {
        return format!("{:.1} MB", bytes * 1e-6);
    }
    format!("{:.2} GB", bytes * 1e-9)
}
