//! Vectors in space as arrays; in the plane the last component is exactly zero.

/// p + q
pub fn plus<const D: usize>(p: [f64; D], q: [f64; D]) -> [f64; D] {
    std::array::from_fn(|d| p[d] + q[d])
}

/// p − q
pub fn minus<const D: usize>(p: [f64; D], q: [f64; D]) -> [f64; D] {
    std::array::from_fn(|d| p[d] - q[d])
}

/// p · q
pub fn dot<const D: usize>(p: [f64; D], q: [f64; D]) -> f64 {
    (1..D).fold(p[0] * q[0], |sum, d| sum + p[d] * q[d])
}

/// |p|
pub fn norm<const D: usize>(p: [f64; D]) -> f64 {
    dot(p, p).sqrt() // as exact as hypot but for sizes beyond 1e±154
}

/// |p| by `hypot`, free of overflow.
pub fn length<const D: usize>(p: [f64; D]) -> f64 {
    p.into_iter().fold(0.0, f64::hypot)
}

/// p × q
pub fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// v / |v|
pub fn unit<const D: usize>(v: [f64; D]) -> [f64; D] {
    let length = norm(v);
    v.map(|v| v / length)
}

/// A vector of the plane in space.
pub fn in_space([x, y]: [f64; 2]) -> [f64; 3] {
    [x, y, 0.0]
}

/// The components in the plane of a vector in space.
pub fn in_plane([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x, y]
}
