//! The stiffness number K_N h/E of a joint: what its springs are against the continuum beside them.

use super::curve::PlannedInterface;
use crate::assembly::{Joint, Model};
use crate::error::Result;
use crate::law::Law;
use crate::scene::{CouplingKind, Interface, Scene, Strategy};

/// K_N h/E times the machine's ε from which rounding is seen in the tractions.
pub(super) const ROUNDING_SEEN: f64 = 1e-6;
/// The same from which nothing else is left.
const ROUNDING_RULES: f64 = 1e-3;
/// K_N h/E from which the jump of an elastic joint is an unknown of its own, not a difference of displacements.
const STIFF: f64 = 1e3;
/// K_N h/E up to which its products with other numbers of a model can be represented.
const REPRESENTED: f64 = 1e100;

/// K_N h/E of a joint: the larger of the two edges meeting, the smaller E, maximum along the joint.
pub fn stiffness_number(model: &Model, joint: &Joint, law: &Law) -> f64 {
    law.elastic_stiffness()[0] * compliance(model, joint)
}

/// h/E, the largest along a joint.
pub(super) fn compliance(model: &Model, joint: &Joint) -> f64 {
    let coupling = &joint.coupling;
    let young = |side: usize, e: usize| {
        let node = coupling.nodes(side, e)[0];
        let body = model.bodies.partition_point(|body| body.first_node <= node) - 1;
        model.bodies[body].elasticity.young
    };
    let numbers = coupling.shares().into_iter().map(|share| {
        let [a, b] = share.edges;
        coupling.chord(0, a).max(coupling.chord(1, b)) / young(0, a).min(young(1, b))
    });
    numbers.fold(0.0, f64::max)
}

/// True if a joint is solved for its jump when it is stiff: then the rounding of displacements does not reach its
/// tractions.
pub(super) fn jump_is_unknown(scene: &Scene, interface: &Interface) -> bool {
    let elastic = matches!(interface.law, Law::Elastic(_));
    let projected = interface.coupling == CouplingKind::Projected;
    elastic && projected && scene.solution.strategy != Strategy::Plain
}

/// True if a joint is solved for its jump and is so stiff, in any direction, that this is worth it.
pub(super) fn is_stiff(scene: &Scene, interface: &Interface, model: &Model, joint: &Joint) -> bool {
    let [kn, kt] = interface.law.elastic_stiffness();
    jump_is_unknown(scene, interface) && kn.max(kt) * compliance(model, joint) > STIFF
}

/// A stiffness whose springs are nothing but rounding is refused.
pub(super) fn refuse_beyond_precision(
    scene: &Scene,
    model: &Model,
    joint: &Joint,
    plan: &PlannedInterface,
) -> Result<()> {
    let law = &plan.interface.law;
    let number = stiffness_number(model, joint, law);
    let most =
        if jump_is_unknown(scene, plan.interface) { REPRESENTED } else { ROUNDING_RULES / f64::EPSILON };
    if number <= most {
        return Ok(());
    }
    let [kn, _] = law.elastic_stiffness();
    let largest = kn * ROUNDING_SEEN / (number * f64::EPSILON);
    let what = format!("K_N h/E = {number:.1e} is beyond double precision");
    let cure = format!("take {largest:.0e} or less: stiffer springs change nothing but the rounding");
    Err(scene.source.refuse(&["interfaces", plan.entry, "law", "normal_stiffness"], what, cure))
}
