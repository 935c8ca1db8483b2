//! Path following by dissipated energy: the load level λ is one more unknown, the energy that the joints dissipate in an
//! increment is one more equation. It never decreases, so that the path is followed through limit and turning points.
//!
//! ```text
//! R(x) = A(x) − b₀ − λ b₁ = 0          ⎡ J   −b₁ ⎤ ⎡δx⎤   ⎡−R⎤
//! g(x) = Σ h w ΔD(r) − Δτ = 0          ⎣ cᵀ    0 ⎦ ⎣δλ⎦ = ⎣−g⎦      c = ∂g/∂x
//! ```
//!
//! Two solves with one factor: δλ = (c·y − g) / (c·z), δx = δλ z − y with y = J⁻¹ R and z = J⁻¹ b₁. The sum of the laws' own
//! dissipation is taken: formulas from energies hold for joints that unload to their origin, ours unload elastically.

use super::newton::{Evaluation, STALLED, UNUSABLE, evaluate, unconverged};
use super::{Form, Iterate, Newton, Respond, Settings, Unconverged};

/// The constraint is met to this, relative to Δτ.
const MET: f64 = 1e-2;
/// Most halvings of a step.
const HALVINGS: usize = 8;
/// Most trials on the way from a sound state to one that dissipates enough.
const TRIALS: usize = 60;

/// A load that is affine in its level: b₀ and b₁.
#[derive(Debug, Clone)]
pub struct Affine {
    /// Target at level 0.
    pub start: Vec<f64>,
    /// Its change up to level 1.
    pub change: Vec<f64>,
}

impl Affine {
    /// From the targets at levels 0 and 1.
    pub fn new(start: Vec<f64>, end: &[f64]) -> Affine {
        let change = end.iter().zip(&start).map(|(end, start)| end - start).collect();
        Affine { start, change }
    }

    /// The target at a level.
    pub fn at(&self, level: f64) -> Vec<f64> {
        self.start.iter().zip(&self.change).map(|(start, change)| start + level * change).collect()
    }
}

/// Where a search stands: unknowns and load level.
#[derive(Debug, Clone)]
pub struct Point {
    /// The unknowns of the form.
    pub x: Vec<f64>,
    /// Load level.
    pub level: f64,
}

impl Newton {
    /// The equilibrium that dissipates `amount` more than the last accepted one, sought from a point.
    pub fn follow<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        start: Point,
        load: &Affine,
        amount: f64,
        settings: Settings,
    ) -> Result<(Iterate<L::Memory>, f64), Unconverged> {
        let Point { mut x, mut level } = start;
        let mut now = evaluate(form, laws, &x, &load.at(level))?;
        let mut residuals = vec![now.error];
        for iterations in 0..=settings.iterations {
            let missing = dissipated(form, laws, &now) - amount;
            let stalled = iterations > 0 && residuals[iterations] > STALLED * residuals[iterations - 1];
            let rounded = || form.rounding(&x, &now.forces, &load.at(level), &self.tangents).min(UNUSABLE);
            let balanced = now.error <= settings.tolerance || stalled && now.error <= rounded();
            if iterations > 0 && balanced && missing.abs() <= MET * amount {
                let Evaluation { jumps, tractions, forces, memory, .. } = now;
                return Ok((Iterate { x, jumps, tractions, forces, memory, iterations, residuals }, level));
            }
            if iterations == settings.iterations {
                break;
            }
            self.fill(form, laws, &now, settings);
            let (mut y, mut z) = (now.residual.clone(), load.change.clone());
            if form.factor(&self.tangents) {
                form.solve(&mut y);
                form.solve(&mut z);
            }
            let c = form.weights(&rates(form, laws, &now));
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let change = (dot(&c, &y) - missing) / dot(&c, &z);
            let correction: Vec<f64> = y.iter().zip(&z).map(|(y, z)| change * z - y).collect();
            if !(change.is_finite() && correction.iter().all(|value| value.is_finite())) {
                return Err(unconverged(form, "the path is singular", &now, iterations));
            }
            let (mut step, mut best) = (1.0, None::<(f64, Vec<f64>, f64, Evaluation<L::Memory>)>);
            let merit = |error: f64, missing: f64| error.max(settings.tolerance).hypot(missing / amount);
            let before = merit(now.error, missing);
            for _ in 0..=HALVINGS {
                let next: Vec<f64> = x.iter().zip(&correction).map(|(x, d)| x + step * d).collect();
                let next_level = level + step * change;
                if let Ok(there) = evaluate(form, laws, &next, &load.at(next_level)) {
                    let value = merit(there.error, dissipated(form, laws, &there) - amount);
                    if value.is_finite() && best.as_ref().is_none_or(|(kept, ..)| value < *kept) {
                        best = Some((value, next, next_level, there));
                    }
                    if value < (1.0 - 1e-4 * step) * before {
                        break;
                    }
                }
                step *= 0.5;
            }
            let Some((_, next, next_level, there)) = best else {
                return Err(unconverged(form, "the laws have no answer along the path", &now, iterations));
            };
            (x, level, now) = (next, next_level, there);
            residuals.push(now.error);
        }
        let reason = format!("out of balance by {:.1e} on the path", now.error);
        Err(unconverged(form, &reason, &now, settings.iterations))
    }

    /// A point from which to follow the path out of a state where nothing dissipates yet: along the tangent, as far as
    /// the laws dissipate `amount` there.
    pub fn leave<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        from: &Point,
        load: &Affine,
        amount: f64,
        settings: Settings,
    ) -> Result<Point, Unconverged> {
        let now = evaluate(form, laws, &from.x, &load.at(from.level))?;
        self.fill(form, laws, &now, settings);
        let mut direction = load.change.clone();
        if form.factor(&self.tangents) {
            form.solve(&mut direction);
        }
        let at = |change: f64| Point {
            x: from.x.iter().zip(&direction).map(|(x, d)| x + change * d).collect(),
            level: from.level + change,
        };
        let (mut low, mut high, mut change) = (0.0, f64::INFINITY, 1e-3);
        for _ in 0..TRIALS {
            let point = at(change);
            let spent = evaluate(form, laws, &point.x, &load.at(point.level));
            let spent = spent.map_or(f64::INFINITY, |there| dissipated(form, laws, &there));
            if (0.5..2.0).contains(&(spent / amount)) {
                return Ok(point);
            }
            *(if spent < amount { &mut low } else { &mut high }) = change;
            change = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * change };
        }
        Err(unconverged(form, "nothing dissipates along the path", &now, 0))
    }
}

/// Energy dissipated since the last accepted increment.
fn dissipated<L: Respond>(form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> f64 {
    let joints = form.active().iter().zip(&now.memory);
    let of = |(&k, memory): (&usize, &Vec<L::Memory>)| {
        let joint = &form.joints()[k];
        let points = joint.coupling.points.iter().zip(memory);
        points.map(|(p, memory)| joint.thickness() * p.weight * laws.dissipation(memory).0).sum::<f64>()
    };
    joints.map(of).sum()
}

/// Its derivative by the jump coefficients of every active joint.
fn rates<L: Respond>(form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> Vec<Vec<f64>> {
    let joints = form.active().iter().zip(&now.memory);
    let of = |(&k, memory): (&usize, &Vec<L::Memory>)| {
        let rates: Vec<f64> = memory.iter().flat_map(|memory| laws.dissipation(memory).1).copied().collect();
        form.joints()[k].gather(&rates)
    };
    joints.map(of).collect()
}
