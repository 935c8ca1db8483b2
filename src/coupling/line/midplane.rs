//! The mid-plane C of two sides and its segments (paper §3.1, fig. 2).
//!
//! C is cut at every node of either side; a segment has one parent edge on A and one on B, and a place η on it has a
//! place ξ_A, ξ_B on both. The point of C lies half-way between the two; the normal is that of both sides' mean
//! direction. Arc length s counts the segments of all pieces, one after the other, and is linear in η within each.

use super::Chain;
use super::Piece;
use super::angle::Angles;
use super::segment::Segment;
use crate::shape::GAUSS_3;
use crate::shape::vector::*;

/// The mid-plane of two sides.
#[derive(Debug, Clone)]
pub struct LineMidplane {
    /// Side A, its body on the right: n on the left points away from it.
    pub a: Chain,
    /// Side B, its body on the left, so that both run along the tangent.
    pub b: Chain,
    /// Origin of the coordinates in the chains.
    pub origin: [f64; 2],
    /// Length of C [length].
    pub length: f64,
    /// Smallest and largest distance from A to B along n; negative where they overlap [length].
    pub gap: [f64; 2],
    /// Largest distance of the sides, either way, beyond what chords of one curve differ by [length].
    pub apart: f64,
    /// Shares of A's and of B's length that are joined.
    pub joined: [f64; 2],
    /// The largest turn at a kink of either side [rad].
    pub kink: f64,
    /// The segments of C, piece after piece, in order within each.
    pub segments: Vec<Segment>,
    /// The smooth pieces of C.
    pub pieces: Vec<Piece>,
    pub(in crate::coupling) angles: [Angles; 2],
}

/// A place on C.
#[derive(Debug, Clone, Copy)]
pub struct MidplanePoint {
    /// ξ on A's edge.
    pub xi_a: f64,
    /// ξ on B's edge.
    pub xi_b: f64,
    /// Half-way between the two sides, in the plane.
    pub position: [f64; 2],
    /// R: rows n and t; n points from A to B.
    pub rotation: [[f64; 2]; 2],
    /// Distance from A to B along n [length].
    pub gap: f64,
    /// Length of C per η [length].
    pub speed: f64,
    /// Cosine of half the angle between the directions of both sides.
    pub facing: f64,
}

impl LineMidplane {
    /// The place η of a segment, −1 at its start and 1 at its end.
    pub fn spot(&self, segment: usize, eta: f64) -> MidplanePoint {
        let g = &self.segments[segment];
        let (xi_a, xi_b, along) = self.along(g, eta);
        let (x_a, x_b) = (self.a.point(g.edge_a, xi_a), self.b.point(g.edge_b, xi_b));
        let [a, b] = &self.angles;
        let both = plus(a.tangent(g.edge_a, xi_a), b.tangent(g.edge_b, xi_b));
        let tangent = unit(both);
        let normal = [-tangent[1], tangent[0]];
        MidplanePoint {
            xi_a,
            xi_b,
            position: [0, 1].map(|d| self.origin[d] + 0.5 * (x_a[d] + x_b[d])),
            rotation: [normal, tangent],
            gap: dot(minus(x_b, x_a), normal),
            speed: norm(along),
            facing: 0.5 * norm(both),
        }
    }

    /// ξ on both edges at a place of a segment, and dC/dη.
    fn along(&self, g: &Segment, eta: f64) -> (f64, f64, [f64; 2]) {
        let (xi_a, slope_a) = within(&self.a, g.edge_a, g.xi_a, eta);
        let (xi_b, slope_b) = within(&self.b, g.edge_b, g.xi_b, eta);
        let (d_a, d_b) = (self.a.derivative(g.edge_a, xi_a), self.b.derivative(g.edge_b, xi_b));
        (xi_a, xi_b, [0, 1].map(|d| 0.5 * (d_a[d] * slope_a + d_b[d] * slope_b)))
    }

    /// Length of a segment: ∫ |dC/dη| dη [length].
    pub(in crate::coupling) fn measure(&self, segment: usize) -> f64 {
        let g = &self.segments[segment];
        let speed = |eta: f64| norm(self.along(g, eta).2);
        if self.a.is_straight(g.edge_a) && self.b.is_straight(g.edge_b) {
            return 2.0 * speed(0.0); // two straight edges: constant
        }
        GAUSS_3.iter().map(|&[eta, weight]| weight * speed(eta)).sum()
    }

    /// The segment of a piece that holds arc length `s`, and the place η on it.
    pub fn locate(&self, piece: &Piece, s: f64) -> (usize, f64) {
        let segments = &self.segments[piece.segments.clone()];
        let i = segments.partition_point(|g| g.start <= s).max(1) - 1;
        let g = &segments[i];
        (piece.segments.start + i, 2.0 * (s - g.start) / (g.end - g.start) - 1.0)
    }

    /// The point of C at arc length `s`; where pieces meet, that of the piece that holds `inside`.
    pub fn position(&self, s: f64, inside: f64) -> [f64; 2] {
        let holds = |piece: &&Piece| self.segments[piece.segments.end - 1].end >= inside;
        let piece = self.pieces.iter().find(holds).unwrap_or(&self.pieces[self.pieces.len() - 1]);
        let (segment, eta) = self.locate(piece, s);
        self.spot(segment, eta).position
    }

    /// Arc lengths of start and end of a piece.
    pub(in crate::coupling) fn span(&self, piece: &Piece) -> [f64; 2] {
        [self.segments[piece.segments.start].start, self.segments[piece.segments.end - 1].end]
    }
}

/// ξ between `range` at η, and dξ/dη: the place that divides the chord like η, so that a mid-node off the middle of a
/// straight edge does no harm.
fn within(chain: &Chain, e: usize, range: [f64; 2], eta: f64) -> (f64, f64) {
    let [low, high] = range;
    let linear = 0.5 * ((1.0 - eta) * low + (1.0 + eta) * high);
    if chain.is_straight(e) {
        return (linear, 0.5 * (high - low));
    }
    let [p, q] = chain.ends[e].map(|place| chain.points[place]);
    let m = chain.point(e, 0.0);
    // x = m + slope ξ + bend ξ²
    let slope = [0, 1].map(|d| 0.5 * (q[d] - p[d]));
    let bend = [0, 1].map(|d| 0.5 * ((p[d] - m[d]) + (q[d] - m[d])));
    let chord = [0, 1].map(|d| slope[d] + bend[d] * (low + high)); // times (high − low)
    let (b, a) = (dot(slope, chord), dot(bend, chord));
    let at = |xi: f64| xi * (b + a * xi);
    let c = -0.5 * ((1.0 - eta) * at(low) + (1.0 + eta) * at(high));
    let xi = -2.0 * c / (b + (b * b - 4.0 * a * c).max(0.0).sqrt());
    (xi, 0.5 * (at(high) - at(low)) / (b + 2.0 * a * xi))
}
