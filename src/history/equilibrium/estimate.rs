//! The error of a part of an increment, from the laws in its middle: no equilibrium is sought for it.
//!
//! ```text
//! a_m = ½ (a₀ + a₁) − J⁻¹ R(½ (a₀ + a₁))       the middle of the way, corrected once with the last factor
//! error     t(a₀ → a_m → a₁) − t(a₀ → a₁)       what the laws answer over the middle, against the straight way
//! bend      ⅓ (t₀ − 2 t_m + t₁) · Δr            Simpson's rule against the trapezoidal one; large where the way is none
//! ```
//!
//! The laws integrate along a straight way of their jumps, so that an increment is exact where the way of equilibria is
//! straight. Where it bends, both numbers fall with the third power of the part; where a part jumps to another branch, the
//! bend stays.

use super::laws::{Laws, OldStates};
use super::view::{View, target};
use super::{Estimate, ON, Way, late};
use crate::history::converged::{Converged, PointResponse};
use crate::history::loading::StepLoad;
use crate::history::water::pressures_of;
use crate::law::{self, Law, Local, N};
use crate::output::Snapshot;
use crate::solver::PathPoint;
use crate::solver::{Affine, Form, ask, corrected};

/// A change of the traction is elastic within this part of it, and of what rounding leaves of the jump.
const LINEAR: f64 = 1e-9;
const DIGITS: f64 = 8.0 * f64::EPSILON;

/// True if every point of an interface answers elastically, or is open throughout.
fn is_straight(law: &Law, old: &law::State, answer: &PointResponse) -> bool {
    let new = &answer.state;
    if answer.dissipation != 0.0 || answer.released != 0.0 {
        return false;
    }
    if old.traction == new.traction && old.traction == Local::zeros() {
        return true;
    }
    let k = law.held(new.jump, old).1;
    let differs = |i: usize, k: f64| {
        let (change, elastic) = (new.traction[i] - old.traction[i], k * (new.jump[i] - old.jump[i]));
        let rounding = DIGITS * k * (new.jump[i].abs() + old.jump[i].abs() + old.jump_plastic[i].abs());
        (change - elastic).abs() > LINEAR * elastic.abs() + rounding
    };
    !k.into_iter().enumerate().any(|(i, k)| differs(i, k))
}

/// The estimate for what was found last, after a growth of the load factor, under the load in the middle; none if the way there is straight.
pub(super) fn error_of<F: Form>(
    view: &View<F>,
    old: OldStates,
    found: &Converged,
    way: Way,
    advance: f64,
) -> Option<Estimate> {
    let problem = view.problem;
    let straight = found.interfaces.iter().all(|of| {
        let laws = &problem.interfaces[of.interface].laws;
        if problem.interfaces[of.interface].coupled_pressure {
            let mut all = of.memory.iter().enumerate();
            if all.any(|(p, now)| now.pressure != 0.0 || old.pressure(of.interface, p) != 0.0) {
                return false;
            }
        }
        let mut points = old.states[of.interface].iter().zip(&of.memory).enumerate();
        points.all(|(p, (old, new))| is_straight(laws.at(p), old, new))
    });
    if straight {
        return None;
    }
    Some(over_the_middle(view, old, found, way, advance).unwrap_or(Estimate {
        traction: f64::INFINITY,
        dissipation: f64::INFINITY,
        work: f64::INFINITY,
        passed: 0.0,
        bend: f64::INFINITY,
        cracked: false,
        late: false,
    }))
}

fn over_the_middle<F: Form>(
    view: &View<F>,
    old: OldStates,
    found: &Converged,
    way: Way,
    advance: f64,
) -> Option<Estimate> {
    let View { problem, prepared, form, .. } = *view;
    let target_of = |load| target(form, prepared, load).ok();
    let target = target_of(way.middle)?;
    let laws = Laws::alone(problem, old, 0.5 * advance, way.middle.at());
    let x: Vec<f64> = view.unknowns.iter().zip(view.found).map(|(a, b)| 0.5 * (a + b)).collect();
    // on a path the load factor is corrected too, so that the middle stays on the plane across the way
    let across = match way.ends {
        Some([start, end]) => {
            let (start, end) = (target_of(start)?, target_of(end)?);
            let way = view.unknowns.iter().zip(view.found).map(|(a, b)| b - a).collect();
            Some((Affine::new(start, &end).change, way))
        }
        None => None,
    };
    let [halfway, corrected] =
        corrected(form, &laws, &PathPoint { x, load_factor: way.middle.load_factor }, &target, across)
            .ok()?;
    // a point that changes its mode in the second half leads the correction astray
    let better = if corrected.residuals[0] < halfway.residuals[0] { &corrected } else { &halfway };
    let mut states = old.states.to_vec();
    for (&k, memory) in form.active().iter().zip(&better.memory) {
        states[k].iter_mut().zip(memory).for_each(|(state, answer)| *state = answer.state);
    }
    let from = OldStates { states: &states, ..old };
    let onwards = Laws::alone(problem, from, 0.5 * advance, way.end.at());
    let end = ask(form, &onwards, view.found).ok()?;
    let mut estimate = Estimate::default();
    let (mut squares, mut bends, mut works) = (0.0, 0.0, 0.0);
    for (a, of) in found.interfaces.iter().enumerate() {
        let points = &problem.model.interfaces[of.interface].coupling.points;
        let before = |p: usize| old.pressure(of.interface, p);
        for (p, (old, new)) in old.states[of.interface].iter().zip(&of.memory).enumerate() {
            let area = problem.model.thickness * points[p].weight;
            let (there, here) = (&end.memory[a][p], &better.memory[a][p]);
            squares += points[p].weight * (there.state.traction - new.state.traction).norm_squared();
            estimate.dissipation += area * (here.dissipation + there.dissipation - new.dissipation);
            // (t₀ − 2 t_m + t₁) / 3: the trapezoidal rule less Simpson's
            let middle = &halfway.memory[a][p];
            let mut bend = old.traction + new.state.traction - 2.0 * middle.state.traction;
            if problem.interfaces[of.interface].coupled_pressure {
                bend[N] -= before(p) + new.pressure - 2.0 * middle.pressure;
            }
            let moved = new.state.jump - old.jump;
            estimate.work += area * bend.dot(&moved) / 3.0;
            bends += area * bend.dot(&moved).abs() / 3.0;
            estimate.cracked |= new.dissipation > 0.0
                && problem.interfaces[of.interface]
                    .laws
                    .at(p)
                    .onset(new.state.jump, old)
                    .is_some_and(|share| share > ON);
            works += area * 0.5 * (old.traction + new.state.traction).dot(&moved).abs();
        }
    }
    estimate.late = late::late(problem, old, found).is_some();
    estimate.traction = squares.sqrt();
    estimate.bend = if bends > 0.0 { bends / works } else { 0.0 };
    estimate.passed = works;
    Some(estimate)
}

/// The relative out-of-balance force of the last accepted state.
pub(super) fn imbalance<F: Form>(view: &View<F>, snapshot: &Snapshot, load: &StepLoad) -> Option<f64> {
    let View { problem, prepared, form, .. } = *view;
    let target = target(form, prepared, load).ok()?;
    let coupled = problem.interfaces.iter().any(|interface| interface.coupled_pressure);
    let (step, load_factor) = load.at();
    let pressures = match &step.water {
        Some(water) if coupled => pressures_of(problem, snapshot, water, load_factor).ok()?.pressures,
        _ => Vec::new(),
    };
    let force = |&k: &usize| {
        let interface = &problem.model.interfaces[k];
        let states = &snapshot.states[k];
        let leading = |v: Local| <[f64; 3]>::from(v).into_iter().take(problem.model.components);
        let tractions: Vec<f64> = if states.is_empty() {
            let laws = &problem.interfaces[k].laws;
            let d = |p: usize| Local::from(laws.at(p).elastic_stiffness());
            let jumps = snapshot.jumps[k].iter().enumerate();
            jumps.flat_map(|(p, r)| leading(d(p).component_mul(r))).collect()
        } else {
            states.iter().flat_map(|state| leading(state.traction)).collect()
        };
        let mut tractions = tractions;
        if problem.interfaces[k].coupled_pressure
            && let Some(pressures) = pressures.get(k)
        {
            let normal = tractions.iter_mut().step_by(problem.model.components);
            normal.zip(pressures).for_each(|(traction, pressure)| *traction -= pressure);
        }
        interface.gather(&tractions)
    };
    let forces: Vec<Vec<f64>> = form.active().iter().map(force).collect();
    let residual = form.residual(view.unknowns, &forces, &target);
    Some(form.error(&residual, view.unknowns, &forces, &target))
}
