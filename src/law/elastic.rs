//! Linear springs: t = D r + t₀, D = diag(K_N, K_T, K_T) (paper eq. 10). No state, no history.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, not_negative};
use super::local::{Local, diagonal};
use super::{Integration, PointLaw, Response, State, Unresolved};

/// Parameters of the elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elastic {
    /// Normal stiffness K_N [stress / length], zero or more.
    pub normal_stiffness: f64,
    /// Tangential stiffness K_T [stress / length], zero or more.
    pub tangential_stiffness: f64,
}

impl Elastic {
    /// The traction at a jump, with the initial traction t₀.
    #[inline]
    pub fn traction(&self, jump: Local, initial: Local) -> Local {
        let (kn, kt) = (self.normal_stiffness, self.tangential_stiffness);
        Local::new(kn * jump.x + initial.x, kt * jump.y + initial.y, kt * jump.z + initial.z)
    }
}

impl PointLaw for Elastic {
    /// Both stiffnesses must be finite and not negative; zero leaves that direction free.
    fn check(&self) -> Result<(), Inadmissible> {
        not_negative("normal_stiffness", self.normal_stiffness)?;
        not_negative("tangential_stiffness", self.tangential_stiffness)
    }

    fn elastic_stiffness(&self) -> [f64; 3] {
        [self.normal_stiffness, self.tangential_stiffness, self.tangential_stiffness]
    }

    fn is_linear(&self) -> bool {
        true
    }

    /// The answer in the form all laws share: the old traction is carried, so t₀ needs no place of its own.
    #[inline]
    fn respond(&self, jump: Local, old: &State, _: Integration) -> Result<Response, Unresolved> {
        let traction = self.traction(jump - old.jump, old.traction);
        Ok(Response {
            traction,
            stiffness: diagonal(self.normal_stiffness, self.tangential_stiffness),
            state: State { jump, traction, ..*old },
            dissipation: 0.0,
            dissipation_gradient: Local::zeros(),
            released: 0.0,
        })
    }
}
