//! The plane of the normal and of the direction in which a point would be sheared had nothing slipped.

use nalgebra::Vector2;

use super::jet::Jet;
use crate::law::State;
use crate::law::local::{Local, LocalMatrix, N, S, T, across, direction, narrow, shear};

/// The plane in which a way is followed; that of n and t where nothing is sheared along s.
pub(super) struct Turned {
    /// Unit vector along the interface.
    e: Local,
    /// Component along e of the slip that would be there [length].
    length: f64,
    /// False in the plane of n and t.
    in_space: bool,
}

impl Turned {
    /// The plane for the way from a state to a jump.
    pub(super) fn new(jump: Local, old: &State) -> Turned {
        // faces that meet on the way are sheared from there on
        let closed = old.jump[N] <= old.jump_plastic[N];
        let sheared = jump - if closed { old.jump_plastic } else { old.jump };
        if old.is_plane(&jump) {
            return Turned { e: Local::y(), length: sheared[T], in_space: false };
        }
        Turned { e: direction(&sheared), length: shear(&sheared), in_space: true }
    }

    /// The components along the normal and e.
    pub(super) fn plane(&self, v: Local) -> Vector2<f64> {
        if self.in_space { Vector2::new(v[N], self.e.dot(&v)) } else { narrow(&v) }
    }

    /// The vector with these components.
    pub(super) fn space(&self, v: Vector2<f64>) -> Local {
        if self.in_space { self.e * v[T] + Local::x() * v[N] } else { Local::new(v[N], v[T], 0.0) }
    }

    /// r^p from its components in the plane: across e nothing is elastic, so that there it is the jump.
    pub(super) fn irreversible(&self, v: Vector2<f64>, jump: Local) -> Local {
        let own = self.space(v);
        if self.in_space { own + jump - self.space(self.plane(jump)) } else { own }
    }

    /// Derivatives of a traction by the jump.
    pub(super) fn stiffness(&self, [sigma, tau]: &[Jet; 2]) -> LocalMatrix {
        let [by_sigma, by_tau] = [sigma.gradient, tau.gradient];
        let turn = if self.length == 0.0 { by_tau[T] } else { tau.value / self.length };
        if !self.in_space {
            let mut d = LocalMatrix::zeros();
            d.fixed_view_mut::<1, 2>(N, 0).copy_from(&by_sigma.transpose());
            d.fixed_view_mut::<1, 2>(T, 0).copy_from(&by_tau.transpose());
            d[(S, S)] = turn;
            return d;
        }
        Local::x() * self.space(by_sigma).transpose()
            + self.e * self.space(by_tau).transpose()
            + across(&self.e) * turn
    }
}
