//! Faces as they are at a state: what is left of cohesion and dilatancy.

use super::jet::Jet;
use super::normal::{mean, traction};
use super::parameters::{Coulomb, LOST, LossOfCohesion, SLIP_TOTAL};
use super::slide::Slide;
use crate::law::OWN;

/// Faces with the cohesion and the dilatancy that they still have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Faces {
    pub law: Coulomb,
    /// |slip| after which dilatancy ends.
    pub left: Jet,
    /// The cohesion is lost at the first slip.
    pub loses: bool,
}

/// The drop of the traction where cohesion is lost at a jump.
pub(super) struct Drop {
    pub slip: Jet,
    /// Irreversible opening that goes with it.
    pub opening: Jet,
    pub dissipation: Jet,
    pub released: f64,
    pub after: Faces,
}

impl Faces {
    /// The faces of a law at a point with these variables.
    pub(super) fn of(law: &Coulomb, own: &[f64; OWN]) -> Faces {
        let left = law.dilatancy_end.map_or(f64::INFINITY, |end| end - own[SLIP_TOTAL]);
        let loses = law.cohesion_lost == LossOfCohesion::AtSlip;
        let faces = Faces { law: *law, left: left.into(), loses: loses && own[LOST] == 0.0 };
        let faces = if left <= 0.0 { faces.worn() } else { faces };
        if loses && own[LOST] > 0.0 { faces.apart() } else { faces }
    }

    /// The same without dilatancy.
    pub(super) fn worn(&self) -> Faces {
        Faces { law: Coulomb { dilatancy: 0.0, ..self.law }, left: f64::INFINITY.into(), ..*self }
    }

    /// The same once they have been apart.
    pub(super) fn apart(&self) -> Faces {
        match self.law.cohesion_lost {
            LossOfCohesion::AtSlip => {
                Faces { law: Coulomb { cohesion: 0.0, ..self.law }, loses: false, ..*self }
            }
            LossOfCohesion::Never => *self,
        }
    }

    /// The drop at a normal jump where slip begins; none if there is nothing to lose. What is above friction is released.
    ///
    /// ```text
    /// K_T λ + μ (σ₀ − σ(λ)) = c,  σ(λ) = f(y₀ − tanψ min(λ, left))        released ∫ (c − K_T λ − μ (σ₀ − σ(λ))) dλ
    /// ```
    pub(super) fn drop(&self, start: Jet) -> Option<Drop> {
        let Coulomb { tangential_stiffness: kt, friction_coefficient: mu, dilatancy: psi, .. } = self.law;
        let c = self.law.cohesion;
        if !self.loses || c == 0.0 {
            return None;
        }
        let springs = self.law.normal();
        let sigma = traction(&springs, start);
        // the faces as they were pushed, without their cohesion
        let pushed = [start, (1.0 / kt) * (Jet::from(c) - mu * sigma)];
        let after = self.apart();
        let whole = Slide { law: &after.law, direction: 1.0 }.slipped(0.0.into(), &pushed).slip;
        let dilated = whole.min(self.left);
        let end = start - psi * dilated;
        let (worked, sigma_end) = (dilated * mean(&springs, end, start), traction(&springs, end));
        let above = Jet::from(c) - kt * dilated - mu * (sigma - sigma_end); // of friction, where dilatancy ends
        let above = if whole.value <= self.left.value { 0.0.into() } else { above };
        let rest = (1.0 / kt) * above;
        let left = self.left - dilated;
        let after = Faces { left, ..after };
        Some(Drop {
            slip: dilated + rest,
            opening: psi * dilated,
            dissipation: (psi - mu) * worked - mu * rest * sigma_end,
            released: (dilated * (Jet::from(c) - (0.5 * kt) * dilated) - mu * (dilated * sigma - worked)
                + 0.5 * rest * above)
                .value,
            after: if left.value <= 0.0 { after.worn() } else { after },
        })
    }
}
