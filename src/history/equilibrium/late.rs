//! Points of softening laws that crack in a part after others, and the first that does.

use super::ON;
use super::laws::{Laws, OldStates};
use super::view::{ViewMut, target};
use crate::history::converged::Converged;
use crate::history::loading::StepLoad;
use crate::law::local;
use crate::problem::Problem;
use crate::solver::{Form, NewtonSettings, along, ask};

/// Intact points of softening laws that crack in a part after others do; none if all crack at once.
pub(super) fn late(problem: &Problem, old: OldStates, found: &Converged) -> Option<Vec<Vec<bool>>> {
    let mut fractions: Vec<Vec<f64>> = old.states.iter().map(|states| vec![f64::NAN; states.len()]).collect();
    let mut first = 1.0_f64;
    for of in &found.interfaces {
        let laws = &problem.interfaces[of.interface].laws;
        for (p, (old, new)) in old.states[of.interface].iter().zip(&of.memory).enumerate() {
            if new.dissipation > 0.0
                && let Some(fraction) = laws.at(p).onset_or_on(new.state.jump, old)
            {
                fractions[of.interface][p] = fraction;
                first = first.min(fraction);
            }
        }
    }
    let late = |fraction: &f64| *fraction > first + ON;
    let any = fractions.iter().flatten().any(late);
    any.then(|| fractions.iter().map(|of| of.iter().map(late).collect()).collect())
}

/// True if points that crack late in what was found last would do so if they were held: then small parts lead there too.
/// They are held elastic, the equilibrium is corrected once, and some of them must be beyond its strength.
pub(super) fn crack<F: Form>(
    view: &mut ViewMut<F>,
    old: OldStates,
    found: &Converged,
    end: &StepLoad,
    settings: NewtonSettings,
) -> Option<bool> {
    let problem = view.problem;
    let Some(intact) = late(problem, old, found) else { return Some(true) };
    let target = target(&*view.form, view.prepared, end).ok()?;
    let laws = Laws { intact: Some(&intact), ..Laws::alone(problem, old, f64::INFINITY, end.at()) };
    let (form, newton) = (&mut *view.form, &mut *view.newton);
    let here = ask(form, &laws, view.found).ok()?;
    let residual = form.residual(view.found, &here.forces, &target);
    let change: Vec<f64> = residual.iter().map(|r| -r).collect();
    let there = along(newton, form, &laws, view.found, (&target, &change), 0.0, settings).ok()?;
    for (&k, coefficients) in form.active().iter().zip(form.coefficients(&there)) {
        let jumps = form.interfaces()[k].jumps_of(&coefficients);
        let points = jumps.chunks_exact(problem.model.components).zip(&old.states[k]).zip(&intact[k]);
        for (p, ((jump, state), intact)) in points.enumerate() {
            let jump = old.presence.counted(k, p, local(jump));
            if *intact && problem.interfaces[k].laws.at(p).onset(jump, state).is_some() {
                return Some(true);
            }
        }
    }
    Some(false)
}

/// Fraction of the way to a load at which the first intact point reaches its surface, on the way to `end` or along
/// the tangent.
pub(super) fn first_onset<F: Form>(
    view: &mut ViewMut<F>,
    old: OldStates,
    [load, now]: [&StepLoad; 2],
    end: Option<Vec<f64>>,
    settings: NewtonSettings,
) -> Option<f64> {
    let target_of = |load| target(&*view.form, view.prepared, load).ok();
    let (target, before) = (target_of(load)?, target_of(now)?);
    let problem = view.problem;
    let laws = Laws::alone(problem, old, f64::INFINITY, now.at());
    let (form, newton) = (&mut *view.form, &mut *view.newton);
    let end = match end {
        Some(end) => end,
        None => {
            let change: Vec<f64> = target.iter().zip(&before).map(|(b, a)| b - a).collect();
            let advance = load.load_factor - now.load_factor;
            along(newton, form, &laws, view.unknowns, (&before, &change), advance, settings).ok()?
        }
    };
    let mut first = 1.0_f64;
    for (&k, coefficients) in form.active().iter().zip(form.coefficients(&end)) {
        if old.presence.is_absent(k) {
            continue;
        }
        let jumps = form.interfaces()[k].jumps_of(&coefficients);
        for (p, (jump, state)) in jumps.chunks_exact(problem.model.components).zip(&old.states[k]).enumerate()
        {
            let jump = old.presence.counted(k, p, local(jump));
            let fraction = problem.interfaces[k].laws.at(p).onset(jump, state);
            first = fraction.filter(|fraction| *fraction > ON).map_or(first, |fraction| first.min(fraction));
        }
    }
    (first < 1.0).then_some(first)
}
