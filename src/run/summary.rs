//! summary.json: sizes, where the time went, how good the solution is.

use std::collections::BTreeMap;

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::assembly::Model;
use crate::history::{Clock, Operations, Resultant, Snap, Totals, memory, resultant};
use crate::law::LawVariable;
use crate::problem::{Problem, Survey};
use crate::scene::Scene;
use crate::shape::Ends;

/// The file.
#[derive(Debug, Serialize)]
pub(super) struct Summary<'a> {
    program: &'static str,
    version: &'static str,
    scene: &'a str,
    title: &'a str,
    sizes: Sizes<'a>,
    /// Variables of the laws: what interface arrays hold beside jump, traction and status.
    variables: Vec<&'static LawVariable>,
    solution: SolutionSummary,
    /// Increments after which the run was interrupted and gone on with.
    resumed: &'a [usize],
    /// Why the run ended before its last increment; null if it did not.
    stopped: Option<String>,
    equilibrium: Balance,
    /// Seconds by stage, since the run was gone on with last.
    time: IndexMap<&'static str, f64>,
    peak_memory_bytes: Option<u64>,
    /// `W04 interface interface: why; help`.
    warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Sizes<'a> {
    nodes: usize,
    dofs: usize,
    subdomains: IndexMap<&'a str, SubdomainSize>,
    interfaces: IndexMap<&'a str, InterfaceSize<'a>>,
}

#[derive(Debug, Serialize)]
struct SubdomainSize {
    nodes: usize,
    cells: BTreeMap<&'static str, usize>,
}

#[derive(Debug, Serialize)]
struct InterfaceSize<'a> {
    /// Subdomains of sides A and B.
    subdomains: [&'a str; 2],
    edges_a: usize,
    edges_b: usize,
    segments: usize,
    grid_nodes: usize,
    law_points: usize,
    length: f64,
    gap: Ends,
    stiffness_number: f64,
}

#[derive(Debug, Serialize)]
struct SolutionSummary {
    increments: usize,
    /// Rows of history.csv, that of the unloaded state among them, and states whose fields are stored.
    rows: usize,
    fields: usize,
    iterations: usize,
    /// Parts in which the increments were found.
    parts: usize,
    /// Parts that were sought and not kept.
    rejected: usize,
    factorisations: usize,
    /// Turning points of the path of equilibria: after which increment, in which step, at which load factor.
    turns: Vec<(usize, String, f64)>,
    /// Snaps to another branch of equilibria.
    snaps: Vec<Snap>,
    /// Energy released by them [force × length].
    released: f64,
    /// Work of the viscosity of laws, part of what is dissipated [force × length].
    viscous: f64,
    /// "joined", "in parts", "condensed", "blocks" or "plain".
    strategy: &'static str,
    /// Multiplications and additions of both forms, estimated; none where there is no choice.
    operations: Option<Operations>,
    /// Bodies that are like no earlier one, up to a motion, where every one is condensed.
    distinct_subdomains: Option<usize>,
    factor_entries: usize,
    /// Largest residual of all increments: the componentwise backward error max |r| / (|A| |u| + |f|) of a linear scene that
    /// is solved for displacements, the out-of-balance force relative to the forces in the model of any other.
    residual: f64,
    /// Largest |work − stored − dissipated − released| over the largest of them.
    energy_balance: f64,
}

/// Applied loads against reactions at the last increment.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Balance {
    #[serde(flatten)]
    whole: Resultants,
    /// |load + reaction| over the sum of all nodal loads and reactions, by magnitude.
    imbalance: f64,
    /// The same by subdomain; what is left there crosses its interfaces.
    subdomains: IndexMap<String, Resultants>,
}

/// Resultants by direction [force], and their moments about z.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Resultants {
    load: Vec<f64>,
    reaction: Vec<f64>,
    /// Moment of loads, and of reactions [force × length].
    moment: [f64; 2],
}

impl<'a> InterfaceSize<'a> {
    fn new(subdomains: [&'a str; 2], survey: Survey) -> InterfaceSize<'a> {
        let Survey { facets: [edges_a, edges_b], segments, grid_nodes, law_points, length, .. } = survey;
        let Survey { gap, stiffness_number, .. } = survey;
        InterfaceSize {
            subdomains,
            edges_a,
            edges_b,
            segments,
            grid_nodes,
            law_points,
            length,
            gap,
            stiffness_number,
        }
    }
}

/// Sums loads and reactions.
pub(super) fn balance(model: &Model, force: &[f64], reactions: &[f64]) -> Balance {
    let sum = |values: &[f64]| -> Vec<f64> {
        let along = |d: usize| values.iter().skip(d).step_by(model.components).sum();
        (0..model.components).map(along).collect()
    };
    let forces: Vec<(String, Resultants)> = (model.subdomains.iter().enumerate())
        .map(|(b, subdomain)| {
            let dofs = model.dofs_of(b);
            let (force, reactions) = (&force[dofs.clone()], &reactions[dofs]);
            let moment = |values: &[f64]| {
                let of = |(x, f): (&[f64; 3], &[f64])| x[0] * f[1] - x[1] * f[0];
                subdomain.mesh.points.iter().zip(values.chunks_exact(model.components)).map(of).sum::<f64>()
            };
            let moment = [moment(force), moment(reactions)];
            (subdomain.name.clone(), Resultants { load: sum(force), reaction: sum(reactions), moment })
        })
        .collect();
    let moments = [0, 1].map(|k| forces.iter().map(|(_, own)| own.moment[k]).sum());
    let whole = Resultants { load: sum(force), reaction: sum(reactions), moment: moments };
    let Resultant { rest, scale } = resultant(model, force, reactions);
    let imbalance = if scale > 0.0 { rest / scale } else { 0.0 };
    Balance { whole, imbalance, subdomains: forces.into_iter().collect() }
}

/// Gathers the summary.
pub(super) fn summary<'a>(
    scene: &'a Scene,
    name: &'a str,
    problem: &'a Problem,
    (totals, [rows, fields], resumed): (&Totals, [usize; 2], &'a [usize]),
    equilibrium: Balance,
    clock: &Clock,
    stopped: Option<String>,
) -> Summary<'a> {
    let model = &problem.model;
    let subdomains = model.subdomains.iter().map(|subdomain| {
        let mut cells = BTreeMap::new();
        for shape in &subdomain.mesh.cells.shapes {
            *cells.entry(shape.label()).or_insert(0) += 1;
        }
        (subdomain.name.as_str(), SubdomainSize { nodes: subdomain.mesh.points.len(), cells })
    });
    let interfaces = model.interfaces.iter().zip(&problem.interfaces).map(|(interface, bound)| {
        let sides = interface.subdomains.map(|b| model.subdomains[b].name.as_str());
        (interface.name.as_str(), InterfaceSize::new(sides, Survey::of(model, interface, &bound.laws)))
    });
    let told = totals.warnings(problem.solution.path_tolerance);
    let mut time: IndexMap<&'static str, f64> = clock.stages().iter().copied().collect();
    time.insert("total", clock.total());
    Summary {
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        scene: name,
        title: &scene.title,
        sizes: Sizes {
            nodes: model.nodes(),
            dofs: model.dofs(),
            subdomains: subdomains.collect(),
            interfaces: interfaces.collect(),
        },
        variables: problem.variables().collect(),
        solution: SolutionSummary {
            increments: totals.increments,
            rows,
            fields,
            iterations: totals.iterations,
            parts: totals.parts,
            rejected: totals.rejected,
            turns: totals.turns.clone(),
            snaps: totals.snaps.clone(),
            released: totals.released,
            viscous: totals.viscous,
            factorisations: totals.factorisations,
            strategy: totals.method.name(),
            operations: totals.operations,
            distinct_subdomains: totals.distinct,
            factor_entries: totals.factor_entries,
            residual: totals.residual,
            energy_balance: totals.energy_balance,
        },
        resumed,
        stopped,
        equilibrium,
        time,
        peak_memory_bytes: memory::peak(),
        warnings: problem.warnings.iter().chain(&told).map(ToString::to_string).collect(),
    }
}
