//! Measures taken from a run while it goes: the columns of its history, and norms at its end.
//!
//! ```text
//!   error of a field = √(∫ |field − exact|² / ∫ |exact|²)      interfaces: Σ over law points, bodies: Σ over cells
//! ```

use indexmap::IndexMap;

use super::file::{Field, Measure};
use super::summit::Summit;
use crate::assembly::Model;
use crate::history::{ModelState, Totals};
use crate::law::{Local, N, T};
use crate::output::HistoryRow;
use crate::problem::{Problem, stiffness_number};
use crate::scene::{FormulaPlace, Value};
use crate::shape::vector::in_plane;
use crate::shape::{determinant, jacobian};

/// Takes the measures of one run.
#[derive(Debug)]
pub(super) struct Gauge<'a> {
    measures: &'a IndexMap<String, Measure>,
    /// Values so far, with the magnitude of the peak where there is one.
    taken: Vec<(f64, f64)>,
    /// Rows around the peaks of others.
    summits: Vec<Summit>,
    /// Sizes and counts up to the last increment.
    pub(super) counts: IndexMap<&'static str, f64>,
    /// Way in which the equations are solved.
    pub(super) method: &'static str,
}

impl<'a> Gauge<'a> {
    pub(super) fn new(measures: &'a IndexMap<String, Measure>) -> Gauge<'a> {
        let taken = vec![(f64::NAN, -1.0); measures.len()];
        let summits = vec![Summit::default(); measures.len()];
        Gauge { measures, taken, summits, counts: IndexMap::new(), method: "" }
    }

    /// Looks at an increment.
    pub(super) fn look(&mut self, row: &HistoryRow, totals: &Totals, problem: &Problem, state: &ModelState) {
        for (((name, measure), taken), summit) in
            self.measures.iter().zip(&mut self.taken).zip(&mut self.summits)
        {
            let column = |of: &str| value(row, problem, name, of);
            match measure {
                Measure::Last { of, .. } => taken.0 = column(of),
                Measure::Peak { of, .. } => {
                    let now = column(of);
                    if now.abs() > taken.1 {
                        *taken = (now, now.abs());
                    }
                }
                Measure::AtPeak { of, peak_of, .. } => {
                    summit.take(column(of), column(peak_of));
                    taken.0 = summit.place();
                }
                Measure::Reached { .. } => taken.0 = row.load_factor,
                // the displacements of an increment whose fields are not stored may be missing; the last has them
                Measure::Error { field, of, exact } => taken.0 = error(problem, state, *field, of, exact),
            }
        }
        let model = &problem.model;
        let stiffness = model.interfaces.iter().zip(&problem.interfaces);
        let stiffness = stiffness.map(|(interface, bound)| stiffness_number(model, interface, &bound.laws));
        self.method = totals.method.name();
        self.counts = IndexMap::from([
            ("nodes", model.nodes() as f64),
            ("dofs", model.dofs() as f64),
            ("stiffness_number", stiffness.fold(0.0, f64::max)),
            ("increments", totals.increments as f64),
            ("iterations", totals.iterations as f64),
            ("parts", totals.parts as f64),
            ("rejected", totals.rejected as f64),
            ("factorisations", totals.factorisations as f64),
            ("factor_entries", totals.factor_entries as f64),
            ("reached", row.load_factor),
        ]);
    }

    /// True if the load factor at the end is measured: then an end without equilibrium is a limit.
    pub(super) fn seeks_limit(&self) -> bool {
        self.measures.values().any(|measure| matches!(measure, Measure::Reached { .. }))
    }

    /// The measures by name; what could not be taken is not a number.
    pub(super) fn values(&self) -> IndexMap<String, f64> {
        self.measures.keys().cloned().zip(self.taken.iter().map(|(value, _)| *value)).collect()
    }
}

/// The column of the history that a probe of a measure has: that of the scene, or one made for it.
pub(super) fn column_of(measure: &str, of: &str) -> String {
    format!("study:{measure}:{of}")
}

fn value(row: &HistoryRow, problem: &Problem, measure: &str, of: &str) -> f64 {
    let made = column_of(measure, of);
    let found = problem.columns().iter().position(|name| *name == of || *name == made);
    found.and_then(|i| row.values.get(i)).copied().unwrap_or(f64::NAN)
}

fn error(problem: &Problem, state: &ModelState, field: Field, of: &str, exact: &[Value; 2]) -> f64 {
    let model = &problem.model;
    let sums = match field {
        Field::Displacement => displacement(model, &state.snapshot.u, of, exact),
        Field::Traction => on_interface(model, &state.snapshot.tractions, of, exact),
        Field::Jump => on_interface(model, &state.snapshot.jumps, of, exact),
    };
    let Some([misfit, size]) = sums else { return f64::NAN };
    if misfit == 0.0 { 0.0 } else { (misfit / size).sqrt() }
}

/// Σ w |field − exact|² and Σ w |exact|² over the law points of an interface.
fn on_interface(model: &Model, fields: &[Vec<Local>], of: &str, exact: &[Value; 2]) -> Option<[f64; 2]> {
    let k = model.interfaces.iter().position(|interface| interface.name == of)?;
    let coupling = &model.interfaces[k].coupling;
    let mut sums = [0.0; 2];
    for (point, field) in coupling.points.iter().zip(fields.get(k)?) {
        let [x, y, z] = point.position;
        let place = FormulaPlace {
            x,
            y,
            z,
            s: point.s / coupling.midplane.length,
            load_factor: 1.0,
            ..FormulaPlace::default()
        };
        add(&mut sums, point.weight, [field[N], field[T]], exact, &place);
    }
    Some(sums)
}

/// ∫ |u − exact|² and ∫ |exact|² over a body.
fn displacement(model: &Model, u: &[f64], of: &str, exact: &[Value; 2]) -> Option<[f64; 2]> {
    let b = model.subdomains.iter().position(|subdomain| subdomain.name == of)?;
    let (mesh, u) = (&model.subdomains[b].mesh, u.get(model.dofs_of(b))?);
    let mut sums = [0.0; 2];
    for (c, &shape) in mesh.cells.shapes.iter().enumerate() {
        let nodes = mesh.cells.nodes(c);
        for &[xi, eta, weight] in shape.field_rule() {
            let values = shape.values(xi, eta);
            let (mut place, mut moved) = ([0.0; 2], [0.0; 2]);
            for (i, &node) in nodes.iter().enumerate() {
                for d in 0..2 {
                    place[d] += values.n[i] * mesh.points[node][d];
                    moved[d] += values.n[i] * u[model.components * node + d];
                }
            }
            let x: Vec<[f64; 2]> = nodes.iter().map(|&node| in_plane(mesh.points[node])).collect();
            let area = weight * determinant(&jacobian(&values, &x));
            let place = FormulaPlace {
                x: place[0],
                y: place[1],
                z: 0.0,
                s: 0.0,
                load_factor: 1.0,
                ..FormulaPlace::default()
            };
            add(&mut sums, area, moved, exact, &place);
        }
    }
    Some(sums)
}

fn add(sums: &mut [f64; 2], weight: f64, field: [f64; 2], exact: &[Value; 2], place: &FormulaPlace) {
    for d in 0..2 {
        let exact = exact[d].at(place);
        sums[0] += weight * (field[d] - exact).powi(2);
        sums[1] += weight * exact.powi(2);
    }
}
