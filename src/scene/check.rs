//! Validation of a scene beyond its types: names that exist, numbers that mean something.

use super::named::{check_group, check_name};
use super::{Gravity, Plane, Scene, Step, Subdomain, Variable, split_group};
use crate::error::{Result, name_help};

/// Most increments of a step, and the least that a row of the history takes [bytes].
const MOST_INCREMENTS: usize = 100_000_000;
const ROW: f64 = 60.0;

impl Scene {
    /// Refuses the first thing that is wrong, with its line and key.
    pub(super) fn check(&self) -> Result<()> {
        if !(self.thickness > 0.0 && self.thickness.is_finite()) {
            let what = format!("{} is not a thickness", self.thickness);
            return Err(self.source.error_at(&["thickness"], what, "it must be positive"));
        }
        self.check_materials()?;
        self.check_subdomains()?;
        for (name, interface) in &self.interfaces {
            self.check_interface(name, interface)?;
        }
        if self.steps.is_empty() {
            return Err(self.source.error_at(
                &["steps"],
                "there is no step",
                "add one with \"name\" and \"load\"",
            ));
        }
        for (i, step) in self.steps.iter().enumerate() {
            self.check_step(&i.to_string(), step)?;
        }
        self.check_stages()?;
        for (i, name) in self.refinement.iter().enumerate() {
            let (subdomain, parameter) = split_group(name);
            if parameter.is_none() || !self.subdomains.contains_key(subdomain) {
                let what = format!("\"{name}\" is no parameter of a subdomain");
                let help = name_help(subdomain, self.subdomains.keys().map(String::as_str));
                let help = format!("write <subdomain>.<parameter>; {help}");
                return Err(self.source.error_at(&["refinement", &i.to_string()], what, help));
            }
        }
        self.check_columns()?;
        Ok(())
    }

    fn check_materials(&self) -> Result<()> {
        for (name, material) in &self.materials {
            let error_at =
                |key, what: String, help| Err(self.source.error_at(&["materials", name, key], what, help));
            let nu = material.poisson;
            let top_is_in = nu < 0.5 || (nu == 0.5 && self.plane == Plane::Stress);
            if !(material.young > 0.0 && material.young.is_finite()) {
                return error_at(
                    "young",
                    format!("Young's modulus is {}", material.young),
                    "it must be positive",
                );
            }
            if !(nu > -1.0 && top_is_in) {
                let help = match self.plane {
                    Plane::Strain => {
                        "it must lie above -1 and below 0.5 (an incompressible body needs plane stress)"
                    }
                    Plane::Stress => "it must lie above -1 and not above 0.5",
                };
                return error_at("poisson", format!("Poisson's ratio {nu} is out of range"), help);
            }
            if !material.expansion.is_finite() {
                return error_at("expansion", "it is not a number".into(), "give a number");
            }
            if !(material.density >= 0.0 && material.density.is_finite()) {
                return error_at(
                    "density",
                    format!("{} is not a density", material.density),
                    "it must be zero or more",
                );
            }
        }
        Ok(())
    }

    fn check_subdomains(&self) -> Result<()> {
        if self.subdomains.is_empty() {
            return Err(self.source.error_at(
                &["subdomains"],
                "there is no subdomain",
                "add one with \"geo\" and \"material\"",
            ));
        }
        for (name, subdomain) in &self.subdomains {
            let path = ["subdomains", name.as_str()];
            check_name(self, &path, name)?;
            match (&subdomain.geo, &subdomain.msh) {
                (None, None) => {
                    return Err(self.source.error_at(
                        &path,
                        "neither \"geo\" nor \"msh\"",
                        "give one of them",
                    ));
                }
                (Some(_), Some(_)) => {
                    return Err(self.source.error_at(&path, "both \"geo\" and \"msh\"", "keep one of them"));
                }
                _ => {}
            }
            if subdomain.msh.is_some() && !subdomain.parameters.is_empty() {
                let path = ["subdomains", name, "parameters"];
                return Err(self.source.error_at(
                    &path,
                    "a finished mesh takes no parameters",
                    "give \"geo\" in place of \"msh\"",
                ));
            }
            self.check_shared(name, subdomain)?;
            self.check_initial_stress(name)?;
            if !self.materials.contains_key(&subdomain.material) {
                let what = format!("no material \"{}\"", subdomain.material);
                let help = name_help(&subdomain.material, self.materials.keys().map(String::as_str));
                return Err(self.source.error_at(&["subdomains", name, "material"], what, help));
            }
        }
        Ok(())
    }

    /// Subdomains of one mesh are different surfaces of it.
    fn check_shared(&self, name: &str, subdomain: &Subdomain) -> Result<()> {
        let same = |other: &Subdomain| {
            (&other.geo, &other.msh, &other.parameters)
                == (&subdomain.geo, &subdomain.msh, &subdomain.parameters)
                && (other.surface == subdomain.surface
                    || other.surface.is_none()
                    || subdomain.surface.is_none())
        };
        let before = self.subdomains.iter().take_while(|(other, _)| *other != name);
        let Some((other, twin)) = before.into_iter().find(|(_, other)| same(other)) else { return Ok(()) };
        let file = subdomain.geo.as_ref().or(subdomain.msh.as_ref()).map_or("", String::as_str);
        let (key, what) = match (&subdomain.surface, &twin.surface) {
            (Some(surface), Some(_)) => {
                ("surface", format!("\"{other}\" is the surface \"{surface}\" of {file} already"))
            }
            _ => ("", format!("\"{other}\" and \"{name}\" are the same bodies of {file}")),
        };
        let path: Vec<&str> = ["subdomains", name, key].into_iter().filter(|part| !part.is_empty()).collect();
        Err(self.source.error_at(&path, what, "give each its own \"surface\" of the mesh"))
    }

    fn check_step(&self, index: &str, step: &Step) -> Result<()> {
        self.check_clock(index, step)?;
        if step.increments == 0 {
            let path = ["steps", index, "increments"];
            return Err(self.source.error_at(&path, "a step of 0 increments", "give 1 or more"));
        }
        if step.increments > MOST_INCREMENTS {
            let gigabytes = step.increments as f64 * ROW / 1e9;
            let what = format!(
                "{} increments, for which history.csv alone takes {gigabytes:.0} GB or more",
                step.increments
            );
            let help = format!("give {MOST_INCREMENTS} at most");
            return Err(self.source.error_at(&["steps", index, "increments"], what, help));
        }
        for (key, groups) in [
            ("fix", step.fix.keys().collect::<Vec<_>>()),
            ("displace", step.displace.keys().collect()),
            ("body_force", step.body_force.keys().collect()),
        ] {
            for group in groups {
                check_group(self, &["steps", index, key, group], group)?;
            }
        }
        self.check_loads(index, step)?;
        self.check_gravity(index, step)?;
        self.check_own_strains(index, step)?;
        for (group, directions) in &step.fix {
            if directions.is_empty() {
                let path = ["steps", index, "fix", group];
                return Err(self.source.error_at(
                    &path,
                    "no direction",
                    "give [\"x\"], [\"y\"] or [\"x\", \"y\"]",
                ));
            }
        }
        for (group, displace) in &step.displace {
            if displace.components().next().is_none() {
                let path = ["steps", index, "displace", group];
                return Err(self.source.error_at(
                    &path,
                    "no direction",
                    "give {\"x\": …}, {\"y\": …} or both",
                ));
            }
        }
        for group in step.body_force.keys() {
            if split_group(group).1.is_some() {
                let path = ["steps", index, "body_force", group];
                return Err(self.source.error_at(
                    &path,
                    format!("\"{group}\" is not a subdomain"),
                    "name the subdomain alone",
                ));
            }
        }
        Ok(())
    }

    /// Supports, loads and initial stresses of absent parts are refused.
    fn check_stages(&self) -> Result<()> {
        let stages = self.stages()?;
        if stages.is_empty() {
            return Ok(());
        }
        for ((name, subdomain), there) in self.subdomains.iter().zip(self.there_at_first()?) {
            if subdomain.initial_stress.is_some() && !there {
                let what = format!("\"{name}\" is not there before it is activated, free of stress");
                return Err(self.source.error_at(
                    &["subdomains", name, "initial_stress"],
                    what,
                    "leave it out",
                ));
            }
        }
        for (number, (step, stage)) in self.steps.iter().zip(&stages).enumerate() {
            for (key, groups) in [
                ("fix", step.fix.keys().collect::<Vec<_>>()),
                ("displace", step.displace.keys().collect()),
                ("hold", step.hold.keys().collect()),
                ("release", step.release.keys().collect()),
                ("load", step.load.keys().collect()),
                ("body_force", step.body_force.keys().collect()),
            ] {
                for group in groups {
                    let subdomain = split_group(group).0;
                    let index = self.subdomains.get_index_of(subdomain);
                    if index.is_some_and(|b| !stage.present[b]) {
                        let what = format!("\"{subdomain}\" is not there in this step");
                        let help =
                            "activate it before, or leave the key out: what is in force comes back with it";
                        return Err(self.source.error_at(
                            &["steps", &number.to_string(), key, group],
                            what,
                            help,
                        ));
                    }
                }
            }
        }
        Ok(())
    }

    /// Temperature and strain act on subdomains; temperature on an expansion.
    fn check_own_strains(&self, index: &str, step: &Step) -> Result<()> {
        let temperatures = step.temperature.iter().map(|(name, value)| ("temperature", name, value));
        let strains =
            step.strain.iter().flat_map(|(name, values)| values.iter().map(move |v| ("strain", name, v)));
        for (key, name, value) in temperatures.chain(strains) {
            let path = ["steps", index, key, name.as_str()];
            let Some(subdomain) = self.subdomains.get(name) else {
                let help = name_help(name, self.subdomains.keys().map(String::as_str));
                return Err(self.source.error_at(&path, format!("no subdomain \"{name}\""), help));
            };
            for variable in Variable::ALL.into_iter().filter(|of| !Variable::OF_PLACES.contains(of)) {
                if value.uses(variable) {
                    let what = format!("{} in {value}", variable.name());
                    let help = "write it in x and y: it is ramped to its value at the end of the step";
                    return Err(self.source.error_at(&path, what, help));
                }
            }
            let material = &subdomain.material;
            if key == "temperature" && self.materials.get(material).is_some_and(|own| own.expansion == 0.0) {
                let what = format!("temperature acts on no expansion: materials.{material}.expansion is 0");
                return Err(self.source.error_at(&path, what, "give the material an \"expansion\""));
            }
        }
        Ok(())
    }

    /// Gravity acts on a density.
    fn check_gravity(&self, index: &str, step: &Step) -> Result<()> {
        let Some(gravity) = &step.gravity else { return Ok(()) };
        if let Gravity::Parts(parts) = gravity
            && let Some(name) = parts.keys().find(|name| !self.subdomains.contains_key(*name))
        {
            let help = name_help(name, self.subdomains.keys().map(String::as_str));
            let path = ["steps", index, "gravity", name];
            return Err(self.source.error_at(&path, format!("no subdomain \"{name}\""), help));
        }
        let pulled = self.subdomains.iter().filter(|(name, _)| gravity.of(name).is_some());
        let mut names: Vec<&str> = pulled.map(|(_, part)| part.material.as_str()).collect();
        if gravity.all().iter().flat_map(|(_, values)| *values).all(|value| value.constant() == Some(0.0))
            || names.iter().any(|name| self.materials[*name].density != 0.0)
        {
            return Ok(());
        }
        names.sort_unstable();
        names.dedup();
        let keys: Vec<String> = names.iter().map(|name| format!("materials.{name}.density")).collect();
        let verb = if keys.len() == 1 { "is" } else { "are" };
        let what = format!("gravity acts on no density: {} {verb} 0", keys.join(" and "));
        let help = "give a material of a subdomain a density, or take a \"body_force\"";
        Err(self.source.error_at(&["steps", index, "gravity"], what, help))
    }
}
