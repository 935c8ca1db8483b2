//! Going on from a checkpoint: the latest in the folder that belongs to the scene, its meshes and the results beside it.

use std::path::Path;

use super::checkpoint::{Kept, read_all};
use super::identity::Identity;
use super::places::FOLDER;
use super::results::Results;
use super::{Event, Listener, Resumed};
use crate::error::{Error, Result};
use crate::history::{Checkpoint, Clock, Equations, History};
use crate::problem::Problem;

/// The checkpoint to go on from, with the results up to it; none if there is none at all.
pub(super) fn find(results: &mut Results, now: &Identity, listen: Listener) -> Result<Option<Checkpoint>> {
    let problem = results.problem;
    let (found, unusable) = read_all(results.path());
    let mut passed: Option<Error> = unusable.into_iter().next();
    for one in &found {
        let usable = match one.identity.difference(now, &one.place) {
            Some(what) => Err(Identity::refused(&one.path, what)),
            None => one.kept().and_then(|kept| match results.has_rows_of(&kept.results)? {
                true => Ok(kept),
                false => Err(Identity::refused(&one.path, "is of other rows than those beside it".into())),
            }),
        };
        match usable {
            Ok(Kept { results: state, history }) => {
                let name = one.path.file_name().unwrap_or_default().to_string_lossy();
                let complete = one.place.step == problem.steps.len();
                results.go_on(state, history.totals(), &format!("{FOLDER}/{name}"), complete);
                let (increments, passed) = (one.place.increment, passed.map(|why| why.to_string()));
                listen(Event::Resumed(&Resumed::After { increments, passed }));
                return Ok(Some(history));
            }
            Err(why) => passed = passed.or(Some(why)),
        }
    }
    if let Some(why) = passed {
        return Err(why);
    }
    listen(Event::Resumed(&Resumed::Anew));
    Ok(None)
}

/// The history from a checkpoint, whose equations must be of the same form.
pub(super) fn history<'a>(
    problem: &'a Problem,
    equations: &'a Equations,
    clock: Clock,
    checkpoint: Checkpoint,
    folder: &Path,
) -> Result<History<'a>> {
    if !checkpoint.fits(equations) {
        let what = format!("is of a run that was solved in another way, {}", checkpoint.method().name());
        return Err(Identity::refused(&folder.join(FOLDER), what));
    }
    History::resume(problem, equations, clock, checkpoint)
}
