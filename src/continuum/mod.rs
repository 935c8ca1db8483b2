//! The plane elastic continuum: element stiffness, loads, stress recovery.
//!
//! ```text
//! K_e = h ∫ Bᵀ C B dA,      f_e = h ∫ Nᵀ b dA + h ∫ Nᵀ t dL        (h: thickness)
//! ```
//!
//! An element returns its small matrix and touches nothing global. Strain is (ε_xx, ε_yy, γ_xy), stress
//! (σ_xx, σ_yy, σ_xy); dofs of an element are ordered node by node, x before y.

mod element;
mod load;
mod material;
mod prestress;
mod recovery;

pub use element::{ElementStiffness, cell_coordinates, element_stiffness};
pub use load::{cell_field_force, cell_weights, edge_field_force, edge_force, edge_weights};
pub use material::{Elasticity, PlaneState};
pub use prestress::PointField;
pub use recovery::{Stresses, principal, recover, von_mises};
