//! The tables of `midplane check`: bodies, interfaces, what is held.

use super::show::Show;
use crate::problem::{Problem, Survey, unused_groups};
use crate::run::Prepared;

/// Prints what there is, short of solving it.
pub(super) fn print(show: &Show, prepared: &Prepared) {
    show.finish();
    let problem = &prepared.problem;
    let model = &problem.model;
    let names = model
        .subdomains
        .iter()
        .map(|subdomain| &subdomain.name)
        .chain(model.interfaces.iter().map(|interface| &interface.name));
    let width = names.map(|name| name.chars().count()).max().unwrap_or(0).max(12);
    show.line(&format!("{:<width$} {:>9} {:>9}  shapes", "subdomain", "nodes", "cells"));
    for subdomain in &model.subdomains {
        let mut shapes: Vec<&str> = subdomain.mesh.cells.shapes.iter().map(|shape| shape.label()).collect();
        shapes.sort_unstable();
        shapes.dedup();
        let (nodes, cells) = (subdomain.mesh.points.len(), subdomain.mesh.cells.len());
        show.line(&format!("{:<width$} {nodes:>9} {cells:>9}  {}", subdomain.name, shapes.join(" ")));
    }
    if !model.interfaces.is_empty() {
        show.line(&format!(
            "{:<width$} {:>11} {:>6} {:>8} {:>6} {:>11} {:>9} {:>9} {:>7} {:>9}",
            "interface",
            "edges A:B",
            "ratio",
            "segments",
            "grid",
            "length",
            "gap min",
            "gap max",
            "kink",
            "K_N h/E"
        ));
    }
    for (interface, bound) in model.interfaces.iter().zip(&problem.interfaces) {
        let survey = Survey::of(model, interface, &bound.laws);
        let [a, b] = survey.edges;
        show.line(&format!(
            "{:<width$} {:>11} {:>6.2} {:>8} {:>6} {:>11.6} {:>9.1e} {:>9.1e} {:>6.1}° {:>9.2e}",
            interface.name,
            format!("{a}:{b}"),
            survey.ratio(),
            survey.segments,
            survey.grid_nodes,
            survey.length,
            survey.gap[0],
            survey.gap[1],
            survey.kink,
            survey.stiffness_number
        ));
    }
    if !model.interfaces.is_empty() {
        show.line(&format!("{:<width$} {:<30} {:<30} A, B", "ends of", "@0", "@1"));
    }
    for (interface, bound) in model.interfaces.iter().zip(&problem.interfaces) {
        let [start, end] =
            Survey::of(model, interface, &bound.laws).ends.map(|[x, y, _]| format!("({x:.4}, {y:.4})"));
        let [a, b] = interface.subdomains.map(|b| model.subdomains[b].name.as_str());
        show.line(&format!("{:<width$} {start:<30} {end:<30} {a}, {b}", interface.name));
    }
    flow(show, problem, width);
    let constrained = problem
        .steps
        .first()
        .map_or(0, |step| step.constrained.iter().filter(|&&constrained| constrained).count());
    show.line(&format!("{} dofs, {constrained} held in the first step", model.dofs()));
    for warning in unused_groups(&prepared.scene, model) {
        show.warning(&warning);
    }
}

/// Prints where water flows, step by step where that changes.
fn flow(show: &Show, problem: &Problem, width: usize) {
    let mut told = Vec::new();
    for step in &problem.steps {
        let lines = step.water.as_ref().map_or_else(Vec::new, |water| water.lines(&problem.model));
        if lines == told {
            continue;
        }
        show.line(&format!(
            "{:<width$} {:<30} {:<30} between, step \"{}\"",
            "flow along", "@0", "@1", step.name
        ));
        for along in &lines {
            let end = |end: usize| {
                let [x, y, _] = along.ends[end];
                format!("{} at ({x:.4}, {y:.4})", along.conditions[end])
            };
            show.line(&format!(
                "{:<width$} {:<30} {:<30} {}",
                along.interface,
                end(0),
                end(1),
                along.between
            ));
        }
        told = lines;
    }
}
