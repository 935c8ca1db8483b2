//! Faces as they are at a state: what is left of cohesion and dilatancy.

use super::jet::Jet;
use super::parameters::{Coulomb, LOST, LossOfCohesion, SLIP_TOTAL};
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
    pub slip: f64,
    /// Irreversible opening that goes with it.
    pub opening: f64,
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

    /// The drop at a normal traction where slip begins; none if there is nothing to lose.
    ///
    /// ```text
    /// K_T λ + μ K_N tanψ min(λ, left) = c        released ∫ (c − K_T λ − μ K_N tanψ λ) dλ: what is above friction
    /// ```
    pub(super) fn drop(&self, sigma: Jet) -> Option<Drop> {
        let Coulomb { normal_stiffness: kn, tangential_stiffness: kt, friction_coefficient: mu, .. } =
            self.law;
        let (c, tan_psi) = (self.law.cohesion, self.law.dilatancy);
        if !self.loses || c == 0.0 {
            return None;
        }
        let whole = kt + mu * kn * tan_psi;
        let dilated = (c / whole).min(self.left.value);
        let above = c - whole * dilated; // of friction, where dilatancy ends
        let slip = dilated + above / kt;
        let end = sigma - kn * tan_psi * dilated;
        let friction = (-0.5 * (mu - tan_psi) * dilated) * (sigma + end) + (-mu * (slip - dilated)) * end;
        let left = self.left - dilated;
        let after = Faces { left, ..self.apart() };
        let after = if left.value <= 0.0 { after.worn() } else { after };
        let released = 0.5 * (c + above) * dilated + 0.5 * above * (slip - dilated);
        Some(Drop { slip, opening: tan_psi * dilated, dissipation: friction, released, after })
    }
}
