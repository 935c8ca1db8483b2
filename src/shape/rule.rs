//! Quadrature: points and weights on the line [−1, 1], the unit triangle and the square [−1, 1]².

/// Points of a plane rule: (ξ, η, weight).
pub type Rule = &'static [[f64; 3]];

/// Points of a line rule: (ξ, weight).
pub type LineRule = &'static [[f64; 2]];

const G2: f64 = 0.577_350_269_189_625_8; // 1/√3
const G3: f64 = 0.774_596_669_241_483_4; // √(3/5)

/// Two Gauss points, degree 3.
pub const GAUSS_2: LineRule = &[[-G2, 1.0], [G2, 1.0]];
/// Three Gauss points, degree 5.
pub const GAUSS_3: LineRule = &[[-G3, 5.0 / 9.0], [0.0, 8.0 / 9.0], [G3, 5.0 / 9.0]];
/// Two Lobatto points (the ends), degree 1.
pub const LOBATTO_2: LineRule = &[[-1.0, 1.0], [1.0, 1.0]];
/// Three Lobatto points (ends and middle), degree 3.
pub const LOBATTO_3: LineRule = &[[-1.0, 1.0 / 3.0], [0.0, 4.0 / 3.0], [1.0, 1.0 / 3.0]];

/// Centroid, degree 1.
pub(super) const TRIANGLE_1: Rule = &[[1.0 / 3.0, 1.0 / 3.0, 0.5]];
/// Three inner points, degree 2.
pub(super) const TRIANGLE_3: Rule = &[
    [1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
];

// Dunavant's rule of degree 4: two orbits of three points.
const A: f64 = 0.445_948_490_915_965;
const WA: f64 = 0.111_690_794_839_005_5;
const B: f64 = 0.091_576_213_509_771;
const WB: f64 = 0.054_975_871_827_661_16;
/// Six points, degree 4.
pub(super) const TRIANGLE_6: Rule = &[
    [A, A, WA],
    [1.0 - 2.0 * A, A, WA],
    [A, 1.0 - 2.0 * A, WA],
    [B, B, WB],
    [1.0 - 2.0 * B, B, WB],
    [B, 1.0 - 2.0 * B, WB],
];

// Radon's rule: the centroid and two orbits of three points, with √15.
const R: f64 = 3.872_983_346_207_417;
const C: f64 = (6.0 - R) / 21.0;
const WC: f64 = (155.0 - R) / 2400.0;
const D: f64 = (6.0 + R) / 21.0;
const WD: f64 = (155.0 + R) / 2400.0;
/// Seven points, degree 5.
pub(super) const TRIANGLE_7: Rule = &[
    [1.0 / 3.0, 1.0 / 3.0, 9.0 / 80.0],
    [C, C, WC],
    [1.0 - 2.0 * C, C, WC],
    [C, 1.0 - 2.0 * C, WC],
    [D, D, WD],
    [1.0 - 2.0 * D, D, WD],
    [D, 1.0 - 2.0 * D, WD],
];

/// 2×2 Gauss points, degree 3 in each direction.
pub(super) const SQUARE_4: Rule = &[[-G2, -G2, 1.0], [G2, -G2, 1.0], [G2, G2, 1.0], [-G2, G2, 1.0]];

const W_END: f64 = 5.0 / 9.0;
const W_MID: f64 = 8.0 / 9.0;
/// 3×3 Gauss points, degree 5 in each direction.
pub(super) const SQUARE_9: Rule = &[
    [-G3, -G3, W_END * W_END],
    [0.0, -G3, W_MID * W_END],
    [G3, -G3, W_END * W_END],
    [-G3, 0.0, W_END * W_MID],
    [0.0, 0.0, W_MID * W_MID],
    [G3, 0.0, W_END * W_MID],
    [-G3, G3, W_END * W_END],
    [0.0, G3, W_MID * W_END],
    [G3, G3, W_END * W_END],
];
