//! Exact solutions of two layers with an interface at y = 0 under loads that are harmonic in x.
//!
//! ```text
//!   u_x = P(y) sin kx,   u_y = Q(y) cos kx      0 < x < L = π/k, planes of symmetry at both ends
//!   σ_yy = ((λ + 2μ) Q′ + λ k P) cos kx,        σ_xy = μ (P′ − k Q) sin kx
//! ```

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

/// λ and μ in plane strain.
pub fn lame(e: f64, nu: f64) -> (f64, f64) {
    (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
}

/// Two layers, the lower one clamped below, under σ_yy = −p₀ cos kx on top (no body force): a constant linear system in
/// (P, Q, P′, Q′) through each layer, by matrix exponentials.
pub struct Strip {
    pub e: [f64; 2],
    pub nu: [f64; 2],
    pub h: [f64; 2],
    pub k: f64,
    pub kn: f64,
    pub kt: f64,
    pub p0: f64,
}

/// Values that are compared.
pub struct Answer {
    /// Amplitude of u_y on the top.
    pub q_top: f64,
    /// Amplitude of the normal traction, cos kx.
    pub normal: f64,
    /// Amplitude of the shear traction, sin kx.
    pub shear: f64,
    /// Strain energy of bodies and interface per thickness.
    pub energy: f64,
}

impl Strip {
    /// The set of the published values: E 10000 and 4000 MPa, ν 0.2 and 0.3, heights 0.8 and 0.6 m, k = π, p₀ = 5 MPa.
    pub fn open(kn: f64, kt: f64) -> Strip {
        Strip { e: [1e4, 4e3], nu: [0.2, 0.3], h: [0.8, 0.6], k: std::f64::consts::PI, kn, kt, p0: 5.0 }
    }

    fn system(&self, layer: usize) -> Matrix4<f64> {
        let ((l, m), k) = (lame(self.e[layer], self.nu[layer]), self.k);
        let c = l + 2.0 * m;
        Matrix4::new(
            0.0,
            0.0,
            1.0,
            0.0,
            0.0,
            0.0,
            0.0,
            1.0,
            c * k * k / m,
            0.0,
            0.0,
            k * (l + m) / m,
            0.0,
            m * k * k / c,
            -k * (l + m) / c,
            0.0,
        )
    }

    /// Traction amplitudes (σ_xy, σ_yy) of a state.
    fn traction(&self, layer: usize, z: Vector4<f64>) -> Vector2<f64> {
        let ((l, m), k) = (lame(self.e[layer], self.nu[layer]), self.k);
        Vector2::new(m * (z[2] - k * z[1]), (l + 2.0 * m) * z[3] + l * k * z[0])
    }

    pub fn solve(&self) -> Answer {
        let through = [0, 1].map(|layer| (self.system(layer) * self.h[layer]).exp());
        let (l, m) = lame(self.e[1], self.nu[1]);
        // state below and above the interface, and tractions on the top, for unit slopes P′, Q′ at the bottom
        let unit = |i: usize| {
            let below: Vector4<f64> = through[0].column(2 + i).into();
            let t = self.traction(0, below);
            let (p, q) = (below[0] + t[0] / self.kt, below[1] + t[1] / self.kn);
            let above = Vector4::new(p, q, t[0] / m + self.k * q, (t[1] - l * self.k * p) / (l + 2.0 * m));
            (t, through[1] * above)
        };
        let ((t0, top0), (t1, top1)) = (unit(0), unit(1));
        let scale = self.e[0];
        let columns =
            Matrix2::from_columns(&[self.traction(1, top0) / scale, self.traction(1, top1) / scale]);
        let slopes = columns.lu().solve(&Vector2::new(0.0, -self.p0 / scale)).unwrap();
        let t = t0 * slopes[0] + t1 * slopes[1];
        let q_top = top0[1] * slopes[0] + top1[1] * slopes[1];
        let length = std::f64::consts::PI / self.k;
        Answer { q_top, normal: t[1], shear: t[0], energy: 0.25 * self.p0 * q_top.abs() * length }
    }
}

/// Manufactured solution: P and Q quadratic in y, with the body force that makes it so (coefficients at y = 0).
pub struct Manufactured {
    pub e: [f64; 2],
    pub nu: [f64; 2],
    pub h: [f64; 2],
    pub k: f64,
    /// P = p[0] + p[1] y + p[2] y² of both layers.
    pub p: [[f64; 3]; 2],
    /// Q likewise.
    pub q: [[f64; 3]; 2],
    /// Amplitudes (σ_xy, σ_yy) at the interface.
    pub traction: [f64; 2],
    pub kn: f64,
    pub kt: f64,
}

impl Manufactured {
    /// The published set: U 0.001 and −0.0004, V 0.0007 and 0.0005, p₂ = 0.002, q₂ = −0.0015.
    pub fn open() -> Manufactured {
        let (e, nu, h, k) = ([1e4, 4e3], [0.2, 0.3], [0.8, 0.6], std::f64::consts::PI);
        let (kn, kt) = (2e4, 1e4);
        let [(l1, m1), (l2, m2)] = [0, 1].map(|i| lame(e[i], nu[i]));
        let h1: f64 = h[0];
        let p = [0.001 - 0.0004, (0.001 - 0.0008) / h1, -0.0004 / (h1 * h1)];
        let q = [0.0007 + 0.0005, (0.0007 + 0.001) / h1, 0.0005 / (h1 * h1)];
        let tx = m1 * (p[1] - k * q[0]);
        let ty = (l1 + 2.0 * m1) * q[1] + l1 * k * p[0];
        let (p0, q0) = (p[0] + tx / kt, q[0] + ty / kn);
        let above_p = [p0, tx / m2 + k * q0, 0.002];
        let above_q = [q0, (ty - l2 * k * p0) / (l2 + 2.0 * m2), -0.0015];
        Manufactured { e, nu, h, k, p: [p, above_p], q: [q, above_q], traction: [tx, ty], kn, kt }
    }

    /// P, Q and their first and second derivatives.
    fn amplitudes(&self, layer: usize, y: f64) -> [[f64; 3]; 2] {
        [self.p[layer], self.q[layer]]
            .map(|c| [c[0] + c[1] * y + c[2] * y * y, c[1] + 2.0 * c[2] * y, 2.0 * c[2]])
    }

    pub fn u(&self, layer: usize, x: f64, y: f64) -> [f64; 2] {
        let [p, q] = self.amplitudes(layer, y);
        [p[0] * (self.k * x).sin(), q[0] * (self.k * x).cos()]
    }

    /// (ε_xx, ε_yy, γ_xy)
    pub fn strain(&self, layer: usize, x: f64, y: f64) -> [f64; 3] {
        let ([p, q], k) = (self.amplitudes(layer, y), self.k);
        let (sin, cos) = (k * x).sin_cos();
        [k * p[0] * cos, q[1] * cos, (p[1] - k * q[0]) * sin]
    }

    /// Body force as expressions in x and y: amplitudes are quadratic in y.
    pub fn body_force(&self, layer: usize) -> [String; 2] {
        let ((l, m), k) = (lame(self.e[layer], self.nu[layer]), self.k);
        let c = l + 2.0 * m;
        let (p, q) = (self.p[layer], self.q[layer]);
        // f_x = k (c k P + λ Q′) − μ (P″ − k Q′),  f_y = −(k μ (P′ − k Q) + c Q″ + λ k P′)
        let x = [
            k * (c * k * p[0] + l * q[1]) - m * (2.0 * p[2] - k * q[1]),
            k * (c * k * p[1] + l * 2.0 * q[2]) + m * k * 2.0 * q[2],
            k * c * k * p[2],
        ];
        let y = [
            -(k * m * (p[1] - k * q[0]) + c * 2.0 * q[2] + l * k * p[1]),
            -(k * m * (2.0 * p[2] - k * q[1]) + l * k * 2.0 * p[2]),
            k * m * k * q[2],
        ];
        let quadratic =
            |a: [f64; 3], f: &str| format!("(({:e}) + ({:e})*y + ({:e})*y^2)*{f}(pi*x)", a[0], a[1], a[2]);
        [quadratic(x, "sin"), quadratic(y, "cos")]
    }

    /// Traction on the top as expressions.
    pub fn top(&self) -> [String; 2] {
        let ((l, m), k) = (lame(self.e[1], self.nu[1]), self.k);
        let [p, q] = self.amplitudes(1, self.h[1]);
        let (tx, ty) = (m * (p[1] - k * q[0]), (l + 2.0 * m) * q[1] + l * k * p[0]);
        [format!("({tx:e})*sin(pi*x)"), format!("({ty:e})*cos(pi*x)")]
    }
}
