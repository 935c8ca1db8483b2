//! A cohesive zone with damage: strength and fracture energy in two modes, softening of any shape, contact and friction.
//!
//! ```text
//! t_n = (1 − D) K_N r_n   r_n > 0        t_t = (1 − D) K_T r_t + F        secant unloading
//!       K_N r_n           r_n ≤ 0        F: friction on the lost share D, while the faces touch (`friction`)
//! ```
//!
//! D grows with the jump so that a way at one mixity B dissipates G(B) (`damage`, `mixed`, `softening`). It falls never, so that
//! the dissipation ½ e² Ḋ is never negative on any way. With a viscosity η the lost share follows that D late,
//! Ḋ_v = (D − D_v)/η with the step's load factor as time: a backward Euler step (Duvaut and Lions).
//!
//! Forms of this kind are usual (Camanho and Dávila 2002, Turon et al. 2006; friction: Alfano and Sacco 2006); not in the paper.

mod check;
mod damage;
mod friction;
mod mixed;
mod parameters;
mod softening;

pub use parameters::{Cohesive, MixedMode, NamedSoftening, Softening};

use super::local::{Local, LocalMatrix, N, diagonal, shear};
use super::variable::{LawVariable, OWN};
use super::{Inadmissible, Integration, PointLaw, Response, State, Strength, Unresolved};
use crate::error::Warning;

use damage::{ByJump, Growth, bisect};
use friction::LostShare;

const WORK: usize = 0;
const DAMAGE: usize = 1;
const UNDELAYED: usize = 2;
const VISCOUS: usize = 3;

const VARIABLES: [LawVariable; 4] = [
    LawVariable {
        name: "fracture_work",
        unit: "stress × length",
        meaning: "work spent on fracture, friction left out",
        place: WORK,
    },
    LawVariable {
        name: "damage",
        unit: "-",
        meaning: "share D of the stiffness that is lost",
        place: DAMAGE,
    },
    LawVariable {
        name: "damage_undelayed",
        unit: "-",
        meaning: "share of the stiffness that would be lost without viscosity",
        place: UNDELAYED,
    },
    LawVariable {
        name: "viscous_work",
        unit: "stress × length",
        meaning: "work of the tractions above those without viscosity, part of what is dissipated",
        place: VISCOUS,
    },
];

/// Statuses, as those of a crack that closes.
const GROWS: u8 = 1;
const SLIDES: u8 = 2;
const OPEN: u8 = 4;
const CLOSED: u8 = 5;
const TIED: u8 = 6;

impl Cohesive {
    /// Jumps before and after, from where the point carries nothing.
    fn ends(jump: Local, old: &State) -> [Local; 2] {
        [old.jump - old.jump_plastic, jump - old.jump_plastic]
    }

    /// Friction of a state.
    fn friction(&self, old: &State) -> Local {
        let elastic = old.jump - old.jump_plastic;
        let lost = old.own[DAMAGE];
        if self.friction_coefficient == 0.0 || lost <= 0.0 || elastic[N] >= 0.0 {
            return Local::zeros();
        }
        let mut force = old.traction - elastic * ((1.0 - lost) * self.tangential_stiffness);
        force[N] = 0.0;
        force
    }

    /// Traction of the elastic law without friction, and its slopes by the same components.
    fn secant(&self, jump: &Local, damage: f64) -> (Local, [f64; 2]) {
        let left = 1.0 - damage;
        let kn = if jump[N] > 0.0 { left * self.normal_stiffness } else { self.normal_stiffness };
        let kt = left * self.tangential_stiffness;
        (Local::new(kn * jump[N], kt * jump[1], kt * jump[2]), [kn, kt])
    }

    /// The answer after a change of the load factor; without a bound on that nothing is late.
    fn answer(&self, jump: Local, old: &State, advance: f64) -> Response {
        let curve = self.curve();
        let [from, to] = Cohesive::ends(jump, old);
        let viscous = self.viscosity > 0.0;
        let before = old.own[DAMAGE];
        let driven_before = if viscous { old.own[UNDELAYED].max(before) } else { before };
        let growth = self.growth(&curve, [&from, &to], driven_before);
        let still = ByJump { value: driven_before, gradient: Local::zeros() };
        let driven = growth.map_or(still, |growth| growth.damage);
        let (mut damage, mut spent) = (driven, ByJump { value: 0.0, gradient: Local::zeros() });
        let (mut mean, mut mean_by_end) = (to, LocalMatrix::identity());
        let mut own = old.own;
        if viscous {
            let part = if advance.is_finite() { advance / (self.viscosity + advance) } else { 1.0 };
            damage =
                ByJump { value: before + part * (driven.value - before), gradient: driven.gradient * part };
            let [start, end] = [self.mixity(&from), self.mixity(&to)];
            let (added, release) = (damage.value - before, 0.25 * (start.square + end.square));
            spent.value = added * release;
            spent.gradient = damage.gradient * release + end.half_gradient * (0.5 * added);
            let late = start.half_gradient * (driven_before - before)
                + end.half_gradient * (driven.value - damage.value);
            own[VISCOUS] += (0.5 * late.dot(&(to - from))).max(0.0);
            own[UNDELAYED] = driven.value;
            (mean, mean_by_end) = (0.5 * (from + to), 0.5 * LocalMatrix::identity());
        } else if let Some(growth) = &growth {
            spent = self.dissipated(&curve, before, growth);
            let Growth { ends: [begin, end], .. } = growth;
            (mean, mean_by_end) = (0.5 * (begin.jump + end.jump), 0.5 * (begin.by_end + end.by_end));
        }
        let lost = LostShare { before, after: damage, mean, mean_by_end };
        let friction = self.rub([&from, &to], self.friction(old), &lost);
        let (elastic, [kn, kt]) = self.secant(&to, damage.value);
        let undamaged = self.mixity(&to).half_gradient;
        let traction = elastic + friction.force;
        own[WORK] += spent.value;
        own[DAMAGE] = damage.value;
        let status = match (damage.value > before, friction.slides, to[N] > 0.0) {
            (.., true) if damage.value >= 1.0 => OPEN,
            (true, ..) => GROWS,
            (_, true, _) => SLIDES,
            (.., true) if damage.value > 0.0 => TIED,
            (.., false) if damage.value > 0.0 => CLOSED,
            _ => 0,
        };
        Response {
            traction,
            stiffness: diagonal::<3>(kn, kt) - undamaged * damage.gradient.transpose() + friction.stiffness,
            state: State { jump, traction, own, status, ..*old },
            dissipation: spent.value + friction.dissipated.value,
            dissipation_gradient: spent.gradient + friction.dissipated.gradient,
            damage_gradient: damage.gradient,
            released: 0.0,
        }
    }
}

impl PointLaw for Cohesive {
    fn all_variables() -> &'static [LawVariable] {
        &VARIABLES
    }

    /// The last two are there with a viscosity alone.
    fn variables(&self) -> &'static [LawVariable] {
        if self.viscosity > 0.0 { &VARIABLES } else { &VARIABLES[..UNDELAYED] }
    }

    fn check(&self) -> Result<(), Inadmissible> {
        self.admit()
    }

    fn warnings(&self) -> Vec<Warning> {
        self.doubts()
    }

    fn elastic_stiffness(&self) -> [f64; 3] {
        [self.normal_stiffness, self.tangential_stiffness, self.tangential_stiffness]
    }

    /// Without viscosity: as after a change of the load factor without end.
    fn respond(&self, jump: Local, old: &State, _: Integration) -> Result<Response, Unresolved> {
        Ok(self.answer(jump, old, f64::INFINITY))
    }

    fn respond_over(
        &self,
        jump: Local,
        old: &State,
        _: Integration,
        advance: f64,
    ) -> Result<Response, Unresolved> {
        Ok(self.answer(jump, old, advance))
    }

    fn is_viscous(&self) -> bool {
        self.viscosity > 0.0
    }

    fn viscous_work(&self, state: &State) -> f64 {
        if self.viscosity > 0.0 { state.own[VISCOUS] } else { 0.0 }
    }

    fn held(&self, jump: Local, old: &State) -> (Local, [f64; 3]) {
        let [from, to] = Cohesive::ends(jump, old);
        let damage = old.own[DAMAGE];
        let (mut traction, [kn, mut kt]) = self.secant(&to, damage);
        if to[N] < 0.0 && self.friction_coefficient > 0.0 {
            let met = if from[N] > 0.0 { to[N] / (to[N] - from[N]) } else { 1.0 };
            let mut slip = (to - from) * met;
            slip[N] = 0.0;
            traction += self.friction(old) + slip * (damage * self.tangential_stiffness);
            kt += damage * self.tangential_stiffness * met;
        }
        (traction, [kn, kt, kt])
    }

    fn damage(&self, state: &State) -> Option<f64> {
        Some(state.own[DAMAGE])
    }

    /// ½ (1 − D) e² + ½ K_N ⟨−r_n⟩² + F²/(2 D K_T).
    fn stored(&self, state: &State) -> f64 {
        let elastic = state.jump - state.jump_plastic;
        let damage = state.own[DAMAGE];
        let closed = elastic[N].min(0.0);
        let force = self.friction(state);
        let rubbed =
            if damage > 0.0 { force.norm_squared() / (damage * self.tangential_stiffness) } else { 0.0 };
        0.5 * ((1.0 - damage) * self.mixity(&elastic).square
            + self.normal_stiffness * closed * closed
            + rubbed)
    }

    fn takes_damage(&self) -> bool {
        true
    }

    /// D at which a way in mode I has spent that share.
    fn lost(&self, share: f64) -> Option<[f64; OWN]> {
        let curve = self.curve();
        let spent = |damage: f64| self.spent(&curve, damage, 0.0)[0] - share * self.fracture_energy_i;
        let damage = if share >= 1.0 { 1.0 } else { bisect([0.0, 1.0], spent) };
        let mut own = self.intact();
        (own[WORK], own[DAMAGE]) = (share * self.fracture_energy_i, damage);
        if self.viscosity > 0.0 {
            own[UNDELAYED] = damage;
        }
        Some(own)
    }

    fn at_rest(&self, jump: Local, jump_plastic: Local, own: &[f64; OWN]) -> Local {
        self.secant(&(jump - jump_plastic), own[DAMAGE]).0
    }

    /// Excess over the surface of a damage, beyond the friction on the share that is lost.
    fn excess(&self, traction: &Local, own: &[f64; OWN]) -> f64 {
        let damage = own[DAMAGE];
        let [kn, kt, _] = self.elastic_stiffness();
        let left = 1.0 - damage;
        let rubbed = damage * self.friction_coefficient * (-traction[N]).max(0.0);
        let bonded = (shear(traction) - rubbed).max(0.0);
        if left <= 0.0 {
            return if left < 0.0 { f64::INFINITY } else { bonded.max(traction[N]) };
        }
        let jump = Local::new(traction[N] / kn, bonded / kt, 0.0) / left;
        let at = self.mixity(&jump);
        if damage > 0.0 {
            return (self.driven(&self.curve(), &at).value - damage)
                * self.tensile_strength.max(self.shear_strength);
        }
        let epsilon = (at.square * self.strengths(at.share).per_square).sqrt();
        (1.0 - 1.0 / epsilon.max(f64::MIN_POSITIVE)) * traction[N].max(0.0).max(bonded)
    }

    fn strength(&self, state: &State) -> Option<Strength> {
        let (curve, damage) = (self.curve(), state.own[DAMAGE]);
        let left = |share: f64| {
            let strengths = self.strengths(share);
            let kappa = strengths.energy * strengths.per_square / curve.area;
            if damage < 1.0 { curve.at_damage(kappa, damage).left } else { 0.0 }
        };
        Some(Strength {
            tensile_strength: self.tensile_strength * left(0.0),
            cohesion: self.shear_strength * left(1.0),
            tan_friction: self.friction_coefficient,
        })
    }

    fn steepest_softening(&self) -> f64 {
        self.softens()
    }

    fn onset_or_on(&self, jump: Local, old: &State) -> Option<f64> {
        let [from, to] = Cohesive::ends(jump, old);
        let damage = old.own[if self.viscosity > 0.0 { UNDELAYED } else { DAMAGE }];
        self.begins(&self.curve(), [&from, &to], damage)
    }

    fn closes(&self) -> bool {
        true
    }
}
