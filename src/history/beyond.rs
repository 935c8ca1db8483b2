//! Jumps beyond the range in which the pairs of the undeformed sides hold.

use serde::{Deserialize, Serialize};

use super::state::ModelState;
use crate::law::{Local, N, S, T};
use crate::problem::Problem;

/// A jump, of a point that carries something, by more than an edge that faces it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Beyond {
    /// Name of the interface.
    pub interface: String,
    /// True for an opening, else a slip.
    pub opens: bool,
    /// Number of the first increment with such a jump.
    pub increment: usize,
    /// The largest of that increment and of those since [length].
    pub jump: f64,
    /// The same over the shorter of the two edges that face each other there.
    pub edges: f64,
    /// Its place.
    pub at: [f64; 3],
}

/// Notes the jumps of an increment that exceed an edge of either side.
pub(super) fn note(problem: &Problem, state: &ModelState, increment: usize, told: &mut Vec<Beyond>) {
    for (k, interface) in problem.model.interfaces.iter().enumerate() {
        let coupling = &interface.coupling;
        let jumps = state.snapshot.jumps[k].iter().zip(&state.snapshot.tractions[k]);
        for (point, (jump, traction)) in coupling.points.iter().zip(jumps) {
            let [a, b] = point.on.map(|on| on.facet);
            let edge = coupling.chord(0, a).min(coupling.chord(1, b));
            let (opening, slip) = (jump[N], jump[T].hypot(jump[S]));
            if opening.max(slip) <= edge || *traction == Local::zeros() {
                continue;
            }
            for (opens, jump) in [(true, opening), (false, slip)].into_iter().filter(|(_, jump)| *jump > edge)
            {
                let new = Beyond {
                    interface: interface.name.clone(),
                    opens,
                    increment,
                    jump,
                    edges: jump / edge,
                    at: point.position,
                };
                match told.iter_mut().find(|one| one.opens == opens && one.interface == interface.name) {
                    Some(one) if new.edges > one.edges => *one = Beyond { increment: one.increment, ..new },
                    Some(_) => {}
                    None => told.push(new),
                }
            }
        }
    }
}
