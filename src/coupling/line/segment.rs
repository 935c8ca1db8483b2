//! Segments of C, what they are cut from, and the pieces that they make.

/// Faces without a gap may lie this far apart, beyond what chords of one curve do. Of the shorter line.
pub(in crate::coupling) const FACING: f64 = 1e-3;

/// A part of C with its parents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Arc length of its start [length].
    pub start: f64,
    /// Arc length of its end [length].
    pub end: f64,
    /// Parent edge on chain A.
    pub edge_a: usize,
    /// Parent edge on chain B.
    pub edge_b: usize,
    /// ξ on A's edge at start and end; ±1 at its nodes, exactly.
    pub xi_a: [f64; 2],
    /// ξ on B's edge at start and end.
    pub xi_b: [f64; 2],
}

/// A place on a line: number of the edge in the line, ξ on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::coupling) struct LinePoint {
    pub i: usize,
    pub xi: f64,
}

/// A common part of two lines.
pub(in crate::coupling) struct CommonStretch {
    pub segments: Vec<Segment>,
    /// Place in the order along A.
    pub order: (usize, LinePoint),
    pub closed: bool,
    pub length: f64,
    /// Smallest and largest distance along n.
    pub gap: [f64; 2],
    /// Largest distance beyond what chords of one curve differ by.
    pub apart: f64,
    /// The worst place: by how much its distance exceeds what is allowed, the distance, and where.
    pub worst: (f64, f64, [f64; 2]),
    /// A place where one side turns away from the other.
    pub turned: Option<[f64; 2]>,
    /// True if the sides lie on each other somewhere.
    pub touches: bool,
}
