//! A scene bound to its meshes: names become nodes, edges and cells, once.

mod along;
mod between;
mod cover;
mod curve;
mod gap;
mod groups;
mod history;
mod idle;
mod initial;
mod load;
mod parts;
mod plan;
mod probes;
mod quantity;
mod rigid;
mod step;
mod stiffness;
mod survey;
mod unjoined;
mod unused;
mod warnings;

pub use gap::Gaps;
pub use history::Reaction;
pub use initial::InitialTraction;
pub use parts::subdomain_meshes;
pub use probes::{BoundProbe, ProbeInput};
pub use rigid::is_constrained;
pub use step::BoundStep;
pub use stiffness::stiffness_number;
pub use survey::Survey;
pub use unused::unused_groups;

use crate::assembly::{Body, InterfaceOperator, Model};
use crate::continuum::{Elasticity, PlaneState};
use crate::error::{Result, Warning};
use crate::law::{self, Integration, Law};
use crate::mesh::Mesh;
use crate::scene::{self, Scene};

/// Everything the run needs, with no names left to resolve.
#[derive(Debug)]
pub struct Problem {
    /// Bodies and interfaces.
    pub model: Model,
    /// Law and initial traction of every interface.
    pub laws: Vec<(Law, InitialTraction)>,
    /// States of the law points before the first increment; empty for an elastic interface, which has no history.
    pub states: Vec<Vec<law::State>>,
    /// How the laws' integration is controlled, interface by interface.
    pub integration: Vec<Integration>,
    /// How equilibrium is found where an interface is not elastic.
    pub solution: scene::Solution,
    /// Supports and loads step by step.
    pub steps: Vec<BoundStep>,
    /// Which increments store their fields.
    pub fields: scene::Fields,
    /// Columns of the history: name and probe.
    pub probes: Vec<(String, BoundProbe)>,
    /// Groups that hold something, for their reactions.
    pub reactions: Vec<Reaction>,
    /// True for the elastic interfaces that are too stiff for differences of displacements.
    pub stiff: Vec<bool>,
    /// What the user should know before believing the result.
    pub warnings: Vec<Warning>,
}

impl Problem {
    /// Names of the history's columns after the fixed ones: probes, then reactions.
    pub fn columns(&self) -> Vec<String> {
        let reactions = self.reactions.iter().map(Reaction::name);
        self.probes.iter().map(|(name, _)| name.clone()).chain(reactions).collect()
    }

    /// Binds a scene to the meshes of its subdomains, in their order.
    pub fn bind(scene: &Scene, meshes: Vec<Mesh>) -> Result<Problem> {
        Problem::bind_joined(scene, meshes, &[])
    }

    /// The same where the interfaces are known from a scene that differs in laws, materials, loads or output only.
    pub fn bind_joined(
        scene: &Scene,
        meshes: Vec<Mesh>,
        interfaces: &[InterfaceOperator],
    ) -> Result<Problem> {
        let mut model = Model {
            components: 2,
            thickness: scene.thickness,
            subdomains: subdomains(scene, meshes),
            interfaces: Vec::new(),
        };
        let mut warnings = warnings::locking(&model.subdomains);
        let (mut laws, mut states, mut integration) = (Vec::new(), Vec::new(), Vec::new());
        let mut stiff = Vec::new();
        let plans = plan::plans(scene, &model)?;
        for (k, plan) in plans.iter().enumerate() {
            let interface =
                interfaces.get(k).map_or_else(|| plan.join(&model), |interface| Ok(interface.clone()))?;
            let stated = plan.stated;
            stiffness::check_precision(scene, &model, &interface, plan)?;
            warnings.extend(warnings::of_interface(scene, &model, &interface, plan));
            stiff.push(stiffness::is_stiff(scene, stated, &model, &interface));
            let gaps = Gaps::new(stated.initial_gap, &interface);
            let initial = InitialTraction::bind(scene, plan.entry, stated, &interface)?;
            states.push(initial::states(scene, plan.entry, &stated.law, &initial, &gaps, &interface)?);
            integration.push(Integration::Tolerance(stated.law_tolerance));
            laws.push((stated.law, initial));
            model.interfaces.push(interface);
        }
        warnings.extend(cover::shares(scene, &model, &plans)?);
        let (connectivity, unjoined) = unjoined::look(&model, &plans)?;
        warnings.extend(unjoined);
        model
            .subdomains
            .iter_mut()
            .zip(&connectivity)
            .for_each(|(subdomain, found)| subdomain.pieces = found.nodes(subdomain));
        let (steps, reactions) = history::steps(scene, &model)?;
        warnings.extend(idle::loads(scene, &model)?);
        warnings.extend(idle::keys(scene, &plans));
        for step in &steps {
            let warning = rigid::check_free_subdomains(&model, &connectivity, &laws, step)?;
            let new = warning.filter(|warning| !warnings.contains(warning));
            warnings.extend(new);
        }
        let probes = probes::bind(scene, &model)?;
        let (solution, fields) = (scene.solution, scene.output.fields);
        Ok(Problem {
            model,
            laws,
            states,
            integration,
            solution,
            fields,
            steps,
            probes,
            reactions,
            stiff,
            warnings,
        })
    }
}

fn subdomains(scene: &Scene, meshes: Vec<Mesh>) -> Vec<Body> {
    let plane = match scene.plane {
        scene::Plane::Strain => PlaneState::Strain,
        scene::Plane::Stress => PlaneState::Stress,
    };
    let mut first_node = 0;
    let subdomains = scene.subdomains.iter().zip(meshes).map(|((name, subdomain), mesh)| {
        let material = scene.materials[&subdomain.material];
        let elasticity = Elasticity::new(material.young, material.poisson, plane);
        let subdomain = Body {
            name: name.clone(),
            mesh,
            elasticity,
            density: material.density,
            first_node,
            pieces: Vec::new(),
        };
        first_node += subdomain.mesh.points.len();
        subdomain
    });
    subdomains.collect()
}
