//! The scene: what `scene.json` says, as types that reject unknown keys.
//!
//! A scene names; it never numbers. Groups are written `<subdomain>.<physical group>`, `<subdomain>` alone is the
//! whole body. Units are the user's own, as long as they are consistent.

mod accuracy;
mod check;
mod column;
mod explain;
pub mod expression;
mod functions;
mod grammar;
mod gravity;
mod ground;
mod interface;
mod interface_check;
mod joint_probe;
mod load_check;
mod named;
mod op;
mod patterns;
mod plain;
mod pressure;
pub mod probe;
mod random;
mod read;
mod schema;
mod set;
mod solution;
mod source;
mod stages;
mod stated_law;
mod text;
mod value;

pub use accuracy::{Accuracy, Preset};
pub use column::Column;
pub use gravity::Gravity;
pub use ground::{Ground, InitialStress, StressComponents};
pub use interface::{CouplingKind, DrawnGap, Grid, InitialGap, Interface, JOINED, OneOrMany, Quadrature};
pub use named::is_pattern;
pub use op::{FormulaPlace, Variable};
pub use pressure::{Drain, Flow, FlowEnd, Pressure};
pub use read::{document, parse, read};
pub use schema::{scene_schema, schema_of};
pub use solution::{Control, Solution, Strategy, Tangent};
pub use source::Source;
pub use stages::{LeftShare, StepStage};
pub use stated_law::StatedLaw;
pub use text::text_of;
pub use value::Value;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A whole problem: bodies, interfaces, load history, what to write.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The JSON Schema of this file, so that editors complete and check it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line for people.
    #[serde(default)]
    pub title: String,
    /// Plane strain or plane stress.
    pub plane: Plane,
    /// Thickness out of the plane [length].
    #[serde(default = "one")]
    pub thickness: f64,
    /// The parts, each with its own mesh.
    pub subdomains: IndexMap<String, Subdomain>,
    /// Elastic materials by name.
    pub materials: IndexMap<String, Material>,
    /// The interfaces between parts.
    #[serde(default)]
    pub interfaces: IndexMap<String, Interface>,
    /// The load history, in order.
    pub steps: Vec<Step>,
    /// Settings of the search for equilibrium where an interface is not elastic.
    #[serde(default)]
    pub solution: Solution,
    /// A preset of the knobs that trade speed for accuracy; what the scene states stays. Absent: the scene as it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// Parameters of `.geo` files that `accuracy` multiplies, `<subdomain>.<name>`: counts, of which more is finer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub refinement: Vec<String>,
    /// Results that are written.
    #[serde(default)]
    pub output: Output,
    /// File and positions that the scene came from; filled by the reader.
    #[serde(skip)]
    pub source: Source,
}

/// The out-of-plane assumption.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Plane {
    /// No strain out of the plane: long bodies.
    Strain,
    /// No stress out of the plane: thin plates.
    Stress,
}

/// One part: a geometry that gmsh meshes, or a mesh that is there.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Subdomain {
    /// gmsh geometry, relative to the scene file. Either this or `msh`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub geo: Option<String>,
    /// gmsh mesh (MSH 4.1; MSH 2 and 4.0 are converted by gmsh), relative to the scene file. Either this or `geo`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub msh: Option<String>,
    /// Physical surface of a mesh that several subdomains share: the subdomain consists of its cells, and the nodes on
    /// curves that it shares with others are its own. Absent: the whole mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<String>,
    /// Name of its material.
    pub material: String,
    /// Numbers handed to gmsh in place of the defaults of the `.geo` (its `DefineConstant`).
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub parameters: IndexMap<String, f64>,
    /// Stress that is there before the first load, in equilibrium with the loads of the first step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_stress: Option<InitialStress>,
}

/// Isotropic linear elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E [stress], positive.
    pub young: f64,
    /// Poisson's ratio ν, above −1 and below 0.5 (0.5 allowed in plane stress).
    pub poisson: f64,
    /// Mass density [mass / volume], for gravity.
    #[serde(default)]
    pub density: f64,
    /// Coefficient of thermal expansion α [1 / temperature], for `temperature`.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub expansion: f64,
}

/// A stage of loading. Supports and loads stay in force in later steps unless replaced.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Its name, for messages and the history.
    pub name: String,
    /// Equal parts in which the step is applied.
    #[serde(default = "one_increment")]
    pub increments: usize,
    /// Control from increment to increment.
    #[serde(default)]
    pub control: Control,
    /// Directions held at zero, by group, its name or a pattern (`*` any text, `?` any character), as all groups of a step.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub fix: IndexMap<String, Vec<Direction>>,
    /// Total displacement by group, ramped from its value at the start of the step [length]. A formula that holds
    /// load_factor is not ramped: it is the displacement at every load factor.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub displace: IndexMap<String, Displace>,
    /// Directions held at the displacement that they have at the start of the step, by group.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub hold: IndexMap<String, Vec<Direction>>,
    /// Directions freed, by group; the reaction goes to zero over the step. A point of several groups is freed for all.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub release: IndexMap<String, Vec<Direction>>,
    /// Loads by group, ramped from their last value; a pressure also by interface, its name or a pattern. A load in whose formulas load_factor occurs is not ramped: they
    /// are its value at every load factor of the step, and that at load_factor 1 afterwards.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub load: IndexMap<String, Load>,
    /// Force per volume (x, y) by subdomain, names or patterns [force / volume], ramped like a load.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub body_force: IndexMap<String, [Value; 2]>,
    /// Acceleration (x, y) that acts on every density [length / time²], or by subdomain, ramped like a load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Gravity>,
    /// Subdomains that come in this step, names or patterns with `*` and `?`: free of stress, in the place to which their
    /// neighbours have moved. One that is first mentioned here is absent until then.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub activate: Vec<String>,
    /// Subdomains that go at the start of this step, by name or pattern, with the share of their forces on their neighbours that
    /// is let go over the step: 1 is all.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub deactivate: IndexMap<String, f64>,
    /// Difference of temperature by subdomain, a number or a formula in x and y, ramped from its last value: with the
    /// `expansion` of the material it strains all three directions [temperature].
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub temperature: IndexMap<String, Value>,
    /// Strain of its own (xx, yy, zz, xy) by subdomain, such as shrinkage, tensor components, ramped alike [-].
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub strain: IndexMap<String, [Value; 4]>,
}

/// A coordinate direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// x
    X,
    /// y
    Y,
}

/// Prescribed displacement; a direction that is not named stays as it was.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Displace {
    /// Displacement in x [length].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Value>,
    /// Displacement in y [length].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Value>,
}

/// A load on a group.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Load {
    /// Force per area (x, y) on a curve [stress].
    Traction([Value; 2]),
    /// Pressure on a curve, positive against the body, or of water between the sides of an interface [stress].
    Pressure(Pressure),
    /// Force (x, y) at a point, through the whole thickness [force].
    Force([Value; 2]),
}

/// Results that are written.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Which increments write their fields.
    #[serde(default)]
    pub fields: Fields,
    /// Columns of history.csv by name: a probe, such as `interface.traction_t@0.5`, or a formula over those before it.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub history: IndexMap<String, Column>,
}

/// Which increments write their fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Fields {
    /// The unloaded state and every increment.
    #[default]
    Every,
    /// The unloaded state and the end of every step.
    Step,
    /// The last increment only.
    Last,
    /// None.
    None,
}

impl Direction {
    /// Component number.
    pub fn component(self) -> usize {
        self as usize
    }

    /// "x" or "y".
    pub fn name(self) -> &'static str {
        ["x", "y"][self.component()]
    }
}

impl Displace {
    /// The prescribed components: (direction, value).
    pub fn components(&self) -> impl Iterator<Item = (Direction, &Value)> {
        let both = [(Direction::X, &self.x), (Direction::Y, &self.y)];
        both.into_iter().filter_map(|(d, v)| v.as_ref().map(|v| (d, v)))
    }
}

/// Splits `<subdomain>.<group>`; a name without a dot is the whole body.
pub fn split_group(name: &str) -> (&str, Option<&str>) {
    match name.split_once('.') {
        Some((subdomain, group)) => (subdomain, Some(group)),
        None => (name, None),
    }
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

fn one() -> f64 {
    1.0
}

fn one_increment() -> usize {
    1
}
