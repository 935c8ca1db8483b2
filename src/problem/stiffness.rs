//! The stiffness number K_N h/E of an interface: what its springs are against the continuum beside them.

use super::PointLaws;
use super::curve::PlannedInterface;
use crate::assembly::{InterfaceOperator, Model};
use crate::error::Result;
use crate::law::N;
use crate::scene::{CouplingKind, Interface, Scene, Strategy};

/// K_N h/E times the machine's ε from which rounding is seen in the tractions.
pub(super) const ROUNDING_SEEN: f64 = 1e-6;
/// The same from which nothing else is left.
const ROUNDING_RULES: f64 = 1e-3;
/// K_N h/E from which the jump of an elastic interface is an unknown of its own, not a difference of displacements.
const STIFF: f64 = 1e3;
/// K_N h/E up to which its products with other numbers of a model can be represented.
const REPRESENTED: f64 = 1e100;

/// K_N h/E of an interface: the larger of the two edges meeting, the smaller E, maximum along the interface.
pub fn stiffness_number(model: &Model, interface: &InterfaceOperator, laws: &PointLaws) -> f64 {
    laws.stiffest()[N] * compliance(model, interface)
}

/// h/E, the largest along an interface.
pub(super) fn compliance(model: &Model, interface: &InterfaceOperator) -> f64 {
    let coupling = &interface.coupling;
    let young = |side: usize, e: usize| {
        let node = coupling.nodes(side, e)[0];
        let subdomain = model.subdomains.partition_point(|subdomain| subdomain.first_node <= node) - 1;
        model.subdomains[subdomain].elasticity.young
    };
    let numbers = coupling.midplane.segments.iter().map(|share| {
        let [a, b] = share.facets;
        coupling.chord(0, a).max(coupling.chord(1, b)) / young(0, a).min(young(1, b))
    });
    numbers.fold(0.0, f64::max)
}

/// True if an interface is solved for its jump when it is stiff: then the rounding of displacements does not reach its
/// tractions.
pub(super) fn jump_is_unknown(scene: &Scene, stated: &Interface) -> bool {
    let elastic = stated.law.kind().is_linear();
    let projected = stated.coupling == CouplingKind::Projected;
    elastic && projected && scene.solution.strategy != Strategy::Plain
}

/// True if an interface is solved for its jump and is so stiff, in any direction, that this is worth it.
pub(super) fn is_stiff(
    scene: &Scene,
    stated: &Interface,
    model: &Model,
    interface: &InterfaceOperator,
    laws: &PointLaws,
) -> bool {
    let [kn, kt, _] = laws.stiffest();
    jump_is_unknown(scene, stated) && kn.max(kt) * compliance(model, interface) > STIFF
}

/// A stiffness whose springs are nothing but rounding is refused.
pub(super) fn check_precision(
    scene: &Scene,
    model: &Model,
    interface: &InterfaceOperator,
    plan: &PlannedInterface,
    laws: &PointLaws,
) -> Result<()> {
    let number = stiffness_number(model, interface, laws);
    let most = if jump_is_unknown(scene, plan.stated) { REPRESENTED } else { ROUNDING_RULES / f64::EPSILON };
    if number <= most {
        return Ok(());
    }
    let [kn, ..] = laws.stiffest();
    let largest = kn * ROUNDING_SEEN / (number * f64::EPSILON);
    let what = format!("K_N h/E = {number:.1e} is beyond double precision");
    let help = format!("take {largest:.0e} or less: stiffer springs change nothing but the rounding");
    Err(scene.source.error_at(&["interfaces", plan.entry, "law", "normal_stiffness"], what, help))
}
