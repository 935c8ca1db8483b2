//! The engine of a linear scene: a step whose loads are affine in the load factor takes two solves at most.

use super::{Ahead, Engine, Estimate, Failure, Make, PathSearch, Search, Viscous, Way};
use crate::assembly::InterfaceOperator;
use crate::history::converged::{Converged, InterfaceResponse};
use crate::history::loading::{Ledger, LoadForces, StepLoad};
use crate::history::state::ModelState;
use crate::solver::{Factored, LinearMeasure, NodalSolution, NotPositiveDefinite, Ramp};

/// One factorisation per set of supports, no iteration. An increment takes one solve, a step whose loads are affine in the
/// load factor two at most.
pub(super) struct LinearEngine<'a, F> {
    interfaces: &'a [InterfaceOperator],
    make: Make<'a, F>,
    factored: Option<(Vec<bool>, F)>,
    /// The step's loads, if they are affine.
    ends: Option<RampEnds>,
}

impl<'a, F> LinearEngine<'a, F> {
    /// With factors made for every set of supports.
    pub(super) fn new(interfaces: &'a [InterfaceOperator], make: Make<'a, F>) -> Self {
        LinearEngine { interfaces, make, factored: None, ends: None }
    }
}

/// The answer to a load.
struct Answered {
    solution: NodalSolution,
    /// Jumps (n, t) of every interface, law point by law point.
    jumps: Vec<Vec<f64>>,
    measured: Vec<f64>,
}

impl Answered {
    fn new(
        solution: NodalSolution,
        interfaces: &[InterfaceOperator],
        measures: &[LinearMeasure],
    ) -> Answered {
        let jumps = interfaces.iter().map(|interface| interface.jumps(&solution.u)).collect();
        let measured = measures.iter().map(|measure| measure.of(&solution)).collect();
        Answered { solution, jumps, measured }
    }
}

/// Answers at the ends of a ramp, as far as they were needed. Between them the response is
///
/// ```text
/// u(λ) = u₀ + λ (u₁ − u₀)
/// ```
///
/// and so are jumps and measures, with which an increment whose fields are not stored can do.
struct RampEnds {
    ramp: Ramp,
    measures: Vec<LinearMeasure>,
    answers: [Option<Answered>; 2],
}

impl RampEnds {
    /// The equilibrium at a load factor, with displacements if it is to be `complete`. Its backward error is the larger of both
    /// ends', relative to what both carry: |r| ≤ error · ((1 − λ) (|A| |u₀| + |f₀|) + λ (|A| |u₁| + |f₁|)), and the rounding
    /// of the sum.
    fn at(
        &mut self,
        factored: &impl Factored,
        interfaces: &[InterfaceOperator],
        load_factor: f64,
        complete: bool,
    ) -> Option<Converged> {
        let needed = if load_factor == 1.0 { 1..2 } else { 0..2 };
        let missing: Vec<usize> = needed.filter(|&end| self.answers[end].is_none()).collect();
        let load = |&end: &usize| (&self.ramp.force[end][..], &self.ramp.prescribed[end][..]);
        let solved = factored.refined_all(&missing.iter().map(load).collect::<Vec<_>>());
        for (end, solution) in missing.into_iter().zip(solved) {
            self.answers[end] = Some(Answered::new(solution, interfaces, &self.measures));
        }
        let [start, end] = &self.answers;
        let end = end.as_ref()?;
        let start = if load_factor == 1.0 { end } else { start.as_ref()? };
        let between = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + load_factor * (b - a)).collect()
        };
        let (a, b) = (&start.solution, &end.solution);
        let backward_error = a.backward_error.max(b.backward_error);
        let solution = || NodalSolution {
            u: between(&a.u, &b.u),
            reactions: between(&a.reactions, &b.reactions),
            backward_error,
        };
        let jumps = start.jumps.iter().zip(&end.jumps).map(|(a, b)| between(a, b)).collect();
        let ledger = Ledger::new(load_factor, &between(&start.measured, &end.measured));
        Some(found(complete.then(solution), backward_error, jumps, ledger, interfaces))
    }
}

/// The equilibrium of a linear scene as an increment that converged.
fn found(
    solution: Option<NodalSolution>,
    backward_error: f64,
    jumps: Vec<Vec<f64>>,
    ledger: Option<Ledger>,
    interfaces: &[InterfaceOperator],
) -> Converged {
    let answer = |(interface, jumps): (usize, Vec<f64>)| {
        let components = interfaces[interface].coupling.components;
        InterfaceResponse::new(interface, components, &jumps, Vec::new()) // elastic: remembers nothing
    };
    let interfaces = jumps.into_iter().enumerate().map(answer).collect();
    Converged {
        solution,
        ledger,
        interfaces,
        released: 0.0,
        bend: 0.0,
        iterations: 0,
        wasted: 0,
        residuals: vec![backward_error],
    }
}

/// A solution with a larger backward error is not kept.
const UNUSABLE: f64 = 1e-6;

impl<F: Factored> Engine for LinearEngine<'_, F> {
    fn support(&mut self, constrained: &[bool]) -> Result<bool, NotPositiveDefinite> {
        if self.factored.as_ref().is_some_and(|(of, _)| of == constrained) {
            return Ok(false);
        }
        (self.factored, self.ends) = (None, None); // two factors at a time would not fit
        let (factored, anew) = (self.make)(constrained)?;
        self.factored = Some((constrained.to_vec(), factored));
        Ok(anew)
    }

    fn prepare(&mut self, ramp: Option<&Ramp>, measures: &[LinearMeasure]) {
        let ends =
            |ramp: &Ramp| RampEnds { ramp: ramp.clone(), measures: measures.to_vec(), answers: [None, None] };
        self.ends = ramp.map(ends);
    }

    fn finds_all_jumps(&self) -> bool {
        true
    }

    fn solve(
        &mut self,
        _: &ModelState,
        load: &StepLoad,
        _: Ahead,
        complete: bool,
    ) -> Result<Converged, Failure> {
        let Some((_, factored)) = &self.factored else { return Err(Failure::Unusable(f64::INFINITY)) };
        let usable = |found: &Converged| found.residuals[0] <= UNUSABLE;
        let between = self
            .ends
            .as_mut()
            .and_then(|ends| ends.at(factored, self.interfaces, load.load_factor, complete));
        if let Some(found) = between.filter(usable) {
            return Ok(found);
        }
        let LoadForces { loaded, prescribed, .. } = load.forces();
        let solution = factored.refined(loaded, prescribed);
        let Answered { solution, jumps, .. } = Answered::new(solution, self.interfaces, &[]);
        let backward_error = solution.backward_error;
        let found = found(Some(solution), backward_error, jumps, None, self.interfaces);
        if usable(&found) { Ok(found) } else { Err(Failure::Unusable(backward_error)) }
    }

    fn creep(&mut self, _: &ModelState, _: &StepLoad, _: Viscous, _: bool) -> Result<Converged, Failure> {
        Err(Failure::Unusable(f64::INFINITY)) // nothing softens
    }

    fn estimate(&mut self, _: &ModelState, _: &Converged, _: Way) -> Option<Estimate> {
        None
    }

    fn is_reached(&mut self, _: &ModelState, _: &Converged, _: &StepLoad) -> bool {
        true
    }

    fn onset(&mut self, _: &ModelState, _: &StepLoad, _: &StepLoad, _: f64) -> Option<f64> {
        None
    }

    fn imbalance(&self, _: &ModelState, _: &StepLoad) -> f64 {
        0.0
    }

    fn follow(&mut self, _: &ModelState, _: f64, _: &PathSearch) -> Result<(Converged, f64), Failure> {
        Err(Failure::Unusable(f64::INFINITY)) // nothing dissipates
    }

    fn recover(&self, _: &StepLoad) -> Option<NodalSolution> {
        None
    }

    fn search(&self) -> Search {
        Search::default()
    }

    fn restore(&mut self, _: Search) {}

    fn begin_viscous(&mut self) -> Search {
        Search::default()
    }

    fn accept(&mut self) {}
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// A free dof on a spring of stiffness 1 that counts the solves.
    #[derive(Default)]
    struct Spring(Cell<usize>);

    impl Factored for Spring {
        fn constrained(&self) -> &[bool] {
            &[false]
        }

        fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
            vec![f[0] - u[0]]
        }

        fn add_moved(&self, u: &[f64], scale: &mut [f64]) {
            scale[0] += u[0].abs();
        }

        fn apply(&self, b: &mut [Vec<f64>]) {
            self.0.set(self.0.get() + b.len());
        }
    }

    #[test]
    fn a_ramp_takes_two_solves_and_a_single_increment_one() {
        for (increments, solves) in [(1, 1), (2, 2), (51, 2)] {
            let base_spring = Spring::default();
            let ramp = Ramp { force: [vec![1.0], vec![3.0]], prescribed: [vec![0.0], vec![0.0]] };
            let mut ends = RampEnds { ramp, measures: Vec::new(), answers: [None, None] };
            for k in 1..=increments {
                let load_factor = k as f64 / increments as f64;
                let found = ends.at(&base_spring, &[], load_factor, true).unwrap();
                assert_eq!(found.solution.unwrap().u, [1.0 + load_factor * 2.0]);
            }
            assert_eq!(base_spring.0.get(), solves, "{increments} increments");
        }
    }
}
