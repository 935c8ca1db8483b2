//! Branches of a line of flow: from one node to the next, with their resistance and what it owes to the jumps.

use super::aperture::{Resistance, between};
use super::interval::{Interval, Polynomial};
use super::line::FlowLine;

/// A branch with its resistance Y and the part of it up to its law points.
pub(super) struct FlowBranch {
    pub line: usize,
    pub nodes: [usize; 2],
    /// 12 μ.
    pub twelve_mu: f64,
    /// Y, and its derivatives by the normal jumps of law points (numbers over all lines).
    pub whole: f64,
    pub by_jump: Vec<(usize, f64)>,
    pub points: Vec<PointOnBranch>,
}

/// A law point of a branch: its number over all lines, Y up to it, and the derivatives beyond those of the intervals before.
pub(super) struct PointOnBranch {
    pub point: usize,
    pub part: f64,
    /// Number of the branch's derivatives that stand for intervals before it.
    pub before: usize,
    pub own: Vec<(usize, f64)>,
}

impl FlowLine {
    /// Its branches for normal jumps at its law points, whose numbers over all lines start at `first`.
    pub(super) fn branches(&self, line: usize, jumps: &[f64], first: usize) -> Vec<FlowBranch> {
        let mut branches = Vec::with_capacity(self.stations.len() - 1);
        let (mut start, mut next) = (0.0, 0);
        let open = |k: usize| FlowBranch {
            line,
            nodes: [self.stations[k].node, self.stations[k + 1].node],
            twelve_mu: 12.0 * self.viscosity,
            whole: 0.0,
            by_jump: Vec::new(),
            points: Vec::new(),
        };
        let mut branch = open(0);
        for interval in &self.intervals {
            let own = interval.first..interval.first + interval.places.len();
            let jump = Polynomial::new(&interval.places, &jumps[own.clone()]);
            let mut from = 0.0;
            loop {
                // up to the next inner station, or the end of the interval
                let station = self.stations.get(next + 1).filter(|_| next + 2 < self.stations.len());
                let cut = station.map(|at| (at.s - start) / interval.length).filter(|at| *at < 1.0);
                let to = cut.unwrap_or(1.0).max(from);
                let mut part = Resistance::default();
                let mut here = from;
                let inside = |place: f64| if to < 1.0 { place < to } else { true };
                for (p, &place) in interval.places.iter().enumerate() {
                    if place < from || !inside(place) {
                        continue;
                    }
                    part.add(&between(&jump, self.aperture, here, place));
                    here = place;
                    branch.points.push(PointOnBranch {
                        point: first + own.start + p,
                        part: branch.whole + part.value * interval.length,
                        before: branch.by_jump.len(),
                        own: listed(first + own.start, &part, interval),
                    });
                }
                part.add(&between(&jump, self.aperture, here, to));
                branch.whole += part.value * interval.length;
                branch.by_jump.extend(listed(first + own.start, &part, interval));
                if cut.is_none() {
                    break;
                }
                next += 1;
                branches.push(std::mem::replace(&mut branch, open(next)));
                from = to;
            }
            start += interval.length;
        }
        branches.push(branch);
        branches
    }
}

/// Derivatives of a part of an interval by the jumps of its law points, the first of which has a number.
fn listed(first: usize, part: &Resistance, interval: &Interval) -> Vec<(usize, f64)> {
    (0..interval.places.len()).map(|j| (first + j, part.by_jump[j] * interval.length)).collect()
}
