//! Initial stress of a subdomain, bound.

use super::quantity::Quantity;
use crate::assembly::{InterfaceOperator, Model};
use crate::coupling::LawPoint;
use crate::error::Result;
use crate::law::{Local, N, T};
use crate::scene::{FormulaPlace, Ground, InitialStress, Plane, Scene, Subdomain};

/// Initial stress of a subdomain at a place (x, y) [stress].
#[derive(Debug, Clone)]
pub(super) enum StressAt {
    Ground { ground: Ground, weight: f64, out_of_plane: bool },
    Components([Quantity; 4]),
}

impl StressAt {
    /// Initial stress of every subdomain that has one.
    pub(super) fn all(scene: &Scene, model: &Model) -> Vec<Option<StressAt>> {
        let of = |(b, (name, stated)): (usize, (&String, &Subdomain))| {
            Some(match stated.initial_stress.as_ref()? {
                InitialStress::Ground(ground) => StressAt::Ground {
                    ground: ground.clone(),
                    weight: -model.subdomains[b].density * ground.gravity[1].constant().unwrap_or(0.0),
                    out_of_plane: scene.plane == Plane::Strain,
                },
                InitialStress::Components(components) => {
                    StressAt::Components(components.keys().map(|(key, value)| {
                        Quantity::new(scene, &["subdomains", name, "initial_stress", key], value)
                    }))
                }
            })
        };
        scene.subdomains.iter().enumerate().map(of).collect()
    }

    /// (xx, yy, zz, xy) at a place.
    pub(super) fn at(&self, [x, y, z]: [f64; 3]) -> Result<[f64; 4]> {
        match self {
            StressAt::Ground { ground, weight, out_of_plane } => {
                let vertical = -ground.overburden - weight * (ground.surface - y);
                let horizontal = ground.k0 * vertical;
                Ok([horizontal, vertical, if *out_of_plane { horizontal } else { 0.0 }, 0.0])
            }
            StressAt::Components(components) => {
                let place = FormulaPlace { x, y, z, s: 0.0, load_factor: 0.0, ..FormulaPlace::default() };
                let mut stress = [0.0; 4];
                for (stress, component) in stress.iter_mut().zip(components) {
                    *stress = component.at(&place)?;
                }
                Ok(stress)
            }
        }
    }
}

/// Tractions that both sides' initial stresses make at the law points of an interface; none if neither side has any [stress].
pub(super) fn tractions(
    stresses: &[Option<StressAt>],
    interface: &InterfaceOperator,
) -> Result<Option<Vec<[Local; 2]>>> {
    let both = interface.subdomains.map(|b| stresses[b].as_ref());
    if both.iter().all(Option::is_none) {
        return Ok(None);
    }
    let at = |point: &LawPoint| {
        let mut sides = [Local::zeros(); 2];
        for (side, stress) in sides.iter_mut().zip(both) {
            let Some(stress) = stress else { continue };
            let [xx, yy, zz, xy] = stress.at(point.position)?;
            let normal = Local::from(point.rotation[N]);
            let on = Local::new(xx * normal.x + xy * normal.y, xy * normal.x + yy * normal.y, zz * normal.z);
            *side = Local::from_fn(|i, _| if i <= T { Local::from(point.rotation[i]).dot(&on) } else { 0.0 });
        }
        Ok(sides)
    };
    Ok(Some(interface.coupling.points.iter().map(at).collect::<Result<_>>()?))
}
