//! Claim: on straight, curved, kinked, graded and closed sides labels, place and size do not matter, rigid motions give no jump, and
//! nodal forces balance in force and moment.
//!
//! ```text
//!   u = c + ω × x of both sides    r = 0
//!   u_B − u_A = c                  r = R c
//!   forces of any tractions        Σ f = 0,  Σ x × f = 0
//! ```

use std::f64::consts::PI;

use crate::common::chains::*;
use midplane::coupling::Coupling;
use midplane::shape::vector::in_plane;
use proptest::prelude::*;

/// A curve by its shape, scaled to a length of about one.
#[derive(Debug, Clone, Copy)]
enum JumpScheme {
    Straight,
    Arc(f64),
    Wave(f64),
    Circle,
    /// Two straight legs that turn by an angle.
    Kinked(f64),
}

impl JumpScheme {
    fn at(self, t: f64) -> [f64; 2] {
        match self {
            JumpScheme::Straight => [t, 0.3 * t],
            JumpScheme::Arc(angle) => {
                let (sin, cos) = (angle * (t - 0.5)).sin_cos();
                [sin / angle, cos / angle]
            }
            JumpScheme::Wave(height) => [t, height * (2.0 * PI * t).sin()],
            JumpScheme::Circle => {
                let (sin, cos) = (2.0 * PI * t).sin_cos();
                [cos / PI, -sin / PI]
            }
            JumpScheme::Kinked(turn) => {
                let (sin, cos) = turn.sin_cos();
                if t <= 0.5 { [t, 0.0] } else { [0.5 + (t - 0.5) * cos, (t - 0.5) * sin] }
            }
        }
    }

    fn closed(self) -> bool {
        matches!(self, JumpScheme::Circle)
    }

    /// Parameters of the nodes from random steps; the kink is a node.
    fn nodes(self, steps: &[f64]) -> Vec<f64> {
        let sum: f64 = steps.iter().sum();
        let mut t = vec![0.0];
        steps.iter().for_each(|step| t.push(t[t.len() - 1] + step / sum));
        let last = t.len() - 1;
        t[last] = 1.0;
        if let JumpScheme::Kinked(_) = self {
            let nearest = (1..last).min_by(|&i, &j| (t[i] - 0.5).abs().total_cmp(&(t[j] - 0.5).abs()));
            let nearest = nearest.unwrap_or(0);
            let at = t[nearest];
            t.iter_mut().for_each(|t| {
                *t = if *t <= at { 0.5 * *t / at } else { 1.0 - 0.5 * (1.0 - *t) / (1.0 - at) }
            });
        }
        t
    }
}

#[derive(Debug, Clone)]
struct Pair {
    kind: JumpScheme,
    t: [Vec<f64>; 2],
    quadratic: [bool; 2],
}

impl Pair {
    fn curve(&self, side: usize) -> Curve {
        let (t, kind) = (&self.t[side], self.kind);
        // a closed side starts somewhere else on B
        let shift = if kind.closed() { 0.37 * side as f64 } else { 0.0 };
        let t: Vec<f64> = t.iter().map(|t| t + shift).collect();
        let mut curve = Curve::new(&t, kind.closed(), self.quadratic[side], side == 1, &|t| kind.at(t));
        if let JumpScheme::Kinked(_) = kind {
            curve.corners = (0..t.len()).filter(|&i| t[i] == 0.5).collect();
        }
        curve
    }
}

/// Enough edges that the sagitta of a chord stays small beside the curve.
fn steps(many: bool) -> impl Strategy<Value = Vec<f64>> {
    let least = if many { 12 } else { 2 };
    prop_oneof![
        prop::collection::vec(0.4f64..1.0, least..40),
        (least..40usize, 0.2f64..5.0).prop_map(|(n, ratio)| {
            let q = ratio.powf(1.0 / n as f64);
            (0..n).map(|i| q.powi(i as i32)).collect()
        }),
    ]
}

fn pairs() -> impl Strategy<Value = Pair> {
    let kind = prop_oneof![
        Just(JumpScheme::Straight),
        (0.2f64..4.0).prop_map(JumpScheme::Arc),
        (0.02f64..0.15).prop_map(JumpScheme::Wave),
        Just(JumpScheme::Circle),
        (-1.6f64..1.6).prop_filter("a kink", |turn| turn.abs() > 0.01).prop_map(JumpScheme::Kinked),
    ];
    (kind, steps(true), steps(true), any::<[bool; 2]>()).prop_map(|(kind, a, b, quadratic)| Pair {
        kind,
        t: [kind.nodes(&a), kind.nodes(&b)],
        quadratic,
    })
}

/// Some displacement at a place: the same function on both sides plus what differs.
fn field(x: [f64; 2], side: usize) -> [f64; 2] {
    let s = side as f64;
    [(3.0 * x[0] + s).sin() + 0.3 * x[1], x[0] * x[1] - s * (2.0 * x[1]).cos()]
}

fn displacements(curves: [&Curve; 2]) -> Vec<[f64; 2]> {
    let of = |side: usize| curves[side].points.iter().map(move |&x| field(in_plane(x), side));
    of(0).chain(of(1)).collect()
}

fn largest(f: &[[f64; 2]]) -> f64 {
    f.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()))
}

fn differ(f: &[[f64; 2]], g: &[[f64; 2]]) -> f64 {
    f.iter().flatten().zip(g.iter().flatten()).fold(0.0, |m: f64, (p, q)| m.max((p - q).abs())) / largest(f)
}

const K: [f64; 2] = [3.0, 1.7];

fn couple(
    a: &Curve,
    b: &Curve,
    scheme: (midplane::coupling::JumpScheme, midplane::coupling::Points),
) -> Coupling {
    join(&[a], &[b], scheme).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 700, failure_persistence: None, ..ProptestConfig::default() })]

    /// Claim: exchanging A and B, or numbering either curve backwards, gives the same forces to round-off.
    #[test]
    fn labels_do_not_matter(pair in pairs()) {
        let (a, b) = (pair.curve(0), pair.curve(1));
        let (n, m) = (a.points.len(), b.points.len());
        let u = displacements([&a, &b]);
        for scheme in ALL {
            let f = respond(&couple(&a, &b, scheme), &u, K);
            // B first: its nodes come first
            let swapped: Vec<[f64; 2]> = u[n..].iter().chain(&u[..n]).copied().collect();
            let mut g = respond(&couple(&b, &a, scheme), &swapped, K);
            g.rotate_left(m);
            prop_assert!(differ(&f, &g) < 1e-10, "swapped {scheme:?}: {:e}", differ(&f, &g));
            let back: Vec<[f64; 2]> = u[..n].iter().rev().chain(&u[n..]).copied().collect();
            let mut g = respond(&couple(&a.renumbered(), &b, scheme), &back, K);
            g[..n].reverse();
            prop_assert!(differ(&f, &g) < 1e-10, "A backwards {scheme:?}: {:e}", differ(&f, &g));
            let back: Vec<[f64; 2]> = u[..n].iter().chain(u[n..].iter().rev()).copied().collect();
            let mut g = respond(&couple(&a, &b.renumbered(), scheme), &back, K);
            g[n..].reverse();
            prop_assert!(differ(&f, &g) < 1e-10, "B backwards {scheme:?}: {:e}", differ(&f, &g));
        }
    }

    /// Claim: turning, moving and scaling the whole turns and scales the forces.
    #[test]
    fn place_and_size_do_not_matter(pair in pairs(), angle in 0.0f64..6.0, size in -3.0f64..3.0) {
        // equal edges everywhere are a tie: the grid's walk then starts where x is smaller
        let equal = |t: &[f64]| t.windows(2).all(|w| ((w[1] - w[0]) * (t.len() - 1) as f64 - 1.0).abs() < 1e-6);
        prop_assume!(!pair.t.iter().all(|t| equal(t)));
        let (a, b) = (pair.curve(0), pair.curve(1));
        let u = displacements([&a, &b]);
        let ((sin, cos), size) = (angle.sin_cos(), 10f64.powf(size));
        let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
        let to = |x: [f64; 2]| turn(x).map(|x| size * (x + 0.7));
        let turned: Vec<[f64; 2]> = u.iter().map(|&u| turn(u)).collect();
        for scheme in ALL {
            let one = couple(&a, &b, scheme);
            let two = couple(&a.moved(&to), &b.moved(&to), scheme);
            let f: Vec<[f64; 2]> = respond(&one, &u, K).into_iter().map(|f| turn(f).map(|f| size * f)).collect();
            let g = respond(&two, &turned, K);
            // the walk's direction is a tie where the first edges agree to 1e-9: random ones do not
            prop_assert!(differ(&f, &g) < 1e-9, "{scheme:?}: {:e}", differ(&f, &g));
            prop_assert!((two.midplane.length / one.midplane.length / size - 1.0).abs() < 1e-12);
        }
    }

    /// Claim: a rigid motion of the whole gives no jump; forces and moments of any traction balance; weights are positive
    /// and sum to the length; segments follow each other; constant jumps are reproduced.
    #[test]
    fn rigid_motions_and_balance(pair in pairs()) {
        let (a, b) = (pair.curve(0), pair.curve(1));
        let n = a.points.len();
        let x: Vec<[f64; 2]> = a.points.iter().chain(&b.points).map(|&x| in_plane(x)).collect();
        let rigid: Vec<[f64; 2]> = x.iter().map(|[x, y]| [0.3 - y, x - 0.2]).collect();
        let step: Vec<[f64; 2]> = (0..x.len()).map(|i| if i < n { [0.0; 2] } else { [0.4, -0.7] }).collect();
        for scheme in ALL {
            let c = couple(&a, &b, scheme);
            prop_assert!(largest(&jumps(&c, &rigid)) < 2e-14, "{scheme:?}: {:e}", largest(&jumps(&c, &rigid)));
            for (p, jump) in c.points.iter().zip(jumps(&c, &step)) {
                for k in 0..2 {
                    let exact = p.rotation[k][0] * 0.4 - p.rotation[k][1] * 0.7;
                    prop_assert!((jump[k] - exact).abs() < 2e-14, "{scheme:?}: {jump:?} {exact}");
                }
            }
            let t: Vec<[f64; 2]> = c.points.iter().map(|p| [(5.0 * p.s).sin(), 1.0 - p.s]).collect();
            let f = forces(&c, &t, x.len());
            let scale: f64 = f.iter().map(|f| f[0].hypot(f[1])).sum();
            let moment: f64 = f.iter().zip(&x).map(|(f, x)| x[0] * f[1] - x[1] * f[0]).sum();
            let force = [0, 1].map(|d| f.iter().map(|f| f[d]).sum::<f64>());
            prop_assert!(moment.abs() < 1e-13 * scale, "{moment:e} of {scale:e}");
            prop_assert!(force[0].hypot(force[1]) < 1e-13 * scale, "{force:?} of {scale:e}");
            prop_assert!(c.points.iter().all(|p| p.weight > 0.0));
            let sum: f64 = c.points.iter().map(|p| p.weight).sum();
            prop_assert!((sum / c.midplane.length - 1.0).abs() < 1e-13);
            prop_assert!(c.midplane.segments.iter().all(|g| g.s[1] > g.s[0]));
            prop_assert!(c.midplane.segments.windows(2).all(|g| g[0].s[1] == g[1].s[0]));
            prop_assert!(c.midplane.joined.iter().all(|share| (share - 1.0).abs() < 0.02), "{:?}", c.midplane.joined);
            let least = a.edges.len().min(b.edges.len());
            prop_assert!(c.midplane.grid_nodes <= least + c.midplane.pieces.len(), "{} of {least}", c.midplane.grid_nodes);
        }
    }
}

/// Claim: a rigid rotation of two polygons of one circle gives a jump below 1e-13 of the displacement.
#[test]
fn a_turned_circle_has_no_jump() {
    for (n, m) in [(12, 17), (100, 101), (3, 700)] {
        for quadratic in [false, true] {
            let at = |t: f64| [(2.0 * PI * t).cos(), -(2.0 * PI * t).sin()];
            let curve = |n: usize, forward: bool| {
                let t: Vec<f64> = (0..=n).map(|i| i as f64 / n as f64).collect();
                Curve::new(&t, true, quadratic, forward, &at)
            };
            let (a, b) = (curve(n, false), curve(m, true));
            if n == 3 && !quadratic {
                continue; // a triangle is no circle
            }
            let u: Vec<[f64; 2]> = a.points.iter().chain(&b.points).map(|[x, y, _]| [-y, *x]).collect();
            for scheme in ALL {
                let jump = largest(&jumps(&couple(&a, &b, scheme), &u));
                assert!(jump < 1e-13, "{n}:{m} {scheme:?}: {jump:e}");
            }
        }
    }
}

/// Claim: a loop starts at the A and the B node that lie closest together, at that with the longer edges; of several at the one with
/// smaller x, then y, wherever the file begins.
#[test]
fn loops_start_where_nodes_are_closest() {
    let start = |a: &Curve, b: &Curve| {
        let c = join(&[a], &[b], ALL[0]).unwrap();
        in_plane(c.midplane.segments[0].places[0])
    };
    let at = |t: f64| [(2.0 * PI * t).cos(), -(2.0 * PI * t).sin()];
    let curve = |t: &[f64], forward: bool| Curve::new(t, true, false, forward, &at);
    // nodes of both sides face each other all round, two of them farthest to the left
    let lowest = [(PI / 12.0).cos(), (PI / 12.0).sin()].map(|x| -x);
    for first in 0..12 {
        for second in [0, 5, 7] {
            let circle =
                |from: usize, forward: bool| curve(&even_parts(12, (from as f64 + 0.5) / 12.0), forward);
            let [x, y] = start(&circle(first, false), &circle(second, true));
            let off = (x - lowest[0]).hypot(y - lowest[1]);
            assert!(off < 1e-12, "{first} {second}: starts at {x} {y}");
        }
    }
    // a circle of 40 edges in one of 23, turned: the closest nodes by their angles, which no others come near
    for turn in [0.013, 0.4, 0.77, 1.3] {
        let [many, few] = [40, 23];
        let (a, b) = (even_parts(many, 0.0), even_parts(few, turn));
        let [x, y] = start(&curve(&a, false), &curve(&b, true));
        let apart = |s: f64, t: f64| ((s - t) - (s - t).round()).abs();
        let near = |t: &f64| a[..many].iter().map(|s| apart(*s, *t)).fold(f64::INFINITY, f64::min);
        let closest = b[..few].iter().min_by(|s, t| near(s).total_cmp(&near(t))).unwrap();
        let found = (-y).atan2(x) / (2.0 * PI);
        assert!(apart(found, *closest) < 2e-4, "{turn}: starts at {found}, not at {closest}");
    }
}

/// Ends of n even parts of a loop that starts at a parameter.
fn even_parts(n: usize, from: f64) -> Vec<f64> {
    (0..=n).map(|i| from + i as f64 / n as f64).collect()
}

/// Claim: of sides in several parts the distance of those farthest apart is told, wherever they stand.
#[test]
fn the_largest_distance_of_several_parts_is_told() {
    let line = |from: f64, y: f64, forward: bool| {
        let t: Vec<f64> = (0..5).map(|i| i as f64 / 4.0).collect();
        Curve::new(&t, false, false, forward, &|t| [from + t, y])
    };
    for apart in [[1e-3, 0.0], [0.0, 1e-3], [1e-3, 5e-4]] {
        let a = [line(0.0, 0.0, false), line(2.0, 0.0, false)];
        let b = [line(0.0, apart[0], true), line(2.0, apart[1], true)];
        let c = join(&[&a[0], &a[1]], &[&b[0], &b[1]], ALL[0]).unwrap();
        let least = apart[0].min(apart[1]);
        assert!((c.midplane.apart - 1e-3).abs() < 1e-12, "{apart:?}: {}", c.midplane.apart);
        let [low, high] = c.midplane.gap;
        assert!((low - least).abs() < 1e-12 && (high - 1e-3).abs() < 1e-12, "{apart:?}: {low} {high}");
    }
}
