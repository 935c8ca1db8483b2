//! Path following: the load level λ is one more unknown, and how far an increment goes is one more equation, so that the
//! path is followed through limit and turning points.
//!
//! ```text
//! R(x) = A(x) − b₀ − λ b₁ = 0          ⎡ J   −b₁ ⎤ ⎡δx⎤   ⎡−R⎤
//! g(x) = 0                             ⎣ cᵀ    0 ⎦ ⎣δλ⎦ = ⎣−g⎦      c = ∂g/∂x
//!
//! g = Σ h w ΔD(r) / Δτ − 1             the energy that the joints dissipate: it never decreases
//! g = Σ h w p·Δr / Σ h w p·p − 1       the change of the jumps along a predicted one p: a plane across the path
//! ```
//!
//! Two solves with one factor: δλ = (c·y − g) / (c·z), δx = δλ z − y with y = J⁻¹ R and z = J⁻¹ b₁. The sum of the laws' own
//! dissipation is taken: formulas from energies hold for joints that unload to their origin, ours unload elastically.

use super::evaluation::{Evaluation, evaluate, unconverged};
use super::newton::STALLED;
use super::{Form, Iterate, Newton, NewtonSettings, Respond, Unconverged};

/// The constraint is met to this: it says how far to go, not where the path is.
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

/// How far an increment goes.
#[derive(Debug, Clone)]
pub enum Constraint {
    /// As far as it dissipates this energy.
    Dissipate(f64),
    /// From the jumps of every active joint by a change of them, or what is across it.
    Move {
        /// The jumps.
        from: Vec<Vec<f64>>,
        /// Their change.
        by: Vec<Vec<f64>>,
    },
}

impl Constraint {
    /// By the change of the jumps between two sets of unknowns.
    pub fn between(form: &impl Form, from: &[f64], to: &[f64]) -> Constraint {
        let jumps = |x: &[f64]| -> Vec<Vec<f64>> {
            let of = |(&k, a): (&usize, Vec<f64>)| form.joints()[k].jumps_of(&a);
            form.active().iter().zip(form.coefficients(x)).map(of).collect()
        };
        let (from, mut by) = (jumps(from), jumps(to));
        by.iter_mut().flatten().zip(from.iter().flatten()).for_each(|(by, from)| *by -= from);
        Constraint::Move { from, by }
    }

    /// g.
    fn missing<L: Respond>(&self, form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> f64 {
        match self {
            Constraint::Dissipate(amount) => dissipated(form, laws, now) / amount - 1.0,
            Constraint::Move { from, by } => {
                let moved = (now.jumps.iter().zip(from))
                    .map(|(now, from)| now.iter().zip(from).map(|(now, from)| now - from).collect())
                    .collect::<Vec<Vec<f64>>>();
                product(form, by, &moved) / product(form, by, by) - 1.0
            }
        }
    }

    /// Its derivative by the jump coefficients of every active joint.
    fn slope<L: Respond>(&self, form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> Vec<Vec<f64>> {
        let (mut slope, amount) = match self {
            Constraint::Dissipate(amount) => (rates(form, laws, now), *amount),
            Constraint::Move { by, .. } => {
                let of = |(&k, by): (&usize, &Vec<f64>)| form.joints()[k].gather(by);
                (form.active().iter().zip(by).map(of).collect(), product(form, by, by))
            }
        };
        slope.iter_mut().flatten().for_each(|value| *value /= amount);
        slope
    }
}

/// Where a search stands: unknowns and load level.
#[derive(Debug, Clone)]
pub struct PathPoint {
    /// The unknowns of the form.
    pub x: Vec<f64>,
    /// Load level.
    pub level: f64,
}

impl Newton {
    /// The equilibrium as far from the last accepted one as a constraint says, sought from a point.
    pub fn follow<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        start: PathPoint,
        load: &Affine,
        constraint: &Constraint,
        settings: NewtonSettings,
    ) -> Result<(Iterate<L::Memory>, f64), Unconverged> {
        let PathPoint { mut x, mut level } = start;
        let mut now = evaluate(form, laws, &x, &load.at(level))?;
        let mut residuals = vec![now.error];
        for iterations in 0..=settings.iterations {
            let missing = constraint.missing(form, laws, &now);
            let stalled = iterations > 0 && residuals[iterations] > STALLED * residuals[iterations - 1];
            let rounded = || self.rounding(form, laws, &x, &now, &load.at(level));
            let balanced = now.error <= settings.tolerance || stalled && now.error <= rounded();
            if iterations > 0 && balanced && missing.abs() <= MET {
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
            let c = form.weights(&constraint.slope(form, laws, &now));
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let change = (dot(&c, &y) - missing) / dot(&c, &z);
            let correction: Vec<f64> = y.iter().zip(&z).map(|(y, z)| change * z - y).collect();
            if !(change.is_finite() && correction.iter().all(|value| value.is_finite())) {
                return Err(unconverged(form, "the path is singular", &now, iterations));
            }
            let (mut step, mut best) = (1.0, None::<(f64, Vec<f64>, f64, Evaluation<L::Memory>)>);
            let merit = |error: f64, missing: f64| error.max(settings.tolerance).hypot(missing);
            let before = merit(now.error, missing);
            for _ in 0..=HALVINGS {
                let next: Vec<f64> = x.iter().zip(&correction).map(|(x, d)| x + step * d).collect();
                let next_level = level + step * change;
                if let Ok(there) = evaluate(form, laws, &next, &load.at(next_level)) {
                    let value = merit(there.error, constraint.missing(form, laws, &there));
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
        from: &PathPoint,
        load: &Affine,
        amount: f64,
        settings: NewtonSettings,
    ) -> Result<PathPoint, Unconverged> {
        let (now, direction) = self.tangent(form, laws, from, load, settings)?;
        let at = |change: f64| from.moved(&direction, change);
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

    /// The point that the tangent leads to by a change of the load level.
    pub fn ahead<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        from: &PathPoint,
        load: &Affine,
        change: f64,
        settings: NewtonSettings,
    ) -> Result<PathPoint, Unconverged> {
        let (_, direction) = self.tangent(form, laws, from, load, settings)?;
        Ok(from.moved(&direction, change))
    }

    /// What the laws say at a point, and J⁻¹ b₁ there.
    fn tangent<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        from: &PathPoint,
        load: &Affine,
        settings: NewtonSettings,
    ) -> Result<(Evaluation<L::Memory>, Vec<f64>), Unconverged> {
        let now = evaluate(form, laws, &from.x, &load.at(from.level))?;
        self.fill(form, laws, &now, settings);
        let mut direction = load.change.clone();
        if form.factor(&self.tangents) {
            form.solve(&mut direction);
        }
        Ok((now, direction))
    }
}

impl PathPoint {
    fn moved(&self, direction: &[f64], change: f64) -> PathPoint {
        let x = self.x.iter().zip(direction).map(|(x, d)| x + change * d).collect();
        PathPoint { x, level: self.level + change }
    }
}

/// Σ h w a·b of two sets of values at the law points.
fn product(form: &impl Form, a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let of = |((&k, a), b): ((&usize, &Vec<f64>), &Vec<f64>)| {
        let joint = &form.joints()[k];
        let components = joint.coupling.components;
        let at = |(p, (a, b)): (usize, (&f64, &f64))| joint.coupling.points[p / components].weight * a * b;
        joint.thickness() * a.iter().zip(b).enumerate().map(at).sum::<f64>()
    };
    form.active().iter().zip(a).zip(b).map(of).sum()
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
