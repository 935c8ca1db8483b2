//! The answer at a jump: the way there, and the state that it leaves.

use nalgebra::{SMatrix, SVector};

use super::super::local::{Local, N, diagonal, narrow, shear, widen, widen_matrix};
use super::super::{Response, State, Unresolved};
use super::control::Lengths;
use super::crack::{Crack, Regime};
use super::elastic::{compliant, margin, stiff};
use super::march::{Change, Slopes, WayPoint, euler_step};
use super::mode::Mode;
use super::prediction::Line;
use super::surface::Surface;
use super::variables::WORK;
use super::way::LawWay;

/// A state that does not move is outside above so many times the margin.
const LEFT_OUTSIDE: f64 = 1e3;
/// Status of a cracked point whose faces touch, and of one that is open but tied, both elastic.
const CLOSED: u8 = 5;
const TIED: u8 = 6;

/// N equal backward Euler steps.
pub(super) fn march_euler<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    steps: usize,
) -> Response {
    let part = 1.0 / steps.max(1) as f64;
    let change = (jump - narrow(&old.jump)) * part;
    let mut point = WayPoint::start(surface, old);
    let mut slopes = Slopes::none();
    for _ in 0..steps.max(1) {
        let mut change = change;
        let along: SMatrix<f64, D, D> = SMatrix::identity() * part;
        let mut moved = Change { along, across: part };
        if let Some(share) = point.share_in_contact(change) {
            // nothing is carried up to the touch, slip counts from there
            let open: SVector<f64, D> = moved.along.row(N).transpose() * (1.0 - share);
            let by_jump = (slopes.crack.gap + open) / change[N];
            moved.along = moved.along * share + change * by_jump.transpose();
            moved.across *= share;
            change *= share;
            point.touch(surface);
            slopes = Slopes { work: slopes.work, dissipation: slopes.dissipation, ..Slopes::none() };
        }
        let (end, stage) = euler_step(surface, &point, change);
        slopes = slopes.over_euler_step(surface, &stage, &moved);
        point = end;
    }
    response(surface, jump, old, &point, &slopes)
}

/// The two-stage scheme in sub-steps.
pub(super) fn march<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    lengths: Lengths,
) -> Result<Response, Unresolved> {
    let change: SVector<f64, D> = jump - narrow(&old.jump);
    let start = WayPoint::start(surface, old);
    if let Some(answer) = straight(surface, jump, old, &start.crack) {
        return Ok(answer);
    }
    let mut way = LawWay::new(surface, start, change);
    if change == SVector::<f64, D>::zeros() {
        let outside = surface.at(old.own[WORK]).hyperbola(start.traction[N], shear(&start.traction));
        if outside > LEFT_OUTSIDE * margin(surface, start.traction) {
            return Ok(march_euler(surface, jump, old, 1)); // a viscous step may leave a state outside
        }
        // what is free of stress and has no strength to lose is taken to stay so
        let free = old.traction == Local::zeros() && old.own[WORK] > 0.0 && surface.is_spent(old.own[WORK]);
        let slopes = if free { Slopes::none() } else { way.still() };
        return Ok(response(surface, jump, old, &start, &slopes));
    }
    way.finish(lengths).map_err(|rest| Unresolved::SnapBack { jump: widen(&(jump - rest)) })?;
    Ok(response(surface, jump, old, &way.point, &way.slopes))
}

/// The answer of a way that is elastic and within one regime from end to end; none for any other.
fn straight<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    crack: &Crack,
) -> Option<Response> {
    let change: SVector<f64, D> = jump - narrow(&old.jump);
    let crack = &crack.heading(surface, change[N]);
    let stays = crack.border(surface, change[N]).is_none_or(|gap| (gap - crack.gap) / change[N] > 1.0);
    if crack.regime == Regime::Free || !stays || change == SVector::<f64, D>::zeros() {
        return None;
    }
    let k = [crack.slope(surface), surface.kt];
    let mut traction: SVector<f64, D> =
        narrow(&old.traction) + SVector::<f64, D>::from_fn(|i, _| k[usize::from(i != N)] * change[i]);
    if surface.at(old.own[WORK]).hyperbola(traction[N], shear(&traction)) > margin(surface, traction) {
        return None;
    }
    if crack.regime == Regime::Secant {
        traction[N] = crack.bridge * (crack.gap + change[N]);
    }
    let told = crack.told(surface, traction[N], change[N] > 0.0);
    let regime = told.unwrap_or(crack.regime);
    let slip = if told == Some(Regime::Contact) { 0.0 } else { crack.slip };
    let crack = Crack { regime, slip, ..*crack };
    let (jump, traction) = (widen(&jump), widen(&traction));
    let status = status(surface, Mode::Elastic, old.own[WORK], regime);
    let mut state = State { jump, traction, status, ..*old };
    crack.store(surface, &mut state);
    Some(Response {
        traction,
        stiffness: widen_matrix(&diagonal::<D>(k[0], k[1]), surface.kt),
        state,
        dissipation: 0.0,
        dissipation_gradient: Local::zeros(),
        damage_gradient: Local::zeros(),
        released: 0.0,
    })
}

/// Fraction of the way to a jump at which the hyperbola is met; none if it is not.
pub(super) fn onset_of<const D: usize>(surface: &Surface, jump: SVector<f64, D>, old: &State) -> Option<f64> {
    let change: SVector<f64, D> = jump - narrow(&old.jump);
    let mut way = LawWay::new(surface, WayPoint::start(surface, old), change);
    (!way.elastic()).then_some(way.fraction)
}

/// Traction and slopes (n, t) of a point held elastic whatever the surface; in a spent crack slip counts from the touch.
pub(super) fn held<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
) -> (SVector<f64, D>, [f64; 2]) {
    let change: SVector<f64, D> = jump - narrow(&old.jump);
    let mut point = WayPoint::start(surface, old);
    let touches = point.share_in_contact(change);
    let share = touches.unwrap_or(1.0);
    if touches.is_some() {
        point.touch(surface);
    } else if point.crack.regime == Regime::Free {
        return (SVector::zeros(), [0.0; 2]);
    }
    let mut traction = point.traction + stiff(surface, change * share);
    let crack = Crack { gap: point.crack.gap + change[N] * share, ..point.crack };
    let by = crack.predict(surface, traction[N], change[N] >= 0.0);
    traction[N] = by.sigma;
    let slope = if by.line == Line::Secant { crack.bridge } else { surface.kn };
    (traction, [slope, share * surface.kt])
}

fn response<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    end: &WayPoint<D>,
    slopes: &Slopes<D>,
) -> Response {
    let traction = end.traction;
    let returned = narrow(&old.traction) + stiff(surface, jump - narrow(&old.jump)) - traction;
    let was_open = surface.closes && Crack::of(surface, old).regime == Regime::Free;
    let mut jump_plastic = match end.mode {
        Mode::Elastic if end.work == old.own[WORK] && end.dissipation == 0.0 && !was_open => old.jump_plastic,
        _ => old.jump_plastic + widen(&compliant(surface, returned)),
    };
    if surface.closes {
        // u_t^p of what is open is u_t; d moves in contact only
        if end.crack.regime == Regime::Free {
            jump_plastic = widen(&jump);
        }
        jump_plastic[N] = if end.crack.dilated { jump[N] - end.crack.gap } else { old.jump_plastic[N] };
    }
    let (jump, traction) = (widen(&jump), widen(&traction));
    let mut state = State {
        jump,
        traction,
        jump_plastic,
        status: status(surface, end.mode, end.work, end.crack.regime),
        ..*old
    };
    state.own[WORK] = end.work;
    end.crack.store(surface, &mut state);
    Response {
        traction,
        stiffness: widen_matrix(&slopes.traction, slopes.across),
        state,
        dissipation: end.dissipation,
        dissipation_gradient: widen(&slopes.dissipation),
        damage_gradient: match surface.is_spent(end.work) {
            true => Local::zeros(),
            false => widen(&slopes.work) * surface.per_gf_i,
        },
        released: 0.0,
    }
}

/// The mode; what is cracked and elastic is closed, or open and tied.
fn status(surface: &Surface, mode: Mode, work: f64, regime: Regime) -> u8 {
    match mode {
        _ if regime == Regime::Free => Mode::Open as u8,
        Mode::Elastic if surface.closes && work > 0.0 => match regime {
            Regime::Contact => CLOSED,
            _ => TIED,
        },
        mode => mode as u8,
    }
}
