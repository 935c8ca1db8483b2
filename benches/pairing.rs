//! Times of pairing two sides of n edges each, and of finding where two bodies touch along as many:
//! `cargo bench --bench pairing -- 100000`. The least of seven runs counts, for others may use the machine.

use std::f64::consts::TAU;
use std::time::Instant;

use indexmap::IndexMap;
use midplane::coupling::{Coupling, Gap, JumpScheme, Points, Scheme, Side, Surroundings, join};
use midplane::mesh::{Cells, Facet, Group, Mesh, touching};
use midplane::shape::Shape;
use midplane::shape::vector::in_space;

const RUNS: usize = 7;
const SCHEME: Scheme = Scheme { kind: JumpScheme::Projected, points: Points::Gauss, gap: Gap::Closed };

fn main() {
    let sizes: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    for n in if sizes.is_empty() { vec![10_000, 100_000] } else { sizes } {
        let straight = |t: f64, _: f64| [t, 0.0];
        let wave = |t: f64, _: f64| [t, 0.1 * (TAU * t).sin()];
        let circle = |t: f64, r: f64| [r * (TAU * t).cos(), -r * (TAU * t).sin()];
        println!("{n} edges a side");
        measure("straight", n, false, &straight);
        measure("curved", n, false, &wave);
        measure("closed", n, true, &circle);
        let meshes = [strip(n, -1.0), strip(n - 1, 1.0)];
        let (seconds, lines) = least(|| touching(&[&meshes[0], &meshes[1]], &|pair, _| pair == [0, 1]));
        println!(
            "    touching                    {seconds:8.3} s, {} line",
            lines.map_or(0, |lines| lines.len())
        );
    }
}

fn measure(name: &str, n: usize, closed: bool, at: &dyn Fn(f64, f64) -> [f64; 2]) {
    let sides = [(n, false), (n - 1, true)].map(|(n, forward)| curve(n, closed, forward, &|t| at(t, 1.0)));
    let side = |i: usize, first: usize| {
        [Side { name: "side", points: &sides[i].0, edges: &sides[i].1, corners: &[usize::MAX], first }]
    };
    let (a, b) = (side(0, 0), side(1, n + 1));
    let (seconds, midplane) = least(|| join("joint", &a, &b, Gap::Closed));
    let segments = midplane.map_or(0, |midplane| midplane.segments.len());
    println!("    {name:<10} pairing          {seconds:8.3} s, {segments} segments");
    let (seconds, _) = least(|| Coupling::build("joint", &a, &b, SCHEME, Surroundings::default()));
    println!("    {name:<10} with operator    {seconds:8.3} s");
}

/// The least time of some runs, and what came out.
fn least<T>(run: impl Fn() -> T) -> (f64, T) {
    let mut best = f64::INFINITY;
    let mut result = None;
    for _ in 0..RUNS {
        let start = Instant::now();
        result = Some(run());
        best = best.min(start.elapsed().as_secs_f64());
    }
    (best, result.unwrap_or_else(&run))
}

/// Points and edges of a side.
fn curve(n: usize, closed: bool, forward: bool, at: &dyn Fn(f64) -> [f64; 2]) -> (Vec<[f64; 3]>, Vec<Facet>) {
    let nodes = if closed { n } else { n + 1 };
    let points = (0..nodes).map(|i| in_space(at(i as f64 / n as f64))).collect();
    let edge = |i: usize| {
        let (p, q) = (i, (i + 1) % nodes);
        let [start, end] = if forward { [p, q] } else { [q, p] };
        Facet::edge(&[start, end], 0, true)
    };
    (points, (0..n).map(edge).collect())
}

/// A row of n quadrilaterals from y = 0 to `height`, 1 long.
fn strip(n: usize, height: f64) -> Mesh {
    let (low, high) = (height.min(0.0), height.max(0.0));
    let row = |y: f64| (0..=n).map(move |i| [i as f64 / n as f64, y, 0.0]);
    let points = row(low).chain(row(high)).collect();
    let mut cells = Cells::default();
    (0..n).for_each(|i| cells.push(Shape::Quadrilateral4, &[i, i + 1, n + 2 + i, n + 1 + i]));
    let groups = IndexMap::from([("body".into(), Group::Cells((0..n).collect()))]);
    Mesh { file: "strip.msh".into(), points, cells, corners: vec![0, n, n + 1, 2 * n + 1], groups }
}
