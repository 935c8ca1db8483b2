//! Edges that have a length and a direction everywhere: what pairing may rely on.

use super::link::names;
use super::{Chain, Side};
use crate::error::{Error, Result};
use crate::shape::vector::*;

/// Edges are at least so long, of the extent of both sides: shorter ones drown in the rounding of where they are.
const SHORTEST: f64 = 1e-12;
/// And so many units in the last place of their coordinates.
const ROUNDING: f64 = 4.0;
/// A mid-node is less than these parts of the chord off its middle, along it and across: beyond them the edge turns back,
/// or as far as no curve does from one node to the next.
const OFF: [f64; 2] = [0.25, 0.5];

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
                let fault = format!("of length {length:.1e}");
                return Err(error_at(e, &fault, "make one node of its ends: no mesh needs it"));
            }
            let [start, middle, end] = [-1.0, 0.0, 1.0].map(|xi| chain.point(e, xi));
            let (chord, off) = (minus(end, start), minus(middle, plus(start, end).map(|x| 0.5 * x)));
            let parts = [dot(off, chord), dot(off, [-chord[1], chord[0]])];
            if !parts.iter().zip(OFF).all(|(part, most)| part.abs() < most * length * length) {
                let fault = "with a mid-node far off its middle";
                return Err(error_at(e, fault, "use a finer mesh or Mesh.HighOrderOptimize = 1"));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Gap, Side, join};
    use crate::mesh::Facet;

    type Points = Vec<[f64; 3]>;

    /// Joins two lines of points along x, A below B.
    fn joined(a: &Points, b: &Points, quadratic: bool) -> Result<(), String> {
        let edges = |points: &Points, forward: bool| -> Vec<Facet> {
            let step = if quadratic { 2 } else { 1 };
            let edge = |i: usize| {
                let [start, end] = if forward { [i, i + step] } else { [i + step, i] };
                let nodes = [start, end, i + 1];
                Facet::edge(&nodes[..=step], i, true)
            };
            (0..points.len() - 1).step_by(step).map(edge).collect()
        };
        let (edges_a, edges_b) = (edges(a, false), edges(b, true));
        let side =
            |points, edges, first| [Side { name: "side", points, edges, corners: &[usize::MAX], first }];
        let (a, b) = (side(a, &edges_a, 0), side(b, &edges_b, a.len()));
        join("joint", &a, &b, Gap::Open).map(|_| ()).map_err(|error| error.to_string())
    }

    fn at(points: &[[f64; 2]]) -> Points {
        points.iter().map(|&[x, y]| [x, y, 0.0]).collect()
    }

    #[test]
    fn edges_without_length_are_refused() {
        let good = at(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]);
        joined(&good, &good, false).unwrap();
        joined(&at(&[[0.0, 0.0], [1e-11, 0.0], [1.0, 0.0]]), &good, false).unwrap();
        let message = joined(&good, &at(&[[0.0, 0.0], [1e-13, 0.0], [1.0, 0.0]]), false).unwrap_err();
        assert!(message.contains("an edge of length 1.0e-13, near (0, 0)"), "{message}");
        // far away, where coordinates have fewer digits
        let far = |x: f64| at(&[[1e9, 0.0], [1e9 + x, 0.0], [1e9 + 1.0, 0.0]]);
        joined(&far(0.5), &far(1e-5), false).unwrap();
        assert!(joined(&far(0.5), &far(5e-7), false).unwrap_err().contains("an edge of length"));
    }

    #[test]
    fn mid_nodes_far_off_are_refused() {
        let good = at(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]);
        let with = |x: f64, y: f64| joined(&at(&[[0.0, 0.0], [x, y], [1.0, 0.0]]), &good, true);
        with(0.74, 0.0).unwrap();
        with(0.5, 0.02).unwrap();
        for [x, y] in [[0.76, 0.0], [0.2, 0.0], [0.5, 0.6], [0.5, -0.6]] {
            let message = with(x, y).unwrap_err();
            assert!(message.contains("a mid-node far off its middle"), "{message}");
        }
    }

    #[test]
    fn sides_that_turn_away_from_each_other_are_refused() {
        let line = |sign: f64, last: f64| {
            let arc = (1..=12).map(|i| last * f64::from(i) / 12.0);
            let arc = arc.map(|turn| [10.0 + 0.5 * turn.sin(), sign * 0.5 * (1.0 - turn.cos())]);
            at(&[[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]].into_iter().chain(arc).collect::<Vec<_>>())
        };
        joined(&line(-1.0, 0.7), &line(1.0, 0.7), false).unwrap();
        let message = joined(&line(-1.0, 1.1), &line(1.0, 1.1), false).unwrap_err();
        assert!(message.contains("turn away from each other near (10."), "{message}");
    }

    #[test]
    fn a_side_that_folds_back_is_kinked_there_whatever_its_corners() {
        // A closed line there and back, none of whose nodes is on a point of the geometry: its way back lies on nothing
        let points = at(&[[0.0, 0.0], [0.1, 0.0], [0.4, 0.0], [1.0, 0.0]]);
        let edges = [[1, 0], [2, 1], [3, 2], [0, 3]].map(|nodes| Facet::edge(&nodes, 0, true));
        let b = at(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]);
        let edges_b = [[0, 1], [1, 2]].map(|nodes| Facet::edge(&nodes, 0, true));
        for corners in [&[][..], &[usize::MAX]] {
            let side = |points, edges, first| [Side { name: "side", points, edges, corners, first }];
            let (a, b) = (side(&points, &edges, 0), side(&b, &edges_b, points.len()));
            let joined = join("joint", &a, &b, Gap::Closed).unwrap();
            assert!((joined.kink - std::f64::consts::PI).abs() < 1e-12, "{}", joined.kink);
            assert!((joined.length - 1.0).abs() < 1e-12, "{}", joined.length);
        }
    }
}
