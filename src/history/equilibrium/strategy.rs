//! The choice of a form: which interfaces have unknowns of their own, and which form of the equations takes less work.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::history::memory;
use crate::problem::Problem;
use crate::scene::Strategy;
use crate::solver::{Continuum, Method, Symbolic, TooLarge};

/// Iterations of an increment, for the estimate.
const ITERATIONS: f64 = 4.0;

/// Work beside that of a dense factor, in its operations: measured over a dozen scenes of 80 to 35 000 dofs (benches/strategies.py).
/// Setting up the condensed form gains from large products; of its system an iteration factors what is not intact, a third of the
/// points where much slides.
const SETUP: f64 = 1.0 / 3.0;
const BY_UNKNOWN_SQUARED: f64 = 120.0;
const FACTORED: f64 = 0.2;
/// An operation of sparse factors by blocks and of sparse factors on all displacements, and what a dof and an iteration take beside
/// them.
const BLOCKS: [f64; 3] = [4.5, 3e3, 6e6];
const PLAIN: [f64; 3] = [17.0, 2.5e4, 2e6];

/// Work that a run takes, estimated before it [multiplications and additions of a dense factor that take as long].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Operations {
    /// On the jumps of the interfaces.
    pub condensed: f64,
    /// On these and the motions of the bodies, by blocks.
    pub blocks: f64,
    /// On all displacements.
    pub plain: f64,
}

/// Interfaces that are not elastic.
pub(in crate::history) fn active(problem: &Problem) -> Vec<usize> {
    let interfaces = problem.interfaces.iter().enumerate();
    interfaces.filter(|(_, interface)| !interface.is_linear()).map(|(k, _)| k).collect()
}

/// Interfaces whose jumps are unknowns of the condensed form: those that are not elastic or stiff. None if the scene is linear
/// and its displacements will do.
pub(in crate::history) fn condensed_interfaces(problem: &Problem) -> Vec<usize> {
    let active = active(problem);
    match problem.solution.strategy {
        Strategy::Plain => return active,
        Strategy::Condensed if active.is_empty() => return (0..problem.interfaces.len()).collect(),
        Strategy::Blocks => return (0..problem.interfaces.len()).collect(),
        _ => {}
    }
    (0..problem.interfaces.len()).filter(|k| problem.interfaces[*k].stiff || active.contains(k)).collect()
}

/// Chooses the form: as asked for, or the one with the least work that fits into memory. Stiff elastic interfaces need their jumps
/// as unknowns. What an interrupted run chose `before` stands.
pub(in crate::history) fn choose(
    problem: &Problem,
    continuum: &Continuum,
    condensed_interfaces: &[usize],
    (available, before): (Option<u64>, Option<Method>),
) -> Result<(Method, Operations)> {
    let (model, dofs) = (&problem.model, problem.model.dofs());
    let separator = continuum.separator() as f64;
    let coefficients = condensed_interfaces.iter().map(|&k| model.interfaces[k].size()).sum::<usize>() as f64;
    let changes = problem.steps.windows(2).filter(|pair| pair[0].constrained != pair[1].constrained).count();
    let sets = (1 + changes) as f64;
    let increments = problem.steps.iter().map(|step| step.increments).sum::<usize>() as f64;
    let iterations = if active(problem).is_empty() { sets } else { ITERATIONS * increments };
    let base = separator.powi(3) / 3.0 + separator * coefficients * (separator + coefficients);
    let subdomains = |b: usize| {
        let separator = continuum.separator_of(b).len() as f64;
        2.3 * separator.powi(3) // its factor, and flexibilities of as many unknowns
    };
    let iteration =
        |[operation, dof, own]: [f64; 3], factor: f64| operation * factor + dof * dofs as f64 + own;
    let mut estimate = Operations {
        condensed: SETUP * (continuum.operations() + sets * (base + 2.0 * coefficients.powi(3)))
            + iterations * (BY_UNKNOWN_SQUARED * coefficients.powi(2) + FACTORED * coefficients.powi(3)),
        blocks: continuum.operations()
            + sets * (0..continuum.subdomains()).map(subdomains).sum::<f64>()
            + iterations * iteration(BLOCKS, by_blocks(problem)),
        plain: iterations * iteration(PLAIN, continuum.operations()),
    };
    if estimate.plain < estimate.blocks.min(estimate.condensed) {
        // the bodies alone are the least: interfaces couple whole sides
        let joined =
            Symbolic::minimum_degree(&model.pattern()).map_err(|TooLarge| memory::too_large(dofs))?;
        estimate.plain = iterations * iteration(PLAIN, joined.operations());
    }
    let dense = continuum.separator().pow(2) + 5 * (coefficients as usize).pow(2);
    let needed = memory::needed(continuum.bytes() + size_of::<f64>() * dense, 0, dofs);
    let fits = available.is_none_or(|available| needed <= available);
    let method = match problem.solution.strategy {
        Strategy::Auto if condensed_interfaces.is_empty() || problem.flows() => Method::Condensed,
        Strategy::Auto if before.is_some() => before.unwrap_or_default(),
        Strategy::Auto => {
            let stiff = condensed_interfaces.iter().any(|&k| problem.interfaces[k].stiff);
            let condensed = if fits { estimate.condensed } else { f64::INFINITY };
            let plain = if stiff { f64::INFINITY } else { estimate.plain };
            match estimate.blocks {
                blocks if condensed <= blocks && condensed <= plain => Method::Condensed,
                blocks if blocks <= plain => Method::Blocks,
                _ => Method::Plain,
            }
        }
        Strategy::Condensed => Method::Condensed,
        Strategy::Blocks => Method::Blocks,
        Strategy::Plain => Method::Plain,
    };
    if method == Method::Condensed {
        memory::check_fits(dofs, continuum.entries(), needed, available)?;
    }
    Ok((method, estimate))
}

/// Work of an LU of the interfaces' unknowns, interface by interface in the order of least degree: those of one body are all connected.
fn by_blocks(problem: &Problem) -> f64 {
    let interfaces = &problem.model.interfaces;
    let mut beside: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); interfaces.len()];
    for subdomain in 0..problem.model.subdomains.len() {
        let of: Vec<usize> =
            (0..interfaces.len()).filter(|&k| interfaces[k].subdomains.contains(&subdomain)).collect();
        of.iter().for_each(|&k| beside[k].extend(of.iter().filter(|&&other| other != k)));
    }
    let front = |set: &BTreeSet<usize>| set.iter().map(|&k| interfaces[k].size()).sum::<usize>() as f64;
    let (mut left, mut work): (Vec<usize>, f64) = ((0..interfaces.len()).collect(), 0.0);
    while let Some(at) = (0..left.len()).min_by(|&a, &b| {
        front(&beside[left[a]]).total_cmp(&front(&beside[left[b]])) // ties in the order of the interfaces
    }) {
        let k = left.remove(at);
        let neighbours = std::mem::take(&mut beside[k]);
        let (own, rest) = (interfaces[k].size() as f64, front(&neighbours));
        work += own.powi(3) * 2.0 / 3.0 + 2.0 * own * own * rest + 2.0 * own * rest * rest;
        for &a in &neighbours {
            beside[a].remove(&k);
            beside[a].extend(neighbours.iter().filter(|&&b| b != a));
        }
    }
    work
}
