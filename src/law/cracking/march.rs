//! One step of the integration and the derivatives it carries along.
//!
//! A step is a diagonally implicit Runge–Kutta step whose stages are backward Euler steps from shifted old values:
//!
//! ```text
//! γ │ γ                 γ = 1 − 1/√2: second order, L-stable (Alexander, SIAM J. Numer. Anal. 14, 1977)
//! 1 │ 1−γ   γ
//! ```
//!
//! The last stage is the end of the step, so F = 0 holds there to rounding; all weights are positive, so the work W
//! and the dissipation never fall. Plain backward Euler is the one stage γ = 1. Tractions are carried instead of the
//! irreversible jump: K r loses digits at high stiffness, K Δr of a sub-step does not. Where a crack closes and the first stage
//! changes its regime (`crack`), the step is two backward Euler steps, γ and 1 − γ.

use nalgebra::{SMatrix, SVector};

use super::super::State;
use super::super::local::{N, narrow, shear};
use super::crack::{Crack, Regime};
use super::elastic::{stiff, stiff_rows};
use super::mode::Mode;
use super::newton::Near;
use super::stage::{Old, Stage, stage, stage_nested};
use super::stage_slopes::{CrackSlopes, StageSlopes};
use super::surface::Surface;
use super::ties::bounded_slope;
use super::variables::WORK;

/// γ of the two-stage scheme.
pub(super) const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Weight of the first stage per its own step: (1 − γ)/γ.
const FIRST: f64 = (1.0 - GAMMA) / GAMMA;

/// A point of the way.
#[derive(Debug, Clone, Copy)]
pub(super) struct WayPoint<const D: usize> {
    pub traction: SVector<f64, D>,
    pub work: f64,
    pub dissipation: f64,
    pub mode: Mode,
    pub crack: Crack,
}

/// Derivatives of a point by the jump at the end of the whole increment; columns (n, t, s).
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes<const D: usize> {
    /// ∂τ_s/∂r_s in the plane, where s depends on nothing else.
    pub across: f64,
    pub traction: SMatrix<f64, D, D>,
    pub work: SVector<f64, D>,
    pub dissipation: SVector<f64, D>,
    pub crack: CrackSlopes<D>,
}

/// Derivative of a change of jump by the jump at the end; in the plane that of s stands alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change<const D: usize> {
    pub along: SMatrix<f64, D, D>,
    pub across: f64,
}

/// A step of the two-stage scheme.
#[derive(Debug, Clone, Copy)]
pub(super) struct TwoStages<const D: usize> {
    pub stages: [Stage<D>; 2],
    /// The second stage starts where the first one ends.
    restarts: bool,
    /// B at the start and what the step pays for more of it.
    kept: f64,
    paid: f64,
}

impl<const D: usize> TwoStages<D> {
    /// True if a stage has another mode than the end, or the crack changed its regime in the first one.
    pub fn is_across(&self, mode: Mode) -> bool {
        self.stages.iter().any(|stage| stage.mode() != mode)
            || (self.restarts && self.stages[0].before.regime != self.stages[1].crack.regime)
    }
}

impl<const D: usize> WayPoint<D> {
    /// The start of an increment.
    pub fn start(surface: &Surface, old: &State) -> WayPoint<D> {
        WayPoint {
            traction: narrow(&old.traction),
            work: old.own[WORK],
            dissipation: 0.0,
            mode: Mode::Elastic,
            crack: Crack::of(surface, old),
        }
    }

    /// Share of a change of jump that a spent crack does in contact, after its faces met; none if they do not.
    pub fn share_in_contact(&self, change: SVector<f64, D>) -> Option<f64> {
        let meets = self.crack.regime == Regime::Free && self.crack.gap + change[N] < 0.0;
        meets.then(|| 1.0 + self.crack.gap / change[N])
    }

    /// The faces of a spent crack meet here; nothing is carried yet.
    pub fn touch(&mut self, surface: &Surface) {
        self.traction = SVector::zeros();
        let Crack { dilated, .. } = self.crack;
        self.crack = Crack { dilated, ..Crack::closed(surface) };
    }

    /// The old values of a backward Euler step along a change of jump.
    fn old(&self, surface: &Surface, change: SVector<f64, D>) -> Old<D> {
        Old {
            carried: self.traction + stiff(surface, change),
            work: self.work,
            crack: Crack { gap: self.crack.gap + change[N], ..self.crack },
            opens: change[N] >= 0.0,
            near: Near { tau: shear(&self.traction), work: 0.0 },
        }
    }
}

/// One backward Euler step by the nested solver.
pub(super) fn step_nested<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
) -> (SVector<f64, D>, f64) {
    let mut from = WayPoint::<D>::start(surface, old);
    let mut change = jump - narrow(&old.jump);
    if let Some(share) = from.share_in_contact(change) {
        from.touch(surface);
        change *= share;
    }
    let stage = stage_nested(surface, &from.old(surface, change));
    (stage.traction, stage.answer.work)
}

/// One backward Euler step along a change of jump.
pub(super) fn euler_step<const D: usize>(
    surface: &Surface,
    from: &WayPoint<D>,
    change: SVector<f64, D>,
) -> (WayPoint<D>, Stage<D>) {
    let stage = stage(surface, &from.old(surface, change));
    let mut dissipation = from.dissipation + stage.dissipation(surface);
    if surface.closes {
        dissipation -= stage.kept_change(surface);
    }
    (stage.end(dissipation), stage)
}

/// Estimate of a place within a step, on parabolas through its start, its first stage and its end.
pub(super) fn within<const D: usize>(from: &WayPoint<D>, step: &TwoStages<D>, x: f64) -> Near {
    let [first, second] = &step.stages;
    let at = |start: f64, middle: f64, end: f64| {
        let (by_middle, by_end) = ((middle - start) / GAMMA, end - start);
        start + x * (by_middle + (x - GAMMA) * (by_end - by_middle) / (1.0 - GAMMA))
    };
    Near {
        tau: at(shear(&from.traction), first.answer.tau, second.answer.tau).max(0.0),
        work: at(from.work, first.answer.work, second.answer.work),
    }
}

/// One step of the two-stage scheme along a change of jump; `near`: the answers of both stages, roughly.
pub(super) fn two_stage_step<const D: usize>(
    surface: &Surface,
    from: &WayPoint<D>,
    change: SVector<f64, D>,
    near: Option<[Near; 2]>,
) -> (WayPoint<D>, TwoStages<D>) {
    let mut old = from.old(surface, change * GAMMA);
    old.near = near.map_or(old.near, |near| near[0]);
    old.carried = from.traction + GAMMA * stiff(surface, change);
    let first = stage(surface, &old);
    if surface.closes && !first.is_regular() {
        let middle = first.end(from.dissipation + first.dissipation(surface) - first.kept_change(surface));
        let (end, second) = euler_step(surface, &middle, change * (1.0 - GAMMA));
        return (end, TwoStages { stages: [first, second], restarts: true, kept: 0.0, paid: 0.0 });
    }
    let returned = first.trial - first.traction;
    let mut old = Old {
        carried: from.traction + stiff(surface, change) - FIRST * returned,
        work: from.work + FIRST * (first.answer.work - from.work),
        near: near.map_or_else(|| first.onwards(from), |near| near[1]),
        ..from.old(surface, change)
    };
    if surface.closes {
        let shifted = |before: f64, after: f64| before + FIRST * (after - before);
        old.crack.opening = shifted(from.crack.opening, first.crack.opening).max(0.0);
        old.crack.slip = shifted(from.crack.slip, first.crack.slip);
        if from.crack.regime == Regime::Secant {
            old.crack.bridge = shifted(from.crack.bridge, first.crack.bridge).max(0.0);
        }
        old.crack.dilated = first.crack.dilated;
    }
    let second = stage(surface, &old);
    let dissipation = from.dissipation + FIRST * first.dissipation(surface) + second.dissipation(surface);
    let mut end = second.end(dissipation);
    if surface.closes && end.crack.regime == Regime::Free && !surface.is_spent(from.work) {
        end.work = surface.settled(end.work.min(surface.all_of_mode_i())); // the shift may lie beyond it
    }
    let (mut kept, mut paid) = (0.0, 0.0);
    if surface.closes && from.crack.regime == Regime::Envelope && second.is_regular() {
        kept = from.crack.stored;
        paid = FIRST * first.spent_on_opening(surface) + second.spent_on_opening(surface);
        end.crack.keep(surface, kept + paid, end.traction[N]);
        end.dissipation -= end.crack.stored - kept;
    } else if surface.closes {
        end.dissipation -= second.kept_change(surface);
    }
    (end, TwoStages { stages: [first, second], restarts: false, kept, paid })
}

impl<const D: usize> Stage<D> {
    /// Estimate of the end of a step from its first stage, on a straight line.
    fn onwards(&self, from: &WayPoint<D>) -> Near {
        let tau = shear(&from.traction);
        let ahead = |before: f64, now: f64| before + (now - before) / GAMMA;
        Near { tau: ahead(tau, self.answer.tau).max(0.0), work: ahead(from.work, self.answer.work) }
    }

    fn end(&self, dissipation: f64) -> WayPoint<D> {
        WayPoint {
            traction: self.traction,
            work: self.answer.work,
            dissipation,
            mode: self.answer.mode,
            crack: self.crack,
        }
    }
}

impl<const D: usize> Slopes<D> {
    /// At the start of an increment nothing depends on its end.
    pub fn none() -> Slopes<D> {
        Slopes {
            across: 0.0,
            traction: SMatrix::zeros(),
            work: SVector::zeros(),
            dissipation: SVector::zeros(),
            crack: CrackSlopes::none(),
        }
    }

    /// Carries the derivatives over a backward Euler step, whose change of jump has the derivative `change`.
    pub fn over_euler_step(&self, surface: &Surface, stage: &Stage<D>, change: &Change<D>) -> Slopes<D> {
        let carried = self.traction + stiff_rows(surface, &change.along);
        let across = stage.turned(surface) * (self.across + surface.kt * change.across);
        let old = self.crack_after(&change.along);
        let at = stage.slopes(surface, &carried, &self.work, &old);
        let mut dissipation = self.dissipation + stage.dissipation_slope(surface, &old, &at);
        let mut crack = at.crack;
        if surface.closes {
            let [end, added] = stage.kept_slopes(surface, &old, &at);
            crack.stored = end;
            dissipation -= added;
            if stage.crack.regime == Regime::Envelope {
                crack.set_bridge_by_stored(surface, &stage.crack);
            }
        }
        Slopes { across, traction: at.traction, work: at.work, dissipation, crack }
    }

    /// Carries the derivatives over a step of the two-stage scheme.
    pub fn over_two_stages(
        &self,
        surface: &Surface,
        step: &TwoStages<D>,
        change: &Change<D>,
        end: &WayPoint<D>,
    ) -> Slopes<D> {
        let stages = &step.stages;
        if step.restarts {
            let part = |part: f64| Change { along: change.along * part, across: change.across * part };
            return self.over_euler_step(surface, &stages[0], &part(GAMMA)).over_euler_step(
                surface,
                &stages[1],
                &part(1.0 - GAMMA),
            );
        }
        let stiff = stiff_rows(surface, &change.along);
        let (across, kt) = (self.across, surface.kt * change.across);
        let returned = (1.0 - stages[0].turned(surface)) * (across + GAMMA * kt);
        let across = stages[1].turned(surface) * (across + kt - FIRST * returned);
        let carried_1 = self.traction + GAMMA * stiff;
        let old_1 = self.crack_after(&(change.along * GAMMA));
        let at_1 = stages[0].slopes(surface, &carried_1, &self.work, &old_1);
        let carried_2 = self.traction + stiff - FIRST * (at_1.trial - at_1.traction);
        let work_old = self.work + FIRST * (at_1.work - self.work);
        let mut old_2 = self.crack_after(&change.along);
        if surface.closes {
            let shifted = |before: SVector<f64, D>, after: SVector<f64, D>| before + (after - before) * FIRST;
            old_2.opening = shifted(self.crack.opening, at_1.crack.opening);
            old_2.slip = shifted(self.crack.slip, at_1.crack.slip);
            if stages[0].crack.regime == Regime::Secant {
                old_2.bridge = match stages[1].before.bridge > 0.0 {
                    true => shifted(self.crack.bridge, at_1.crack.bridge),
                    false => SVector::zeros(),
                };
            }
        }
        let at = stages[1].slopes(surface, &carried_2, &work_old, &old_2);
        let mut dissipation = self.dissipation
            + FIRST * stages[0].dissipation_slope(surface, &old_1, &at_1)
            + stages[1].dissipation_slope(surface, &old_2, &at);
        let mut crack = at.crack;
        if surface.closes {
            let added = self.kept_over(surface, step, [&at_1, &at], &old_2, end, &mut crack);
            dissipation -= added;
        }
        Slopes { across, traction: at.traction, work: at.work, dissipation, crack }
    }

    /// Derivatives of the crack's state, with the gap after a change of jump.
    fn crack_after(&self, change: &SMatrix<f64, D, D>) -> CrackSlopes<D> {
        CrackSlopes { gap: self.crack.gap + change.row(N).transpose(), ..self.crack }
    }

    /// Sets dB and dk at the end of a step that does not restart; returns the derivative of what was added to B.
    fn kept_over(
        &self,
        surface: &Surface,
        step: &TwoStages<D>,
        [first, second]: [&StageSlopes<D>; 2],
        old: &CrackSlopes<D>,
        end: &WayPoint<D>,
        crack: &mut CrackSlopes<D>,
    ) -> SVector<f64, D> {
        let [one, two] = &step.stages;
        if two.before.regime != Regime::Envelope || !two.is_regular() {
            let [stored, added] = two.kept_slopes(surface, old, second);
            crack.stored = stored;
            return added;
        }
        let paid = one.spent_slope(surface, first) * FIRST + two.spent_slope(surface, second);
        crack.stored = bounded_slope(&end.crack, step.kept + step.paid, self.crack.stored + paid, second);
        crack.set_bridge_by_stored(surface, &end.crack);
        crack.stored - self.crack.stored
    }
}
