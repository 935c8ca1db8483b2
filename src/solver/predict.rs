//! Predictions from the tangent: where a change of the load leads, and where the path goes on.

use super::constraint::dissipated;
use super::evaluation::{Evaluation, evaluate, evaluate_at, unconverged};
use super::press::{by_load_factor, residual_rate};
use super::{Affine, Form, Iterate, Newton, NewtonSettings, PathPoint, Respond, Unconverged};

/// Most trials on the way from an intact state to one that dissipates enough.
const TRIALS: usize = 60;

/// The unknowns that the tangent leads to by a change of the target and of the load factor.
pub fn along<L: Respond>(
    newton: &mut Newton,
    form: &mut impl Form,
    laws: &L,
    x: &[f64],
    (target, change): (&[f64], &[f64]),
    advance: f64,
    settings: NewtonSettings,
) -> Result<Vec<f64>, Unconverged> {
    let now = evaluate_at(form, laws, x, target, advance != 0.0)?;
    newton.fill(form, laws, &now, settings);
    let mut step = change.to_vec();
    if let Some(forces) = by_load_factor(form, now.pressures.as_ref()) {
        let none = vec![0.0; x.len()];
        let pushed = form.residual(&none, &forces, &none);
        step.iter_mut().zip(pushed).for_each(|(step, pushed)| *step -= advance * pushed);
    }
    if form.factor(&newton.tangents) {
        form.solve(&mut step);
    }
    Ok(x.iter().zip(&step).map(|(x, d)| x + d).collect())
}

/// Evaluations at some unknowns and load factor, and at those corrected by the factor at hand; with a change of the target also by
/// as much of it as keeps the correction across a way.
pub fn corrected<L: Respond>(
    form: &impl Form,
    laws: &L,
    PathPoint { x, load_factor }: &PathPoint,
    target: &[f64],
    across: Option<(Vec<f64>, Vec<f64>)>,
) -> Result<[Iterate<L::Memory>; 2], Unconverged> {
    let here = evaluate_at(form, laws, x, target, across.is_some())?;
    let mut correction = here.residual.clone();
    form.solve(&mut correction);
    let (mut target, mut laws) = (target.to_vec(), *laws);
    if let Some((change, way)) = across {
        let mut along: Vec<f64> =
            residual_rate(form, &change, here.pressures.as_ref()).into_iter().map(|rate| -rate).collect();
        form.solve(&mut along);
        let dot = |a: &[f64]| a.iter().zip(&way).map(|(a, b)| a * b).sum::<f64>();
        let more = dot(&correction) / dot(&along);
        if more.is_finite() {
            correction.iter_mut().zip(&along).for_each(|(d, z)| *d -= more * z);
            target.iter_mut().zip(&change).for_each(|(b, change)| *b += more * change);
            laws = laws.at(load_factor + more);
        }
    }
    let next: Vec<f64> = x.iter().zip(&correction).map(|(x, d)| x - d).collect();
    let there = evaluate(form, &laws, &next, &target)?;
    Ok([here.into_iterate(x.clone()), there.into_iterate(next)])
}

/// A point from which to follow the path out of a state where nothing dissipates yet: along the tangent, as far as
/// the laws dissipate `amount` there.
pub fn leave<L: Respond>(
    newton: &mut Newton,
    form: &mut impl Form,
    laws: &L,
    from: &PathPoint,
    load: &Affine,
    amount: f64,
    settings: NewtonSettings,
) -> Result<PathPoint, Unconverged> {
    let (now, direction) = tangent(newton, form, laws, from, load, settings)?;
    let at = |change: f64| moved(from, &direction, change);
    let (mut low, mut high, mut change) = (0.0, f64::INFINITY, 1e-3);
    for _ in 0..TRIALS {
        let point = at(change);
        let spent = evaluate(form, &laws.at(point.load_factor), &point.x, &load.at(point.load_factor));
        let spent = spent.map_or(f64::INFINITY, |there| dissipated(form, laws, &there));
        if (0.5..2.0).contains(&(spent / amount)) {
            return Ok(point);
        }
        *(if spent < amount { &mut low } else { &mut high }) = change;
        change = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * change };
    }
    Err(unconverged(form, "nothing dissipates along the path", &now, 0))
}

/// The point that the tangent leads to by a change of the load factor.
pub fn ahead<L: Respond>(
    newton: &mut Newton,
    form: &mut impl Form,
    laws: &L,
    from: &PathPoint,
    load: &Affine,
    change: f64,
    settings: NewtonSettings,
) -> Result<PathPoint, Unconverged> {
    let (_, direction) = tangent(newton, form, laws, from, load, settings)?;
    Ok(moved(from, &direction, change))
}

/// Evaluation at a point, and −J⁻¹ ∂R/∂λ there.
fn tangent<L: Respond>(
    newton: &mut Newton,
    form: &mut impl Form,
    laws: &L,
    from: &PathPoint,
    load: &Affine,
    settings: NewtonSettings,
) -> Result<(Evaluation<L::Memory>, Vec<f64>), Unconverged> {
    let now = evaluate_at(form, &laws.at(from.load_factor), &from.x, &load.at(from.load_factor), true)?;
    newton.fill(form, laws, &now, settings);
    let mut direction: Vec<f64> =
        residual_rate(form, &load.change, now.pressures.as_ref()).into_iter().map(|rate| -rate).collect();
    if form.factor(&newton.tangents) {
        form.solve(&mut direction);
    }
    Ok((now, direction))
}

fn moved(from: &PathPoint, direction: &[f64], change: f64) -> PathPoint {
    let x = from.x.iter().zip(direction).map(|(x, d)| x + change * d).collect();
    PathPoint { x, load_factor: from.load_factor + change }
}
