//! A scene bound to its meshes: names become nodes, edges and cells, once.

mod along;
mod between;
mod cover;
mod curve;
mod flow;
mod flow_lines;
mod gap;
mod ground;
mod groups;
mod history;
mod idle;
mod in_situ;
mod initial;
mod interface;
mod joint_probes;
mod load;
mod orient;
mod parts;
mod plan;
mod point_laws;
mod pressure_names;
mod pressures;
mod prestress;
mod probe_input;
mod probes;
mod quantity;
mod rigid;
mod scales;
mod step;
mod stiffness;
mod supports;
mod survey;
mod unjoined;
mod unused;
mod warnings;
mod water;
mod water_answer;
mod water_in_force;
mod within;

pub use curve::joinings;
pub use gap::Gaps;
pub use history::Reaction;
pub use initial::InitialTraction;
pub use interface::BoundInterface;
pub use parts::subdomain_meshes;
pub use point_laws::PointLaws;
pub use prestress::Prestress;
pub use probe_input::ProbeInput;
pub use probes::BoundProbe;
pub use rigid::is_constrained;
pub use step::BoundStep;
pub use stiffness::stiffness_number;
pub use supports::{Duty, duties};
pub use survey::Survey;
pub use unused::unused_groups;
pub use water::StepWater;
pub use water_answer::{EndRates, FlowAlong, FlowSlopes, WaterAnswer, WaterFields, WaterPoint};

use curve::PlannedInterface;
use ground::StressAt;
use unjoined::Connectivity;

use crate::assembly::{BoundSubdomain, InterfaceOperator, Model};
use crate::continuum::{Elasticity, PlaneState};
use crate::coupling::Surroundings;
use crate::error::{Result, Warning};
use crate::law::{self, Law, LawVariable};
use crate::mesh::Mesh;
use crate::scene::{self, Scene};

/// Everything the run needs, with no names left to resolve.
#[derive(Debug)]
pub struct Problem {
    /// Bodies and interfaces.
    pub model: Model,
    /// Laws and initial states of the interfaces.
    pub interfaces: Vec<BoundInterface>,
    /// Settings of the search for equilibrium where an interface is not elastic.
    pub solution: scene::Solution,
    /// Supports and loads step by step.
    pub steps: Vec<BoundStep>,
    /// Which increments store their fields.
    pub fields: scene::Fields,
    /// Columns of the history: name and probe.
    pub probes: Vec<(String, BoundProbe)>,
    /// Groups that hold something, for their reactions.
    pub reactions: Vec<Reaction>,
    /// Warnings so far.
    pub warnings: Vec<Warning>,
}

impl Problem {
    /// Names of the history's columns after the fixed ones: probes, then reactions.
    pub fn columns(&self) -> Vec<String> {
        let reactions = self.reactions.iter().map(Reaction::name);
        self.probes.iter().map(|(name, _)| name.clone()).chain(reactions).collect()
    }

    /// True if there is water in an interface in some step, and if it flows along it.
    pub fn water_in(&self, interface: usize) -> [bool; 2] {
        let steps = || self.steps.iter().filter_map(|step| step.water.as_ref());
        [steps().any(|water| water.is_in(interface)), steps().any(|water| water.flows_in(interface))]
    }

    /// True if water flows along some interface.
    pub fn flows(&self) -> bool {
        (0..self.interfaces.len()).any(|k| self.water_in(k)[1])
    }

    /// All laws of all interfaces that differ.
    pub fn laws(&self) -> impl Iterator<Item = &Law> {
        self.interfaces.iter().flat_map(|interface| interface.laws.all())
    }

    /// Variables of their laws, each name once.
    pub fn variables(&self) -> impl Iterator<Item = &'static LawVariable> {
        law::variables().filter(|variable| self.laws().any(|law| law.has(variable)))
    }

    /// Binds a scene to the meshes of its subdomains, in their order.
    pub fn bind(scene: &Scene, meshes: Vec<Mesh>) -> Result<Problem> {
        Problem::bind_joined(scene, meshes, &[])
    }

    /// The same where the interfaces are known from a scene that joins alike (`joinings`).
    pub fn bind_joined(scene: &Scene, meshes: Vec<Mesh>, known: &[InterfaceOperator]) -> Result<Problem> {
        let Joined { model, interfaces, plans, connectivity, stresses, mut warnings } =
            join(scene, meshes, known)?;
        warnings.extend(in_situ::disagreements(scene, &model, &interfaces, &plans, &stresses)?);
        let (steps, reactions, unbalanced) = history::steps(scene, &model, &interfaces, &stresses)?;
        warnings.extend(unbalanced);
        warnings.extend(idle::loads(scene, &model, &interfaces)?);
        warnings.extend(idle::keys(scene, &plans));
        for step in &steps {
            let warning = rigid::check_free_subdomains(&model, &connectivity, &interfaces, step)?;
            let new = warning.filter(|warning| !warnings.contains(warning));
            warnings.extend(new);
        }
        let probes = probes::bind(scene, &model)?;
        let (solution, fields) = (scene.solution, scene.output.fields);
        Ok(Problem { model, interfaces, solution, steps, fields, probes, reactions, warnings })
    }
}

/// Subdomains and interfaces, finished: loads, probes and the history are bound on them.
struct Joined<'a> {
    model: Model,
    interfaces: Vec<BoundInterface>,
    plans: Vec<PlannedInterface<'a>>,
    connectivity: Vec<Connectivity>,
    /// Initial stress of every subdomain.
    stresses: Vec<Option<StressAt>>,
    warnings: Vec<Warning>,
}

fn join<'a>(scene: &'a Scene, meshes: Vec<Mesh>, known: &[InterfaceOperator]) -> Result<Joined<'a>> {
    let mut model = Model {
        components: meshes.iter().map(Mesh::dimension).max().unwrap_or(0),
        thickness: scene.thickness,
        subdomains: subdomains(scene, meshes),
        interfaces: Vec::new(),
    };
    let (stresses, times) = (StressAt::all(scene, &model), scene.times()?);
    let mut warnings = warnings::locking(&model.subdomains);
    let mut interfaces = Vec::new();
    let opened = within::open(scene, &mut model)?;
    let plans = plan::plans(scene, &model, opened)?;
    let (supports, junctions) =
        (supports::over_all_steps(scene, &model)?, plan::junctions(&model, &plans, &times));
    let around = Surroundings { supports: &supports, junctions: &junctions };
    for (k, plan) in plans.iter().enumerate() {
        let operator = known.get(k).map_or_else(|| plan.join(&model, around), |known| Ok(known.clone()))?;
        let laws = PointLaws::bind(scene, plan.entry, plan.stated, &operator)?;
        stiffness::check_precision(scene, &model, &operator, plan, &laws)?;
        warnings.extend(warnings::of_interface(scene, &model, &operator, plan, &laws));
        interfaces.push(BoundInterface::new(scene, &model, &operator, plan, laws, &stresses)?);
        model.interfaces.push(operator);
    }
    warnings.extend(cover::shares(scene, &model, &plans, &times)?);
    let (connectivity, unjoined) = unjoined::look(&model, &plans, &times)?;
    warnings.extend(unjoined);
    for (subdomain, found) in model.subdomains.iter_mut().zip(&connectivity) {
        subdomain.pieces = found.nodes(subdomain);
    }
    Ok(Joined { model, interfaces, plans, connectivity, stresses, warnings })
}

fn subdomains(scene: &Scene, meshes: Vec<Mesh>) -> Vec<BoundSubdomain> {
    let plane = match scene.plane {
        scene::Plane::Strain => PlaneState::Strain,
        scene::Plane::Stress => PlaneState::Stress,
    };
    let mut first_node = 0;
    let subdomains = scene.subdomains.iter().zip(meshes).map(|((name, subdomain), mesh)| {
        let material = scene.materials[&subdomain.material];
        let elasticity = Elasticity::new(material.young, material.poisson, plane);
        let subdomain = BoundSubdomain {
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
