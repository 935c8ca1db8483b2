//! Claim: a million random steps of Coulomb joints, with linear springs and with a closure, of every option, in the plane and in
//! space: no traction leaves the surface, nothing is NaN, dissipation and release are never negative, slip and loss never fall, the mirrored
//! way gives the mirrored traction, a step repeated changes nothing. A million of elastic joints with a closure return along their way.

use crate::common::laws::Random;
use midplane::law::{
    Closure, Coulomb, Elastic, Integration, Law, Local, LossOfCohesion, PointLaw, Response, State,
};

const STEP: Integration = Integration::Tolerance(1e-4);
/// Rounding of a traction, relative; with a closure to its slope times the jump.
const ROUNDING: f64 = 1e-12;
const STEPS: usize = 1_000_000;

fn springs(random: &mut Random) -> (f64, Option<Closure>) {
    let kn = random.power(3.0, 8.0);
    let closure = Closure { initial_stiffness: kn, maximum: random.power(-1.5, 1.0) / kn };
    (kn, random.coin().then_some(closure))
}

fn coulomb(random: &mut Random) -> Coulomb {
    let (kn, closure) = springs(random);
    let mu = if random.between(0.0, 1.0) < 0.1 { 0.0 } else { random.between(0.0, 2.0) };
    Coulomb {
        normal_stiffness: closure.is_none().then_some(kn),
        closure,
        tangential_stiffness: kn * random.power(-2.0, 2.0),
        friction_coefficient: mu,
        cohesion: if random.coin() { 0.0 } else { random.between(0.0, 2.0) },
        dilatancy: if random.coin() { 0.0 } else { random.between(0.0, mu) },
        dilatancy_end: random.coin().then_some(random.power(-1.0, 1.5) / kn),
        cohesion_lost: if random.coin() { LossOfCohesion::Never } else { LossOfCohesion::AtSlip },
    }
}

/// A step to anywhere around, larger ones more rarely.
fn next(law: &dyn PointLaw, old: &State, flat: bool, random: &mut Random) -> Local {
    let [kn, kt, _] = law.elastic_stiffness();
    let (way, across) = (random.direction() * random.power(-2.0, 1.5), random.direction());
    let to = Local::new(way.x / kn, way.y / kt, if flat { 0.0 } else { across.x * way.y / kt });
    let end = to + if random.coin() { old.jump } else { old.jump_plastic };
    let least = old.jump_plastic.x + 0.95 * law.narrowest();
    Local::new(end.x.max(least), end.y, if flat { 0.0 } else { end.z })
}

/// Size of the tractions of a step, by what is lost to the last digit of its jumps.
fn size(law: &dyn PointLaw, old: &State, response: &Response) -> f64 {
    let [kn, kt, _] = law.elastic_stiffness();
    let jumps = [old.jump, old.jump_plastic, response.state.jump, response.state.jump_plastic];
    let reach = jumps.iter().fold(0.0, |most: f64, r| most.max(r.amax()));
    let v = -law.narrowest();
    let steep = |sigma: f64| if v.is_finite() { kn * (1.0 - sigma / (kn * v)).powi(2) } else { kn };
    let stiff = kt.max(steep(old.traction.x)).max(steep(response.traction.x));
    (stiff * reach).max(old.traction.amax()).max(1.0)
}

#[test]
fn a_million_steps_of_coulomb_joints() {
    let mut random = Random(31);
    let (mut steps, mut wedged, mut by_status) = (0, 0, [0_usize; 5]);
    while steps < STEPS {
        let own = coulomb(&mut random);
        own.check().unwrap();
        let (law, flat) = (Law::Coulomb(own), random.coin());
        let mut state = law.initial_state(Local::zeros(), 0.0).unwrap();
        let mut mirrored = state;
        for _ in 0..100 {
            let jump = next(&own, &state, flat, &mut random);
            let mirror = Local::new(jump.x, -jump.y, -jump.z);
            // dilated faces may be unable to close so far
            let Ok(response) = law.respond(jump, &state, STEP) else {
                assert!(own.closure.is_some());
                wedged += 1;
                continue;
            };
            let Response {
                state: new, traction, stiffness, dissipation, dissipation_gradient, released, ..
            } = response;
            let all = stiffness.iter().chain(&dissipation_gradient).chain(&traction).chain(&new.jump_plastic);
            assert!(all.copied().all(f64::is_finite), "{own:?} {state:?} {jump:?} {response:?}");
            let size = size(&own, &state, &response);
            let outside = law.excess(&traction, &new.own);
            assert!(outside <= ROUNDING * size, "{outside:e} of {size:e}: {own:?} {state:?} {jump:?}");
            let energy = size * (jump - state.jump).amax();
            assert!(dissipation >= -ROUNDING * energy, "{dissipation:e}: {own:?} {state:?} {jump:?}");
            assert!(released >= -ROUNDING * energy, "{released:e}: {own:?} {state:?} {jump:?}");
            assert!((0..2).all(|k| new.own[k] >= state.own[k]), "{own:?} {state:?} {jump:?}");
            let other = law.respond(mirror, &mirrored, STEP).unwrap();
            let seen = Local::new(other.traction.x, -other.traction.y, -other.traction.z);
            assert!(
                (seen - traction).amax() <= ROUNDING * size,
                "{own:?} {state:?} {jump:?} {seen:?} {traction:?}"
            );
            let again = law.respond(jump, &new, STEP).unwrap();
            assert!((again.traction - traction).amax() <= ROUNDING * size, "{own:?} {new:?} {jump:?}");
            assert!(again.dissipation.abs() <= ROUNDING * energy, "{own:?} {new:?} {jump:?}");
            by_status[usize::from(new.status)] += 1;
            (state, mirrored, steps) = (new, other.state, steps + 1);
        }
    }
    println!("{by_status:?}, {wedged} wedged");
    assert!([0, 2, 4].iter().all(|&status| by_status[status] > STEPS / 20), "{by_status:?}");
    assert!(wedged < STEPS / 5);
}

#[test]
fn a_million_steps_of_elastic_joints_that_close() {
    let mut random = Random(32);
    let mut steps = 0;
    while steps < STEPS {
        let (kn, Some(closure)) = springs(&mut random) else { continue };
        let kt = kn * random.power(-2.0, 2.0);
        let own = Elastic { normal_stiffness: None, closure: Some(closure), tangential_stiffness: kt };
        let law = Law::Elastic(own);
        let initial =
            Local::new(-kn * closure.maximum * random.power(-2.0, 1.0), random.between(-1.0, 1.0), 0.0);
        let start = law.initial_state(initial, 0.0).unwrap();
        let mut state = start;
        for _ in 0..100 {
            let jump = next(&own, &state, false, &mut random);
            let response = law.respond(jump, &state, STEP).unwrap();
            let size = size(&own, &state, &response).max(size(&own, &start, &response));
            let u = jump.x - start.jump_plastic.x;
            let exact = if u < 0.0 { kn * u / (1.0 + u / closure.maximum) } else { kn * u };
            assert!((response.traction.x - exact).abs() <= ROUNDING * size, "{own:?} {state:?} {jump:?}");
            let shear = initial + jump * kt - response.traction;
            assert!(shear.y.abs().max(shear.z.abs()) <= ROUNDING * size, "{own:?} {state:?} {jump:?}");
            assert!(response.dissipation == 0.0 && response.released == 0.0);
            // the slope by central differences, away from the kink of its derivative at no traction
            let room = if u < 0.0 { closure.maximum + u } else { closure.maximum };
            let step = 1e-4 * room.min(u.abs());
            let at = |shift: f64| law.respond(jump + Local::x() * shift, &state, STEP).unwrap().traction.x;
            let slope = (at(step) - at(-step)) / (2.0 * step);
            let exact = response.stiffness[(0, 0)];
            let rounding = ROUNDING * size / step;
            assert!((slope - exact).abs() <= 1e-6 * exact + rounding, "{slope} {exact} {own:?} {jump:?}");
            (state, steps) = (response.state, steps + 1);
        }
    }
}
