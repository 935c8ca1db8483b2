//! Snaps to another branch of equilibria, as they are told.

use super::course::Course;
use super::march::Snap;
use super::parts::Leg;
use super::viscous::Stretch;

/// A stretch whose viscous work is done by this part at open points that close is a gap that closes, no snap.
const FALLS: f64 = 0.5;
/// Released energy below this part of the largest is not told.
pub(super) const NOTHING: f64 = 1e-6;
/// Viscous work above this part of all that is dissipated is a snap.
pub(super) const TOLD: f64 = 0.02;

impl Course<'_, '_> {
    /// Tells a stretch that released energy as a snap.
    pub(super) fn tell(&mut self, leg: &Leg, energy: f64, stretch: &Stretch, before: f64) {
        let released = self.state.released - before;
        if released <= (TOLD * self.state.dissipated).max(NOTHING * energy.max(self.state.largest_energy())) {
            return;
        }
        if stretch.closing > FALLS * released {
            return; // a gap closes
        }
        let (interface, at) = self.place_of(&stretch.worst());
        let half = before + 0.5 * released;
        let (to, _) = stretch.work.last().copied().unwrap_or((leg.goal, 0.0));
        let load_factor = stretch.work.iter().find(|(_, work)| *work >= half).map_or(to, |(level, _)| *level);
        self.totals.snaps.push(Snap {
            increment: self.totals.increments + 1,
            step: leg.stage.name.clone(),
            load_factor,
            between: [stretch.from, to],
            interface,
            at,
            released,
        });
    }

    /// Name and position of a law point.
    pub(super) fn place_of(&self, worst: &[(usize, usize)]) -> (String, [f64; 2]) {
        let Some(&(joint, point)) = worst.first() else { return (String::new(), [0.0; 2]) };
        let joint = &self.problem.model.joints[joint];
        (joint.name.clone(), joint.coupling.points[point].position)
    }
}
