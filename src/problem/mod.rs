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
mod stage;
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
pub use rigid::is_held;
pub use stage::BoundStep;
pub use stiffness::stiffness_number;
pub use survey::Survey;
pub use unused::unused_groups;

use crate::assembly::{Body, Joint, Model};
use crate::continuum::{Elasticity, PlaneState};
use crate::error::{Result, Warning};
use crate::law::{self, Integration, Law};
use crate::mesh::Mesh;
use crate::scene::{self, Scene};

/// Everything the run needs, with no names left to resolve.
#[derive(Debug)]
pub struct Problem {
    /// Bodies and joints.
    pub model: Model,
    /// Law and initial traction of every joint.
    pub laws: Vec<(Law, InitialTraction)>,
    /// States of the law points before the first increment; empty for an elastic joint, which has no history.
    pub states: Vec<Vec<law::State>>,
    /// How the laws' integration is controlled, joint by joint.
    pub stepping: Vec<Integration>,
    /// How equilibrium is found where a joint is not elastic.
    pub solution: scene::Solution,
    /// Supports and loads step by step.
    pub stages: Vec<BoundStep>,
    /// Which increments store their fields.
    pub fields: scene::Fields,
    /// Columns of the history: name and probe.
    pub probes: Vec<(String, BoundProbe)>,
    /// Groups that hold something, for their reactions.
    pub reactions: Vec<Reaction>,
    /// True for the elastic joints that are too stiff for differences of displacements.
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

    /// The same where the joints are known from a scene that differs in laws, materials, loads or output only.
    pub fn bind_joined(scene: &Scene, meshes: Vec<Mesh>, joints: &[Joint]) -> Result<Problem> {
        let mut model = Model {
            components: 2,
            thickness: scene.thickness,
            bodies: bodies(scene, meshes),
            joints: Vec::new(),
        };
        let mut warnings = warnings::locking(&model.bodies);
        let (mut laws, mut states, mut stepping) = (Vec::new(), Vec::new(), Vec::new());
        let mut stiff = Vec::new();
        let plans = plan::plans(scene, &model)?;
        for (k, plan) in plans.iter().enumerate() {
            let joint = joints.get(k).map_or_else(|| plan.join(&model), |joint| Ok(joint.clone()))?;
            let interface = plan.interface;
            stiffness::refuse_beyond_precision(scene, &model, &joint, plan)?;
            warnings.extend(warnings::of_joint(scene, &model, &joint, plan));
            stiff.push(stiffness::is_stiff(scene, interface, &model, &joint));
            let gaps = Gaps::new(interface.initial_gap, &joint);
            let initial = InitialTraction::bind(scene, plan.entry, interface, &joint)?;
            states.push(initial::states(scene, plan.entry, &interface.law, &initial, &gaps, &joint)?);
            stepping.push(Integration::Tolerance(interface.law_tolerance));
            laws.push((interface.law, initial));
            model.joints.push(joint);
        }
        warnings.extend(cover::shares(scene, &model, &plans)?);
        let (connectivity, unjoined) = unjoined::look(&model, &plans)?;
        warnings.extend(unjoined);
        model.bodies.iter_mut().zip(&connectivity).for_each(|(body, found)| body.pieces = found.nodes(body));
        let (stages, reactions) = history::stages(scene, &model)?;
        warnings.extend(idle::loads(scene, &model)?);
        warnings.extend(idle::keys(scene, &plans));
        for stage in &stages {
            let warning = rigid::refuse_free_bodies(&model, &connectivity, &laws, stage)?;
            let new = warning.filter(|warning| !warnings.contains(warning));
            warnings.extend(new);
        }
        let probes = probes::bind(scene, &model)?;
        let (solution, fields) = (scene.solution, scene.output.fields);
        Ok(Problem {
            model,
            laws,
            states,
            stepping,
            solution,
            fields,
            stages,
            probes,
            reactions,
            stiff,
            warnings,
        })
    }
}

fn bodies(scene: &Scene, meshes: Vec<Mesh>) -> Vec<Body> {
    let plane = match scene.plane {
        scene::Plane::Strain => PlaneState::Strain,
        scene::Plane::Stress => PlaneState::Stress,
    };
    let mut first_node = 0;
    let bodies = scene.subdomains.iter().zip(meshes).map(|((name, subdomain), mesh)| {
        let material = scene.materials[&subdomain.material];
        let elasticity = Elasticity::new(material.young, material.poisson, plane);
        let body = Body {
            name: name.clone(),
            mesh,
            elasticity,
            density: material.density,
            first_node,
            pieces: Vec::new(),
        };
        first_node += body.mesh.points.len();
        body
    });
    bodies.collect()
}
