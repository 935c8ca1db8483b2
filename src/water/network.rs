//! A network of lines with flow: nodes with a given pressure or none, and branches between them.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::branch::FlowBranch;
use super::line::FlowLine;

/// A node of a network: with a given pressure, or with rates that sum to zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlowNode {
    /// Its pressure is given, in this place of the list.
    Given(usize),
    /// Nothing leaves it.
    Free,
}

/// Lines and their nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    /// The lines.
    pub lines: Vec<FlowLine>,
    /// The nodes.
    pub nodes: Vec<FlowNode>,
}

/// Flow from one node of a line to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchFlow {
    /// Number of the line.
    pub line: usize,
    /// Nodes at its start and end, of which the start has the smaller s.
    pub nodes: [usize; 2],
    /// Rate for a unit thickness, positive towards larger s [length² / time].
    pub rate: f64,
}

/// Steady flow for given apertures.
#[derive(Debug, Clone)]
pub struct Flowing {
    /// Pressures at the law points of every line [stress].
    pub pressures: Vec<Vec<f64>>,
    /// FlowBranch of every law point of every line.
    pub branch_of: Vec<Vec<usize>>,
    /// The branches, line by line from s = 0 to s = 1.
    pub branches: Vec<BranchFlow>,
    /// Pressures at the nodes [stress].
    pub nodes: Vec<f64>,
    /// Derivatives of the pressures, if they were asked for.
    pub slopes: Option<JumpSlopes>,
}

/// Derivatives of the pressures at all law points, line after line, by the normal jumps there [stress / length].
#[derive(Debug, Clone)]
pub struct JumpSlopes {
    /// Row: pressure; column: normal jump.
    pub matrix: Mat<f64>,
}

impl Network {
    /// Number of a line to whose nodes no pressure reaches; none if all have one.
    pub fn without_pressure(&self) -> Option<usize> {
        let mut reached: Vec<bool> = self.nodes.iter().map(|node| *node != FlowNode::Free).collect();
        let mut again = true;
        while again {
            again = false;
            for line in &self.lines {
                let any = line.stations.iter().any(|station| reached[station.node]);
                for station in line.stations.iter().filter(|_| any) {
                    again |= !std::mem::replace(&mut reached[station.node], true);
                }
            }
        }
        self.lines.iter().position(|line| line.stations.iter().any(|station| !reached[station.node]))
    }

    /// First number of every line's law points over all lines, and their count.
    fn first_points(&self) -> Vec<usize> {
        let mut first = vec![0];
        for line in &self.lines {
            let points: usize = line.intervals.iter().map(|interval| interval.places.len()).sum();
            first.push(first[first.len() - 1] + points);
        }
        first
    }

    /// The flow for normal jumps at the law points of every line and the given pressures.
    pub fn flow(&self, jumps: &[Vec<f64>], given: &[f64], with_slopes: bool) -> Flowing {
        let first = self.first_points();
        let branches: Vec<FlowBranch> = (self.lines.iter().enumerate())
            .flat_map(|(l, line)| line.branches(l, &jumps[l], first[l]))
            .collect();
        let free: Vec<Option<usize>> = {
            let mut count = 0;
            let number = |node: &FlowNode| {
                (*node == FlowNode::Free).then(|| {
                    count += 1;
                    count - 1
                })
            };
            self.nodes.iter().map(number).collect()
        };
        let unknowns = free.iter().flatten().count();
        let conductance = |branch: &FlowBranch| 1.0 / (branch.twelve_mu * branch.whole);
        // Σ g (p_i − p_j) = 0, every row over the sum of its conductances
        let mut scale = vec![0.0; unknowns];
        for branch in &branches {
            branch.nodes.iter().filter_map(|node| free[*node]).for_each(|i| scale[i] += conductance(branch));
        }
        let (mut matrix, mut right) = (Mat::<f64>::zeros(unknowns, unknowns), Mat::<f64>::zeros(unknowns, 1));
        for branch in &branches {
            let [u, v] = branch.nodes;
            for (here, there) in [(u, v), (v, u)] {
                let Some(i) = free[here] else { continue };
                let g = conductance(branch) / scale[i];
                matrix[(i, i)] += g;
                match (free[there], self.nodes[there]) {
                    (Some(j), _) => matrix[(i, j)] -= g,
                    (_, FlowNode::Given(value)) => right[(i, 0)] += g * given[value],
                    _ => {}
                }
            }
        }
        let lu = (unknowns > 0).then(|| matrix.partial_piv_lu());
        if let Some(lu) = &lu {
            lu.solve_in_place(right.as_mut());
        }
        let nodes: Vec<f64> = (self.nodes.iter().zip(&free))
            .map(|(node, free)| match (node, free) {
                (FlowNode::Given(value), _) => given[*value],
                (_, Some(i)) => right[(*i, 0)],
                _ => 0.0,
            })
            .collect();
        let mut pressures: Vec<Vec<f64>> =
            first.windows(2).map(|pair| vec![0.0; pair[1] - pair[0]]).collect();
        let mut branch_of: Vec<Vec<usize>> = pressures.iter().map(|of| vec![0; of.len()]).collect();
        for (b, branch) in branches.iter().enumerate() {
            let [p, q] = branch.nodes.map(|node| nodes[node]);
            for at in &branch.points {
                let place = at.point - first[branch.line];
                pressures[branch.line][place] = p - (p - q) * (at.part / branch.whole);
                branch_of[branch.line][place] = b;
            }
        }
        let slopes = with_slopes.then(|| {
            let mut by_resistance = Mat::<f64>::zeros(unknowns, branches.len());
            for (b, branch) in branches.iter().enumerate() {
                let [u, v] = branch.nodes;
                let drop = (nodes[u] - nodes[v]) * conductance(branch) / branch.whole;
                for (here, sign) in [(u, 1.0), (v, -1.0)] {
                    if let Some(i) = free[here] {
                        by_resistance[(i, b)] += sign * drop / scale[i];
                    }
                }
            }
            if let Some(lu) = &lu {
                lu.solve_in_place(by_resistance.as_mut());
            }
            slopes(&branches, &nodes, &free, &by_resistance, first[self.lines.len()])
        });
        let flow = |branch: &FlowBranch| {
            let [p, q] = branch.nodes.map(|node| nodes[node]);
            BranchFlow { line: branch.line, nodes: branch.nodes, rate: (p - q) * conductance(branch) }
        };
        Flowing { pressures, branch_of, branches: branches.iter().map(flow).collect(), nodes, slopes }
    }
}

/// dp = dp_u (1 − θ) + dp_v θ − (p_u − p_v) dθ with θ = Y_l/Y.
fn slopes(
    branches: &[FlowBranch],
    nodes: &[f64],
    free: &[Option<usize>],
    by_resistance: &Mat<f64>,
    points: usize,
) -> JumpSlopes {
    let mut matrix = Mat::<f64>::zeros(points, points);
    for branch in branches {
        let [u, v] = branch.nodes;
        let drop = nodes[u] - nodes[v];
        for at in &branch.points {
            let theta = at.part / branch.whole;
            for (c, other) in branches.iter().enumerate() {
                let by = |node: usize| free[node].map_or(0.0, |i| by_resistance[(i, c)]);
                let by_whole = (1.0 - theta) * by(u) + theta * by(v);
                if by_whole != 0.0 {
                    other.by_jump.iter().for_each(|&(m, slope)| matrix[(at.point, m)] += by_whole * slope);
                }
            }
            if drop == 0.0 {
                continue;
            }
            for (k, &(m, slope)) in branch.by_jump.iter().enumerate() {
                let before = if k < at.before { slope } else { 0.0 };
                matrix[(at.point, m)] -= drop * (before - theta * slope) / branch.whole;
            }
            at.own.iter().for_each(|&(m, slope)| matrix[(at.point, m)] -= drop * slope / branch.whole);
        }
    }
    JumpSlopes { matrix }
}

#[cfg(test)]
mod tests {
    use super::super::interval::Interval;
    use super::super::line::Station;
    use super::*;

    fn line(interface: usize, stations: &[(f64, usize)]) -> FlowLine {
        let places = vec![0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()];
        let intervals =
            (0..3).map(|k| Interval { length: [0.5, 0.3, 0.7][k], first: 2 * k, places: places.clone() });
        FlowLine {
            interface,
            aperture: 0.2,
            viscosity: 0.25,
            intervals: intervals.collect(),
            stations: stations.iter().map(|&(s, node)| Station { s, node }).collect(),
        }
    }

    /// A T of three lines whose branches meet in node 3, a drain in the last line at node 4, and a wall at node 5.
    fn tee() -> Network {
        Network {
            lines: vec![
                line(0, &[(0.0, 0), (1.5, 3)]),
                line(1, &[(0.0, 3), (1.5, 1)]),
                line(2, &[(0.0, 3), (0.6, 4), (1.0, 2), (1.5, 5)]),
            ],
            nodes: vec![
                FlowNode::Given(0),
                FlowNode::Given(1),
                FlowNode::Free,
                FlowNode::Free,
                FlowNode::Given(2),
                FlowNode::Free,
            ],
        }
    }

    fn jumps() -> Vec<Vec<f64>> {
        let at = |l: usize, p: usize| 0.3 * ((1 + l) as f64 * (1.0 + p as f64)).sin() + 0.05;
        (0..3).map(|l| (0..6).map(|p| at(l, p)).collect()).collect()
    }

    #[test]
    fn rates_sum_to_nothing_at_free_nodes_and_nothing_flows_to_a_wall() {
        let network = tee();
        let flowing = network.flow(&jumps(), &[5.0, 1.0, -2.0], false);
        let mut sums = [0.0; 6];
        for branch in &flowing.branches {
            sums[branch.nodes[0]] -= branch.rate;
            sums[branch.nodes[1]] += branch.rate;
        }
        let largest = flowing.branches.iter().map(|branch| branch.rate.abs()).fold(0.0, f64::max);
        for node in [2, 3, 5] {
            assert!(sums[node].abs() < 1e-14 * largest, "{sums:?}");
        }
        assert!((flowing.nodes[5] - flowing.nodes[4]).abs() < 1e-15 * 2.0);
        assert!(flowing.branches[2..].iter().any(|branch| branch.rate.abs() > 0.1 * largest));
    }

    #[test]
    fn slopes_are_those_of_differences() {
        let (network, given) = (tee(), [5.0, 1.0, -2.0]);
        let flowing = network.flow(&jumps(), &given, true);
        let slopes = flowing.slopes.unwrap().matrix;
        let flat = |jumps: &[Vec<f64>]| network.flow(jumps, &given, false).pressures.concat();
        for m in 0..18 {
            let moved = |by: f64| {
                let mut jumps = jumps();
                jumps[m / 6][m % 6] += by;
                flat(&jumps)
            };
            let (up, down) = (moved(1e-6), moved(-1e-6));
            for l in 0..18 {
                let differences = (up[l] - down[l]) / 2e-6;
                let error = (slopes[(l, m)] - differences).abs();
                assert!(error < 2e-7, "d p{l} / d r{m}: {} and {differences}", slopes[(l, m)]);
            }
        }
    }

    #[test]
    fn uniform_pipes_share_the_flow_as_their_cubes_say() {
        // all closed: three equal pipes of 1.5, the third with the drain at 0.6
        let network = tee();
        let flowing = network.flow(&vec![vec![-1.0; 6]; 3], &[5.0, 1.0, -2.0], false);
        let g = |length: f64| 0.2f64.powi(3) / (12.0 * 0.25 * length);
        let middle = (5.0 * g(1.5) + 1.0 * g(1.5) - 2.0 * g(0.6)) / (2.0 * g(1.5) + g(0.6));
        assert!((flowing.nodes[3] - middle).abs() < 1e-14, "{:?} {middle}", flowing.nodes);
        assert!((flowing.branches[0].rate - (5.0 - middle) * g(1.5)).abs() < 1e-15);
    }
}
