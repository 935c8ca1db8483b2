//! Exact solutions with a circular interface: two rings under pressure and torque, and an inclusion in a plate.
//!
//! ```text
//! rings      u_r = A r + B/r,  u_t = w r − T/(4π μ r);  σ_rr = 2(λ + μ) A − 2μ B/r²,  σ_rt = T/(2π r²)
//! inclusion  harmonics 0 and 2: Airy terms r², r⁴ inside, ln r, r², r⁰, r⁻² outside
//! ```

use std::f64::consts::PI;

use nalgebra::{Matrix4, Vector4};

/// λ and μ in plane strain.
pub fn lame(e: f64, nu: f64) -> (f64, f64) {
    (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
}

/// u_r = c₀ r + c₁/r + (c₂ r + c₃ r³ + c₄/r + c₅/r³) cos 2θ, u_t = t₀ r + t₁/r + (t₂ r + t₃ r³ + t₄/r + t₅/r³) sin 2θ.
#[derive(Debug, Clone, Copy, Default)]
pub struct Polar {
    pub r: [f64; 6],
    pub t: [f64; 6],
}

impl Polar {
    pub fn u(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let r = x.hypot(y);
        let (c, s) = (x / r, y / r);
        let (c2, s2) = (c * c - s * s, 2.0 * s * c);
        let of = |k: &[f64; 6], f: f64| {
            k[0] * r + k[1] / r + (k[2] * r + k[3] * r.powi(3) + k[4] / r + k[5] / r.powi(3)) * f
        };
        let (ur, ut) = (of(&self.r, c2), of(&self.t, s2));
        [ur * c - ut * s, ur * s + ut * c]
    }

    /// The same as formulas of a scene.
    pub fn formulas(&self) -> [String; 2] {
        let of = |k: &[f64; 6], f: &str| {
            let r = "hypot(x,y)";
            format!(
                "(({:e})*{r} + ({:e})/{r} + (({:e})*{r} + ({:e})*{r}^3 + ({:e})/{r} + ({:e})/{r}^3)*{f}/{r}^2)",
                k[0], k[1], k[2], k[3], k[4], k[5]
            )
        };
        let (ur, ut) = (of(&self.r, "(x^2-y^2)"), of(&self.t, "(2*x*y)"));
        [format!("({ur}*x - {ut}*y)/hypot(x,y)"), format!("({ur}*y + {ut}*x)/hypot(x,y)")]
    }
}

/// A body on either side of the circle, the traction there, and the material.
pub struct Round {
    pub e: [f64; 2],
    pub nu: [f64; 2],
    pub u: [Polar; 2],
    /// t_n = n₀ + n₂ cos 2θ
    pub normal: [f64; 2],
    /// σ_rt = t₀ + t₂ sin 2θ; the tangent of C runs clockwise where n points outwards, so t_t = −σ_rt.
    pub shear: [f64; 2],
}

/// Rings a < r < b and b < r < c: pressure p inside, torque T about the axis, no rotation at r = a.
pub fn rings(kn: f64, kt: f64, p: f64, torque: f64) -> Round {
    let ([a, b, c], e, nu) = ([1.0, 1.5, 2.0], [3e4, 1e4], [0.2, 0.3]);
    let [(l1, m1), (l2, m2)] = [0, 1].map(|i| lame(e[i], nu[i]));
    let radial = |l: f64, m: f64, r: f64| [2.0 * (l + m), -2.0 * m / (r * r)];
    let (s1a, s1b, s2b, s2c) = (radial(l1, m1, a), radial(l1, m1, b), radial(l2, m2, b), radial(l2, m2, c));
    let matrix = Matrix4::new(
        s1a[0],
        s1a[1],
        0.0,
        0.0,
        0.0,
        0.0,
        s2c[0],
        s2c[1],
        s1b[0],
        s1b[1],
        -s2b[0],
        -s2b[1],
        e[0] * (-b - s1b[0] / kn),
        e[0] * (-1.0 / b - s1b[1] / kn),
        e[0] * b,
        e[0] / b,
    );
    let x = matrix.lu().solve(&Vector4::new(-p, 0.0, 0.0, 0.0)).unwrap();
    let twist = |m: f64| torque / (4.0 * PI * m);
    let w1 = twist(m1) / (a * a);
    let jump = torque / (2.0 * PI * b * b * kt);
    let w2 = (w1 * b - twist(m1) / b + jump + twist(m2) / b) / b;
    let polar = |a: f64, b: f64, w: f64, m: f64| Polar {
        r: [a, b, 0.0, 0.0, 0.0, 0.0],
        t: [w, -twist(m), 0.0, 0.0, 0.0, 0.0],
    };
    Round {
        e,
        nu,
        u: [polar(x[0], x[1], w1, m1), polar(x[2], x[3], w2, m2)],
        normal: [s1b[0] * x[0] + s1b[1] * x[1], 0.0],
        shear: [torque / (2.0 * PI * b * b), 0.0],
    }
}

/// An inclusion of radius 1 in an infinite plate under σ_x = 1 far away.
pub fn inclusion(kn: f64, kt: f64) -> Round {
    let (e, nu, a, s, d) = ([3e4, 1e4], [0.2, 0.3], 1.0, 0.5, 0.5);
    let [(_, mi), (_, mm)] = [0, 1].map(|i| lame(e[i], nu[i]));
    let [ki, km] = nu.map(|nu| 3.0 - 4.0 * nu);
    let (fi, fm) = ((ki - 1.0) * a / (4.0 * mi), (km - 1.0) * a / (4.0 * mm));
    let a0 = s * (fm + a / (2.0 * mm)) / (1.0 / kn + fi + a / (2.0 * mm));
    let b0 = (s - a0) * a * a;
    let (hi, hm) = (a / (2.0 * mi), a / (2.0 * mm));
    // rows: σ_rr, σ_rt, normal spring, tangential spring; columns α, β a², γ/a², δ/a⁴
    let rows = Matrix4::new(
        -2.0,
        0.0,
        4.0,
        6.0,
        2.0,
        6.0,
        2.0,
        6.0,
        -2.0 / kn - 2.0 * hi,
        (ki - 3.0) * hi,
        -(km + 1.0) * hm,
        -2.0 * hm,
        2.0 / kt + 2.0 * hi,
        6.0 / kt + (ki + 3.0) * hi,
        (km - 1.0) * hm,
        -2.0 * hm,
    );
    let right = Vector4::new(d, -d, d * hm, -d * hm);
    let scale = Vector4::from_fn(|i, _| 1.0 / rows.row(i).amax());
    let x = (Matrix4::from_diagonal(&scale) * rows).lu().solve(&scale.component_mul(&right)).unwrap();
    let [alpha, beta, gamma, delta] = [x[0], x[1], x[2], x[3]];
    let inside = Polar {
        r: [
            a0 * (ki - 1.0) / (4.0 * mi),
            0.0,
            -2.0 * alpha / (2.0 * mi),
            (ki - 3.0) * beta / (2.0 * mi),
            0.0,
            0.0,
        ],
        t: [0.0, 0.0, 2.0 * alpha / (2.0 * mi), (ki + 3.0) * beta / (2.0 * mi), 0.0, 0.0],
    };
    let outside = Polar {
        r: [
            s * (km - 1.0) / (4.0 * mm),
            b0 / (2.0 * mm),
            d / (2.0 * mm),
            0.0,
            (km + 1.0) * gamma / (2.0 * mm),
            2.0 * delta / (2.0 * mm),
        ],
        t: [0.0, 0.0, -d / (2.0 * mm), 0.0, -(km - 1.0) * gamma / (2.0 * mm), 2.0 * delta / (2.0 * mm)],
    };
    Round { e, nu, u: [inside, outside], normal: [a0, -2.0 * alpha], shear: [0.0, 2.0 * alpha + 6.0 * beta] }
}
