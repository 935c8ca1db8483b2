//! One law point driven along a program of segments, each component by displacement or by stress.
//!
//! ```json
//! { "program": [ { "n": { "control": "stress", "start": 0, "end": -5 },
//!                  "t": { "control": "displacement", "start": 0, "end": 0 }, "points": 2 } ],
//!   "initial": { "u_n": 0, "u_t": 0, "up_n": 0, "up_t": 0, "W": 0 } }
//! ```
//!
//! Segment k runs linearly over s in [k, k + 1]; a row is stored at its start and at `points` equally spaced s. Other
//! keys of the file are ignored. Where stress is prescribed the jump is an unknown, so the way between two rows is not
//! straight: it is divided by the same error control as the law's own sub-steps.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Deserialize;

use super::balance::{Prescribed, balance};
use super::local::Local;
use super::point::intact_strength;
use super::{Integration, Law, OWN, State, Strength};

/// A path as read from its file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct LawPath {
    /// Segments, one after the other.
    pub program: Vec<PathSegment>,
    /// Initial state of the point; by default intact, at rest, under the interface's initial traction.
    #[serde(default)]
    pub initial: Option<Initial>,
}

/// A straight piece of the program.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub struct PathSegment {
    /// Normal component.
    pub n: ComponentControl,
    /// Tangential component.
    pub t: ComponentControl,
    /// Rows stored after the start, equally spaced.
    pub points: usize,
}

/// Control of one component, and its values at the ends of the segment.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComponentControl {
    /// Displacement (the jump) or stress (the traction).
    pub control: Controlled,
    /// Value at the start; it must be the value reached before.
    pub start: f64,
    /// Value at the end.
    pub end: f64,
}

/// The quantity that is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Controlled {
    /// The component of the jump.
    Displacement,
    /// The component of the traction.
    Stress,
}

/// Most points of a program.
const MOST_POINTS: f64 = 1e7;

/// State at the start of a program.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default)]
pub struct Initial {
    /// Normal jump [length].
    pub u_n: f64,
    /// Tangential jump [length].
    pub u_t: f64,
    /// Irreversible normal jump [length]; the dilation d of a crack that closes.
    #[serde(alias = "dilation")]
    pub up_n: f64,
    /// Irreversible tangential jump [length].
    pub up_t: f64,
    /// Variables of the law by name; `W` is `fracture_work`.
    #[serde(flatten)]
    pub own: BTreeMap<String, f64>,
}

impl Initial {
    /// The variables in their places; a name that the law does not have is refused.
    fn own(&self, law: &Law) -> Result<[f64; OWN], PathError> {
        let mut own = [0.0; OWN];
        for (name, value) in &self.own {
            let full = if name == "W" { "fracture_work" } else { name };
            let Some(variable) = law.variables().iter().find(|variable| variable.name == full) else {
                let known = ["u_n", "u_t", "up_n", "up_t"].into_iter();
                let names: Vec<&str> =
                    known.chain(law.variables().iter().map(|variable| variable.name)).collect();
                return Err(PathError::Program {
                    key: format!("initial.{name}"),
                    what: format!("the law has no \"{name}\""),
                    help: format!("there is {}", names.join(", ")),
                });
            };
            own[variable.place] = *value;
        }
        Ok(own)
    }
}

/// A stored point of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathRow {
    /// Segment number plus the fraction of it.
    pub s: f64,
    /// Jump, traction, irreversible jump, fracture work and status there.
    pub state: State,
    /// Strength there; `None` for the elastic law.
    pub strength: Option<Strength>,
}

/// Why a path ended early.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PathError {
    /// The path asks for something that cannot start.
    #[error("{key}: {what}; {help}")]
    Program {
        /// The key to blame, such as `program[1].n.start`.
        key: String,
        /// The fault.
        what: String,
        /// The remedy.
        help: String,
    },
    /// The law has no answer beyond some point.
    #[error("no equilibrium at s = {s:.6}: {reason}")]
    NoEquilibrium {
        /// Position on the path.
        s: f64,
        /// Why.
        reason: String,
        /// The rows up to there.
        rows: Vec<PathRow>,
    },
}

/// Columns of the CSV, those of the law's own variables among them.
pub fn columns(law: &Law) -> String {
    let own: String = law.variables().iter().map(|variable| format!("{},", variable.name)).collect();
    format!(
        "s,jump_n,jump_t,traction_n,traction_t,{own}jump_n_plastic,jump_t_plastic,\
         tensile_strength,cohesion,tan_friction,status,condition"
    )
}

/// A prescribed value may miss the value reached before by this, relative to the segment's values.
const JOINT: f64 = 1e-9;
/// A way under stress control is not divided below this part of the distance between two rows.
const SHORTEST: f64 = 1e-7;
/// Divisions of the way between two rows before it is given up, and per 1/√ε: a smooth way takes a tenth of them. One that
/// has no answer counts as several.
const DIVISIONS: f64 = 300.0;
const DIVISIONS_BY_ROOT: f64 = 1.0;
const UNANSWERED: usize = 8;
/// Local errors below this part of the cohesion are rounding.
const ROUNDING: f64 = 1e-11;
/// And those below so many units in the last place of the elastic traction of the whole jump: where it is an unknown, no
/// traction is met more closely.
const LAST_PLACES: f64 = 8.0;

/// Drives a point of `law` from `start` (the interface's initial state) along a path; the first row is the start.
pub fn drive(
    law: &Law,
    path: &LawPath,
    start: &State,
    integration: Integration,
) -> Result<Vec<PathRow>, PathError> {
    let mut state = match &path.initial {
        None => *start,
        Some(initial) => {
            let jump = Local::new(initial.u_n, initial.u_t, 0.0);
            let plastic = Local::new(initial.up_n, initial.up_t, 0.0);
            law.state_at(jump, plastic, initial.own(law)?).map_err(|refused| PathError::Program {
                key: "initial".into(),
                what: refused.what,
                help: refused.help,
            })?
        }
    };
    let points = path.program.iter().map(|segment| segment.points as f64).sum::<f64>();
    if points > MOST_POINTS {
        let gigabytes = points * size_of::<PathRow>() as f64 / 1e9;
        return Err(PathError::Program {
            key: "program".into(),
            what: format!("{points:.0} points, which take {gigabytes:.0} GB"),
            help: format!("ask for {MOST_POINTS:e} at most"),
        });
    }
    let row = |s: f64, state: &State| PathRow { s, state: *state, strength: law.strength(state) };
    let mut rows = vec![row(0.0, &state)];
    let mut length = 1.0; // of the next division under stress control, per row
    for (k, segment) in path.program.iter().enumerate() {
        segment.check(k, &state)?;
        for point in 0..segment.points {
            let at = |part: f64| segment.target((point as f64 + part) / segment.points as f64);
            state = between_rows(law, &state, at, integration, &mut length).map_err(|(part, reason)| {
                let s = k as f64 + (point as f64 + part) / segment.points as f64;
                PathError::NoEquilibrium { s, reason, rows: rows.clone() }
            })?;
            rows.push(row(k as f64 + (point + 1) as f64 / segment.points as f64, &state));
        }
    }
    Ok(rows)
}

/// Writes the rows as CSV, the header first; the elastic law leaves the strength columns empty.
pub fn write_csv(law: &Law, rows: &[PathRow], mut out: impl Write) -> io::Result<()> {
    writeln!(out, "{}", columns(law))?;
    for PathRow { s, state, strength } in rows {
        write!(out, "{s},{:e},{:e}", state.jump.x, state.jump.y)?;
        write!(out, ",{:e},{:e}", state.traction.x, state.traction.y)?;
        for variable in law.variables() {
            write!(out, ",{:e}", state.own[variable.place])?;
        }
        write!(out, ",{:e},{:e}", state.jump_plastic.x, state.jump_plastic.y)?;
        match strength {
            Some(Strength { tensile_strength, cohesion, tan_friction }) => {
                write!(out, ",{tensile_strength:e},{cohesion:e},{tan_friction:e}")?
            }
            None => write!(out, ",,,")?,
        }
        writeln!(out, ",{},{}", state.status, law.condition(state) as u8)?;
    }
    Ok(())
}

impl PathSegment {
    /// Prescribed values at a fraction of the segment.
    fn target(&self, fraction: f64) -> [Prescribed; 2] {
        [self.n, self.t].map(|ComponentControl { control, start, end }| {
            let value = if fraction >= 1.0 { end } else { start + fraction * (end - start) };
            match control {
                Controlled::Displacement => Prescribed::Jump(value),
                Controlled::Stress => Prescribed::Traction(value),
            }
        })
    }

    /// The segment must have points, finite values, and begin where the point is.
    fn check(&self, k: usize, state: &State) -> Result<(), PathError> {
        let error_at = |key: &str, what: String, help: &str| {
            Err(PathError::Program { key: format!("program[{k}].{key}"), what, help: help.into() })
        };
        if self.points == 0 {
            return error_at("points", "0 points".into(), "it must be 1 or more");
        }
        for (i, (name, control)) in [("n", self.n), ("t", self.t)].into_iter().enumerate() {
            let reached = match control.control {
                Controlled::Displacement => state.jump[i],
                Controlled::Stress => state.traction[i],
            };
            if !(control.start.is_finite() && control.end.is_finite()) {
                return error_at(&format!("{name}.end"), "not a finite number".into(), "give a number");
            }
            let size = control.start.abs().max(control.end.abs()).max(reached.abs());
            if (control.start - reached).abs() > JOINT * size {
                return error_at(
                    &format!("{name}.start"),
                    format!("{:e}, but the point is at {reached:e} there", control.start),
                    "begin where the segment before ends, or at the initial state",
                );
            }
        }
        Ok(())
    }
}

/// Rounding of the jump as a traction [stress].
fn rounding(law: &Law, state: &State) -> f64 {
    let elastic = law.elastic_stiffness().into_iter().zip(state.jump.iter());
    let largest = elastic.map(|(stiffness, jump)| stiffness * jump.abs()).fold(0.0, f64::max);
    LAST_PLACES * f64::EPSILON * largest
}

/// From one row to the next; `length` is the division under stress control, kept from row to row.
fn between_rows(
    law: &Law,
    from: &State,
    at: impl Fn(f64) -> [Prescribed; 2],
    integration: Integration,
    length: &mut f64,
) -> Result<State, (f64, String)> {
    let straight = at(1.0).iter().all(|target| matches!(target, Prescribed::Jump(_)));
    let controlled = match integration {
        Integration::Tolerance(tolerance) if !straight => {
            law.local_bound(tolerance).map(|bound| (bound, tolerance))
        }
        Integration::BackwardEuler(steps) if !straight && law.is_integrated() => {
            let mut state = *from;
            for step in 1..=steps.max(1) {
                let part = step as f64 / steps.max(1) as f64;
                state = balance(law, &state, at(part), Integration::BackwardEuler(1))
                    .map_err(|reason| (part, reason))?;
            }
            return Ok(state);
        }
        _ => None,
    };
    let Some((bound, tolerance)) = controlled else {
        return balance(law, from, at(1.0), integration).map_err(|reason| (1.0, reason));
    };
    let bound = bound.max(ROUNDING * intact_strength(&**law));
    let mut divisions_left = (DIVISIONS + DIVISIONS_BY_ROOT / tolerance.sqrt()) as usize;
    let mut state = *from;
    let mut done = 0.0;
    while done < 1.0 {
        let part = length.min(1.0 - done);
        let end = if part >= 1.0 - done { 1.0 } else { done + part };
        let go = |from: &State, to: f64| balance(law, from, at(to), integration);
        let whole = go(&state, end);
        let halves = go(&state, 0.5 * (done + end)).and_then(|middle| go(&middle, end));
        let ratio = match (&whole, &halves) {
            (Ok(whole), Ok(halves)) => law.misfit(whole, halves) / bound.max(rounding(law, halves)),
            _ => f64::INFINITY,
        };
        let cost = if ratio.is_finite() { 1 } else { UNANSWERED };
        divisions_left = divisions_left.checked_sub(cost).ok_or_else(|| {
            let reason = "the traction changes too fast for the way to the next row; ask for more points";
            (end, halves.as_ref().err().map_or(reason.to_string(), String::clone))
        })?;
        let shortest = part <= SHORTEST;
        if ratio <= 1.0 || shortest {
            state = halves.map_err(|reason| (end, reason))?;
            done = end;
        }
        let factor = if shortest { 5.0 } else { (0.85 / ratio.cbrt()).clamp(0.2, 5.0) };
        *length = (part * factor).min(1.0);
    }
    Ok(state)
}
