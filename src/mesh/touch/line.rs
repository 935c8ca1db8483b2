//! Boundary edges as straight lines, and what two of them share.

use std::collections::HashMap;

use rstar::AABB;

use crate::error::Result;
use crate::mesh::{Facet, Mesh};
use crate::shape::vector::{dot, in_plane, minus};

/// Touching edges may be this far apart, and more where the boundary turns. Of their length.
const NEAR: f64 = 1e-3;
/// Distance that a turn by one radian adds: two chords of a circle are up to 1/8 of their turn and length apart.
const BEND: f64 = 0.25;
/// A turn above this is a corner, not a bend [rad].
const CORNER: f64 = 0.9;
/// Touching edges run against each other: the cosine between them is below this.
const AGAINST: f64 = -0.5;
/// A shared length below this is a point. Of the shorter edge.
const POINT: f64 = 1e-10;

/// Nodes of both bodies closer than this end at one place. Of the shorter edge.
pub(super) const TOGETHER: f64 = 1e-6;

/// A boundary edge as a straight line.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoundaryLine {
    pub(super) subdomain: usize,
    pub(super) edge: Facet,
    pub(super) ends: [[f64; 2]; 2],
    pub(super) tangent: [f64; 2],
    pub(super) length: f64,
    /// Largest distance of another body that still touches.
    pub(super) reach: f64,
}

/// The length that two lines share, and where it starts and ends along the first.
pub(super) struct SharedLength {
    pub(super) lines: [usize; 2],
    pub(super) part: Stretch,
}

/// The part of a line that another line shares.
pub(super) struct Stretch {
    /// Nodes that end it.
    pub(super) ends: EndNodes,
    /// Its corner with the smallest x and y.
    pub(super) corner: [f64; 2],
    /// Its length.
    pub(super) length: f64,
    /// Its middle.
    pub(super) middle: [f64; 2],
}

/// At start and end of a shared length: the node of either body that ends it.
pub(super) type EndNodes = [[Option<usize>; 2]; 2];

/// The boundary of a body, with the reach of every edge.
pub(super) fn lines(subdomain: usize, mesh: &Mesh) -> Result<Vec<BoundaryLine>> {
    let mut lines: Vec<BoundaryLine> =
        mesh.boundary()?.into_iter().map(|edge| BoundaryLine::new(subdomain, mesh, edge)).collect();
    let mut starting: HashMap<usize, usize> = HashMap::new();
    for (i, line) in lines.iter().enumerate() {
        starting.insert(line.edge.nodes()[0], i);
    }
    for i in 0..lines.len() {
        let Some(&next) = starting.get(&lines[i].edge.nodes()[1]) else { continue };
        let (t, u) = (lines[i].tangent, lines[next].tangent);
        let turn = (t[0] * u[1] - t[1] * u[0]).atan2(dot(t, u)).abs();
        if turn < CORNER {
            for line in [i, next] {
                let length = lines[line].length;
                lines[line].reach = lines[line].reach.max((NEAR + BEND * turn) * length);
            }
        }
    }
    Ok(lines)
}

impl BoundaryLine {
    fn new(subdomain: usize, mesh: &Mesh, edge: Facet) -> BoundaryLine {
        let ends = [0, 1].map(|i| in_plane(mesh.points[edge.nodes()[i]]));
        let along = minus(ends[1], ends[0]);
        let length = along[0].hypot(along[1]);
        BoundaryLine {
            subdomain,
            edge,
            ends,
            tangent: along.map(|x| x / length),
            length,
            reach: NEAR * length,
        }
    }

    /// The box around it that its reach fills.
    pub(super) fn surroundings(&self) -> AABB<[f64; 2]> {
        let [p, q] = self.ends;
        let low = [0, 1].map(|d| p[d].min(q[d]) - self.reach);
        AABB::from_corners(low, [0, 1].map(|d| p[d].max(q[d]) + self.reach))
    }

    /// The part that another line shares.
    pub(super) fn share(&self, other: &BoundaryLine) -> Option<Stretch> {
        if dot(self.tangent, other.tangent) > AGAINST {
            return None;
        }
        // along this line the other one runs backwards: its end comes first
        let relative = [1, 0].map(|i| minus(other.ends[i], self.ends[0]));
        let s = relative.map(|x| dot(x, self.tangent));
        let off = relative.map(|x| x[1] * self.tangent[0] - x[0] * self.tangent[1]);
        let (low, high) = (s[0].max(0.0), s[1].min(self.length));
        let size = self.ends.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let shorter = self.length.min(other.length);
        if high - low <= POINT * shorter + 8.0 * f64::EPSILON * size {
            return None;
        }
        let gap = |at: f64| (off[0] + (off[1] - off[0]) * (at - s[0]) / (s[1] - s[0])).abs();
        if gap(low).max(gap(high)) > self.reach.max(other.reach) {
            return None;
        }
        let together = TOGETHER * shorter + 16.0 * f64::EPSILON * size;
        let node = |at: f64, own: f64, line: &BoundaryLine, i: usize| {
            ((at - own).abs() <= together).then_some(line.edge.nodes()[i])
        };
        let ends = [
            [node(low, 0.0, self, 0), node(low, s[0], other, 1)],
            [node(high, self.length, self, 1), node(high, s[1], other, 0)],
        ];
        let place = |at: f64| [0, 1].map(|d| self.ends[0][d] + at * self.tangent[d]);
        let (p, q) = (place(low), place(high));
        Some(Stretch {
            ends,
            corner: [p[0].min(q[0]), p[1].min(q[1])],
            length: high - low,
            middle: [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])],
        })
    }
}
