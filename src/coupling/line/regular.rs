//! Edges that have a length and a direction everywhere: what pairing may rely on.

use super::link::names;
use super::{Chain, Side};
use crate::error::{Error, Result};
use crate::shape::vector::*;

/// Edges are at least so long, of the extent of both sides: shorter ones drown in the rounding of where they are.
const SHORTEST: f64 = 1e-12;
/// And so many units in the last place of their coordinates.
const ROUNDING: f64 = 4.0;
/// A mid-node is less than this part of the chord away from the middle: there the edge turns back, or by a right angle.
const QUARTER: f64 = 0.25;

/// Refuses edges whose ends are one place and those that turn back on their way.
pub(super) fn check(name: &str, sides: [&[Side]; 2], chains: [&Chain; 2], origin: [f64; 2]) -> Result<()> {
    let largest = |from: [f64; 2]| {
        let points = chains.iter().flat_map(|chain| &chain.points);
        points.flat_map(|&x| plus(x, from)).fold(0.0_f64, |largest, x| largest.max(x.abs()))
    };
    let shortest = (SHORTEST * largest([0.0; 2])).max(ROUNDING * f64::EPSILON * largest(origin));
    for (side, chain) in sides.into_iter().zip(chains) {
        let error_at = |e: usize, fault: &str, help: &str| {
            let [x, y] = plus(chain.point(e, -1.0), origin);
            let what = format!("{} has an edge {fault}, near ({x}, {y})", names(side));
            Error::Interface { name: name.into(), what, help: help.into() }
        };
        for e in 0..chain.edges() {
            let length = chain.chord(e);
            if length.is_nan() || length <= shortest {
                let fault = format!("of length {length:e}");
                return Err(error_at(e, &fault, "make one node of its ends: no mesh needs it"));
            }
            let [start, middle, end] = [-1.0, 0.0, 1.0].map(|xi| chain.point(e, xi));
            let off = norm(minus(middle, plus(start, end).map(|x| 0.5 * x)));
            if off.is_nan() || off >= QUARTER * length {
                let fault = "whose mid-node is a quarter of its length or more off the middle";
                return Err(error_at(e, fault, "use a finer mesh or Mesh.HighOrderOptimize = 1"));
            }
        }
    }
    Ok(())
}
