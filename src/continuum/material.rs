//! Isotropic linear elasticity in the plane.

/// The out-of-plane assumption.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneState {
    /// ε_zz = 0.
    Strain,
    /// σ_zz = 0.
    Stress,
}

/// Elastic constants of one material in one plane state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// C_xxxx [stress].
    pub c11: f64,
    /// C_xxyy [stress].
    pub c12: f64,
    /// C_xyxy, the shear modulus [stress].
    pub c33: f64,
    /// σ_zz = `out_of_plane` · (σ_xx + σ_yy).
    pub out_of_plane: f64,
    /// Young's modulus [stress].
    pub young: f64,
    /// σ_zz = 0.
    pub is_plane_stress: bool,
}

impl Elasticity {
    /// From Young's modulus [stress] and Poisson's ratio.
    pub fn new(young: f64, poisson: f64, plane: PlaneState) -> Elasticity {
        let (e, nu) = (young, poisson);
        let c33 = e / (2.0 * (1.0 + nu));
        let is_plane_stress = plane == PlaneState::Stress;
        match plane {
            PlaneState::Strain => {
                let c = e / ((1.0 + nu) * (1.0 - 2.0 * nu));
                Elasticity { c11: c * (1.0 - nu), c12: c * nu, c33, out_of_plane: nu, young, is_plane_stress }
            }
            PlaneState::Stress => {
                let c = e / ((1.0 - nu) * (1.0 + nu));
                Elasticity { c11: c, c12: c * nu, c33, out_of_plane: 0.0, young, is_plane_stress }
            }
        }
    }

    /// Stress (xx, yy, xy) of a strain (xx, yy, γ_xy).
    #[inline]
    pub fn stress(&self, strain: [f64; 3]) -> [f64; 3] {
        let [exx, eyy, gxy] = strain;
        [self.c11 * exx + self.c12 * eyy, self.c12 * exx + self.c11 * eyy, self.c33 * gxy]
    }
}
