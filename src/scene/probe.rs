//! Probes: what a column of history.csv asks for.
//!
//! `interface.traction_n@0.5` a field at a fraction of the mid-plane's length, `upper.top.displacement_y` the mean over a
//! group, `interface.resultant_t` the force across an interface, `interface.moment` that about its middle, `energy.stored`, `energy.dissipated`,
//! `energy.released`, `energy.viscous`, `work.external`, `work.water`; of water `interface.uplift`, `interface.rate@0`, …

use wildmatch::WildMatch;

pub use super::joint_probe::{JointField, JointQuantity, RatePlace, Statistic};
use super::joint_probe::{JointProbe, joint};
use super::named::is_pattern;
use super::{Direction, JOINED, Scene};
use crate::error::name_help;

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
    /// A quantity of a whole interface, or of all that fit a pattern.
    Joint {
        /// The interface, its name or a pattern.
        interface: String,
        /// The quantity.
        quantity: JointQuantity,
    },
    /// Sum of the reactions of a group, or over the union of those of a pattern [force].
    Reaction {
        /// The group, its name or a pattern.
        group: String,
        /// Its direction.
        direction: Direction,
    },
    /// Mean displacement of a group, or over the union of those of a pattern [length].
    Displacement {
        /// The group, `<subdomain>` or `<subdomain>.<group>`, or a pattern.
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

const DISPLACEMENTS: [&str; 2] = ["displacement_x", "displacement_y"];
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
        if let Some(rest) = text.strip_prefix("reaction:") {
            return reaction(rest, scene);
        }
        check_separators(text, scene)?;
        let Some((object, field)) = text.rsplit_once('.').filter(|_| !text.contains('@')).or_else(|| {
            let dot = text.split('@').next().and_then(|head| head.rfind('.'))?;
            Some((&text[..dot], &text[dot + 1..]))
        }) else {
            let help = "write something like joint.traction_t@0.5, upper.top.displacement_y or energy.stored";
            return Err((format!("\"{text}\" is not a probe"), help.into()));
        };
        let displacement = DISPLACEMENTS.iter().position(|known| *known == field);
        if scene.entry(object).is_some() || is_pattern(object) && displacement.is_none() {
            let interface = object.to_string();
            return Ok(match joint(object, field)? {
                JointProbe::At(field, fraction) => Probe::Interface { interface, field, fraction },
                JointProbe::Whole(quantity) => Probe::Joint { interface, quantity },
            });
        }
        if scene.interfaces.contains_key(object) {
            let what = format!("\"{object}\" makes an interface of every pair that touches");
            return Err((
                what,
                format!(
                    "name one of them, such as {object}{JOINED}a{JOINED}b for side A on a and B on b, or all: {object}{JOINED}*"
                ),
            ));
        }
        if is_of_subdomain(object, scene) {
            let direction = match displacement {
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

/// True for a group of a subdomain, or a pattern that fits some.
fn is_of_subdomain(object: &str, scene: &Scene) -> bool {
    let subdomain = super::split_group(object).0;
    let matcher = WildMatch::new(subdomain);
    scene.subdomains.contains_key(subdomain)
        || is_pattern(subdomain) && scene.subdomains.keys().any(|name| matcher.matches(name))
}

/// The probe of a reaction, `<group or pattern>:x` or `…:y`.
fn reaction(text: &str, scene: &Scene) -> std::result::Result<Probe, (String, String)> {
    let (group, direction) = text.rsplit_once(':').unwrap_or((text, ""));
    let direction = match direction {
        "x" => Direction::X,
        "y" => Direction::Y,
        _ => {
            let help = "write reaction:upper.top:x or reaction:*.bottom:y";
            return Err((format!("\"reaction:{text}\" has no direction"), help.into()));
        }
    };
    if is_of_subdomain(group, scene) {
        return Ok(Probe::Reaction { group: group.into(), direction });
    }
    let subdomain = super::split_group(group).0;
    let help = name_help(subdomain, scene.subdomains.keys().map(String::as_str));
    Err((format!("no subdomain \"{subdomain}\""), help))
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
