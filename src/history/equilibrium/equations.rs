//! The equations of a problem: matrices, orderings and condensations that serve all its steps.
//!
//! A linear scene takes one factorisation per set of supports and two solves per step; any other iterates.

use std::sync::Arc;

use super::Engine;
use super::forms::{bases, blocks, condensed, plain};
use super::linear::LinearEngine;
use super::strategy::{Operations, asked, choose};
use crate::assembly::{Pattern, Symmetric};
use crate::error::Result;
use crate::history::{Clock, memory};
use crate::problem::Problem;
use crate::scene::{Solution, Strategy, Tangent};
use crate::solver::{
    Continuum, FactorPlan, Linear, Method, NewtonSettings, SubdomainCache, System, TooLarge,
};

/// Bodies of linear scenes are shared with other runs if at most so many of their dofs are on joints.
const SHARED: usize = 12_000;

/// Newton's method gives up if the residual has not halved in so many iterations.
const PATIENCE: usize = 5;

/// Resources of a run.
#[derive(Debug, Clone)]
pub struct Means {
    /// Memory [bytes]; a run that needs more is refused before its first factor.
    pub memory: Option<u64>,
    /// Bodies shared with other runs.
    pub shelf: Option<Arc<SubdomainCache>>,
}

impl Default for Means {
    /// All memory there is, nothing shared.
    fn default() -> Means {
        Means { memory: memory::available(), shelf: None }
    }
}

/// The equations of a problem, ready to be factored for any supports.
#[derive(Debug)]
pub struct Equations<'a> {
    problem: &'a Problem,
    /// Numbers of the interfaces whose jumps are unknowns.
    asked: Vec<usize>,
    /// Base stiffness at the law points of every interface.
    stiffness: Vec<Vec<f64>>,
    matrices: Matrices,
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
        let Means { memory: available, shelf } = means;
        clock.begin("assemble");
        let (model, strategy) = (&problem.model, problem.solution.strategy);
        let dofs = model.dofs();
        let too_large = |TooLarge| memory::too_large(dofs);
        let asked = asked(problem);
        let stiffness = (0..model.joints.len()).map(|k| springs(problem, k, &asked)).collect();
        let linear = asked.is_empty();
        // a linear scene needs its condensation once, which pays only if others have it too
        let shared = strategy == Strategy::Auto && shelf.is_some();
        let border = || model.components * model.joined().into_iter().filter(|&joined| joined).count();
        if linear && !(shared && border() <= SHARED) {
            let pattern = model.pattern();
            let continuum = model.continuum(&pattern);
            let plan = order(problem, &pattern, available, clock)?;
            let (method, factor_entries) = (plan.method(), plan.entries());
            let matrices = Matrices::Joined(pattern, continuum, plan);
            return Ok(Equations {
                problem,
                asked,
                stiffness,
                matrices,
                method,
                operations: None,
                factor_entries,
            });
        }
        let mut operations = None;
        if strategy != Strategy::Plain {
            let continuum = Continuum::new(model, shelf).map_err(too_large)?;
            let (method, estimate) = choose(problem, &continuum, &asked, available)?;
            operations = Some(estimate).filter(|_| !linear);
            let factor_entries = continuum.entries();
            if method != Method::Plain {
                let every = || 0..model.joints.len();
                let stiffness = match method {
                    Method::Blocks => {
                        let all: Vec<usize> = every().collect();
                        every().map(|k| springs(problem, k, &all)).collect()
                    }
                    _ => stiffness,
                };
                let matrices = Matrices::Condensed(continuum);
                return Ok(Equations {
                    problem,
                    asked,
                    stiffness,
                    matrices,
                    method,
                    operations,
                    factor_entries,
                });
            }
        }
        let pattern = model.continuum_pattern();
        let continuum = model.continuum(&pattern);
        let plan = order(problem, &pattern, available, clock)?;
        let (method, factor_entries) = (Method::Plain, plan.entries());
        let matrices = Matrices::Apart(pattern, continuum);
        Ok(Equations { problem, asked, stiffness, matrices, method, operations, factor_entries })
    }

    /// The engine that solves them.
    pub(in crate::history) fn engine(&self) -> Box<dyn Engine + '_> {
        let Equations { problem, asked, stiffness, .. } = self;
        let joints = &problem.model.joints;
        let settings = settings(&problem.solution);
        match &self.matrices {
            Matrices::Joined(pattern, continuum, plan) => {
                let system = System { joints, stiffness, pattern, continuum };
                let make = move |held: &[bool]| Ok((Linear::new(system, plan, held)?, true));
                Box::new(LinearEngine::new(joints, Box::new(make)))
            }
            Matrices::Condensed(continuum) if self.method == Method::Blocks => {
                Box::new(blocks(problem, continuum, stiffness, settings))
            }
            Matrices::Condensed(continuum) if asked.is_empty() => {
                Box::new(LinearEngine::new(joints, bases(problem, continuum, stiffness)))
            }
            Matrices::Condensed(continuum) => {
                Box::new(condensed(problem, continuum, asked, stiffness, settings))
            }
            Matrices::Apart(pattern, continuum) => {
                Box::new(plain(problem, pattern, continuum, asked, stiffness, settings))
            }
        }
    }

    /// Parts taken from other runs, such as "factor of lower".
    pub fn reused(&self) -> Vec<String> {
        let Matrices::Condensed(continuum) = &self.matrices else { return Vec::new() };
        let found = continuum.found();
        let named = |what: &'static str, bodies: &[usize]| -> Vec<String> {
            bodies.iter().map(|&b| format!("{what} of {}", self.problem.model.bodies[b].name)).collect()
        };
        [named("stiffness", &found.bodies), named("factor", &found.factors)].concat()
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
    memory::refuse(dofs, plan.entries(), needed, available)?;
    Ok(plan)
}

fn settings(solution: &Solution) -> NewtonSettings {
    let Solution { tolerance, iterations, tangent, .. } = *solution;
    let initial_tangent = tangent == Tangent::Initial;
    let patience = if initial_tangent { usize::MAX } else { PATIENCE };
    NewtonSettings { tolerance, iterations, patience, initial_tangent }
}

/// Law stiffness of a joint's springs: its own unless its jumps are unknowns. Then at most E/h, which keeps floating bodies
/// in place: E of the softer body, h the mean length of the coarser side's edges. More than the law's own would only cancel.
fn springs(problem: &Problem, k: usize, asked: &[usize]) -> Vec<f64> {
    let (joint, (law, _)) = (&problem.model.joints[k], &problem.laws[k]);
    let midplane = &joint.coupling.midplane;
    let edges = midplane.a.edges().min(midplane.b.edges());
    let young = joint.bodies.map(|body| problem.model.bodies[body].elasticity.young);
    let soft = young[0].min(young[1]) * edges as f64 / midplane.length;
    let most = if asked.contains(&k) { soft } else { f64::INFINITY };
    let [kn, kt] = law.elastic_stiffness().map(|stiffness| stiffness.min(most));
    [kn, 0.0, 0.0, kt].repeat(joint.coupling.points.len())
}
