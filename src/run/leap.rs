//! Does an increment of the load level leap to another branch of equilibria?
//!
//! ```text
//! released = work along the straight way of the forces − what is stored and dissipated = Σ h w (½ (t₀ + t₁) · Δr − ∫ t · dr)
//! ```
//!
//! An increment that follows the path releases little, and what it dissipates falls with its size. One that leaps releases
//! what the path would have given back; however finely it is divided, one part dissipates most of it. So increments that
//! release something, and those whose tractions change much, are divided to see, not to be kept.

use super::course::Course;
use super::engine::Failure;
use super::loading::Start;
use super::state::{Found, State};
use crate::error::Result;
use crate::solver::Unconverged;

/// An increment that releases less than this part of what it dissipates follows the path,
const RELEASED: f64 = 1e-2;
/// if it changes what the joints carry by less than this part, as a mean square.
const CHANGED: f64 = 0.25;
/// Halvings by which the leap is enclosed, and the part of what the increment dissipates that must be left in it.
const HALVINGS: usize = 10;
const LEFT: f64 = 0.5;

impl Course<'_, '_> {
    /// True if an increment releases energy: the way there was not through equilibria.
    pub(super) fn leaps(&self, found: &Found) -> bool {
        self.state.released(self.problem, found) > RELEASED * State::dissipation(self.problem, found)
    }

    /// The level within an increment at which it leaps, if it does, and what is found again at its end.
    pub(super) fn leap(
        &mut self,
        start: &Start,
        [from, to]: [f64; 2],
        last: f64,
        found: Found,
    ) -> Result<std::result::Result<(Found, Option<f64>), Unconverged>> {
        let spent = State::dissipation(self.problem, &found);
        let small = self.state.change(self.problem, &found) <= CHANGED * self.state.carried(self.problem);
        let held = self.state.released(self.problem, &found) <= RELEASED * spent;
        if spent <= 0.0 || small && held {
            return Ok(Ok((found, None)));
        }
        let (mut before, mut after) = ((from, 0.0), (to, spent));
        for _ in 0..HALVINGS {
            let level = 0.5 * (before.0 + after.0);
            let load = start.at(level)?;
            let Ok(there) = self.engine.solve(&self.state, &load, (level - from) / last, true) else { break };
            let so_far = State::dissipation(self.problem, &there);
            let half = if so_far - before.1 > after.1 - so_far { &mut after } else { &mut before };
            *half = (level, so_far);
            if after.1 - before.1 < LEFT * spent {
                break;
            }
        }
        let leaps = after.1 - before.1 >= LEFT * spent;
        match self.engine.solve(&self.state, &start.at(to)?, (to - from) / last, true) {
            Ok(found) => Ok(Ok((found, leaps.then_some(after.0)))),
            Err(Failure::Unconverged(why)) => Ok(Err(why)),
            Err(Failure::Unusable(_)) => Ok(Ok((found, leaps.then_some(after.0)))),
        }
    }
}
