//! Validation of interfaces beyond their types: two sides on two subdomains, or two patterns that match some.

use super::named::{check_group, check_name, matching};
use super::{
    Control, CouplingKind, Grid, InitialGap, Interface, OneOrMany, Scene, Step, Variable, split_group,
};
use crate::error::Result;

impl Scene {
    /// Refuses the first thing that is wrong with an interface.
    pub(super) fn check_interface(&self, name: &str, interface: &Interface) -> Result<()> {
        let path = ["interfaces", name];
        check_name(self, &path, name)?;
        if self.subdomains.contains_key(name) {
            let help = "rename one of them: both name a file of results";
            return Err(self.source.error_at(&path, format!("\"{name}\" is also a subdomain"), help));
        }
        match (&interface.side_a, &interface.side_b, &interface.between, &interface.within) {
            (Some(a), Some(b), None, None) => self.check_sides(name, [a, b])?,
            (None, None, Some(patterns), None) => self.check_patterns(name, patterns)?,
            (None, None, None, Some(curves)) => self.check_curves(name, "within", curves)?,
            (_, _, Some(_), None) => {
                let (what, help) = ("both \"between\" and a side", "keep \"between\", or both sides");
                return Err(self.source.error_at(&path, what, help));
            }
            (.., Some(_)) => {
                let help = "keep \"within\" alone: it has both faces of its curves";
                return Err(self.source.error_at(&path, "both \"within\" and a side or \"between\"", help));
            }
            (a, _, None, None) => {
                let missing = if a.is_none() { "side_a" } else { "side_b" };
                let help = "give \"side_a\" and \"side_b\", \"between\" with two patterns of subdomains, or \"within\" with curves inside a body";
                return Err(self.source.error_at(&path, format!("the key \"{missing}\" is missing"), help));
            }
        }
        self.check_gap(name, interface)?;
        if interface.grid != Grid::Auto && interface.coupling == CouplingKind::Pointwise {
            let path = ["interfaces", name, "grid"];
            let help = "leave \"grid\" out, or take \"coupling\": \"projected\"";
            return Err(self.source.error_at(&path, "\"pointwise\" has no grid", help));
        }
        for (i, value) in interface.initial_traction.iter().enumerate() {
            let path = ["interfaces", name, "initial_traction", &i.to_string()];
            self.check_place(&path, "", [value])?;
            if value.uses(Variable::LoadFactor) {
                let what = format!("load_factor in {value}");
                return Err(self.source.error_at(
                    &path,
                    what,
                    "an initial traction is there before any load",
                ));
            }
        }
        let tolerance = interface.law_tolerance;
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let path = ["interfaces", name, "law_tolerance"];
            return Err(self.source.error_at(
                &path,
                format!("{tolerance} is no tolerance"),
                "it lies between 0 and 1, such as 1e-4",
            ));
        }
        self.check_law(name, interface)
    }

    /// A law whose numbers are numbers is checked here, any other at its law points.
    fn check_law(&self, name: &str, interface: &Interface) -> Result<()> {
        let law = &interface.law;
        let at_start = |key: &str, what: String| {
            let path: Vec<&str> = ["interfaces", name].into_iter().chain(key.split('.')).collect();
            let help = "what an interface is made of does not change with the load";
            Err(self.source.error_at(&path, what, help))
        };
        for variable in [Variable::LoadFactor, Variable::Opening, Variable::Damage] {
            if let Some((key, text)) = law.using(variable) {
                return at_start(&format!("law.{key}"), format!("{} in {text}", variable.name()));
            }
            if interface.initial_damage.uses(variable) {
                let what = format!("{} in {}", variable.name(), interface.initial_damage);
                return at_start("initial_damage", what);
            }
        }
        if !interface.initial_damage.is_zero() && !law.kind().takes_damage() {
            let what = "this law knows no initial damage";
            return Err(self.source.error_at(
                &["interfaces", name, "initial_damage"],
                what,
                "take \"cracking\" or \"cohesive\", or leave it out",
            ));
        }
        if !law.is_uniform() {
            return Ok(());
        }
        law.kind()
            .check()
            .map_err(|law| self.source.error_at(&["interfaces", name, "law", law.key], law.what, law.help))
    }

    /// The viscosity of a law counts in the load factor of a step, which must not fall.
    pub(super) fn check_clock(&self, index: &str, step: &Step) -> Result<()> {
        let viscous = |interface: &Interface| interface.law.kind().is_viscous();
        match self.interfaces.iter().find(|(_, interface)| viscous(interface)) {
            Some((name, _)) if step.control != Control::Load => {
                let what = format!("the law of \"{name}\" has a viscosity, whose time is the load factor");
                let help = "take \"control\": \"load\", or leave the viscosity out";
                Err(self.source.error_at(&["steps", index, "control"], what, help))
            }
            _ => Ok(()),
        }
    }

    fn check_sides(&self, name: &str, sides: [&OneOrMany; 2]) -> Result<()> {
        for (key, side) in ["side_a", "side_b"].into_iter().zip(sides) {
            self.check_curves(name, key, side)?;
        }
        let [a, b] = sides;
        if let Some(both) = a.names().iter().find(|name| b.names().contains(name)) {
            let what = format!("\"{both}\" is on both sides");
            let help = "an interface lies between two different curves; \"within\" opens a curve inside a body, with both its faces";
            return Err(self.source.error_at(&["interfaces", name], what, help));
        }
        Ok(())
    }

    fn check_curves(&self, name: &str, key: &str, side: &OneOrMany) -> Result<()> {
        let path = ["interfaces", name, key];
        if side.names().is_empty() {
            return Err(self.source.error_at(&path, "no curve", "name one, such as \"lower.top\""));
        }
        for group in side.names() {
            check_group(self, &path, group)?;
            if split_group(group).1.is_none() {
                let what = format!("\"{group}\" is a whole body");
                let help = format!("name a curve of it, such as \"{group}.top\"");
                return Err(self.source.error_at(&path, what, help));
            }
        }
        Ok(())
    }

    fn check_gap(&self, name: &str, interface: &Interface) -> Result<()> {
        let path = ["interfaces", name, "initial_gap"];
        let Some(gap) = interface.initial_gap else { return Ok(()) };
        if !interface.law.kind().takes_gap() {
            let what = "this law knows no initial gap";
            let help = "only \"type\": \"coulomb\" does: take that law or leave \"initial_gap\" out";
            return Err(self.source.error_at(&path, what, help));
        }
        match gap {
            InitialGap::Uniform(gap) if !gap.is_finite() => {
                let what = format!("{gap} is no distance");
                Err(self.source.error_at(
                    &path,
                    what,
                    "give a number, below zero for an overlap, or \"geometry\"",
                ))
            }
            _ => Ok(()),
        }
    }

    fn check_patterns(&self, name: &str, patterns: &[String; 2]) -> Result<()> {
        for (i, pattern) in patterns.iter().enumerate() {
            matching(self, &["interfaces", name, "between", &i.to_string()], pattern)?;
        }
        Ok(())
    }
}
