//! Validation of the loads of a step: on groups, and of water in interfaces.

use super::named::{check_group, is_pattern};
use super::{
    Flow, FlowEnd, Gravity, JOINED, Load, Pressure, Scene, Step, Strategy, Value, Variable, split_group,
};
use crate::error::{Result, name_help};

impl Scene {
    /// True for a name of a load that can only be that of interfaces: one of them, or a pattern.
    pub fn names_interfaces(&self, name: &str) -> bool {
        let (subdomain, group) = split_group(name);
        if group.is_some() || self.subdomains.contains_key(subdomain) {
            return false;
        }
        self.interfaces.contains_key(name) || is_pattern(name) || name.contains(JOINED)
    }

    /// Refuses the first load of a step that means nothing.
    pub(super) fn check_loads(&self, index: &str, step: &Step) -> Result<()> {
        for (name, load) in &step.load {
            let path = ["steps", index, "load", name.as_str()];
            if self.names_interfaces(name) {
                self.check_water(&path, load)?;
                continue;
            }
            let (subdomain, group) = split_group(name);
            if group.is_none() && !self.subdomains.contains_key(subdomain) {
                let names = self.subdomains.keys().chain(self.interfaces.keys()).map(String::as_str);
                let what = format!("no subdomain or interface \"{name}\"");
                return Err(self.source.error_at(&path, what, name_help(name, names)));
            }
            check_group(self, &path, name)?;
            if group.is_none() {
                let help =
                    if matches!(load, Load::Force(_)) { "name a point of it" } else { "name a curve of it" };
                return Err(self.source.error_at(&path, format!("\"{name}\" is a whole body"), help));
            }
            match load {
                Load::Pressure(Pressure::Flow(_)) => {
                    let path = [&path[..], &["pressure"]].concat();
                    let help = "name an interface, or give a number or formula";
                    return Err(self.source.error_at(&path, "water flows along interfaces", help));
                }
                Load::Pressure(Pressure::Imposed(value)) => self.check_place(&path, "pressure", [value])?,
                Load::Traction(values) => self.check_place(&path, "traction", values)?,
                Load::Force(values) => self.check_place(&path, "force", values)?,
            }
        }
        let at = |key: &'static str| ["steps", index, key];
        for (name, displace) in &step.displace {
            let values = displace.components().map(|(_, value)| value);
            self.check_place(&[&at("displace")[..], &[name]].concat(), "", values)?;
        }
        for (name, values) in &step.body_force {
            self.check_place(&[&at("body_force")[..], &[name]].concat(), "", values)?;
        }
        for (part, values) in step.gravity.iter().flat_map(Gravity::all) {
            let path: Vec<&str> = at("gravity").into_iter().chain(part).collect();
            self.check_place(&path, "", values)?;
        }
        Ok(())
    }

    /// Opening and damage are known in an interface alone.
    pub(super) fn check_place<'v>(
        &self,
        path: &[&str],
        key: &str,
        values: impl IntoIterator<Item = &'v Value>,
    ) -> Result<()> {
        for value in values {
            for variable in Variable::OF_INTERFACES {
                if value.uses(variable) {
                    let path: Vec<&str> =
                        path.iter().copied().chain([key]).filter(|part| !part.is_empty()).collect();
                    let what = format!("{} in {value}", variable.name());
                    let help = "only the pressure in an interface knows its opening and damage";
                    return Err(self.source.error_at(&path, what, help));
                }
            }
        }
        Ok(())
    }

    /// Water in interfaces has a pressure alone.
    fn check_water(&self, path: &[&str], load: &Load) -> Result<()> {
        match load {
            Load::Pressure(Pressure::Imposed(_)) => Ok(()),
            Load::Pressure(Pressure::Flow(_))
                if matches!(self.solution.strategy, Strategy::Plain | Strategy::Blocks) =>
            {
                let what = "flow is solved with the jumps of the interfaces";
                let help = "leave \"strategy\" out, or take \"condensed\"";
                Err(self.source.error_at(&["solution", "strategy"], what, help))
            }
            Load::Pressure(Pressure::Flow(flow)) => {
                self.check_flow(&[path, &["pressure", "flow"]].concat(), flow)
            }
            Load::Traction(_) | Load::Force(_) => {
                let what = format!("\"{}\" is an interface", path[path.len() - 1]);
                Err(self.source.error_at(
                    path,
                    what,
                    "give it a \"pressure\", or load a curve of a subdomain",
                ))
            }
        }
    }

    fn check_flow(&self, path: &[&str], flow: &Flow) -> Result<()> {
        for (key, value) in [("aperture", flow.aperture), ("viscosity", flow.viscosity)] {
            if !(value > 0.0 && value.is_finite()) {
                let path = [path, &[key]].concat();
                let what = format!("{value} is no {key}");
                return Err(self.source.error_at(&path, what, "it must be positive"));
            }
        }
        for (end, condition) in flow.ends.iter().enumerate() {
            if let Some(FlowEnd::Pressure(value)) = condition {
                self.check_place(&[path, &["ends"]].concat(), ["0", "1"][end], [value])?;
            }
        }
        for (i, drain) in flow.drains.iter().enumerate() {
            let number = i.to_string();
            let path = [path, &["drains", &number]].concat();
            if !(drain.at > 0.0 && drain.at < 1.0) {
                let what = format!("{} is no place between the ends", drain.at);
                let help = "it is a fraction of the length, above 0 and below 1";
                return Err(self.source.error_at(&[&path[..], &["at"]].concat(), what, help));
            }
            if flow.drains[..i].iter().any(|before| before.at == drain.at) {
                let what = format!("two drains at {}", drain.at);
                return Err(self.source.error_at(
                    &[&path[..], &["at"]].concat(),
                    what,
                    "leave one of them out",
                ));
            }
            self.check_place(&path, "pressure", [&drain.pressure])?;
        }
        Ok(())
    }
}
