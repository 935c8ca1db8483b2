//! Snaps to another branch of equilibria, as they are told.

use super::analysis::Analysis;
use super::converged::Converged;
use super::progress::LoadIncrement;
use super::stretch::ViscousStretch;
use super::totals::Snap;

/// A stretch whose viscous work is done by this part at open points that close is a gap that closes, no snap.
const FALLS: f64 = 0.5;
/// Released energy below this part of the largest is not told.
const NOTHING: f64 = 1e-6;
/// Viscous work above this part of all that is dissipated is a snap.
const TOLD: f64 = 0.02;

/// Tells a stretch that released energy as a snap.
pub(super) fn tell(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    energy: f64,
    stretch: &ViscousStretch,
    before: f64,
) {
    let released = analysis.state.released - before;
    if released
        <= (TOLD * analysis.state.dissipated).max(NOTHING * energy.max(analysis.state.largest_energy()))
    {
        return;
    }
    if stretch.closing > FALLS * released {
        return; // a gap closes
    }
    let (interface, at) = place_of(analysis, &stretch.worst());
    let half = before + 0.5 * released;
    let (to, _) = stretch.work.last().copied().unwrap_or((leg.goal, 0.0));
    let load_factor =
        stretch.work.iter().find(|(_, work)| *work >= half).map_or(to, |(load_factor, _)| *load_factor);
    analysis.totals.snaps.push(Snap {
        increment: analysis.totals.increments + 1,
        step: leg.step.name.clone(),
        load_factor,
        between: [stretch.from, to],
        interface,
        at,
        released,
    });
}

/// Name and position of a law point.
pub(super) fn place_of(analysis: &Analysis, worst: &[(usize, usize)]) -> (String, Vec<f64>) {
    let Some(&(interface, point)) = worst.first() else { return (String::new(), Vec::new()) };
    let model = &analysis.problem.model;
    let interface = &model.interfaces[interface];
    let position = interface.coupling.points[point].position;
    (interface.name.clone(), position[..model.components].to_vec())
}

/// Tells energy that is lost at once in a part, where a traction drops, as a snap.
pub(super) fn tell_drop(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    energy: f64,
    [from, to]: [f64; 2],
    found: &Converged,
) {
    let (mut released, mut most) = (0.0, (0.0, (0, 0)));
    for of in &found.interfaces {
        let points = &analysis.problem.model.interfaces[of.interface].coupling.points;
        for (p, (point, answer)) in points.iter().zip(&of.memory).enumerate() {
            released += analysis.problem.model.thickness * point.weight * answer.released;
            if answer.released > most.0 {
                most = (answer.released, (of.interface, p));
            }
        }
    }
    if released
        <= (TOLD * analysis.state.dissipated).max(NOTHING * energy.max(analysis.state.largest_energy()))
    {
        return;
    }
    let (interface, at) = place_of(analysis, &[most.1]);
    let (increment, step) = (analysis.totals.increments + 1, leg.step.name.clone());
    let between = [from, to];
    analysis.totals.snaps.push(Snap { increment, step, load_factor: to, between, interface, at, released });
}
