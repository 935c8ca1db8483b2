//! Steps of a scene: supports, displacements, loads, parts that come and go.

use serde_json::{Map, Value};

use super::{Flow, Step, member, pair};

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

/// The directions of "x", "y" or "xy".
fn directions(names: &str) -> Value {
    names.chars().map(String::from).collect()
}
