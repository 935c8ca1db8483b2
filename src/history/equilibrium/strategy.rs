//! The choice of a form: which interfaces have unknowns of their own, and which form of the equations takes less work.

use serde::{Deserialize, Serialize};

use crate::assembly::Pattern;
use crate::error::Result;
use crate::history::memory;
use crate::problem::{Problem, stiffness_number};
use crate::scene::Strategy;
use crate::solver::{Continuum, FloatingSubdomains, FrontWork, JoinedSubdomains, Method, Primal};

/// Iterations of an increment, for the estimate, and of a whole run at least: few increments come in many parts.
const ITERATIONS: f64 = 4.0;
const FEWEST: f64 = 100.0;

/// Work in operations of a dense factor that take as long, 10 ps each: measured over a dozen scenes of 80 to 260 000 dofs
/// (midplane_pipeline.bench.strategies). For a dof once, where bodies are condensed; for a dof and an iteration, whatever the form.
const CONDENSED_DOF: f64 = 4.5e5;
const DOF: f64 = 1.2e4;
const ITERATION: f64 = 5e7;
/// Cost of a condensed iteration by the square and the cube of its unknowns; only those of points that are not intact are factored, a
/// third where much slides.
const BY_UNKNOWN_SQUARED: f64 = 200.0;
const FACTORED: f64 = 0.2;
/// An operation of factors by fronts, a number that they hold, an unknown, and what an iteration takes beside them.
const FRONTS: [f64; 4] = [0.8, 86.0, 2.6e4, 3e7];

/// K_N h/E at which displacements of bodies have the digits of the forces between them: rounding is 1e-16 times it, or over it.
const EVEN: std::ops::RangeInclusive<f64> = 1e-5..=1e4;

/// Work that a run takes, estimated before it [multiplications and additions of a dense factor that take as long].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Operations {
    /// On the jumps of the interfaces.
    pub condensed: f64,
    /// On the displacements of the nodes on interfaces, sparse by bodies.
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
) -> Result<(Method, Option<Operations>)> {
    let (model, dofs) = (&problem.model, problem.model.dofs());
    let separator = continuum.separator() as f64;
    let dense = |coefficients: f64| continuum.separator().pow(2) + 5 * (coefficients as usize).pow(2);
    let needed = |numbers: usize| memory::needed(continuum.bytes() + size_of::<f64>() * numbers, 0, dofs);
    if condensed_interfaces.is_empty() {
        // displacements of a linear scene: no form is to be chosen
        let numbers = dense(0.0);
        memory::check_fits(dofs, continuum.entries() + numbers, needed(numbers), available)?;
        return Ok((Method::Condensed, None));
    }
    let coefficients = condensed_interfaces.iter().map(|&k| model.interfaces[k].size()).sum::<usize>() as f64;
    let changes = problem.steps.windows(2).filter(|pair| pair[0].constrained != pair[1].constrained).count();
    let sets = (1 + changes) as f64;
    let increments = problem.steps.iter().map(|step| step.increments).sum::<usize>() as f64;
    let iterations = if active(problem).is_empty() { sets } else { (ITERATIONS * increments).max(FEWEST) };
    let base = separator.powi(3) / 3.0 + separator * coefficients * (separator + coefficients);
    let subdomains = |b: usize| {
        let separator = continuum.separator_of(b).len() as f64;
        2.3 * separator.powi(3) // its factor, and flexibilities of as many unknowns
    };
    let fronts = |work: FrontWork| {
        FRONTS[0] * work.operations
            + FRONTS[1] * work.entries as f64
            + FRONTS[2] * work.unknowns as f64
            + FRONTS[3]
    };
    let every = iterations * (DOF * dofs as f64 + ITERATION);
    let (_, distinct) = continuum.distinct();
    let bodies = continuum.operations() + CONDENSED_DOF * distinct as f64 + every;
    let joined = is_joined(problem);
    let of_blocks = match joined {
        true => JoinedSubdomains::work(continuum, &model.interfaces),
        false => FloatingSubdomains::work(continuum, &model.interfaces),
    };
    let flexibilities: f64 = if joined { 0.0 } else { (0..continuum.subdomains()).map(subdomains).sum() };
    let alone = FrontWork { operations: continuum.operations(), entries: 0, unknowns: dofs };
    let mut estimate = Operations {
        condensed: bodies
            + sets * (base + 2.0 * coefficients.powi(3))
            + iterations * (BY_UNKNOWN_SQUARED * coefficients.powi(2) + FACTORED * coefficients.powi(3)),
        blocks: bodies + sets * flexibilities + iterations * fronts(of_blocks),
        plain: every + iterations * fronts(alone),
    };
    if estimate.plain < estimate.blocks.min(estimate.condensed) {
        // the bodies alone are the least: interfaces couple whole sides
        let work = plain_work(problem, &model.continuum_pattern());
        estimate.plain = every + iterations * fronts(work);
    }
    let dense = dense(coefficients);
    let fits = |numbers: usize| available.is_none_or(|available| needed(numbers) <= available);
    let method = match problem.solution.strategy {
        Strategy::Auto if problem.flows() => Method::Condensed,
        Strategy::Auto if before.is_some() => before.unwrap_or_default(),
        Strategy::Auto => {
            let condensed = if fits(dense) { estimate.condensed } else { f64::INFINITY };
            let plain = if joined { estimate.plain } else { f64::INFINITY };
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
    let numbers = match method {
        Method::Condensed => dense,
        Method::Blocks => of_blocks.entries,
        _ => 0,
    };
    if method != Method::Plain {
        memory::check_fits(dofs, continuum.entries() + numbers, needed(numbers), available)?;
    }
    Ok((method, Some(estimate)))
}

/// True if displacements will do as unknowns of `blocks`: jumps of stiff interfaces cannot be their differences, and of bodies that
/// are much stiffer than what carries them rounding leaves forces that are none.
pub(in crate::history) fn is_joined(problem: &Problem) -> bool {
    let mut all = problem.model.interfaces.iter().zip(&problem.interfaces);
    all.all(|(interface, bound)| {
        !bound.stiff && EVEN.contains(&stiffness_number(&problem.model, interface, &bound.laws))
    })
}

/// Work of a factor of `plain`, for the pattern of the bodies.
pub(super) fn plain_work(problem: &Problem, bodies: &Pattern) -> FrontWork {
    Primal::work(bodies, problem.model.coordinates(), &problem.model.interfaces)
}
