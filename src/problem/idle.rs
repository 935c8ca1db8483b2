//! Loads and keys that do nothing: told, for whoever wrote them meant something by them.

use std::collections::HashSet;

use super::curve::PlannedInterface;
use super::history::given;
use super::pressure_names::depends_on_jumps;
use super::{BoundInterface, pressures};
use crate::assembly::Model;
use crate::error::{Code, Result, Warning};
use crate::mesh::Facet;
use crate::scene::{Control, Grid, Scene, Solution};

/// Warnings of loads that are zero wherever and whenever they act. One that ends a load of an earlier step is none.
pub(super) fn loads(scene: &Scene, model: &Model, interfaces: &[BoundInterface]) -> Result<Vec<Warning>> {
    let mut warnings = Vec::new();
    let mut acting: HashSet<(&str, String)> = HashSet::new();
    for (number, step) in scene.steps.iter().enumerate() {
        let index = number.to_string();
        // gravity is one load, whatever number of subdomains it acts on
        let name = |key: &str, group: &str| if key == "gravity" { String::new() } else { group.to_string() };
        let mut zero: Vec<(&str, String)> = Vec::new();
        let mut here: HashSet<(&str, String)> = HashSet::new();
        let stated = pressures::stated(scene, model, interfaces, &index, step)?;
        for ((key, group), load) in &given(scene, model, interfaces, (&index, step), &stated)? {
            let load_of = (*key, name(key, group));
            if load.is_zero(model, step.increments)? {
                zero.push(load_of);
            } else {
                here.insert(load_of);
            }
        }
        zero.dedup();
        for load in zero.into_iter().filter(|load| !here.contains(load) && !acting.contains(load)) {
            let path: Vec<&str> =
                ["steps", &index, load.0, &load.1].into_iter().filter(|part| !part.is_empty()).collect();
            let what = format!("{}: this load is zero everywhere", scene.source.at(&path));
            let help = "give it a value, look at its formula, or leave it out";
            warnings.push(Warning::new(Code::NoLoad, what, help));
        }
        acting.extend(here);
    }
    Ok(warnings)
}

/// Warnings of keys that the scene cannot use.
pub(super) fn keys(scene: &Scene, plans: &[PlannedInterface]) -> Vec<Warning> {
    let mut told: Vec<(Vec<String>, String, &str)> = Vec::new();
    let mut tell = |path: &[&str], why: String, help| {
        told.push((path.iter().map(|part| part.to_string()).collect(), why, help));
    };
    for (name, stated) in &scene.interfaces {
        let linear = |edge: &Facet| !edge.shape.is_quadratic();
        let mut own = plans.iter().filter(|plan| plan.entry == name).peekable();
        let quadratic_grid = stated.grid == Grid::Quadratic && own.peek().is_some();
        let has_linear =
            |plan: &PlannedInterface| plan.sides.iter().flatten().any(|curve| curve.edges.iter().any(linear));
        if quadratic_grid && own.all(has_linear) {
            let help = "mesh both sides with Mesh.ElementOrder = 2, or leave the key out";
            tell(
                &["interfaces", name, "grid"],
                "a side with linear edges makes the grid linear".into(),
                help,
            );
        }
        let path = ["interfaces", name, "law_tolerance"];
        // a preset sets it for every law
        let chosen = stated.law_tolerance != crate::law::LAW_TOLERANCE && scene.accuracy.is_none();
        if !stated.law.kind().is_integrated() && (chosen || scene.source.states(&path)) {
            let why = "this law is evaluated exactly and has no error to control";
            tell(&path, why.into(), "leave it out: only \"cracking\" is integrated");
        }
    }
    let coupled = |plan: &PlannedInterface| depends_on_jumps(scene, &plan.name);
    if scene.interfaces.values().all(|stated| stated.law.kind().is_linear()) && !plans.iter().any(coupled) {
        let linear = "nothing slides or cracks: the scene is linear";
        for (i, step) in scene.steps.iter().enumerate() {
            if step.control != Control::Load {
                tell(&["steps", &i.to_string(), "control"], linear.into(), "leave it out");
            }
        }
        let (own, usual) = (&scene.solution, Solution::default());
        let chosen = [
            ("tolerance", own.tolerance != usual.tolerance && scene.accuracy.is_none()),
            ("iterations", own.iterations != usual.iterations),
            ("path_tolerance", own.path_tolerance != usual.path_tolerance && scene.accuracy.is_none()),
            ("tangent", own.tangent != usual.tangent),
        ];
        for (key, chosen) in chosen {
            if chosen || scene.source.states(&["solution", key]) {
                tell(&["solution", key], linear.into(), "leave it out: nothing is iterated");
            }
        }
    }
    let warning = |(path, why, help): (Vec<String>, String, &str)| {
        Warning::new(Code::IdleKey, format!("{} does nothing: {why}", scene.source.at(&path)), help)
    };
    told.into_iter().map(warning).collect()
}
