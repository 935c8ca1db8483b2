//! Modes of the law, and the steepest flow of faces that slide.

/// Modes of a point in a step; the number is the status.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// Elastic.
    Elastic = 0,
    /// T: cracking under tension.
    Tension = 1,
    /// C: cracking under compression.
    Compression = 2,
    /// Z: opening and sliding with σ held at 0.
    Sliding = 3,
    /// A: free of stress.
    Open = 4,
}

/// Faces ride on each other up to this many times their slip while open, and dilate at most so much per slip.
pub(super) const RIDING_SLOPE: f64 = 2.0;
