//! Rigid motions that nothing holds, or next to nothing: found before anything is solved, and named.
//!
//! Every piece of every body (cells that hang together by edges) has three rigid motions in the plane. Supports, interfaces and nodes that
//! two pieces share resist combinations of them; the Gram
//! matrix of these resistances must have no null space. An interface counts by K h/E, up to 1: softer springs than the bodies
//! leave fewer digits of a motion that they alone resist.

use nalgebra::{DMatrix, SymmetricEigen};

use super::stiffness::compliance;
use super::unjoined::Connectivity;
use super::{BoundInterface, BoundStep};
use crate::assembly::{Model, RigidMotions};
use crate::error::{Code, Error, Result, Warning};
use crate::solver::lowest_below;

/// A motion is free if its resistance is below this. Of the largest resistance.
const FREE: f64 = 1e-12;
/// A motion is hardly held if its resistance is below this: the bends between the edges of a frictionless arc resist a
/// turn about its centre by less, and ever less on finer meshes. Of the largest resistance.
const HARDLY: f64 = 1e-6;

/// A piece of a body.
struct RigidPiece {
    subdomain: usize,
    nodes: Vec<usize>, // of the model
    motions: RigidMotions,
}

impl RigidPiece {
    /// A component of a motion at a node of the model.
    fn value(&self, model: &Model, mode: usize, node: usize, d: usize) -> f64 {
        let subdomain = &model.subdomains[self.subdomain];
        self.motions.value(mode, &subdomain.mesh.points[node - subdomain.first_node], d)
    }
}

/// True if the supports alone resist every rigid motion of a subdomain.
pub fn is_constrained(model: &Model, subdomain: usize, constrained: &[bool]) -> bool {
    let (c, of) = (model.components, &model.subdomains[subdomain]);
    let motions = RigidMotions::of(c, of.mesh.points.iter().map(|x| &x[..c]));
    let each = motions.count();
    let mut gram = DMatrix::<f64>::zeros(each, each);
    for (node, x) in of.mesh.points.iter().enumerate() {
        for d in (0..c).filter(|d| constrained[c * (of.first_node + node) + d]) {
            let row: Vec<f64> = (0..each).map(|mode| motions.value(mode, x, d)).collect();
            (0..each).for_each(|i| (0..each).for_each(|j| gram[(i, j)] += row[i] * row[j]));
        }
    }
    let limit = FREE * gram.diagonal().max();
    SymmetricEigen::new(gram).eigenvalues.min() > limit
}

/// Refuses the step if a body can move freely in it; warns if it almost can.
pub(super) fn check_free_subdomains(
    model: &Model,
    connectivity: &[Connectivity],
    interfaces: &[BoundInterface],
    step: &BoundStep,
) -> Result<Option<Warning>> {
    let (c, each) = (model.components, RigidMotions::most(model.components));
    let (parts, part_of, hinges) = parts(model, connectivity);
    let mut gram: Vec<(usize, usize, f64)> = Vec::new();
    for (p, part) in parts.iter().enumerate() {
        for d in 0..c {
            let constrained: Vec<usize> =
                part.nodes.iter().copied().filter(|node| step.constrained[c * node + d]).collect();
            let share = 1.0 / constrained.len() as f64; // many nodes hold no more than a few
            for node in constrained {
                let row: Vec<f64> = (0..each).map(|mode| part.value(model, mode, node, d)).collect();
                for i in 0..each {
                    for j in 0..each {
                        gram.push((each * p + i, each * p + j, share * row[i] * row[j]));
                    }
                }
            }
        }
    }
    for &(node, one, two) in &hinges {
        for d in 0..c {
            let of = |p: usize, sign: f64| -> Vec<(usize, f64)> {
                (0..each).map(|m| (each * p + m, sign * parts[p].value(model, m, node, d))).collect()
            };
            let row = [of(one, 1.0), of(two, -1.0)].concat();
            for &(i, own) in &row {
                for &(j, other) in &row {
                    gram.push((i, j, own * other));
                }
            }
        }
    }
    let mut u = vec![0.0; model.dofs()];
    let is_there = |b: usize| step.stage.as_ref().is_none_or(|stage| stage.present[b]);
    for (interface, BoundInterface { laws, .. }) in model.interfaces.iter().zip(interfaces) {
        if !interface.subdomains.iter().all(|&b| is_there(b)) {
            continue;
        }
        let mut nodes = interface.coupling.sides.each_ref().map(|side| side.nodes.as_slice()).concat();
        nodes.sort_unstable();
        nodes.dedup(); // both sides of a slit share its tips
        let mut touched: Vec<usize> = nodes.iter().map(|&node| part_of[node]).collect();
        touched.sort_unstable();
        touched.dedup();
        let mut jumps: Vec<(usize, Vec<f64>)> = Vec::new();
        for &p in &touched {
            for mode in 0..each {
                for &node in nodes.iter().filter(|&&node| part_of[node] == p) {
                    (0..c).for_each(|d| u[c * node + d] = parts[p].value(model, mode, node, d));
                }
                jumps.push((each * p + mode, interface.jumps(&u)));
                nodes.iter().for_each(|&node| u[c * node..c * (node + 1)].fill(0.0));
            }
        }
        let compliance = compliance(model, interface);
        let share = 1.0 / interface.coupling.points.len() as f64;
        let resists = laws.stiffest().map(|k| share * (k * compliance).min(1.0));
        for (i, jump_i) in &jumps {
            for (j, jump_j) in &jumps {
                let sum: f64 = (0..jump_i.len()).map(|k| resists[k % c] * jump_i[k] * jump_j[k]).sum();
                gram.push((*i, *j, sum));
            }
        }
    }
    let mut diagonal = vec![0.0; each * parts.len()];
    gram.iter().filter(|(i, j, _)| i == j).for_each(|&(i, _, value)| diagonal[i] += value);
    let limit = FREE * diagonal.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    // a pure motion reads better than a combination
    for (p, part) in parts.iter().enumerate() {
        for mode in 0..each {
            if diagonal[each * p + mode] <= limit {
                let mode = match ["x", "y", "z"][..c].get(mode) {
                    Some(axis) => format!("translation in {axis}"),
                    None => format!("rotation about {}", place(&part.motions.centre)),
                };
                return Err(free(model, connectivity, &parts, &[p], mode));
            }
        }
    }
    let Some((value, mode)) = lowest_below(diagonal.len(), &gram, limit / FREE * HARDLY, limit) else {
        return Ok(None);
    };
    let own = |p: usize| &mode[each * p..each * (p + 1)];
    let share = |p: usize| own(p).iter().copied().fold(0.0, f64::hypot);
    let largest = (0..parts.len()).map(share).fold(0.0, f64::max);
    let mut moving: Vec<usize> = (0..parts.len()).filter(|&p| share(p) > 1e-3 * largest).collect();
    moving.sort_by(|&p, &q| share(q).total_cmp(&share(p)));
    let text = told(&parts[moving[0]].motions, own(moving[0]));
    if value <= limit {
        return Err(free(model, connectivity, &parts, &moving, text));
    }
    let what = format!(
        "{} is hardly held against a {text}: {:.0e} of the largest resistance",
        named(model, connectivity, &parts, &moving),
        value / limit * FREE
    );
    let help =
        "hold it, or give its interfaces a stiffness in that direction: what it does is up to the mesh";
    Ok(Some(Warning::new(Code::HardlyHeld, what, help)))
}

/// A combination of motions in words: a translation along its direction, a rotation about its pole.
fn told(motions: &RigidMotions, shares: &[f64]) -> String {
    let (shifts, turns) = shares.split_at(motions.centre.len());
    let length = shifts.iter().copied().fold(0.0, f64::hypot);
    let turn = turns.iter().copied().fold(0.0, f64::hypot);
    if turn <= 1e-6 * length {
        let along: Vec<f64> = shifts.iter().map(|shift| shift / length).collect();
        return format!("translation along {}", place(&along));
    }
    let [tx, ty, turn] = *shares else { return format!("rotation about {}", place(&motions.centre)) };
    let omega = turn / motions.size; // u = t + ω ẑ × (x − centre) vanishes at the pole
    format!("rotation about {}", place(&[motions.centre[0] - ty / omega, motions.centre[1] + tx / omega]))
}

/// "(1.0000, 0.5000)".
fn place(coordinates: &[f64]) -> String {
    let all: Vec<String> = coordinates.iter().map(|x| format!("{x:.4}")).collect();
    format!("({})", all.join(", "))
}

fn free(
    model: &Model,
    connectivity: &[Connectivity],
    parts: &[RigidPiece],
    moving: &[usize],
    mode: String,
) -> Error {
    let subdomain = parts[moving[0]].subdomain;
    let mode = match connectivity[subdomain].told(&model.subdomains[subdomain]) {
        Some(told) => format!("{mode} ({told})"),
        None => mode,
    };
    Error::FreeBody { subdomain: named(model, connectivity, parts, moving), mode }
}

/// The bodies of some parts, the first before the others; a piece by its place.
fn named(model: &Model, connectivity: &[Connectivity], parts: &[RigidPiece], moving: &[usize]) -> String {
    let mut names: Vec<&str> =
        moving.iter().map(|&p| model.subdomains[parts[p].subdomain].name.as_str()).collect();
    names.dedup();
    let RigidPiece { subdomain, motions, .. } = &parts[moving[0]];
    let piece = if connectivity[*subdomain].pieces.count > 1 {
        format!("the piece around {} of ", place(&motions.centre))
    } else {
        String::new()
    };
    match names.as_slice() {
        [one] => format!("{piece}subdomain {one}"),
        [first, rest @ ..] => format!("{piece}subdomain {first} (with {})", rest.join(", ")),
        [] => String::new(),
    }
}

/// A node and two pieces that share it.
type Hinge = (usize, usize, usize);

/// The pieces of all bodies, a piece of every node, and the nodes that hold pieces together.
fn parts(model: &Model, connectivity: &[Connectivity]) -> (Vec<RigidPiece>, Vec<usize>, Vec<Hinge>) {
    let mut parts: Vec<RigidPiece> = Vec::new();
    let mut part_of = vec![usize::MAX; model.nodes()];
    let mut hinges = Vec::new();
    for (b, (subdomain, Connectivity { pieces, .. })) in model.subdomains.iter().zip(connectivity).enumerate()
    {
        let first = parts.len();
        parts.extend((0..pieces.count).map(|_| RigidPiece {
            subdomain: b,
            nodes: Vec::new(),
            motions: RigidMotions::new(vec![0.0; model.components], 1.0),
        }));
        for (cell, piece) in pieces.of_cell.iter().enumerate() {
            for node in subdomain.mesh.cells.nodes(cell) {
                let own = &mut part_of[subdomain.first_node + node];
                *own = (*own).min(first + piece);
            }
        }
        for node in subdomain.first_node..subdomain.first_node + subdomain.mesh.points.len() {
            parts[part_of[node]].nodes.push(node);
        }
        for (node, sharing) in &pieces.hinges {
            let node = subdomain.first_node + node;
            for other in &sharing[1..] {
                parts[first + other].nodes.push(node); // a support there holds every piece
                hinges.push((node, first + sharing[0], first + other));
            }
        }
    }
    for part in &mut parts {
        let subdomain = &model.subdomains[part.subdomain];
        let point = |node: usize| subdomain.mesh.points[node - subdomain.first_node];
        let range = |d: usize| {
            let values = part.nodes.iter().map(|&node| point(node)[d]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let ranges: Vec<(f64, f64)> = (0..model.components).map(range).collect();
        let centre = ranges.iter().map(|(low, high)| 0.5 * (low + high)).collect();
        let extent = ranges.iter().map(|(low, high)| high - low).fold(0.0, f64::max);
        part.motions = RigidMotions::new(centre, 0.5 * extent);
    }
    (parts, part_of, hinges)
}
