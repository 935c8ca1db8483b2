//! The way of an increment: elastic pieces, and sub-steps where the surface is reached.
//!
//! The way is elastic up to the onset of cracking, found exactly, then runs in sub-steps (`sub_steps`). Elastic pieces end where
//! a crack changes its regime (`crack`), found exactly too: the elastic law is straight between.

use nalgebra::{SMatrix, SVector};

use super::super::local::{N, direction, shear};
use super::crack::Regime;
use super::elastic::{margin, stiff_rows};
use super::march::{Slopes, WayPoint};
use super::mode::Mode;
use super::surface::Surface;

/// A way under way.
pub(super) struct LawWay<'a, const D: usize> {
    pub surface: &'a Surface,
    pub change: SVector<f64, D>,
    pub point: WayPoint<D>,
    pub slopes: Slopes<D>,
    /// Fraction of the way that is done, and the derivative of the place there by the jump.
    pub fraction: f64,
    pub here: SMatrix<f64, D, D>,
    /// Sub-steps done.
    pub count: usize,
}

impl<'a, const D: usize> LawWay<'a, D> {
    pub fn new(surface: &'a Surface, from: WayPoint<D>, change: SVector<f64, D>) -> LawWay<'a, D> {
        let (slopes, here) = (Slopes::none(), SMatrix::zeros());
        LawWay { surface, change, point: from, slopes, fraction: 0.0, here, count: 0 }
    }

    /// Goes on elastically: to the end (true) or to the surface.
    pub fn elastic(&mut self) -> bool {
        loop {
            let rest = self.change * (1.0 - self.fraction);
            if self.point.crack.regime == Regime::Free {
                if rest[N] >= 0.0 || self.point.crack.gap + rest[N] > 0.0 {
                    self.stay_open(rest);
                    return true;
                }
                self.touch(rest);
                continue;
            }
            let crack = self.point.crack;
            let k = [crack.slope(self.surface), self.surface.kt];
            let rate = SVector::from_fn(|i, _| k[usize::from(i != N)] * rest[i]);
            let border = crack.border(self.surface, rest[N]);
            let part = border.map_or(1.0, |gap| ((gap - crack.gap) / rest[N]).clamp(0.0, 1.0));
            let end = self.point.traction + rate * part;
            let now = self.surface.at(self.point.work);
            if now.hyperbola(end[N], shear(&end)) > margin(self.surface, end) {
                let (part, by_jump) = self.onset(k, rate, part);
                self.advance(rest, k, part, by_jump);
                self.settle(rest[N] > 0.0);
                return false;
            }
            let turned = match border {
                Some(_) if part < 1.0 => {
                    -(self.slopes.crack.gap + self.ahead().row(N).transpose() * part) / rest[N]
                }
                _ => SVector::zeros(),
            };
            self.advance(rest, k, part, turned);
            self.point.mode = Mode::Elastic;
            if part == 1.0 {
                self.settle(rest[N] > 0.0);
                return true;
            }
            self.cross(rest[N] > 0.0);
        }
    }

    /// d(what is left of the way).
    fn ahead(&self) -> SMatrix<f64, D, D> {
        SMatrix::identity() - self.here
    }

    /// Goes elastically to a part of the rest.
    fn advance(&mut self, rest: SVector<f64, D>, k: [f64; 2], part: f64, by_jump: SVector<f64, D>) {
        let moved = self.ahead() * part + rest * by_jump.transpose();
        let k = |i: usize| k[usize::from(i != N)];
        self.slopes.traction += SMatrix::<f64, D, D>::from_fn(|i, j| k(i) * moved[(i, j)]);
        self.slopes.across += self.surface.kt * (part * (1.0 - self.fraction));
        self.point.traction += SVector::from_fn(|i, _| k(i) * rest[i]) * part;
        self.point.crack.gap += part * rest[N];
        if self.point.crack.regime == Regime::Secant {
            self.point.traction[N] = self.point.crack.bridge * self.point.crack.gap;
        }
        self.slopes.crack.gap += moved.row(N).transpose();
        self.here += moved;
        self.fraction = if part == 1.0 { 1.0 } else { self.fraction + part * (1.0 - self.fraction) };
    }

    /// Over a border of the elastic law.
    fn cross(&mut self, opens: bool) {
        let crack = &mut self.point.crack;
        match (crack.regime, opens) {
            (Regime::Contact, _) => (crack.regime, crack.gap) = (Regime::Secant, 0.0),
            (Regime::Secant, true) => {
                (crack.regime, crack.stored) = (Regime::Envelope, crack.kept_at_anchor(self.surface));
                self.slopes.crack.stored = SVector::zeros(); // k and o are those of the start
            }
            (Regime::Envelope, _) => {
                (crack.regime, crack.stored) = (Regime::Secant, 0.0);
                self.point.traction[N] = crack.bridge * crack.gap;
            }
            _ => self.close(),
        }
    }

    /// The faces meet at this place.
    pub fn close(&mut self) {
        let crack = &mut self.point.crack;
        (crack.regime, crack.gap, crack.slip) = (Regime::Contact, 0.0, 0.0);
        (self.slopes.crack.gap, self.slopes.crack.slip) = (SVector::zeros(), SVector::zeros());
        self.point.traction[N] = 0.0;
        self.slopes.traction.row_mut(N).fill(0.0);
    }

    /// The regime of a crack without a border behind it: an intact one, or one under the surface.
    fn settle(&mut self, opens: bool) {
        let (sigma, kn) = (self.point.traction[N], self.surface.kn);
        let crack = &mut self.point.crack;
        let Some(regime) = crack.told(self.surface, sigma, opens) else { return };
        crack.regime = regime;
        if regime == Regime::Envelope && !crack.dilated {
            return;
        }
        crack.gap = sigma / kn;
        self.slopes.crack.gap = self.slopes.traction.row(N).transpose() / kn;
        if regime == Regime::Contact {
            crack.slip = 0.0;
            self.slopes.crack.slip = SVector::zeros();
        }
    }

    /// A spent crack stays open to the end: no shear is carried either.
    fn stay_open(&mut self, rest: SVector<f64, D>) {
        let crack = &mut self.point.crack;
        crack.gap += rest[N];
        crack.opening = crack.gap;
        self.free();
        self.here = SMatrix::identity();
        self.fraction = 1.0;
    }

    /// A spent crack goes on to where its faces meet; slip counts from there.
    fn touch(&mut self, rest: SVector<f64, D>) {
        let part = (-self.point.crack.gap / rest[N]).clamp(0.0, 1.0);
        let by_jump = -(self.slopes.crack.gap + self.ahead().row(N).transpose() * part) / rest[N];
        self.advance(rest, [0.0; 2], part, by_jump);
        self.free();
        self.point.touch(self.surface);
        self.close();
    }

    fn free(&mut self) {
        self.point.traction = SVector::zeros();
        self.slopes.traction = SMatrix::zeros();
        self.slopes.across = 0.0;
        self.point.mode = Mode::Open;
    }

    /// Part of the rest at which an elastic point meets the hyperbola, between 0 and `most`, and its derivative by the jump.
    ///
    /// F is convex along a straight piece, not positive at its start and positive at its end: Newton from the end falls
    /// monotonically on the one crossing.
    fn onset(&self, k: [f64; 2], rate: SVector<f64, D>, most: f64) -> (f64, SVector<f64, D>) {
        let now = self.surface.at(self.point.work);
        let start = self.point.traction;
        let at = |x: f64| {
            let traction = start + rate * x;
            let s = now.root(shear(&traction));
            let mut normal = if s > 0.0 { traction / s } else { direction(&rate) };
            normal[N] = now.t;
            (now.hyperbola(traction[N], shear(&traction)), normal)
        };
        let none = (0.0, SVector::zeros());
        let (f, normal) = at(0.0);
        if f >= -margin(self.surface, start) && normal.dot(&rate) >= 0.0 {
            return none;
        }
        let mut x = most;
        loop {
            let (f, normal) = at(x);
            let slope = normal.dot(&rate);
            let next = x - f / slope;
            if slope <= 0.0 || next <= 0.0 || !next.is_finite() {
                return none;
            }
            if next >= x - 2.0 * f64::EPSILON {
                let stiff: SVector<f64, D> = SVector::from_fn(|i, _| k[usize::from(i != N)] * normal[i]);
                let by_end = self.slopes.traction.tr_mul(&normal) + self.ahead().tr_mul(&stiff) * x;
                return (x, -by_end / slope);
            }
            x = next;
        }
    }

    /// Derivatives of a point that does not move.
    pub fn still(&self) -> Slopes<D> {
        let mut slopes = Slopes::none();
        if self.point.crack.regime == Regime::Free {
            return slopes;
        }
        slopes.traction = stiff_rows(self.surface, &SMatrix::identity());
        slopes.traction[(N, N)] = self.point.crack.slope(self.surface);
        slopes.across = self.surface.kt;
        slopes
    }
}
