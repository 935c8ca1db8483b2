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

use super::laws::Laws;
use super::newton::NewtonEngine;
use crate::history::loading::Load;
use crate::history::state::{Answer, Found, State};
use crate::law;
use crate::problem::Problem;
use crate::solver::{Affine, Form, Iterate};

/// A change of the traction is elastic within this part of it, and of what rounding leaves of the jump.
const LINEAR: f64 = 1e-9;
const DIGITS: f64 = 8.0 * f64::EPSILON;
/// Points that reach their surface within this fraction of a part do so at once.
const ON: f64 = 1e-6;

/// The error of a part of an increment.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::history) struct Estimate {
    /// Change of the tractions at its end, √(Σ w |Δt|²) [stress × √length].
    pub(in crate::history) traction: f64,
    /// Change of the energy dissipated in it [force × length].
    pub(in crate::history) dissipation: f64,
    /// Error of the trapezoidal rule for the work of the interfaces [force × length].
    pub(in crate::history) work: f64,
    /// The work of the interfaces in the part, added up by magnitude [force × length].
    pub(in crate::history) passed: f64,
    /// The same, added up by magnitude, over the work of the interfaces in the part.
    pub(in crate::history) bend: f64,
    /// Intact points of softening laws have cracked, and some of them after others.
    pub(in crate::history) cracked: bool,
    pub(in crate::history) late: bool,
}

/// The way of a part: load in its middle, and those of the step where its load factor was found along a path.
#[derive(Debug, Clone, Copy)]
pub(in crate::history) struct Way<'a> {
    pub(in crate::history) middle: &'a Load<'a>,
    pub(in crate::history) step: Option<&'a [Load<'a>; 2]>,
}

/// True if every point of an interface answers elastically, or is open throughout.
fn is_straight([kn, kt]: [f64; 2], old: &law::State, answer: &Answer) -> bool {
    let new = &answer.state;
    if answer.dissipation != 0.0 || answer.released != 0.0 {
        return false;
    }
    if old.traction == new.traction && old.traction.x == 0.0 && old.traction.y == 0.0 {
        return true;
    }
    let differs = |i: usize, k: f64| {
        let (change, elastic) = (new.traction[i] - old.traction[i], k * (new.jump[i] - old.jump[i]));
        let rounding = DIGITS * k * (new.jump[i].abs() + old.jump[i].abs() + old.jump_plastic[i].abs());
        (change - elastic).abs() > LINEAR * elastic.abs() + rounding
    };
    !(differs(0, kn) || differs(1, kt))
}

/// Intact points of softening laws that crack in a part after others do; none if all crack at once.
fn late(problem: &Problem, old: &[Vec<law::State>], found: &Found) -> Option<Vec<Vec<bool>>> {
    let mut fractions: Vec<Vec<f64>> = old.iter().map(|states| vec![f64::NAN; states.len()]).collect();
    let mut first = 1.0_f64;
    for of in &found.joints {
        let law = &problem.laws[of.joint].0;
        for (p, (old, new)) in old[of.joint].iter().zip(&of.memory).enumerate() {
            if new.dissipation > 0.0
                && let Some(fraction) = law.onset_or_on(new.state.jump, old)
            {
                fractions[of.joint][p] = fraction;
                first = first.min(fraction);
            }
        }
    }
    let late = |fraction: &f64| *fraction > first + ON;
    let any = fractions.iter().flatten().any(late);
    any.then(|| fractions.iter().map(|of| of.iter().map(late).collect()).collect())
}

impl<F: Form> NewtonEngine<'_, F> {
    /// The estimate for what was found last under the load in the middle; none if the way there is straight.
    pub(in crate::history) fn estimate_part(
        &mut self,
        state: &State,
        found: &Found,
        way: Way,
    ) -> Option<Estimate> {
        let problem = self.problem;
        let old = &state.snapshot.states;
        let straight = found.joints.iter().all(|of| {
            let k = problem.laws[of.joint].0.elastic_stiffness();
            old[of.joint].iter().zip(&of.memory).all(|(old, new)| is_straight(k, old, new))
        });
        if straight {
            return None;
        }
        Some(self.over_the_middle(old, found, way).unwrap_or(Estimate {
            traction: f64::INFINITY,
            dissipation: f64::INFINITY,
            work: f64::INFINITY,
            passed: 0.0,
            bend: f64::INFINITY,
            cracked: false,
            late: false,
        }))
    }

    fn over_the_middle(&mut self, old: &[Vec<law::State>], found: &Found, way: Way) -> Option<Estimate> {
        let problem = self.problem;
        let target = self.target(way.middle).ok()?;
        let (_, form, newton) = self.form.as_ref()?;
        let laws = Laws { problem, old, viscosity: None, lags: false, held: None };
        let x: Vec<f64> = self.unknowns.iter().zip(&self.found).map(|(a, b)| 0.5 * (a + b)).collect();
        // on a path the load factor is corrected too, so that the middle stays on the plane across the way
        let across = match way.step {
            Some([start, end]) => {
                let (start, end) = (self.target(start).ok()?, self.target(end).ok()?);
                let way = self.unknowns.iter().zip(&self.found).map(|(a, b)| b - a).collect();
                Some((Affine::new(start, &end).change, way))
            }
            None => None,
        };
        let [halfway, corrected] = newton.corrected(form, &laws, &x, &target, across).ok()?;
        // a point that changes its mode in the second half leads the correction astray
        let better = if corrected.residuals[0] < halfway.residuals[0] { &corrected } else { &halfway };
        let mut states = old.to_vec();
        for (&k, memory) in form.active().iter().zip(&better.memory) {
            states[k].iter_mut().zip(memory).for_each(|(state, answer)| *state = answer.state);
        }
        let onwards = Laws { problem, old: &states, viscosity: None, lags: false, held: None };
        let end = newton.look(form, &onwards, &self.found).ok()?;
        let mut estimate = Estimate::default();
        let (mut squares, mut bends, mut works) = (0.0, 0.0, 0.0);
        for (a, of) in found.joints.iter().enumerate() {
            let points = &problem.model.joints[of.joint].coupling.points;
            for (p, (old, new)) in old[of.joint].iter().zip(&of.memory).enumerate() {
                let area = problem.model.thickness * points[p].weight;
                let (there, here) = (&end.memory[a][p], &better.memory[a][p]);
                squares += points[p].weight * (there.state.traction - new.state.traction).norm_squared();
                estimate.dissipation += area * (here.dissipation + there.dissipation - new.dissipation);
                // (t₀ − 2 t_m + t₁) / 3: the trapezoidal rule less Simpson's
                let bend = old.traction + new.state.traction - 2.0 * halfway.memory[a][p].state.traction;
                let moved = new.state.jump - old.jump;
                estimate.work += area * bend.dot(&moved) / 3.0;
                bends += area * bend.dot(&moved).abs() / 3.0;
                estimate.cracked |= new.dissipation > 0.0
                    && problem.laws[of.joint].0.onset(new.state.jump, old).is_some_and(|share| share > ON);
                works += area * 0.5 * (old.traction + new.state.traction).dot(&moved).abs();
            }
        }
        estimate.late = late(problem, old, found).is_some();
        estimate.traction = squares.sqrt();
        estimate.bend = if bends > 0.0 { bends / works } else { 0.0 };
        estimate.passed = works;
        Some(estimate)
    }

    /// True if points that crack late in what was found last would do so if they were held: then small parts lead there too.
    /// They are held elastic, the equilibrium is corrected once, and some of them must be beyond its strength.
    pub(in crate::history) fn late_points_crack(
        &mut self,
        state: &State,
        found: &Found,
        end: &Load,
    ) -> Option<bool> {
        let problem = self.problem;
        let old = &state.snapshot.states;
        let Some(held) = late(problem, old, found) else { return Some(true) };
        let target = self.target(end).ok()?;
        let laws = Laws { problem, old, viscosity: None, lags: false, held: Some(&held) };
        let (_, form, newton) = self.form.as_mut()?;
        let here = newton.look(form, &laws, &self.found).ok()?;
        let residual = form.residual(&self.found, &here.forces, &target);
        let change = residual.iter().map(|r| -r).collect();
        let there = newton.along(form, &laws, &self.found, &target, change, self.settings).ok()?;
        for (&k, coefficients) in form.active().iter().zip(form.coefficients(&there)) {
            let jumps = form.joints()[k].jumps_of(&coefficients);
            for ((jump, old), held) in jumps.chunks_exact(2).zip(&old[k]).zip(&held[k]) {
                if *held && problem.laws[k].0.onset([jump[0], jump[1]].into(), old).is_some() {
                    return Some(true);
                }
            }
        }
        Some(false)
    }

    /// Fraction of the way to a load at which the first intact point reaches its surface, on the way on as before (`ahead`) or
    /// along the tangent.
    pub(in crate::history) fn first_onset(
        &mut self,
        state: &State,
        load: &Load,
        now: &Load,
        ahead: f64,
    ) -> Option<f64> {
        let (target, before) = (self.target(load).ok()?, self.target(now).ok()?);
        let problem = self.problem;
        let laws = Laws::alone(problem, &state.snapshot.states);
        let end = if ahead > 0.0 { Some(self.onwards(ahead)) } else { None };
        let (_, form, newton) = self.form.as_mut()?;
        let end = match end {
            Some(end) => end,
            None => {
                let change = target.iter().zip(&before).map(|(b, a)| b - a).collect();
                newton.along(form, &laws, &self.unknowns, &before, change, self.settings).ok()?
            }
        };
        let mut first = 1.0_f64;
        for (&k, coefficients) in form.active().iter().zip(form.coefficients(&end)) {
            let jumps = form.joints()[k].jumps_of(&coefficients);
            for (jump, old) in jumps.chunks_exact(2).zip(&state.snapshot.states[k]) {
                let fraction = problem.laws[k].0.onset([jump[0], jump[1]].into(), old);
                first =
                    fraction.filter(|fraction| *fraction > ON).map_or(first, |fraction| first.min(fraction));
            }
        }
        (first < 1.0).then_some(first)
    }

    /// The relative out-of-balance force of the last accepted state.
    pub(in crate::history) fn out_of_balance(&self, state: &State, load: &Load) -> Option<f64> {
        let target = self.target(load).ok()?;
        let (_, form, _) = self.form.as_ref()?;
        let force = |&k: &usize| {
            let joint = &self.problem.model.joints[k];
            let states = &state.snapshot.states[k];
            let tractions: Vec<f64> = if states.is_empty() {
                let d = self.problem.laws[k].0.elastic_stiffness();
                state.snapshot.jumps[k].iter().flat_map(|r| [d[0] * r[0], d[1] * r[1]]).collect()
            } else {
                states.iter().flat_map(|state| [state.traction.x, state.traction.y]).collect()
            };
            joint.gather(&tractions)
        };
        let forces: Vec<Vec<f64>> = form.active().iter().map(force).collect();
        let residual = form.residual(&self.unknowns, &forces, &target);
        Some(form.error(&residual, &self.unknowns, &forces, &target))
    }

    /// Keeps the viscous tractions of what was found, and returns the work that they do on the way there: that of all tractions
    /// along a straight way, less that of the laws' own by Simpson's rule. And the bend of the tractions of joints that
    /// dilate, √(Σ w |Δt|²).
    pub(in crate::history) fn keep_viscous(&mut self, laws: &Laws, iterate: &Iterate<Answer>) -> [f64; 2] {
        self.viscous[1].clear();
        if laws.viscosity.is_none() && self.viscous[0].is_empty() {
            return [0.0; 2];
        }
        let Some((_, form, _)) = &self.form else { return [0.0; 2] };
        let (mut released, mut bent) = (0.0, 0.0);
        for (a, &k) in form.active().iter().enumerate() {
            let points = &self.problem.model.joints[k].coupling.points;
            let dilates = self.problem.laws[k].0.dilates();
            let mut now = Vec::with_capacity(2 * points.len());
            for (p, (old, answer)) in laws.old[k].iter().zip(&iterate.memory[a]).enumerate() {
                // a traction that drops at the end of a step pushes on in the next
                (0..2).for_each(|i| now.push(iterate.tractions[a][2 * p + i] - answer.state.traction[i]));
                let jump = answer.state.jump;
                let moved = jump - old.jump;
                let middle = 0.5 * (jump + old.jump);
                // a law that lags may drop at once
                let Ok(start) = laws.own(k, p, old.jump.as_slice()) else { continue };
                let Ok(middle) = laws.own(k, p, middle.as_slice()) else { continue };
                for i in 0..2 {
                    let before = self.viscous[0].get(a).map_or(0.0, |viscous| viscous[2 * p + i]);
                    let own = iterate.tractions[a][2 * p + i] - answer.viscous[i];
                    // ½ (t₀ + t₁) − (t₀' + 4 t_m + t₁) / 6
                    let bend = 0.5 * (old.traction[i] + own)
                        - (start.traction[i] + 4.0 * middle.traction[i] + own) / 6.0;
                    bent += if dilates { points[p].weight * bend * bend } else { 0.0 };
                    released += points[p].weight * (0.5 * (before + answer.viscous[i]) + bend) * moved[i];
                }
            }
            self.viscous[1].push(if laws.viscosity.is_some() { now } else { Vec::new() });
        }
        if laws.viscosity.is_none() {
            self.viscous[1].clear();
        }
        [self.problem.model.thickness * released, bent.sqrt()]
    }
}
