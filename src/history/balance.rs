//! Out-of-balance of loads and reactions.

use crate::assembly::Model;
use crate::shape::vector::{cross, length, minus};

/// Resultant of all loads and reactions.
#[derive(Debug, Clone, Copy)]
pub struct Resultant {
    /// The larger of the resultant force and the moment over half the extent of the model [force].
    pub rest: f64,
    /// Sum of the magnitudes of all loads and reactions [force].
    pub scale: f64,
}

/// The resultant of loads and reactions.
pub fn resultant(model: &Model, force: &[f64], reactions: &[f64]) -> Resultant {
    let points = || model.subdomains.iter().flat_map(|subdomain| &subdomain.mesh.points);
    let bound =
        |d: usize, of: fn(f64, f64) -> f64, from: f64| points().fold(from, |bound, x| of(bound, x[d]));
    let c = model.components;
    let low = [0, 1, 2].map(|d| bound(d, f64::min, f64::INFINITY));
    let high = [0, 1, 2].map(|d| bound(d, f64::max, f64::NEG_INFINITY));
    let centre = [0, 1, 2].map(|d| 0.5 * (low[d] + high[d]));
    let (mut rest, mut moment, mut scale) = ([0.0; 3], [0.0; 3], 0.0);
    for (node, x) in points().enumerate() {
        let mut f = [0.0; 3];
        for d in 0..c {
            let (force, reaction) = (force[c * node + d], reactions[c * node + d]);
            f[d] = force + reaction;
            rest[d] += f[d];
            scale += force.abs() + reaction.abs();
        }
        let own = cross(minus(*x, centre), f);
        moment.iter_mut().zip(own).for_each(|(moment, own)| *moment += own);
    }
    Resultant { rest: length(rest).max(length(moment) / (0.5 * length(minus(high, low)))), scale }
}
