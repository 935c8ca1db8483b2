//! Two unmatched layers of 2 × 0.5, made in memory: what the benches measure on.

use indexmap::IndexMap;
use midplane::mesh::{Cells, Facet, Group, Mesh};
use midplane::shape::Shape;

/// Both layers with about `dofs` dofs in all: n edges along and n/4 rows in each layer make n² dofs.
pub fn layers(dofs: usize) -> Vec<Mesh> {
    let n = (dofs as f64).sqrt();
    let (a, b) = ((0.98 * n).round() as usize, (1.02 * n).round() as usize);
    vec![layer(a, a / 4, -0.5), layer(b, b / 4, 0.0)]
}

/// A layer 2 × 0.5 of Q4 whose lower edge is at `y`.
fn layer(nx: usize, ny: usize, y: f64) -> Mesh {
    let node = |i: usize, j: usize| j * (nx + 1) + i;
    let mut mesh = Mesh { file: "layer.msh".into(), ..Mesh::default() };
    for j in 0..=ny {
        let y = y + 0.5 * j as f64 / ny as f64;
        mesh.points.extend((0..=nx).map(|i| [2.0 * i as f64 / nx as f64, y, 0.0]));
    }
    let mut cells = Cells::default();
    for j in 0..ny {
        for i in 0..nx {
            cells.push(
                Shape::Quadrilateral4,
                &[node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)],
            );
        }
    }
    mesh.cells = cells;
    let edge = |start, end, cell| Facet::edge(&[start, end], cell, true);
    let mut groups = IndexMap::new();
    let mut curve = |name: &str, edges: Vec<Facet>| groups.insert(name.to_string(), Group::Edges(edges));
    curve("bottom", (0..nx).map(|i| edge(node(i, 0), node(i + 1, 0), i)).collect());
    curve("right", (0..ny).map(|j| edge(node(nx, j), node(nx, j + 1), j * nx + nx - 1)).collect());
    curve("top", (0..nx).map(|i| edge(node(i + 1, ny), node(i, ny), (ny - 1) * nx + i)).collect());
    curve("left", (0..ny).map(|j| edge(node(0, j + 1), node(0, j), j * nx)).collect());
    mesh.groups = groups;
    mesh
}
