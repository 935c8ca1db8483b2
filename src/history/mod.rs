//! The load history: increments, Newton's policy, path following, viscous relaxation, energies.

mod arclength;
mod balance;
mod beyond;
mod clock;
mod course;
mod energy;
mod engine;
mod estimate;
mod failure;
mod laws;
mod linear;
mod loading;
mod march;
pub mod memory;
mod newton;
mod parts;
mod path;
mod snap;
mod state;
mod strategy;
mod viscous;

pub use balance::{Resultant, resultant};
pub use beyond::Beyond;
pub use clock::{Clock, processor};
pub use march::{Means, Place, Snap, Totals, march, march_within};
pub use state::State;
pub use strategy::Estimate;
