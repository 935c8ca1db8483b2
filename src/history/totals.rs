//! Counts of a load history, and what the user should know of them.

use serde::{Deserialize, Serialize};

use super::beyond::Beyond;
use super::equilibrium::strategy::Operations;
use crate::error::{Code, Warning};
use crate::shape::Ends;
use crate::solver::Method;

/// Counts over a whole history.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Totals {
    /// Increments done.
    pub increments: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Newton iterations, those of failed increments included.
    pub iterations: usize,
    /// Parts in which the increments were found.
    pub parts: usize,
    /// Parts that were sought and not kept.
    pub rejected: usize,
    /// Way in which the equations are solved.
    pub method: Method,
    /// Work of all forms, where there is a choice.
    pub operations: Option<Operations>,
    /// Bodies that are like no earlier one, where every one is condensed.
    pub distinct: Option<usize>,
    /// Entries of one factor.
    pub factor_entries: usize,
    /// Largest residual of all increments.
    pub residual: f64,
    /// Turning points of the load factor on the path of equilibria: number of the increment, step, load factor.
    pub turns: Vec<(usize, String, f64)>,
    /// Snaps to another branch of equilibria.
    pub snaps: Vec<Snap>,
    /// Energy released by snaps [force × length].
    pub released: f64,
    /// Work of the viscosity of laws [force × length].
    pub viscous: f64,
    /// Largest |work − stored − dissipated − released|, relative.
    pub energy_balance: f64,
    /// Number of the increment with that balance.
    pub balance_at: usize,
    /// Largest out-of-balance of loads and reactions, relative.
    pub imbalance: f64,
    /// Number of the increment with that out-of-balance.
    pub imbalance_at: usize,
    /// Subdomains that nothing holds any more, each with the increment since which.
    pub unheld: Vec<(String, usize)>,
    /// Jumps beyond the range of the pairs.
    pub beyond: Vec<Beyond>,
    /// Largest sum of the magnitudes of loads and reactions so far [force].
    pub forces: f64,
    /// Initial tractions that nothing holds.
    pub initial: Relaxed,
}

/// Initial tractions that relax before the first increment.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct Relaxed {
    /// Their out-of-balance over their sum.
    pub rest: f64,
    /// Energy that they release [force × length].
    pub released: f64,
}

/// A snap: from where no equilibrium continues the path to a stable one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snap {
    /// Number of the increment over all steps.
    pub increment: usize,
    /// Name of the step.
    pub step: String,
    /// Load factor at which half of the energy is released.
    pub load_factor: f64,
    /// Load factors between which it is followed.
    pub between: Ends,
    /// Interface that takes most of it.
    pub interface: String,
    /// Law point there that takes most of it: as many coordinates as the model has.
    pub at: Vec<f64>,
    /// Energy released [force × length].
    pub released: f64,
}

/// Loads and reactions that are further from balance, relative to them, are told; further than the second, no equilibrium.
pub(super) const UNBALANCED: f64 = 1e-6;
pub(super) const NO_BALANCE: f64 = 1e-3;
/// An energy balance of so many times the tolerance of the path is told.
const ENERGY: f64 = 10.0;
/// Initial tractions that are out of balance by less than this part are in equilibrium.
const IN_BALANCE: f64 = 1e-6;

impl Totals {
    /// Warnings of how the increments went.
    pub fn warnings(&self, path_tolerance: f64) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if let Some(Snap { step, load_factor, interface, at, .. }) = self.snaps.first() {
            let at = at.iter().map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(", ");
            let (count, released) = (self.snaps.len(), self.released);
            let times = if count == 1 { "once".to_string() } else { format!("{count} times") };
            let what = format!(
                "step \"{step}\": snapped to another branch {times}, first at load factor {load_factor:.6} by {interface} \
                 at ({at}); {released:.3e} of energy released in all"
            );
            let help = "\"control\": \"auto\" follows the path between; where it snaps too, more edges over the cohesive zone";
            warnings.push(Warning::new(Code::Snapped, what, help));
        }
        if self.imbalance > UNBALANCED {
            let what = format!(
                "increment {}: loads and reactions are out of balance by {:.1e} of their sum",
                self.imbalance_at, self.imbalance
            );
            warnings.push(Warning::new(
                Code::Unbalanced,
                what,
                "a smaller solution.tolerance, or another strategy",
            ));
        }
        if self.energy_balance > ENERGY * path_tolerance {
            let what = format!(
                "increment {}: energies are out of balance by {:.1e} of the largest",
                self.balance_at, self.energy_balance
            );
            let help =
                "more increments or a smaller solution.path_tolerance show what it means for the answer";
            warnings.push(Warning::new(Code::Energies, what, help));
        }
        if self.initial.rest > IN_BALANCE {
            let what = format!(
                "initial tractions are out of balance with the first step's loads by {:.1} % of their sum; they relax before \
                 the first increment and release {:.3e} of energy",
                100.0 * self.initial.rest,
                self.initial.released
            );
            let help = "give loads and supports at load factor 0 that hold them, such as a pressure \"5 + 0*load_factor\"";
            warnings.push(Warning::new(Code::InitialTraction, what, help));
        }
        for (name, increment) in &self.unheld {
            let what = format!(
                "subdomain {name}: nothing holds it from increment {increment} on, and nothing pushes it; its place and the jumps around it say nothing from there on"
            );
            warnings.push(Warning::new(Code::Unheld, what, "a support, if it should not float"));
        }
        for Beyond { interface, opens, increment, jump, edges, at: [x, y, _] } in &self.beyond {
            let kind = if *opens { "opening" } else { "slip" };
            let what = format!(
                "interface {interface}: {kind} of {jump:.3e} is {edges:.1} edges near ({x:.4}, {y:.4}), more than one from increment \
                 {increment} on; the sides are paired as they are before any displacement"
            );
            let help = "results hold for jumps that are small beside the edges: a smaller displacement, or coarser edges there";
            warnings.push(Warning::new(Code::Beyond, what, help));
        }
        warnings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(totals: &Totals) -> Vec<String> {
        totals.warnings(1e-3).iter().map(|warning| warning.to_string()).collect()
    }

    /// Claim: what is out of balance is told with its size and increment from ten times the tolerance of the path on (energies), 1e-6 (forces,
    /// initial tractions); below nothing is.
    #[test]
    fn what_is_out_of_balance_is_told() {
        let limits = Totals {
            energy_balance: 9.9e-3,
            imbalance: 0.9e-6,
            initial: Relaxed { rest: 0.9e-6, released: 0.0 },
            ..Totals::default()
        };
        assert_eq!(told(&limits), [""; 0]);
        let energies = told(&Totals { energy_balance: 1.2e-2, balance_at: 17, ..Totals::default() });
        assert!(energies.len() == 1 && energies[0].contains("increment 17: energies"), "{energies:?}");
        let forces = told(&Totals { imbalance: 2e-6, imbalance_at: 5, ..Totals::default() });
        assert!(forces.len() == 1 && forces[0].contains("increment 5: loads and reactions"), "{forces:?}");
        let initial = Relaxed { rest: 2e-6, released: 3.0 };
        let tractions = told(&Totals { initial, ..Totals::default() });
        assert!(tractions.len() == 1 && tractions[0].contains("3.000e0 of energy"), "{tractions:?}");
        let unheld = told(&Totals { unheld: vec![("block".to_string(), 4)], ..Totals::default() });
        assert!(
            unheld.len() == 1 && unheld[0].contains("block: nothing holds it from increment 4"),
            "{unheld:?}"
        );
    }
}
