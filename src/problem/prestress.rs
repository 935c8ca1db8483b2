//! Stresses beyond those of the strains, from step to step: initial stress, temperature and strains of their own.

use std::sync::Arc;

use super::ground::StressAt;
use super::quantity::Quantity;
use crate::assembly::Model;
use crate::continuum::PointField;
use crate::error::{Error, Result};
use crate::scene::{FormulaPlace, Scene, Step, StepStage, Value};
use crate::shape::Ends;

/// Initial stress, eigenstrain and temperature of a body at the start and at the end of a step, affine in between.
#[derive(Debug, Clone)]
pub struct Prestress {
    /// σ_p at the points of the stiffness rule [stress].
    pub stress: [Arc<PointField>; 2],
    /// Its nodal forces [force].
    pub force: [Arc<Vec<f64>>; 2],
    /// ½ ∫ ε*ᵀ C ε* as a parabola in the load factor [force × length].
    energy: [f64; 3],
    /// Differences of temperature at the nodes, where the scene gives some.
    pub temperature: Option<[Arc<Vec<f64>>; 2]>,
    /// Strains ε* of its own, those of temperature among them, where it has some [-].
    pub strain: Option<[Arc<PointField>; 2]>,
}

impl Prestress {
    /// σ_p at a load factor.
    pub fn at(&self, load_factor: f64) -> Arc<PointField> {
        between(&self.stress, load_factor, |from, to| to.plus(from, -1.0), |from, by, s| from.plus(by, s))
    }

    /// Mean of ε* over every cell at a load factor [-].
    pub fn strains(&self, load_factor: f64) -> Option<Vec<[f64; 4]>> {
        let strain = self.strain.as_ref()?;
        let at = between(strain, load_factor, |from, to| to.plus(from, -1.0), |from, by, s| from.plus(by, s));
        Some(at.cells())
    }

    /// Differences of temperature at the nodes at a load factor.
    pub fn temperatures(&self, load_factor: f64) -> Option<Vec<f64>> {
        let [from, to] = self.temperature.as_ref()?;
        Some(from.iter().zip(to.iter()).map(|(a, b)| a + load_factor * (b - a)).collect())
    }

    /// ½ ∫ ε*ᵀ C ε* at a load factor [force × length].
    pub fn energy(&self, load_factor: f64) -> f64 {
        let [constant, linear, square] = self.energy;
        constant + load_factor * (linear + load_factor * square)
    }

    /// True if it changes in the step.
    pub fn changes(&self) -> bool {
        !Arc::ptr_eq(&self.stress[0], &self.stress[1])
    }
}

/// A value between two ends; the ends themselves without arithmetic.
fn between<T>(
    [from, to]: &[Arc<T>; 2],
    load_factor: f64,
    change: impl Fn(&T, &T) -> T,
    add: impl Fn(&T, &T, f64) -> T,
) -> Arc<T> {
    match load_factor {
        _ if Arc::ptr_eq(from, to) => to.clone(),
        1.0 => to.clone(),
        0.0 => from.clone(),
        _ => Arc::new(add(from, &change(from, to), load_factor)),
    }
}

/// Initial stress and eigenstrains in force in a subdomain, from step to step.
#[derive(Debug, Clone, Default)]
struct InForce {
    /// Initial stress and its forces.
    initial: Option<(Arc<PointField>, Arc<Vec<f64>>)>,
    temperature: Option<Arc<Vec<f64>>>,
    /// Strains of temperature, and those given.
    warmed: Option<Arc<PointField>>,
    given: Option<Arc<PointField>>,
    /// Strains from which those of a part count: those in force when it came.
    reference: Option<PointField>,
    /// σ_p and its forces as they were last.
    last: Option<(Arc<PointField>, Arc<Vec<f64>>)>,
}

/// Initial stresses and eigenstrains in force in all subdomains.
pub(super) struct AllInForce(Vec<InForce>);

impl AllInForce {
    /// Before the first step.
    pub(super) fn new(scene: &Scene, model: &Model, initial: &[Option<StressAt>]) -> Result<AllInForce> {
        let of = |(b, stress): (usize, &Option<StressAt>)| {
            let (name, mesh) = (&model.subdomains[b].name, &model.subdomains[b].mesh);
            let nothing = || PointField::sample(mesh, |_| Ok::<_, Error>([0.0; 4]));
            let mut own = InForce::default();
            // results have the same arrays from the first to the last
            if scene.steps.iter().any(|step| step.temperature.contains_key(name)) {
                own.temperature = Some(Arc::new(vec![0.0; mesh.points.len()]));
                own.warmed = Some(Arc::new(nothing()?));
            }
            if scene.steps.iter().any(|step| step.strain.contains_key(name)) {
                own.given = Some(Arc::new(nothing()?));
            }
            let (stress, force) = match stress {
                Some(stress) => (
                    PointField::sample(mesh, |place| stress.at(place))?,
                    PointField::forces_of(mesh, model.thickness, |place| stress.at(place))?,
                ),
                None if own.warmed.is_some() || own.given.is_some() => {
                    (nothing()?, vec![0.0; 2 * mesh.points.len()])
                }
                None => return Ok(own),
            };
            let initial = (Arc::new(stress), Arc::new(force));
            Ok(InForce { initial: Some(initial.clone()), last: Some(initial), ..own })
        };
        Ok(AllInForce(initial.iter().enumerate().map(of).collect::<Result<_>>()?))
    }

    /// Goes through a step: what bodies have in it; empty if none has anything.
    pub(super) fn step(
        &mut self,
        scene: &Scene,
        model: &Model,
        index: &str,
        step: &Step,
        stage: Option<&StepStage>,
    ) -> Result<Vec<Option<Arc<Prestress>>>> {
        let mut all = Vec::new();
        for (b, own) in self.0.iter_mut().enumerate() {
            if let Some(stage) = stage {
                own.stage(stage, b);
            }
            let is_there = stage.is_none_or(|stage| stage.present[b]);
            all.push(own.step(scene, model, index, step, b, is_there)?.map(Arc::new));
        }
        if all.iter().all(Option::is_none) {
            all.clear();
        }
        Ok(all)
    }
}

impl InForce {
    /// A part that has gone has nothing any more, and one that comes is free of stress as it is then.
    fn stage(&mut self, stage: &StepStage, b: usize) {
        if stage.present[b] && !stage.activated.contains(&b) {
            return;
        }
        let none = self
            .last
            .as_ref()
            .map(|(stress, force)| (Arc::new(stress.map(|_| [0.0; 4])), Arc::new(vec![0.0; force.len()])));
        (self.initial, self.last) = (none.clone(), none);
        self.reference = self.in_force();
    }

    fn step(
        &mut self,
        scene: &Scene,
        model: &Model,
        index: &str,
        step: &Step,
        b: usize,
        is_there: bool,
    ) -> Result<Option<Prestress>> {
        let subdomain = &model.subdomains[b];
        let (mesh, elasticity) = (&subdomain.mesh, subdomain.elasticity);
        let before = self.clone();
        let quantity = |key: &str, more: &[&str], value: &Value| {
            let path: Vec<&str> =
                ["steps", index, key, &subdomain.name].into_iter().chain(more.iter().copied()).collect();
            Quantity::new(scene, &path, value)
        };
        if let Some(value) = step.temperature.get(&subdomain.name) {
            let value = quantity("temperature", &[], value);
            let expansion = scene.materials[&scene.subdomains[&subdomain.name].material].expansion;
            let at = |place: [f64; 3]| value.at(&in_body(place));
            let nodes: Result<Vec<f64>> = mesh.points.iter().map(|&place| at(place)).collect();
            let warmed = PointField::sample(mesh, |place| {
                let strain = expansion * at(place)?;
                Ok::<_, Error>([strain, strain, strain, 0.0])
            })?;
            (self.temperature, self.warmed) = (Some(Arc::new(nodes?)), Some(Arc::new(warmed)));
        }
        if let Some(values) = step.strain.get(&subdomain.name) {
            let parts = ["0", "1", "2", "3"].iter().zip(values);
            let values: Vec<Quantity> =
                parts.map(|(part, value)| quantity("strain", &[part], value)).collect();
            let given = PointField::sample(mesh, |place| {
                let mut strain = [0.0; 4];
                for (strain, value) in strain.iter_mut().zip(&values) {
                    *strain = value.at(&in_body(place))?;
                }
                Ok::<_, Error>(strain)
            })?;
            self.given = Some(Arc::new(given));
        }
        let changes =
            step.temperature.contains_key(&subdomain.name) || step.strain.contains_key(&subdomain.name);
        if changes && !is_there {
            self.reference = self.in_force();
        } else if changes {
            let eigen = self.strain().map(|strain| strain.map(|strain| elasticity.eigenstress(strain)));
            let (Some(eigen), Some((initial, held))) = (eigen, &self.initial) else { return Ok(None) };
            let mut force = eigen.forces(mesh, model.thickness);
            force.iter_mut().zip(held.iter()).for_each(|(force, held)| *force += held);
            let stress = eigen.plus(initial, 1.0);
            self.last = Some((Arc::new(stress), Arc::new(force)));
        }
        let (Some((stress_before, force_before)), Some((stress, force))) =
            (before.last.clone(), self.last.clone())
        else {
            return Ok(None);
        };
        let strain = before.strain().zip(self.strain()).map(|(start, end)| {
            let end = Arc::new(end);
            [if changes { Arc::new(start) } else { end.clone() }, end]
        });
        let energy = match &strain {
            None => [0.0; 3],
            Some([from, to]) => {
                let by = to.plus(from, -1.0);
                let [from_stress, by_stress] =
                    [&**from, &by].map(|field| field.map(|strain| elasticity.eigenstress(strain)));
                let product = |stress: &PointField, strain: &PointField| {
                    -0.5 * stress.product(strain, mesh, model.thickness)
                };
                [product(&from_stress, from), 2.0 * product(&from_stress, &by), product(&by_stress, &by)]
            }
        };
        let temperature = before.temperature.clone().zip(self.temperature.clone()).map(<[_; 2]>::from);
        let (stress, force) = ([stress_before, stress], [force_before, force]);
        Ok(Some(Prestress { stress, force, energy, temperature, strain }))
    }

    /// ε* that the scene states.
    fn in_force(&self) -> Option<PointField> {
        match (&self.warmed, &self.given) {
            (Some(warmed), Some(given)) => Some(warmed.plus(given, 1.0)),
            (Some(one), None) | (None, Some(one)) => Some((**one).clone()),
            (None, None) => None,
        }
    }

    /// ε* from the moment at which the part came.
    fn strain(&self) -> Option<PointField> {
        match &self.reference {
            Some(reference) => self.in_force().map(|all| all.plus(reference, -1.0)),
            None => self.in_force(),
        }
    }
}

fn in_body([x, y, z]: [f64; 3]) -> FormulaPlace {
    FormulaPlace { x, y, z, s: 0.0, load_factor: 1.0, ..FormulaPlace::default() }
}

/// Nodal forces of initial stresses and eigenstrains at a load factor; none without any [force].
pub(super) fn forces(model: &Model, all: &[Option<Arc<Prestress>>], load_factor: f64) -> Option<Vec<f64>> {
    if all.is_empty() {
        return None;
    }
    let mut force = vec![0.0; model.dofs()];
    for (b, own) in all.iter().enumerate() {
        let Some(Prestress { force: [from, to], .. }) = own.as_deref() else { continue };
        let dofs = &mut force[model.dofs_of(b)];
        for (dof, (from, to)) in dofs.iter_mut().zip(from.iter().zip(to.iter())) {
            *dof += ramp([*from, *to], load_factor);
        }
    }
    Some(force)
}

fn ramp([from, to]: Ends, load_factor: f64) -> f64 {
    if load_factor == 1.0 { to } else { from + load_factor * (to - from) }
}
