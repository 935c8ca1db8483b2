//! From elements to one sparse system: numbering, pattern, stiffness.
//!
//! ```text
//! dof = components · (first node of the body + node) + direction
//! ```

mod joint;
mod matrix;
mod pattern;
mod tangent;

pub use joint::Joint;
pub use matrix::Symmetric;
pub use pattern::Pattern;
pub use tangent::Tangent;

use rayon::prelude::*;

use crate::continuum::{Elasticity, cell_coordinates, element_stiffness};
use crate::mesh::Mesh;

/// One body of the model.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name of the subdomain.
    pub name: String,
    /// Its mesh.
    pub mesh: Mesh,
    /// Its material in the scene's plane state.
    pub elasticity: Elasticity,
    /// Mass density [mass / volume].
    pub density: f64,
    /// Number of its first node in the model.
    pub first_node: usize,
}

/// All bodies and joints with their numbering.
#[derive(Debug, Clone)]
pub struct Model {
    /// Displacement components per node.
    pub components: usize,
    /// Thickness out of the plane [length].
    pub thickness: f64,
    /// The bodies, their nodes numbered one after the other.
    pub bodies: Vec<Body>,
    /// The joints on global dofs.
    pub joints: Vec<Joint>,
}

impl Model {
    /// Number of nodes of all bodies.
    pub fn nodes(&self) -> usize {
        self.bodies.last().map_or(0, |body| body.first_node + body.mesh.points.len())
    }

    /// Number of dofs, held ones included.
    pub fn dofs(&self) -> usize {
        self.components * self.nodes()
    }

    /// Dofs of one body.
    pub fn dofs_of(&self, body: usize) -> std::ops::Range<usize> {
        let body = &self.bodies[body];
        self.components * body.first_node..self.components * (body.first_node + body.mesh.points.len())
    }

    /// Coordinates of all nodes, one node after the other [length].
    pub fn coordinates(&self) -> Vec<f64> {
        self.bodies.iter().flat_map(|body| body.mesh.points.as_flattened()).copied().collect()
    }

    /// The pattern of the bodies alone: a block for each.
    pub fn continuum_pattern(&self) -> Pattern {
        let cells = self.bodies.iter().flat_map(|body| {
            let cells = &body.mesh.cells;
            (0..cells.len()).map(move |c| (body.first_node, cells.nodes(c)))
        });
        Pattern::new(self.components, self.nodes(), || cells.clone())
    }

    /// The pattern that continuum and joints fill together.
    pub fn pattern(&self) -> Pattern {
        let cells = self.bodies.iter().flat_map(|body| {
            let cells = &body.mesh.cells;
            (0..cells.len()).map(move |c| (body.first_node, cells.nodes(c)))
        });
        let joints: Vec<Vec<usize>> = self.joints.iter().flat_map(Joint::cliques).collect();
        let cliques = joints.iter().map(|nodes| (0, nodes.as_slice()));
        Pattern::new(self.components, self.nodes(), || cells.clone().chain(cliques.clone()))
    }

    /// K of the continuum on a pattern.
    pub fn continuum(&self, pattern: &Pattern) -> Symmetric {
        let mut stiffness = Symmetric::zero(pattern);
        // every body has columns of its own
        let mut parts: Vec<(&Body, usize, &mut [f64])> = Vec::new();
        let (mut rest, mut start) = (stiffness.values.as_mut_slice(), 0);
        for (b, body) in self.bodies.iter().enumerate() {
            let end = pattern.offsets[self.dofs_of(b).end] as usize;
            let (part, behind) = rest.split_at_mut(end - start);
            parts.push((body, start, part));
            (rest, start) = (behind, end);
        }
        parts.into_par_iter().for_each(|(body, start, values)| {
            for c in 0..body.mesh.cells.len() {
                let nodes = body.mesh.cells.nodes(c);
                let x = cell_coordinates(&body.mesh, c);
                let k = element_stiffness(body.mesh.cells.shapes[c], &x, &body.elasticity, self.thickness);
                for (j, &node_j) in nodes.iter().enumerate() {
                    for (i, &node_i) in nodes.iter().enumerate().filter(|(_, node_i)| **node_i >= node_j) {
                        let at = pattern.block(body.first_node + node_i, body.first_node + node_j);
                        for (b, column) in at.into_iter().enumerate() {
                            for a in if i == j { b } else { 0 }..2 {
                                values[column - start + a] += k[2 * i + a][2 * j + b];
                            }
                        }
                    }
                }
            }
        });
        stiffness
    }
}
