//! Warnings of interfaces.

use super::PointLaws;
use super::curve::PlannedInterface;
use super::scales::out_of_scale;
use super::stiffness::{ROUNDING_SEEN, jump_is_unknown, stiffness_number};
use crate::assembly::{BoundSubdomain, InterfaceOperator, Model};
use crate::error::{Code, Warning};
use crate::scene::{CouplingKind, Scene};

/// A gap below this is rounding. Of the length of the interface.
const GAP_SEEN: f64 = 1e-9;
/// Coordinates that resolve no finer than this reach the tractions. Of the smallest edge.
const RESOLVED: f64 = 1e-10;
/// Cells with a lower scaled Jacobian are bad (Verdict accepts quadrilaterals from here).
const BAD: f64 = 0.3;
/// Linear elements lock in plane strain from this Poisson's ratio on.
const LOCKING: f64 = 0.49;

/// The warnings of one interface.
pub(super) fn of_interface(
    scene: &Scene,
    model: &Model,
    interface: &InterfaceOperator,
    plan: &PlannedInterface,
    laws: &PointLaws,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let name = &interface.name;
    let coupling = &interface.coupling;
    let segments = coupling.midplane.segments.len();
    let matched = (0..2).all(|side| coupling.facets(side) == segments);
    let number = stiffness_number(model, interface, laws);
    if number * f64::EPSILON > ROUNDING_SEEN && !jump_is_unknown(scene, plan.stated) {
        let what = format!("interface {name}: at K_N h/E = {number:.1e} rounding reaches the tractions");
        warnings.push(Warning::new(Code::Rounding, what, "less stiff springs say as much"));
    }
    // laws that vary may each have doubts of their own: the first of a kind is told
    for warning in laws.all().iter().flat_map(|law| law.warnings()) {
        if !warnings.iter().any(|told: &Warning| told.code == warning.code) {
            warnings.push(warning.of(&format!("interface {name}")));
        }
    }
    if plan.stated.coupling == CouplingKind::Pointwise && !matched && number > 1.0 {
        let what =
            format!("interface {name}: \"pointwise\" on unmatched sides at K_N h/E = {number:.1} oscillates");
        warnings.push(Warning::new(Code::Oscillation, what, "use \"projected\""));
    }
    let [least, most] = coupling.midplane.gap;
    let widest = most.max(-least);
    if coupling.midplane.apart > GAP_SEEN * coupling.midplane.length && plan.stated.initial_gap.is_none() {
        let what = format!("interface {name}: the sides are up to {widest:.3e} apart");
        let help = "this is not a stress: draw them on one line, or give \"initial_gap\" if it is meant";
        warnings.push(Warning::new(Code::Apart, what, help));
    }
    warnings.extend(far_away(interface));
    warnings.extend(out_of_scale(model, interface, laws));
    for curve in plan.sides.iter().flatten() {
        let subdomain = &model.subdomains[curve.subdomain];
        let mut cells: Vec<usize> = curve.edges.iter().map(|edge| edge.cell).collect();
        cells.sort_unstable();
        cells.dedup();
        let bad: Vec<(f64, usize)> = cells
            .iter()
            .map(|&cell| (subdomain.mesh.quality(cell), cell))
            .filter(|(quality, _)| *quality < BAD)
            .collect();
        if let Some((worst, cell)) = bad.iter().min_by(|p, q| p.0.total_cmp(&q.0)) {
            let [x, y, _] = subdomain.mesh.points[subdomain.mesh.cells.nodes(*cell)[0]];
            let what = format!(
                "interface {name}: {} of {} cells of {} beside it have a scaled Jacobian below {BAD}, the worst {worst:.2} near ({x:.4}, {y:.4})",
                bad.len(),
                cells.len(),
                subdomain.name
            );
            let help = "stresses there mean little: mesh it with better angles";
            warnings.push(Warning::new(Code::BadCells, what, help));
        }
    }
    warnings
}

/// Bodies in plane strain whose elements lock: their volume cannot change, and linear elements know no other way to deform.
pub(super) fn locking(subdomains: &[BoundSubdomain]) -> Vec<Warning> {
    let locks = |subdomain: &&BoundSubdomain| {
        subdomain.elasticity.out_of_plane > LOCKING
            && subdomain.mesh.cells.shapes.iter().any(|s| !s.is_quadratic())
    };
    let told = subdomains.iter().filter(locks).map(|subdomain| {
        let nu = subdomain.elasticity.out_of_plane; // ν in plane strain, zero in plane stress
        let what = format!("subdomain {}: linear elements lock at a Poisson's ratio of {nu}", subdomain.name);
        Warning::new(Code::Locking, what, "use T6 or Q8: Mesh.ElementOrder = 2 in the .geo")
    });
    told.collect()
}

/// An interface so far from the origin, for its edges, that rounding of its coordinates is seen.
fn far_away(interface: &InterfaceOperator) -> Option<Warning> {
    let (mut farthest, mut smallest) = (0.0_f64, f64::INFINITY);
    let coupling = &interface.coupling;
    for side in 0..2 {
        for e in 0..coupling.facets(side) {
            let line = coupling.line(side, e);
            farthest = line.as_flattened().iter().fold(farthest, |far, x| far.max(x.abs()));
            smallest = smallest.min(coupling.chord(side, e));
        }
    }
    let resolved = f64::EPSILON * farthest / smallest;
    (resolved > RESOLVED).then(|| {
        let what = format!(
            "interface {}: {farthest:.1e} away from the origin, coordinates resolve {resolved:.0e} of its smallest edge",
            interface.name
        );
        Warning::new(Code::FarAway, what, "move the origin nearer")
    })
}
