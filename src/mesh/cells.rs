//! Cells as the program relies on them: counter-clockwise, with a Jacobian that is positive everywhere it is used.

use super::Cells;
use super::msh::{MeshFault, damaged};
use crate::shape::{MAX_NODES, Shape, Values, determinant, jacobian};

/// A Jacobian below this part of the cell's squared diameter counts as zero.
const FLAT: f64 = 1e-12;

/// Turns clockwise cells over and refuses those that are flat, crossed, concave or bent too far.
pub(super) fn orient(cells: &mut Cells, points: &[[f64; 2]], tags: &[u64]) -> Result<(), MeshFault> {
    let probes = SHAPES.map(probes);
    for c in 0..cells.len() {
        let shape = cells.shapes[c];
        let range = cells.offsets[c]..cells.offsets[c + 1];
        let nodes = &mut cells.nodes[range];
        for (i, node) in nodes.iter().enumerate() {
            if nodes[..i].contains(node) {
                return Err(damaged(format!("element {} ({}) has a node twice", tags[c], shape.label())));
            }
        }
        let mut x = [[0.0; 2]; MAX_NODES];
        for (x, &node) in x.iter_mut().zip(nodes.iter()) {
            *x = points[node];
        }
        if doubled_area(&x[..shape.corners()]) < 0.0 {
            reverse(shape, nodes);
            for (x, &node) in x.iter_mut().zip(nodes.iter()) {
                *x = points[node];
            }
        }
        let x = &x[..shape.nodes()];
        let size = FLAT * squared_diameter(x);
        let probes = SHAPES.iter().position(|&s| s == shape).map_or(&[][..], |s| probes[s].as_slice());
        // written so that a Jacobian that is not a number is refused as well
        if !probes.iter().all(|probe| determinant(&jacobian(probe, x)) > size) {
            return Err(error_at(shape, tags[c], x));
        }
    }
    Ok(())
}

const SHAPES: [Shape; 5] =
    [Shape::Triangle3, Shape::Triangle6, Shape::Quadrilateral4, Shape::Quadrilateral8, Shape::Quadrilateral9];

/// Points at which the Jacobian is checked: the nodes and the points of the stiffness rule.
fn probes(shape: Shape) -> Vec<Values> {
    let nodes = shape.node_points().iter().map(|p| shape.values(p[0], p[1]));
    let rule = shape.stiffness_rule().iter().map(|q| shape.values(q[0], q[1]));
    match shape {
        Shape::Triangle3 => rule.collect(), // it is constant
        _ => nodes.chain(rule).collect(),
    }
}

/// Twice the area of a polygon, positive if it runs counter-clockwise.
fn doubled_area(x: &[[f64; 2]]) -> f64 {
    let [x0, y0] = x[0];
    let fan = x[1..].windows(2);
    fan.map(|p| (p[0][0] - x0) * (p[1][1] - y0) - (p[1][0] - x0) * (p[0][1] - y0)).sum()
}

fn squared_diameter(x: &[[f64; 2]]) -> f64 {
    let extent = |d: usize| {
        let (low, high) =
            x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[d]), h.max(p[d])));
        high - low
    };
    extent(0).powi(2) + extent(1).powi(2)
}

/// Counts the nodes the other way round, from the same first corner.
fn reverse(shape: Shape, nodes: &mut [usize]) {
    let corners = shape.corners();
    nodes[1..corners].reverse();
    if shape.is_quadratic() {
        nodes[corners..2 * corners].reverse();
    }
}

fn error_at(shape: Shape, tag: u64, x: &[[f64; 2]]) -> MeshFault {
    let corners = shape.corners();
    let size = FLAT * squared_diameter(x);
    let turn = |i: usize| doubled_area(&[x[(i + corners - 1) % corners], x[i], x[(i + 1) % corners]]);
    let vanishes = |area: f64| area.is_nan() || area <= size;
    let label = shape.label();
    let at = format!("near {}, {}", x[0][0], x[0][1]);
    let (what, help) = if vanishes(doubled_area(&x[..corners])) {
        (
            format!("element {tag} ({label}) {at} has no area"),
            "look for coincident points or curves in the .geo",
        )
    } else if (0..corners).any(|i| vanishes(turn(i))) {
        (
            format!("element {tag} ({label}) {at} is concave or crossed"),
            "use another Mesh.Algorithm or a finer mesh",
        )
    } else {
        (
            format!(
                "element {tag} ({label}) {at} has a mid-node so far off its place that it folds over itself"
            ),
            "use a finer mesh or Mesh.HighOrderOptimize = 1",
        )
    };
    MeshFault { what, help: help.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One cell on the nodes of the reference cell, moved by `change`.
    fn one(shape: Shape, change: impl Fn(&mut Vec<[f64; 2]>)) -> Result<Cells, MeshFault> {
        let mut points = shape.node_points().to_vec();
        change(&mut points);
        let mut cells = Cells::default();
        cells.push(shape, &(0..points.len()).collect::<Vec<_>>());
        orient(&mut cells, &points, &[42]).map(|()| cells)
    }

    #[test]
    fn a_mirrored_cell_is_turned_over_with_its_mid_nodes() {
        for shape in SHAPES {
            let cells = one(shape, |points| points.iter_mut().for_each(|p| p[0] = -p[0])).unwrap();
            let nodes = cells.nodes(0);
            for e in 0..shape.corners() {
                let [a, b, m] = shape.edge(e);
                if shape.is_quadratic() {
                    let p = shape.node_points();
                    let (a, b, m) = (p[nodes[a]], p[nodes[b]], p[nodes[m]]);
                    assert_eq!([m[0], m[1]], [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], "{shape:?}");
                }
            }
            assert_ne!(nodes[1], 1, "{shape:?}");
        }
    }

    #[test]
    fn flat_crossed_and_folded_cells_are_refused_by_tag() {
        for shape in SHAPES {
            let flat = one(shape, |points| points.iter_mut().for_each(|p| p[1] = 0.5 * p[0])).unwrap_err();
            assert!(flat.what.contains("element 42") && flat.what.contains("no area"), "{}", flat.what);
        }
        let crossed = one(Shape::Quadrilateral4, |points| points[1] = [-0.9, 0.9]).unwrap_err();
        assert!(crossed.what.contains("concave or crossed"), "{}", crossed.what);
        // T6: ∂x/∂ξ = 4 x_m − 1 − 4 (2 x_m − 1) ξ < 0 at ξ = 1 for x_m > 3/4; Q8: ∂y/∂η = (1 − y_m)/2 < 0 for y_m > 1
        for (shape, mid) in [(Shape::Triangle6, [0.9, 0.0]), (Shape::Quadrilateral8, [0.0, 1.1])] {
            let folded = one(shape, |points| points[shape.corners()] = mid).unwrap_err();
            assert!(folded.what.contains("mid-node"), "{}", folded.what);
        }
    }

    #[test]
    fn a_thin_cell_is_accepted() {
        one(Shape::Quadrilateral4, |points| points.iter_mut().for_each(|p| p[1] *= 1e-6)).unwrap();
    }
}
