//! The load history: increments, Newton's policy, path following, viscous relaxation, energies.

mod arclength;
mod balance;
mod beyond;
mod clock;
mod course;
mod energy;
mod equilibrium;
mod failure;
mod loading;
mod march;
pub mod memory;
mod parts;
mod path;
mod snap;
mod state;
mod viscous;

pub use balance::{Resultant, resultant};
pub use beyond::Beyond;
pub use clock::{Clock, processor};
pub use equilibrium::strategy::Estimate;
pub use march::{Means, Place, Snap, Totals, march, march_within};
pub use state::State;
