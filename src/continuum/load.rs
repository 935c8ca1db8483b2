//! Consistent nodal forces: f_i = h ∫ N_i t dL on edges, f_i = h ∫ N_i b dA in cells.

use super::element::gradients;
use crate::shape::{GAUSS_2, GAUSS_3, LINE_NODES, LineRule, LineValues, MAX_NODES, Shape};

/// Lobatto points and weights, four of them, exact for what three Gauss points are.
const LOBATTO_4: [[f64; 2]; 4] = [
    [-1.0, 1.0 / 6.0],
    [-0.447_213_595_499_957_9, 5.0 / 6.0],
    [0.447_213_595_499_957_9, 5.0 / 6.0],
    [1.0, 1.0 / 6.0],
];
/// An edge's forces are exact to this part of them; parts are halved at most so often, and there are at most so many: a formula that
/// oscillates faster is not followed further.
const EXACT: f64 = 1e-13;
const HALVINGS: usize = 40;
const PARTS: usize = 4096;

/// Points of an edge: shape values, outward normal times dL/dξ · weight. The body lies on the left of the edge.
fn edge_points(x: &[[f64; 2]; LINE_NODES], shape: Shape) -> impl Iterator<Item = (LineValues, [f64; 2])> {
    let rule = if shape.is_quadratic() { GAUSS_3 } else { GAUSS_2 };
    rule.iter().map(move |&[xi, weight]| {
        let (n, normal) = edge_point(x, shape, xi);
        (n, normal.map(|d| weight * d))
    })
}

/// Shape values at the place ξ of an edge, and the outward normal times dL/dξ.
fn edge_point(x: &[[f64; 2]; LINE_NODES], shape: Shape, xi: f64) -> (LineValues, [f64; 2]) {
    let (n, dn) = shape.line_functions(xi);
    let slope = [0, 1].map(|d| (0..LINE_NODES).map(|i| dn[i] * x[i][d]).sum::<f64>());
    (n, [slope[1], -slope[0]])
}

/// Nodal forces (x, y) of an edge under a traction (x, y) and a pressure, both constant [stress]; times thickness.
/// `x` holds its ends, then its inner nodes.
pub fn edge_force(
    x: &[[f64; 2]; LINE_NODES],
    shape: Shape,
    traction: [f64; 2],
    pressure: f64,
    thickness: f64,
) -> [[f64; 2]; LINE_NODES] {
    let mut force = [[0.0; 2]; LINE_NODES];
    for (n, normal) in edge_points(x, shape) {
        let length = normal[0].hypot(normal[1]);
        for (force, n) in force.iter_mut().zip(n) {
            for d in 0..2 {
                force[d] += thickness * n * (traction[d] * length - pressure * normal[d]);
            }
        }
    }
    force
}

/// The same for a traction and a pressure that vary: `load` gets ξ and the place relative to the origin of `x`. Halved until
/// both halves, and a rule with the ends, give what the whole gives: loads may have kinks, such as that of a water level.
pub fn edge_field_force<E>(
    x: &[[f64; 2]; LINE_NODES],
    shape: Shape,
    thickness: f64,
    mut load: impl FnMut(f64, [f64; 2]) -> Result<([f64; 2], f64), E>,
) -> Result<[[f64; 2]; LINE_NODES], E> {
    let mut on = |rule: LineRule, from: f64, to: f64| -> Result<NodalForces, E> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut force = [[0.0; 2]; LINE_NODES];
        for &[xi, weight] in rule {
            let xi = middle + half * xi;
            let (n, normal) = edge_point(x, shape, xi);
            let place = [0, 1].map(|d| (0..LINE_NODES).map(|i| n[i] * x[i][d]).sum());
            let (traction, pressure) = load(xi, place)?;
            let length = normal[0].hypot(normal[1]);
            for (force, n) in force.iter_mut().zip(n) {
                for d in 0..2 {
                    force[d] += thickness * half * weight * n * (traction[d] * length - pressure * normal[d]);
                }
            }
        }
        Ok(force)
    };
    let largest = |force: &NodalForces| force.iter().flatten().map(|f| f.abs()).fold(0.0, f64::max);
    let whole = on(GAUSS_3, -1.0, 1.0)?;
    let (mut force, mut size) = ([[0.0; 2]; LINE_NODES], largest(&whole));
    let (mut todo, mut parts) = (vec![(-1.0, 1.0, whole, 0)], 1);
    while let Some((from, to, whole, depth)) = todo.pop() {
        let middle = 0.5 * (from + to);
        let halves = [on(GAUSS_3, from, middle)?, on(GAUSS_3, middle, to)?];
        let both = sum(&halves[0], &halves[1]);
        size = size.max(largest(&both));
        // a formula may have no value at an end
        let ends = on(&LOBATTO_4, from, to).unwrap_or(whole);
        // below the smallest number of full precision there are no such parts
        let exact = (EXACT * size).max(f64::MIN_POSITIVE);
        let off = |other: &NodalForces| largest(&sum(other, &whole.map(|f| f.map(|f| -f)))) > exact;
        if depth < HALVINGS && parts < PARTS && (off(&both) || off(&ends)) {
            parts += 1;
            todo.push((from, middle, halves[0], depth + 1));
            todo.push((middle, to, halves[1], depth + 1));
        } else {
            force = sum(&force, &both);
        }
    }
    Ok(force)
}

/// Forces (x, y) of an edge's nodes.
type NodalForces = [[f64; 2]; LINE_NODES];

fn sum(a: &NodalForces, b: &NodalForces) -> NodalForces {
    std::array::from_fn(|i| [a[i][0] + b[i][0], a[i][1] + b[i][1]])
}

/// ∫ N_i dL of an edge: ends, then inner nodes [length].
pub fn edge_weights(x: &[[f64; 2]; LINE_NODES], shape: Shape) -> LineValues {
    let mut weights = [0.0; LINE_NODES];
    for (n, normal) in edge_points(x, shape) {
        for (weight, n) in weights.iter_mut().zip(n) {
            *weight += n * normal[0].hypot(normal[1]);
        }
    }
    weights
}

/// ∫ N_i dA of a cell [length²].
pub fn cell_weights(shape: Shape, x: &[[f64; 2]; MAX_NODES]) -> [f64; MAX_NODES] {
    let mut weights = [0.0; MAX_NODES];
    for &[xi, eta, weight] in shape.load_rule() {
        let values = shape.values(xi, eta);
        let (_, det) = gradients(shape, x, &values);
        for i in 0..shape.nodes() {
            weights[i] += weight * det * values.n[i];
        }
    }
    weights
}

/// ∫ N_i b dA of a cell for a force b per volume that varies: `load` gets the place relative to the origin of `x`.
pub fn cell_field_force<E>(
    shape: Shape,
    x: &[[f64; 2]; MAX_NODES],
    mut load: impl FnMut([f64; 2]) -> Result<[f64; 2], E>,
) -> Result<[[f64; 2]; MAX_NODES], E> {
    let mut force = [[0.0; 2]; MAX_NODES];
    for &[xi, eta, weight] in shape.field_rule() {
        let values = shape.values(xi, eta);
        let (_, det) = gradients(shape, x, &values);
        let place = [0, 1].map(|d| (0..shape.nodes()).map(|i| values.n[i] * x[i][d]).sum());
        let density = load(place)?;
        for i in 0..shape.nodes() {
            for d in 0..2 {
                force[i][d] += weight * det * values.n[i] * density[d];
            }
        }
    }
    Ok(force)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pressure_pushes_against_the_subdomain_and_sums_to_pressure_times_length() {
        // the body lies above an edge that runs along +x: a pressure p pushes up
        let x = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
        for shape in [Shape::Line2, Shape::Line3] {
            let force = edge_force(&x, shape, [0.0, 0.0], 3.0, 0.5);
            let total = [0, 1].map(|d| force.iter().map(|f| f[d]).sum::<f64>());
            assert!(total[0].abs() < 1e-15 && (total[1] - 3.0).abs() < 1e-15, "{total:?}");
        }
        // quadratic: 1/6, 1/6, 4/6 of the force
        let force = edge_force(&x, Shape::Line3, [0.0, 6.0], 0.0, 1.0);
        for (force, exact) in force.iter().zip([2.0, 2.0, 8.0]) {
            assert!((force[1] - exact).abs() < 1e-14);
        }
    }

    #[test]
    fn a_force_that_varies_in_a_curved_cell_has_its_exact_resultant() {
        // one edge bulges by h as a parabola; ∫ y dA over the region by hand
        let h = 0.3;
        for (shape, mid, place, exact) in [
            (Shape::Triangle6, 3, [0.5, -h], 0.5 * (1.0 / 3.0 - 16.0 * h * h / 30.0)),
            (Shape::Quadrilateral8, 6, [0.0, 1.0 + h], 4.0 / 3.0 * h + 8.0 / 15.0 * h * h),
            (Shape::Quadrilateral9, 6, [0.0, 1.0 + h], 4.0 / 3.0 * h + 8.0 / 15.0 * h * h),
        ] {
            let mut x = [[0.0; 2]; MAX_NODES];
            for (x, p) in x.iter_mut().zip(shape.node_points()) {
                *x = *p;
            }
            x[mid] = place;
            if shape == Shape::Quadrilateral9 {
                x[8] = [0.0, 0.5 * h]; // the middle of the bulge, as Q8 has it
            }
            let force = cell_field_force::<()>(shape, &x, |place| Ok([place[1], 0.0])).unwrap();
            let total: f64 = force.iter().map(|f| f[0]).sum();
            assert!((total - exact).abs() < 1e-14, "{shape:?}: {total}, exact {exact}");
        }
    }

    #[test]
    fn a_water_level_within_an_edge_gives_its_exact_force() {
        // t = max(0, h − ξ) on −1 to 1: ∫ ½ (1 ∓ ξ) t dξ by hand, d = h + 1 under water
        let x = [[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
        for h in [-0.97, -0.3, 0.123, 0.7, 0.98, 0.9999] {
            let force = edge_field_force::<()>(&x, Shape::Line2, 1.0, |xi, _| {
                Ok(([f64::max(0.0, h - xi), 0.0], 0.0))
            });
            let d: f64 = h + 1.0;
            let second = d.powi(3) / 12.0;
            for (force, exact) in force.unwrap().iter().zip([0.5 * d * d - second, second]) {
                assert!((force[0] - exact).abs() < 1e-11, "{force:?} {exact}");
            }
        }
    }

    #[test]
    fn a_linear_traction_gives_its_exact_consistent_force() {
        // t = ξ on an edge of length 2: ∫ N_i ξ dξ = ∓1/3, and on a quadratic edge the same with 0 in the middle
        let x = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
        for shape in [Shape::Line2, Shape::Line3] {
            let force = edge_field_force::<()>(&x, shape, 1.0, |xi, _| Ok(([xi, 0.0], 0.0))).unwrap();
            for (force, exact) in force.iter().zip([-1.0 / 3.0, 1.0 / 3.0, 0.0]) {
                assert!((force[0] - exact).abs() < 1e-15, "{force:?}");
            }
        }
    }
}
