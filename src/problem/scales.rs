//! Numbers of a softening interface that do not fit each other: told by ratios without units, which a wrong unit puts out by powers
//! of ten.
//!
//! ```text
//! E/f_t            about 1e4 for concrete
//! f_t/k            opening at which the strength is gone, by its steepest softening k
//! E/k              length over which a crack opens, that edges have to resolve
//! ```

use super::PointLaws;
use crate::assembly::{InterfaceOperator, Model};
use crate::error::{Code, Warning};
use crate::law::State;

/// Young's modulus over strength outside of this is hardly a material.
const MODULUS: [f64; 2] = [1.0, 1e8];
/// Edges longer than so many times the length over which a crack opens see it as brittle.
const EDGES: f64 = 3.0;

/// The first ratio of an interface that is out of scale.
pub(super) fn out_of_scale(
    model: &Model,
    interface: &InterfaceOperator,
    laws: &PointLaws,
) -> Option<Warning> {
    let law = laws.at(0);
    let steepest = law.steepest_softening();
    let strength = law.strength(&State { own: law.intact(), ..State::default() })?.tensile_strength;
    if steepest <= 0.0 || strength <= 0.0 {
        return None;
    }
    let young = interface.subdomains.map(|b| model.subdomains[b].elasticity.young);
    let young = young[0].min(young[1]);
    let coupling = &interface.coupling;
    let (name, length) = (&interface.name, coupling.midplane.length);
    let edge = length / coupling.facets(0).max(coupling.facets(1)) as f64;
    let (opening, zone) = (strength / steepest, young / steepest);
    let ratio = young / strength;
    let (what, help) = if !(MODULUS[0]..=MODULUS[1]).contains(&ratio) {
        (
            format!("Young's modulus {young:.3e} is {ratio:.1e} times the tensile strength {strength:.3e}"),
            "for concrete it is about 1e4: are both in the same units?",
        )
    } else if opening > length {
        (
            format!(
                "it opens by {opening:.1e} before its strength is gone, more than its length {length:.3e}"
            ),
            "are fracture energy, strength and coordinates in the same units?",
        )
    } else if edge > EDGES * zone {
        (
            format!(
                "its edges of {edge:.1e} are longer than E G/f_t^2 = {zone:.1e}, over which a crack opens"
            ),
            "finer edges, or what cracks does so at once; are coordinates and energies in the same units?",
        )
    } else {
        return None;
    };
    Some(Warning::new(Code::OutOfScale, format!("interface {name}: {what}"), help))
}
