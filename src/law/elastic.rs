//! Linear springs: t = D r + t₀, D = diag(K_N, K_T, K_T) (paper eq. 10). No state, no history; with a closure the normal springs
//! get stiffer as they close, and the jump from which they do is kept.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, not_negative};
use super::closure::{Closure, Springs};
use super::local::{Local, N, diagonal};
use super::{Integration, OWN, PointLaw, Response, State, Unresolved};

/// Parameters of the elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elastic {
    /// Normal stiffness K_N [stress / length], zero or more; or `closure`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal_stiffness: Option<f64>,
    /// Hyperbolic closure in place of `normal_stiffness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closure: Option<Closure>,
    /// Tangential stiffness K_T [stress / length], zero or more.
    pub tangential_stiffness: f64,
}

impl Elastic {
    /// Linear springs of two stiffnesses [stress / length].
    pub fn springs(normal: f64, tangential: f64) -> Elastic {
        Elastic { normal_stiffness: Some(normal), closure: None, tangential_stiffness: tangential }
    }

    /// The traction of linear springs at a jump, with the initial traction t₀.
    #[inline]
    pub fn traction(&self, jump: Local, initial: Local) -> Local {
        let [kn, kt, _] = self.elastic_stiffness();
        Local::new(kn * jump.x + initial.x, kt * jump.y + initial.y, kt * jump.z + initial.z)
    }

    fn normal(&self) -> Springs {
        Springs::of(self.normal_stiffness, self.closure)
    }
}

impl PointLaw for Elastic {
    /// Stiffnesses must be finite and not negative; zero leaves that direction free.
    fn check(&self) -> Result<(), Inadmissible> {
        Springs::check(self.normal_stiffness, self.closure, not_negative)?;
        not_negative("tangential_stiffness", self.tangential_stiffness)
    }

    fn elastic_stiffness(&self) -> [f64; 3] {
        [self.normal().initial(), self.tangential_stiffness, self.tangential_stiffness]
    }

    fn is_linear(&self) -> bool {
        self.closure.is_none()
    }

    fn narrowest(&self) -> f64 {
        self.normal().narrowest()
    }

    fn jump_under(&self, traction: &Local) -> Local {
        springs_under(&self.normal(), self.tangential_stiffness, traction)
    }

    fn at_rest(&self, jump: Local, jump_plastic: Local, _: &[f64; OWN]) -> Local {
        let elastic = jump - jump_plastic;
        let shear = elastic * self.tangential_stiffness;
        Local::new(self.normal().answer(elastic[N]).0, shear.y, shear.z)
    }

    fn held(&self, jump: Local, old: &State) -> (Local, [f64; 3]) {
        let [_, kt, ks] = self.elastic_stiffness();
        let linear = self.traction(jump - old.jump, old.traction);
        match self.closure {
            None => (linear, self.elastic_stiffness()),
            Some(_) => {
                let (sigma, kn) = self.normal().answer(jump[N] - old.jump_plastic[N]);
                (Local::new(sigma, linear.y, linear.z), [kn, kt, ks])
            }
        }
    }

    fn stored(&self, state: &State) -> f64 {
        let t = state.traction;
        let shear = 0.5 * (t.y * t.y + t.z * t.z) / self.tangential_stiffness;
        self.normal().stored(t[N]) + if self.tangential_stiffness > 0.0 { shear } else { 0.0 }
    }

    /// The answer in the form all laws share: the old traction is carried, so t₀ needs no place of its own; what closes begins
    /// at its irreversible jump.
    #[inline]
    fn respond(&self, jump: Local, old: &State, _: Integration) -> Result<Response, Unresolved> {
        let (traction, [kn, kt, _]) = self.held(jump, old);
        if !self.normal().reach(jump[N] - old.jump_plastic[N]) {
            return Err(Unresolved::Closed { jump, narrowest: self.narrowest() });
        }
        Ok(Response {
            traction,
            stiffness: diagonal(kn, kt),
            state: State { jump, traction, ..*old },
            dissipation: 0.0,
            dissipation_gradient: Local::zeros(),
            damage_gradient: Local::zeros(),
            released: 0.0,
        })
    }
}

/// Jump of springs under a traction; none in a direction without stiffness.
pub(super) fn springs_under(normal: &Springs, kt: f64, traction: &Local) -> Local {
    let shear = if kt > 0.0 { traction / kt } else { Local::zeros() };
    Local::new(normal.jump_under(traction[N]), shear.y, shear.z)
}
