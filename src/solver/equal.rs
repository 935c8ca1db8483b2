//! Bodies that are equal up to a motion: found by what they consist of, so that a wall of equal bricks assembles and condenses one.
//!
//! ```text
//!   x = R (x₁ − p₁) + p       K = R K₁ Rᵀ       R from the vector p₁ → q₁ between two nodes far apart
//! ```
//!
//! Cells, material and joined nodes must be the same, and every node where the motion takes it, as nearly as a mesher places nodes.

use std::collections::HashMap;

use faer::Mat;

use crate::assembly::{BoundSubdomain, Model};

/// Nodes of equal bodies may be so far apart, as a part of their size: gmsh places those on a straight line to 1e-11. So much, over the
/// size of an element, is what the stiffness of one differs by from that of the other.
const LARGEST: f64 = 2e-11;
/// The digits of coordinates, which bodies far from the origin lose.
const DIGITS: f64 = 4.0 * f64::EPSILON;

/// The body that a body is like: itself, or an earlier one.
#[derive(Debug, Clone)]
pub(super) struct Like {
    pub(super) first: usize,
    /// The rotation from that one to this; none if there is none.
    pub(super) rotation: Option<Rotation>,
}

/// A rotation of vectors with some components.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rotation {
    components: usize,
    r: [[f64; 3]; 3],
}

impl Rotation {
    /// R of every vector in place.
    pub(super) fn turn(&self, vectors: &mut [f64]) {
        self.each(vectors, |i, j| self.r[i][j]);
    }

    /// Rᵀ of every vector in place.
    pub(super) fn back(&self, vectors: &mut [f64]) {
        self.each(vectors, |i, j| self.r[j][i]);
    }

    /// |R| of every vector in place.
    pub(super) fn turn_sizes(&self, vectors: &mut [f64]) {
        self.each(vectors, |i, j| self.r[i][j].abs());
    }

    /// Rᵀ of every vector.
    pub(super) fn turned_back(&self, vectors: &[f64]) -> Vec<f64> {
        let mut turned = vectors.to_vec();
        self.back(&mut turned);
        turned
    }

    /// R S Rᵀ of a symmetric matrix on vectors; only the lower triangle is read and right.
    pub(super) fn turned(&self, lower: &Mat<f64>) -> Mat<f64> {
        let mut whole = Mat::from_fn(lower.nrows(), lower.ncols(), |i, j| lower[(i.max(j), i.min(j))]);
        for _ in 0..2 {
            (0..whole.ncols()).for_each(|j| self.turn(whole.col_as_slice_mut(j)));
            whole = whole.transpose().to_owned();
        }
        whole
    }

    /// Its entries, to find equal ones.
    pub(super) fn bits(&self) -> [u64; 9] {
        let mut bits = [0; 9];
        bits.iter_mut().zip(self.r.as_flattened()).for_each(|(bits, r)| *bits = r.to_bits());
        bits
    }

    fn each(&self, vectors: &mut [f64], r: impl Fn(usize, usize) -> f64) {
        let c = self.components;
        for vector in vectors.chunks_exact_mut(c) {
            let mut turned = [0.0; 3];
            for (i, turned) in turned.iter_mut().enumerate().take(c) {
                *turned = vector.iter().enumerate().map(|(j, x)| r(i, j) * x).sum();
            }
            vector.copy_from_slice(&turned[..c]);
        }
    }
}

/// Properties that equal bodies share, geometry aside.
#[derive(PartialEq, Eq, Hash)]
struct Kind<'a> {
    shapes: Vec<u8>,
    nodes: &'a [usize],
    material: [u64; 3],
    joined: &'a [bool],
}

/// The first body of every kind up to a motion, and how the others are turned. Bodies with a dof that is `held` are like none that
/// is turned: their supports are along the axes.
pub(super) fn first_of_its_kind(model: &Model, joined: &[bool], held: &[bool]) -> Vec<Like> {
    let c = model.components;
    let mut firsts: HashMap<Kind, Vec<usize>> = HashMap::new();
    let mut likes: Vec<Like> = Vec::new();
    for (b, subdomain) in model.subdomains.iter().enumerate() {
        let (mesh, e, dofs) = (&subdomain.mesh, &subdomain.elasticity, model.dofs_of(b));
        let kind = Kind {
            shapes: mesh.cells.shapes.iter().map(|&shape| shape as u8).collect(),
            nodes: &mesh.cells.nodes,
            material: [e.c11, e.c12, e.c33].map(f64::to_bits),
            joined: &joined[dofs.start / c..dofs.end / c],
        };
        let may_turn = !held.get(dofs).is_some_and(|held| held.contains(&true));
        let known = firsts.entry(kind).or_default();
        let like = known.iter().find_map(|&first| {
            let rotation = motion(&model.subdomains[first], subdomain, c)?;
            (rotation.is_none() || may_turn).then_some(Like { first, rotation })
        });
        likes.push(like.unwrap_or_else(|| {
            known.push(b);
            Like { first: b, rotation: None }
        }));
    }
    likes
}

/// The rotation of the motion that takes every node of one body to that of the other; `Some(None)` for a translation. Turned
/// bodies are found in the plane.
fn motion(one: &BoundSubdomain, other: &BoundSubdomain, components: usize) -> Option<Option<Rotation>> {
    let (a, b) = (&one.mesh.points, &other.mesh.points);
    let (Some(&p), Some(&p_other), true) = (a.first(), b.first(), a.len() == b.len()) else { return None };
    let against = |x: &[f64; 3], p: &[f64; 3]| [x[0] - p[0], x[1] - p[1], x[2] - p[2]];
    let square = |v: &[f64; 3]| v.iter().map(|v| v * v).sum::<f64>();
    let far =
        (0..a.len()).max_by(|&i, &j| square(&against(&a[i], &p)).total_cmp(&square(&against(&a[j], &p))))?;
    let (v, v_other) = (against(&a[far], &p), against(&b[far], &p_other));
    let size = square(&v).sqrt();
    let largest = a.iter().chain(b).flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let tolerance = LARGEST * size + DIGITS * largest;
    if (square(&v_other).sqrt() - size).abs() > tolerance {
        return None;
    }
    let fits = |r: &[[f64; 3]; 3]| {
        a.iter().zip(b).all(|(x, y)| {
            let (x, y) = (against(x, &p), against(y, &p_other));
            let misses = |i: usize| (0..3).map(|j| r[i][j] * x[j]).sum::<f64>() - y[i];
            (0..3).all(|i| misses(i).abs() <= tolerance)
        })
    };
    let rotation = |cos: f64, sin: f64| [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
    if fits(&rotation(1.0, 0.0)) {
        return Some(None);
    }
    if components != 2 {
        return None;
    }
    let cos = (v[0] * v_other[0] + v[1] * v_other[1]) / (size * size);
    let sin = (v[0] * v_other[1] - v[1] * v_other[0]) / (size * size);
    // quarter turns exactly
    let rounded = rotation(cos.round(), sin.round());
    let exact = (cos.round().abs() + sin.round().abs() == 1.0).then_some(rounded).filter(|r| fits(r));
    let r = exact.or_else(|| Some(rotation(cos, sin)).filter(|r| fits(r)))?;
    Some(Some(Rotation { components, r }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turned_matrices_turn_forces_and_displacements() {
        let rotation = Rotation { components: 2, r: [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]] };
        let lower = Mat::from_fn(4, 4, |i, j| (1 + i.min(j) + 3 * i.max(j)) as f64);
        let turned = rotation.turned(&lower);
        let product = |lower: &Mat<f64>, x: &[f64]| -> Vec<f64> {
            (0..4).map(|i| (0..4).map(|j| lower[(i.max(j), i.min(j))] * x[j]).sum()).collect()
        };
        let x = [1.0, -2.0, 0.5, 3.0];
        let mut expected = product(&lower, &rotation.turned_back(&x));
        rotation.turn(&mut expected);
        let found = product(&turned, &x);
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12));
        let mut sizes = [5.0, 10.0];
        rotation.turn_sizes(&mut sizes);
        assert!((sizes[0] - 11.0).abs() < 1e-12 && (sizes[1] - 10.0).abs() < 1e-12);
    }
}
