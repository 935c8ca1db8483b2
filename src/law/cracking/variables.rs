//! Variables of the cracking law.

use crate::law::variable::LawVariable;

/// Index of the work W spent on fracture among what the law knows of a point.
pub const WORK: usize = 0;

/// Variables of the law.
pub(in crate::law) const VARIABLES: [LawVariable; 1] = [LawVariable {
    name: "fracture_work",
    unit: "stress × length",
    meaning: "work W spent on fracture, friction left out",
    place: WORK,
}];
