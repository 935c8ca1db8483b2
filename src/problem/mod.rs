//! A scene bound to its meshes: names become nodes, edges and cells, once.

mod along;
mod gap;
mod groups;
mod history;
mod initial;
mod joint;
mod load;
mod probes;
mod quantity;
mod rigid;
mod stage;

pub use gap::Gaps;
pub use history::Reaction;
pub use initial::InitialTraction;
pub use joint::stiffness_number;
pub use probes::{BoundProbe, ProbeInput};
pub use stage::Stage;

use crate::assembly::{Body, Joint, Model};
use crate::continuum::{Elasticity, Plane};
use crate::error::Result;
use crate::law::{self, Law, Stepping};
use crate::mesh::Mesh;
use crate::scene::{self, Scene};

/// K_N h/E times the machine's ε from which rounding is seen in the tractions.
const ROUNDING_SEEN: f64 = 1e-6;
/// The same from which nothing else is left.
const ROUNDING_RULES: f64 = 1e-3;

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
    pub stepping: Vec<Stepping>,
    /// How equilibrium is found where a joint is not elastic.
    pub solution: scene::Solution,
    /// Supports and loads step by step.
    pub stages: Vec<Stage>,
    /// Which increments store their fields.
    pub fields: scene::Fields,
    /// Columns of the history: name and probe.
    pub probes: Vec<(String, BoundProbe)>,
    /// Groups that hold something, for their reactions.
    pub reactions: Vec<Reaction>,
    /// What the user should know before believing the result.
    pub warnings: Vec<String>,
}

impl Problem {
    /// Binds a scene to the meshes of its subdomains, in their order.
    pub fn bind(scene: &Scene, meshes: Vec<Mesh>) -> Result<Problem> {
        let mut model = Model {
            components: 2,
            thickness: scene.thickness,
            bodies: bodies(scene, meshes),
            joints: Vec::new(),
        };
        let mut warnings = Vec::new();
        let (mut laws, mut states, mut stepping) = (Vec::new(), Vec::new(), Vec::new());
        for (name, interface) in &scene.interfaces {
            let joint = joint::join(scene, &model, name, interface)?;
            refuse_beyond_precision(scene, &model, &joint, interface)?;
            warnings.extend(joint_warnings(&model, &joint, interface));
            let gaps = Gaps::new(interface.initial_gap, &joint);
            let initial = InitialTraction::bind(scene, name, interface, &joint)?;
            states.push(initial::states(scene, name, &interface.law, &initial, &gaps, &joint)?);
            stepping.push(Stepping::Tolerance(interface.law_tolerance));
            laws.push((interface.law, initial));
            model.joints.push(joint);
        }
        let (stages, reactions) = history::stages(scene, &model)?;
        for stage in &stages {
            rigid::refuse_free_bodies(&model, &laws, stage)?;
        }
        let probes = probes::bind(scene, &model)?;
        let (solution, fields) = (scene.solution, scene.output.fields);
        Ok(Problem { model, laws, states, stepping, solution, fields, stages, probes, reactions, warnings })
    }
}

fn bodies(scene: &Scene, meshes: Vec<Mesh>) -> Vec<Body> {
    let plane = match scene.plane {
        scene::Plane::Strain => Plane::Strain,
        scene::Plane::Stress => Plane::Stress,
    };
    let mut first_node = 0;
    let bodies = scene.subdomains.iter().zip(meshes).map(|((name, subdomain), mesh)| {
        let material = scene.materials[&subdomain.material];
        let elasticity = Elasticity::new(material.young, material.poisson, plane);
        let body = Body { name: name.clone(), mesh, elasticity, density: material.density, first_node };
        first_node += body.mesh.points.len();
        body
    });
    bodies.collect()
}

/// A stiffness whose springs are nothing but rounding is refused.
fn refuse_beyond_precision(
    scene: &Scene,
    model: &Model,
    joint: &Joint,
    interface: &scene::Interface,
) -> Result<()> {
    let number = stiffness_number(model, joint, &interface.law);
    if number * f64::EPSILON <= ROUNDING_RULES {
        return Ok(());
    }
    let [kn, _] = interface.law.elastic_stiffness();
    let largest = kn * ROUNDING_SEEN / (number * f64::EPSILON);
    let what = format!("K_N h/E = {number:.1e} is beyond double precision");
    let cure = format!("take {largest:.0e} or less: stiffer springs change nothing but the rounding");
    Err(scene.source.refuse(&["interfaces", &joint.name, "law", "normal_stiffness"], what, cure))
}

fn joint_warnings(model: &Model, joint: &Joint, interface: &scene::Interface) -> Vec<String> {
    let mut warnings = Vec::new();
    let midplane = &joint.coupling.midplane;
    let name = &joint.name;
    let edges = [midplane.a.edges(), midplane.b.edges()];
    let matched = edges == [midplane.segments.len(); 2];
    let number = stiffness_number(model, joint, &interface.law);
    if number * f64::EPSILON > ROUNDING_SEEN {
        warnings.push(format!(
            "interface {name}: at K_N h/E = {number:.1e} rounding reaches the tractions; less stiff springs say as much"
        ));
    }
    warnings
        .extend(interface.law.warnings().into_iter().map(|warning| format!("interface {name}: {warning}")));
    if interface.coupling == scene::CouplingKind::Pointwise && !matched && number > 1.0 {
        warnings.push(format!(
            "interface {name}: \"pointwise\" on unmatched sides at K_N h/E = {number:.1} oscillates; use \"projected\""
        ));
    }
    for (share, side) in midplane.joined.iter().zip(["A", "B"]) {
        if *share < 1.0 - 1e-9 {
            let (share, length) = (100.0 * share, midplane.length);
            warnings.push(format!(
                "interface {name}: {share:.4} % of side {side} is joined (length {length:.6}), the rest faces nothing"
            ));
        }
    }
    if midplane.apart > 1e-9 * midplane.length && interface.initial_gap.is_none() {
        let widest = midplane.gap[1].max(-midplane.gap[0]);
        warnings
            .push(format!("interface {name}: the sides are up to {widest:.3e} apart; this is not a stress"));
    }
    warnings
}
