//! Pairs of chains along one curve, as the coupling sees them.

use midplane::coupling::{Coupling, Gap, JumpScheme, LawPoint, Points, Scheme, Side, Surroundings};
use midplane::error::Result;
use midplane::mesh::Facet;
use midplane::shape::vector::{in_plane, in_space};

/// Points and edges of a mesh's curve.
#[derive(Debug, Clone)]
pub struct Curve {
    pub points: Vec<[f64; 3]>,
    pub edges: Vec<Facet>,
    pub corners: Vec<usize>,
}

impl Curve {
    /// Nodes at the parameters `t` of a curve, with mid-nodes if asked for; a closed one repeats its first parameter at
    /// the end. `forward`: the body lies on the left of growing t.
    pub fn new(
        t: &[f64],
        closed: bool,
        quadratic: bool,
        forward: bool,
        at: &dyn Fn(f64) -> [f64; 2],
    ) -> Curve {
        let n = t.len() - 1;
        let ends = if closed { n } else { n + 1 };
        let mut points: Vec<[f64; 3]> = t[..ends].iter().map(|&t| in_space(at(t))).collect();
        let mut edges = Vec::new();
        for i in 0..n {
            let (mut start, mut end) = (i, (i + 1) % ends);
            if !forward {
                (start, end) = (end, start);
            }
            let mid = if quadratic {
                points.push(in_space(at(0.5 * (t[i] + t[i + 1]))));
                points.len() - 1
            } else {
                end
            };
            let nodes = [start, end, mid];
            edges.push(Facet::edge(&nodes[..if mid == end { 2 } else { 3 }], 0, true));
        }
        // file order is nobody's business
        edges.sort_by_key(|edge| edge.nodes()[0].wrapping_mul(2654435761) % 1009);
        Curve { points, edges, corners: vec![usize::MAX] }
    }

    /// A polygon through points, all of them corners.
    pub fn through(points: &[[f64; 2]], forward: bool) -> Curve {
        let t: Vec<f64> = (0..points.len()).map(|i| i as f64).collect();
        let mut curve = Curve::new(&t, false, false, forward, &|t| points[t as usize]);
        curve.corners = (0..points.len()).collect();
        curve
    }

    pub fn side<'a>(&'a self, name: &'a str, first: usize) -> Side<'a> {
        Side { name, points: &self.points, edges: &self.edges, corners: &self.corners, first }
    }

    /// The same with all nodes numbered backwards and the edges listed backwards.
    pub fn renumbered(&self) -> Curve {
        let n = self.points.len();
        let edge = |edge: &Facet| edge.renumbered(|node| n - 1 - node);
        let mut corners: Vec<usize> =
            self.corners.iter().map(|&c| if c < n { n - 1 - c } else { c }).collect();
        corners.sort_unstable();
        Curve {
            points: self.points.iter().rev().copied().collect(),
            edges: self.edges.iter().rev().map(edge).collect(),
            corners,
        }
    }

    pub fn moved(&self, to: &dyn Fn([f64; 2]) -> [f64; 2]) -> Curve {
        Curve { points: self.points.iter().map(|&p| in_space(to(in_plane(p)))).collect(), ..self.clone() }
    }
}

pub const ALL: [(JumpScheme, Points); 4] = [
    (JumpScheme::Projected, Points::Gauss),
    (JumpScheme::ProjectedLinear, Points::Gauss),
    (JumpScheme::Pointwise, Points::Gauss),
    (JumpScheme::Pointwise, Points::Lobatto),
];

/// Joins curves; nodes of B are numbered after those of A.
pub fn join(a: &[&Curve], b: &[&Curve], (kind, points): (JumpScheme, Points)) -> Result<Coupling> {
    join_with(a, b, Scheme { kind, points, gap: Gap::Closed })
}

pub fn join_with(a: &[&Curve], b: &[&Curve], scheme: Scheme) -> Result<Coupling> {
    let mut first = 0;
    let mut sides = |curves: &[&'_ Curve]| -> Vec<usize> {
        curves
            .iter()
            .map(|curve| {
                first += curve.points.len();
                first - curve.points.len()
            })
            .collect()
    };
    let (first_a, first_b) = (sides(a), sides(b));
    let of_a: Vec<Side> = a.iter().zip(&first_a).map(|(curve, &first)| curve.side("a.side", first)).collect();
    let of_b: Vec<Side> = b.iter().zip(&first_b).map(|(curve, &first)| curve.side("b.side", first)).collect();
    Coupling::build("joint", &of_a, &of_b, scheme, Surroundings::default())
}

/// A displacement field of both sides in the order of the coupling's columns.
pub fn columns(c: &Coupling, u: &[[f64; 2]]) -> Vec<f64> {
    c.sides[0].nodes.iter().chain(&c.sides[1].nodes).flat_map(|&node| u[node]).collect()
}

/// Jumps (n, t) at the law points.
pub fn jumps(c: &Coupling, u: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let a = c.jump.multiply(&columns(c, u));
    let jump = |p: &LawPoint| {
        [0, 1].map(|k| {
            let at = |i: usize| (0..2).map(|d| p.rotation[k][d] * a[2 * i + d]).sum::<f64>();
            p.interpolation.iter().map(|&(i, n)| n * at(i)).sum()
        })
    };
    c.points.iter().map(jump).collect()
}

/// Nodal forces of tractions (n, t) at the law points, by node.
pub fn forces(c: &Coupling, tractions: &[[f64; 2]], nodes: usize) -> Vec<[f64; 2]> {
    let mut q = vec![0.0; c.jump.rows()];
    for (p, t) in c.points.iter().zip(tractions) {
        for &(i, n) in &p.interpolation {
            for d in 0..2 {
                q[2 * i + d] += p.weight * n * (p.rotation[0][d] * t[0] + p.rotation[1][d] * t[1]);
            }
        }
    }
    let mut f = vec![0.0; c.jump.width];
    c.jump.add_transposed(&q, &mut f);
    let mut by_node = vec![[0.0; 2]; nodes];
    for (&node, f) in c.sides[0].nodes.iter().chain(&c.sides[1].nodes).zip(f.chunks_exact(2)) {
        by_node[node][0] += f[0];
        by_node[node][1] += f[1];
    }
    by_node
}

/// Nodal forces of an elastic law for a displacement field.
pub fn respond(c: &Coupling, u: &[[f64; 2]], k: [f64; 2]) -> Vec<[f64; 2]> {
    let tractions: Vec<[f64; 2]> = jumps(c, u).into_iter().map(|r| [k[0] * r[0], k[1] * r[1]]).collect();
    forces(c, &tractions, u.len())
}
