//! What finds the equilibrium of one increment: a linear scene with one solve, any other with Newton's method.

use std::sync::Arc;

use nalgebra::Vector2;

use super::state::{Found, JointAnswer, State};
use crate::law::{self, Law};
use crate::problem::Problem;
use crate::solver::{
    Base, Condensation, Continuum, Dual, Form, Linear, Newton, NotPositiveDefinite, Plain, Plan, Respond,
    Settings, System, Unconverged,
};

/// Why an increment has no equilibrium.
#[derive(Debug)]
pub(super) enum Failure {
    /// A smaller increment may have one.
    Unconverged(Unconverged),
    /// Nothing will help: rounding or overflow leaves this backward error.
    Unusable(f64),
}

/// Finds equilibria under one set of supports after the other.
pub(super) trait Engine {
    /// Makes ready for a set of supports. True if something was factored.
    fn support(&mut self, held: &[bool]) -> Result<bool, NotPositiveDefinite>;

    /// Equilibrium under external forces and prescribed displacements, sought from the last accepted one and from `ahead`
    /// times the last change beyond it.
    fn solve(
        &mut self,
        state: &State,
        force: &[f64],
        prescribed: &[f64],
        ahead: f64,
    ) -> Result<Found, Failure>;

    /// What was found last is accepted: the next search starts from it.
    fn accept(&mut self);
}

/// One factorisation per set of supports, one solve per increment, no iteration.
pub(super) struct LinearEngine<'a> {
    system: &'a System<'a>,
    plan: &'a Plan,
    factored: Option<(Vec<bool>, Linear<'a>)>,
}

/// A solution with a larger backward error is not kept.
const UNUSABLE: f64 = 1e-6;

/// Most corrections of what the displacements say against the condensed form.
const DEFECTS: usize = 3;

impl<'a> LinearEngine<'a> {
    pub(super) fn new(system: &'a System<'a>, plan: &'a Plan) -> LinearEngine<'a> {
        LinearEngine { system, plan, factored: None }
    }
}

impl Engine for LinearEngine<'_> {
    fn support(&mut self, held: &[bool]) -> Result<bool, NotPositiveDefinite> {
        if self.factored.as_ref().is_some_and(|(of, _)| of == held) {
            return Ok(false);
        }
        self.factored = None; // two factors at a time would not fit
        self.factored = Some((held.to_vec(), Linear::new(self.system, self.plan, held)?));
        Ok(true)
    }

    fn solve(&mut self, _: &State, force: &[f64], prescribed: &[f64], _: f64) -> Result<Found, Failure> {
        let Some((_, linear)) = &self.factored else { return Err(Failure::Unusable(f64::INFINITY)) };
        let solution = linear.solve(force, prescribed);
        if solution.backward_error > UNUSABLE {
            return Err(Failure::Unusable(solution.backward_error));
        }
        let residuals = vec![solution.backward_error];
        Ok(Found { solution, joints: Vec::new(), iterations: 0, residuals })
    }

    fn accept(&mut self) {}
}

/// Makes the form for a set of supports; true if something was factored for it.
type Make<'a, F> = Box<dyn FnMut(&[bool]) -> Result<(F, bool), NotPositiveDefinite> + 'a>;

/// Newton's method on a form of the equilibrium that is made anew for every set of supports.
pub(super) struct NewtonEngine<'a, F> {
    problem: &'a Problem,
    settings: Settings,
    make: Make<'a, F>,
    form: Option<(Vec<bool>, F, Newton)>,
    /// Unknowns of the form at the accepted increment before the last, at the last, and at what was found last.
    before: Vec<f64>,
    unknowns: Vec<f64>,
    found: Vec<f64>,
}

impl<'a, F> NewtonEngine<'a, F> {
    fn new(problem: &'a Problem, settings: Settings, make: Make<'a, F>, size: usize) -> Self {
        let (before, unknowns, found) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
        NewtonEngine { problem, settings, make, form: None, before, unknowns, found }
    }
}

impl<'a> NewtonEngine<'a, Dual<'a>> {
    /// On the jump coefficients of the joints that are not elastic.
    pub(super) fn condensed(
        problem: &'a Problem,
        continuum: &'a Continuum,
        stiffness: &'a [Vec<f64>],
        settings: Settings,
    ) -> Self {
        let active = active(problem);
        let size: usize = active.iter().map(|&k| problem.model.joints[k].size()).sum();
        let mut condensed: Option<Arc<Condensation>> = None;
        let make = move |held: &[bool]| {
            let reused = condensed.take().filter(|condensation| continuum.serves(condensation, held));
            let anew = reused.is_none();
            let condensation = match reused {
                Some(condensation) => condensation,
                None => Arc::new(continuum.condense(held)?),
            };
            condensed = Some(condensation.clone());
            let base = Base::new(continuum, condensation, &problem.model.joints, stiffness, held)?;
            Ok((Dual::new(base, &active, stiffness), anew))
        };
        NewtonEngine::new(problem, settings, Box::new(make), size)
    }
}

impl<'a> NewtonEngine<'a, Plain<'a>> {
    /// On all displacements.
    pub(super) fn plain(
        problem: &'a Problem,
        continuum: &'a Continuum,
        stiffness: &'a [Vec<f64>],
        settings: Settings,
    ) -> Self {
        let active = active(problem);
        let make = move |held: &[bool]| {
            let Continuum { pattern, stiffness: k, .. } = continuum;
            Ok((Plain::new(&problem.model.joints, &active, stiffness, pattern, k, held), true))
        };
        NewtonEngine::new(problem, settings, Box::new(make), problem.model.dofs())
    }
}

impl<F: Form> Engine for NewtonEngine<'_, F> {
    fn support(&mut self, held: &[bool]) -> Result<bool, NotPositiveDefinite> {
        if self.form.as_ref().is_some_and(|(of, ..)| of == held) {
            return Ok(false);
        }
        self.form = None;
        let (form, anew) = (self.make)(held)?;
        let newton = Newton::new(&form);
        self.form = Some((held.to_vec(), form, newton));
        Ok(anew)
    }

    fn solve(
        &mut self,
        state: &State,
        force: &[f64],
        prescribed: &[f64],
        ahead: f64,
    ) -> Result<Found, Failure> {
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        let laws = Laws { problem: self.problem, old: &state.snapshot.states };
        let mut target = form.target(force, prescribed);
        if !target.iter().all(|value| value.is_finite()) {
            return Err(Failure::Unusable(f64::INFINITY));
        }
        let extrapolate = |(now, before): (&f64, &f64)| now + ahead * (now - before);
        let mut start: Vec<f64> = self.unknowns.iter().zip(&self.before).map(extrapolate).collect();
        let (mut residuals, mut passes) = (Vec::new(), 0);
        let (iterate, solution) = loop {
            let starts = [&self.unknowns, &start];
            let iterate = newton.solve(form, &laws, &starts, &target, self.settings);
            let iterate = iterate.map_err(Failure::Unconverged)?;
            let solution = form.recover(&iterate.x, &iterate.forces, force, prescribed);
            residuals.extend_from_slice(&iterate.residuals[usize::from(passes > 0)..]);
            let defect = form.defect(&iterate.x, &solution.u);
            let left = form.error(&defect, &iterate.x, &iterate.forces, &target);
            passes += 1;
            if defect.is_empty() || left <= self.settings.tolerance || passes > DEFECTS {
                break (iterate, solution);
            }
            target.iter_mut().zip(&defect).for_each(|(b, defect)| *b -= defect);
            start = iterate.x;
        };
        let joints = form.active().iter().zip(iterate.jumps).zip(iterate.memory);
        let joints = joints.map(|((&joint, jumps), memory)| {
            let jumps = jumps.chunks_exact(2).map(|r| [r[0], r[1]]).collect();
            JointAnswer { joint, jumps, memory }
        });
        let (joints, iterations) = (joints.collect(), residuals.len() - 1);
        self.found = iterate.x;
        Ok(Found { solution, joints, iterations, residuals })
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.before, &mut self.unknowns);
        std::mem::swap(&mut self.unknowns, &mut self.found);
    }
}

/// Joints that are not elastic.
pub(super) fn active(problem: &Problem) -> Vec<usize> {
    let laws = problem.laws.iter().enumerate();
    laws.filter(|(_, (law, _))| !matches!(law, Law::Elastic(_))).map(|(k, _)| k).collect()
}

/// The laws with the states at the last accepted increment.
struct Laws<'a> {
    problem: &'a Problem,
    old: &'a [Vec<law::State>],
}

impl Respond for Laws<'_> {
    type Memory = (law::State, f64);

    fn respond(
        &self,
        joint: usize,
        point: usize,
        jump: &[f64],
        traction: &mut [f64],
        stiffness: &mut [f64],
    ) -> Result<(law::State, f64), String> {
        let (law, _) = &self.problem.laws[joint];
        let stepping = self.problem.stepping[joint];
        let answer = law
            .respond(Vector2::new(jump[0], jump[1]), &self.old[joint][point], stepping)
            .map_err(|why| why.to_string())?;
        traction.copy_from_slice(answer.traction.as_slice());
        stiffness.copy_from_slice(answer.stiffness.transpose().as_slice()); // by rows
        Ok((answer.state, answer.dissipation))
    }

    fn initial_stiffness(&self, joint: usize, stiffness: &mut [f64]) {
        let [kn, kt] = self.problem.laws[joint].0.elastic_stiffness();
        stiffness.copy_from_slice(&[kn, 0.0, 0.0, kt]);
    }
}
