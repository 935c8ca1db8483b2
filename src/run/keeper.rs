//! The times of checkpoints: after so much time or so many increments, at the ends of steps, and where a run ends early.
//!
//! The state after an increment is kept in memory, so that a run that ends in the middle of the next one can write it: after every
//! increment, or as often as a small part of the time allows.

use std::time::{Duration, Instant};

use super::checkpoint::{self, Keeping};
use super::identity::Identity;
use super::places::{CheckpointPlace, LATEST, of_step};
use super::results::Results;
use crate::error::{Error, Result};
use crate::history::{History, Increment};
use crate::problem::Problem;
use crate::scene::Fields;

/// Interval between checkpoints, beside the ends of steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Every {
    /// After so many seconds.
    Seconds(f64),
    /// After so many increments.
    Increments(usize),
    /// Never, nor at the ends of steps.
    Never,
}

/// States are kept as long as that has taken this share of the time, and always as long as it has taken less than this [s].
const SHARE: f64 = 0.01;
const LITTLE: f64 = 0.002;

/// Keeps the state of a run.
#[derive(Debug)]
pub(super) struct Keeper {
    every: Every,
    /// The identity of the run, as JSON.
    identity: Vec<u8>,
    /// The ends of all steps are kept, not of the last two only.
    all_steps: bool,
    steps: usize,
    /// The state after the last increment; empty if it is on disk.
    held: Vec<u8>,
    place: CheckpointPlace,
    spent: Duration,
    last: (Instant, usize),
}

impl Keeper {
    /// For a run that begins, or goes on after so many increments.
    pub(super) fn new(
        every: Every,
        identity: Option<&Identity>,
        problem: &Problem,
        increment: usize,
    ) -> Result<Keeper> {
        let all_steps = matches!(problem.fields, Fields::Every | Fields::Step);
        let identity = serde_json::to_vec(&identity);
        let identity = identity.map_err(|error| Error::io("write", LATEST)(std::io::Error::other(error)))?;
        let place = CheckpointPlace { increment, step: 0, between: true };
        let (steps, held, spent) = (problem.steps.len(), Vec::new(), Duration::ZERO);
        let last = (Instant::now(), increment);
        Ok(Keeper { every, identity, all_steps, steps, held, place, spent, last })
    }

    /// Takes the state after an increment; `stops`: somebody wants the run to stop.
    pub(super) fn after(
        &mut self,
        increment: &Increment,
        history: &mut History,
        results: &mut Results,
        stops: bool,
    ) -> Result<()> {
        let known = history.place().filter(|_| self.every != Every::Never && increment.increment > 0);
        // a run that has come to its end leaves the state before
        let Some((step, between)) = known else { return Ok(()) };
        let now = Instant::now();
        let due = match self.every {
            Every::Seconds(seconds) => (now - self.last.0).as_secs_f64() >= seconds,
            Every::Increments(many) => increment.increment >= self.last.1 + many,
            Every::Never => false,
        };
        let cheap = self.spent.as_secs_f64() <= LITTLE + SHARE * history.clock().total();
        let ends = between && (cheap || step == self.steps);
        if !(due || ends || stops || cheap) {
            return Ok(()); // the state before that was kept will do
        }
        let name = if between { of_step(step) } else { LATEST.into() };
        if ends {
            results.list(&name)?;
        }
        self.place = CheckpointPlace { increment: increment.increment, step, between };
        let keeping = Keeping { results: &results.state(), history: history.checkpoint() };
        checkpoint::encode(&self.place, &self.identity, &keeping, &mut self.held)?;
        if due || ends {
            self.write(results, if ends { &name } else { LATEST })?;
            if ends {
                results.remove(LATEST); // an earlier one
            }
            if ends && !self.all_steps && step > 2 {
                results.remove(&of_step(step - 2));
            }
        }
        self.spent += now.elapsed();
        Ok(())
    }

    /// Writes the state after the last increment, unless that is done.
    pub(super) fn end(&mut self, results: &mut Results) -> Result<()> {
        if self.held.is_empty() { Ok(()) } else { self.write(results, LATEST) }
    }

    fn write(&mut self, results: &mut Results, name: &str) -> Result<()> {
        checkpoint::write(results.path(), name, &self.held)?;
        self.held.clear();
        self.last = (Instant::now(), self.place.increment);
        Ok(())
    }
}
