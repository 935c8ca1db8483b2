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

mod interface;
mod step;

use std::fmt;
use std::path::Path;

use midplane::error::Result;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use serde_json::{Map, Value, json};

pub use interface::*;
pub use step::*;

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

impl Scene {
    /// A scene in plane "strain" or "stress", of no parts yet.
    pub fn new(plane: &str) -> Scene {
        let empty = json!({ "plane": plane, "subdomains": {}, "materials": {}, "steps": [] });
        Scene(empty.as_object().expect("an object").clone())
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
        let scene = midplane::run::parse_scene("scene.json".into(), self.to_string(), &[])?;
        Problem::bind(&scene, meshes)
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
