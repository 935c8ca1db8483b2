//! The march through the load history. A linear scene takes one factorisation per set of supports and one solve per
//! increment; any other iterates, and divides an increment that finds no equilibrium.

use super::engine::{Engine, Failure, LinearEngine};
use super::loading::Start;
use super::newton::{NewtonEngine, active};
use super::state::State;
use super::{Clock, memory};
use crate::error::{Error, Result};
use crate::law::Law;
use crate::problem::{Problem, Stage};
use crate::scene::{Fields, Solution, Strategy, Tangent};
use crate::solver::{Continuum, Plan, Settings, System, TooLarge, Unconverged};

/// An increment is halved at most this many times.
const HALVINGS: i32 = 10;
/// An increment found in at most this many iterations is followed by one of twice the size.
const EASY: usize = 8;
/// Condensation is for joints of at most this many dofs: its dense matrices have their square.
const DENSE: usize = 12_000;

/// Counts over a whole march.
#[derive(Debug, Clone, Default)]
pub struct Totals {
    /// Increments done.
    pub increments: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Newton iterations, those of failed increments included.
    pub iterations: usize,
    /// Increments that had to be halved.
    pub halved: usize,
    /// How the equations are solved.
    pub strategy: &'static str,
    /// Entries of one factor.
    pub factor_entries: usize,
    /// Largest residual of all increments.
    pub residual: f64,
    /// Largest |work − stored − dissipated|, relative.
    pub energy_balance: f64,
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
    /// The state of the last increment again, complete: no equilibrium was found beyond.
    pub ended: bool,
}

/// Called after the unloaded state (`number` 0) and after every increment, with the running counts.
pub type Visit<'a> = &'a mut dyn FnMut(Place, &State, &Totals, &mut Clock) -> Result<()>;

/// Marches through all steps. `stage` hears of every stage of work.
pub fn march(
    problem: &Problem,
    clock: &mut Clock,
    stage: &mut dyn FnMut(&'static str),
    visit: Visit,
) -> Result<Totals> {
    march_within(memory::available(), problem, clock, stage, visit)
}

/// `march` if it can do with the memory that is available [bytes]; else it is refused before the first factor.
pub fn march_within(
    available: Option<u64>,
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
    let model = &problem.model;
    let dofs = model.dofs();
    let stiffness: Vec<Vec<f64>> = (0..model.joints.len()).map(|k| springs(problem, k)).collect();
    let mut totals = Totals::default();
    if active(problem).is_empty() {
        let (pattern, joints) = (&model.pattern(), &model.joints);
        let continuum = &model.continuum(pattern);
        let system = System { joints, stiffness: &stiffness, pattern, continuum };
        begin(clock, "order");
        let plan =
            Plan::analyse(pattern, &model.coordinates()).map_err(|TooLarge| memory::too_large(dofs))?;
        memory::refuse(dofs, plan.entries(), memory::needed(plan.bytes(), pattern), available)?;
        (totals.strategy, totals.factor_entries) = (plan.strategy(), plan.entries());
        steps(problem, &mut LinearEngine::new(&system, &plan), totals, clock, &mut begin, visit)
    } else {
        let continuum = &Continuum::new(model).map_err(|TooLarge| memory::too_large(dofs))?;
        let (parts, settings) = (&continuum.parts, settings(&problem.solution));
        let condensed = match problem.solution.strategy {
            Strategy::Auto => parts.border() <= DENSE,
            strategy => strategy == Strategy::Condensed,
        };
        let coefficients: usize = active(problem).iter().map(|&k| model.joints[k].size()).sum();
        let dense = if condensed { parts.border().pow(2) + 4 * coefficients.pow(2) } else { 0 };
        let bytes = parts.bytes() + size_of::<f64>() * dense;
        memory::refuse(dofs, parts.entries(), memory::needed(bytes, &continuum.pattern), available)?;
        totals.factor_entries = parts.entries();
        if condensed {
            totals.strategy = "condensed";
            let mut engine = NewtonEngine::condensed(problem, continuum, &stiffness, settings);
            steps(problem, &mut engine, totals, clock, &mut begin, visit)
        } else {
            totals.strategy = "plain";
            let mut engine = NewtonEngine::plain(problem, continuum, &stiffness, settings);
            steps(problem, &mut engine, totals, clock, &mut begin, visit)
        }
    }
}

fn settings(solution: &Solution) -> Settings {
    let Solution { tolerance, iterations, tangent, .. } = *solution;
    Settings { tolerance, iterations, initial_tangent: tangent == Tangent::Initial }
}

/// Law stiffness of a joint's springs: its own if it is elastic. Else at most E/h, which keeps floating bodies in place:
/// E of the softer body, h the mean length of the coarser side's edges. More than the law's own would only cancel.
fn springs(problem: &Problem, k: usize) -> Vec<f64> {
    let (joint, (law, _)) = (&problem.model.joints[k], &problem.laws[k]);
    let midplane = &joint.coupling.midplane;
    let edges = midplane.a.edges().min(midplane.b.edges());
    let young = joint.bodies.map(|body| problem.model.bodies[body].elasticity.young);
    let soft = young[0].min(young[1]) * edges as f64 / midplane.length;
    let [kn, kt] = match law {
        Law::Elastic(_) => law.elastic_stiffness(),
        _ => law.elastic_stiffness().map(|stiffness| stiffness.min(soft)),
    };
    [kn, 0.0, 0.0, kt].repeat(joint.coupling.points.len())
}

/// All steps with one engine.
fn steps(
    problem: &Problem,
    engine: &mut dyn Engine,
    mut totals: Totals,
    clock: &mut Clock,
    begin: &mut dyn FnMut(&mut Clock, &'static str),
    visit: Visit,
) -> Result<Totals> {
    let (model, initial) = (&problem.model, initial_force(problem));
    let mut state = State::unloaded(problem);
    for (step, stage) in problem.stages.iter().enumerate() {
        begin(clock, "factor");
        totals.factorisations +=
            usize::from(engine.support(&stage.held).map_err(|_| singular(stage, totals.increments))?);
        if step == 0 {
            let place =
                Place { step, stage, number: 0, increment: 0, load_factor: 0.0, iterations: 0, ended: false };
            visit(place, &state, &totals, clock)?;
        }
        let start = Start::new(problem, stage, &initial, &state.snapshot.u, &state.reactions);
        let ramp = start.ramp()?;
        // increments whose fields are not stored do without displacements where no joint needs them and it pays: a
        // measure costs about as much as recovering one increment
        let unstored = problem.fields != Fields::Every && active(problem).len() == model.joints.len();
        let measures =
            ramp.as_ref().filter(|_| unstored).map(|ramp| start.measures(ramp)).unwrap_or_default();
        let thrifty = !measures.is_empty() && measures.len() < stage.increments;
        let measures = if thrifty { measures } else { Vec::new() };
        begin(clock, "prepare");
        engine.prepare(ramp.as_ref(), &measures);
        state.open(ramp.filter(|_| thrifty).map(|ramp| start.ledger(&ramp)));
        let (mut level, mut width, mut last) = (0.0, 1.0 / stage.increments as f64, f64::INFINITY);
        for number in 1..=stage.increments {
            let goal = number as f64 / stage.increments as f64;
            let mut iterations = 0;
            let mut lost = None;
            while level < goal {
                begin(clock, "solve");
                let reached = if level + 1.001 * width >= goal { goal } else { level + width };
                let load = start.at(reached)?;
                let complete = !thrifty || number == stage.increments;
                match engine.solve(&state, &load, (reached - level) / last, complete) {
                    Ok(found) => {
                        engine.accept();
                        iterations += found.iterations;
                        if found.iterations <= EASY {
                            width = (2.0 * width).min(1.0 / stage.increments as f64);
                        }
                        state.accept(problem, found, load);
                        (last, level) = (reached - level, reached);
                    }
                    Err(Failure::Unusable(error)) => {
                        return Err(unusable(stage, number, totals.increments, error));
                    }
                    Err(Failure::Unconverged(why)) => {
                        iterations += why.iterations;
                        totals.halved += 1;
                        width = 0.5 * (reached - level);
                        if width * (stage.increments as f64) < 0.5_f64.powi(HALVINGS) {
                            lost = Some(why);
                            break;
                        }
                    }
                }
            }
            totals.iterations += iterations;
            let between = level > (number - 1) as f64 / stage.increments as f64;
            if lost.is_none() || between {
                begin(clock, "recover");
                state.recover(problem);
                if !(state.stored.is_finite() && state.work.is_finite()) {
                    return Err(unusable(stage, number, totals.increments, f64::INFINITY)); // every stress counts in these
                }
                totals.increments += 1;
                totals.residual = totals.residual.max(state.residual);
                totals.energy_balance = totals.energy_balance.max(state.energy_balance().abs());
                let increment = totals.increments;
                let place =
                    Place { step, stage, number, increment, load_factor: level, iterations, ended: false };
                visit(place, &state, &totals, clock)?;
            }
            if let Some(why) = lost {
                if totals.increments > 0 {
                    state.complete(problem, engine, start.at(level)?);
                    let increment = totals.increments;
                    let place = Place {
                        step,
                        stage,
                        number,
                        increment,
                        load_factor: level,
                        iterations: 0,
                        ended: true,
                    };
                    visit(place, &state, &totals, clock)?;
                }
                return Err(no_equilibrium(problem, stage, number, totals.increments, level, &why));
            }
        }
    }
    clock.begin("end");
    Ok(totals)
}

/// Gᵀ Σ w Nᵀ Rᵀ t₀ of the initial tractions of elastic joints (paper eq. 12); other laws know theirs.
fn initial_force(problem: &Problem) -> Vec<f64> {
    let mut force = vec![0.0; problem.model.dofs()];
    for ((joint, (_, initial)), states) in problem.model.joints.iter().zip(&problem.laws).zip(&problem.states)
    {
        if states.is_empty() {
            let tractions: Vec<f64> = (0..joint.coupling.points.len()).flat_map(|p| initial.at(p)).collect();
            joint.add_force(&tractions, &mut force);
        }
    }
    force
}

/// A solution that is none: rounding or overflow has eaten it.
fn unusable(stage: &Stage, increment: usize, kept: usize, error: f64) -> Error {
    let reason = if error.is_finite() {
        format!("rounding leaves a backward error of {error:.1e}")
    } else {
        "numbers overflowed: loads or stiffnesses are out of range".into()
    };
    Error::NoEquilibrium { step: stage.name.clone(), increment, reason, kept }
}

fn singular(stage: &Stage, kept: usize) -> Error {
    let reason = "the stiffness is not positive definite in floating point".into();
    Error::NoEquilibrium { step: stage.name.clone(), increment: 1, reason, kept }
}

/// The smallest increment has none: where it was lost, and the law points that are farthest from it.
fn no_equilibrium(
    problem: &Problem,
    stage: &Stage,
    increment: usize,
    kept: usize,
    level: f64,
    why: &Unconverged,
) -> Error {
    let worst: Vec<String> = why
        .worst
        .iter()
        .map(|&(joint, point)| {
            let joint = &problem.model.joints[joint];
            let point = &joint.coupling.points[point];
            format!("{} at ({:.6}, {:.6})", joint.name, point.position[0], point.position[1])
        })
        .collect();
    let reason =
        format!("{} beyond load factor {level:.6}; worst law points: {}", why.reason, worst.join(", "));
    Error::NoEquilibrium { step: stage.name.clone(), increment, reason, kept }
}
