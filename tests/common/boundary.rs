//! Fractures in an infinite plane by displacement discontinuities, constant on every element (Crouch and Starfield 1983): an
//! independent code to compare with, with contact and friction.

use nalgebra::{DMatrix, DVector};

/// Changes of an element's contact after which it stays.
const OFTEN: usize = 6;

/// Part of a fracture: its ends, and what it carries.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    pub ends: [[f64; 2]; 2],
    pub state: Contact,
}

/// Contact of the faces of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// Open under a pressure that does not depend on it.
    Pressed(f64),
    Sticks,
    /// Slides with this sign of the shear stress.
    Slides(f64),
    Opens,
}

/// Elastic plane under a remote stress (xx, yy, xy).
pub struct Plane {
    pub young: f64,
    pub poisson: f64,
    pub remote: [f64; 3],
    pub friction: f64,
}

/// Opening, slip, normal and shear stress at the middle of an element.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub opening: f64,
    pub slip: f64,
    pub normal: f64,
    pub shear: f64,
}

impl Element {
    fn middle(&self) -> [f64; 2] {
        [0, 1].map(|d| 0.5 * (self.ends[0][d] + self.ends[1][d]))
    }

    fn half(&self) -> f64 {
        let [p, q] = self.ends;
        0.5 * (q[0] - p[0]).hypot(q[1] - p[1])
    }

    /// Unit vector along it.
    fn along(&self) -> [f64; 2] {
        let [p, q] = self.ends;
        [0, 1].map(|d| (q[d] - p[d]) / (2.0 * self.half()))
    }
}

impl Plane {
    /// Stresses (normal, shear) on a target for unit discontinuities (along, across) of a source.
    fn influence(&self, target: &Element, source: &Element) -> [[f64; 2]; 2] {
        let (g, nu) = (self.young / (2.0 * (1.0 + self.poisson)), self.poisson);
        let (a, [c, s]) = (source.half(), source.along());
        let ([x0, y0], [x1, y1]) = (source.middle(), target.middle());
        let (dx, dy) = (x1 - x0, y1 - y0);
        let (x, y) = (c * dx + s * dy, c * dy - s * dx);
        let k = 1.0 / (4.0 * std::f64::consts::PI * (1.0 - nu));
        let ends = [x - a, x + a];
        let square = ends.map(|e| e * e + y * y);
        let both = |f: &dyn Fn(f64, f64) -> f64| k * (f(ends[0], square[0]) - f(ends[1], square[1]));
        let xy = both(&|_, r| y / r);
        let xx = both(&|e, r| e / r);
        let xyy = both(&|e, r| (e * e - y * y) / (r * r));
        let yyy = 2.0 * y * both(&|e, r| e / (r * r));
        let yy = -xx;
        // local stresses (xx, yy, xy) for unit D along and D across
        let local = [[2.0 * xy + y * xyy, -y * xyy, yy + y * yyy], [yy + y * yyy, yy - y * yyy, -y * xyy]];
        let [ct, st] = target.along();
        let (cr, sr) = (c * ct + s * st, c * st - s * ct); // from the source's axes to the target's
        local.map(|[xx, yy, xy]| {
            let normal = xx * sr * sr + yy * cr * cr - 2.0 * xy * sr * cr;
            let shear = (yy - xx) * sr * cr + xy * (cr * cr - sr * sr);
            [2.0 * g * normal, 2.0 * g * shear]
        })
    }

    /// Finds what all elements do.
    pub fn solve(&self, elements: &mut [Element]) -> Vec<Found> {
        let n = elements.len();
        let mut all = vec![[[0.0; 2]; 2]; n * n];
        for i in 0..n {
            for j in 0..n {
                all[i * n + j] = self.influence(&elements[i], &elements[j]);
            }
        }
        let remote = |element: &Element| {
            let ([xx, yy, xy], [c, s]) = (self.remote, element.along());
            [xx * s * s + yy * c * c - 2.0 * xy * s * c, (yy - xx) * s * c + xy * (c * c - s * s)]
        };
        let mut changes = vec![0; n];
        for _ in 0..50 {
            let (mut matrix, mut right) = (DMatrix::zeros(2 * n, 2 * n), DVector::zeros(2 * n));
            for (i, element) in elements.iter().enumerate() {
                let [normal, shear] = remote(element);
                let (rows, given) = match element.state {
                    Contact::Pressed(p) => ([Some([1.0, 0.0]), Some([0.0, 1.0])], [-p - normal, -shear]),
                    Contact::Opens => ([Some([1.0, 0.0]), Some([0.0, 1.0])], [-normal, -shear]),
                    Contact::Sticks => ([None, None], [0.0; 2]),
                    // τ + sign μ σ = 0
                    Contact::Slides(sign) => {
                        let m = sign * self.friction;
                        ([None, Some([m, 1.0])], [0.0, -shear - m * normal])
                    }
                };
                for (r, (row, given)) in rows.iter().zip(given).enumerate() {
                    match row {
                        // D along is the second unknown of a sticking or sliding element's rows, D across the first
                        None => matrix[(2 * i + r, 2 * i + 1 - r)] = 1.0,
                        Some([by_normal, by_shear]) => {
                            for j in 0..n {
                                for d in 0..2 {
                                    let [sn, ss] = all[i * n + j][d];
                                    matrix[(2 * i + r, 2 * j + d)] = by_normal * sn + by_shear * ss;
                                }
                            }
                        }
                    }
                    right[2 * i + r] = given;
                }
            }
            let d = matrix.lu().solve(&right).unwrap();
            let found: Vec<Found> = (0..n)
                .map(|i| {
                    let [mut normal, mut shear] = remote(&elements[i]);
                    for j in 0..n {
                        for k in 0..2 {
                            normal += all[i * n + j][k][0] * d[2 * j + k];
                            shear += all[i * n + j][k][1] * d[2 * j + k];
                        }
                    }
                    // D is that of the lower face less that of the upper one
                    Found { opening: -d[2 * i + 1], slip: -d[2 * i], normal, shear }
                })
                .collect();
            let next = |element: &Element, found: &Found| match element.state {
                Contact::Pressed(p) => Contact::Pressed(p),
                Contact::Opens if found.opening < 0.0 => Contact::Slides(found.shear.signum()),
                Contact::Opens => Contact::Opens,
                _ if found.normal > 0.0 => Contact::Opens,
                Contact::Sticks if found.shear.abs() > -self.friction * found.normal => {
                    Contact::Slides(found.shear.signum())
                }
                Contact::Slides(sign) if sign * found.slip < 0.0 => Contact::Sticks,
                state => state,
            };
            // what goes to and fro beside a junction stays as it is
            let mut settled = true;
            for ((element, found), changes) in elements.iter_mut().zip(&found).zip(&mut changes) {
                let state = next(element, found);
                if state != element.state && *changes < OFTEN {
                    *changes += 1;
                    element.state = state;
                    settled = false;
                }
            }
            if settled {
                return found;
            }
        }
        panic!("contact does not settle");
    }
}

/// Elements of equal size from one place to another.
pub fn elements(from: [f64; 2], to: [f64; 2], n: usize, state: Contact) -> Vec<Element> {
    let at = |k: usize| [0, 1].map(|d| from[d] + (to[d] - from[d]) * k as f64 / n as f64);
    (0..n).map(|k| Element { ends: [at(k), at(k + 1)], state }).collect()
}
