//! Newton's method as the engine of a history: forms made for each set of supports, laws asked with the committed states.

use super::laws::{Laws, OldStates, may_lag};
use super::strategy::active;
use super::view::{View, ViewMut, target};
use super::{
    Ahead, Engine, Estimate, Failure, Make, PathSearch, Search, Viscous, Way, estimate, late, viscosity,
};
use crate::history::converged::{Converged, InterfaceResponse, PointResponse};
use crate::history::loading::{Ledger, LoadForces, StepLoad};
use crate::history::state::ModelState;
use crate::problem::Problem;
use crate::solver::{
    Affine, Constraint, Form, Iterate, LinearMeasure, Newton, NewtonSettings, NodalSolution,
    NotPositiveDefinite, PathPoint, Ramp, Respond, ahead, leave,
};

/// Part of the extrapolation that shows which points go on cracking or sliding, and hardly moves them.
const NEAR: f64 = 1e-3;
/// Largest relative residual of a viscous step: what is stored is found without viscosity.
const CREEP: f64 = 1e-7;
/// Largest error of displacements against the condensed form that counts as their rounding.
const ROUNDED: f64 = 1e-6;
/// Most corrections of what the displacements say against the condensed form.
const DEFECTS: usize = 3;

/// Newton's method on a form of the equilibrium that is made anew for every set of supports.
pub(super) struct NewtonEngine<'a, F> {
    problem: &'a Problem,
    /// All interfaces are elastic.
    linear: bool,
    settings: NewtonSettings,
    make: Make<'a, F>,
    form: Option<(Vec<bool>, F, Newton)>,
    search: Search,
    /// Unknowns, forces of the interfaces and viscous tractions of what was found last.
    found: (Vec<f64>, Vec<Vec<f64>>, Vec<Vec<f64>>),
    /// Growth of the load factor to what was sought last.
    sought: f64,
    /// The step's loads are prepared; so are its measures.
    prepared: bool,
    measured: bool,
}

impl<'a, F> NewtonEngine<'a, F> {
    /// With a form of so many unknowns.
    pub(super) fn new(
        problem: &'a Problem,
        settings: NewtonSettings,
        make: Make<'a, F>,
        size: usize,
    ) -> Self {
        let zero = || vec![0.0; size];
        let search = Search { before: zero(), unknowns: zero(), first: true, ..Search::default() };
        let (linear, found) = (active(problem).is_empty(), (zero(), Vec::new(), Vec::new()));
        let (prepared, measured) = (false, false);
        NewtonEngine {
            problem,
            linear,
            settings,
            make,
            form: None,
            search,
            found,
            sought: 0.0,
            prepared,
            measured,
        }
    }
}

impl<F: Form> NewtonEngine<'_, F> {
    /// Growth of the load factor since the last accepted state, kept for what is found.
    fn advance(&mut self, load: &StepLoad) -> f64 {
        self.sought = (load.load_factor - self.search.load_factor).max(0.0);
        self.sought
    }

    fn view(&self) -> Option<View<'_, F>> {
        let (problem, prepared) = (self.problem, self.prepared);
        let (_, form, _) = self.form.as_ref()?;
        Some(View { problem, prepared, form, unknowns: &self.search.unknowns, found: &self.found.0 })
    }

    fn view_mut(&mut self) -> Option<ViewMut<'_, F>> {
        let (problem, prepared) = (self.problem, self.prepared);
        let (_, form, newton) = self.form.as_mut()?;
        Some(ViewMut {
            problem,
            prepared,
            form,
            newton,
            unknowns: &self.search.unknowns,
            found: &self.found.0,
        })
    }

    /// Equilibrium under a load, sought from the better of two starts.
    fn solve_from(
        &mut self,
        [near, mut start]: [Vec<f64>; 2],
        laws: &Laws,
        load: &StepLoad,
        complete: bool,
    ) -> Result<Converged, Failure> {
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        form.compare_with(self.search.force_scale());
        let mut target = target(form, self.prepared, load)?;
        let (mut residuals, mut passes) = (Vec::new(), 0);
        // the first increment of a step shows whether displacements are needed against the rounding of the others
        let complete = complete || self.search.first || !self.search.trusted;
        let mut kept: Option<(Iterate<PointResponse>, NodalSolution, f64)> = None;
        let (iterate, solution) = loop {
            let starts = [&near, &start];
            let iterate = match (newton.solve(form, laws, &starts, &target, self.settings), kept.take()) {
                (Ok(iterate), _) => iterate,
                // what displacements say is corrected as far as rounding lets it
                (Err(_), Some((iterate, solution, left))) if left <= ROUNDED => {
                    residuals.push(left);
                    break (iterate, Some(solution));
                }
                (Err(why), _) => return Err(Failure::Unconverged(why)),
            };
            residuals.extend_from_slice(&iterate.residuals[usize::from(passes > 0)..]);
            if !complete {
                break (iterate, None);
            }
            let LoadForces { loaded, prescribed, .. } = load.forces();
            let solution = form.recover(&iterate.x, &iterate.forces, loaded, prescribed);
            let defect = form.defect(&iterate.x, &solution.u);
            let left = form.error(&defect, &iterate.x, &iterate.forces, &target);
            passes += 1;
            if defect.is_empty() || left <= self.settings.tolerance || passes > DEFECTS {
                break (iterate, Some(solution));
            }
            target.iter_mut().zip(&defect).for_each(|(b, defect)| *b -= defect);
            start.clone_from(&iterate.x);
            kept = Some((iterate, solution, left));
        };
        self.search.trusted &= passes <= 1;
        self.search.first = false;
        let ledger = match self.measured {
            true => {
                Ledger::new(load.load_factor, &form.measured(load.load_factor, &iterate.x, &iterate.forces))
            }
            false => None,
        };
        Ok(self.found(solution, ledger, residuals, laws, iterate))
    }

    /// Keeps a solution for its acceptance.
    fn found(
        &mut self,
        solution: Option<NodalSolution>,
        ledger: Option<Ledger>,
        residuals: Vec<f64>,
        laws: &Laws,
        iterate: Iterate<PointResponse>,
    ) -> Converged {
        let active = self.form.as_ref().map_or(&[][..], |(_, form, _)| form.active());
        let (viscous, [released, bend]) = viscosity::account(laws, active, &self.search.viscous, &iterate);
        self.found = (iterate.x, iterate.forces, viscous);
        let components = self.problem.model.components;
        let answers = active.iter().zip(iterate.jumps).zip(iterate.memory);
        let interfaces = answers.map(|((&interface, jumps), memory)| {
            InterfaceResponse::new(interface, components, &jumps, memory)
        });
        // one solve is all that a linear scene takes
        let solves = residuals.len() - 1;
        let iterations = if self.linear { solves - 1 } else { solves };
        Converged {
            solution,
            ledger,
            interfaces: interfaces.collect(),
            released,
            bend,
            iterations,
            wasted: 0,
            residuals,
        }
    }
}

impl<F: Form> Engine for NewtonEngine<'_, F> {
    fn support(&mut self, constrained: &[bool]) -> Result<bool, NotPositiveDefinite> {
        if self.form.as_ref().is_some_and(|(of, ..)| of == constrained) {
            return Ok(false);
        }
        self.form = None;
        let (form, anew) = (self.make)(constrained)?;
        let newton = Newton::new(&form);
        self.form = Some((constrained.to_vec(), form, newton));
        Ok(anew)
    }

    fn prepare(&mut self, ramp: Option<&Ramp>, measures: &[LinearMeasure]) {
        if let Some((_, form, _)) = &mut self.form {
            self.prepared = form.prepare(ramp, measures);
            self.measured = self.prepared && !measures.is_empty();
            self.search.trusted = self.measured;
            self.search.first = true;
        }
        self.search.load_factor = 0.0;
    }

    fn solve(
        &mut self,
        state: &ModelState,
        load: &StepLoad,
        ahead: Ahead,
        complete: bool,
    ) -> Result<Converged, Failure> {
        let Ahead { changes, near } = ahead;
        let starts = [
            self.search.onwards(NEAR * changes),
            self.search.onwards(if near { NEAR * changes } else { changes }),
        ];
        let laws = Laws::alone(self.problem, OldStates::of(&state.snapshot), self.advance(load), load.at());
        self.solve_from(starts, &laws, load, complete)
    }

    fn creep(
        &mut self,
        state: &ModelState,
        load: &StepLoad,
        Viscous { viscosity, ahead, strict }: Viscous,
        complete: bool,
    ) -> Result<Converged, Failure> {
        let starts = [self.search.unknowns.clone(), self.search.onwards(ahead)];
        let lags = self.search.lags && may_lag(self.problem, viscosity);
        let alone = Laws::alone(self.problem, OldStates::of(&state.snapshot), self.advance(load), load.at());
        let laws = Laws { viscosity: Some(viscosity), lags, ..alone };
        let settings = self.settings;
        let tolerance = if strict { settings.tolerance } else { settings.tolerance.max(CREEP) };
        self.settings = NewtonSettings { tolerance, initial_tangent: false, ..settings };
        let mut found = self.solve_from(starts.clone(), &laws, load, complete);
        if let Err(Failure::Unconverged(first)) = &mut found
            && may_lag(self.problem, viscosity)
        {
            let tried = std::mem::take(&mut first.iterations);
            self.search.lags = !self.search.lags;
            found = self.solve_from(starts, &Laws { lags: self.search.lags, ..laws }, load, complete);
            match &mut found {
                Ok(found) => found.wasted = tried,
                Err(Failure::Unconverged(why)) => why.iterations += tried,
                Err(Failure::Unusable(_)) => {}
            }
        }
        self.settings = settings;
        found
    }

    fn estimate(&mut self, state: &ModelState, found: &Converged, way: Way) -> Option<Estimate> {
        estimate::error_of(&self.view()?, OldStates::of(&state.snapshot), found, way, self.sought)
    }

    fn is_reached(&mut self, state: &ModelState, found: &Converged, end: &StepLoad) -> bool {
        let settings = self.settings;
        let reached = self.view_mut().and_then(|mut view| {
            late::crack(&mut view, OldStates::of(&state.snapshot), found, end, settings)
        });
        reached.unwrap_or(false)
    }

    fn onset(&mut self, state: &ModelState, load: &StepLoad, now: &StepLoad, ahead: f64) -> Option<f64> {
        let end = if ahead > 0.0 { Some(self.search.onwards(ahead)) } else { None };
        let settings = self.settings;
        late::first_onset(&mut self.view_mut()?, OldStates::of(&state.snapshot), [load, now], end, settings)
    }

    fn imbalance(&self, state: &ModelState, load: &StepLoad) -> f64 {
        self.view()
            .and_then(|view| estimate::imbalance(&view, &state.snapshot, load))
            .unwrap_or(f64::INFINITY)
    }

    fn follow(
        &mut self,
        state: &ModelState,
        load_factor: f64,
        path: &PathSearch,
    ) -> Result<(Converged, f64), Failure> {
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        form.compare_with(self.search.force_scale());
        let at = (path.step, load_factor);
        let laws = Laws::alone(self.problem, OldStates::of(&state.snapshot), f64::INFINITY, at);
        let ends = [0, 1].map(|end| form.target(&path.ramp.force[end], &path.ramp.prescribed[end]));
        let load = Affine::new(ends[0].clone(), &ends[1]);
        let from = PathPoint { x: self.search.unknowns.clone(), load_factor };
        let start = if path.ahead > 0.0 {
            let x = self.search.onwards(path.ahead);
            Ok(PathPoint { x, load_factor: load_factor + path.ahead * path.last })
        } else {
            match path.amount {
                Some(amount) => leave(newton, form, &laws, &from, &load, amount, self.settings),
                None => ahead(newton, form, &laws, &from, &load, path.last, self.settings),
            }
        };
        let start = start.map_err(Failure::Unconverged)?;
        let constraint = match path.amount {
            Some(amount) => Constraint::Dissipate(amount),
            None => Constraint::between(form, &from.x, &start.x),
        };
        let followed = newton.follow(form, &laws, start, &load, &constraint, self.settings);
        let (iterate, load_factor) = followed.map_err(Failure::Unconverged)?;
        let [loaded, prescribed] = path.ramp.at(load_factor);
        let solution = form.recover(&iterate.x, &iterate.forces, &loaded, &prescribed);
        let laws = laws.at(load_factor);
        let found = self.found(Some(solution), None, iterate.residuals.clone(), &laws, iterate);
        Ok((found, load_factor))
    }

    fn recover(&self, load: &StepLoad) -> Option<NodalSolution> {
        let (_, form, _) = self.form.as_ref()?;
        let LoadForces { loaded, prescribed, .. } = load.forces();
        Some(form.recover(&self.search.unknowns, &self.search.forces, loaded, prescribed))
    }

    fn search(&self) -> Search {
        self.search.clone()
    }

    fn restore(&mut self, search: Search) {
        self.search = search;
    }

    fn begin_viscous(&mut self) -> Search {
        self.search.lags = false;
        let mut search = self.search.clone();
        search.viscous.clear();
        search
    }

    fn accept(&mut self) {
        self.search.accept(&mut self.found);
        self.search.load_factor += self.sought;
    }
}
