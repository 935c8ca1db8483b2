//! Sides that are lines: chains of edges, which place faces which, the segments of C and the grid on it.

pub(super) mod angle;
pub(super) mod chain;
pub(super) mod faults;
pub(super) mod grid;
pub(super) mod link;
pub(super) mod midplane;
pub(super) mod pair;
pub(super) mod parts;
pub(super) mod seam;
pub(super) mod segment;

use super::Gap;
use chain::Chain;
use link::Side;
use midplane::Midplane;
