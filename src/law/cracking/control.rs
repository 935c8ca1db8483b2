//! Error control of the length of sub-steps.
//!
//! Each sub-step is done once whole and once in halves; the difference rules the next length. The tolerance ε bounds
//! the error at the end of a way: a second-order step has a local error of third order, so the local bound is
//! LOCAL ε^{3/2}, and the number of steps drops out of the sum. Where the flow changes its law (σ passes 0, W passes
//! an energy) the difference may vanish by chance: such an event is enclosed by halving until the traction changes
//! little across it.

use nalgebra::SVector;

use super::super::local::shear;
use super::march::{GAMMA, TwoStages, WayPoint, two_stage_step, within};
use super::mode::Mode;
use super::surface::Surface;

/// Local bound per ε^{3/2}, of the strength.
const LOCAL: f64 = 5.0;
/// First length per √ε, of the length over which the strength is lost.
const FIRST_LENGTH: f64 = 4.0;
/// Tolerances below this are rounding.
const SMALLEST_TOLERANCE: f64 = 1e-14;
/// Rounding of a step's difference, relative to the tractions and to the work in it.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A new length aims at this much less than the bound allows.
const SAFETY: f64 = 0.85;
/// The vertex is at the origin but for this part of G_I.
const AT_ORIGIN: f64 = 1e-10;
/// Bounds of the change of length from one sub-step to the next.
const SHRINK: f64 = 0.2;
const GROW: f64 = 5.0;
/// No sub-step leaves less than this part of itself to go: an answer over a length of rounding has no derivative.
const REMAINDER: f64 = 1e-9;
/// A sub-step this short, of the first length, is not divided further.
const SHORTEST: f64 = 1e-10;
/// Change of traction in a sub-step across an event, per ε, of the strength.
const EVENT: f64 = 0.3;
/// Sub-steps tried before the way counts as a snap, and ten times fewer per 1/√ε.
const TRIES: usize = 1000;
/// A straight way meets a handful of events; beyond this number they are rounding.
const EVENTS: usize = 20;
/// Part of an energy that counts as all of it: W approaches its limit without end.
const USED_UP: f64 = 1.0 - 1e-9;
/// A change of traction within the shortest sub-step that counts as a snap, of the strength.
const SNAP: f64 = 1e-3;
/// So many shortest sub-steps may miss the bound before the whole way counts as a snap.
const SNAPS: usize = 50;

/// Source of the lengths of sub-steps.
pub(super) enum Lengths<'a> {
    /// Error control with this tolerance; the accepted lengths are appended to the record, if there is one.
    Controlled(f64, Option<&'a mut Vec<f64>>),
    /// Given beforehand; the last one reaches to the end whatever its length.
    Given(&'a [f64]),
}

/// Among recorded lengths: the crack is free of stress from here on.
pub(super) const PIECE_ENDS: f64 = 0.0;

/// A sub-step done in halves.
pub(super) struct Double<const D: usize> {
    pub length: f64,
    pub steps: [TwoStages<D>; 2],
    pub middle: WayPoint<D>,
    pub end: WayPoint<D>,
}

/// Error control under way.
pub(super) struct ErrorControl {
    bound: f64,
    event_bound: f64,
    shortest: f64,
    length: f64,
    /// An event lies within the first of these distances; a step across it may have the second as its length.
    event: Option<(f64, f64)>,
    /// Sub-steps that may still be tried.
    tries_left: usize,
    /// Events met so far.
    events: usize,
    /// Shortest sub-steps that still missed the bound.
    snaps: usize,
}

impl ErrorControl {
    /// At the onset, with this much of the way ahead.
    pub fn new(surface: &Surface, tolerance: f64, total: f64) -> ErrorControl {
        let loss = 1.0 / surface.loss(); // infinite if nothing is lost
        let length = (FIRST_LENGTH * tolerance.max(SMALLEST_TOLERANCE).sqrt() * loss).min(total);
        let bound = local_bound(surface, tolerance);
        let strength = if bound.is_finite() { surface.scale() } else { f64::INFINITY };
        ErrorControl {
            bound,
            event_bound: EVENT * tolerance.max(SMALLEST_TOLERANCE) * strength,
            shortest: SHORTEST * length,
            length,
            event: None,
            tries_left: TRIES + (TRIES as f64 * 0.1 / tolerance.max(SMALLEST_TOLERANCE).sqrt()) as usize,
            events: 0,
            snaps: 0,
        }
    }

    /// The next sub-step, as long as the bound allows; `None` if the traction snaps.
    pub fn next<const D: usize>(
        &mut self,
        surface: &Surface,
        from: &WayPoint<D>,
        direction: SVector<f64, D>,
        left: f64,
    ) -> Option<Double<D>> {
        loop {
            self.tries_left = self.tries_left.checked_sub(1)?;
            let length = self.length.min(left);
            let length = match self.event {
                Some((beyond, short)) if beyond > short => length.min(0.5 * beyond),
                Some((beyond, _)) => length.min(beyond),
                None => length,
            };
            let length = if left - length <= REMAINDER * length { left } else { length };
            let (whole, stages) = two_stage_step(surface, from, direction * length, None);
            let step = in_halves(surface, from, direction, length, &stages);
            let misfit = (whole.traction - step.end.traction).amax();
            let strength = (whole.work - step.end.work).abs() * surface.loss();
            let rounding = ROUNDING * from.traction.amax().max(step.end.traction.amax())
                + rounding_near_vertex(surface, &step.end);
            let rounding_of_work = ROUNDING * step.end.work * surface.loss();
            let ratio = (misfit / self.bound.max(rounding)).max(strength / self.bound.max(rounding_of_work));
            let change = (step.end.traction - from.traction).amax();
            let across = is_across_event(surface, from, &step);
            if length <= self.shortest {
                (self.length, self.event) = (GROW * length, None);
                self.snaps += usize::from(ratio > 1.0);
                let snap = ratio > 1.0 && (misfit > SNAP * surface.scale() || self.snaps > SNAPS);
                return (!snap).then_some(step);
            }
            if across && change > self.event_bound.max(rounding) && self.events < EVENTS {
                self.events += usize::from(self.event.is_none());
                self.event = Some((length, length * self.event_bound / change));
                continue;
            }
            self.length = length * (SAFETY / ratio.cbrt()).clamp(SHRINK, GROW);
            if ratio <= 1.0 {
                self.event = match self.event {
                    Some((beyond, short)) if !across && beyond > length => Some((beyond - length, short)),
                    _ => None,
                };
                return Some(step);
            }
        }
    }
}

/// Bound of the local error of a sub-step [stress]; without strength (Coulomb friction) one step is exact.
pub(super) fn local_bound(surface: &Surface, tolerance: f64) -> f64 {
    if surface.scale() == 0.0 {
        return f64::INFINITY;
    }
    let tolerance = tolerance.max(SMALLEST_TOLERANCE);
    LOCAL * tolerance * tolerance.sqrt() * surface.scale()
}

/// A sub-step in halves, which lie near what the whole one says.
fn in_halves<const D: usize>(
    surface: &Surface,
    from: &WayPoint<D>,
    direction: SVector<f64, D>,
    length: f64,
    whole: &TwoStages<D>,
) -> Double<D> {
    let change = direction * (0.5 * length);
    let near = |start: f64| Some([start + 0.5 * GAMMA, start + 0.5].map(|x| within(from, whole, x)));
    let (middle, first) = two_stage_step(surface, from, change, near(0.0));
    let (end, second) = two_stage_step(surface, &middle, change, near(0.5));
    Double { length, steps: [first, second], middle, end }
}

/// A sub-step of a given length in halves.
pub(super) fn given<const D: usize>(
    surface: &Surface,
    from: &WayPoint<D>,
    direction: SVector<f64, D>,
    length: f64,
) -> Double<D> {
    let (_, whole) = two_stage_step(surface, from, direction * length, None);
    in_halves(surface, from, direction, length, &whole)
}

/// Rounding of τ near a vertex at the origin: σ = 0 makes τ ~ √(χ c t), so what χ is rounded by counts c/τ times, up
/// to its root where τ vanishes.
fn rounding_near_vertex<const D: usize>(surface: &Surface, end: &WayPoint<D>) -> f64 {
    let largest = surface.scale() * (ROUNDING * surface.e_chi.max(1.0 / surface.e_chi)).sqrt();
    if (1.0 - end.work * surface.per_gf_i).abs() <= AT_ORIGIN {
        return largest;
    }
    let tau = shear(&end.traction);
    if end.mode == Mode::Sliding && tau > 0.0 {
        return largest.min(ROUNDING * surface.scale() * (surface.scale() / tau));
    }
    0.0
}

/// True if the flow changes its law within a step: another mode, or an energy used up.
fn is_across_event<const D: usize>(surface: &Surface, from: &WayPoint<D>, step: &Double<D>) -> bool {
    let mode = step.end.mode;
    let used_up = |w: f64| [w * surface.per_gf_i >= USED_UP, w * surface.per_gf_iia >= USED_UP];
    (from.mode != Mode::Elastic && from.mode != mode)
        || step.steps.iter().any(|step| step.is_across(mode))
        || used_up(from.work) != used_up(step.end.work)
}
