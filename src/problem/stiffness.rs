//! The stiffness number K_N h/E of a joint: what its springs are against the continuum beside them.

use super::plan::Plan;
use crate::assembly::{Joint, Model};
use crate::error::Result;
use crate::law::Law;
use crate::scene::Scene;

/// K_N h/E times the machine's ε from which rounding is seen in the tractions.
pub(super) const ROUNDING_SEEN: f64 = 1e-6;
/// The same from which nothing else is left.
const ROUNDING_RULES: f64 = 1e-3;

/// K_N h/E of a joint: the larger of the two edges meeting, the smaller E, maximum along the joint.
pub fn stiffness_number(model: &Model, joint: &Joint, law: &Law) -> f64 {
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
    law.elastic_stiffness()[0] * numbers.fold(0.0, f64::max)
}

/// A stiffness whose springs are nothing but rounding is refused.
pub(super) fn refuse_beyond_precision(
    scene: &Scene,
    model: &Model,
    joint: &Joint,
    plan: &Plan,
) -> Result<()> {
    let law = &plan.interface.law;
    let number = stiffness_number(model, joint, law);
    if number * f64::EPSILON <= ROUNDING_RULES {
        return Ok(());
    }
    let [kn, _] = law.elastic_stiffness();
    let largest = kn * ROUNDING_SEEN / (number * f64::EPSILON);
    let what = format!("K_N h/E = {number:.1e} is beyond double precision");
    let cure = format!("take {largest:.0e} or less: stiffer springs change nothing but the rounding");
    Err(scene.source.refuse(&["interfaces", plan.entry, "law", "normal_stiffness"], what, cure))
}
