//! Laws of interfaces at one point: `cargo test --release --test laws tangent::` runs the tests of one file.
//!
//! ## Cracking
//!
//! - `closed_forms`: pure tension, shear under pressure and one Euler step are those of the closed forms
//! - `reference`: ten curves of an independent implementation are reproduced
//! - `closing`: a crack closes as the curves of an independent implementation do, and nothing is made or undone
//! - `invariants`: a million random steps leave no hyperbola, undo no damage and create no energy
//! - `extremes`: extreme parameters and ways are answered or refused
//!
//! ## Cohesive
//!
//! - `cohesive`: the fracture energy is spent whatever the softening and the mixity
//!
//! ## Coulomb and elastic
//!
//! - `coulomb`: friction is returned in closed form along a straight way
//! - `coulomb_way`: the answer is exact along a straight way, whatever happens on it
//! - `steps`: a million random steps leave no surface, and dissipation is never negative
//!
//! ## All laws
//!
//! - `tangent`: the stiffness is the exact derivative of the traction
//! - `space`: in space a law answers as in the plane
//! - `path`: a point is driven by jump or by traction in either component
//! - `command`: `midplane law` drives a point of a scene's law, and prints CSV
#![allow(missing_docs, clippy::unwrap_used)]

#[allow(dead_code)] // each program of tests uses a part of it
#[path = "../common/mod.rs"]
mod common;

mod closed_forms;
mod closing;
mod cohesive;
mod command;
mod coulomb;
mod coulomb_way;
mod extremes;
mod invariants;
mod path;
mod reference;
mod space;
mod steps;
mod tangent;
