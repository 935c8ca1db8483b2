//! The laws as Newton's method asks them: with the states at the last accepted increment, and with a drag on their jumps.

use nalgebra::Vector2;

use super::state::Answer;
use crate::law::{self, Law};
use crate::problem::Problem;
use crate::solver::Respond;

/// The laws with the states at the last accepted increment.
pub(super) struct Laws<'a> {
    pub(super) problem: &'a Problem,
    pub(super) old: &'a [Vec<law::State>],
}

impl Respond for Laws<'_> {
    type Memory = Answer;

    fn respond(
        &self,
        joint: usize,
        point: usize,
        jump: &[f64],
        traction: &mut [f64],
        stiffness: &mut [f64],
    ) -> Result<Answer, String> {
        let (law, _) = &self.problem.laws[joint];
        if let Law::Elastic(_) = law {
            let [kn, kt] = law.elastic_stiffness();
            traction.copy_from_slice(&[kn * jump[0], kt * jump[1]]); // what it starts with is a load
            stiffness.copy_from_slice(&[kn, 0.0, 0.0, kt]);
            return Ok(Answer::default());
        }
        let stepping = self.problem.stepping[joint];
        let answer = law
            .respond(Vector2::new(jump[0], jump[1]), &self.old[joint][point], stepping)
            .map_err(|why| why.to_string())?;
        traction.copy_from_slice(answer.traction.as_slice());
        stiffness.copy_from_slice(answer.stiffness.transpose().as_slice()); // by rows
        let gradient = answer.dissipation_gradient.into();
        Ok(Answer { state: answer.state, dissipation: answer.dissipation, gradient })
    }

    fn dissipation<'m>(&self, memory: &'m Answer) -> (f64, &'m [f64]) {
        (memory.dissipation, &memory.gradient)
    }

    fn initial_stiffness(&self, joint: usize, stiffness: &mut [f64]) {
        let [kn, kt] = self.problem.laws[joint].0.elastic_stiffness();
        stiffness.copy_from_slice(&[kn, 0.0, 0.0, kt]);
    }
}

/// The laws with a drag: each carries c (r − r₀) more, r₀ the jump of its state.
pub(super) struct Dragged<'a> {
    pub(super) laws: Laws<'a>,
    /// c [stress / length].
    pub(super) drag: f64,
}

impl Respond for Dragged<'_> {
    type Memory = Answer;

    fn respond(
        &self,
        joint: usize,
        point: usize,
        jump: &[f64],
        traction: &mut [f64],
        stiffness: &mut [f64],
    ) -> Result<Answer, String> {
        let answer = self.laws.respond(joint, point, jump, traction, stiffness)?;
        if let Some(old) = self.laws.old[joint].get(point) {
            traction
                .iter_mut()
                .zip(jump)
                .zip(old.jump.iter())
                .for_each(|((t, r), r0)| *t += self.drag * (r - r0));
            stiffness.iter_mut().step_by(3).for_each(|d| *d += self.drag);
        }
        Ok(answer)
    }

    fn dissipation<'m>(&self, memory: &'m Answer) -> (f64, &'m [f64]) {
        self.laws.dissipation(memory)
    }

    fn initial_stiffness(&self, joint: usize, stiffness: &mut [f64]) {
        self.laws.initial_stiffness(joint, stiffness);
    }
}
