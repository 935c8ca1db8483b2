//! Meshes, pairing, coupling, and their verification: `cargo test --release --test coupling patch::` runs the tests of one file.
//!
//! ## Meshes
//!
//! - `mesh_reading`: the mesh holds what an MSH 4.1 file says, in every encoding and numbering
//! - `mesh_damaged`: a damaged file gives a sound mesh or one clear error
//! - `mesh_gmsh`: gmsh makes every kind of cell, and each way in which it fails is told
//! - `mesh_cache`: nothing is meshed twice, and everything that changes a mesh is noticed
//! - `mesh_rows`: physical groups work or are refused by name, end to end
//! - `shared_mesh`: a conforming mesh opens into subdomains with nodes of their own
//!
//! ## Pairing
//!
//! - `joints`: geometry at its extremes is joined exactly or refused with the reason
//! - `fractures`: a fracture drawn inside a body is an interface once the mesh is opened along it
//! - `slit`: a slit inside a body is joined to itself
//! - `inclusion`: `between` finds the closed curve of two parts of one mesh
//! - `junctions`: a constant stress passes X- and T-junctions to rounding
//!
//! ## Coupling
//!
//! - `straight`: jumps of two straight sides are those of the classical elements, constant and linear ones exact
//! - `curves`: labels, place and size of curved, kinked, graded and closed sides do not matter
//! - `ends`: where an interface ends on held nodes, unmatched meshes carry what matched ones do
//! - `cantilever`: `projected` transmits shear without spurious normal traction at every stiffness
//! - `stiff`: `projected` loses no digits to the stiffness of an interface
//! - `fit`: interferences and clearances carry what theory says
//!
//! ## Verification
//!
//! - `example1`: two layers under pressure shorten as one column (paper Example 1)
//! - `example2`: two layers sheared over each other carry the curve of one point (paper Example 2)
//! - `patch`: a constant-stress patch of two materials is exact on any two meshes
//! - `verify`: bending patch, manufactured solution, harmonic strip, stiff and soft limits converge to exact solutions
//! - `round`: circular interfaces converge with the rates of their elements
//! - `cook`: Cook's membrane with a cut deflects as its reference
#![allow(missing_docs, clippy::unwrap_used)]

#[allow(dead_code)] // each program of tests uses a part of it
#[path = "../common/mod.rs"]
mod common;

mod cantilever;
mod cook;
mod curves;
mod ends;
mod example1;
mod example2;
mod fit;
mod fractures;
mod inclusion;
mod joints;
mod junctions;
mod mesh_cache;
mod mesh_damaged;
mod mesh_gmsh;
mod mesh_reading;
mod mesh_rows;
mod patch;
mod round;
mod shared_mesh;
mod slit;
mod stiff;
mod straight;
mod verify;
