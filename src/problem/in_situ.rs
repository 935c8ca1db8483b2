//! State in situ, before the first load: tractions of interfaces, and the loads in equilibrium with them and the initial stress.
//!
//! ```text
//! t₀ = σ n, σ the mean of both sides        f = ∫ Bᵀ σ₀ + Gᵀ t₀: the first step ramps from it to its loads, not from nothing
//! ```

use super::curve::PlannedInterface;
use super::ground::{StressAt, tractions};
use super::point_laws::{place, shown};
use super::{BoundInterface, Prestress, prestress};
use crate::assembly::Model;
use crate::error::{Code, Result, Warning};
use crate::law::Local;
use crate::scene::Scene;
use std::sync::Arc;

/// Tractions of both sides that differ by less, of the largest, differ by rounding.
const ALIKE: f64 = 1e-6;
/// Forces out of balance below this part of the weight are rounding.
const BALANCED: f64 = 1e-6;

/// Warnings of interfaces whose sides do not agree, or not with what the scene states there.
pub(super) fn disagreements(
    scene: &Scene,
    model: &Model,
    interfaces: &[BoundInterface],
    plans: &[PlannedInterface],
    stresses: &[Option<StressAt>],
) -> Result<Vec<Warning>> {
    let (mut warnings, there) = (Vec::new(), scene.there_at_first()?);
    for ((operator, bound), plan) in model.interfaces.iter().zip(interfaces).zip(plans) {
        if operator.subdomains.iter().any(|&b| !there[b]) {
            continue;
        }
        let Some(sides) = tractions(stresses, operator)? else { continue };
        let largest = sides.iter().flatten().map(|t| t.amax()).fold(0.0, f64::max);
        let mut tell = |size: &dyn Fn(usize) -> f64, what: &str, help: &str| {
            let sizes = (0..sides.len()).map(size);
            let worst = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((at, size)) = worst.filter(|(_, size)| *size > ALIKE * largest) {
                let what = format!("{what} by {size:.3e} at {}", shown(&place(operator, at)));
                let told = Warning::new(Code::InitialStress, what, help);
                warnings.push(told.of(&format!("interface {}", operator.name)));
            }
        };
        tell(
            &|p| (sides[p][0] - sides[p][1]).amax(),
            "the initial stresses of its sides differ",
            "its traction is that of their mean: give both sides the stress that the joint carries",
        );
        if plan.stated.initial_traction.iter().any(|value| !value.is_zero()) {
            tell(
                &|p| (bound.initial.at(p) - 0.5 * (sides[p][0] + sides[p][1])).amax(),
                "its initial_traction differs from the initial stress",
                "leave it out: it follows from the stress",
            );
        }
    }
    Ok(warnings)
}

/// Loads that hold initial stresses and the tractions of all interfaces as they are [force].
pub(super) fn holding(
    model: &Model,
    interfaces: &[BoundInterface],
    all: &[Option<Arc<Prestress>>],
) -> Option<Vec<f64>> {
    let mut force = prestress::forces(model, all, 0.0)?;
    for (operator, bound) in model.interfaces.iter().zip(interfaces) {
        let leading = |v: Local| <[f64; 3]>::from(v).into_iter().take(model.components);
        let at = |p: usize| bound.states.get(p).map_or(bound.initial.at(p), |state| state.traction);
        let tractions: Vec<f64> = (0..operator.coupling.points.len()).flat_map(|p| leading(at(p))).collect();
        operator.add_force(&tractions, &mut force);
    }
    Some(force)
}

/// Warning of initial stresses that the loads of the first step do not hold; `weight`: that of its gravity.
pub(super) fn imbalance(
    scene: &Scene,
    holding: &[f64],
    loads: &[f64],
    constrained: &[bool],
    weight: f64,
) -> Option<Warning> {
    let free = (0..loads.len()).filter(|&dof| !constrained[dof]);
    let rest: f64 = free.map(|dof| (loads[dof] - holding[dof]).abs()).sum();
    let of = if weight > 0.0 { weight } else { holding.iter().map(|force| force.abs()).sum() };
    (rest > BALANCED * of).then(|| {
        let whole = if weight > 0.0 { "weight" } else { "forces that hold it" };
        let what = format!(
            "{}: the loads of the first step do not hold the initial stress: {:.3e} % of the {whole} are out of balance",
            scene.source.at(&["steps", "0"]),
            100.0 * rest / of
        );
        let help = "state its gravity and its pressures in the first step; what is left moves the model in that step";
        Warning::new(Code::NotAtRest, what, help)
    })
}
