//! Claim: the cohesive law spends its fracture energy whatever the softening and the mixity, its stiffness is a derivative on
//! every branch, and no way makes energy.

use crate::common::laws::{Random, close};
use crate::common::scene::cohesive;
use midplane::law::{
    Cohesive, Integration, Law, Local, LocalMatrix, MixedMode, N, NamedSoftening, PointLaw, Response,
    Softening, State,
};

const EXACT: Integration = Integration::Tolerance(1e-4);
const WORK: usize = 0;
/// Steps of a curve whose area is summed, in a geometric series.
const PARTS: usize = 30_000;
const DAMAGE: usize = 1;

/// A carbon composite in MPa and mm.
fn composite() -> Cohesive {
    Cohesive {
        normal_stiffness: 1e6,
        tangential_stiffness: 4e5,
        tensile_strength: 60.0,
        shear_strength: 90.0,
        fracture_energy_i: 0.3,
        fracture_energy_ii: 0.9,
        softening: Softening::Named(NamedSoftening::Linear),
        bilinear_knee: (0.25, 0.25),
        mixed_mode: MixedMode::BenzeggaghKenane(1.75),
        friction_coefficient: 0.0,
        viscosity: 0.0,
    }
}

fn softenings() -> Vec<Softening> {
    let named = [NamedSoftening::Linear, NamedSoftening::Bilinear, NamedSoftening::Exponential];
    let points = Softening::Points(vec![(0.0, 1.0), (0.1, 0.6), (0.35, 0.2), (1.0, 0.0)]);
    named.map(Softening::Named).into_iter().chain([points]).collect()
}

/// Answer of a law on a way; the load factor grows by `advance`.
fn answer(law: &Cohesive, jump: Local, old: &State, advance: f64) -> Response {
    law.respond_over(jump, old, EXACT, advance).unwrap()
}

/// ∫ t · dr of a way in n parts, by the trapezoidal rule; the state and the dissipation at its end.
fn follow(law: &Cohesive, state: &mut State, to: Local, parts: usize) -> [f64; 2] {
    let (from, mut sums) = (state.jump, [0.0; 2]);
    if from[N] * to[N] < 0.0 && parts > 1 {
        // faces meet or part: a step ends there
        let mut touch = from + (to - from) * (from[N] / (from[N] - to[N]));
        touch[N] = 0.0;
        let [a, b] = [follow(law, state, touch, parts), follow(law, state, to, parts)];
        return [a[0] + b[0], a[1] + b[1]];
    }
    for k in 1..=parts {
        let jump = from + (to - from) * (k as f64 / parts as f64);
        let response = answer(law, jump, state, f64::INFINITY);
        sums[0] += 0.5 * (response.traction + state.traction).dot(&(jump - state.jump));
        sums[1] += response.dissipation;
        *state = response.state;
    }
    sums
}

/// Share of shear in the work of a way at an angle.
fn share(law: &Cohesive, angle: f64) -> f64 {
    let (n, t) = (law.normal_stiffness * angle.cos().powi(2), law.tangential_stiffness * angle.sin().powi(2));
    t / (n + t)
}

#[test]
fn a_way_at_one_mixity_costs_the_energy_of_that_mixity() {
    let modes = [
        MixedMode::BenzeggaghKenane(1.0),
        MixedMode::BenzeggaghKenane(2.3),
        MixedMode::Power(1.0),
        MixedMode::Power(1.7),
    ];
    for softening in softenings() {
        for mixed_mode in modes {
            let law = Cohesive { softening: softening.clone(), mixed_mode, ..composite() };
            law.check().unwrap();
            for angle in [0.0, 0.3, 0.8, 1.2, 0.5 * std::f64::consts::PI] {
                let b = share(&law, angle);
                let [g1, g2] = [law.fracture_energy_i, law.fracture_energy_ii];
                let exact = match mixed_mode {
                    MixedMode::BenzeggaghKenane(eta) => g1 + (g2 - g1) * b.powf(eta),
                    MixedMode::Power(alpha) => {
                        1.0 / (((1.0 - b) / g1).powf(alpha) + (b / g2).powf(alpha)).powf(1.0 / alpha)
                    }
                };
                let far = Local::new(angle.cos(), angle.sin(), 0.0) * 0.6;
                let what = format!("{softening:?} {mixed_mode:?} {angle}");
                // at one go, and in many steps along a curve whose area is summed
                let one = answer(&law, far, &State::default(), f64::INFINITY);
                close(one.dissipation / exact, 1.0, 1e-9, &what);
                let mut state = State::default();
                let onset = law.onset_or_on(far, &state).unwrap();
                let [mut work, mut spent] = follow(&law, &mut state, far * onset, 1);
                for k in 1..=PARTS {
                    let part = onset.powf(1.0 - k as f64 / PARTS as f64);
                    let more = follow(&law, &mut state, far * part, 1);
                    (work, spent) = (work + more[0], spent + more[1]);
                }
                close(work / exact, 1.0, 1e-6, &what);
                close(spent / exact, 1.0, 1e-9, &what);
                close(state.own[WORK] / exact, 1.0, 1e-9, &what);
            }
        }
    }
}

#[test]
fn the_curve_is_the_one_that_was_drawn() {
    // σ(w) in mode I, w = u − σ/K, of each softening with its own closed form
    let law = composite();
    let [f, g, k] = [law.tensile_strength, law.fracture_energy_i, law.normal_stiffness];
    type Shape = fn(f64) -> f64; // share of the strength at w f/G
    let shapes: [(Softening, Shape); 4] = [
        (Softening::Named(NamedSoftening::Linear), |x| (1.0 - x / 2.0).max(0.0)),
        (Softening::Named(NamedSoftening::Bilinear), |x| match x / 4.0 {
            w if w < 0.25 => 1.0 - 3.0 * w,
            w => (0.25 * (1.0 - w) / 0.75).max(0.0),
        }),
        (Softening::Named(NamedSoftening::Exponential), |x| (-x).exp()),
        // Petersson: a knee at a third of the strength and 0.8 G/f, the end at 3.6 G/f
        (Softening::Points(vec![(0.0, 1.0), (0.8, 1.0 / 3.0), (3.6, 0.0)]), |x| match x {
            w if w < 0.8 => 1.0 - w / 1.2,
            w => ((3.6 - w) / 8.4).max(0.0),
        }),
    ];
    for (softening, shape) in shapes {
        let law = Cohesive { softening: softening.clone(), ..law.clone() };
        for x in [0.01, 0.3, 0.7, 1.1, 1.9, 2.7, 3.5, 3.7] {
            let sigma = f * shape(x);
            let jump = Local::new(x * g / f + sigma / k, 0.0, 0.0);
            let response = answer(&law, jump, &State::default(), f64::INFINITY);
            close(response.traction[N], sigma, 1e-9 * f, &format!("{softening:?} at {x}"));
        }
        // onset at the strength, not before
        let jump = |part: f64| Local::new(part * f / k, 0.0, 0.0);
        assert_eq!(answer(&law, jump(1.0 - 1e-12), &State::default(), f64::INFINITY).state.own[DAMAGE], 0.0);
        assert!(answer(&law, jump(1.0 + 1e-9), &State::default(), f64::INFINITY).state.own[DAMAGE] > 0.0);
        close(law.onset_or_on(jump(4.0), &State::default()).unwrap(), 0.25, 1e-12, "onset");
    }
}

/// A random law that may be asked.
fn random_law(random: &mut Random) -> Cohesive {
    loop {
        let softenings = softenings();
        let softening = softenings[random.between(0.0, softenings.len() as f64) as usize].clone();
        let tensile_strength = random.power(-0.5, 2.0);
        let mixed_mode = match random.coin() {
            true => MixedMode::BenzeggaghKenane(random.between(1.0, 3.0)),
            false => MixedMode::Power(random.between(1.0, 3.0)),
        };
        let energy = random.power(-4.0, 0.0);
        let kn = tensile_strength * tensile_strength / energy * random.power(0.3, 3.5);
        let law = Cohesive {
            normal_stiffness: kn,
            tangential_stiffness: kn * random.power(-1.0, 0.5),
            tensile_strength,
            shear_strength: tensile_strength * random.power(-0.3, 1.0),
            fracture_energy_i: energy,
            fracture_energy_ii: energy * random.power(-0.3, 1.3),
            softening,
            bilinear_knee: (random.between(0.1, 0.6), random.between(0.1, 0.6)),
            mixed_mode,
            friction_coefficient: if random.coin() { 0.0 } else { random.between(0.1, 1.2) },
            viscosity: if random.between(0.0, 1.0) < 0.7 { 0.0 } else { random.power(-3.0, 0.0) },
        };
        if law.check().is_ok() {
            return law;
        }
    }
}

/// One that is soft enough for its elastic branch to be resolved.
fn soft_law(random: &mut Random) -> Cohesive {
    loop {
        let law = random_law(random);
        let soften = |strength: f64, energy: f64, times: f64| times * strength * strength / energy;
        let law = Cohesive {
            normal_stiffness: soften(law.tensile_strength, law.fracture_energy_i, random.between(4.0, 30.0)),
            tangential_stiffness: soften(
                law.shear_strength,
                law.fracture_energy_ii,
                random.between(4.0, 30.0),
            ),
            viscosity: 0.0,
            ..law
        };
        if law.check().is_ok() {
            return law;
        }
    }
}

/// A jump of the size at which things happen: onset, softening, contact.
fn random_jump(law: &Cohesive, random: &mut Random, space: bool) -> Local {
    let opening = 3.0 * law.fracture_energy_i / law.tensile_strength;
    let slip = 3.0 * law.fracture_energy_ii / law.shear_strength;
    let size = random.power(-2.5, 0.5);
    let n = match random.between(0.0, 1.0) < 0.35 {
        true => -random.power(-1.0, 2.0) * law.tensile_strength / law.normal_stiffness,
        false => opening * size * random.between(0.0, 1.0),
    };
    let s = if space { slip * size * random.between(-1.0, 1.0) } else { 0.0 };
    Local::new(n, slip * size * random.between(-1.0, 1.0), s)
}

/// Largest error of a derivative by central differences, of the whole matrix, at the better of two steps.
fn off(law: &Cohesive, jump: Local, old: &State, advance: f64) -> [f64; 2] {
    let here = answer(law, jump, old, advance);
    let components = if old.jump[2] == 0.0 && jump[2] == 0.0 { 2 } else { 3 };
    let mut best = [f64::INFINITY; 2];
    for relative in [1e-4, 1e-5, 1e-6, 1e-7] {
        let mut worst = [0.0_f64; 2];
        for c in 0..components {
            let h = relative * if jump[c] == 0.0 { (jump - old.jump).norm() } else { jump[c].abs() };
            let mut step = Local::zeros();
            step[c] = h;
            let [ahead, behind] = [jump + step, jump - step].map(|jump| answer(law, jump, old, advance));
            let slope = (ahead.traction - behind.traction) / (2.0 * h);
            let scale = here.stiffness.amax().max(slope.amax());
            worst[0] = worst[0].max((slope - here.stiffness.column(c)).amax() / scale);
            let spent = (ahead.dissipation - behind.dissipation) / (2.0 * h);
            let size = here.dissipation_gradient.amax().max(here.traction.amax()).max(spent.abs());
            worst[1] = worst[1].max((spent - here.dissipation_gradient[c]).abs() / size);
            // damage counts as the part of the traction that it takes
            let damaged = (ahead.state.own[DAMAGE] - behind.state.own[DAMAGE]) / (2.0 * h);
            let undamaged = law.normal_stiffness * jump.amax();
            worst[1] = worst[1].max((damaged - here.damage_gradient[c]).abs() * undamaged / scale);
        }
        best = [best[0].min(worst[0]), best[1].min(worst[1])];
    }
    best
}

#[test]
fn the_stiffness_is_the_derivative_on_every_branch() {
    let mut random = Random(20);
    let (mut by_status, mut kinks, mut asked) = ([0; 7], 0, 0);
    while asked < 20_000 {
        let law = random_law(&mut random);
        let space = random.coin();
        let mut state = State::default();
        for _ in 0..4 {
            let jump = random_jump(&law, &mut random, space);
            let advance = if law.viscosity > 0.0 { random.power(-3.0, 0.0) } else { f64::INFINITY };
            let response = answer(&law, jump, &state, advance);
            let errors = off(&law, jump, &state, advance);
            // a difference across a kink says nothing; there are few
            if errors[0] > 1e-4 || errors[1] > 1e-4 {
                kinks += 1;
                if std::env::var("SHOW").is_ok() {
                    println!("{errors:?} {:?} {law:?} {state:?} {jump:?}", response.state);
                }
            }
            by_status[usize::from(response.state.status)] += 1;
            state = response.state;
            asked += 1;
        }
    }
    assert!(kinks * 500 < asked, "{kinks} of {asked}");
    for status in [0, 1, 2, 4, 5, 6] {
        assert!(by_status[status] > 100, "{by_status:?}");
    }
}

#[test]
fn a_million_random_steps_keep_every_promise() {
    let mut random = Random(21);
    let mut steps = 0;
    while steps < 1_000_000 {
        let law = random_law(&mut random);
        let space = random.coin();
        let [mut state, mut mirrored] = [State::default(); 2];
        for _ in 0..20 {
            let jump = random_jump(&law, &mut random, space);
            let advance = if law.viscosity > 0.0 { random.power(-4.0, 0.0) } else { f64::INFINITY };
            let response = answer(&law, jump, &state, advance);
            let Response { traction, stiffness, state: new, dissipation, dissipation_gradient, .. } =
                response;
            let finite = |v: &Local| v.iter().all(|x| x.is_finite());
            assert!(
                finite(&traction) && finite(&dissipation_gradient),
                "{law:?} {state:?} {jump:?} {response:?}"
            );
            assert!(stiffness.iter().all(|x| x.is_finite()), "{law:?} {state:?} {jump:?} {response:?}");
            assert!(dissipation >= 0.0, "{law:?} {state:?} {jump:?} {response:?}");
            assert!(new.own[WORK] >= state.own[WORK] && new.own[DAMAGE] >= state.own[DAMAGE]);
            assert!(new.own[DAMAGE] <= 1.0 && law.stored(&new) >= 0.0);
            assert!(jump[N] <= 0.0 || traction[N] >= 0.0);
            assert!(jump[N] >= 0.0 || traction[N] <= 0.0);
            // a step repeated changes nothing
            if law.viscosity == 0.0 {
                let again = answer(&law, jump, &new, f64::INFINITY);
                assert!(
                    (again.traction - traction).amax() <= 1e-9 * traction.amax(),
                    "{law:?} {state:?} {jump:?} {response:?} {again:?}"
                );
                assert!(again.dissipation <= 1e-9 * law.fracture_energy_i.max(new.own[WORK]));
            }
            // the mirrored way has the mirrored answer
            let mirror = |v: Local| Local::new(v[N], -v[1], -v[2]);
            let other = answer(&law, mirror(jump), &mirrored, advance);
            assert_eq!(mirror(other.traction), traction);
            (state, mirrored) = (new, other.state);
            steps += 1;
        }
    }
}

#[test]
fn what_is_not_stored_is_dissipated_to_second_order() {
    let mut random = Random(22);
    let (mut rates, mut asked) = (Vec::new(), 0);
    while asked < 60 {
        let law = soft_law(&mut random);
        let places: Vec<Local> = (0..4).map(|_| random_jump(&law, &mut random, true)).collect();
        let mut errors = [50, 100, 200, 400, 800].map(|parts| {
            let (mut state, mut left, mut passed) = (State::default(), 0.0, 0.0);
            for place in &places {
                let stored = law.stored(&state);
                let [work, spent] = follow(&law, &mut state, *place, parts);
                left += work - (law.stored(&state) - stored) - spent;
                passed += work.abs();
            }
            left.abs() / passed
        });
        asked += 1;
        assert!(errors[4] < 2e-3, "{errors:?} {law:?} {places:?}");
        errors.iter_mut().for_each(|error| *error = error.max(1e-12));
        rates.push((errors[0] / errors[4]).ln() / 16f64.ln());
    }
    rates.sort_by(f64::total_cmp);
    assert!(rates[rates.len() / 2] > 1.6, "{rates:?}");
}

#[test]
fn a_cycle_makes_no_energy() {
    let mut random = Random(23);
    for _ in 0..300 {
        let law = soft_law(&mut random);
        let mut state = State::default();
        let start = random_jump(&law, &mut random, true);
        follow(&law, &mut state, start, 2000);
        let before = law.stored(&state);
        let mut work = 0.0;
        let mut passed = 0.0;
        for _ in 0..5 {
            let place = random_jump(&law, &mut random, true);
            let [more, _] = follow(&law, &mut state, place, 2000);
            work += more;
            passed += more.abs();
        }
        work += follow(&law, &mut state, start, 2000)[0];
        let left = law.stored(&state) - before;
        assert!(work - left >= -1e-3 * passed, "{work:e} {left:e} {passed:e} {law:?}");
    }
}

#[test]
fn what_is_broken_rubs_as_coulomb_says() {
    let law = Cohesive { friction_coefficient: 0.6, ..composite() };
    let mut state = State::default();
    follow(&law, &mut state, Local::new(0.1, 0.0, 0.0), 1); // open and free
    assert_eq!((state.traction, state.status, state.own[DAMAGE]), (Local::zeros(), 4, 1.0));
    follow(&law, &mut state, Local::new(-1e-4, 0.0, 0.0), 1);
    close(state.traction[N], -100.0, 1e-10, "contact");
    assert_eq!(state.status, 5);
    // sticks with K_T up to μ |σ|, then slides; what it takes is dissipated
    follow(&law, &mut state, Local::new(-1e-4, 1e-4, 0.0), 1);
    close(state.traction[1], 40.0, 1e-10, "stick");
    let [_, spent] = follow(&law, &mut state, Local::new(-1e-4, 1e-2, 0.0), 1);
    close(state.traction[1], 60.0, 1e-10, "slip");
    assert_eq!(state.status, 2);
    close(spent, 60.0 * (1e-2 - 60.0 / 4e5), 1e-12, "dissipation of slip");
    // back: elastic for 2 μ |σ|/K_T
    follow(&law, &mut state, Local::new(-1e-4, 1e-2 - 2.0e-4, 0.0), 1);
    close(state.traction[1], -20.0, 1e-10, "back");
    // shear from intact to broken under compression ends in friction too, in one step as in many
    for parts in [1, 7, 1000] {
        let mut state = State::default();
        follow(&law, &mut state, Local::new(-1e-4, 0.0, 0.0), 1);
        follow(&law, &mut state, Local::new(-1e-4, 0.1, 0.0), parts);
        close(state.traction[1], 60.0, 1e-9, "residual shear");
        close(state.own[WORK], law.fracture_energy_ii, 1e-9, "energy of mode II");
    }
}

#[test]
fn viscosity_goes_to_the_answer_without_it_with_rate_one() {
    let plain = composite();
    let (opened, steps) = (Local::new(6e-3, 4e-3, 0.0), 4000);
    let run = |law: &Cohesive| {
        let (mut state, mut spent, mut work) = (State::default(), 0.0, 0.0);
        for k in 1..=steps {
            let old = state;
            let response = answer(law, opened * (k as f64 / steps as f64), &old, 1.0 / steps as f64);
            spent += response.dissipation;
            work += 0.5 * (response.traction + old.traction).dot(&(response.state.jump - old.jump));
            state = response.state;
        }
        (state, spent, work - law.stored(&state))
    };
    let (exact, ..) = run(&plain);
    let mut errors = Vec::new();
    for eta in [2e-2, 1e-2, 5e-3, 2.5e-3] {
        let (state, spent, work) = run(&Cohesive { viscosity: eta, ..plain.clone() });
        errors.push((state.traction - exact.traction).norm() / exact.traction.norm());
        close(spent / work, 1.0, 2e-3, "all that is not stored is dissipated");
        let more = spent - exact.own[WORK];
        // the overstress has done what the point without viscosity has not spent, up to what both have stored
        assert!(state.own[3] > 0.0 && more.abs() < 1.2 * state.own[3], "{more:e} {:e}", state.own[3]);
    }
    for pair in errors.windows(2) {
        close((pair[0] / pair[1]).log2(), 1.0, 0.15, &format!("rate of {errors:?}"));
    }
    // and a point that waits loses what it would have lost without viscosity
    let late = Cohesive { viscosity: 0.1, ..plain.clone() };
    let mut state = answer(&late, opened, &State::default(), 0.01).state;
    for _ in 0..400 {
        state = answer(&late, opened, &state, 0.05).state;
    }
    close(state.own[DAMAGE], exact.own[DAMAGE], 1e-9, "damage at rest");
    assert_eq!(answer(&late, opened, &State::default(), 0.0).state.own[DAMAGE], 0.0);
}

#[test]
fn space_is_the_plane_turned() {
    let mut random = Random(24);
    for _ in 0..2000 {
        let law = random_law(&mut random);
        let angle = random.between(0.0, 6.0);
        let (c, s) = (angle.cos(), angle.sin());
        let turn = LocalMatrix::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c);
        let [mut flat, mut turned] = [State::default(); 2];
        for _ in 0..6 {
            let jump = random_jump(&law, &mut random, false);
            let advance = random.power(-3.0, 0.0);
            let (a, b) = (answer(&law, jump, &flat, advance), answer(&law, turn * jump, &turned, advance));
            let size = a.traction.amax().max(law.tensile_strength);
            close((turn * a.traction - b.traction).amax() / size, 0.0, 1e-7, "traction");
            close(a.dissipation, b.dissipation, 1e-7 * law.fracture_energy_ii, "dissipation");
            (flat, turned) = (a.state, b.state);
        }
    }
}

#[test]
fn what_no_point_can_follow_is_refused() {
    let refused = |law: Cohesive| {
        let why = law.check().unwrap_err();
        (why.key, why.what)
    };
    let soft = Cohesive { normal_stiffness: 5e3, ..composite() };
    let soft_help = soft.check().unwrap_err().help;
    let (key, what) = refused(soft);
    assert!(key == "normal_stiffness" && what.contains("pure tension"), "{key}: {what}");
    // linear softening: K_N > f²/(2 G), here 6000
    assert!(soft_help.contains("6.000e3"), "{soft_help}");
    assert!(Cohesive { normal_stiffness: 6001.0, ..composite() }.check().is_ok());
    let (key, _) = refused(Cohesive { tangential_stiffness: 4e3, ..composite() });
    assert_eq!(key, "tangential_stiffness");
    assert_eq!(refused(Cohesive { mixed_mode: MixedMode::Power(0.5), ..composite() }).0, "mixed_mode");
    for points in [vec![(0.0, 1.0), (1.0, 0.1)], vec![(0.0, 1.0), (1.0, 0.5), (0.5, 0.0)], vec![(0.0, 1.0)]] {
        assert_eq!(refused(Cohesive { softening: Softening::Points(points), ..composite() }).0, "softening");
    }
    let crack = Law::Cohesive(composite());
    let pulled = crack.initial_state(Local::new(3.0, 0.0, 0.0), 0.0).unwrap();
    assert_eq!(crack.damaged(pulled, 0.5).unwrap_err().key, "initial_damage");
    assert_eq!(crack.damaged(State::default(), 1.5).unwrap_err().key, "initial_damage");
    let half = crack.damaged(State::default(), 0.5).unwrap();
    close(half.own[WORK], 0.15, 1e-15, "half of the energy");
    let rest = crack.respond(Local::new(1.0, 0.0, 0.0), &half, EXACT).unwrap();
    close(rest.dissipation, 0.15, 1e-12, "what is left of it");
    let stated = cohesive(1e6, 4e5, [60.0, 90.0], [0.3, 0.9])
        .with("softening", vec![[0.0, 1.0], [0.02, 0.0]])
        .with_in("mixed_mode", "benzeggagh_kenane", 1.75);
    let law: Law = serde_json::from_value(stated.into()).unwrap();
    law.check().unwrap();
    assert!(law.warnings()[0].what.contains("6.0000e-1")); // 60 · 0.02/2
}

/// Claim: a traction at the start that the criterion √((σ/f_t)² + (τ/f_s)²) ≤ 1 does not allow is refused, also of a point that has lost
/// a share of its energy, whose strength is 1 − D of that; pressure is carried whatever is lost.
#[test]
fn tractions_at_the_start_stay_within_the_strength() {
    let law = Law::Cohesive(composite());
    let refused = |t: Local| law.initial_state(t, 0.0).err().map(|fault| fault.key);
    for (n, t) in [(60.0, 0.0), (0.0, 90.0), (36.0, 72.0)] {
        assert_eq!(refused(Local::new(0.999 * n, 0.999 * t, 0.0)), None, "{n} {t}");
        assert_eq!(refused(Local::new(1.001 * n, 1.001 * t, 0.0)), Some("initial_traction"), "{n} {t}");
    }
    let shear = |t: f64| law.initial_state(Local::new(-5.0, t, 0.0), 0.0).unwrap();
    assert!(law.damaged(shear(0.0), 1.0).is_ok());
    assert_eq!(law.damaged(shear(80.0), 0.9).unwrap_err().key, "initial_damage");
    // what is lost rubs: wholly lost, μ σ is carried and no more
    let law = Law::Cohesive(Cohesive { friction_coefficient: 0.5, ..composite() });
    let pressed = |t: f64| law.initial_state(Local::new(-100.0, t, 0.0), 0.0).unwrap();
    assert!(law.damaged(pressed(49.9), 1.0).is_ok());
    assert_eq!(law.damaged(pressed(50.1), 1.0).unwrap_err().key, "initial_damage");
}
