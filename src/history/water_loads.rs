//! Loads of an increment with the pressures of all interfaces.

use super::state::ModelState;
use crate::problem::Problem;

impl ModelState {
    /// External forces by dof, pressures of all interfaces among them; none where fields are not stored [force].
    pub fn loads(&self, problem: &Problem) -> Vec<f64> {
        let mut force = self.force.clone();
        let coupled = problem.interfaces.iter().map(|bound| bound.coupled_pressure);
        let interfaces = problem.model.interfaces.iter().zip(coupled).zip(&self.snapshot.water.pressures);
        let stored = !force.is_empty();
        for ((operator, _), pressures) in interfaces.filter(|((_, coupled), _)| *coupled && stored) {
            let mut tractions = vec![0.0; operator.coupling.points.len() * problem.model.components];
            let normal = tractions.iter_mut().step_by(problem.model.components);
            normal.zip(pressures).for_each(|(traction, pressure)| *traction = *pressure);
            operator.add_force(&tractions, &mut force);
        }
        force
    }
}
