//! The equations of a problem: matrices, orderings and condensations that serve all its steps.
//!
//! A linear scene takes one factorisation per set of supports and two solves per step; any other iterates.

use std::sync::Arc;

use super::Engine;
use super::forms::{bases, blocks, condensed, joined, plain};
use super::linear::LinearEngine;
use super::strategy::{Operations, choose, condensed_interfaces, is_joined, plain_work};
use crate::assembly::{Pattern, Symmetric};
use crate::error::{Result, Stop};
use crate::history::{Clock, memory};
use crate::problem::{BoundInterface, Problem, stiffness_number};
use crate::scene::{Solution, Strategy, Tangent};
use crate::solver::{
    Continuum, FactorPlan, Linear, Method, NewtonSettings, SubdomainCache, System, TooLarge,
};

/// Bodies of linear scenes are shared with other runs if at most so many of their dofs are on interfaces.
const SHARED: usize = 12_000;

/// A linear scene of so many dofs is condensed, its bodies one by one, if interfaces have at most this multiple of the root of all dofs:
/// its factor has no fronts across interfaces then, and takes two thirds of the time.
const LINEAR: std::ops::RangeInclusive<usize> = 2_000..=200_000;
const FEW: f64 = 6.0;
/// K_N h/E at which nothing of its digits is lost so.
const MILD: std::ops::RangeInclusive<f64> = 1e-3..=1e3;

/// Newton's method gives up if the residual has not halved in so many iterations.
const PATIENCE: usize = 5;

/// Resources of a run.
#[derive(Debug, Clone)]
pub struct Means {
    /// Memory [bytes]; a run that needs more is refused before its first factor.
    pub memory: Option<u64>,
    /// Bodies shared with other runs.
    pub cache: Option<Arc<SubdomainCache>>,
    /// A request to stop, looked at between parts.
    pub stop: Stop,
    /// The form that an interrupted run had, where the scene leaves the choice.
    pub method: Option<Method>,
}

impl Default for Means {
    /// All memory there is, nothing shared.
    fn default() -> Means {
        Means { memory: memory::available(), cache: None, stop: Stop::default(), method: None }
    }
}

/// The equations of a problem, ready to be factored for any supports.
#[derive(Debug)]
pub struct Equations<'a> {
    problem: &'a Problem,
    /// Numbers of the interfaces whose jumps are unknowns.
    condensed_interfaces: Vec<usize>,
    /// Base stiffness at the law points of every interface.
    stiffness: Vec<Vec<f64>>,
    matrices: Matrices,
    /// A request to stop.
    pub(in crate::history) stop: Stop,
    /// Way in which they are solved.
    pub(in crate::history) method: Method,
    /// Work of all forms, where there is a choice.
    pub(in crate::history) operations: Option<Operations>,
    /// Entries of one factor.
    pub(in crate::history) factor_entries: usize,
}

#[derive(Debug)]
enum Matrices {
    /// One matrix of bodies and interfaces.
    Joined(Pattern, Symmetric, FactorPlan),
    /// Bodies condensed on their interfaces.
    Condensed(Continuum),
    /// The matrix of the bodies, to which the interfaces are added in every iteration.
    Apart(Pattern, Symmetric),
}

impl<'a> Equations<'a> {
    /// Assembles what the scene's strategy asks for, within the means.
    pub fn new(problem: &'a Problem, means: Means, clock: &mut Clock) -> Result<Equations<'a>> {
        let Means { memory: available, cache, stop, method: before } = means;
        clock.begin("assemble");
        let (model, strategy) = (&problem.model, problem.solution.strategy);
        let dofs = model.dofs();
        let too_large = |TooLarge| memory::too_large(dofs);
        let condensed_interfaces = condensed_interfaces(problem);
        let stiffness =
            (0..model.interfaces.len()).map(|k| base_stiffness(problem, k, &condensed_interfaces)).collect();
        let linear = condensed_interfaces.is_empty();
        let separator = || model.components * model.joined().into_iter().filter(|&joined| joined).count();
        let pays = || {
            let few = LINEAR.contains(&dofs) && separator() as f64 <= FEW * (dofs as f64).sqrt();
            let mild = || {
                let both = model.interfaces.iter().zip(&problem.interfaces);
                let number = |(k, bound): (_, &BoundInterface)| stiffness_number(model, k, &bound.laws);
                both.map(number).all(|number| MILD.contains(&number))
            };
            strategy == Strategy::Auto && (few && mild() || cache.is_some() && separator() <= SHARED)
        };
        if linear && !pays() {
            let pattern = model.pattern();
            let continuum = model.continuum(&pattern);
            let plan = order(problem, &pattern, available, clock)?;
            let (method, factor_entries) = (plan.method(), plan.entries());
            let matrices = Matrices::Joined(pattern, continuum, plan);
            return Ok(Equations {
                problem,
                condensed_interfaces,
                stiffness,
                matrices,
                stop,
                method,
                operations: None,
                factor_entries,
            });
        }
        let mut operations = None;
        if strategy != Strategy::Plain {
            let held = |dof: usize| problem.steps.iter().any(|step| step.constrained[dof]);
            let held: Vec<bool> = (0..dofs).map(held).collect();
            let continuum = Continuum::new(model, &held, cache).map_err(too_large)?;
            let (method, estimate) = choose(problem, &continuum, &condensed_interfaces, (available, before))?;
            operations = estimate;
            let factor_entries = continuum.entries();
            if method != Method::Plain {
                let every = || 0..model.interfaces.len();
                let stiffness = match method {
                    Method::Blocks => {
                        let all: Vec<usize> = every().collect();
                        every().map(|k| base_stiffness(problem, k, &all)).collect()
                    }
                    _ => stiffness,
                };
                let matrices = Matrices::Condensed(continuum);
                return Ok(Equations {
                    problem,
                    condensed_interfaces,
                    stiffness,
                    matrices,
                    stop,
                    method,
                    operations,
                    factor_entries,
                });
            }
        }
        let pattern = model.continuum_pattern();
        let continuum = model.continuum(&pattern);
        clock.begin("order");
        let (method, factor_entries) = (Method::Plain, plain_work(problem, &pattern).entries);
        let needed = memory::needed(size_of::<f64>() * factor_entries, pattern.rows.len(), dofs);
        memory::check_fits(dofs, factor_entries, needed, available)?;
        let matrices = Matrices::Apart(pattern, continuum);
        Ok(Equations {
            problem,
            condensed_interfaces,
            stiffness,
            matrices,
            stop,
            method,
            operations,
            factor_entries,
        })
    }

    /// The engine that solves them.
    pub(in crate::history) fn engine(&self) -> Box<dyn Engine + '_> {
        let Equations { problem, condensed_interfaces, stiffness, .. } = self;
        let interfaces = &problem.model.interfaces;
        let settings = settings(&problem.solution);
        match &self.matrices {
            Matrices::Joined(pattern, continuum, plan) => {
                let system = System { interfaces, stiffness, pattern, continuum };
                let make = move |constrained: &[bool]| Ok((Linear::new(system, plan, constrained)?, true));
                Box::new(LinearEngine::new(interfaces, Box::new(make)))
            }
            Matrices::Condensed(continuum) if self.method == Method::Blocks && is_joined(problem) => {
                Box::new(joined(problem, continuum, settings))
            }
            Matrices::Condensed(continuum) if self.method == Method::Blocks => {
                Box::new(blocks(problem, continuum, stiffness, settings))
            }
            Matrices::Condensed(continuum) if condensed_interfaces.is_empty() => {
                Box::new(LinearEngine::new(interfaces, bases(problem, continuum, stiffness)))
            }
            Matrices::Condensed(continuum) => {
                Box::new(condensed(problem, continuum, condensed_interfaces, stiffness, settings))
            }
            Matrices::Apart(pattern, continuum) => {
                Box::new(plain(problem, pattern, continuum, condensed_interfaces, stiffness, settings))
            }
        }
    }

    /// Bodies that are like no earlier one, where every one is condensed.
    pub(in crate::history) fn distinct(&self) -> Option<usize> {
        match &self.matrices {
            Matrices::Condensed(continuum) => Some(continuum.distinct().0),
            _ => None,
        }
    }

    /// Parts taken from other runs, such as "factor of lower".
    pub fn reused(&self) -> Vec<String> {
        let Matrices::Condensed(continuum) = &self.matrices else { return Vec::new() };
        let found = continuum.found();
        let named = |what: &'static str, subdomains: &[usize]| -> Vec<String> {
            subdomains
                .iter()
                .map(|&b| format!("{what} of {}", self.problem.model.subdomains[b].name))
                .collect()
        };
        [named("stiffness", &found.subdomains), named("factor", &found.factors)].concat()
    }
}

/// The elimination ordering of a matrix, refused if its factor does not fit.
fn order(
    problem: &Problem,
    pattern: &Pattern,
    available: Option<u64>,
    clock: &mut Clock,
) -> Result<FactorPlan> {
    clock.begin("order");
    let dofs = problem.model.dofs();
    let plan = FactorPlan::analyse(pattern, &problem.model.coordinates());
    let plan = plan.map_err(|TooLarge| memory::too_large(dofs))?;
    let needed = memory::needed(plan.bytes(), pattern.rows.len(), dofs);
    memory::check_fits(dofs, plan.entries(), needed, available)?;
    Ok(plan)
}

fn settings(solution: &Solution) -> NewtonSettings {
    let Solution { tolerance, iterations, tangent, .. } = *solution;
    let initial_tangent = tangent == Tangent::Initial;
    let patience = if initial_tangent { usize::MAX } else { PATIENCE };
    NewtonSettings { tolerance, iterations, patience, initial_tangent }
}

/// Base stiffness of an interface: its own unless its jumps are unknowns. Then at most E/h, which keeps floating bodies
/// in place: E of the softer body, h the mean length of the coarser side's edges. More than the law's own would only cancel.
fn base_stiffness(problem: &Problem, k: usize, condensed_interfaces: &[usize]) -> Vec<f64> {
    let (interface, laws) = (&problem.model.interfaces[k], &problem.interfaces[k].laws);
    let coupling = &interface.coupling;
    let edges = coupling.facets(0).min(coupling.facets(1));
    let young = interface.subdomains.map(|subdomain| problem.model.subdomains[subdomain].elasticity.young);
    let soft = young[0].min(young[1]) * edges as f64 / coupling.midplane.length;
    let most = if condensed_interfaces.contains(&k) { soft } else { f64::INFINITY };
    laws.diagonals(coupling, most)
}
