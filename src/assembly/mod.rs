//! From elements to one sparse system: numbering, pattern, stiffness.
//!
//! ```text
//! dof = components · (first node of the body + node) + direction
//! ```

mod interface;
mod matrix;
mod pattern;
mod rigid;
mod stiffness;
mod tangent;

pub use interface::InterfaceOperator;
pub use matrix::Symmetric;
pub use pattern::Pattern;
pub use rigid::RigidMotions;
pub use stiffness::add_stiffness;
pub use tangent::InterfaceTangent;

use rayon::prelude::*;

use crate::continuum::{Elasticity, cell_coordinates, element_stiffness};
use crate::mesh::Mesh;

/// One body of the model.
#[derive(Debug, Clone)]
pub struct BoundSubdomain {
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
    /// Nodes of its pieces where it falls into several, which share nodes at most; none if it is one.
    pub pieces: Vec<Vec<usize>>,
}

/// All bodies and interfaces with their numbering.
#[derive(Debug, Clone)]
pub struct Model {
    /// Displacement components per node.
    pub components: usize,
    /// Thickness out of the plane [length].
    pub thickness: f64,
    /// The bodies, their nodes numbered one after the other.
    pub subdomains: Vec<BoundSubdomain>,
    /// The interfaces on global dofs.
    pub interfaces: Vec<InterfaceOperator>,
}

impl Model {
    /// Number of nodes of all bodies.
    pub fn nodes(&self) -> usize {
        self.subdomains.last().map_or(0, |subdomain| subdomain.first_node + subdomain.mesh.points.len())
    }

    /// Number of dofs, held ones included.
    pub fn dofs(&self) -> usize {
        self.components * self.nodes()
    }

    /// Dofs of one body.
    pub fn dofs_of(&self, subdomain: usize) -> std::ops::Range<usize> {
        let subdomain = &self.subdomains[subdomain];
        self.components * subdomain.first_node
            ..self.components * (subdomain.first_node + subdomain.mesh.points.len())
    }

    /// Nodes that an interface touches.
    pub fn joined(&self) -> Vec<bool> {
        let mut joined = vec![false; self.nodes()];
        for interface in &self.interfaces {
            for i in 0..interface.size() {
                interface.row(i).0.iter().for_each(|&dof| joined[dof / self.components] = true);
            }
        }
        joined
    }

    /// Coordinates of all nodes, one node after the other [length].
    pub fn coordinates(&self) -> Vec<f64> {
        self.subdomains.iter().flat_map(|subdomain| subdomain.coordinates(self.components)).collect()
    }

    /// The pattern of the bodies alone: a block for each.
    pub fn continuum_pattern(&self) -> Pattern {
        Pattern::new(self.components, self.nodes(), || self.cells())
    }

    /// First node and nodes of every cell.
    fn cells(&self) -> impl Iterator<Item = (usize, &[usize])> + Clone {
        self.subdomains.iter().flat_map(|subdomain| subdomain.cells(subdomain.first_node))
    }

    /// The pattern that continuum and interfaces fill together.
    pub fn pattern(&self) -> Pattern {
        let interfaces: Vec<Vec<usize>> = self.interfaces.iter().flat_map(stiffness::cliques).collect();
        let cliques = interfaces.iter().map(|nodes| (0, nodes.as_slice()));
        Pattern::new(self.components, self.nodes(), || self.cells().chain(cliques.clone()))
    }

    /// K of the continuum on a pattern.
    pub fn continuum(&self, pattern: &Pattern) -> Symmetric {
        let mut stiffness = Symmetric::zero(pattern);
        // every body has columns of its own
        let mut parts: Vec<(&BoundSubdomain, usize, &mut [f64])> = Vec::new();
        let (mut rest, mut start) = (stiffness.values.as_mut_slice(), 0);
        for (b, subdomain) in self.subdomains.iter().enumerate() {
            let end = pattern.offsets[self.dofs_of(b).end] as usize;
            let (part, behind) = rest.split_at_mut(end - start);
            parts.push((subdomain, start, part));
            (rest, start) = (behind, end);
        }
        parts.into_par_iter().for_each(|(subdomain, start, values)| {
            subdomain.add_stiffness(pattern, subdomain.first_node, self.thickness, start, values);
        });
        stiffness
    }
}

impl BoundSubdomain {
    /// First node and nodes of every cell.
    fn cells(&self, first_node: usize) -> impl Iterator<Item = (usize, &[usize])> + Clone {
        (0..self.mesh.cells.len()).map(move |c| (first_node, self.mesh.cells.nodes(c)))
    }

    /// Coordinates of its nodes, one node after the other, `components` of each [length].
    pub fn coordinates(&self, components: usize) -> impl Iterator<Item = f64> {
        self.mesh.points.iter().flat_map(move |x| x[..components].iter().copied())
    }

    /// The pattern of this body alone, its nodes numbered from 0.
    pub fn pattern(&self, components: usize) -> Pattern {
        Pattern::new(components, self.mesh.points.len(), || self.cells(0))
    }

    /// K of this body on its own pattern.
    pub fn stiffness(&self, pattern: &Pattern, thickness: f64) -> Symmetric {
        let mut stiffness = Symmetric::zero(pattern);
        self.add_stiffness(pattern, 0, thickness, 0, &mut stiffness.values);
        stiffness
    }

    /// Adds K where the pattern has the body's first node at `first`; `values` are those of the pattern from `start` on.
    fn add_stiffness(
        &self,
        pattern: &Pattern,
        first: usize,
        thickness: f64,
        start: usize,
        values: &mut [f64],
    ) {
        let c = pattern.components();
        for cell in 0..self.mesh.cells.len() {
            let nodes = self.mesh.cells.nodes(cell);
            let x = cell_coordinates(&self.mesh, cell);
            let k = element_stiffness(self.mesh.cells.shapes[cell], &x, &self.elasticity, thickness);
            for (j, &node_j) in nodes.iter().enumerate() {
                for (i, &node_i) in nodes.iter().enumerate().filter(|(_, node_i)| **node_i >= node_j) {
                    let at = pattern.block(first + node_i, first + node_j);
                    for (b, column) in at.into_iter().enumerate().take(c) {
                        for a in if i == j { b } else { 0 }..c {
                            values[column - start + a] += k[c * i + a][c * j + b];
                        }
                    }
                }
            }
        }
    }
}
