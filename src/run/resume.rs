//! Going on from a checkpoint: the latest in the folder that belongs to the scene, its meshes and the results beside it.

use std::path::Path;

use super::checkpoint::{Kept, all_of, read};
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
    let mut passed: Option<Error> = None;
    for path in all_of(results.path()) {
        let usable = read(&path).and_then(|one| {
            if let Some(what) = one.identity.difference(now, &one.place) {
                return Err(Identity::refused(&path, what));
            }
            let kept = one.kept()?;
            match results.has_rows_of(&kept.results)? {
                true => Ok((one.place, kept)),
                false => Err(Identity::refused(&path, "is of other rows than those beside it".into())),
            }
        });
        match usable {
            Ok((place, Kept { results: state, history })) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let complete = place.step == problem.steps.len();
                results.go_on(state, history.totals(), &format!("{FOLDER}/{name}"), complete);
                let (increments, passed) = (place.increment, passed.map(|why| why.to_string()));
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
