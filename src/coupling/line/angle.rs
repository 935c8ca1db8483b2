//! The direction of a side: tangent angles at its nodes, and where it is kinked.
//!
//! ```text
//!            θ₁    node     θ₂            θ = (θ₁ h₂ + θ₂ h₁) / (h₁ + h₂), the angle half-way between the middles
//!   ●─────────────● θ ───────────●        of the two edges if both belong to one curve;
//!        h₁               h₂              at an end the deviation at the other end, mirrored
//! ```
//!
//! θ₁ and θ₂ are the angles of the edges themselves at the node: constant along a straight edge, from the edge's own
//! derivative on a curved quadratic one. Between its nodes an edge interpolates the angles. At a kink every edge keeps an
//! end angle of its own.

use super::Chain;
use super::link::Corner;
use crate::shape::vector::*;

/// A kink turns by more than this times what its neighbours turn by on average ...
const SHARPER: f64 = 2.0;
/// ... plus this [rad].
const STRAIGHT: f64 = 1e-6;
/// At a point of the geometry so sharp a turn is a kink whatever its neighbours do [rad].
const SHARP: f64 = 1.0;
/// So sharp a turn is a kink whatever is known: no curve has it [rad].
const FOLD: f64 = 2.2;
/// Least turn of a kink if the points of the geometry are not known [rad].
const PLAIN: f64 = 0.3;
/// An edge this much shorter than its neighbour has no direction of its own: rounding turns it.
const SPECK: f64 = 1e-6;

/// Directions of a side.
#[derive(Debug, Clone, Default)]
pub(in crate::coupling) struct Angles {
    /// Tangent angle of every edge at its start, end and middle [rad].
    pub of_edge: Vec<[f64; 3]>,
    /// Unit tangent of every edge there.
    tangents: Vec<[[f64; 2]; 3]>,
    /// Angle from every edge's own direction to that of its nodes, at start and end [rad].
    deviation: Vec<[f64; 2]>,
    /// Largest distance of every edge from the curve that it approximates [length].
    pub slack: Vec<f64>,
    /// Lines without kinks.
    pub lines: Vec<SmoothLine>,
    /// The largest turn at a kink [rad].
    pub sharpest: f64,
}

/// Edges that follow each other without a kink.
#[derive(Debug, Clone)]
pub(in crate::coupling) struct SmoothLine {
    /// Numbers of the edges, in order.
    pub edges: Vec<usize>,
    /// True if the last edge ends where the first one starts.
    pub closed: bool,
}

impl Angles {
    /// Finds kinks and angles of a chain.
    pub(in crate::coupling) fn new(chain: &Chain) -> Angles {
        let own: Vec<[f64; 3]> = (0..chain.edges()).map(|e| own(chain, e)).collect();
        let mut angles = Angles { of_edge: own.clone(), ..Angles::default() };
        for run in &chain.runs {
            let edges: Vec<usize> = run.edges.clone().collect();
            let turns = turns(&own, &edges, run.closed);
            let kinks: Vec<usize> = (0..edges.len())
                .filter(|&i| (run.closed || i > 0) && is_kink(chain, &edges, &turns, i, run.closed))
                .collect();
            for &i in &kinks {
                angles.sharpest = angles.sharpest.max(turns[i].abs());
            }
            if run.closed && kinks.is_empty() {
                angles.lines.push(SmoothLine { edges, closed: true });
                continue;
            }
            // a closed run starts at its first kink
            let mut order = edges;
            let first = if run.closed { kinks[0] } else { 0 };
            order.rotate_left(first);
            let mut starts: Vec<usize> = kinks.iter().map(|i| i - first).filter(|&i| i > 0).collect();
            starts.push(order.len());
            let mut start = 0;
            for end in starts {
                angles.lines.push(SmoothLine { edges: order[start..end].to_vec(), closed: false });
                start = end;
            }
        }
        for line in &angles.lines {
            smooth(chain, &own, line, &mut angles.of_edge);
        }
        for (e, own) in own.iter().enumerate() {
            let of_nodes = angles.of_edge[e];
            let deviation = [0, 1].map(|i| near(of_nodes[i], own[i]) - own[i]);
            angles.slack.push(slack(chain.chord(e), deviation, of_nodes));
            angles.deviation.push(deviation);
            let of = |angle: f64| [angle.cos(), angle.sin()];
            let [start, end] = [of(of_nodes[0]), of(of_nodes[1])];
            let mid = if chain.is_straight(e) { unit(plus(start, end)) } else { of(of_nodes[2]) };
            angles.tangents.push([start, end, mid]);
        }
        angles
    }

    /// From a straight edge at ξ to the curve that its nodes lie on: the cubic through both with their directions.
    /// Nothing on a quadratic edge, which follows the curve itself.
    pub(in crate::coupling) fn to_curve(&self, chain: &Chain, e: usize, xi: f64) -> [f64; 2] {
        let [first, last] = self.deviation[e];
        if !chain.is_straight(e) || first == 0.0 && last == 0.0 {
            return [0.0; 2];
        }
        let [dx, dy] = chain.derivative(e, xi); // half the chord
        let (u, v) = (0.5 * (1.0 + xi), 0.5 * (1.0 - xi));
        let height = 2.0 * u * v * (first * v - last * u);
        [-height * dy, height * dx]
    }

    /// Unit tangent of an edge at ξ: along the parabola through the three, exactly the common value where they agree.
    pub(in crate::coupling) fn tangent(&self, e: usize, xi: f64) -> [f64; 2] {
        let [start, end, mid] = self.tangents[e];
        if xi == 1.0 {
            return end;
        }
        unit([0, 1].map(|d| {
            let (slope, bend) = (0.5 * (end[d] - start[d]), 0.5 * ((start[d] - mid[d]) + (end[d] - mid[d])));
            mid[d] + xi * (slope + xi * bend)
        }))
    }
}

/// Largest distance of an edge from its curve: twice the sagitta h δ/4, δ the angle between edge and curve at its ends, and
/// what is left of an arc when a parabola follows it, h θ³/512, with a margin likewise.
fn slack(h: f64, deviation: [f64; 2], nodes: [f64; 3]) -> f64 {
    h * (0.5 * deviation[0].abs().max(deviation[1].abs()) + (nodes[1] - nodes[0]).abs().powi(3) / 256.0)
}

/// Angles of an edge's own derivative at its start, end and middle, continuous along it.
fn own(chain: &Chain, e: usize) -> [f64; 3] {
    let angle = |xi: f64| {
        let [dx, dy] = chain.derivative(e, xi);
        dy.atan2(dx)
    };
    let mid = angle(0.0);
    match chain.is_straight(e) {
        true => [mid; 3],
        false => [near(angle(-1.0), mid), near(angle(1.0), mid), mid],
    }
}

/// The angle that is nearest to another among those that differ by full turns.
fn near(angle: f64, other: f64) -> f64 {
    angle + ((other - angle) / std::f64::consts::TAU).round() * std::f64::consts::TAU
}

/// Turn at the start of every edge; zero at an open end.
fn turns(own: &[[f64; 3]], edges: &[usize], closed: bool) -> Vec<f64> {
    let n = edges.len();
    let turn = |i: usize| {
        let before = own[edges[(i + n - 1) % n]][1];
        near(own[edges[i]][0], before) - before
    };
    (0..n).map(|i| if i > 0 || closed { turn(i) } else { 0.0 }).collect()
}

/// True if the side is kinked at the start of edge `i` of a run.
fn is_kink(chain: &Chain, edges: &[usize], turns: &[f64], i: usize, closed: bool) -> bool {
    let n = edges.len();
    let turn = turns[i].abs();
    if turn > FOLD {
        return true;
    }
    let limit = match chain.corners[chain.ends[edges[i]][0]] {
        Corner::No => return false,
        Corner::Yes if turn > SHARP => return true,
        Corner::Yes => STRAIGHT,
        Corner::Unknown => PLAIN,
    };
    let (before, after) = ((i + n - 1) % n, (i + 1) % n);
    let there = |j: usize| j != i && (closed || j > 0);
    let neighbours: Vec<f64> =
        [before, after].into_iter().filter(|&j| there(j)).map(|j| turns[j].abs()).collect();
    let mean = neighbours.iter().sum::<f64>() / neighbours.len().max(1) as f64;
    turn > SHARPER * mean + limit
}

/// Replaces the own angles of the edges of a line by those of its nodes, continuous along the line.
fn smooth(chain: &Chain, own: &[[f64; 3]], line: &SmoothLine, angles: &mut [[f64; 3]]) {
    let n = line.edges.len();
    let length: Vec<f64> = line.edges.iter().map(|&e| chain.chord(e)).collect();
    // own angles without jumps by full turns
    let mut unrolled: Vec<[f64; 3]> = Vec::with_capacity(n);
    for (i, &e) in line.edges.iter().enumerate() {
        let shift = if i == 0 { 0.0 } else { near(own[e][0], unrolled[i - 1][1]) - own[e][0] };
        unrolled.push(own[e].map(|angle| angle + shift));
    }
    let between = |i: usize, j: usize| {
        let (h1, h2) = (length[i], length[j]);
        let (before, after) = (unrolled[i][1], near(unrolled[j][0], unrolled[i][1]));
        if h1 < SPECK * h2 {
            after
        } else if h2 < SPECK * h1 {
            before
        } else {
            before + (after - before) * (h1 / (h1 + h2))
        }
    };
    let mut nodes: Vec<f64> = (1..n).map(|i| between(i - 1, i)).collect(); // inner nodes: at the start of edge i
    let deviation = |node: f64, own: f64| near(node, own) - own;
    let (first, last) = if line.closed {
        let seam = between(n - 1, 0);
        (near(seam, unrolled[0][0]), seam)
    } else if n == 1 {
        (unrolled[0][0], unrolled[0][1])
    } else {
        let start = unrolled[0][0] - deviation(nodes[0], unrolled[0][1]);
        let end = unrolled[n - 1][1] - deviation(nodes[n - 2], unrolled[n - 1][0]);
        let speck = |i: usize, j: usize| length[i] < SPECK * length[j];
        (if speck(0, 1) { nodes[0] } else { start }, if speck(n - 1, n - 2) { nodes[n - 2] } else { end })
    };
    nodes.insert(0, first);
    nodes.push(last);
    for (i, &e) in line.edges.iter().enumerate() {
        let (start, end) = (nodes[i], near(nodes[i + 1], nodes[i]));
        let mid = if chain.is_straight(e) { 0.5 * (start + end) } else { unrolled[i][2] };
        angles[e] = [start, end, mid];
    }
}
