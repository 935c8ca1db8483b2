//! Curved meshes: bent rectangles and closed rings, with mid-nodes on the curves.

use std::collections::HashMap;
use std::f64::consts::PI;

use midplane::mesh::{Group, Mesh};
use midplane::shape::Shape;
use midplane::shape::vector::in_space;

use super::{even, rectangle};

/// A rectangle whose nodes, mid-nodes included, are put in place one by one.
pub fn bent(xs: &[f64], ys: &[f64], shape: Shape, place: impl Fn(f64, f64) -> [f64; 2]) -> Mesh {
    let mut mesh = rectangle(xs, ys, shape, |x, y| [x, y]);
    mesh.points.iter_mut().for_each(|p| *p = in_space(place(p[0], p[1])));
    mesh
}

/// A quarter of a ring: "bottom" is the inner, "top" the outer arc, "left" lies on y, "right" on x.
pub fn quarter(n: usize, radii: &[f64], shape: Shape) -> Mesh {
    bent(&even(0.0, 1.0, n), radii, shape, |x, r| {
        [r * (0.5 * PI * (1.0 - x)).cos(), r * (0.5 * PI * (1.0 - x)).sin()]
    })
}

/// A closed ring of n edges from an angle on: "bottom" is the inner, "top" the outer circle.
pub fn ring(n: usize, radii: &[f64], shape: Shape, from: f64) -> Mesh {
    let mut mesh = rectangle(&even(0.0, 1.0, n), radii, shape, |x, y| [x, y]);
    let side = |name: &str| {
        let mut nodes = mesh.groups[name].points(&mesh);
        nodes.sort_by(|&i, &j| mesh.points[i][1].total_cmp(&mesh.points[j][1]));
        nodes
    };
    let twin: HashMap<usize, usize> = side("right").into_iter().zip(side("left")).collect();
    let mut number = vec![usize::MAX; mesh.points.len()];
    let mut points = Vec::new();
    for (i, p) in mesh.points.iter().enumerate().filter(|(i, _)| !twin.contains_key(i)) {
        number[i] = points.len();
        let angle = from - 2.0 * PI * p[0];
        points.push([p[1] * angle.cos(), p[1] * angle.sin(), 0.0]);
    }
    for (i, j) in &twin {
        number[*i] = number[*j];
    }
    mesh.points = points;
    mesh.cells.nodes.iter_mut().for_each(|node| *node = number[*node]);
    mesh.groups.retain(|name, _| ["bottom", "top", "body"].contains(&name.as_str()));
    for group in mesh.groups.values_mut() {
        if let Group::Edges(edges) = group {
            edges.iter_mut().for_each(|edge| *edge = edge.renumbered(|node| number[node]));
        }
    }
    mesh.corners = mesh.corners.iter().map(|&node| number[node]).collect();
    mesh.corners.sort_unstable();
    mesh.corners.dedup();
    mesh
}

/// ∫ |u_h − u|² and ∫ |u|² over a body; `u` are the displacements of its nodes one after the other.
pub fn l2_error(mesh: &Mesh, u: &[f64], exact: impl Fn([f64; 2]) -> [f64; 2]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for c in 0..mesh.cells.len() {
        let (shape, nodes) = (mesh.cells.shapes[c], mesh.cells.nodes(c));
        for q in shape.load_rule() {
            let values = shape.values(q[0], q[1]);
            let (mut x, mut v, mut j) = ([0.0; 2], [0.0; 2], [[0.0; 2]; 2]);
            for (i, &node) in nodes.iter().enumerate() {
                for d in 0..2 {
                    x[d] += values.n[i] * mesh.points[node][d];
                    v[d] += values.n[i] * u[2 * node + d];
                    for k in 0..2 {
                        j[d][k] += values.dn[i][k] * mesh.points[node][d];
                    }
                }
            }
            let (w, e) = (q[2] * (j[0][0] * j[1][1] - j[0][1] * j[1][0]), exact(x));
            sums[0] += w * ((v[0] - e[0]).powi(2) + (v[1] - e[1]).powi(2));
            sums[1] += w * (e[0] * e[0] + e[1] * e[1]);
        }
    }
    sums
}
