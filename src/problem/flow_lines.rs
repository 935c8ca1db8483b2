//! Lines of flow: the intervals of an interface, its ends, and which of them meet.

use crate::assembly::{InterfaceOperator, Model};
use crate::error::{Error, Result};
use crate::scene::{Flow, FlowEnd, Scene};
use crate::shape::Ends;
use crate::shape::vector::{dot, minus, norm, plus};
use crate::water::{FlowLine, Interval, Station};

/// Two ends meet within this part of the longer interval beside them, as boundaries do in `between`.
const MEET: f64 = 1e-3;
/// Stations of a line that are nearer than this part of its length are one.
pub(super) const SAME: f64 = 1e-9;

/// Flow along an interface as it is stated: in which step, under which key.
#[derive(Debug, Clone)]
pub(super) struct StatedFlow<'a> {
    pub(super) interface: usize,
    pub(super) flow: &'a Flow,
    pub(super) step: usize,
    pub(super) key: String,
}

/// An end of a line, with the length of the interval beside it.
pub(super) struct LineEnd {
    pub(super) place: [f64; 3],
    beside: f64,
}

/// FlowNodes that are one, and what is given at them.
#[derive(Default)]
pub(super) struct FlowNodes {
    parent: Vec<usize>,
    pub(super) given: Vec<Option<usize>>,
}

impl FlowNodes {
    pub(super) fn add(&mut self, given: Option<usize>) -> usize {
        self.parent.push(self.parent.len());
        self.given.push(given);
        self.parent.len() - 1
    }

    pub(super) fn root(&self, mut node: usize) -> usize {
        while self.parent[node] != node {
            node = self.parent[node];
        }
        node
    }

    /// Number of nodes, those that are one among them.
    pub(super) fn len(&self) -> usize {
        self.parent.len()
    }

    /// Makes two nodes one; of two given pressures the first stays.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.given[a] = self.given[a].or(self.given[b]);
            self.parent[b] = a;
        }
    }
}

impl StatedFlow<'_> {
    pub(super) fn path<'p>(&'p self, number: &'p str) -> [&'p str; 6] {
        ["steps", number, "load", &self.key, "pressure", "flow"]
    }

    /// The refusal of an end at which nothing with flow ends.
    pub(super) fn alone(&self, scene: &Scene, end: usize, [x, y, _]: [f64; 3]) -> Error {
        let number = self.step.to_string();
        let path = [&self.path(&number)[..], &["ends"]].concat();
        let what = format!("no other interface with flow meets the end at s = {end}, ({x:.6}, {y:.6})");
        scene.source.error_at(&path, what, "give it a pressure, or \"wall\"")
    }

    /// The intervals of an interface, which must be one open line; without stations.
    pub(super) fn line(&self, scene: &Scene, operator: &InterfaceOperator) -> Result<FlowLine> {
        let midplane = &operator.coupling.midplane;
        let number = self.step.to_string();
        let refuse = |what: &str, help: &str| {
            let what = format!("{}: {what}", operator.name);
            Err(scene.source.error_at(&self.path(&number), what, help))
        };
        if midplane.pieces.iter().any(|piece| piece.closed) {
            return refuse("a closed loop has no ends to flow between", "join it by two interfaces");
        }
        if midplane.pieces.iter().skip(1).any(|piece| !piece.follows) {
            return refuse("it is in several parts", "make an interface of each part");
        }
        let spans: Vec<Ends> = spans(operator).into_iter().map(|(s, _)| s).collect();
        let points = &operator.coupling.points;
        let each = points.len() / spans.len();
        let interval = |(i, [from, to]): (usize, &Ends)| Interval {
            length: to - from,
            first: each * i,
            places: points[each * i..each * (i + 1)].iter().map(|p| (p.s - from) / (to - from)).collect(),
        };
        Ok(FlowLine {
            interface: self.interface,
            aperture: self.flow.aperture,
            viscosity: self.flow.viscosity,
            intervals: spans.iter().enumerate().map(interval).collect(),
            stations: Vec::new(),
        })
    }
}

/// The intervals of an interface in order: arc lengths and places of their ends.
pub(super) fn spans(operator: &InterfaceOperator) -> Vec<(Ends, [[f64; 3]; 2])> {
    let midplane = &operator.coupling.midplane;
    match midplane.cells.is_empty() {
        true => midplane.segments.iter().map(|segment| (segment.s, segment.places)).collect(),
        false => midplane.cells.iter().map(|cell| (cell.s, cell.places)).collect(),
    }
}

pub(super) fn line_ends(operator: &InterfaceOperator) -> [LineEnd; 2] {
    let spans = spans(operator);
    [0, 1].map(|end| {
        let (s, places) = if end == 0 { spans[0] } else { spans[spans.len() - 1] };
        LineEnd { place: places[end], beside: s[1] - s[0] }
    })
}

/// The place at an arc length, on the chord of its interval.
pub(super) fn position(operator: &InterfaceOperator, s: f64) -> [f64; 3] {
    let spans = spans(operator);
    let at = spans.partition_point(|(span, _)| span[1] < s).min(spans.len() - 1);
    let ([from, to], [p, q]) = spans[at];
    let share = (s - from) / (to - from);
    plus(p, minus(q, p).map(|d| share * d))
}

/// Joins an end with all ends there that are not walls, else with the line on which it lies; false if there is neither.
pub(super) fn meet(
    model: &Model,
    stated: &[StatedFlow],
    lines: &mut [FlowLine],
    ends: &[[LineEnd; 2]],
    (l, end): (usize, usize),
    nodes: &mut FlowNodes,
) -> bool {
    let own = &ends[l][end];
    let node = |lines: &[FlowLine], l: usize, end: usize| {
        let stations = &lines[l].stations;
        stations[if end == 0 { 0 } else { stations.len() - 1 }].node
    };
    let mut met = false;
    for (m, others) in ends.iter().enumerate() {
        for (side, other) in others.iter().enumerate().filter(|(side, _)| (m, *side) != (l, end)) {
            let near = norm(minus(other.place, own.place)) <= MEET * own.beside.max(other.beside);
            if near && stated[m].flow.ends[side] != Some(FlowEnd::Wall) {
                nodes.join(node(lines, m, side), node(lines, l, end));
                met = true;
            }
        }
    }
    if met {
        return true;
    }
    for m in (0..stated.len()).filter(|m| *m != l) {
        let Some(s) = place_on(&model.interfaces[stated[m].interface], own) else { continue };
        let length = model.interfaces[stated[m].interface].coupling.midplane.length;
        let own = node(lines, l, end);
        let stations = &mut lines[m].stations;
        let after = stations.partition_point(|station| station.s < s - SAME * length);
        match stations.get(after).filter(|station| station.s <= s + SAME * length) {
            Some(station) => nodes.join(station.node, own),
            None => stations.insert(after, Station { s, node: own }),
        }
        return true;
    }
    false
}

/// Arc length of the place of an interface that an end touches, not at the interface's own ends.
fn place_on(operator: &InterfaceOperator, end: &LineEnd) -> Option<f64> {
    spans(operator).into_iter().find_map(|([from, to], [p, q])| {
        let (way, here) = (minus(q, p), minus(end.place, p));
        let share = (dot(way, here) / dot(way, way)).clamp(0.0, 1.0);
        let off = norm(minus(here, way.map(|d| share * d)));
        (off <= MEET * (to - from).max(end.beside)).then_some(from + share * (to - from))
    })
}
