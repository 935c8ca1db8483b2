//! Rigid motions that nothing holds, or next to nothing: found before anything is solved, and named.
//!
//! Every piece of every body (cells that hang together by edges) has three rigid motions. Supports, interfaces and nodes that
//! two pieces share resist combinations of them; the Gram
//! matrix of these resistances must have no null space. An interface counts by K h/E, up to 1: softer springs than the bodies
//! leave fewer digits of a motion that they alone resist.

use nalgebra::{DMatrix, SymmetricEigen};

use super::stiffness::compliance;
use super::unjoined::Connectivity;
use super::{BoundInterface, BoundStep};
use crate::assembly::Model;
use crate::error::{Code, Error, Result, Warning};

/// A motion is free if its resistance is below this. Of the largest resistance.
const FREE: f64 = 1e-12;
/// A motion is hardly held if its resistance is below this: the bends between the edges of a frictionless arc resist a
/// turn about its centre by less, and ever less on finer meshes. Of the largest resistance.
const HARDLY: f64 = 1e-6;

/// A piece of a body.
struct RigidPiece {
    subdomain: usize,
    nodes: Vec<usize>, // of the model
    centre: [f64; 2],
    size: f64,
}

/// True if the supports alone resist every rigid motion of a subdomain.
pub fn is_constrained(model: &Model, subdomain: usize, constrained: &[bool]) -> bool {
    let of = &model.subdomains[subdomain];
    let mut gram = DMatrix::<f64>::zeros(3, 3);
    let count = of.mesh.points.len() as f64;
    let centre = [0, 1].map(|d| of.mesh.points.iter().map(|x| x[d]).sum::<f64>() / count);
    let reach = |x: &[f64; 3]| (x[0] - centre[0]).hypot(x[1] - centre[1]);
    let size = of.mesh.points.iter().map(reach).fold(0.0, f64::max);
    for (node, x) in of.mesh.points.iter().enumerate() {
        let turn = [-(x[1] - centre[1]) / size, (x[0] - centre[0]) / size];
        for d in (0..2).filter(|d| constrained[model.components * (of.first_node + node) + d]) {
            let row = [f64::from(d == 0), f64::from(d == 1), turn[d]];
            (0..3).for_each(|i| (0..3).for_each(|j| gram[(i, j)] += row[i] * row[j]));
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
    let (parts, part_of, hinges) = parts(model, connectivity);
    let motion = |part: &RigidPiece, mode: usize, node: usize| -> [f64; 2] {
        let subdomain = &model.subdomains[part.subdomain];
        let x = subdomain.mesh.points[node - subdomain.first_node];
        match mode {
            0 => [1.0, 0.0],
            1 => [0.0, 1.0],
            _ => [-(x[1] - part.centre[1]) / part.size, (x[0] - part.centre[0]) / part.size],
        }
    };
    let mut gram = DMatrix::<f64>::zeros(3 * parts.len(), 3 * parts.len());
    for (p, part) in parts.iter().enumerate() {
        for d in 0..2 {
            let constrained: Vec<usize> = part
                .nodes
                .iter()
                .copied()
                .filter(|node| step.constrained[model.components * node + d])
                .collect();
            let share = 1.0 / constrained.len() as f64; // many nodes hold no more than a few
            for node in constrained {
                let row = [0, 1, 2].map(|mode| motion(part, mode, node)[d]);
                for i in 0..3 {
                    for j in 0..3 {
                        gram[(3 * p + i, 3 * p + j)] += share * row[i] * row[j];
                    }
                }
            }
        }
    }
    for &(node, one, two) in &hinges {
        let rows = [0, 1].map(|d| {
            let of = |p: usize, sign: f64| {
                [0, 1, 2].map(|mode| (3 * p + mode, sign * motion(&parts[p], mode, node)[d]))
            };
            [of(one, 1.0), of(two, -1.0)].concat()
        });
        for row in rows {
            for &(i, own) in &row {
                for &(j, other) in &row {
                    gram[(i, j)] += own * other;
                }
            }
        }
    }
    let mut u = vec![0.0; model.dofs()];
    for (interface, BoundInterface { law, .. }) in model.interfaces.iter().zip(interfaces) {
        let mut nodes = interface.coupling.sides.each_ref().map(|side| side.nodes.as_slice()).concat();
        nodes.sort_unstable();
        nodes.dedup(); // both sides of a slit share its tips
        let mut touched: Vec<usize> = nodes.iter().map(|&node| part_of[node]).collect();
        touched.sort_unstable();
        touched.dedup();
        let mut jumps: Vec<(usize, Vec<f64>)> = Vec::new();
        for &p in &touched {
            for mode in 0..3 {
                for &node in nodes.iter().filter(|&&node| part_of[node] == p) {
                    let motion = motion(&parts[p], mode, node);
                    u[model.components * node..model.components * node + 2].copy_from_slice(&motion);
                }
                jumps.push((3 * p + mode, interface.jumps(&u)));
                for &node in &nodes {
                    u[model.components * node..model.components * node + 2].copy_from_slice(&[0.0; 2]);
                }
            }
        }
        let compliance = compliance(model, interface);
        let share = 1.0 / interface.coupling.points.len() as f64;
        let resists = law.elastic_stiffness().map(|k| share * (k * compliance).min(1.0));
        for (i, jump_i) in &jumps {
            for (j, jump_j) in &jumps {
                let sum: f64 =
                    (0..jump_i.len()).map(|k| resists[k % model.components] * jump_i[k] * jump_j[k]).sum();
                gram[(*i, *j)] += sum;
            }
        }
    }
    let limit = FREE * gram.diagonal().max().max(f64::MIN_POSITIVE);
    // a pure motion reads better than a combination
    for (p, part) in parts.iter().enumerate() {
        for (mode, text) in ["translation in x", "translation in y", "rotation"].into_iter().enumerate() {
            if gram[(3 * p + mode, 3 * p + mode)] <= limit {
                let [x, y] = part.centre;
                let mode =
                    if mode == 2 { format!("{text} about ({x:.4}, {y:.4})") } else { text.to_string() };
                return Err(free(model, connectivity, &parts, &[p], mode));
            }
        }
    }
    let eigen = SymmetricEigen::new(gram);
    let (least, value) = eigen.eigenvalues.argmin();
    if value > limit / FREE * HARDLY {
        return Ok(None);
    }
    let mode = eigen.eigenvectors.column(least);
    let share = |p: usize| mode.rows(3 * p, 3).norm();
    let largest = (0..parts.len()).map(share).fold(0.0, f64::max);
    let mut moving: Vec<usize> = (0..parts.len()).filter(|&p| share(p) > 1e-3 * largest).collect();
    moving.sort_by(|&p, &q| share(q).total_cmp(&share(p)));
    let part = &parts[moving[0]];
    let [tx, ty, turn] = [0, 1, 2].map(|k| mode[3 * moving[0] + k]);
    let text = if turn.abs() <= 1e-6 * tx.hypot(ty) {
        format!("translation along ({:.4}, {:.4})", tx / tx.hypot(ty), ty / tx.hypot(ty))
    } else {
        let omega = turn / part.size; // u = t + ω ẑ × (x − centre) vanishes at the pole
        format!("rotation about ({:.4}, {:.4})", part.centre[0] - ty / omega, part.centre[1] + tx / omega)
    };
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
    let RigidPiece { subdomain, centre: [x, y], .. } = &parts[moving[0]];
    let piece = if connectivity[*subdomain].pieces.count > 1 {
        format!("the piece around ({x:.4}, {y:.4}) of ")
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
            centre: [0.0; 2],
            size: 0.0,
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
        let (x, y) = (range(0), range(1));
        part.centre = [0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)];
        part.size = 0.5 * (x.1 - x.0).max(y.1 - y.0);
    }
    (parts, part_of, hinges)
}
