//! One body condensed on the nodes that interfaces touch: its interior eliminated, a dense S left on its separator.
//!
//! ```text
//!   S = C − B A⁻¹ Bᵀ      A: the interior, C: the separator; symmetric, singular for a floating body
//! ```
//!
//! It knows nothing of other bodies, so whoever has the same body again can have the same condensation.

use std::sync::{Arc, Mutex, PoisonError};

use faer::Mat;

use super::{Cut, NotPositiveDefinite, Parts, TooLarge, nested_dissection};
use crate::assembly::{BoundSubdomain, Pattern, Symmetric};

/// The stiffness of a body and the plan of its condensation.
#[derive(Debug)]
pub struct Substructure {
    pub(super) pattern: Pattern,
    /// K.
    pub(super) stiffness: Symmetric,
    /// The interior as one part, the rest as separator.
    pub(super) parts: Parts,
    /// Condensations that are kept.
    kept: Mutex<Vec<Arc<CondensedSubdomain>>>,
}

/// The interior's factor under one set of supports, and S.
#[derive(Debug)]
pub struct CondensedSubdomain {
    /// Dofs of the interior that are held.
    constrained: Vec<bool>,
    /// Values of L.
    pub(super) values: Vec<Vec<f64>>,
    /// Lower triangle of S.
    pub(super) schur: Arc<Mat<f64>>,
}

impl Substructure {
    /// Assembles a body and plans its condensation on the nodes that are `joined`.
    pub fn new(
        components: usize,
        subdomain: &BoundSubdomain,
        thickness: f64,
        joined: &[bool],
    ) -> Result<Substructure, TooLarge> {
        let pattern = subdomain.pattern(components);
        let stiffness = subdomain.stiffness(&pattern, thickness);
        let coordinates: Vec<f64> = subdomain.coordinates(components).collect();
        let order = nested_dissection(&pattern, &coordinates);
        let parts = Parts::new(&pattern, Cut::along_interfaces(&pattern, &order, joined))?;
        Ok(Substructure { pattern, stiffness, parts, kept: Mutex::default() })
    }

    /// Eliminates the interior; `held` are its held dofs, none on the separator.
    pub(super) fn condense(&self, constrained: Vec<bool>) -> Result<CondensedSubdomain, NotPositiveDefinite> {
        let mut matrix = self.stiffness.clone();
        matrix.hold(&self.pattern, &constrained);
        let (values, schur) = self.parts.eliminate(&matrix, true)?;
        Ok(CondensedSubdomain { constrained, values, schur: Arc::new(schur) })
    }

    /// A condensation that was kept for these supports.
    pub(super) fn kept(&self, constrained: &[bool]) -> Option<Arc<CondensedSubdomain>> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter().find(|condensed| condensed.constrained == constrained).cloned()
    }

    /// Keeps a condensation for whoever has this body again.
    pub(super) fn keep(&self, condensed: &Arc<CondensedSubdomain>) {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner).push(condensed.clone());
    }

    /// Memory of a condensation [bytes].
    pub(super) fn bytes(&self) -> usize {
        let separator = self.parts.separator();
        size_of::<f64>() * (self.parts.entries() + separator * separator)
    }
}
