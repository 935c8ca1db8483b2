//! Probes of interfaces: a field at a place, or a quantity of a whole interface, or of all that fit a pattern.

use super::named::is_pattern;
use crate::error::name_help;
use crate::law::{self, LawVariable};

/// A quantity of whole interfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointQuantity {
    /// Resultant of the traction, component n or t [force].
    Resultant(usize),
    /// Resultant of traction and pressure, component n [force].
    TotalResultant,
    /// Resultant of the pressure, positive where it pushes the sides apart [force].
    Uplift,
    /// Moment of the traction about the middle, positive where tension grows along an interface [force × length].
    Moment,
    /// Rate of flow for a unit thickness [length² / time].
    Rate(RatePlace),
    /// Largest, smallest or mean value of a field along it.
    Statistic(Statistic, JointField),
    /// Length over which the faces are apart and carry nothing [length].
    OpenLength,
    /// Length over which some strength is lost [length].
    CrackedLength,
}

/// Value of a field that stands for all along an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// The largest.
    Max,
    /// The smallest.
    Min,
    /// The mean over the length.
    Mean,
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

const FIELDS: [(&str, JointField); 8] = [
    ("jump_n", JointField::Jump(0)),
    ("jump_t", JointField::Jump(1)),
    ("traction_n", JointField::Traction(0)),
    ("traction_t", JointField::Traction(1)),
    ("traction_total_n", JointField::TotalTraction(0)),
    ("traction_total_t", JointField::TotalTraction(1)),
    ("pressure", JointField::Pressure),
    ("hydraulic_aperture", JointField::Aperture),
];
const STATISTICS: [(&str, Statistic); 3] =
    [("max_", Statistic::Max), ("min_", Statistic::Min), ("mean_", Statistic::Mean)];
const QUANTITIES: [(&str, JointQuantity); 8] = [
    ("resultant_n", JointQuantity::Resultant(0)),
    ("resultant_t", JointQuantity::Resultant(1)),
    ("total_resultant_n", JointQuantity::TotalResultant),
    ("uplift", JointQuantity::Uplift),
    ("moment", JointQuantity::Moment),
    ("drain_rate", JointQuantity::Rate(RatePlace::Drains)),
    ("open_length", JointQuantity::OpenLength),
    ("cracked_length", JointQuantity::CrackedLength),
];

/// Fields along an interface by name: jump, traction, water, and what laws know beyond.
fn fields() -> impl Iterator<Item = (&'static str, JointField)> {
    let own = law::variables().map(|variable| (variable.name, JointField::Variable(variable)));
    FIELDS.into_iter().chain(own)
}

impl JointQuantity {
    /// True if it is one of several interfaces together as well.
    fn is_of_several(&self) -> bool {
        match self {
            JointQuantity::Rate(_) => false,
            JointQuantity::Statistic(statistic, _) => *statistic == Statistic::Max,
            _ => true,
        }
    }

    /// The quantity of a name without a place; of `rate` also with it.
    fn named(name: &str, place: Option<&str>) -> Option<JointQuantity> {
        match (name, place) {
            ("rate", Some("0")) => return Some(JointQuantity::Rate(RatePlace::Start)),
            ("rate", Some("1")) => return Some(JointQuantity::Rate(RatePlace::End)),
            (_, Some(_)) => return None,
            _ => {}
        }
        if let Some((_, quantity)) = QUANTITIES.iter().find(|(known, _)| *known == name) {
            return Some(*quantity);
        }
        STATISTICS.iter().find_map(|(prefix, statistic)| {
            let field = name.strip_prefix(prefix)?;
            let (_, field) = fields().find(|(known, _)| *known == field)?;
            Some(JointQuantity::Statistic(*statistic, field))
        })
    }
}

/// A probe of an interface.
pub(super) enum JointProbe {
    /// A field at a fraction of the length.
    At(JointField, f64),
    /// A quantity of all of it.
    Whole(JointQuantity),
}

/// The probe of an interface, or of those of a pattern; on failure (what is wrong, what would have been right).
pub(super) fn joint(interface: &str, field: &str) -> Result<JointProbe, (String, String)> {
    let (name, place) = match field.split_once('@') {
        Some((name, place)) => (name, Some(place)),
        None => (field, None),
    };
    if let Some(quantity) = JointQuantity::named(name, place) {
        if is_pattern(interface) && !quantity.is_of_several() {
            let what = format!("{field} of a pattern");
            let help = "resultants, moment, uplift, lengths and max_… are of several interfaces; name one for all else";
            return Err((what, help.into()));
        }
        return Ok(JointProbe::Whole(quantity));
    }
    if name == "rate" {
        let what = place.map_or("a rate of flow at no place".into(), |at| format!("a rate of flow at {at}"));
        return Err((what, "write rate@0 or rate@1, or drain_rate for what the drains take".into()));
    }
    let Some((_, field)) = fields().find(|(known, _)| *known == name) else {
        let names = fields().map(|(name, _)| name).chain(QUANTITIES.iter().map(|(name, _)| *name));
        return Err((format!("no field \"{name}\""), name_help(name, names)));
    };
    if is_pattern(interface) {
        let what = format!("{name} of a pattern");
        return Err((what, format!("name one interface, or take max_{name}")));
    }
    let number = place.and_then(|f| f.parse::<f64>().ok()).filter(|f| (0.0..=1.0).contains(f));
    match number {
        Some(fraction) => Ok(JointProbe::At(field, fraction)),
        None => Err((
            format!("\"{}\" does not say where", place.unwrap_or(name)),
            format!(
                "add a fraction of the length from 0 to 1, such as {name}@0.5, or take max_{name}, min_{name} or mean_{name}"
            ),
        )),
    }
}
