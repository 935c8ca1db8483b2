//! Claim: the Coulomb law is exact along a straight way of the jump, whatever happens on it.
//!
//! ```text
//! parts     one way in 1, 3 or 17 parts: the same traction, irreversible jump, ∑ dissipation, ∑ released
//! energy    ∫ t · dr = Δ(∫ σ du + τ²/2K_T) + dissipation + released, by adaptive quadrature of the tractions alone
//! smooth    the traction is continuous in the end of the way, but for the drop of the cohesion
//! gradient  stiffness and dissipation gradient are central differences
//! limit     n steps of backward Euler tend to it as 1/n
//! ```
//!
//! With linear springs and with a closure, on which slip may stop within a way. Random laws, states and ways from a fixed seed; starts touching, on the surface, open, sticking; ways along an axis
//! too. Every sequence of events is counted, so that none is left out.

use crate::common::laws::Random;
use midplane::law::{
    Closure, Coulomb, Integration, Law, Local, LossOfCohesion, N, PointLaw, Response, State, T,
};
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

const OPEN: u8 = 4;

fn respond(law: &Coulomb, jump: Local, old: &State) -> Response {
    answer(law, jump, old).unwrap()
}

/// None where dilated faces would close further than they can.
fn answer(law: &Coulomb, jump: Local, old: &State) -> Option<Response> {
    Law::Coulomb(*law).respond(jump, old, Integration::Tolerance(1e-4)).ok()
}

/// A law, a state that a few steps lead to, and the end of a way from there.
struct Case {
    law: Coulomb,
    old: State,
    end: Local,
}

impl Case {
    fn random(random: &mut Random, closing: bool) -> Case {
        let kn = random.power(3.0, 6.0);
        let closure = Closure { initial_stiffness: kn, maximum: random.power(-1.5, 1.0) / kn };
        let mu = if random.between(0.0, 1.0) < 0.1 { 0.0 } else { random.between(0.0, 2.0) };
        let law = Coulomb {
            normal_stiffness: (!closing).then_some(kn),
            closure: closing.then_some(closure),
            tangential_stiffness: kn * random.power(-2.0, 2.0),
            friction_coefficient: mu,
            cohesion: if random.coin() { 0.0 } else { random.between(0.0, 2.0) },
            dilatancy: if random.coin() { 0.0 } else { random.between(0.0, mu) },
            dilatancy_end: if random.coin() { None } else { Some(random.power(-1.0, 1.5) / kn) },
            cohesion_lost: LossOfCohesion::Never,
        };
        law.check().unwrap();
        let gap = if random.coin() { 0.0 } else { random.between(0.0, 2.0) / kn };
        let mut old = Law::Coulomb(law).initial_state(Local::zeros(), gap).unwrap();
        for _ in 0..random.between(0.0, 5.0) as usize {
            old = respond(&law, next(&law, &old, random), &old).state;
        }
        let end = next(&law, &old, random);
        Case { law, old, end }
    }

    fn at(&self, s: f64) -> Local {
        self.old.jump + s * (self.end - self.old.jump)
    }

    /// Size of tractions: stiffness times jump, with a closure the stiffness of its ends.
    fn stress(&self) -> f64 {
        let size = self.reach(&[self.old.jump, self.old.jump_plastic, self.end]);
        let Some(Closure { initial_stiffness: k, maximum: v }) = self.law.closure else { return size };
        let end = respond(&self.law, self.end, &self.old).traction.x;
        let steep = |sigma: f64| k * v * (1.0 - sigma / (k * v)).powi(2);
        size.max(steep(self.old.traction.x)).max(steep(end))
    }

    fn reach(&self, jumps: &[Local]) -> f64 {
        let [kn, kt, _] = self.law.elastic_stiffness();
        let cohesion = self.law.cohesion;
        jumps.iter().fold(cohesion, |size, jump| size.max(kn * jump.x.abs()).max(kt * jump.y.abs()))
    }

    /// Size of jumps.
    fn length(&self) -> f64 {
        let [kn, kt, _] = self.law.elastic_stiffness();
        self.stress() / kn.min(kt)
    }

    /// Name of the sequence of events.
    fn sequence(&self) -> String {
        let start = if self.old.jump.x > self.old.jump_plastic.x { "open" } else { "closed" };
        let response = respond(&self.law, self.end, &self.old);
        let slips = if response.dissipation > 0.0 { " slip" } else { "" };
        let end = ["stick", "", "slides", "", "open"][usize::from(response.state.status)];
        let drop = if response.released > 0.0 { " drop" } else { "" };
        format!("{start}{slips}{drop} {end}")
    }
}

/// A jump around the irreversible one or the present one, or in a line with the present one along an axis; no nearer than a
/// part of the closure.
fn next(law: &Coulomb, old: &State, random: &mut Random) -> Local {
    let way = random.direction() * random.power(-1.5, 1.5);
    let [kn, kt, _] = law.elastic_stiffness();
    let way = Local::new(way.x / kn, way.y / kt, 0.0);
    let end = match random.between(0.0, 10.0) as usize {
        0 => old.jump + Local::new(way.x, 0.0, 0.0),
        1 => old.jump + Local::new(0.0, way.y, 0.0),
        2..6 => old.jump + way,
        _ => old.jump_plastic + way,
    };
    let least = old.jump_plastic.x + 0.9 * law.narrowest();
    let end = Local::new(end.x.max(least), end.y, 0.0);
    let all = [LossOfCohesion::Never, LossOfCohesion::AtSlip];
    let can = |cohesion_lost| answer(&Coulomb { cohesion_lost, ..*law }, end, old).is_some();
    if end != old.jump && all.into_iter().all(can) { end } else { next(law, old, random) }
}

/// Checks `count` random cases with linear springs and as many with a closure; `check` returns false for those it cannot judge.
fn cases(seed: u64, count: usize, mut check: impl FnMut(&Case) -> bool) {
    for closing in [false, true] {
        cases_of(Random(seed), count, closing, &mut check);
    }
}

fn cases_of(mut random: Random, count: usize, closing: bool, check: &mut impl FnMut(&Case) -> bool) {
    let (mut counts, mut left_out) = (BTreeMap::new(), 0);
    for _ in 0..count {
        let case = Case::random(&mut random, closing);
        if check(&case) {
            *counts.entry(case.sequence()).or_insert(0) += 1;
        } else {
            left_out += 1;
        }
    }
    println!("{counts:?}, left out {left_out}");
    let sequences = [
        "closed stick",
        "closed slip slides",
        "closed open",
        "closed drop open",
        "closed slip open",
        "closed slip drop open",
        "open open",
        "open stick",
        "open slip slides",
    ];
    for sequence in sequences {
        assert!(counts.get(sequence).is_some_and(|&n| n >= count / 200), "{sequence}: {counts:?}");
    }
    let stops = counts.get("closed slip stick").copied().unwrap_or(0);
    assert!(if closing { stops >= count / 200 } else { stops == 0 }, "slip that stops: {counts:?}");
    assert!(left_out <= count / 20, "{left_out} left out");
}

#[test]
fn the_parts_of_a_way_make_no_difference() {
    let mut worst = [0.0_f64; 4];
    cases(1, 6000, |case| {
        for (parts, cohesion_lost) in [
            (3, LossOfCohesion::Never),
            (17, LossOfCohesion::Never),
            (3, LossOfCohesion::AtSlip),
            (17, LossOfCohesion::AtSlip),
        ] {
            let case = &Case { law: Coulomb { cohesion_lost, ..case.law }, ..*case };
            let whole = respond(&case.law, case.end, &case.old);
            let (mut state, mut dissipated, mut released) = (case.old, 0.0, 0.0);
            for part in 1..=parts {
                let response = respond(&case.law, case.at(part as f64 / parts as f64), &state);
                dissipated += response.dissipation;
                released += response.released;
                state = response.state;
            }
            let (stress, length) = (case.stress(), case.length());
            let off = [
                (state.traction - whole.traction).amax() / stress,
                (state.jump_plastic - whole.state.jump_plastic).amax() / length,
                (dissipated - whole.dissipation).abs() / (stress * length),
                (released - whole.released).abs() / (stress * length),
            ];
            assert!(off.iter().all(|&off| off <= 1e-12), "{parts} parts: {off:?}, {}", case.sequence());
            worst = std::array::from_fn(|i| worst[i].max(off[i]));
        }
        true
    });
    println!(
        "worst differences of traction, irreversible jump, dissipation, released: {:?}",
        worst.map(|off| format!("{off:.1e}"))
    );
}

/// ∫ t · dr over a part of the way by Lobatto's rule, halved until that changes nothing.
fn work(case: &Case, [from, to]: [f64; 2], whole: f64) -> f64 {
    let middle = 0.5 * (from + to);
    let halves = [[from, middle], [middle, to]].map(|half| lobatto(case, half));
    let quarters: f64 =
        (0..4).map(|k| lobatto(case, [k, k + 1].map(|k| from + 0.25 * k as f64 * (to - from)))).sum();
    let size = 1e-15 * case.stress() * case.length();
    let settled = [halves[0] + halves[1], quarters].map(|sum| (sum - whole).abs() <= size);
    if settled == [true; 2] || to - from < 1e-15 {
        return quarters;
    }
    work(case, [from, middle], halves[0]) + work(case, [middle, to], halves[1])
}

/// Lobatto's five points, both ends among them: a drop near an end is seen.
fn lobatto(case: &Case, [from, to]: [f64; 2]) -> f64 {
    let inner = (3.0_f64 / 7.0).sqrt();
    let points = [(0.0, 32.0 / 45.0), (inner, 49.0 / 90.0), (-inner, 49.0 / 90.0), (1.0, 0.1), (-1.0, 0.1)];
    let way = case.at(to) - case.at(from);
    let power = |(x, weight): (f64, f64)| {
        let s = 0.5 * (from + to) + 0.5 * x * (to - from);
        0.5 * weight * respond(&case.law, case.at(s), &case.old).traction.dot(&way)
    };
    points.into_iter().map(power).sum()
}

#[test]
fn the_work_along_a_way_is_stored_dissipated_or_released() {
    let mut worst = 0.0_f64;
    cases(2, 3000, |case| {
        let whole = respond(&case.law, case.end, &case.old);
        let [kn, kt, _] = case.law.elastic_stiffness();
        // x − 1 − ln x, x = 1 + u/V = 1/(1 − σ/(K V))
        let pressed = |sigma: f64| match case.law.closure {
            Some(Closure { maximum: v, .. }) => {
                kn * v * v * (1.0 / (1.0 - sigma / (kn * v)) - 1.0 + (-sigma / (kn * v)).ln_1p())
            }
            None => 0.5 * sigma * sigma / kn,
        };
        let stored = |t: Local| pressed(t.x) + 0.5 * t.y * t.y / kt;
        let spent = stored(whole.traction) - stored(case.old.traction) + whole.dissipation + whole.released;
        let pieces = 8;
        let worked: f64 = (0..pieces)
            .map(|k| {
                let piece = [k as f64 / pieces as f64, (k + 1) as f64 / pieces as f64];
                work(case, piece, lobatto(case, piece))
            })
            .sum();
        let off = (worked - spent).abs() / (case.stress() * case.length());
        assert!(off <= 1e-12, "{off:.1e}: {worked:e}, accounted for {spent:e}, {}", case.sequence());
        assert!(whole.dissipation >= 0.0 && whole.released >= 0.0);
        assert!(whole.state.status != OPEN || whole.state.jump_plastic.y == case.end.y);
        let (sigma, tau) = (whole.traction.x, whole.traction.y);
        let excess = tau.abs() + case.law.friction_coefficient * sigma - case.law.cohesion;
        assert!(sigma <= 0.0 && (excess <= 1e-14 * case.stress() || tau == 0.0), "{excess}");
        worst = worst.max(off);
        true
    });
    println!("worst difference {worst:.1e}");
}

#[test]
fn only_cohesion_drops_at_once() {
    let mut random = Random(6);
    let mut drops = 0;
    cases(5, 3000, |case| {
        let (first, other) = (case.end, next(&case.law, &case.old, &mut random));
        let at = |part: f64| first + part * (other - first);
        if !(0..=1000).all(|k| answer(&case.law, at(k as f64 / 1000.0), &case.old).is_some()) {
            return false;
        }
        let answer = |part: f64| respond(&case.law, at(part), &case.old);
        let change = |[from, to]: [f64; 2]| (answer(from).traction - answer(to).traction).amax();
        for piece in 0..10 {
            let mut ends = [piece as f64 / 10.0, (piece + 1) as f64 / 10.0];
            for _ in 0..50 {
                let middle = 0.5 * (ends[0] + ends[1]);
                let halves = [[ends[0], middle], [middle, ends[1]]];
                ends = if change(halves[0]) > change(halves[1]) { halves[0] } else { halves[1] };
            }
            let open = ends.map(|part| answer(part).state.status == OPEN);
            if case.law.cohesion > 0.0 && open[0] != open[1] {
                drops += 1;
                continue;
            }
            let size = case.stress() + case.reach(&[other]);
            assert!(change(ends) <= 1e-11 * size, "{:.1e}: {}", change(ends) / size, case.sequence());
        }
        true
    });
    println!("drops {drops}");
    assert!(drops > 100);
}

/// Differences (f(r + δ) − f(r)) / δ of traction and dissipation, by rows σ, τ, D and columns n, t, s.
fn quotient(case: &Case, step: f64) -> Option<Matrix3<f64>> {
    let answer = |jump| {
        let response = answer(&case.law, jump, &case.old)?;
        Some(Vector3::new(response.traction.x, response.traction.y, response.dissipation))
    };
    let here = answer(case.end)?;
    let [n, t, s] = [Local::x(), Local::y(), Local::z()].map(|axis| answer(case.end + axis * step));
    Some(Matrix3::from_columns(&[n?, t?, s?].map(|there| (there - here) / step)))
}

#[test]
fn stiffness_and_gradient_are_derivatives() {
    let mut worst = [0.0_f64; 2];
    cases(3, 20_000, |case| {
        let lost = if case.end.y.to_bits() % 2 == 0 { LossOfCohesion::Never } else { LossOfCohesion::AtSlip };
        let case = &Case { law: Coulomb { cohesion_lost: lost, ..case.law }, ..*case };
        let whole = respond(&case.law, case.end, &case.old);
        let way = (case.end - case.old.jump).amax();
        let length = case.law.closure.map_or(way, |Closure { initial_stiffness: k, maximum: v }| {
            way.min(v / (1.0 - whole.traction.x / (k * v))) // of what is left of the closure
        });
        let [kn, kt, _] = case.law.elastic_stiffness();
        let stiffest = kn.max(kt).max(whole.stiffness.amax());
        let size =
            Vector3::new(stiffest, stiffest, stiffest * way + whole.traction.amax() + case.law.cohesion);
        let relative = |m: Matrix3<f64>| Matrix3::from_fn(|i, j| m[(i, j)] / size[i]);
        let pair = |step: f64| {
            let [plus, minus] = [quotient(case, step * length)?, quotient(case, -step * length)?];
            Some((relative(0.5 * (plus + minus)), relative(plus - minus)))
        };
        let (Some(coarse), Some(fine)) = (pair(1e-5), pair(5e-6)) else { return false };
        // a kink has no derivative: one within the stencil changes the mean, one at its centre leaves the difference
        let kink = (coarse.0 - fine.0).amax() > 1e-8 || fine.1.amax() > 0.6 * coarse.1.amax() + 1e-8;
        // no shear strength and no shear: a kink on either side
        let cohesion = if lost == LossOfCohesion::AtSlip { 0.0 } else { case.law.cohesion };
        let frictionless = case.law.friction_coefficient + cohesion == 0.0;
        if kink || frictionless && case.end.y == case.old.jump.y {
            return false;
        }
        let [sigma, tau] = [N, T].map(|i| whole.stiffness.row(i).into_owned());
        let exact = Matrix3::from_rows(&[sigma, tau, whole.dissipation_gradient.transpose()]);
        let off = (relative(exact) - fine.0).abs();
        let off = [off.rows(0, 2).max(), off.row(2).max()];
        assert!(off.iter().all(|&off| off <= 1e-7), "{off:?}: {}", case.sequence());
        worst = std::array::from_fn(|i| worst[i].max(off[i]));
        true
    });
    println!(
        "worst differences of stiffness and dissipation gradient: {:?}",
        worst.map(|off| format!("{off:.1e}"))
    );
}

/// One step of backward Euler: the return from the end of the step alone.
fn euler(law: &Coulomb, jump: Local, old: &State) -> (State, f64) {
    let Coulomb { friction_coefficient: mu, dilatancy, .. } = *law;
    let [kn, kt, _] = law.elastic_stiffness();
    let elastic = jump - old.jump_plastic;
    let normal = |u: f64| match law.closure {
        Some(closure) if u < 0.0 => kn * u / (1.0 + u / closure.maximum),
        _ => kn * u,
    };
    let trial = kt * elastic.y;
    let excess =
        |slip: f64| trial.abs() - kt * slip + mu * normal(elastic.x - dilatancy * slip) - law.cohesion;
    let (mut least, mut most) = (0.0, excess(0.0).max(0.0) / kt);
    if dilatancy > 0.0 {
        most = f64::min(most, (elastic.x - law.narrowest()) / dilatancy);
    }
    for _ in 0..200 {
        let middle = 0.5 * (least + most);
        *(if excess(middle) > 0.0 { &mut least } else { &mut most }) = middle;
    }
    let slip = 0.5 * (least + most);
    let sigma = normal(elastic.x - dilatancy * slip);
    let apart = old.jump.x > old.jump_plastic.x && elastic.x > 0.0;
    if apart || sigma > 0.0 {
        let jump_plastic = Local::new(old.jump_plastic.x, jump.y, 0.0);
        return (State { jump, traction: Local::zeros(), jump_plastic, status: OPEN, ..*old }, 0.0);
    }
    let irreversible = slip * Local::new(dilatancy, trial.signum(), 0.0);
    let traction = Local::new(sigma, trial - kt * irreversible.y, 0.0);
    let state = State { jump, traction, jump_plastic: old.jump_plastic + irreversible, status: 0, ..*old };
    (state, traction.dot(&irreversible))
}

#[test]
fn many_steps_of_backward_euler_tend_to_it() {
    let steps = 4000;
    let mut worst = [0.0_f64; 2];
    cases(4, 1500, |case| {
        let case = &Case { law: Coulomb { dilatancy_end: None, ..case.law }, ..*case };
        let law = &case.law;
        let Some(whole) = answer(law, case.end, &case.old) else { return false };
        let (mut state, mut dissipated) = (case.old, 0.0);
        for step in 1..=steps {
            let (next, spent) = euler(law, case.at(step as f64 / steps as f64), &state);
            state = next;
            dissipated += spent;
        }
        if (state.status == OPEN) != (whole.state.status == OPEN) {
            return false; // the end is within a step of the parting
        }
        let off = [
            (state.traction - whole.traction).amax() / case.stress(),
            (dissipated - whole.dissipation).abs() / (case.stress() * case.length()),
        ];
        // slip that a step makes too early dilates, against springs that get stiffer
        let times = if law.closure.is_some() { 30.0 } else { 3.0 };
        let order = 1.0 / steps as f64;
        assert!(off.iter().all(|&off| off <= times * order), "{off:?}: {}", case.sequence());
        worst = std::array::from_fn(|i| worst[i].max(off[i]));
        true
    });
    println!("worst differences of traction and dissipation: {:?}", worst.map(|off| format!("{off:.1e}")));
}
