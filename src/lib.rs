//! midplane: finite elements of solids whose parts are meshed separately and joined along interfaces.
//!
//! One equation carries the program:
//!
//! ```text
//! K u + Gᵀ Σ_p w_p N_pᵀ R_pᵀ t(R_p N_p G u; state_p) = f,      G = M⁻¹ B
//! ```
//!
//! K is the linear elastic continuum; B, M, N, R, w are the coupling of two unmatched sides through the mid-plane
//! of their interface; t is the interface law.
//!
//! Sign convention, everywhere: the jump is u_B − u_A, the normal n points from side A to side B, the tangent t is
//! n turned clockwise (chain A runs along t with n on its left), opening and tension are positive. Components of
//! jumps and tractions are ordered (n, t). Units are the user's own, as long as they are consistent.
//!
//! The rooms, each of which may import only those above it (a test enforces the table):
//! `error`, `sparse`, `shape`, `law`, `scene`, `mesh`, `coupling`, `continuum`, `assembly`, `solver`, `problem`, `output`,
//! `history`, `run`, `study`, `cli`.

#![warn(missing_docs)]
// no panic is reachable from input
#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::todo, clippy::unimplemented)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod assembly;
pub mod cli;
pub mod continuum;
pub mod coupling;
pub mod error;
pub mod files;
pub mod history;
pub mod law;
pub mod mesh;
pub mod output;
pub mod problem;
pub mod run;
pub mod scene;
pub mod shape;
pub mod solver;
pub mod sparse;
pub mod study;
pub mod water;
