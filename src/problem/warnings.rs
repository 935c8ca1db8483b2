//! What the user should know of a joint before believing the result.

use super::plan::Plan;
use super::stiffness::{ROUNDING_SEEN, stiffness_number};
use crate::assembly::{Joint, Model};
use crate::scene::CouplingKind;

/// A gap below this is rounding. Of the length of the joint.
const GAP_SEEN: f64 = 1e-9;

/// The warnings of one joint.
pub(super) fn of_joint(model: &Model, joint: &Joint, plan: &Plan) -> Vec<String> {
    let mut warnings = Vec::new();
    let (name, law) = (&joint.name, &plan.interface.law);
    let coupling = &joint.coupling;
    let segments = coupling.midplane.segments.len();
    let matched = (0..2).all(|side| coupling.edges(side) == segments);
    let number = stiffness_number(model, joint, law);
    if number * f64::EPSILON > ROUNDING_SEEN {
        warnings.push(format!(
            "interface {name}: at K_N h/E = {number:.1e} rounding reaches the tractions; less stiff springs say as much"
        ));
    }
    warnings.extend(law.warnings().into_iter().map(|warning| format!("interface {name}: {warning}")));
    if plan.interface.coupling == CouplingKind::Pointwise && !matched && number > 1.0 {
        warnings.push(format!(
            "interface {name}: \"pointwise\" on unmatched sides at K_N h/E = {number:.1} oscillates; use \"projected\""
        ));
    }
    let [least, most] = coupling.midplane.gap;
    let widest = most.max(-least);
    if coupling.midplane.apart > GAP_SEEN * coupling.midplane.length && plan.interface.initial_gap.is_none() {
        warnings
            .push(format!("interface {name}: the sides are up to {widest:.3e} apart; this is not a stress"));
    }
    warnings
}
