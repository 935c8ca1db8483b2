//! Straight way r(s) = r₀ + s (r₁ − r₀) of the jump, divided at the events of contact and friction.
//!
//! ```text
//! faces meet   r_n(s) = r_n^p                       from there r_t^p = r_t(s)
//! slip starts  d τ(s) + μ σ(s) = c                  d = ±1, the direction of slip
//! faces part   r_n(s) = r_n^p + tanψ |slip|(s)      that is σ(s) = 0
//! dilatancy ends  |slip|(s) = what is left of it           the way goes on without
//! cohesion is lost  at the first slip, where asked for     the traction drops at once, then friction alone
//! ```
//!
//! All are linear in s. r_n grows or falls all along the way, so faces meet or part, never both; slip in one
//! direction goes on to the end or to the parting, since the domain |τ| ≤ c − μ σ is convex and the rates are constant.

use nalgebra::Vector2;

use super::faces::Faces;
use super::jet::Jet;
use super::{Coulomb, OPEN, SLIP, STICK};
use crate::law::local::{N, T};

/// End of a way.
pub(super) struct WayEnd {
    pub(super) traction: [Jet; 2],
    pub(super) jump_plastic: Vector2<f64>,
    pub(super) dissipation: Jet,
    pub(super) released: f64,
    pub(super) status: u8,
    /// |slip| on the way, and whether there was any, or an opening.
    pub(super) slip: f64,
    pub(super) loosened: bool,
}

/// End of the straight way between two jumps, from the irreversible jump at its start.
pub(super) fn follow(
    faces: &Faces,
    start: Vector2<f64>,
    plastic: Vector2<f64>,
    jump: Vector2<f64>,
) -> WayEnd {
    let [n, t] = Jet::variables(jump);
    if start.x <= plastic.x {
        let from = [(start.x - plastic.x).into(), (start.y - plastic.y).into()];
        return ClosedWay { from, to: [n - plastic.x, t - plastic.y], plastic, jump_t: jump.y }.follow(faces);
    }
    let faces = &faces.apart();
    if jump.x > plastic.x {
        return open(plastic.x, jump.y);
    }
    let left = (n - plastic.x) / (n - start.x); // 1 − s at the meeting
    let to = [n - plastic.x, left * (t - start.y)];
    let plastic = Vector2::new(plastic.x, jump.y - to[T].value);
    WayEnd {
        loosened: true,
        ..ClosedWay { from: [0.0.into(); 2], to, plastic, jump_t: jump.y }.follow(faces)
    }
}

/// Open faces at the end, r_t^p := r_t.
fn open(plastic_n: f64, jump_t: f64) -> WayEnd {
    WayEnd {
        traction: [0.0.into(); 2],
        jump_plastic: Vector2::new(plastic_n, jump_t),
        dissipation: 0.0.into(),
        released: 0.0,
        status: OPEN,
        slip: 0.0,
        loosened: true,
    }
}

/// Way that starts with closed faces, by r − r^p of its start.
struct ClosedWay {
    from: [Jet; 2],
    to: [Jet; 2],
    /// r^p at the start.
    plastic: Vector2<f64>,
    /// r_t at the end.
    jump_t: f64,
}

impl ClosedWay {
    fn at(&self, s: Jet) -> [Jet; 2] {
        [N, T].map(|i| self.from[i] + s * (self.to[i] - self.from[i]))
    }

    /// The s at which a quantity linear in r rises above zero, if it does before the end.
    fn rise(&self, of: impl Fn(&[Jet; 2]) -> Jet) -> Option<Jet> {
        let to = of(&self.to);
        if to.value <= 0.0 {
            return None;
        }
        let from = of(&self.from);
        Some(if from.value < 0.0 { from / (from - to) } else { 0.0.into() })
    }

    /// Stick up to the first event, then slip or parting.
    fn follow(&self, faces: &Faces) -> WayEnd {
        let law = &faces.law;
        let forward = (self.to[T].value - self.from[T].value).signum();
        let parts = self.rise(|elastic| elastic[N]);
        let slips = [forward, -forward]
            .map(|direction| Slide { law, direction })
            .into_iter()
            .filter_map(|slide| Some((self.rise(|elastic| slide.excess(elastic))?, slide)))
            .min_by(|(a, _), (b, _)| a.value.total_cmp(&b.value));
        if let Some((start, slide)) = slips {
            // without cohesion the faces part at the apex of the domain only, where slip ends
            let apex = parts.filter(|_| law.cohesion == 0.0);
            let start = apex.map_or(start, |apex| start.min(apex));
            if parts.is_none_or(|parting| start.value <= parting.value) {
                return self.slip(faces, &slide, start);
            }
        }
        if let Some(parting) = parts {
            let tau = law.tangential_stiffness * self.at(parting)[T].value;
            return WayEnd { released: law.shear_energy(tau), ..open(self.plastic.x, self.jump_t) };
        }
        WayEnd {
            traction: [law.normal_stiffness * self.to[N], law.tangential_stiffness * self.to[T]],
            jump_plastic: self.plastic,
            dissipation: 0.0.into(),
            released: 0.0,
            status: STICK,
            slip: 0.0,
            loosened: false,
        }
    }

    /// Slip from `start` on, to the end or to the parting.
    fn slip(&self, faces: &Faces, slide: &Slide, start: Jet) -> WayEnd {
        let law = slide.law;
        let sigma = (law.normal_stiffness * self.at(start)[N]).min(0.0.into());
        if let Some(drop) = faces.drop(sigma) {
            let moved = [drop.opening.into(), (slide.direction * drop.slip).into()];
            return self.onwards(start, moved, &drop.after, drop.slip, drop.dissipation, drop.released);
        }
        if let Some(ends) = self.rise(|elastic| slide.slip(elastic) - faces.left)
            && ends.value >= start.value
            && self.rise(|elastic| slide.sigma(elastic)).is_none_or(|parting| ends.value < parting.value)
        {
            let there = slide.sigma(&self.at(ends));
            let dissipation = slide.dissipation(faces.left, sigma, there);
            let moved = [law.dilatancy * faces.left, slide.direction * faces.left];
            return self.onwards(ends, moved, &faces.worn(), faces.left.value, dissipation, 0.0);
        }
        let Some(parting) = self.rise(|elastic| slide.sigma(elastic)) else {
            return self.slipping(slide, sigma);
        };
        let parting = parting.max(start);
        let slip = slide.slip(&self.at(parting)).max(0.0.into());
        let dissipation = slide.dissipation(slip, sigma, 0.0.into());
        let left = Jet::from(1.0) - parting;
        let rest = ClosedWay {
            from: [0.0.into(); 2],
            to: [N, T].map(|i| left * (self.to[i] - self.from[i])),
            plastic: self.plastic + slide.irreversible(slip),
            jump_t: self.jump_t,
        };
        // at the apex without cohesion: dilatancy of slip the other way keeps the faces together
        let back = Slide { law, direction: -slide.direction };
        if law.cohesion == 0.0 && back.sigma(&rest.to).value < 0.0 {
            let end = rest.slip(&Faces { left: faces.left - slip, ..*faces }, &back, 0.0.into());
            return WayEnd { dissipation: dissipation + end.dissipation, slip: slip.value + end.slip, ..end };
        }
        let released = law.shear_energy(law.cohesion);
        WayEnd { dissipation, released, slip: slip.value, ..open(rest.plastic.x, self.jump_t) }
    }

    /// The rest of the way from a place on, after an irreversible jump and with other faces.
    fn onwards(
        &self,
        from: Jet,
        moved: [Jet; 2],
        faces: &Faces,
        slip: f64,
        dissipation: Jet,
        released: f64,
    ) -> WayEnd {
        let at = self.at(from);
        let rest = ClosedWay {
            from: [N, T].map(|i| at[i] - moved[i]),
            to: [N, T].map(|i| self.to[i] - moved[i]),
            plastic: self.plastic + Vector2::new(moved[N].value, moved[T].value),
            jump_t: self.jump_t,
        };
        let end = rest.follow(faces);
        WayEnd {
            dissipation: dissipation + end.dissipation,
            released: released + end.released,
            slip: slip + end.slip,
            loosened: true,
            ..end
        }
    }

    /// Slip to the end; `sigma` where it starts.
    fn slipping(&self, slide: &Slide, sigma: Jet) -> WayEnd {
        let slip = slide.slip(&self.to);
        let end = slide.sigma(&self.to);
        WayEnd {
            traction: [end, slide.direction * slide.limit(end)],
            jump_plastic: self.plastic + slide.irreversible(slip),
            dissipation: slide.dissipation(slip, sigma, end),
            released: 0.0,
            status: SLIP,
            slip: slip.value,
            loosened: slip.value > 0.0,
        }
    }
}

/// Slip in one direction d; `elastic` is r − r^p had nothing slipped, linear in s like all that follows from it.
struct Slide<'a> {
    law: &'a Coulomb,
    direction: f64,
}

impl Slide<'_> {
    /// d τ + μ σ − c.
    fn excess(&self, elastic: &[Jet; 2]) -> Jet {
        let (kn, kt) = (self.law.normal_stiffness, self.law.tangential_stiffness);
        self.direction * kt * elastic[T] + self.law.friction_coefficient * kn * elastic[N] - self.law.cohesion
    }

    /// |Δr_t^p| that brings the traction back to the surface.
    fn slip(&self, elastic: &[Jet; 2]) -> Jet {
        let Coulomb { normal_stiffness: kn, tangential_stiffness: kt, friction_coefficient: mu, .. } =
            *self.law;
        (1.0 / (kt + mu * kn * self.law.dilatancy)) * self.excess(elastic)
    }

    /// σ on the surface.
    fn sigma(&self, elastic: &[Jet; 2]) -> Jet {
        self.law.normal_stiffness * (elastic[N] - self.law.dilatancy * self.slip(elastic))
    }

    /// c − μ σ.
    fn limit(&self, sigma: Jet) -> Jet {
        Jet::from(self.law.cohesion) - self.law.friction_coefficient * sigma
    }

    /// Δr^p of a slip.
    fn irreversible(&self, slip: Jet) -> Vector2<f64> {
        slip.value * Vector2::new(self.law.dilatancy, self.direction)
    }

    /// Slip times the mean of c + |σ| (μ − tanψ) at its two ends.
    fn dissipation(&self, slip: Jet, start: Jet, end: Jet) -> Jet {
        let Coulomb { friction_coefficient: mu, dilatancy: tan_psi, .. } = *self.law;
        slip * (Jet::from(self.law.cohesion) - 0.5 * (mu - tan_psi) * (start + end))
    }
}
