//! Sides that are lines: chains of edges, which place faces which, the segments of C and the grid on it. They fill the table of
//! places (`super::place`).

mod angle;
mod cells;
mod chain;
mod faults;
mod grid;
mod link;
mod midplane;
mod pair;
mod parts;
mod regular;
mod seam;
mod segment;
mod slaved;
mod table;

pub use link::Side;
pub use midplane::LineMidplane;
pub use parts::join;
pub use table::table;

use super::{Gap, Piece};
use chain::Chain;
