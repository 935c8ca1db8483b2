//! Two arbitrary chains as the sides of an interface: what is joined is joined whole.

#![no_main]

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use midplane::coupling::{Coupling, Gap, JumpScheme, Points, Scheme, Side, Surroundings};
use midplane::mesh::Facet;

/// Most edges of a side.
const MOST: usize = 40;
/// Error that the jump of a rigid translation may have.
const RIGID: f64 = 1e-6;

struct Chain {
    points: Vec<[f64; 3]>,
    edges: Vec<Facet>,
    corners: Vec<usize>,
}

/// The line that both sides follow.
#[derive(Clone, Copy)]
enum Guide {
    Straight,
    Circle,
    Wave,
    Corner,
}

impl Guide {
    fn at(self, t: f64) -> [f64; 2] {
        match self {
            Guide::Straight => [t, 0.0],
            Guide::Circle => [-(6.0 * t).cos(), (6.0 * t).sin()],
            Guide::Wave => [t, 0.2 * (7.0 * t).sin()],
            Guide::Corner => [t, (t - 0.5).max(0.0)],
        }
    }
}

/// A number in [0, 1], often a multiple of 1/16.
fn fraction(bytes: &mut Unstructured) -> Result<f64> {
    let coarse: u8 = bytes.arbitrary()?;
    Ok(match coarse {
        0..=16 => f64::from(coarse) / 16.0,
        17..=200 => f64::from(coarse - 17) / 183.0,
        _ => f64::from(bytes.arbitrary::<u32>()?) / f64::from(u32::MAX),
    })
}

fn chain(bytes: &mut Unstructured, guide: Option<Guide>, forward: bool, place: [f64; 2]) -> Result<Chain> {
    let quadratic: bool = bytes.arbitrary()?;
    let edges = bytes.int_in_range(1..=MOST)?;
    let noise = *bytes.choose(&[0.0, 0.0, 1e-15, 1e-9, 1e-4, 1e-2, 1.0])?;
    let mut ts: Vec<f64> = (0..=edges).map(|_| fraction(bytes)).collect::<Result<_>>()?;
    if bytes.arbitrary()? {
        ts.sort_by(f64::total_cmp);
    }
    let closed = edges > 2 && bytes.ratio(1, 8)?;
    let [scale, shift] = place;
    let mut at = |t: f64| -> Result<[f64; 3]> {
        let [x, y] = match guide {
            Some(guide) => guide.at(t),
            None => [t, fraction(bytes)?],
        };
        let mut moved = |x: f64| Ok(scale * (x + noise * (fraction(bytes)? - 0.5)) + shift);
        Ok([moved(x)?, moved(y)?, 0.0])
    };
    let mut points = ts.iter().map(|&t| at(t)).collect::<Result<Vec<_>>>()?;
    let mut facets = Vec::new();
    for i in 0..edges {
        let next = if closed && i + 1 == edges { 0 } else { i + 1 };
        let [start, end] = if forward { [i, next] } else { [next, i] };
        let mut nodes = vec![start, end];
        if quadratic {
            nodes.push(points.len());
            points.push(at(0.5 * (ts[i] + ts[next]))?);
        }
        facets.push(Facet::edge(&nodes, i, true));
    }
    let mut corners: Vec<usize> =
        (0..bytes.int_in_range(0..=3)?).map(|_| bytes.int_in_range(0..=edges)).collect::<Result<_>>()?;
    corners.sort_unstable();
    corners.dedup();
    Ok(Chain { points, edges: facets, corners })
}

fn joined(data: &[u8]) -> Result<()> {
    let bytes = &mut Unstructured::new(data);
    let kind = *bytes.choose(&[JumpScheme::Projected, JumpScheme::ProjectedLinear, JumpScheme::Pointwise])?;
    let points = *bytes.choose(&[Points::Gauss, Points::Lobatto])?;
    let gap = *bytes.choose(&[Gap::Closed, Gap::Open])?;
    let guides = [Guide::Straight, Guide::Circle, Guide::Wave, Guide::Corner].map(Some);
    let guide = if bytes.ratio(1, 8)? { None } else { *bytes.choose(&guides)? };
    let place = [*bytes.choose(&[1.0, 1e-9, 1e9])?, *bytes.choose(&[0.0, 0.0, 1e4])?];
    let chains = [chain(bytes, guide, false, place)?, chain(bytes, guide, true, place)?];
    let first = [0, chains[0].points.len()];
    let sides = [0, 1].map(|k| {
        let Chain { points, edges, corners } = &chains[k];
        [Side { name: ["a", "b"][k], points, edges, corners, first: first[k] }]
    });
    let scheme = Scheme { kind, points, gap };
    if std::env::var_os("FUZZ_SHOW").is_some() {
        eprintln!("{scheme:?} {sides:#?}");
    }
    if let Ok(coupling) = Coupling::build("joint", &sides[0], &sides[1], scheme, Surroundings::default()) {
        check(&coupling);
    }
    Ok(())
}

/// Weights sum to the length of C, frames are orthonormal, and the jump of a translation is the translation.
fn check(coupling: &Coupling) {
    let length = coupling.midplane.length;
    assert!(length.is_finite() && length > 0.0, "{length}");
    let sum: f64 = coupling.points.iter().map(|point| point.weight).sum();
    assert!((sum / length - 1.0).abs() < 1e-6, "weights sum to {sum}, the length is {length}");
    assert!(coupling.points.iter().all(|point| point.weight >= 0.0));
    for point in &coupling.points {
        let [n, t, _] = point.rotation;
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        assert!((dot(n, n) - 1.0).abs() + (dot(t, t) - 1.0).abs() + dot(n, t).abs() < 1e-9, "{n:?} {t:?}");
    }
    let [nodes_a, nodes_b] = [0, 1].map(|side| coupling.sides[side].nodes.len());
    for component in 0..2 {
        let mut u = vec![0.0; 2 * (nodes_a + nodes_b)];
        (nodes_a..nodes_a + nodes_b).for_each(|node| u[2 * node + component] = 1.0);
        let a = coupling.jump.multiply(&u);
        for point in &coupling.points {
            for d in 0..2 {
                let jump: f64 = point.interpolation.iter().map(|&(k, n)| n * a[2 * k + d]).sum();
                let exact = if d == component { 1.0 } else { 0.0 };
                assert!((jump - exact).abs() < RIGID, "jump {jump} at s = {}", point.s);
            }
        }
    }
}

fuzz_target!(|data: &[u8]| {
    let _ = joined(data);
});
