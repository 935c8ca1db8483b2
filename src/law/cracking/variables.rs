//! Variables of the cracking law.

use crate::law::variable::LawVariable;

/// Index of the work W spent on fracture among what the law knows of a point.
pub const WORK: usize = 0;
/// Index of the opening o.
pub(super) const OPENING: usize = 1;
/// Index of the stiffness k.
pub(super) const BRIDGE: usize = 2;
/// Index of the slip q.
pub(super) const SLIP_OPEN: usize = 3;

/// Variables of the law whose cracks close; the first one is all that the published law has.
pub(in crate::law) const VARIABLES: [LawVariable; 4] = [
    LawVariable {
        name: "fracture_work",
        unit: "stress × length",
        meaning: "work W spent on fracture, friction left out",
        place: WORK,
    },
    LawVariable {
        name: "opening",
        unit: "length",
        meaning: "normal jump o made under tension, which closes freely",
        place: OPENING,
    },
    LawVariable {
        name: "bridge_stiffness",
        unit: "stress / length",
        meaning: "secant stiffness k of an opened crack, K_N where intact, 0 where nothing ties the faces",
        place: BRIDGE,
    },
    LawVariable {
        name: "slip_open",
        unit: "length",
        meaning: "slip q since the faces last touched",
        place: SLIP_OPEN,
    },
];
