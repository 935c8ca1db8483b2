//! The laws as Newton's method asks them: with the states at the last accepted part of an increment, and with a viscosity of
//! their jumps.

use super::press::press;
use crate::history::converged::PointResponse;
use crate::law::{self, Local, local, write_diagonal, write_rows};
use crate::output::{Presence, Snapshot};
use crate::problem::{BoundStep, Problem, StepWater};
use crate::solver::{Pressures, Respond};

/// A viscosity above this part of the stiffness makes tiny steps.
const STIFF: f64 = 0.1;

/// States of the law points from which a part starts, and which interfaces are there.
#[derive(Clone, Copy)]
pub(in crate::history) struct OldStates<'a> {
    pub(in crate::history) states: &'a [Vec<law::State>],
    pub(in crate::history) presence: &'a Presence,
    /// Pressures in the interfaces, empty for those without.
    pub(in crate::history) pressures: &'a [Vec<f64>],
}

impl<'a> OldStates<'a> {
    /// Pressure at a law point.
    pub(in crate::history) fn pressure(&self, interface: usize, point: usize) -> f64 {
        self.pressures.get(interface).and_then(|own| own.get(point)).copied().unwrap_or(0.0)
    }

    /// States of the last accepted increment.
    pub(in crate::history) fn of(snapshot: &'a Snapshot) -> OldStates<'a> {
        OldStates {
            states: &snapshot.states,
            presence: &snapshot.presence,
            pressures: &snapshot.water.pressures,
        }
    }
}

/// The laws from given states.
///
/// ```text
/// t(r; state) + c (r − r₀)        with a viscosity c; friction lags then (`law::lagged`)
/// ```
#[derive(Clone, Copy)]
pub(in crate::history) struct Laws<'a> {
    pub(in crate::history) problem: &'a Problem,
    pub(in crate::history) old: OldStates<'a>,
    /// c [stress / length], if there is one.
    pub(in crate::history) viscosity: Option<f64>,
    /// Friction lags wherever it is steep, not only where its slope has no bound.
    pub(in crate::history) lags: bool,
    /// Growth of the step's load factor since the states: time, for laws with a viscosity of their own.
    pub(in crate::history) advance: f64,
    /// Law points of every interface that are held elastic, if any are.
    pub(in crate::history) intact: Option<&'a [Vec<bool>]>,
    /// Water of the step, if it depends on the jumps of some interface, and the load factor.
    pub(in crate::history) water: Option<&'a StepWater>,
    pub(in crate::history) load_factor: f64,
}

impl<'a> Laws<'a> {
    /// The laws alone, in a step at a load factor.
    pub(in crate::history) fn alone(
        problem: &'a Problem,
        old: OldStates<'a>,
        advance: f64,
        (step, load_factor): (&'a BoundStep, f64),
    ) -> Laws<'a> {
        let coupled = problem.interfaces.iter().any(|interface| interface.coupled_pressure);
        let water = step.water.as_deref().filter(|_| coupled);
        Laws { problem, old, viscosity: None, lags: false, advance, intact: None, water, load_factor }
    }

    /// The answer of the law alone.
    pub(in crate::history) fn own(
        &self,
        interface: usize,
        point: usize,
        jump: Local,
    ) -> Result<law::Response, String> {
        let law = self.problem.interfaces[interface].laws.at(point);
        let old = &self.old.states[interface][point];
        let integration = self.problem.interfaces[interface].integration;
        let answer = match self.viscosity {
            _ if law.is_viscous() => law.respond_over(jump, old, integration, self.advance),
            Some(_) => law.respond_lagged(jump, old, integration, self.lags),
            None => law.respond(jump, old, integration),
        };
        answer.map_err(|why| why.to_string())
    }
}

impl Respond for Laws<'_> {
    type Memory = PointResponse;

    fn respond(
        &self,
        interface: usize,
        point: usize,
        jump: &[f64],
        traction: &mut [f64],
        stiffness: &mut [f64],
    ) -> Result<PointResponse, String> {
        let law = self.problem.interfaces[interface].laws.at(point);
        let components = jump.len();
        if self.old.states[interface].is_empty() {
            let k = law.elastic_stiffness();
            (0..components).for_each(|i| traction[i] = k[i] * jump[i]); // what it starts with is a load
            write_diagonal(&k[..components], stiffness);
            return Ok(PointResponse::default());
        }
        if self.old.presence.is_absent(interface) {
            traction.fill(0.0);
            stiffness.fill(0.0);
            let state = law::State { traction: Local::zeros(), ..self.old.states[interface][point] };
            return Ok(PointResponse { state, ..PointResponse::default() });
        }
        let jump = self.old.presence.counted(interface, point, local(jump));
        if self.intact.is_some_and(|intact| intact[interface][point]) {
            let old = &self.old.states[interface][point];
            let (held, k) = law.held(jump, old);
            traction.copy_from_slice(&held.as_slice()[..components]);
            write_diagonal(&k[..components], stiffness);
            return Ok(PointResponse { state: *old, ..PointResponse::default() });
        }
        let answer = self.own(interface, point, jump)?;
        traction.copy_from_slice(&answer.traction.as_slice()[..components]);
        write_rows(&answer.stiffness, components, stiffness);
        let mut viscous = Local::zeros();
        if let Some(c) = self.viscosity {
            let old = &self.old.states[interface][point].jump;
            for i in 0..components {
                viscous[i] = c * (jump[i] - old[i]);
                traction[i] += viscous[i];
                stiffness[(components + 1) * i] += c;
            }
        }
        Ok(PointResponse {
            state: answer.state,
            dissipation: answer.dissipation,
            gradient: answer.dissipation_gradient,
            released: answer.released,
            viscous,
            damage_gradient: answer.damage_gradient,
            pressure: 0.0,
        })
    }

    fn pressures(
        &self,
        active: &[usize],
        jumps: &[Vec<f64>],
        memory: &mut [Vec<PointResponse>],
        by_load_factor: bool,
    ) -> Result<Option<Pressures>, String> {
        let Some(water) = self.water else { return Ok(None) };
        let water = (water, self.load_factor);
        press(self.problem, self.old.presence, water, active, jumps, memory, by_load_factor).map(Some)
    }

    fn at(self, load_factor: f64) -> Self {
        Laws { load_factor, ..self }
    }

    fn dissipation<'m>(&self, memory: &'m PointResponse) -> (f64, &'m [f64]) {
        (memory.dissipation, &memory.gradient.as_slice()[..self.problem.model.components])
    }

    fn initial_stiffness(&self, interface: usize, point: usize, stiffness: &mut [f64]) {
        let k = self.problem.interfaces[interface].laws.at(point).elastic_stiffness();
        write_diagonal(&k[..self.problem.model.components], stiffness);
    }
}

/// Friction may lag wherever it is steep: some law dilates and the viscosity is above the softening, or steps are so small
/// that lagging costs nothing.
pub(super) fn may_lag(problem: &Problem, viscosity: f64) -> bool {
    let laws = || problem.laws().filter(|law| law.steepest_softening() > 0.0);
    let stiffness = laws().flat_map(|law| law.elastic_stiffness()).fold(0.0, f64::max);
    let softening = laws().map(|law| law.steepest_softening()).fold(0.0, f64::max);
    let least =
        if laws().any(|law| law.dilates()) { softening.min(STIFF * stiffness) } else { STIFF * stiffness };
    softening > 0.0 && viscosity >= least
}
