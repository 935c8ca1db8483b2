//! The way of an increment: elastic pieces, and sub-steps where the surface is reached.
//!
//! Under error control the way is elastic up to the onset of cracking, found exactly, then runs in sub-steps of
//! absolute length, the last one cut at the end of the increment. Lengths depend on what lies behind, never on where
//! the increment ends, so the traction does not snap while a global Newton iteration moves that end. Elastic pieces end where a
//! crack changes its regime (`crack`), found exactly too: the elastic law is straight between.

use nalgebra::{SMatrix, SVector};

use super::super::local::{N, direction, shear};
use super::control::{ErrorControl, in_halves};
use super::crack::{Crack, Regime};
use super::elastic::{margin, stiff_rows};
use super::march::{Change, Slopes, WayPoint};
use super::mode::Mode;
use super::stage::CrackSlopes;
use super::surface::Surface;

/// Source of the lengths of sub-steps.
pub(super) enum Lengths<'a> {
    /// Error control with this tolerance; the accepted lengths are appended to the record, if there is one.
    Controlled(f64, Option<&'a mut Vec<f64>>),
    /// Given beforehand; the last one reaches to the end whatever its length.
    Given(&'a [f64]),
}

/// Among recorded lengths: the crack is free of stress from here on.
const PIECE_ENDS: f64 = 0.0;

/// A way under way.
pub(super) struct LawWay<'a, const D: usize> {
    surface: &'a Surface,
    change: SVector<f64, D>,
    pub point: WayPoint<D>,
    pub slopes: Slopes<D>,
    /// Fraction of the way that is done, and the derivative of the place there by the jump.
    pub fraction: f64,
    here: SMatrix<f64, D, D>,
    /// Sub-steps done.
    count: usize,
}

impl<'a, const D: usize> LawWay<'a, D> {
    pub fn new(surface: &'a Surface, from: WayPoint<D>, change: SVector<f64, D>) -> LawWay<'a, D> {
        let (slopes, here) = (Slopes::none(), SMatrix::zeros());
        LawWay { surface, change, point: from, slopes, fraction: 0.0, here, count: 0 }
    }

    /// Goes on to the end.
    /// `Err` if the traction snaps: what is left of the way there.
    pub fn finish(&mut self, mut lengths: Lengths) -> Result<(), SVector<f64, D>> {
        while !self.elastic() && !self.in_sub_steps(&mut lengths)? {}
        Ok(())
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
            let border = self.border(rest[N]);
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

    /// The gap at which the crack leaves its regime.
    fn border(&self, change: f64) -> Option<f64> {
        let crack = &self.point.crack;
        if crack.opening == 0.0 || change == 0.0 {
            return None;
        }
        match (crack.regime, change > 0.0) {
            (Regime::Contact, true) | (Regime::Secant, false) => Some(0.0),
            (Regime::Secant, true) | (Regime::Envelope, false) => {
                Some(crack.anchor(self.surface)).filter(|g| g.is_finite())
            }
            _ => None,
        }
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
    fn close(&mut self) {
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
        if !self.surface.closes || (crack.opening > 0.0 && crack.regime != Regime::Contact) {
            return;
        }
        crack.regime =
            if sigma > 0.0 || (sigma == 0.0 && opens) { Regime::Envelope } else { Regime::Contact };
        if crack.opening > 0.0 {
            crack.regime = Regime::Contact;
        }
        if crack.opening == 0.0 && crack.regime == Regime::Envelope && !crack.dilated {
            return;
        }
        crack.gap = sigma / kn;
        self.slopes.crack.gap = self.slopes.traction.row(N).transpose() / kn;
        if crack.regime == Regime::Contact {
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

    /// Goes on in sub-steps: to the end (true), or until the crack is free of stress.
    fn in_sub_steps(&mut self, lengths: &mut Lengths) -> Result<bool, SVector<f64, D>> {
        let surface = self.surface;
        let distance = self.change.norm();
        let towards = self.change / distance;
        let turn = (SMatrix::identity() - towards * towards.transpose()) / distance;
        let mut total = (1.0 - self.fraction) * distance;
        let mut control = match lengths {
            Lengths::Controlled(tolerance, _) => Some(ErrorControl::new(surface, *tolerance, total)),
            Lengths::Given(_) => None,
        };
        let mut onset = self.here;
        let mut done = 0.0;
        while done < total {
            let to_touch = self.distance_to_touch(towards[N]);
            let from = self.point.crack;
            let left = (total - done).min(to_touch);
            let step = match (&mut control, &mut *lengths) {
                (Some(control), _) => {
                    control.next(surface, &self.point, towards, left).ok_or(towards * (total - done))?
                }
                (None, Lengths::Given(given))
                    if self.count + 1 < given.len() && given[self.count] != PIECE_ENDS =>
                {
                    in_halves(surface, &self.point, towards, given[self.count].min(left))
                }
                (None, _) => in_halves(surface, &self.point, towards, left),
            };
            let touches = step.length >= to_touch;
            if let Lengths::Controlled(_, Some(record)) = lengths {
                record.push(if touches { f64::INFINITY } else { step.length });
            }
            self.count += 1;
            let before = done;
            done = if step.length >= total - done { total } else { done + step.length };
            let mut there = if done == total { SMatrix::identity() } else { onset + turn * done };
            if touches && done < total {
                let gap = self.slopes.crack.gap + (there - self.here).row(N).transpose();
                there += towards * (-gap / towards[N]).transpose();
            }
            let half = Change { along: (there - self.here) * 0.5, across: 0.5 * (done - before) / distance };
            for (stages, end) in step.steps.iter().zip([&step.middle, &step.end]) {
                self.slopes = self.slopes.over_two_stages(surface, stages, &half, end);
            }
            self.here = there;
            self.point = step.end;
            if done < total && touches {
                match from.regime {
                    Regime::Contact => self.part(from),
                    _ => self.close(),
                }
                (onset, total, done) = (self.here, total - done, 0.0);
            }
            if self.point.crack.regime == Regime::Free && done < total {
                if let Lengths::Controlled(_, Some(record)) = lengths {
                    record.push(PIECE_ENDS);
                }
                self.count += 1;
                self.fraction = 1.0 - (total - done) / distance;
                return Ok(false);
            }
        }
        self.fraction = 1.0;
        Ok(true)
    }

    /// Length of the way up to where the faces of a crack meet or part.
    fn distance_to_touch(&self, towards: f64) -> f64 {
        let crack = &self.point.crack;
        let meets = match crack.regime {
            Regime::Secant | Regime::Envelope => towards < 0.0,
            Regime::Contact => towards > 0.0 && self.surface.sigma_dil == 0.0 && crack.gap < 0.0,
            Regime::Free => false,
        };
        match self.surface.closes && crack.opening > 0.0 && meets {
            true => crack.gap / -towards,
            false => f64::INFINITY,
        }
    }

    /// Faces of a crack part here while they slide: up to this place they touched, whatever rounding says, and k is kept.
    fn part(&mut self, crack: Crack) {
        let slopes = self.slopes.crack;
        self.close();
        self.point.crack = Crack { regime: Regime::Secant, gap: 0.0, ..crack };
        self.slopes.crack = CrackSlopes { gap: SVector::zeros(), bridge: SVector::zeros(), ..slopes };
        self.slopes.crack.slip = SVector::zeros();
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
