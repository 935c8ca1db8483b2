//! The march through the load history. A linear scene takes one factorisation per set of supports and two solves per
//! step; any other iterates, and divides an increment that finds no equilibrium.

use std::sync::Arc;

use serde::Serialize;

use super::beyond::Beyond;
use super::course::Course;
use super::equilibrium::Engine;
use super::equilibrium::linear::LinearEngine;
use super::equilibrium::newton::NewtonEngine;
use super::equilibrium::strategy::{self, Estimate, asked};
use super::state::State;
use super::{Clock, memory};
use crate::error::{Code, Result, Warning};
use crate::problem::{Problem, Stage};
use crate::scene::{Solution, Strategy, Tangent};
use crate::solver::{Continuum, Plan, Settings, Shelf, System, TooLarge};

/// Bodies of linear scenes are shared with other runs if at most so many of their dofs are on joints.
const SHARED: usize = 12_000;

/// Newton's method gives up if the residual has not halved in so many iterations.
const PATIENCE: usize = 5;

/// Counts over a whole march.
#[derive(Debug, Clone, Default)]
pub struct Totals {
    /// Increments done.
    pub increments: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Newton iterations, those of failed increments included.
    pub iterations: usize,
    /// Parts in which the increments were found.
    pub parts: usize,
    /// Parts that were sought and not kept.
    pub rejected: usize,
    /// How the equations are solved.
    pub strategy: &'static str,
    /// The work of both forms, where there is a choice.
    pub estimate: Option<Estimate>,
    /// Entries of one factor.
    pub factor_entries: usize,
    /// Largest residual of all increments.
    pub residual: f64,
    /// Where the load level turned on the path of equilibria: number of the increment, step, load level.
    pub turns: Vec<(usize, String, f64)>,
    /// What was taken from the shelf, such as "factor of lower".
    pub reused: Vec<String>,
    /// Snaps to another branch of equilibria.
    pub snaps: Vec<Snap>,
    /// Energy released by snaps [force × length].
    pub released: f64,
    /// Largest |work − stored − dissipated − released|, relative.
    pub energy_balance: f64,
    /// Number of the increment with that balance.
    pub balance_at: usize,
    /// Largest out-of-balance of loads and reactions, relative.
    pub imbalance: f64,
    /// Number of the increment with that out-of-balance.
    pub imbalance_at: usize,
    /// Subdomains that nothing holds any more, each with the increment since which.
    pub unheld: Vec<(String, usize)>,
    /// Jumps beyond the range of the pairs.
    pub beyond: Vec<Beyond>,
    /// Out-of-balance of the initial tractions over their sum, and the energy that they release [force × length].
    pub initial: [f64; 2],
}

/// A snap: from where no equilibrium continues the path to a stable one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Snap {
    /// Number of the increment over all steps.
    pub increment: usize,
    /// Name of the step.
    pub step: String,
    /// Load factor at which half of the energy is released.
    pub load_factor: f64,
    /// Load factors between which it is followed.
    pub between: [f64; 2],
    /// Interface that takes most of it.
    pub interface: String,
    /// Law point there that takes most of it.
    pub at: [f64; 2],
    /// Energy released [force × length].
    pub released: f64,
}

/// Loads and reactions that are further from balance, relative to them, are told; further than the second, no equilibrium.
pub(super) const UNBALANCED: f64 = 1e-6;
pub(super) const NO_BALANCE: f64 = 1e-3;
/// An energy balance of so many times the tolerance of the path is told.
const ENERGY: f64 = 10.0;
/// Initial tractions that are out of balance by less than this part are in equilibrium.
const IN_BALANCE: f64 = 1e-6;

impl Totals {
    /// What the user should know of how the increments went.
    pub fn warnings(&self, path_tolerance: f64) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if let Some(Snap { step, load_factor, interface, at: [x, y], .. }) = self.snaps.first() {
            let (count, released) = (self.snaps.len(), self.released);
            let times = if count == 1 { "once".to_string() } else { format!("{count} times") };
            let what = format!(
                "step \"{step}\": snapped to another branch {times}, first at load factor {load_factor:.6} by {interface} \
                 at ({x:.4}, {y:.4}); {released:.3e} of energy released in all"
            );
            let help = "\"control\": \"auto\" follows the path between; where it snaps too, more edges over the cohesive zone";
            warnings.push(Warning::new(Code::Snapped, what, help));
        }
        if self.imbalance > UNBALANCED {
            let what = format!(
                "increment {}: loads and reactions are out of balance by {:.1e} of their sum",
                self.imbalance_at, self.imbalance
            );
            warnings.push(Warning::new(
                Code::Unbalanced,
                what,
                "a smaller solution.tolerance, or another strategy",
            ));
        }
        if self.energy_balance > ENERGY * path_tolerance {
            let what = format!(
                "increment {}: energies are out of balance by {:.1e} of the largest",
                self.balance_at, self.energy_balance
            );
            let help =
                "more increments or a smaller solution.path_tolerance show what it means for the answer";
            warnings.push(Warning::new(Code::Energies, what, help));
        }
        if self.initial[0] > IN_BALANCE {
            let what = format!(
                "initial tractions are out of balance with the first step's loads by {:.1} % of their sum; they relax before \
                 the first increment and release {:.3e} of energy",
                100.0 * self.initial[0],
                self.initial[1]
            );
            let help = "give loads and supports at load factor 0 that hold them, such as a pressure \"5 + 0*load_factor\"";
            warnings.push(Warning::new(Code::InitialTraction, what, help));
        }
        for (name, increment) in &self.unheld {
            let what = format!(
                "subdomain {name}: nothing holds it from increment {increment} on, and nothing pushes it; it stays where it is"
            );
            warnings.push(Warning::new(Code::Unheld, what, "a support, if it should not float"));
        }
        for Beyond { interface, opens, increment, jump, edges, at: [x, y] } in &self.beyond {
            let kind = if *opens { "opening" } else { "slip" };
            let what = format!(
                "interface {interface}: {kind} of {jump:.3e} is {edges:.1} edges near ({x:.4}, {y:.4}), more than one from increment \
                 {increment} on; the sides are paired as they are before any displacement"
            );
            let help = "results hold for jumps that are small beside the edges: a smaller displacement, or coarser edges there";
            warnings.push(Warning::new(Code::Beyond, what, help));
        }
        warnings
    }
}

/// Where in the history a state stands.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    /// Number of the step, from 0.
    pub step: usize,
    /// The step.
    pub stage: &'a Stage,
    /// Number of the increment within its step, from 1; 0 is the unloaded state before the first.
    pub number: usize,
    /// Number of the increment over all steps.
    pub increment: usize,
    /// Load level in the step, 0 to 1.
    pub load_factor: f64,
    /// Newton iterations since the increment before.
    pub iterations: usize,
    /// The last increment of its step.
    pub last: bool,
    /// The state of the last increment again, complete: no equilibrium was found beyond.
    pub ended: bool,
}

/// Called after the unloaded state (`number` 0) and after every increment, with the running counts.
pub type Visit<'a> = &'a mut dyn FnMut(Place, &State, &Totals, &mut Clock) -> Result<()>;

/// What a march may use.
#[derive(Debug, Clone)]
pub struct Means {
    /// Memory [bytes]; a march that needs more is refused before its first factor.
    pub memory: Option<u64>,
    /// Bodies shared with other runs.
    pub shelf: Option<Arc<Shelf>>,
}

/// Marches through all steps. `stage` hears of every stage of work.
pub fn march(
    problem: &Problem,
    clock: &mut Clock,
    stage: &mut dyn FnMut(&'static str),
    visit: Visit,
) -> Result<Totals> {
    let means = Means { memory: memory::available(), shelf: None };
    march_within(means, problem, clock, stage, visit)
}

/// `march` with what there is.
pub fn march_within(
    Means { memory: available, shelf }: Means,
    problem: &Problem,
    clock: &mut Clock,
    stage: &mut dyn FnMut(&'static str),
    visit: Visit,
) -> Result<Totals> {
    let mut begin = |clock: &mut Clock, name: &'static str| {
        stage(name);
        clock.begin(name);
    };
    begin(clock, "assemble");
    let (model, strategy) = (&problem.model, problem.solution.strategy);
    let dofs = model.dofs();
    let too_large = |TooLarge| memory::too_large(dofs);
    let asked = asked(problem);
    let mut stiffness: Vec<Vec<f64>> = (0..model.joints.len()).map(|k| springs(problem, k, &asked)).collect();
    let mut totals = Totals::default();
    let linear = asked.is_empty();
    // a linear scene needs its condensation once, which pays only if others have it too
    let shared = strategy == Strategy::Auto && shelf.is_some();
    let border = || model.components * model.joined().into_iter().filter(|&joined| joined).count();
    if linear && !(shared && border() <= SHARED) {
        let (pattern, joints) = (&model.pattern(), &model.joints);
        let continuum = &model.continuum(pattern);
        let system = System { joints, stiffness: &stiffness, pattern, continuum };
        begin(clock, "order");
        let plan = Plan::analyse(pattern, &model.coordinates()).map_err(too_large)?;
        let needed = memory::needed(plan.bytes(), pattern.rows.len(), dofs);
        memory::refuse(dofs, plan.entries(), needed, available)?;
        (totals.strategy, totals.factor_entries) = (plan.strategy(), plan.entries());
        let engine = &mut LinearEngine::joined(&system, &plan);
        return Course::new(problem, engine, totals, clock, &mut begin, visit).march();
    }
    let settings = settings(&problem.solution);
    if strategy != Strategy::Plain {
        let continuum = &Continuum::new(model, shelf).map_err(too_large)?;
        let (strategy, estimate) = strategy::choose(problem, continuum, &asked, available)?;
        totals.estimate = Some(estimate).filter(|_| !linear);
        totals.factor_entries = continuum.entries();
        let engine: Option<Box<dyn Engine>> = match strategy {
            Strategy::Plain => None,
            Strategy::Blocks => {
                let every: Vec<usize> = (0..model.joints.len()).collect();
                stiffness = every.iter().map(|&k| springs(problem, k, &every)).collect();
                totals.strategy = "blocks";
                Some(Box::new(NewtonEngine::blocks(problem, continuum, &stiffness, settings)))
            }
            _ => {
                totals.strategy = "condensed";
                Some(match linear {
                    true => Box::new(LinearEngine::condensed(problem, continuum, &stiffness)),
                    false => {
                        Box::new(NewtonEngine::condensed(problem, continuum, &asked, &stiffness, settings))
                    }
                })
            }
        };
        if let Some(mut engine) = engine {
            let mut totals = Course::new(problem, &mut *engine, totals, clock, &mut begin, visit).march()?;
            let found = continuum.found();
            let named = |what: &'static str, bodies: &[usize]| -> Vec<String> {
                bodies.iter().map(|&b| format!("{what} of {}", model.bodies[b].name)).collect()
            };
            totals.reused = [named("stiffness", &found.bodies), named("factor", &found.factors)].concat();
            return Ok(totals);
        }
    }
    let pattern = &model.continuum_pattern();
    let k = &model.continuum(pattern);
    begin(clock, "order");
    let plan = Plan::analyse(pattern, &model.coordinates()).map_err(too_large)?;
    let needed = memory::needed(plan.bytes(), pattern.rows.len(), dofs);
    memory::refuse(dofs, plan.entries(), needed, available)?;
    (totals.strategy, totals.factor_entries) = ("plain", plan.entries());
    let mut engine = NewtonEngine::plain(problem, pattern, k, &asked, &stiffness, settings);
    Course::new(problem, &mut engine, totals, clock, &mut begin, visit).march()
}

fn settings(solution: &Solution) -> Settings {
    let Solution { tolerance, iterations, tangent, .. } = *solution;
    let initial_tangent = tangent == Tangent::Initial;
    let patience = if initial_tangent { usize::MAX } else { PATIENCE };
    Settings { tolerance, iterations, patience, initial_tangent }
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
