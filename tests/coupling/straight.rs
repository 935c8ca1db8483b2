//! Claim: the coupling of two straight sides is the classical zero-thickness element where they match, and reproduces constant and
//! linear jumps exactly where they do not, whatever is called A, whichever way the interface runs, and at any angle.
//!
//! ```text
//!   ┌─── B ───┐      jump = u_B − u_A,  n from A to B:  r = R (N_B u_B − N_A u_A) on the grid of C
//!   ●──●───●──●      nodes of B
//!   ●───●─●───●      nodes of A         Σ weights = length,  cells of the grid ≤ edges of either side
//!   └─── A ───┘
//! ```

use crate::common::{even, graded};
use midplane::coupling::{Coupling, Gap, JumpScheme, Points, Scheme, Side, Surroundings};
use midplane::mesh::Facet;
use midplane::shape::vector::{in_plane, in_space};
use proptest::prelude::*;

fn side<'a>(name: &'a str, points: &'a [[f64; 3]], edges: &'a [Facet]) -> Side<'a> {
    Side { name, points, edges, corners: &[], first: 0 }
}

fn join(a: Side, b: Side, kind: JumpScheme, points: Points) -> midplane::error::Result<Coupling> {
    Coupling::build("joint", &[a], &[b], Scheme { kind, points, gap: Gap::Closed }, Surroundings::default())
}

/// An interface along a line through `origin` at an angle: nodes of A and B at the given places, B `gap` above A.
struct Line {
    points_a: Vec<[f64; 3]>,
    points_b: Vec<[f64; 3]>,
}

impl Line {
    fn new(s_a: &[f64], s_b: &[f64], degrees: f64, gap: f64) -> Line {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let at = |s: f64, n: f64| [0.3 + s * cos - n * sin, -0.7 + s * sin + n * cos, 0.0];
        Line {
            points_a: s_a.iter().map(|&s| at(s, 0.0)).collect(),
            points_b: s_b.iter().map(|&s| at(s, gap)).collect(),
        }
    }

    /// A lies below: its body is on the left of an edge that runs backwards. B lies above.
    fn couple(&self, kind: JumpScheme, points: Points) -> Coupling {
        let back = edges(self.points_a.len(), true);
        let forth = edges(self.points_b.len(), false);
        let a = side("lower.top", &self.points_a, &back);
        let b = side("upper.bottom", &self.points_b, &forth);
        join(a, b, kind, points).unwrap()
    }

    /// The same interface with A and B exchanged.
    fn couple_swapped(&self, kind: JumpScheme) -> Coupling {
        let back = edges(self.points_a.len(), true);
        let forth = edges(self.points_b.len(), false);
        let a = side("lower.top", &self.points_a, &back);
        let b = side("upper.bottom", &self.points_b, &forth);
        join(b, a, kind, Points::Gauss).unwrap()
    }

    /// Nodal displacements of a field, in the order of the coupling's columns.
    fn displacements(
        &self,
        c: &Coupling,
        swapped: bool,
        a: &dyn Fn([f64; 2]) -> [f64; 2],
        b: &dyn Fn([f64; 2]) -> [f64; 2],
    ) -> Vec<f64> {
        let (first, second, f, g) = if swapped {
            (&self.points_b, &self.points_a, b, a)
        } else {
            (&self.points_a, &self.points_b, a, b)
        };
        let of_a = c.sides[0].nodes.iter().flat_map(|&node| f(in_plane(first[node])));
        let of_b = c.sides[1].nodes.iter().flat_map(|&node| g(in_plane(second[node])));
        of_a.chain(of_b).collect()
    }
}

fn edges(nodes: usize, backwards: bool) -> Vec<Facet> {
    let edge = |i: usize| {
        let (start, end) = if backwards { (i + 1, i) } else { (i, i + 1) };
        Facet::edge(&[start, end], 0, true)
    };
    // file order is nobody's business: interleave from both ends
    let mut order: Vec<usize> = (0..nodes - 1).collect();
    order.sort_by_key(|&i| i.min(nodes - 2 - i));
    order.into_iter().map(edge).collect()
}

/// Jumps (n, t) at the law points.
fn jumps(c: &Coupling, u: &[f64]) -> Vec<[f64; 2]> {
    let a = c.jump.multiply(u);
    let jump = |p: &midplane::coupling::LawPoint| {
        [0, 1].map(|k| {
            p.interpolation
                .iter()
                .map(|&(i, n)| n * (0..2).map(|d| p.rotation[k][d] * a[2 * i + d]).sum::<f64>())
                .sum()
        })
    };
    c.points.iter().map(jump).collect()
}

/// Dense K = Gᵀ Σ w Nᵀ Rᵀ D R N G by the definition.
fn stiffness(c: &Coupling, d: [f64; 2]) -> Vec<Vec<f64>> {
    let n = c.jump.width;
    let mut k = vec![vec![0.0; n]; n];
    let columns: Vec<Vec<[f64; 2]>> = (0..n)
        .map(|j| {
            let mut unit = vec![0.0; n];
            unit[j] = 1.0;
            jumps(c, &unit)
        })
        .collect();
    for (p, point) in c.points.iter().enumerate() {
        for i in 0..n {
            for j in 0..n {
                k[i][j] +=
                    (0..2).map(|m| point.weight * d[m] * columns[i][p][m] * columns[j][p][m]).sum::<f64>();
            }
        }
    }
    k
}

/// Claim: on matched sides both couplings are the classical zero-thickness element (paper eqs. 4–13).
///
/// ```text
///   3 ───── 4 ── …     B = R [−N_α I, −N_β I, N_α I, N_β I],   N_α = (1 − ξ)/2, N_β = (1 + ξ)/2
///   1 ───── 2 ── …     K_e = ∫ Bᵀ D B dL with two Gauss (or Lobatto) points
/// ```
#[test]
fn matched_sides_are_the_classical_element_entry_by_entry() {
    let s = [0.0, 0.4, 1.0, 1.3];
    let d = [3e4, 2e4];
    for degrees in [0.0, 30.0, 200.0] {
        let line = Line::new(&s, &s, degrees, 0.0);
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let r = [[-sin, cos], [cos, sin]]; // rows n and t, t along the line
        for (kind, points) in [
            (JumpScheme::Pointwise, Points::Gauss),
            (JumpScheme::Pointwise, Points::Lobatto),
            (JumpScheme::Projected, Points::Gauss),
            (JumpScheme::Projected, Points::Lobatto),
        ] {
            let places =
                if points == Points::Gauss { [-1.0 / 3f64.sqrt(), 1.0 / 3f64.sqrt()] } else { [-1.0, 1.0] };
            let coupling = line.couple(kind, points);
            let k = stiffness(&coupling, d);
            let n = s.len();
            let mut exact = vec![vec![0.0; 4 * n]; 4 * n];
            // columns of the coupling: A's nodes and B's nodes along the chain
            for e in 0..n - 1 {
                let half = 0.5 * (s[e + 1] - s[e]);
                for xi in places {
                    let (alpha, beta) = (0.5 * (1.0 - xi), 0.5 * (1.0 + xi));
                    let mut b = [[0.0; 8]; 2];
                    for (block, value) in [-alpha, -beta, alpha, beta].into_iter().enumerate() {
                        for m in 0..2 {
                            for x in 0..2 {
                                b[m][2 * block + x] = r[m][x] * value;
                            }
                        }
                    }
                    let dof = |i: usize| [2 * e, 2 * e + 2, 2 * (n + e), 2 * (n + e + 1)][i / 2] + i % 2;
                    for i in 0..8 {
                        for j in 0..8 {
                            let sum: f64 = (0..2).map(|m| b[m][i] * d[m] * b[m][j]).sum();
                            exact[dof(i)][dof(j)] += half * sum;
                        }
                    }
                }
            }
            let along = |nodes: &[usize]| nodes.windows(2).all(|w| w[0] < w[1]);
            assert!(along(&coupling.sides[0].nodes) && along(&coupling.sides[1].nodes));
            for i in 0..4 * n {
                for j in 0..4 * n {
                    assert!(
                        (k[i][j] - exact[i][j]).abs() < 1e-12 * d[0],
                        "{kind:?} {points:?} {degrees}°: {i} {j}"
                    );
                }
            }
        }
    }
}

const EDGES: [(usize, usize); 6] = [(1, 1), (5, 8), (7, 12), (1, 37), (24, 25), (40, 5)];

/// Claim: constant and linear jumps are reproduced exactly, at any ratio of edges, angle and (small) gap.
#[test]
fn constant_and_linear_jumps_are_reproduced() {
    let a = |x: [f64; 2]| [1e-3 + 2e-3 * x[0] - 1e-3 * x[1], -2e-3 + 0.5e-3 * x[0] + 3e-3 * x[1]];
    let b = |x: [f64; 2]| [-4e-3 - 1e-3 * x[0] + 2e-3 * x[1], 1e-3 + 4e-3 * x[0] - 2e-3 * x[1]];
    for (n_a, n_b) in EDGES {
        for degrees in [0.0, 77.0] {
            let line = Line::new(&even(0.0, 2.0, n_a), &graded(0.0, 2.0, n_b.max(2), 5.0), degrees, 0.0);
            for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
                let c = line.couple(kind, Points::Gauss);
                let got = jumps(&c, &line.displacements(&c, false, &a, &b));
                for (point, jump) in c.points.iter().zip(got) {
                    let [x, y, _] = point.position;
                    let (ua, ub) = (a([x, y]), b([x, y]));
                    for m in 0..2 {
                        let exact: f64 = (0..2).map(|d| point.rotation[m][d] * (ub[d] - ua[d])).sum();
                        assert!((jump[m] - exact).abs() < 1e-15, "{kind:?} {n_a}:{n_b} {degrees}°");
                    }
                }
                let length: f64 = c.points.iter().map(|p| p.weight).sum();
                assert!((length / 2.0 - 1.0).abs() < 1e-14);
                let segments: f64 = c.midplane.segments.iter().map(|g| g.s[1] - g.s[0]).sum();
                assert!((segments / 2.0 - 1.0).abs() < 1e-14);
            }
        }
    }
}

/// Claim: a rigid motion of the whole model gives no jump, also where the faces are a little apart.
#[test]
fn rigid_motions_give_no_jump() {
    for gap in [0.0, 1e-4, -1e-3] {
        for (n_a, n_b) in EDGES {
            let line = Line::new(&even(0.0, 2.0, n_a), &even(0.0, 2.0, n_b), 20.0, gap);
            for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
                let c = line.couple(kind, Points::Gauss);
                let rigid = |x: [f64; 2]| [0.3 - 0.1 * x[1], -0.2 + 0.1 * x[0]];
                for jump in jumps(&c, &line.displacements(&c, false, &rigid, &rigid)) {
                    assert!(
                        jump[0].abs().max(jump[1].abs()) < 2e-15,
                        "{kind:?} {n_a}:{n_b} gap {gap}: {jump:?}"
                    );
                }
            }
        }
    }
}

/// Claim: the grid has at most as many cells as the coarser side, and is that side where the other is finer.
#[test]
fn the_grid_is_as_fine_as_the_locally_coarser_side() {
    let fine = even(0.0, 1.0, 40);
    let coarse = graded(0.0, 1.0, 7, 3.0);
    let c = Line::new(&fine, &coarse, 0.0, 0.0).couple(JumpScheme::Projected, Points::Gauss);
    assert!(c.midplane.grid_nodes <= coarse.len());
    for (n_a, n_b) in EDGES {
        let c = Line::new(&even(0.0, 1.0, n_a), &even(0.0, 1.0, n_b), 0.0, 0.0)
            .couple(JumpScheme::Projected, Points::Gauss);
        assert!(c.midplane.grid_nodes - 1 <= n_a.min(n_b), "{n_a}:{n_b}");
    }
    // nested: every node of the coarse side is a node of the fine one, so the grid is the coarse side
    let c = Line::new(&even(0.0, 1.0, 40), &even(0.0, 1.0, 5), 0.0, 0.0)
        .couple(JumpScheme::Projected, Points::Gauss);
    let ends = c.midplane.cells.iter().map(|cell| cell.s);
    for (got, exact) in ends.zip(even(0.0, 1.0, 5).windows(2)) {
        assert!((got[0] - exact[0]).abs() < 1e-15 && (got[1] - exact[1]).abs() < 1e-15);
    }
    assert_eq!(c.midplane.cells.len(), 5);
    // on a part of the length only the common part is joined
    let c = Line::new(&even(0.0, 1.0, 10), &even(0.3, 1.7, 9), 0.0, 0.0)
        .couple(JumpScheme::Projected, Points::Gauss);
    assert!((c.midplane.length - 0.7).abs() < 1e-15);
}

fn places() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.02f64..1.0, 1..25).prop_map(|steps| {
        let sums: Vec<f64> = std::iter::once(0.0)
            .chain(steps.iter().scan(0.0, |sum, step| {
                *sum += step;
                Some(*sum)
            }))
            .collect();
        sums.iter().map(|s| 2.0 * s / sums[sums.len() - 1]).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    /// Claim: exchanging A and B, or turning the interface around, gives the same operator.
    #[test]
    fn labels_do_not_matter(s_a in places(), s_b in places(), degrees in 0.0f64..360.0) {
        let line = Line::new(&s_a, &s_b, degrees, 0.0);
        let a = |x: [f64; 2]| [(3.0 * x[0]).sin(), x[0] * x[1]];
        let b = |x: [f64; 2]| [x[1] * x[1], (2.0 * x[1] - x[0]).cos()];
        for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
            let (one, two) = (line.couple(kind, Points::Gauss), line.couple_swapped(kind));
            let first = jumps(&one, &line.displacements(&one, false, &a, &b));
            let mut second = jumps(&two, &line.displacements(&two, true, &a, &b));
            second.reverse(); // the walk along C turns with the normal
            prop_assert_eq!(first.len(), second.len());
            for (p, q) in first.iter().zip(&second) {
                for m in 0..2 {
                    prop_assert!((p[m] - q[m]).abs() < 1e-12, "{kind:?} {p:?} {q:?}");
                }
            }
        }
    }

    /// Claim: weights are positive and sum to the length; there are no more grid cells than edges of either side.
    #[test]
    fn weights_are_positive(s_a in places(), s_b in places()) {
        let line = Line::new(&s_a, &s_b, 0.0, 0.0);
        for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
            let c = line.couple(kind, Points::Gauss);
            prop_assert!(c.points.iter().all(|p| p.weight > 0.0));
            prop_assert!((c.points.iter().map(|p| p.weight).sum::<f64>() - 2.0).abs() < 1e-13);
            prop_assert!(c.points.windows(2).all(|w| w[0].s < w[1].s));
            prop_assert!(c.midplane.grid_nodes <= s_a.len().min(s_b.len()));
        }
    }
}

/// Claim: where the outermost edges of both ends are alike the next ones decide from which end the grid is laid, whatever is called A and
/// whichever way an interface runs.
#[test]
fn the_grid_is_laid_from_the_same_end_where_the_outermost_edges_are_alike() {
    let s_a = [0.0, 0.3, 0.45, 1.2, 1.35, 1.7, 2.0];
    let s_b = [0.0, 0.3, 0.8, 1.0, 1.5, 1.7, 2.0];
    let turned = |s: &[f64]| s.iter().rev().map(|s| 2.0 - s).collect::<Vec<_>>();
    let ends = |s_a: &[f64], s_b: &[f64]| {
        let c = Line::new(s_a, s_b, 0.0, 0.0).couple(JumpScheme::Projected, Points::Gauss);
        c.midplane.cells.iter().map(|cell| cell.s[0]).chain([2.0]).collect::<Vec<_>>()
    };
    // the second edges: 0.15 and 0.5 at the start, 0.35 and 0.2 at the end, so from the start
    let exact = [0.0, 0.3, 0.8, 1.2, 1.5, 1.7, 2.0];
    for (got, exact) in [
        (ends(&s_a, &s_b), exact.to_vec()),
        (ends(&s_b, &s_a), exact.to_vec()),
        (ends(&turned(&s_a), &turned(&s_b)), turned(&exact)),
        (ends(&turned(&s_b), &turned(&s_a)), turned(&exact)),
    ] {
        let off = got.iter().zip(&exact).map(|(got, exact)| (got - exact).abs()).fold(0.0, f64::max);
        assert!(got.len() == exact.len() && off < 1e-12, "{got:?} {exact:?}");
    }
}

/// Claim: what cannot be joined is refused with the reason and its size.
#[test]
fn sides_that_do_not_face_each_other_are_refused() {
    let refusal = |points_a: &[[f64; 3]], points_b: &[[f64; 3]], turn: bool| {
        let (back, forth) = (edges(points_a.len(), true), edges(points_b.len(), turn));
        let a = side("lower.top", points_a, &back);
        let b = side("upper.bottom", points_b, &forth);
        join(a, b, JumpScheme::Projected, Points::Gauss).unwrap_err().to_string()
    };
    let line = |x0: f64, y: f64| [[x0, y], [x0 + 0.5, y], [x0 + 1.0, y]];
    for (a, b, turn, expected) in [
        (line(0.0, 0.0), line(0.0, 0.1), false, "gap of 1.000e-1 over a length of 1.000e0"),
        (line(0.0, 0.0), line(0.0, -0.1), false, "overlap of 1.000e-1"),
        (line(0.0, 0.0), line(2.0, 0.0), false, "no common length, they are 1.000e0 apart"),
        (line(0.0, 0.0), line(1.0, 0.0), false, "no common length"),
        (line(0.0, 0.0), line(0.0, 0.0), true, "do not face each other"),
        (
            line(0.0, 0.0),
            [[0.0, 0.0], [0.5, 0.01], [1.0, 0.0]],
            false,
            "gap of 1.000e-2 over a length of 1.000e0, near (0.500000, 0.005000)",
        ),
    ] {
        let message = refusal(&a.map(in_space), &b.map(in_space), turn);
        assert!(message.starts_with("interface joint: ") && message.contains(expected), "{message}");
    }
}

/// A side of quadratic edges between the given places along y = 0.3, as points and edges; `backwards` for side A.
fn quadratic_side(s: &[f64], backwards: bool) -> (Vec<[f64; 3]>, Vec<Facet>) {
    let mids = s.windows(2).map(|w| 0.5 * (w[0] + w[1]));
    let points = s.iter().copied().chain(mids).map(|s| [s, 0.3, 0.0]).collect();
    let edge = |i: usize| {
        let (start, end) = if backwards { (i + 1, i) } else { (i, i + 1) };
        Facet::edge(&[start, end, s.len() + i], 0, true)
    };
    (points, (0..s.len() - 1).rev().map(edge).collect())
}

fn couple(
    a: &(Vec<[f64; 3]>, Vec<Facet>),
    b: &(Vec<[f64; 3]>, Vec<Facet>),
    kind: JumpScheme,
    points: Points,
) -> Coupling {
    let lower = side("lower.top", &a.0, &a.1);
    let upper = side("upper.bottom", &b.0, &b.1);
    join(lower, upper, kind, points).unwrap()
}

/// Displacements in the order of the columns.
fn columns(
    c: &Coupling,
    a: &[[f64; 3]],
    b: &[[f64; 3]],
    f: impl Fn(f64) -> f64,
    g: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let of_a = c.sides[0].nodes.iter().flat_map(|&i| [0.0, f(a[i][0])]);
    of_a.chain(c.sides[1].nodes.iter().flat_map(|&i| [0.0, g(b[i][0])])).collect()
}

/// Claim: on matched quadratic sides both couplings are the six-node element with three Gauss (or Lobatto) points.
#[test]
fn matched_quadratic_sides_are_the_classical_six_node_element() {
    let s = [0.0, 0.4, 1.0, 1.3];
    let (a, b) = (quadratic_side(&s, true), quadratic_side(&s, false));
    for (points, rule) in [
        (Points::Gauss, [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)]),
        (Points::Lobatto, [(-1.0, 1.0 / 3.0), (0.0, 4.0 / 3.0), (1.0, 1.0 / 3.0)]),
    ] {
        for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
            let c = couple(&a, &b, kind, points);
            let k = stiffness(&c, [3.0, 2.0]);
            let n = 7; // nodes of a side: 4 ends, 3 mid-nodes
            let mut exact = vec![vec![0.0; 4 * n]; 4 * n];
            for e in 0..3 {
                for (xi, weight) in rule {
                    let shape = [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi];
                    let w = 0.5 * (s[e + 1] - s[e]) * weight;
                    let nodes = [e, e + 1, 4 + e];
                    let entry = |i: usize| {
                        if i < 3 { (nodes[i], -shape[i]) } else { (n + nodes[i - 3], shape[i - 3]) }
                    };
                    for i in 0..6 {
                        for j in 0..6 {
                            let ((p, np), (q, nq)) = (entry(i), entry(j));
                            exact[2 * p][2 * q] += w * 2.0 * np * nq; // x is tangential
                            exact[2 * p + 1][2 * q + 1] += w * 3.0 * np * nq;
                        }
                    }
                }
            }
            for i in 0..4 * n {
                for j in 0..4 * n {
                    assert!((k[i][j] - exact[i][j]).abs() < 1e-12, "{kind:?} {points:?}: {i} {j}");
                }
            }
        }
    }
}

/// Claim: quadratic sides reproduce quadratic jumps on any two meshes, mixed sides linear ones; three law points on
/// quadratic cells, two on linear ones.
#[test]
fn quadratic_jumps_are_reproduced_by_quadratic_sides() {
    for (n_a, n_b) in EDGES {
        let (s_a, s_b) = (even(0.0, 2.0, n_a), graded(0.0, 2.0, n_b.max(2), 3.0));
        let (a, b) = (quadratic_side(&s_a, true), quadratic_side(&s_b, false));
        let straight = (s_b.iter().map(|&s| [s, 0.3, 0.0]).collect::<Vec<_>>(), edges(s_b.len(), false));
        for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
            let c = couple(&a, &b, kind, Points::Gauss);
            let (f, g) = (|x: f64| 0.1 - x + 0.5 * x * x, |x: f64| 0.3 * x - 0.2 * x * x);
            for (point, jump) in c.points.iter().zip(jumps(&c, &columns(&c, &a.0, &b.0, f, g))) {
                assert!((jump[0] - (g(point.position[0]) - f(point.position[0]))).abs() < 1e-13, "{kind:?}");
            }
            if kind == JumpScheme::Projected {
                assert_eq!(c.points.len(), 3 * (c.midplane.grid_nodes - 1));
            }
            let mixed = couple(&a, &straight, kind, Points::Gauss);
            let (f, g) = (|x: f64| 0.1 - x, |x: f64| 0.3 * x);
            for (point, jump) in
                mixed.points.iter().zip(jumps(&mixed, &columns(&mixed, &a.0, &straight.0, f, g)))
            {
                assert!((jump[0] - (g(point.position[0]) - f(point.position[0]))).abs() < 1e-13, "{kind:?}");
            }
            if kind == JumpScheme::Projected {
                assert_eq!(mixed.points.len(), 2 * (mixed.midplane.grid_nodes - 1));
            }
        }
    }
}

/// Claim: the mid-plane of a curved edge and a straight one is half as curved, and as long as that parabola: for a chord c and a sagitta h,
/// √(c² + 16 h²)/2 + c²/(8 h) asinh(4 h/c).
#[test]
fn between_a_curved_and_a_straight_edge_the_length_is_that_of_a_parabola() {
    let chord = 2.0;
    for sagitta in [0.1, -0.1] {
        let curved = quadratic_side(&[0.0, chord], true);
        let bulge = |p: &[f64; 3]| [p[0], p[1] + sagitta * p[0] * (chord - p[0]) * 4.0 / chord.powi(2), 0.0];
        let curved: (Vec<_>, _) = (curved.0.iter().map(bulge).collect(), curved.1);
        let straight: (Vec<_>, _) = ([0.0, chord].map(|x| [x, 0.3, 0.0]).to_vec(), edges(2, false));
        let h = 0.5 * sagitta.abs();
        let exact = 0.5 * chord.hypot(4.0 * h) + chord.powi(2) / (8.0 * h) * (4.0 * h / chord).asinh();
        for kind in [JumpScheme::Pointwise, JumpScheme::Projected] {
            let c = couple(&curved, &straight, kind, Points::Gauss);
            assert!((c.midplane.length / exact - 1.0).abs() < 1e-6, "{} and {exact}", c.midplane.length);
        }
    }
}

/// Claim: at a law point a side moves as its nodes make its edges move: fields that edges carry exactly come out, on unmatched sides.
#[test]
fn sides_move_as_the_fields_at_their_nodes() {
    let line = Line::new(&even(0.0, 2.0, 7), &graded(0.0, 2.0, 10, 1.4), 33.0, 0.0);
    let fields: [fn([f64; 2]) -> [f64; 2]; 2] =
        [|[x, y]| [0.3 + x - 2.0 * y, 0.1 - 0.4 * x + y], |[x, y]| [-1.0 + 0.5 * y, 2.0 * x - 3.0 * y]];
    for (kind, points) in [(JumpScheme::Projected, Points::Lobatto), (JumpScheme::Pointwise, Points::Gauss)] {
        let c = line.couple(kind, points);
        for (side, nodes) in [&line.points_a, &line.points_b].into_iter().enumerate() {
            let u: Vec<f64> = nodes.iter().flat_map(|&p| fields[side](in_plane(p))).collect();
            for point in &c.points {
                let [x, y, z] = c.displacement(side, point, &u);
                let exact = fields[side](in_plane(point.position));
                let off = (x - exact[0]).hypot(y - exact[1]);
                assert!(off < 1e-13 && z == 0.0, "{kind:?} {side}: {off:e}");
            }
        }
    }
}
