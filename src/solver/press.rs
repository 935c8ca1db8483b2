//! Pressures between the sides as Newton's method sees them: forces on the jump coefficients, and their derivatives.

use faer::Mat;

use super::{Form, Pressures};
use crate::assembly::InterfaceOperator;

/// Takes the pressures off the tractions, and their derivatives off those of the tractions, interface by interface.
pub(super) fn subtract(
    pressures: &Pressures,
    components: usize,
    tractions: &mut [Vec<f64>],
    stiffness: &mut [Vec<f64>],
) {
    for (a, values) in pressures.values.iter().enumerate() {
        for (p, value) in values.iter().enumerate() {
            tractions[a][components * p] -= value;
            let slopes = &pressures.slopes[a][components * p..components * (p + 1)];
            let row = components * components * p;
            stiffness[a][row..row + components].iter_mut().zip(slopes).for_each(|(d, slope)| *d -= slope);
        }
    }
}

/// Forces on the jump coefficients of every active interface per load factor; none where there is no pressure.
pub(super) fn by_load_factor(form: &impl Form, pressures: Option<&Pressures>) -> Option<Vec<Vec<f64>>> {
    let changes = pressures?.by_load_factor.as_ref()?;
    let of = |(&k, change): (&usize, &Vec<f64>)| {
        let interface = &form.interfaces()[k];
        let mut tractions = vec![0.0; interface.coupling.components * interface.coupling.points.len()];
        let normal = tractions.iter_mut().step_by(interface.coupling.components);
        normal.zip(change).for_each(|(traction, change)| *traction = -change);
        interface.gather(&tractions)
    };
    Some(form.active().iter().zip(changes).map(of).collect())
}

/// Change of the residual per load factor, for a change of the target and forces of pressures.
pub(super) fn residual_rate(form: &impl Form, change: &[f64], pressures: Option<&Pressures>) -> Vec<f64> {
    match by_load_factor(form, pressures) {
        Some(forces) => form.residual(&vec![0.0; change.len()], &forces, change),
        None => change.iter().map(|b| -b).collect(),
    }
}

/// Derivative of the forces by the jump coefficients of all active interfaces, for what pressures owe to other points.
pub(super) fn beyond(form: &impl Form, pressures: Option<&Pressures>) -> Option<Mat<f64>> {
    let pressures = pressures.filter(|pressures| !pressures.beyond.is_empty())?;
    let active: Vec<&InterfaceOperator> = form.active().iter().map(|&k| &form.interfaces()[k]).collect();
    let mut first = vec![0];
    active.iter().for_each(|interface| first.push(first[first.len() - 1] + interface.size()));
    let size = first[active.len()];
    let mut matrix = Mat::<f64>::zeros(size, size);
    for slopes in &pressures.beyond {
        let functional = |&(a, p): &(usize, usize)| -> Vec<(usize, f64)> {
            let own = active[a].normal_jump(p).into_iter();
            own.map(|(row, value)| (first[a] + row, value)).collect()
        };
        let functionals: Vec<Vec<(usize, f64)>> = slopes.points.iter().map(functional).collect();
        let areas: Vec<f64> = slopes
            .points
            .iter()
            .map(|&(a, p)| active[a].thickness() * active[a].coupling.points[p].weight)
            .collect();
        let mut forces = vec![0.0; size];
        for (column, into) in functionals.iter().enumerate() {
            forces.fill(0.0);
            for (row, own) in functionals.iter().enumerate() {
                let traction = -slopes.matrix[(row, column)] * areas[row];
                own.iter().for_each(|&(i, value)| forces[i] += value * traction);
            }
            for &(j, value) in into {
                let target = matrix.col_mut(j);
                target.iter_mut().zip(&forces).for_each(|(entry, force)| *entry += value * force);
            }
        }
    }
    Some(matrix)
}
