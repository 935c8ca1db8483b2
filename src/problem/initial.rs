//! Initial tractions t₀ at the law points of an interface (paper eq. 10).

use super::ground::{self, StressAt};
use super::point_laws::{place, shown};
use super::quantity::Quantity;
use super::{Gaps, PointLaws};
use crate::assembly::InterfaceOperator;
use crate::error::Result;
use crate::law::{self, Inadmissible, Local};
use crate::scene::{self, Scene};

/// Initial traction of an interface [stress].
#[derive(Debug, Clone, PartialEq)]
pub enum InitialTraction {
    /// The same at all law points.
    Uniform(Local),
    /// One for every law point.
    Varying(Vec<Local>),
}

impl InitialTraction {
    /// Its value at a law point.
    pub fn at(&self, point: usize) -> Local {
        match self {
            InitialTraction::Uniform(traction) => *traction,
            InitialTraction::Varying(tractions) => tractions[point],
        }
    }

    /// Binds that of an interface: s runs along C from the start of chain A. Where nothing is stated it follows from the initial
    /// stresses of both sides.
    pub(super) fn bind(
        scene: &Scene,
        name: &str,
        stated: &scene::Interface,
        interface: &InterfaceOperator,
        stresses: &[Option<StressAt>],
    ) -> Result<InitialTraction> {
        let [n, t] = &stated.initial_traction;
        if n.is_zero()
            && t.is_zero()
            && let Some(sides) = ground::tractions(stresses, interface)?
        {
            let means = sides.into_iter().map(|[a, b]| 0.5 * (a + b));
            return Ok(InitialTraction::Varying(means.collect()));
        }
        if let (Some(n), Some(t)) = (n.constant(), t.constant()) {
            return Ok(InitialTraction::Uniform(Local::new(n, t, 0.0)));
        }
        let n = Quantity::new(scene, &["interfaces", name, "initial_traction", "0"], n);
        let t = Quantity::new(scene, &["interfaces", name, "initial_traction", "1"], t);
        let tractions = (0..interface.coupling.points.len()).map(|point| {
            let place = place(interface, point);
            Ok(Local::new(n.at(&place)?, t.at(&place)?, 0.0))
        });
        Ok(InitialTraction::Varying(tractions.collect::<Result<_>>()?))
    }
}

/// States of the law points before the first increment.
pub(super) fn states(
    scene: &Scene,
    name: &str,
    stated: &scene::Interface,
    laws: &PointLaws,
    initial: &InitialTraction,
    gaps: &Gaps,
    interface: &InterfaceOperator,
) -> Result<Vec<law::State>> {
    let damage = Quantity::new(scene, &["interfaces", name, "initial_damage"], &stated.initial_damage);
    let place = |point: usize| place(interface, point);
    let state = |point: usize| {
        let damage = damage.at(&place(point))?;
        let law = laws.at(point);
        let start = law.initial_state(initial.at(point), gaps.at(point));
        start.and_then(|start| law.damaged(start, damage)).map_err(|Inadmissible { key, what, help }| {
            let what = if damage == 0.0 { what } else { format!("{what} at {}", shown(&place(point))) };
            scene.source.error_at(&["interfaces", name, key], what, help)
        })
    };
    (0..interface.coupling.points.len()).map(state).collect()
}
