//! The jump at which a law point carries what is prescribed, component by component.
//!
//! A prescribed jump is taken as it is. A prescribed traction is an equation for its component of the jump: Newton
//! with the law's own stiffness, kept between the last jumps that gave too little and too much.

use super::local::{Local, LocalMatrix, N, T};
use super::point::intact_strength;
use super::{Integration, Law, Response, State};

/// Prescribed value of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Prescribed {
    /// The jump [length].
    Jump(f64),
    /// The traction [stress].
    Traction(f64),
}

/// A prescribed traction is met to this, relative to traction and strength.
const MET: f64 = 1e-12;
/// Below that, iterations go on only while each divides what is left by this.
const GAIN: f64 = 4.0;
/// It is accepted to this when rounding forbids more.
const NEARLY_MET: f64 = 1e-7;
const ITERATIONS: usize = 60;
/// A search ends, and a correction goes, at most this many times farther than the elastic reach.
const FARTHEST: f64 = 1e8;
/// Halvings of a Newton correction that makes things worse, and trials of all corrections.
const HALVINGS: usize = 12;
const TRIALS: usize = 40;

/// The state that satisfies both targets, reached in a straight line from the old one.
pub(super) fn balance(
    law: &Law,
    old: &State,
    targets: [Prescribed; 2],
    integration: Integration,
) -> Result<State, String> {
    let respond = |jump| law.respond(jump, old, integration).map_err(|unresolved| unresolved.to_string());
    match targets {
        [Prescribed::Jump(n), Prescribed::Jump(t)] => Ok(respond(Local::new(n, t, 0.0))?.state),
        [Prescribed::Traction(sigma), Prescribed::Traction(tau)] => {
            both(law, old, Local::new(sigma, tau, 0.0), respond)
        }
        [Prescribed::Traction(sigma), Prescribed::Jump(t)] => {
            one(law, old, N, sigma, |x| respond(Local::new(x, t, 0.0)))
        }
        [Prescribed::Jump(n), Prescribed::Traction(tau)] => {
            one(law, old, T, tau, |x| respond(Local::new(n, x, 0.0)))
        }
    }
}

/// Component `i` of the jump for a traction there.
fn one(
    law: &Law,
    old: &State,
    i: usize,
    target: f64,
    respond: impl Fn(f64) -> Result<Response, String>,
) -> Result<State, String> {
    let stiffness = law.elastic_stiffness()[i];
    let scale = target.abs().max(old.traction[i].abs()).max(intact_strength(&**law));
    let mut x = old.jump[i];
    // no traction reaches the jump to which faces cannot close
    let least = if i == N { old.jump_plastic[N] + law.narrowest() } else { f64::NEG_INFINITY };
    let (mut lo, mut hi) = (least, f64::INFINITY);
    let mut reach = scale / stiffness;
    let mut best = (f64::INFINITY, *old);
    for _ in 0..ITERATIONS {
        let response = respond(x)?;
        let over = response.traction[i] - target;
        let gain = over.abs() * GAIN <= best.0;
        if over.abs() < best.0 {
            best = (over.abs(), response.state);
        }
        if over == 0.0 || (best.0 <= MET * scale && !gain) {
            return Ok(best.1);
        }
        if over > 0.0 {
            hi = x
        } else {
            lo = x
        }
        let newton = x - over / response.stiffness[(i, i)];
        if newton == x {
            break;
        }
        let fallback = match (lo.is_finite(), hi.is_finite()) {
            (true, true) => 0.5 * (lo + hi),
            (true, false) => lo + reach,
            _ => hi - reach,
        };
        let next =
            if newton > lo && newton < hi && response.stiffness[(i, i)] > 0.0 { newton } else { fallback };
        if !(lo.is_finite() && hi.is_finite()) {
            reach *= 4.0;
        }
        if next == x || reach > FARTHEST * scale / stiffness {
            break;
        }
        x = next;
    }
    let rounding = 4.0 * f64::EPSILON * stiffness * best.1.jump[i].abs();
    if best.0 <= NEARLY_MET * scale + rounding {
        return Ok(best.1);
    }
    let component = ["traction_n", "traction_t"][i];
    Err(format!("the point cannot carry {component} = {target:e}; nearest {:e}", best.1.traction[i]))
}

/// Both components of the jump for a traction.
fn both(
    law: &Law,
    old: &State,
    target: Local,
    respond: impl Fn(Local) -> Result<Response, String>,
) -> Result<State, String> {
    let scale = target.amax().max(old.traction.amax()).max(intact_strength(&**law));
    let k = Local::from(law.elastic_stiffness());
    let elastic = target - old.traction;
    let mut jump = old.jump + elastic.component_div(&k);
    if jump[N] <= old.jump_plastic[N] + law.narrowest() {
        jump[N] = old.jump_plastic[N] + law.jump_under(&target)[N];
    }
    let mut response = respond(jump)?;
    let mut trials = 0;
    for _ in 0..ITERATIONS {
        let over = response.traction - target;
        if largest(&over) <= MET * scale {
            return Ok(response.state);
        }
        let Some(inverse): Option<LocalMatrix> = response.stiffness.try_inverse() else { break };
        let correction = inverse * over;
        // where next to nothing resists it would go to where a law takes long to answer
        let far = correction.component_mul(&k).amax() / (FARTHEST * scale);
        let mut part = if far > 1.0 { 1.0 / far } else { 1.0 };
        let better = (0..HALVINGS).find_map(|_| {
            trials += 1;
            let trial = respond(jump - correction * part).ok()?;
            part *= 0.5;
            ((trial.traction - target).norm() < over.norm()).then_some(trial)
        });
        let Some(next) = better.filter(|_| trials < TRIALS) else { break };
        jump = next.state.jump;
        response = next;
    }
    if largest(&(response.traction - target)) <= NEARLY_MET * scale {
        return Ok(response.state);
    }
    Err(format!("the point cannot carry the traction [{:e}, {:e}]", target.x, target.y))
}

/// The largest component; infinite if one is no number.
fn largest(of: &Local) -> f64 {
    if of.iter().all(|x| x.is_finite()) { of.amax() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// Claim: of a point without tensile strength that is pulled no answer is asked for jumps beyond all sizes, however little resists.
    #[test]
    fn a_search_stays_within_reach() {
        let law: Law = serde_json::from_str(
            r#"{ "type": "cracking", "normal_stiffness": 1e4, "tangential_stiffness": 5e4, "tensile_strength": 0, "cohesion": 0.8,
                "tan_friction": 0.4, "fracture_energy_i": 3.8e-4, "fracture_energy_iia": 1.2e-3, "dilatancy_stress": 6,
                "unloading": "plastic" }"#,
        )
        .unwrap();
        for pull in [1.0, 0.5, 1e-3] {
            let (asked, farthest) = (Cell::new(0), Cell::new(0.0_f64));
            let respond = |jump: Local| {
                asked.set(asked.get() + 1);
                farthest.set(farthest.get().max(jump.amax()));
                law.respond(jump, &State::default(), Integration::Tolerance(1e-4))
                    .map_err(|why| why.to_string())
            };
            let refused = both(&law, &State::default(), Local::new(pull, -3e-9 * pull, 0.0), respond);
            assert!(refused.is_err(), "{pull}: {refused:?}");
            let reach = pull.max(0.8) / 1e4;
            assert!(farthest.get() <= 2.0 * FARTHEST * reach, "{pull}: {:e}", farthest.get());
            assert!(asked.get() > 2);
        }
    }
}
