//! Out-of-balance of loads and reactions.

use crate::assembly::Model;

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
    let low = [0, 1].map(|d| bound(d, f64::min, f64::INFINITY));
    let high = [0, 1].map(|d| bound(d, f64::max, f64::NEG_INFINITY));
    let centre = [0, 1].map(|d| 0.5 * (low[d] + high[d]));
    let (mut rest, mut moment, mut scale) = ([0.0; 2], 0.0, 0.0);
    for (node, x) in points().enumerate() {
        let at = |d: usize| force[model.components * node + d] + reactions[model.components * node + d];
        let f = [at(0), at(1)];
        (0..2).for_each(|d| rest[d] += f[d]);
        moment += (x[0] - centre[0]) * f[1] - (x[1] - centre[1]) * f[0];
        for d in 0..2 {
            let dof = model.components * node + d;
            scale += force[dof].abs() + reactions[dof].abs();
        }
    }
    let arm = 0.5 * (high[0] - low[0]).hypot(high[1] - low[1]);
    Resultant { rest: rest[0].hypot(rest[1]).max(moment.abs() / arm), scale }
}
