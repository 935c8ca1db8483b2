//! Newton's method as the engine of a march: forms made for each set of supports, laws asked with the committed states.

use super::estimate::{Estimate, Way};
use super::laws::Laws;
use super::strategy::active;
use super::{Ahead, Engine, Failure, Make, Path, Viscous, bases, condensations};
use crate::assembly::{Pattern, Symmetric};
use crate::history::loading::{Forces, Ledger, Load};
use crate::history::state::{Answer, Found, JointAnswer, State};
use crate::problem::Problem;
use crate::solver::{
    Affine, Blocks, Constraint, Continuum, Dual, Form, Iterate, Measure, Newton, NotPositiveDefinite, Plain,
    Point, Ramp, Settings, Solution,
};

/// Part of the extrapolation that shows which points go on cracking or sliding, and hardly moves them.
const NEAR: f64 = 1e-3;
/// Largest relative residual of a viscous step: what is stored is found without viscosity.
const CREEP: f64 = 1e-7;
/// A viscosity above this part of the stiffness makes tiny steps.
const STIFF: f64 = 0.1;
/// Most corrections of what the displacements say against the condensed form.
const DEFECTS: usize = 3;

/// Newton's method on a form of the equilibrium that is made anew for every set of supports.
pub(in crate::history) struct NewtonEngine<'a, F> {
    pub(in crate::history) problem: &'a Problem,
    /// All joints are elastic.
    linear: bool,
    pub(in crate::history) settings: Settings,
    make: Make<'a, F>,
    pub(in crate::history) form: Option<(Vec<bool>, F, Newton)>,
    /// Unknowns of the form at the accepted increment before the last, at the last, and at what was found last.
    before: Vec<f64>,
    pub(in crate::history) unknowns: Vec<f64>,
    pub(in crate::history) found: Vec<f64>,
    /// Forces of the joints at the last accepted increment, and at what was found last.
    forces: [Vec<Vec<f64>>; 2],
    /// Viscous tractions at the law points of every active joint, alike; none where nothing is viscous.
    pub(in crate::history) viscous: [Vec<Vec<f64>>; 2],
    /// Friction lags wherever it is steep in viscous steps, since steps without failed.
    lags: bool,
    /// Unknowns to which a search that failed returns.
    kept: [Vec<f64>; 2],
    /// The step's loads are prepared; so are its measures; these are good enough; no increment has been tried yet.
    prepared: bool,
    measured: bool,
    trusted: bool,
    first: bool,
}

impl<'a, F> NewtonEngine<'a, F> {
    fn new(problem: &'a Problem, settings: Settings, make: Make<'a, F>, size: usize) -> Self {
        let (before, unknowns, found) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
        let (prepared, measured, trusted, first) = (false, false, false, true);
        let linear = active(problem).is_empty();
        NewtonEngine {
            problem,
            linear,
            settings,
            make,
            form: None,
            before,
            unknowns,
            found,
            forces: [Vec::new(), Vec::new()],
            viscous: [Vec::new(), Vec::new()],
            lags: false,
            kept: [Vec::new(), Vec::new()],
            prepared,
            measured,
            trusted,
            first,
        }
    }
}

impl<'a> NewtonEngine<'a, Dual<'a>> {
    /// On the jump coefficients of the joints in `asked`.
    pub(in crate::history) fn condensed(
        problem: &'a Problem,
        continuum: &'a Continuum,
        asked: &'a [usize],
        stiffness: &'a [Vec<f64>],
        settings: Settings,
    ) -> Self {
        let size: usize = asked.iter().map(|&k| problem.model.joints[k].size()).sum();
        let sound: Vec<Vec<f64>> = (problem.laws.iter().zip(&problem.model.joints))
            .map(|((law, _), joint)| {
                let [kn, kt] = law.elastic_stiffness();
                [kn, 0.0, 0.0, kt].repeat(joint.coupling.points.len())
            })
            .collect();
        let mut base = bases(problem, continuum, stiffness);
        let make = move |held: &[bool]| {
            let (base, anew) = base(held)?;
            Ok((Dual::new(base, asked, stiffness, &sound), anew))
        };
        NewtonEngine::new(problem, settings, Box::new(make), size)
    }
}

impl<'a> NewtonEngine<'a, Blocks<'a>> {
    /// On the jump coefficients of all joints and the rigid motions of floating bodies.
    pub(in crate::history) fn blocks(
        problem: &'a Problem,
        continuum: &'a Continuum,
        stiffness: &'a [Vec<f64>],
        settings: Settings,
    ) -> Self {
        let joints = &problem.model.joints;
        let mut condense = condensations(continuum);
        let make = move |held: &[bool]| {
            let (condensation, anew) = condense(held)?;
            Ok((Blocks::new(continuum, condensation, joints, stiffness, held)?, anew))
        };
        NewtonEngine::new(problem, settings, Box::new(make), Blocks::unknowns(continuum, joints))
    }
}

impl<'a> NewtonEngine<'a, Plain<'a>> {
    /// On all displacements.
    pub(in crate::history) fn plain(
        problem: &'a Problem,
        pattern: &'a Pattern,
        k: &'a Symmetric,
        asked: &'a [usize],
        stiffness: &'a [Vec<f64>],
        settings: Settings,
    ) -> Self {
        let make = move |held: &[bool]| {
            Ok((Plain::new(&problem.model.joints, asked, stiffness, pattern, k, held), true))
        };
        NewtonEngine::new(problem, settings, Box::new(make), problem.model.dofs())
    }
}

impl<F: Form> NewtonEngine<'_, F> {
    /// The last accepted unknowns, and a multiple of their last change beyond.
    pub(in crate::history) fn onwards(&self, ahead: f64) -> Vec<f64> {
        if ahead == 0.0 {
            return self.unknowns.clone();
        }
        let along = |(now, before): (&f64, &f64)| now + ahead * (now - before);
        self.unknowns.iter().zip(&self.before).map(along).collect()
    }

    /// Friction may lag wherever it is steep: some law dilates and the viscosity is above the softening, or steps are so small
    /// that lagging costs nothing.
    fn may_lag(&self, viscosity: f64) -> bool {
        let laws =
            || self.problem.laws.iter().map(|(law, _)| law).filter(|law| law.steepest_softening() > 0.0);
        let stiffness = laws().flat_map(|law| law.elastic_stiffness()).fold(0.0, f64::max);
        let softening = laws().map(|law| law.steepest_softening()).fold(0.0, f64::max);
        let least = if laws().any(|law| law.dilates()) {
            softening.min(STIFF * stiffness)
        } else {
            STIFF * stiffness
        };
        softening > 0.0 && viscosity >= least
    }

    /// Equilibrium under a load, sought from the better of two starts.
    fn solve_from(
        &mut self,
        [near, mut start]: [Vec<f64>; 2],
        laws: &Laws,
        load: &Load,
        complete: bool,
    ) -> Result<Found, Failure> {
        let mut target = self.target(load)?;
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        let (mut residuals, mut passes) = (Vec::new(), 0);
        // the first increment of a step shows whether displacements are needed against the rounding of the others
        let complete = complete || self.first || !self.trusted;
        let (iterate, solution) = loop {
            let starts = [&near, &start];
            let iterate = newton.solve(form, laws, &starts, &target, self.settings);
            let iterate = iterate.map_err(Failure::Unconverged)?;
            residuals.extend_from_slice(&iterate.residuals[usize::from(passes > 0)..]);
            if !complete {
                break (iterate, None);
            }
            let Forces { loaded, prescribed, .. } = load.forces();
            let solution = form.recover(&iterate.x, &iterate.forces, loaded, prescribed);
            let defect = form.defect(&iterate.x, &solution.u);
            let left = form.error(&defect, &iterate.x, &iterate.forces, &target);
            passes += 1;
            if defect.is_empty() || left <= self.settings.tolerance || passes > DEFECTS {
                break (iterate, Some(solution));
            }
            target.iter_mut().zip(&defect).for_each(|(b, defect)| *b -= defect);
            start = iterate.x;
        };
        self.trusted &= passes <= 1;
        self.first = false;
        let ledger = match self.measured {
            true => Ledger::new(load.level, &form.measured(load.level, &iterate.x, &iterate.forces)),
            false => None,
        };
        Ok(self.found(solution, ledger, residuals, laws, iterate))
    }

    /// b of a load.
    pub(in crate::history) fn target(&self, load: &Load) -> Result<Vec<f64>, Failure> {
        let Some((_, form, _)) = &self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        let target = match self.prepared {
            true => form.prepared(load.level),
            false => {
                let Forces { loaded, prescribed, .. } = load.forces();
                form.target(loaded, prescribed)
            }
        };
        match target.iter().all(|value| value.is_finite()) {
            true => Ok(target),
            false => Err(Failure::Unusable(f64::INFINITY)),
        }
    }

    /// Keeps a solution for its acceptance, and tells the march of it.
    fn found(
        &mut self,
        solution: Option<Solution>,
        ledger: Option<Ledger>,
        residuals: Vec<f64>,
        laws: &Laws,
        iterate: Iterate<Answer>,
    ) -> Found {
        let [released, bend] = self.keep_viscous(laws, &iterate);
        (self.found, self.forces[1]) = (iterate.x, iterate.forces);
        let active = self.form.iter().flat_map(|(_, form, _)| form.active());
        let joints = active.zip(iterate.jumps).zip(iterate.memory).map(|((&joint, jumps), memory)| {
            let jumps = jumps.chunks_exact(2).map(|r| [r[0], r[1]]).collect();
            JointAnswer { joint, jumps, memory }
        });
        // one solve is all that a linear scene takes
        let solves = residuals.len() - 1;
        let iterations = if self.linear { solves - 1 } else { solves };
        Found { solution, ledger, joints: joints.collect(), released, bend, iterations, wasted: 0, residuals }
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

    fn prepare(&mut self, ramp: Option<&Ramp>, measures: &[Measure]) {
        if let Some((_, form, _)) = &mut self.form {
            self.prepared = form.prepare(ramp, measures);
            self.measured = self.prepared && !measures.is_empty();
            self.trusted = self.measured;
            self.first = true;
        }
    }

    fn solve(&mut self, state: &State, load: &Load, ahead: Ahead, complete: bool) -> Result<Found, Failure> {
        let Ahead { changes, near } = ahead;
        let starts =
            [self.onwards(NEAR * changes), self.onwards(if near { NEAR * changes } else { changes })];
        let laws = Laws::alone(self.problem, &state.snapshot.states);
        self.solve_from(starts, &laws, load, complete)
    }

    fn creep(
        &mut self,
        state: &State,
        load: &Load,
        Viscous { viscosity, ahead, strict }: Viscous,
        complete: bool,
    ) -> Result<Found, Failure> {
        let starts = [self.unknowns.clone(), self.onwards(ahead)];
        let (problem, old) = (self.problem, &state.snapshot.states);
        let laws = Laws {
            problem,
            old,
            viscosity: Some(viscosity),
            lags: self.lags && self.may_lag(viscosity),
            held: None,
        };
        let settings = self.settings;
        let tolerance = if strict { settings.tolerance } else { settings.tolerance.max(CREEP) };
        self.settings = Settings { tolerance, initial_tangent: false, ..settings };
        let mut found = self.solve_from(starts.clone(), &laws, load, complete);
        if let Err(Failure::Unconverged(first)) = &mut found
            && self.may_lag(viscosity)
        {
            let tried = std::mem::take(&mut first.iterations);
            self.lags = !self.lags;
            found = self.solve_from(starts, &Laws { lags: self.lags, ..laws }, load, complete);
            match &mut found {
                Ok(found) => found.wasted = tried,
                Err(Failure::Unconverged(why)) => why.iterations += tried,
                Err(Failure::Unusable(_)) => {}
            }
        }
        self.settings = settings;
        found
    }

    fn estimate(&mut self, state: &State, found: &Found, way: Way) -> Option<Estimate> {
        self.estimate_part(state, found, way)
    }

    fn is_reached(&mut self, state: &State, found: &Found, end: &Load) -> bool {
        self.late_points_crack(state, found, end).unwrap_or(false)
    }

    fn onset(&mut self, state: &State, load: &Load, now: &Load, ahead: f64) -> Option<f64> {
        self.first_onset(state, load, now, ahead)
    }

    fn imbalance(&self, state: &State, load: &Load) -> f64 {
        self.out_of_balance(state, load).unwrap_or(f64::INFINITY)
    }

    fn follow(&mut self, state: &State, level: f64, path: &Path) -> Result<(Found, f64), Failure> {
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        let laws = Laws::alone(self.problem, &state.snapshot.states);
        let ends = [0, 1].map(|end| form.target(&path.ramp.force[end], &path.ramp.prescribed[end]));
        let load = Affine::new(ends[0].clone(), &ends[1]);
        let from = Point { x: self.unknowns.clone(), level };
        let start = if path.ahead > 0.0 {
            let extrapolate = |(now, before): (&f64, &f64)| now + path.ahead * (now - before);
            let x = self.unknowns.iter().zip(&self.before).map(extrapolate).collect();
            Ok(Point { x, level: level + path.ahead * path.last })
        } else {
            match path.amount {
                Some(amount) => newton.leave(form, &laws, &from, &load, amount, self.settings),
                None => newton.ahead(form, &laws, &from, &load, path.last, self.settings),
            }
        };
        let start = start.map_err(Failure::Unconverged)?;
        let constraint = match path.amount {
            Some(amount) => Constraint::Dissipate(amount),
            None => Constraint::between(form, &from.x, &start.x),
        };
        let followed = newton.follow(form, &laws, start, &load, &constraint, self.settings);
        let (iterate, level) = followed.map_err(Failure::Unconverged)?;
        let at = |ends: &[Vec<f64>; 2]| -> Vec<f64> {
            ends[0].iter().zip(&ends[1]).map(|(start, end)| start + level * (end - start)).collect()
        };
        let (loaded, prescribed) = (at(&path.ramp.force), at(&path.ramp.prescribed));
        let solution = form.recover(&iterate.x, &iterate.forces, &loaded, &prescribed);
        let found = self.found(Some(solution), None, iterate.residuals.clone(), &laws, iterate);
        Ok((found, level))
    }

    fn recover(&self, load: &Load) -> Option<Solution> {
        let (_, form, _) = self.form.as_ref()?;
        let Forces { loaded, prescribed, .. } = load.forces();
        Some(form.recover(&self.unknowns, &self.forces[0], loaded, prescribed))
    }

    fn keep(&mut self) {
        self.kept = [self.before.clone(), self.unknowns.clone()];
        self.lags = false;
    }

    fn go_back(&mut self) {
        [self.before, self.unknowns] = std::mem::take(&mut self.kept);
        self.viscous[0].clear();
    }

    fn accept(&mut self) {
        self.forces.swap(0, 1);
        self.viscous.swap(0, 1);
        std::mem::swap(&mut self.before, &mut self.unknowns);
        std::mem::swap(&mut self.unknowns, &mut self.found);
    }
}
