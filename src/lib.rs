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
//!
//! One point of a law, pressed and sheared, then pulled open:
//!
//! ```
//! use midplane::law::{Integration, Law, Local, State};
//!
//! let law: Law = serde_json::from_str(
//!     r#"{ "type": "coulomb", "normal_stiffness": 1e5, "tangential_stiffness": 1e5, "friction_coefficient": 0.6 }"#,
//! )?;
//! let pressed = law.respond(Local::new(-1e-5, 1e-3, 0.0), &State::default(), Integration::Tolerance(1e-6))?;
//! assert!((pressed.traction.x + 1.0).abs() < 1e-12 && (pressed.traction.y - 0.6).abs() < 1e-12);
//! let open = law.respond(Local::new(1e-4, 1e-3, 0.0), &pressed.state, Integration::Tolerance(1e-6))?;
//! assert_eq!(open.traction, Local::zeros());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A scene from its file to its results is [`run::run`]; increments one by one are [`history::History`].

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
