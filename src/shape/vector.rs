//! Vectors of the plane as pairs.

pub fn plus(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] + q[0], p[1] + q[1]]
}

pub fn minus(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

pub fn dot(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}

pub fn norm(p: [f64; 2]) -> f64 {
    dot(p, p).sqrt() // as exact as hypot but for sizes beyond 1e±154
}

pub fn unit(v: [f64; 2]) -> [f64; 2] {
    let length = norm(v);
    [v[0] / length, v[1] / length]
}
