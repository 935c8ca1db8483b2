//! Sub-steps of a way that is on the surface.
//!
//! Sub-steps have absolute lengths, the last one cut at the end of the increment. Under error control these depend on what lies
//! behind, never on where the increment ends, so the traction does not snap while a global Newton iteration moves that end.

use nalgebra::{SMatrix, SVector};

use super::super::local::N;
use super::control::{ErrorControl, Lengths, PIECE_ENDS, given};
use super::crack::{Crack, Regime};
use super::march::Change;
use super::stage_slopes::CrackSlopes;
use super::way::LawWay;

impl<const D: usize> LawWay<'_, D> {
    /// Goes on to the end.
    /// `Err` if the traction snaps: what is left of the way there.
    pub fn finish(&mut self, mut lengths: Lengths) -> Result<(), SVector<f64, D>> {
        while !self.elastic() && !self.in_sub_steps(&mut lengths)? {}
        Ok(())
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
                (None, Lengths::Given(lengths))
                    if self.count + 1 < lengths.len() && lengths[self.count] != PIECE_ENDS =>
                {
                    given(surface, &self.point, towards, lengths[self.count].min(left))
                }
                (None, _) => given(surface, &self.point, towards, left),
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
}
