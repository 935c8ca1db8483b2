//! Sides that cannot be joined: what is wrong, where, and what to do.

use super::angle::Angles;
use super::link::names;
use super::segment::{CommonStretch, FACING};
use super::{LineMidplane, Side};
use crate::error::Error;
use crate::shape::vector::*;

const FACE: &str = "turn or move one of the parts, so that the curves lie on each other";

fn both(sides: [&[Side]; 2]) -> String {
    format!("{} and {}", names(sides[0]), names(sides[1]))
}

fn error_at(name: &str, what: String, help: &str) -> Error {
    Error::Interface { name: name.into(), what, help: help.into() }
}

/// The sides of a part are too far apart.
pub(in crate::coupling) fn apart(name: &str, sides: [&[Side]; 2], part: &CommonStretch) -> Error {
    let (_, gap, [x, y]) = part.worst;
    let kind = if gap > 0.0 { "gap" } else { "overlap" };
    let what = format!(
        "{} do not lie on each other: {kind} of {:.3e} over a length of {:.3e}, near ({x:.6}, {y:.6})",
        both(sides),
        gap.abs(),
        part.length
    );
    let help = format!(
        "{FACE} (up to {FACING:.0e} of the length beside what chords of one curve differ by), or declare an \"initial_gap\""
    );
    error_at(name, what, &help)
}

/// The sides face the same way.
pub(in crate::coupling) fn same_side(name: &str, sides: [&[Side]; 2]) -> Error {
    let what = format!("{} do not face each other: their bodies lie on the same side", both(sides));
    error_at(name, what, FACE)
}

/// A side turns away from the other on its way.
pub(in crate::coupling) fn turned(name: &str, sides: [&[Side]; 2], [x, y]: [f64; 2]) -> Error {
    let what = format!("{} turn away from each other near ({x:.6}, {y:.6})", both(sides));
    error_at(name, what, "their directions differ by a right angle at most; end one of the curves there")
}

/// No part lies on the other side: the sides lie beside each other.
pub(in crate::coupling) fn nothing_common(name: &str, sides: [&[Side]; 2], c: &LineMidplane) -> Error {
    // the lines start and end where the sides come closest
    let ends = |chain: &super::Chain, angles: &Angles| -> Vec<[f64; 2]> {
        let of_line = |line: &super::angle::SmoothLine| {
            let (first, last) = (line.edges[0], line.edges[line.edges.len() - 1]);
            [chain.point(first, -1.0), chain.point(last, 1.0)]
        };
        angles.lines.iter().flat_map(of_line).collect()
    };
    let (a, b) = (&c.a, &c.b);
    let mut closest = (f64::INFINITY, [0.0; 2]);
    for (from, to) in [(ends(a, &c.angles[0]), &b.points), (ends(b, &c.angles[1]), &a.points)] {
        for x in from {
            for y in to {
                let distance = norm(minus(*y, x));
                if distance < closest.0 {
                    closest = (distance, plus(x, c.origin));
                }
            }
        }
    }
    let (distance, [x, y]) = closest;
    let extent = (0..a.edges()).map(|e| a.chord(e)).sum::<f64>();
    let how = if distance > 1e-9 * extent {
        format!("they are {distance:.3e} apart")
    } else {
        format!("they touch at ({x:.6}, {y:.6})")
    };
    error_at(name, format!("{} have no common length, {how}", both(sides)), FACE)
}

/// An edge faces two curves at one place.
pub(in crate::coupling) fn twice(
    name: &str,
    sides: [&[Side]; 2],
    c: &LineMidplane,
    side: usize,
    edge: usize,
) -> Error {
    let chain = if side == 0 { &c.a } else { &c.b };
    let [x, y] = plus(chain.point(edge, 0.0), c.origin);
    let what = format!(
        "{} faces two curves of {} at one place, near ({x:.6}, {y:.6})",
        names(sides[side]),
        names(sides[1 - side])
    );
    error_at(name, what, "curves of one side must not lie on each other")
}
