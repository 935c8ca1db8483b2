//! Probes: what a column of history.csv asks for.
//!
//! `interface.traction_n@0.5` a field at a fraction of the mid-plane's length, `upper.top.displacement_y` the mean over a
//! group, `interface.resultant_t` the force across an interface, `interface.moment` that about its middle, `energy.stored`, `energy.dissipated`,
//! `energy.released`, `energy.viscous`, `work.external`, `work.water`; of water `interface.uplift`, `interface.rate@0`, …

use super::{Direction, JOINED, Scene};
use crate::error::name_help;
use crate::law::{self, LawVariable};

/// A question to an increment.
#[derive(Debug, Clone, PartialEq)]
pub enum Probe {
    /// A field of an interface at a fraction of its length.
    Interface {
        /// The interface.
        interface: String,
        /// Which field.
        field: JointField,
        /// 0 at the start of the mid-plane, 1 at its end, counted along chain A with n on its left.
        fraction: f64,
    },
    /// Resultant of the traction across an interface [force].
    Resultant {
        /// The interface.
        interface: String,
        /// Component: n or t.
        component: usize,
    },
    /// Resultant of traction and pressure, component n [force].
    TotalResultant {
        /// The interface.
        interface: String,
    },
    /// Resultant of the pressure in an interface, positive where it pushes the sides apart [force].
    Uplift {
        /// The interface.
        interface: String,
    },
    /// Rate of flow at an end of an interface, or that which its drains take, for a unit thickness [length² / time].
    Rate {
        /// The interface.
        interface: String,
        /// At which place.
        place: RatePlace,
    },
    /// Moment of the traction across an interface about its middle, positive where tension grows along it [force × length].
    Moment {
        /// The interface.
        interface: String,
    },
    /// Mean displacement of a group [length].
    Displacement {
        /// The group, `<subdomain>` or `<subdomain>.<group>`.
        group: String,
        /// Its direction.
        direction: Direction,
    },
    /// Elastic energy of bodies and interfaces [force × length].
    EnergyStored,
    /// Energy dissipated by the interfaces so far [force × length].
    EnergyDissipated,
    /// Energy released by snaps so far [force × length].
    EnergyReleased,
    /// Work of the viscosity of laws so far, part of what is dissipated [force × length].
    EnergyViscous,
    /// Work done by loads and prescribed displacements so far [force × length].
    WorkExternal,
    /// Work of the pressures in interfaces so far, part of that [force × length].
    WorkWater,
}

/// Place of a rate of flow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RatePlace {
    /// Start, s = 0.
    Start,
    /// End, s = 1.
    End,
    /// All drains.
    Drains,
}

/// A field along an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointField {
    /// Jump, component n or t [length].
    Jump(usize),
    /// Traction, component n or t [stress].
    Traction(usize),
    /// Traction less the pressure, component n or t [stress].
    TotalTraction(usize),
    /// Pressure, positive [stress].
    Pressure,
    /// Hydraulic aperture of flow [length].
    Aperture,
    /// A variable that a law has of its own.
    Variable(&'static LawVariable),
}

const DISPLACEMENTS: [&str; 2] = ["displacement_x", "displacement_y"];
const JOINT_FIELDS: [(&str, JointField); 8] = [
    ("jump_n", JointField::Jump(0)),
    ("jump_t", JointField::Jump(1)),
    ("traction_n", JointField::Traction(0)),
    ("traction_t", JointField::Traction(1)),
    ("traction_total_n", JointField::TotalTraction(0)),
    ("traction_total_t", JointField::TotalTraction(1)),
    ("pressure", JointField::Pressure),
    ("hydraulic_aperture", JointField::Aperture),
];

/// Quantities of a whole interface.
const WHOLE: [&str; 7] =
    ["resultant_n", "resultant_t", "total_resultant_n", "uplift", "moment", "rate", "drain_rate"];

/// Fields along an interface by name: jump, traction, and what laws know beyond.
fn joint_fields() -> impl Iterator<Item = (&'static str, JointField)> {
    let own = law::variables().map(|variable| (variable.name, JointField::Variable(variable)));
    JOINT_FIELDS.into_iter().chain(own)
}

impl Probe {
    /// Reads a probe; on failure (what is wrong, what would have been right).
    pub fn parse(text: &str, scene: &Scene) -> std::result::Result<Probe, (String, String)> {
        match text {
            "energy.stored" => return Ok(Probe::EnergyStored),
            "energy.dissipated" => return Ok(Probe::EnergyDissipated),
            "energy.released" => return Ok(Probe::EnergyReleased),
            "energy.viscous" => return Ok(Probe::EnergyViscous),
            "work.external" => return Ok(Probe::WorkExternal),
            "work.water" => return Ok(Probe::WorkWater),
            _ => {}
        }
        check_separators(text, scene)?;
        let Some((object, field)) = text.rsplit_once('.').filter(|_| !text.contains('@')).or_else(|| {
            let dot = text.split('@').next().and_then(|head| head.rfind('.'))?;
            Some((&text[..dot], &text[dot + 1..]))
        }) else {
            let help = "write something like joint.traction_t@0.5, upper.top.displacement_y or energy.stored";
            return Err((format!("\"{text}\" is not a probe"), help.into()));
        };
        if scene.entry(object).is_some() {
            return interface(object, field);
        }
        if scene.interfaces.contains_key(object) {
            let what = format!("\"{object}\" makes an interface of every pair that touches");
            return Err((
                what,
                format!("name one of them, such as {object}{JOINED}a{JOINED}b for side A on a and B on b"),
            ));
        }
        if scene.subdomains.contains_key(super::split_group(object).0) {
            let direction = match DISPLACEMENTS.iter().position(|known| *known == field) {
                Some(0) => Direction::X,
                Some(_) => Direction::Y,
                None => return Err((format!("no field \"{field}\""), name_help(field, DISPLACEMENTS))),
            };
            return Ok(Probe::Displacement { group: object.into(), direction });
        }
        let names = scene.interfaces.keys().chain(scene.subdomains.keys()).map(String::as_str);
        let names = names.chain(["energy", "work"]);
        Err((format!("no interface or subdomain \"{object}\""), name_help(object, names)))
    }
}

/// Refuses a group whose name holds the separator of a place, which nothing could tell from the place itself.
fn check_separators(text: &str, scene: &Scene) -> std::result::Result<(), (String, String)> {
    let Some((object, field)) = text.rsplit_once('.') else { return Ok(()) };
    let (subdomain, group) = super::split_group(object);
    let is_field = DISPLACEMENTS.contains(&field);
    if is_field && scene.subdomains.contains_key(subdomain) && group.is_some_and(|group| group.contains('@'))
    {
        let what = format!("\"@\" in the name \"{object}\"");
        let help =
            "a probe cannot name a group with \"@\": give its curve a second physical group without it";
        return Err((what, help.into()));
    }
    Ok(())
}

fn interface(interface: &str, field: &str) -> std::result::Result<Probe, (String, String)> {
    let (name, fraction) = match field.split_once('@') {
        Some((name, fraction)) => (name, Some(fraction)),
        None => (field, None),
    };
    let component = ["resultant_n", "resultant_t"].iter().position(|&r| r == name);
    if let (Some(component), None) = (component, fraction) {
        return Ok(Probe::Resultant { interface: interface.into(), component });
    }
    let whole = || interface.to_string();
    match (name, fraction) {
        ("moment", None) => return Ok(Probe::Moment { interface: whole() }),
        ("total_resultant_n", None) => return Ok(Probe::TotalResultant { interface: whole() }),
        ("uplift", None) => return Ok(Probe::Uplift { interface: whole() }),
        ("drain_rate", None) => return Ok(Probe::Rate { interface: whole(), place: RatePlace::Drains }),
        ("rate", Some("0")) => return Ok(Probe::Rate { interface: whole(), place: RatePlace::Start }),
        ("rate", Some("1")) => return Ok(Probe::Rate { interface: whole(), place: RatePlace::End }),
        ("rate", at) => {
            let what = at.map_or("a rate of flow at no place".into(), |at| format!("a rate of flow at {at}"));
            return Err((what, "write rate@0 or rate@1, or drain_rate for what the drains take".into()));
        }
        _ => {}
    }
    let Some((_, field)) = joint_fields().find(|(known, _)| *known == name) else {
        let names = joint_fields().map(|(name, _)| name).chain(WHOLE);
        return Err((format!("no field \"{name}\""), name_help(name, names)));
    };
    let number = fraction.and_then(|f| f.parse::<f64>().ok()).filter(|f| (0.0..=1.0).contains(f));
    match number {
        Some(fraction) => Ok(Probe::Interface { interface: interface.into(), field, fraction }),
        None => Err((
            format!("\"{}\" does not say where", fraction.unwrap_or(name)),
            format!("add a fraction of the length from 0 to 1, such as {name}@0.5"),
        )),
    }
}
