//! Water as Newton's method asks it: pressures of interfaces where these depend on the jumps. All others are loads.

use crate::history::converged::PointResponse;
use crate::law::local;
use crate::output::Presence;
use crate::problem::{Problem, StepWater, WaterPoint};
use crate::solver::{PressureSlopes, Pressures};

/// Pressures at the law points of the active interfaces, which keep theirs.
pub(super) fn press(
    problem: &Problem,
    presence: &Presence,
    (water, load_factor): (&StepWater, f64),
    active: &[usize],
    jumps: &[Vec<f64>],
    memory: &mut [Vec<PointResponse>],
    by_load_factor: bool,
) -> Result<Pressures, String> {
    let c = problem.model.components;
    let mut place = vec![None; problem.interfaces.len()];
    let coupled = active.iter().enumerate().filter(|(_, k)| problem.interfaces[**k].coupled_pressure);
    coupled.for_each(|(a, &k)| place[k] = Some(a));
    let point = |k: usize, p: usize| -> WaterPoint {
        let Some(a) = place[k] else { return WaterPoint::default() };
        let own = &memory[a][p];
        let jump = presence.counted(k, p, local(&jumps[a][c * p..c * (p + 1)]));
        let damage = problem.interfaces[k].laws.at(p).damage(&own.state).unwrap_or(0.0);
        WaterPoint { jump, damage, damage_gradient: own.damage_gradient }
    };
    let answer = water.answer(&problem.model, load_factor, &point, true)?;
    // along a path of the load nothing follows a formula: pressures are affine in the load factor
    let by_load_factor = match by_load_factor {
        true => {
            let at = |load_factor: f64| water.answer(&problem.model, load_factor, &point, false);
            let [start, end] = [at(0.0)?, at(1.0)?];
            let change = |&k: &usize| -> Vec<f64> {
                let both = start.fields.pressures[k].iter().zip(&end.fields.pressures[k]);
                if place[k].is_some() { both.map(|(start, end)| end - start).collect() } else { Vec::new() }
            };
            Some(active.iter().map(change).collect())
        }
        false => None,
    };
    let mut pressures = Pressures { by_load_factor, ..Pressures::default() };
    for (a, &k) in active.iter().enumerate() {
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        if place[k].is_some() {
            values.clone_from(&answer.fields.pressures[k]);
            slopes.extend(answer.slopes[k].iter().flat_map(|slope| slope.as_slice()[..c].to_vec()));
            memory[a].iter_mut().zip(&values).for_each(|(own, value)| own.pressure = *value);
        }
        pressures.values.push(values);
        pressures.slopes.push(slopes);
    }
    for own in answer.flow_slopes {
        let points = own.points.iter().filter_map(|&(k, p)| place[k].map(|a| (a, p))).collect();
        pressures.beyond.push(PressureSlopes { points, matrix: own.slopes.matrix });
    }
    Ok(pressures)
}
