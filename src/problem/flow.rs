//! Flow along interfaces, bound: which ends meet, which pressures are given, and the network that this makes.

use super::flow_lines::{FlowNodes, LineEnd, SAME, StatedFlow, line_ends, meet, position};
use super::quantity::Quantity;
use super::water_answer::{FlowAlong, FlowSlopes, WaterAnswer, WaterPoint};
use crate::assembly::Model;
use crate::error::Result;
use crate::law::N;
use crate::scene::{Drain, FlowEnd, FormulaPlace, Scene, Value, Variable};
use crate::water::{FlowLine, FlowNode, JumpSlopes, Network, Station};

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

impl BoundFlow {
    /// The network of all flows in force in a step.
    pub(super) fn new(scene: &Scene, model: &Model, step: usize, stated: &[StatedFlow]) -> Result<BoundFlow> {
        let mut lines = Vec::with_capacity(stated.len());
        for own in stated {
            lines.push(own.line(scene, &model.interfaces[own.interface])?);
        }
        let mut nodes = FlowNodes::default();
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
            let mut drains: Vec<(usize, &Drain)> = own.flow.drains.iter().enumerate().collect();
            drains.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
            let end = |end: usize, nodes: &mut FlowNodes, given: &mut dyn FnMut(&Value) -> usize| {
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
                let boundary = given(own, &["drains", &number, "pressure"], &drain.pressure, drain.at, at);
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
        let mut number = vec![usize::MAX; nodes.len()];
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
            let rates: Vec<f64> =
                flowing.branches.iter().filter(|of| of.line == l).map(|of| of.rate).collect();
            let ends = &mut answer.fields.ends[k];
            ends.start += weight * rates[0];
            ends.end += weight * rates[rates.len() - 1];
            for (rates, station) in rates.windows(2).zip(&line.stations[1..]) {
                let is_drain =
                    |s: &f64| (s - station.s).abs() <= SAME * line.stations[line.stations.len() - 1].s;
                if self.drains[l].iter().any(is_drain) {
                    ends.drains += weight * (rates[0] - rates[1]);
                }
            }
        }
        if let Some(JumpSlopes { mut matrix }) = flowing.slopes {
            for (i, (.., weight)) in rows.iter().enumerate().filter(|(_, row)| row.2 != 1.0) {
                matrix.row_mut(i).iter_mut().for_each(|slope| *slope *= *weight);
            }
            let points = rows.into_iter().map(|(k, p, _)| (k, p)).collect();
            answer.flow_slopes.push(FlowSlopes { points, slopes: JumpSlopes { matrix } });
        }
    }
}
