//! The mid-plane C of two straight sides and its segments (paper §3.1, fig. 2).
//!
//! Both sides are projected on the line in their middle. C is cut at every projected node of either side; a segment has
//! one parent edge on A and one on B, and a place ξ_C on it has a place ξ_A, ξ_B on both.

use super::{Chain, Side};
use crate::error::{Error, Result};

/// Two faces may lie this far apart, and each may deviate this much from a line. Of the common length.
const FACING: f64 = 1e-3;
/// A side deviates from a line by less than this. Of its length.
const STRAIGHT: f64 = 1e-9;
/// Projected nodes closer than this are one. Of the common length.
const SLIVER: f64 = 1e-13;

/// The mid-plane of two straight sides.
#[derive(Debug, Clone)]
pub struct Midplane {
    /// Side A, along the tangent, the normal on its left.
    pub a: Chain,
    /// Side B, along the tangent.
    pub b: Chain,
    /// Arc lengths of A's nodes along C, from the start of the common length; edge ends first, as in `a`.
    pub s_a: Vec<f64>,
    /// Arc lengths of B's nodes along C.
    pub s_b: Vec<f64>,
    /// Start of the common length.
    pub origin: [f64; 2],
    /// Unit tangent: n turned clockwise.
    pub tangent: [f64; 2],
    /// Unit normal, from A to B.
    pub normal: [f64; 2],
    /// Length of C [length].
    pub length: f64,
    /// Smallest and largest distance from A to B along n; negative where they overlap [length].
    pub gap: [f64; 2],
    /// The pieces of C in order.
    pub segments: Vec<Segment>,
}

/// A piece of C with its parents.
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
}

impl Midplane {
    /// Orders the sides, finds the line in their middle, and cuts it.
    pub fn build(name: &str, side_a: Side, side_b: Side) -> Result<Midplane> {
        let refuse =
            |what: String, cure: &str| Error::Interface { name: name.into(), what, cure: cure.into() };
        let names = format!("{} and {}", side_a.name, side_b.name);
        let a = Chain::order(name, side_a)?.reversed(); // its body on the right: n on the left points away from it
        let b = Chain::order(name, side_b)?;
        let (t_a, t_b) = (direction(&a), direction(&b));
        let facing = "turn or move one of the parts, so that the curves lie on each other";
        let cosine = dot(t_a, t_b);
        if cosine < 0.0 {
            let what = format!("{names} do not face each other: their bodies lie on the same side");
            return Err(refuse(what, facing));
        }
        for (chain, side, tangent) in [(&a, side_a, t_a), (&b, side_b, t_b)] {
            let length = distance(chain.points[0], chain.points[chain.edges()]);
            let normal = [-tangent[1], tangent[0]];
            let from_line = |p: &[f64; 2]| dot(minus(*p, chain.points[0]), normal).abs();
            let deviation = chain.points.iter().map(from_line).fold(0.0, f64::max);
            if deviation > STRAIGHT * length {
                let what = format!("{} is not straight: it leaves its line by {deviation:.3e}", side.name);
                return Err(refuse(what, "joints are straight: make an interface of every straight piece"));
            }
        }
        let tangent = unit([t_a[0] + t_b[0], t_a[1] + t_b[1]]);
        let normal = [-tangent[1], tangent[0]];
        let from = a.points[0]; // local origin: differences of coordinates only, also far from zero
        let along = |chain: &Chain| -> Vec<f64> {
            chain.points.iter().map(|p| dot(minus(*p, from), tangent)).collect()
        };
        let (mut s_a, mut s_b) = (along(&a), along(&b));
        let start = s_a[0].max(s_b[0]);
        let length = s_a[a.edges()].min(s_b[b.edges()]) - start;
        let shorter = (s_a[a.edges()] - s_a[0]).min(s_b[b.edges()] - s_b[0]);
        if length <= SLIVER.sqrt() * shorter {
            let apart = if length < 0.0 {
                format!(", they are {:.3e} apart along it", -length)
            } else {
                String::new()
            };
            return Err(refuse(format!("{names} have no common length{apart}"), facing));
        }
        for s in s_a.iter_mut().chain(s_b.iter_mut()) {
            *s -= start;
        }
        let lift = |chain: &Chain, s: &[f64], at: f64| {
            let e = parent(&s[..=chain.edges()], at);
            let x = [0, 1].map(|d| {
                let share = (at - s[e]) / (s[e + 1] - s[e]);
                (chain.points[e][d] - from[d]) * (1.0 - share) + (chain.points[e + 1][d] - from[d]) * share
            });
            (dot(x, normal), x)
        };
        let ends = [0.0, length].map(|at| (lift(&a, &s_a, at), lift(&b, &s_b, at)));
        let gaps = ends.map(|((g_a, _), (g_b, _))| g_b - g_a);
        let gap = [gaps[0].min(gaps[1]), gaps[0].max(gaps[1])];
        let widest = if gap[1] >= -gap[0] { gap[1] } else { gap[0] };
        if widest.abs() > FACING * length {
            let kind = if widest > 0.0 { "gap" } else { "overlap" };
            let what = format!(
                "{names} do not lie on each other: {kind} of {:.3e} over a length of {length:.3e}",
                widest.abs()
            );
            return Err(refuse(what, facing));
        }
        let ((_, x_a), (_, x_b)) = ends[0];
        let origin = [0, 1].map(|d| from[d] + 0.5 * (x_a[d] + x_b[d]));
        let segments = cut(&s_a[..=a.edges()], &s_b[..=b.edges()], length);
        Ok(Midplane { a, b, s_a, s_b, origin, tangent, normal, length, gap, segments })
    }

    /// The place in the plane at arc length `s`.
    pub fn position(&self, s: f64) -> [f64; 2] {
        [0, 1].map(|d| self.origin[d] + s * self.tangent[d])
    }

    /// Arc lengths of the edge ends of A and of B.
    pub fn ends(&self) -> [&[f64]; 2] {
        [&self.s_a[..=self.a.edges()], &self.s_b[..=self.b.edges()]]
    }

    /// R: rows n and t.
    pub fn rotation(&self) -> [[f64; 2]; 2] {
        [self.normal, self.tangent]
    }
}

/// Cuts C at the projections of all nodes; the sum of the lengths is the length of C.
fn cut(s_a: &[f64], s_b: &[f64], length: f64) -> Vec<Segment> {
    let inside = |s: &&f64| **s > SLIVER * length && **s < length * (1.0 - SLIVER);
    let mut cuts: Vec<f64> = s_a.iter().chain(s_b).filter(inside).copied().collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|later, earlier| *later - *earlier <= SLIVER * length);
    let starts = std::iter::once(0.0).chain(cuts.iter().copied());
    let ends = cuts.iter().copied().chain(std::iter::once(length));
    let segment = |(start, end): (f64, f64)| {
        let middle = 0.5 * (start + end);
        Segment { start, end, edge_a: parent(s_a, middle), edge_b: parent(s_b, middle) }
    };
    starts.zip(ends).map(segment).collect()
}

/// The edge of a chain with nodes at `s` that holds the place `at`.
fn parent(s: &[f64], at: f64) -> usize {
    s.partition_point(|&node| node <= at).clamp(1, s.len() - 1) - 1
}

fn direction(chain: &Chain) -> [f64; 2] {
    unit(minus(chain.points[chain.edges()], chain.points[0]))
}

fn minus(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

fn dot(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    minus(p, q)[0].hypot(minus(p, q)[1])
}

fn unit(v: [f64; 2]) -> [f64; 2] {
    let length = v[0].hypot(v[1]);
    [v[0] / length, v[1] / length]
}
