//! Straight way r(s) = r₀ + s (r₁ − r₀) of the jump, divided at the events of contact and friction.
//!
//! ```text
//! faces meet   r_n(s) = r_n^p                       from there r_t^p = r_t(s)
//! slip starts  d τ(s) + μ σ(s) = c                  d = ±1, the direction of slip
//! faces part   r_n(s) = r_n^p + tanψ |slip|(s)      that is σ(s) = 0
//! dilatancy ends  |slip|(s) = what is left of it           the way goes on without
//! cohesion is lost  at the first slip, where asked for     the traction drops at once, then friction alone
//! ```
//!
//! With linear springs all are linear in s. r_n grows or falls all along the way, so faces meet or part, never both; slip in
//! one direction goes on to the end or to the parting, since the domain |τ| ≤ c − μ σ is convex and the rates are constant. With
//! a closure the domain is not convex in r: slip may stop once in each direction (`slide`).

use nalgebra::Vector2;

use super::faces::Faces;
use super::jet::Jet;
use super::normal::traction;
use super::slide::{Slide, Slipped, WayEnds, at, rise};
use super::{OPEN, SLIP, STICK};
use crate::law::local::{N, T};

/// End of a way.
pub(super) struct WayEnd {
    pub(super) traction: [Jet; 2],
    pub(super) jump_plastic: Vector2<f64>,
    pub(super) dissipation: Jet,
    pub(super) released: f64,
    pub(super) status: u8,
    /// |slip| on the way, and whether there was any, or an opening.
    pub(super) slip: f64,
    pub(super) loosened: bool,
}

/// End of the straight way between two jumps, from the irreversible jump at its start; none if the faces would close further than
/// they can.
pub(super) fn follow(
    faces: &Faces,
    start: Vector2<f64>,
    plastic: Vector2<f64>,
    jump: Vector2<f64>,
) -> Option<WayEnd> {
    let [n, t] = Jet::variables(jump);
    let closed = |ends: WayEnds, plastic| ClosedWay { ends, plastic, jump_t: jump.y, stopped: 0.0 };
    if start.x <= plastic.x {
        let from = [(start.x - plastic.x).into(), (start.y - plastic.y).into()];
        return closed([from, [n - plastic.x, t - plastic.y]], plastic).follow(faces);
    }
    let faces = &faces.apart();
    if jump.x > plastic.x {
        return Some(open(plastic.x, jump.y));
    }
    let left = (n - plastic.x) / (n - start.x); // 1 − s at the meeting
    let to = [n - plastic.x, left * (t - start.y)];
    let plastic = Vector2::new(plastic.x, jump.y - to[T].value);
    let end = closed([[0.0.into(); 2], to], plastic).follow(faces)?;
    Some(WayEnd { loosened: true, ..end })
}

/// Open faces at the end, r_t^p := r_t.
fn open(plastic_n: f64, jump_t: f64) -> WayEnd {
    WayEnd {
        traction: [0.0.into(); 2],
        jump_plastic: Vector2::new(plastic_n, jump_t),
        dissipation: 0.0.into(),
        released: 0.0,
        status: OPEN,
        slip: 0.0,
        loosened: true,
    }
}

/// Way that starts with closed faces, by r − r^p of its start.
struct ClosedWay {
    ends: WayEnds,
    /// r^p at the start.
    plastic: Vector2<f64>,
    /// r_t at the end.
    jump_t: f64,
    /// Direction in which slip has stopped, 0 if in none.
    stopped: f64,
}

impl ClosedWay {
    /// The s at which a quantity linear in r rises above zero, if it does before the end.
    fn rise(&self, of: impl Fn(&[Jet; 2]) -> Jet) -> Option<Jet> {
        rise(of(&self.ends[0]), of(&self.ends[1]))
    }

    /// Stick up to the first event, then slip or parting.
    fn follow(&self, faces: &Faces) -> Option<WayEnd> {
        let law = &faces.law;
        let [from, to] = &self.ends;
        if !law.normal().reach(to[N].value) {
            return None;
        }
        let forward = (to[T].value - from[T].value).signum();
        let parts = self.rise(|elastic| elastic[N]);
        let slips = [forward, -forward]
            .map(|direction| Slide { law, direction })
            .into_iter()
            .filter(|slide| slide.direction != self.stopped)
            .filter_map(|slide| Some((slide.rise(&self.ends, 0.0.into())?, slide)))
            .min_by(|(a, _), (b, _)| a.value.total_cmp(&b.value));
        if let Some((start, slide)) = slips {
            // without cohesion the faces part at the apex of the domain only, where slip ends
            let apex = parts.filter(|_| law.cohesion == 0.0);
            let start = apex.map_or(start, |apex| start.min(apex));
            if parts.is_none_or(|parting| start.value <= parting.value) {
                return self.slip(faces, &slide, start);
            }
        }
        if let Some(parting) = parts {
            let tau = law.tangential_stiffness * at(&self.ends, parting)[T].value;
            return Some(WayEnd { released: law.shear_energy(tau), ..open(self.plastic.x, self.jump_t) });
        }
        Some(WayEnd {
            traction: [traction(&law.normal(), to[N]), law.tangential_stiffness * to[T]],
            jump_plastic: self.plastic,
            dissipation: 0.0.into(),
            released: 0.0,
            status: STICK,
            slip: 0.0,
            loosened: false,
        })
    }

    /// Slip from `start` on, to the first of what ends it: the loss of cohesion, the end of dilatancy, a stop, the parting, the end.
    fn slip(&self, faces: &Faces, slide: &Slide, start: Jet) -> Option<WayEnd> {
        let law = slide.law;
        let left = at(&self.ends, start)[N].min(0.0.into());
        let first = Slipped { s: start, slip: 0.0.into(), left };
        if let Some(drop) = faces.drop(left) {
            let moved = [drop.opening, slide.direction * drop.slip];
            let done = Done { slip: drop.slip.value, dissipation: drop.dissipation, released: drop.released };
            return self.onwards(start, moved, 0.0, &drop.after, done);
        }
        let parting = self.rise(|elastic| slide.parting(elastic)).map(|parting| parting.max(start));
        let last = match parting {
            Some(s) => {
                let slip = slide.slipped(s, &at(&self.ends, s)).slip;
                Slipped { s, slip: slip.max(0.0.into()), left: 0.0.into() }
            }
            None => slide.slipped(1.0.into(), &self.ends[1]),
        };
        let stop = slide.stop(&self.ends, start, &last);
        let last = stop.unwrap_or(last);
        if last.slip.value > faces.left.value
            && let Some(s) = slide.rise(&self.ends, faces.left)
        {
            let slip = faces.left;
            let there = Slipped { s, slip, left: at(&self.ends, s)[N] - law.dilatancy * slip };
            let done = Done::slid(slide.dissipation(&self.ends, &first, &there), slip.value);
            return self.onwards(s, slide.irreversible(slip), 0.0, &faces.worn(), done);
        }
        let dissipation = slide.dissipation(&self.ends, &first, &last);
        let moved = slide.irreversible(last.slip);
        let rest = Faces { left: faces.left - last.slip, ..*faces };
        let done = Done::slid(dissipation, last.slip.value);
        if stop.is_some() {
            return self.onwards(last.s, moved, slide.direction, &rest, done);
        }
        if parting.is_none() {
            let sigma = slide.sigma(&last);
            return Some(WayEnd {
                traction: [sigma, slide.direction * slide.limit(sigma)],
                jump_plastic: self.plastic + Vector2::new(moved[N].value, moved[T].value),
                dissipation,
                released: 0.0,
                status: SLIP,
                slip: last.slip.value,
                loosened: last.slip.value > 0.0,
            });
        }
        let remains = Jet::from(1.0) - last.s;
        let [from, to] = &self.ends;
        let after = ClosedWay {
            ends: [[0.0.into(); 2], [N, T].map(|i| remains * (to[i] - from[i]))],
            plastic: self.plastic + Vector2::new(moved[N].value, moved[T].value),
            jump_t: self.jump_t,
            stopped: 0.0,
        };
        // at the apex without cohesion: dilatancy of slip the other way keeps the faces together
        let back = Slide { law, direction: -slide.direction };
        if law.cohesion == 0.0 && back.parting(&after.ends[1]).value < 0.0 {
            let end = after.slip(&rest, &back, 0.0.into())?;
            return Some(WayEnd {
                dissipation: dissipation + end.dissipation,
                slip: last.slip.value + end.slip,
                ..end
            });
        }
        let released = law.shear_energy(law.cohesion);
        Some(WayEnd { dissipation, released, slip: last.slip.value, ..open(after.plastic.x, self.jump_t) })
    }

    /// The rest of the way from a place on, after an irreversible jump and with other faces.
    fn onwards(&self, from: Jet, moved: [Jet; 2], stopped: f64, faces: &Faces, done: Done) -> Option<WayEnd> {
        let here = at(&self.ends, from);
        let rest = ClosedWay {
            ends: [here, self.ends[1]].map(|end| [N, T].map(|i| end[i] - moved[i])),
            plastic: self.plastic + Vector2::new(moved[N].value, moved[T].value),
            jump_t: self.jump_t,
            stopped,
        };
        let end = rest.follow(faces)?;
        Some(WayEnd {
            dissipation: done.dissipation + end.dissipation,
            released: done.released + end.released,
            slip: done.slip + end.slip,
            loosened: true,
            ..end
        })
    }
}

/// Slip, dissipation and release of a part of a way.
struct Done {
    slip: f64,
    dissipation: Jet,
    released: f64,
}

impl Done {
    fn slid(dissipation: Jet, slip: f64) -> Done {
        Done { slip, dissipation, released: 0.0 }
    }
}
