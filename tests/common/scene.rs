//! Scenes as tests write them: subdomains, materials, interfaces with their laws, steps, probes.
//!
//! ```text
//! Scene::new("strain")
//!     .subdomains(["a", "b"], "rock")
//!     .material("rock", 1e4, 0.2)
//!     .interface("joint", faces("a.top", "b.bottom").law(coulomb(1e5, 1e5, 0.6)))
//!     .step(step("press").fix("a.bottom", "xy").pressure("b.top", 10))
//!     .step(step("slide").increments(5).displace("b.top", "x", 1e-3))
//!     .probe("shear", "joint.resultant_t")
//!     .bind(meshes)
//! ```
//!
//! Values are numbers or formulas; `with` sets any other key.

use std::fmt;
use std::path::Path;

use midplane::error::Result;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use serde_json::{Map, Value};

use super::bind;

/// Objects of a scene by their keys.
macro_rules! objects {
    ($($(#[$doc:meta])* $name:ident)*) => { $(
        $(#[$doc])*
        #[derive(Debug, Clone, Default, PartialEq)]
        pub struct $name(Map<String, Value>);

        impl $name {
            /// The object with a value at a key.
            pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
                self.0.insert(key.into(), value.into());
                self
            }

            /// The object with a value in the object at a key.
            pub fn with_in(mut self, key: &str, name: &str, value: impl Into<Value>) -> Self {
                member(&mut self.0, key).insert(name.into(), value.into());
                self
            }
        }

        impl From<$name> for Value {
            fn from(object: $name) -> Value {
                Value::Object(object.0)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "{}", Value::Object(self.0.clone()))
            }
        }
    )* };
}

objects! {
    /// A scene.
    Scene
    /// A subdomain with its mesh or geometry.
    Subdomain
    /// A pair of sides with a law.
    Interface
    /// A law of an interface.
    Law
    /// A step of the load history.
    Step
    /// Steady flow of water along an interface.
    Flow
}

/// The object at a key, made where there is none.
fn member<'a>(object: &'a mut Map<String, Value>, key: &str) -> &'a mut Map<String, Value> {
    let value = object.entry(key).or_insert_with(|| Value::Object(Map::new()));
    value.as_object_mut().expect("an object")
}

/// Two values in the plane.
fn pair(x: impl Into<Value>, y: impl Into<Value>) -> Value {
    Value::Array(vec![x.into(), y.into()])
}

/// The directions of "x", "y" or "xy".
fn directions(names: &str) -> Value {
    names.chars().map(String::from).collect()
}

impl Scene {
    /// A scene in plane "strain" or "stress", of no parts yet.
    pub fn new(plane: &str) -> Scene {
        let objects = ["subdomains", "materials"];
        let empty = Scene::default().with("plane", plane);
        objects
            .into_iter()
            .fold(empty, |scene, key| scene.with(key, Map::new()))
            .with("steps", Vec::<Value>::new())
    }

    /// A subdomain with a mesh of its own name.
    pub fn subdomain(self, name: &str, material: &str) -> Scene {
        self.body(name, mesh(name, material))
    }

    /// Subdomains of one material, each with a mesh of its own name.
    pub fn subdomains<'a>(self, names: impl IntoIterator<Item = &'a str>, material: &str) -> Scene {
        names.into_iter().fold(self, |scene, name| scene.subdomain(name, material))
    }

    /// A subdomain as stated.
    pub fn body(self, name: &str, subdomain: Subdomain) -> Scene {
        self.with_in("subdomains", name, subdomain)
    }

    /// An elastic material: E and ν.
    pub fn material(mut self, name: &str, young: f64, poisson: f64) -> Scene {
        let material = member(member(&mut self.0, "materials"), name);
        material.insert("young".into(), young.into());
        material.insert("poisson".into(), poisson.into());
        self
    }

    /// The density of a material.
    pub fn density(mut self, name: &str, density: f64) -> Scene {
        member(member(&mut self.0, "materials"), name).insert("density".into(), density.into());
        self
    }

    /// The thermal expansion of a material.
    pub fn expansion(mut self, name: &str, expansion: f64) -> Scene {
        member(member(&mut self.0, "materials"), name).insert("expansion".into(), expansion.into());
        self
    }

    /// An interface.
    pub fn interface(self, name: &str, interface: Interface) -> Scene {
        self.with_in("interfaces", name, interface)
    }

    /// A setting of the solution.
    pub fn solution(self, key: &str, value: impl Into<Value>) -> Scene {
        self.with_in("solution", key, value)
    }

    /// One more step.
    pub fn step(mut self, step: Step) -> Scene {
        let steps = self.0.entry("steps").or_insert_with(|| Value::Array(Vec::new()));
        steps.as_array_mut().expect("a list").push(step.into());
        self
    }

    /// More steps.
    pub fn steps(self, steps: impl IntoIterator<Item = Step>) -> Scene {
        steps.into_iter().fold(self, Scene::step)
    }

    /// A column of the history: a probe.
    pub fn probe(self, name: &str, probe: &str) -> Scene {
        self.column(name, probe)
    }

    /// A column of the history: a probe, or a formula.
    pub fn column(mut self, name: &str, column: impl Into<Value>) -> Scene {
        member(member(&mut self.0, "output"), "history").insert(name.into(), column.into());
        self
    }

    /// Columns of the history.
    pub fn probes<'a>(self, columns: impl IntoIterator<Item = (&'a str, &'a str)>) -> Scene {
        columns.into_iter().fold(self, |scene, (name, column)| scene.probe(name, column))
    }

    /// The scene bound to meshes.
    pub fn bind(&self, meshes: Vec<Mesh>) -> Result<Problem> {
        bind(&self.to_string(), meshes)
    }

    /// Writes `scene.json` into a folder.
    pub fn write(&self, folder: &Path) {
        std::fs::write(folder.join("scene.json"), self.to_string()).unwrap();
    }
}

/// A subdomain with a mesh of a file.
pub fn mesh(file: &str, material: &str) -> Subdomain {
    Subdomain::default().with("msh", file).with("material", material)
}

/// A subdomain with a geometry of a file.
pub fn geometry(file: &str, material: &str) -> Subdomain {
    Subdomain::default().with("geo", file).with("material", material)
}

/// The interface of two sides: one curve or a list of curves each.
pub fn faces(side_a: impl Into<Value>, side_b: impl Into<Value>) -> Interface {
    Interface::default().with("side_a", side_a).with("side_b", side_b)
}

/// The interfaces of all pairs of subdomains that touch, by two patterns of names.
pub fn between(side_a: &str, side_b: &str) -> Interface {
    Interface::default().with("between", pair(side_a, side_b))
}

/// The interfaces along curves inside a body.
pub fn within(curves: impl Into<Value>) -> Interface {
    Interface::default().with("within", curves)
}

impl Interface {
    /// Its law.
    pub fn law(self, law: Law) -> Interface {
        self.with("law", law)
    }

    /// Its coupling: "projected" or "pointwise".
    pub fn coupling(self, coupling: &str) -> Interface {
        self.with("coupling", coupling)
    }

    /// Initial traction (n, t).
    pub fn initial_traction(self, n: impl Into<Value>, t: impl Into<Value>) -> Interface {
        self.with("initial_traction", pair(n, t))
    }
}

/// A law of any type, without its parameters.
pub fn law(kind: &str) -> Law {
    Law::default().with("type", kind)
}

/// Springs K_N and K_T.
pub fn elastic(kn: impl Into<Value>, kt: impl Into<Value>) -> Law {
    law("elastic").with("normal_stiffness", kn).with("tangential_stiffness", kt)
}

/// Friction μ on springs K_N and K_T.
pub fn coulomb(kn: impl Into<Value>, kt: impl Into<Value>, friction: impl Into<Value>) -> Law {
    Law(elastic(kn, kt).0).with("type", "coulomb").with("friction_coefficient", friction)
}

/// Cracking on springs K_N and K_T: strengths χ₀ and c₀, tan φ₀, energies G_I and G_IIa, no dilatancy.
pub fn cracking(
    kn: impl Into<Value>,
    kt: impl Into<Value>,
    [chi, c, tan_phi]: [f64; 3],
    [gf_i, gf_iia]: [f64; 2],
) -> Law {
    Law(elastic(kn, kt).0)
        .with("type", "cracking")
        .with("tensile_strength", chi)
        .with("cohesion", c)
        .with("tan_friction", tan_phi)
        .with("fracture_energy_i", gf_i)
        .with("fracture_energy_iia", gf_iia)
        .with("dilatancy_stress", 0)
}

/// Cohesion on springs K_N and K_T: strengths in tension and shear, energies G_I and G_II.
pub fn cohesive(kn: impl Into<Value>, kt: impl Into<Value>, strengths: [f64; 2], energies: [f64; 2]) -> Law {
    Law(elastic(kn, kt).0)
        .with("type", "cohesive")
        .with("tensile_strength", strengths[0])
        .with("shear_strength", strengths[1])
        .with("fracture_energy_i", energies[0])
        .with("fracture_energy_ii", energies[1])
}

/// A step of one increment that changes nothing.
pub fn step(name: impl Into<Value>) -> Step {
    Step::default().with("name", name)
}

impl Step {
    /// Its number of increments.
    pub fn increments(self, n: usize) -> Step {
        self.with("increments", n)
    }

    /// Its control: "load", "auto" or "arclength".
    pub fn control(self, control: &str) -> Step {
        self.with("control", control)
    }

    /// Directions of a group held at zero: "x", "y" or "xy".
    pub fn fix(self, group: &str, held: &str) -> Step {
        self.with_in("fix", group, directions(held))
    }

    /// Directions of a group held where they are.
    pub fn hold(self, group: &str, held: &str) -> Step {
        self.with_in("hold", group, directions(held))
    }

    /// Directions of a group freed.
    pub fn release(self, group: &str, freed: &str) -> Step {
        self.with_in("release", group, directions(freed))
    }

    /// Displacement of a group in "x" or "y".
    pub fn displace(mut self, group: &str, direction: &str, value: impl Into<Value>) -> Step {
        member(member(&mut self.0, "displace"), group).insert(direction.into(), value.into());
        self
    }

    /// Pressure on a curve or in an interface; also flow.
    pub fn pressure(self, place: &str, pressure: impl Into<Value>) -> Step {
        self.load(place, "pressure", pressure)
    }

    /// Traction (x, y) on a curve.
    pub fn traction(self, curve: &str, x: impl Into<Value>, y: impl Into<Value>) -> Step {
        self.load(curve, "traction", pair(x, y))
    }

    /// Force (x, y) at a point.
    pub fn force(self, point: &str, x: impl Into<Value>, y: impl Into<Value>) -> Step {
        self.load(point, "force", pair(x, y))
    }

    /// A load of any kind.
    fn load(self, place: &str, kind: &str, value: impl Into<Value>) -> Step {
        self.with_in("load", place, Value::Object(Map::from_iter([(kind.to_string(), value.into())])))
    }

    /// Force per volume (x, y) on a subdomain.
    pub fn body_force(self, subdomain: &str, x: impl Into<Value>, y: impl Into<Value>) -> Step {
        self.with_in("body_force", subdomain, pair(x, y))
    }

    /// Acceleration (x, y) of all densities.
    pub fn gravity(self, x: impl Into<Value>, y: impl Into<Value>) -> Step {
        self.with("gravity", pair(x, y))
    }

    /// Difference of temperature of a subdomain.
    pub fn temperature(self, subdomain: &str, value: impl Into<Value>) -> Step {
        self.with_in("temperature", subdomain, value)
    }

    /// Own strain of a subdomain (xx, yy, zz, xy).
    pub fn strain(self, subdomain: &str, strain: impl Into<Value>) -> Step {
        self.with_in("strain", subdomain, strain)
    }

    /// Subdomains that come.
    pub fn activate<T: Into<Value>>(self, names: impl IntoIterator<Item = T>) -> Step {
        self.with("activate", Value::from_iter(names))
    }

    /// A subdomain that goes, and the share of its forces that is let go.
    pub fn deactivate(self, subdomain: &str, share: impl Into<Value>) -> Step {
        self.with_in("deactivate", subdomain, share)
    }
}

/// Flow by the cubic law of an aperture, with a viscosity.
pub fn flow(aperture: impl Into<Value>, viscosity: impl Into<Value>) -> Flow {
    let law = Flow::default().with("aperture", aperture).with("viscosity", viscosity);
    Flow::default().with("flow", law)
}

impl Flow {
    /// The ends of an interface: pressures, formulas, "wall", "joined" or null.
    pub fn ends(self, start: impl Into<Value>, end: impl Into<Value>) -> Flow {
        self.with_in("flow", "ends", pair(start, end))
    }

    /// A drain at a fraction of the length, with its pressure.
    pub fn drain(mut self, at: impl Into<Value>, pressure: impl Into<Value>) -> Flow {
        let drain =
            Map::from_iter([("at".to_string(), at.into()), ("pressure".to_string(), pressure.into())]);
        let drains = member(&mut self.0, "flow").entry("drains").or_insert_with(|| Value::Array(Vec::new()));
        drains.as_array_mut().expect("a list").push(drain.into());
        self
    }
}
