//! Flow along interfaces, bound: which ends meet, which pressures are given, and the network that this makes.

use crate::assembly::{InterfaceOperator, Model};
use crate::error::{Error, Result};
use crate::law::N;
use crate::scene::{Flow, FlowEnd, FormulaPlace, Scene, Value, Variable};
use crate::shape::vector::{dot, minus, norm, plus};
use crate::water::{FlowLine, FlowNode, Interval, Network, Slopes, Station};

use super::quantity::Quantity;
use super::water::{FlowAlong, FlowSlopes, WaterAnswer, WaterPoint};

/// Ends meet within this part of the longer interval beside them, as boundaries do in `between`.
const MEET: f64 = 1e-3;
/// Stations of a line that are nearer than this part of its length are one.
const SAME: f64 = 1e-9;

/// A given pressure.
#[derive(Debug, Clone)]
struct Boundary {
    quantity: Quantity,
    place: FormulaPlace,
    /// It is of this step and follows its load factor.
    follows: bool,
}

/// Flow of a step.
#[derive(Debug, Clone)]
pub(super) struct BoundFlow {
    pub(super) network: Network,
    boundaries: Vec<Boundary>,
    /// Places of the drains of every line [length].
    drains: Vec<Vec<f64>>,
    /// A pressure follows the load factor of the step.
    pub(super) follows: bool,
}

/// Flow along an interface as it is stated: in which step, under which key.
#[derive(Debug, Clone)]
pub(super) struct StatedFlow<'a> {
    pub(super) interface: usize,
    pub(super) flow: &'a Flow,
    pub(super) step: usize,
    pub(super) key: String,
}

/// An end of a line, with the length of the interval beside it.
struct LineEnd {
    place: [f64; 3],
    beside: f64,
}

/// Nodes that are one, and what is given at them.
struct Nodes {
    parent: Vec<usize>,
    given: Vec<Option<usize>>,
}

impl Nodes {
    fn add(&mut self, given: Option<usize>) -> usize {
        self.parent.push(self.parent.len());
        self.given.push(given);
        self.parent.len() - 1
    }

    fn root(&self, mut node: usize) -> usize {
        while self.parent[node] != node {
            node = self.parent[node];
        }
        node
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

impl BoundFlow {
    /// The network of all flows in force in a step.
    pub(super) fn new(scene: &Scene, model: &Model, step: usize, stated: &[StatedFlow]) -> Result<BoundFlow> {
        let mut lines = Vec::with_capacity(stated.len());
        for own in stated {
            lines.push(own.line(scene, &model.interfaces[own.interface])?);
        }
        let mut nodes = Nodes { parent: Vec::new(), given: Vec::new() };
        let mut boundaries = Vec::new();
        let mut given = |own: &StatedFlow, key: &[&str], value: &Value, s: f64, place: [f64; 3]| {
            let number = own.step.to_string();
            let path = [&own.path(&number)[..], key].concat();
            let [x, y, z] = place;
            boundaries.push(Boundary {
                quantity: Quantity::new(scene, &path, value),
                place: FormulaPlace { x, y, z, s, ..FormulaPlace::default() },
                follows: own.step == step && value.uses(Variable::LoadFactor),
            });
            boundaries.len() - 1
        };
        let ends: Vec<[LineEnd; 2]> =
            stated.iter().map(|own| line_ends(&model.interfaces[own.interface])).collect();
        for ((own, line), places) in stated.iter().zip(&mut lines).zip(&ends) {
            let length = model.interfaces[own.interface].coupling.midplane.length;
            let mut drains: Vec<(usize, &crate::scene::Drain)> = own.flow.drains.iter().enumerate().collect();
            drains.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
            let end = |end: usize, nodes: &mut Nodes, given: &mut dyn FnMut(&Value) -> usize| {
                let pressure = match &own.flow.ends[end] {
                    Some(FlowEnd::Pressure(value)) => Some(given(value)),
                    _ => None,
                };
                nodes.add(pressure)
            };
            let place = |end: usize| places[end].place;
            let first = end(0, &mut nodes, &mut |value| given(own, &["ends", "0"], value, 0.0, place(0)));
            line.stations.push(Station { s: 0.0, node: first });
            for (i, drain) in drains {
                let number = i.to_string();
                let at = position(&model.interfaces[own.interface], drain.at * length);
                let boundary =
                    given(own, &["drains", &number, "pressure"], &drain.pressure, drain.at, at);
                line.stations.push(Station { s: drain.at * length, node: nodes.add(Some(boundary)) });
            }
            let last = end(1, &mut nodes, &mut |value| given(own, &["ends", "1"], value, 1.0, place(1)));
            line.stations.push(Station { s: length, node: last });
        }
        for (l, own) in stated.iter().enumerate() {
            for end in 0..2 {
                let joined = !matches!(own.flow.ends[end], Some(FlowEnd::Pressure(_) | FlowEnd::Wall));
                if joined && !meet(model, stated, &mut lines, &ends, (l, end), &mut nodes) {
                    return Err(own.alone(scene, end, ends[l][end].place));
                }
            }
        }
        // numbers of the nodes that are left
        let mut number = vec![usize::MAX; nodes.parent.len()];
        let mut found = Vec::new();
        for line in &mut lines {
            for station in &mut line.stations {
                let root = nodes.root(station.node);
                if number[root] == usize::MAX {
                    number[root] = found.len();
                    found.push(nodes.given[root].map_or(FlowNode::Free, FlowNode::Given));
                }
                station.node = number[root];
            }
        }
        let network = Network { lines, nodes: found };
        if let Some(line) = network.without_pressure() {
            let own = &stated[line];
            let what = format!("no pressure is given along \"{}\" or what it is joined with", own.key);
            let help = "give a pressure at an end, or a drain";
            let number = own.step.to_string();
            return Err(scene.source.error_at(&own.path(&number), what, help));
        }
        let follows = boundaries.iter().any(|boundary| boundary.follows);
        let place = |own: &StatedFlow, at: f64| at * model.interfaces[own.interface].coupling.midplane.length;
        let drains = |own: &StatedFlow| own.flow.drains.iter().map(|drain| place(own, drain.at)).collect();
        let drains = stated.iter().map(drains).collect();
        Ok(BoundFlow { network, boundaries, drains, follows })
    }

    /// The lines in words.
    pub(super) fn lines(&self, model: &Model) -> Vec<FlowAlong> {
        let all = || self.network.lines.iter().flat_map(|line| &line.stations);
        let condition = |node: usize| match self.network.nodes[node] {
            _ if all().filter(|station| station.node == node).count() > 1 => "joined",
            FlowNode::Given(_) => "given",
            FlowNode::Free => "wall",
        };
        let of = |line: &FlowLine| {
            let operator = &model.interfaces[line.interface];
            let last = line.stations.len() - 1;
            FlowAlong {
                interface: operator.name.clone(),
                ends: line_ends(operator).map(|end| end.place),
                conditions: [0, last].map(|k| condition(line.stations[k].node)),
                between: last - 1,
            }
        };
        self.network.lines.iter().map(of).collect()
    }

    /// The given pressures at a load factor; those of a flow `before` in the same network go over to them.
    pub(super) fn given(&self, before: Option<&BoundFlow>, load_factor: f64) -> Result<Vec<f64>> {
        let value = |(i, own): (usize, &Boundary)| {
            if own.follows {
                return own.quantity.at(&FormulaPlace { load_factor, ..own.place });
            }
            let at_end = |own: &Boundary| own.quantity.at(&FormulaPlace { load_factor: 1.0, ..own.place });
            let end = at_end(own)?;
            match before {
                Some(before) => {
                    let start = at_end(&before.boundaries[i])?;
                    Ok(if start == end { end } else { start + load_factor * (end - start) })
                }
                None => Ok(end),
            }
        };
        self.boundaries.iter().enumerate().map(value).collect()
    }

    /// Adds the flow for given pressures to an answer, interface by interface with a weight.
    pub(super) fn add(
        &self,
        model: &Model,
        given: &[f64],
        weight: &dyn Fn(usize) -> f64,
        point: &dyn Fn(usize, usize) -> WaterPoint,
        with_slopes: bool,
        answer: &mut WaterAnswer,
    ) {
        let lines = &self.network.lines;
        let points = |line: &FlowLine| model.interfaces[line.interface].coupling.points.len();
        let jumps: Vec<Vec<f64>> = lines
            .iter()
            .map(|line| (0..points(line)).map(|p| point(line.interface, p).jump[N]).collect())
            .collect();
        let flowing = self.network.flow(&jumps, given, with_slopes);
        let mut rows = Vec::new();
        for (l, line) in lines.iter().enumerate() {
            let (k, weight) = (line.interface, weight(line.interface));
            answer.fields.rates[k].resize(points(line), 0.0);
            answer.fields.apertures[k] = jumps[l].iter().map(|jump| line.aperture + jump.max(0.0)).collect();
            for p in 0..points(line) {
                answer.fields.pressures[k][p] += weight * flowing.pressures[l][p];
                answer.fields.rates[k][p] += weight * flowing.branches[flowing.branch_of[l][p]].rate;
                rows.push((k, p, weight));
            }
            let rates: Vec<f64> = flowing.branches.iter().filter(|of| of.line == l).map(|of| of.rate).collect();
            let ends = &mut answer.fields.ends[k];
            ends.start += weight * rates[0];
            ends.end += weight * rates[rates.len() - 1];
            for (rates, station) in rates.windows(2).zip(&line.stations[1..]) {
                let is_drain = |s: &f64| (s - station.s).abs() <= SAME * line.stations[line.stations.len() - 1].s;
                if self.drains[l].iter().any(is_drain) {
                    ends.drains += weight * (rates[0] - rates[1]);
                }
            }
        }
        if let Some(Slopes { mut matrix }) = flowing.slopes {
            for (i, (.., weight)) in rows.iter().enumerate().filter(|(_, row)| row.2 != 1.0) {
                matrix.row_mut(i).iter_mut().for_each(|slope| *slope *= *weight);
            }
            let points = rows.into_iter().map(|(k, p, _)| (k, p)).collect();
            answer.flow_slopes.push(FlowSlopes { points, slopes: Slopes { matrix } });
        }
    }
}

impl StatedFlow<'_> {
    fn path<'p>(&'p self, number: &'p str) -> [&'p str; 6] {
        ["steps", number, "load", &self.key, "pressure", "flow"]
    }

    /// The refusal of an end at which nothing with flow ends.
    fn alone(&self, scene: &Scene, end: usize, [x, y, _]: [f64; 3]) -> Error {
        let number = self.step.to_string();
        let path = [&self.path(&number)[..], &["ends"]].concat();
        let what = format!("no other interface with flow meets the end at s = {end}, ({x:.6}, {y:.6})");
        scene.source.error_at(&path, what, "give it a pressure, or \"wall\"")
    }

    /// The intervals of an interface, which must be one open line; without stations.
    fn line(&self, scene: &Scene, operator: &InterfaceOperator) -> Result<FlowLine> {
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
        let spans: Vec<[f64; 2]> = match midplane.cells.is_empty() {
            true => midplane.segments.iter().map(|segment| segment.s).collect(),
            false => midplane.cells.iter().map(|cell| cell.s).collect(),
        };
        let points = &operator.coupling.points;
        let each = points.len() / spans.len();
        let interval = |(i, [from, to]): (usize, &[f64; 2])| Interval {
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

/// Ends of the intervals of an interface, in order.
fn spans(operator: &InterfaceOperator) -> Vec<([f64; 2], [[f64; 3]; 2])> {
    let midplane = &operator.coupling.midplane;
    match midplane.cells.is_empty() {
        true => midplane.segments.iter().map(|segment| (segment.s, segment.places)).collect(),
        false => midplane.cells.iter().map(|cell| (cell.s, cell.places)).collect(),
    }
}

fn line_ends(operator: &InterfaceOperator) -> [LineEnd; 2] {
    let spans = spans(operator);
    [0, 1].map(|end| {
        let (s, places) = if end == 0 { spans[0] } else { spans[spans.len() - 1] };
        LineEnd { place: places[end], beside: s[1] - s[0] }
    })
}

/// The place at an arc length, on the chord of its interval.
fn position(operator: &InterfaceOperator, s: f64) -> [f64; 3] {
    let spans = spans(operator);
    let at = spans.partition_point(|(span, _)| span[1] < s).min(spans.len() - 1);
    let ([from, to], [p, q]) = spans[at];
    let share = (s - from) / (to - from);
    plus(p, minus(q, p).map(|d| share * d))
}

/// Joins an end with all ends there that are not walls, else with the line on which it lies; false if there is neither.
fn meet(
    model: &Model,
    stated: &[StatedFlow],
    lines: &mut [FlowLine],
    ends: &[[LineEnd; 2]],
    (l, end): (usize, usize),
    nodes: &mut Nodes,
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
