//! Equilibria and load histories: `cargo test --release --test equilibrium friction::` runs the tests of one file.
//!
//! ## Steps, loads and supports
//!
//! - `loads`: loads, supports and ramps meet their exact solutions; what nothing holds is told
//! - `ramp`: an increment of an elastic ramp does not depend on those before
//! - `steps`: supports come and go without a trace of their own
//! - `own_strains`: temperature and own strains strain what is free and stress what is held
//! - `in_situ`: initial stress loads nothing by itself
//! - `stages`: parts come free of stress, and go with their forces let go over a step
//! - `tunnel`: what is dug out of ground under stress moves it as Kirsch says
//! - `gallery`: scenes of the gallery whose answer is known by hand give it
//!
//! ## Contact and friction
//!
//! - `gap`: faces with a gap carry nothing until they meet
//! - `closure`: a joint with a `closure` follows its hyperbola under any load and back
//! - `friction`: Coulomb friction on a mesh agrees with its closed forms
//! - `shear_box`: a layer sheared over another is found quadratically, with the energy in balance
//!
//! ## Cracks
//!
//! - `tension`: two bars with a cohesive interface follow the exact path and spend the fracture energy
//! - `opening`: opening and sliding at once passes through the mode in which σ stays at zero
//! - `varying`: numbers of a law may be formulas of the place
//! - `delamination`: beams come apart at the fracture energy in both modes
//! - `dcb`: a double cantilever beam opens as a converged model of quadratic elements
//! - `confinement`: a box with a cracking interface is sheared to its end at any confinement
//! - `cycles`: what opens and closes again carries its load through faces that touch
//!
//! ## Path
//!
//! - `snapback`: a bar that snaps back is followed along its exact path
//! - `increments`: the answer does not depend on the increments
//! - `structures`: structures with many interfaces end alike whatever the increments
//! - `energies`: work, stored, dissipated and released energy balance to second order
//! - `resume`: a history that goes on from a checkpoint is the same bit for bit
//!
//! ## Water
//!
//! - `water`: water in a joint leaves the law the effective traction
//! - `flow`: steady flow along joints is exact for the apertures of their grids
//! - `pressurised`: fractures under pressure open as theory and an independent code say
//! - `dam`: force and moment of a dam's joint are those of statics at every row
//!
//! ## Equations
//!
//! - `agreement`: all forms of the equations find the same
//! - `parts`: factored in parts or joined, a model has the same displacements
//! - `walls`: walls of many bricks come out the same on condensed bricks and on all displacements
//! - `ordering`: nested dissection is a postordered permutation with a sparse factor
//! - `memory`: a run that does not fit in memory is refused before its first factor
#![allow(missing_docs, clippy::unwrap_used)]

#[allow(dead_code)] // each program of tests uses a part of it
#[path = "../common/mod.rs"]
mod common;

mod agreement;
mod closure;
mod confinement;
mod cycles;
mod dam;
mod dcb;
mod delamination;
mod energies;
mod flow;
mod friction;
mod gallery;
mod gap;
mod in_situ;
mod increments;
mod loads;
mod memory;
mod opening;
mod ordering;
mod own_strains;
mod parts;
mod pressurised;
mod ramp;
mod resume;
mod shear_box;
mod snapback;
mod stages;
mod steps;
mod structures;
mod tension;
mod tunnel;
mod varying;
mod walls;
mod water;
