//! Bodies and interfaces as VTU grids.

use super::vtu::{Array, VtuGrid};
use super::{RowData, Snapshot};
use crate::assembly::{BoundSubdomain, InterfaceOperator, Model};
use crate::continuum::{principal, von_mises};
use crate::coupling::Piece;
use crate::law::{self, LawVariable, Local, N, State};
use crate::problem::PointLaws;

/// Names of the components of stresses and strains, of principal stresses, and of vectors along an interface.
const TENSOR: &[&str] = &["xx", "yy", "zz", "xy", "yz", "xz"];
const PRINCIPAL: &[&str] = &["s1", "s2", "szz"];
const LOCAL: &[&str] = &["n", "t", "s"];

/// A body: displacement, stress and von Mises' at points and cells, principal stress.
pub(super) fn subdomain(model: &Model, index: usize, snapshot: &Snapshot, row: &RowData) -> VtuGrid {
    let subdomain = &model.subdomains[index];
    let u = &snapshot.u[model.dofs_of(index)];
    let stresses = &snapshot.stresses[index];
    let full = |s: &[f64; 4]| [s[0], s[1], s[2], s[3], 0.0, 0.0]; // xx yy zz xy yz xz
    let mut grid = mesh(subdomain);
    grid.field_data = field_data(row);
    grid.point_data = vec![
        Array::float(
            "displacement",
            3,
            u.chunks_exact(model.components).flat_map(|u| <[f64; 3]>::from(law::local(u))),
        ),
        Array::labelled("stress", TENSOR, stresses.nodes.iter().flat_map(full)),
        Array::float("von_mises", 1, stresses.nodes.iter().map(|&s| von_mises(s))),
    ];
    if let Some(temperatures) = &stresses.temperatures {
        grid.point_data.push(Array::float("temperature", 1, temperatures.iter().copied()));
    }
    grid.cell_data = vec![
        Array::labelled("stress", TENSOR, stresses.cells.iter().flat_map(full)),
        Array::float("von_mises", 1, stresses.cells.iter().map(|&s| von_mises(s))),
        Array::labelled("principal_stress", PRINCIPAL, stresses.cells.iter().flat_map(|&s| principal(s))),
    ];
    if let Some(is_there) = snapshot.presence.parts.get(index) {
        let cells = subdomain.mesh.cells.len();
        grid.cell_data.push(Array::int("present", std::iter::repeat_n(i64::from(*is_there), cells)));
    }
    if let Some(strains) = &stresses.strains {
        grid.cell_data.push(Array::labelled("own_strain", TENSOR, strains.iter().flat_map(full)));
    }
    grid
}

/// Time, step, load factor and energies of a row.
fn field_data(row: &RowData) -> Vec<Array> {
    let names = ["energy_stored", "energy_dissipated", "energy_released", "work_external"];
    let mut all = vec![
        Array::float("TimeValue", 1, [row.row as f64]),
        Array::int("step", [row.step as i64]),
        Array::float("load_factor", 1, [row.load_factor]),
    ];
    all.extend(names.into_iter().zip(row.energies).map(|(name, energy)| Array::float(name, 1, [energy])));
    all
}

pub(super) fn mesh(subdomain: &BoundSubdomain) -> VtuGrid {
    let cells = &subdomain.mesh.cells;
    VtuGrid {
        points: subdomain.mesh.points.as_flattened().to_vec(),
        connectivity: cells.nodes.iter().map(|&node| node as i64).collect(),
        offsets: cells.offsets[1..].iter().map(|&end| end as i64).collect(),
        types: cells.shapes.iter().map(|shape| shape.vtk()).collect(),
        ..VtuGrid::default()
    }
}

/// The law points of an interface in order along C, joined by lines; `variables`: of which laws there are arrays. `water`: there are
/// pressures, and flow.
pub(super) fn interface(
    interface: &InterfaceOperator,
    (laws, variables): (&PointLaws, &[&LawVariable]),
    [pressure, flow]: [bool; 2],
    index: usize,
    snapshot: &Snapshot,
    row: &RowData,
) -> VtuGrid {
    let points = &interface.coupling.points;
    let n = points.len();
    // no line from one part of C to another that lies elsewhere
    let apart = |piece: &&Piece| !piece.follows && piece.segments.start > 0;
    let segments = &interface.coupling.midplane.segments;
    let breaks: Vec<f64> = interface
        .coupling
        .midplane
        .pieces
        .iter()
        .filter(apart)
        .map(|p| segments[p.segments.start].s[0])
        .collect();
    let of = |s: f64| breaks.partition_point(|start| *start <= s);
    let lines: Vec<i64> =
        (1..n).filter(|&i| of(points[i - 1].s) == of(points[i].s)).map(|i| i as i64).collect();
    let is_absent = snapshot.presence.is_absent(index);
    let none = vec![State::default(); n];
    let states = Some(&snapshot.states[index]).filter(|states| !states.is_empty()).unwrap_or(&none);
    let plastic: Vec<Local> = states.iter().map(|state| state.jump_plastic).collect();
    let local = |name, vectors: &[Local]| {
        let components = interface.coupling.components;
        let values = vectors.iter().flat_map(|v| v.iter().take(components).copied());
        Array::labelled(name, &LOCAL[..components], values)
    };
    let own = variables.iter().map(|variable| {
        Array::float(
            variable.name,
            1,
            states.iter().enumerate().map(|(p, state)| laws.at(p).value(variable, state)),
        )
    });
    let [a, b] = [0, 1].map(|side| -> Vec<[f64; 3]> {
        points.iter().map(|point| interface.coupling.displacement(side, point, &snapshot.u)).collect()
    });
    let middle = a.iter().zip(&b).flat_map(|(a, b)| [0, 1, 2].map(|d| 0.5 * (a[d] + b[d])));
    let mut point_data = vec![
        Array::float("displacement", 3, middle),
        Array::float("displacement_a", 3, a.iter().flatten().copied()),
        Array::float("displacement_b", 3, b.iter().flatten().copied()),
        local("jump", &snapshot.jumps[index]),
        local("jump_plastic", &plastic),
        local("traction", &snapshot.tractions[index]),
    ];
    let (water, none) = (&snapshot.water, vec![0.0; n]);
    let values = |of: &[Vec<f64>]| of.get(index).filter(|own| !own.is_empty()).unwrap_or(&none).clone();
    if pressure {
        let pressures = values(&water.pressures);
        let mut total = snapshot.tractions[index].clone();
        total.iter_mut().zip(&pressures).for_each(|(traction, pressure)| traction[N] -= pressure);
        point_data.extend([local("traction_total", &total), Array::float("pressure", 1, pressures)]);
    }
    if flow {
        let rates = Array::float("rate", 1, values(&water.rates));
        point_data.extend([rates, Array::float("hydraulic_aperture", 1, values(&water.apertures))]);
    }
    point_data.extend(own);
    point_data.extend([
        Array::int("status", states.iter().map(|state| if is_absent { -1 } else { i64::from(state.status) })),
        Array::int(
            "condition",
            states.iter().enumerate().map(
                |(p, state)| {
                    if is_absent { -1 } else { laws.at(p).condition(state) as i64 }
                },
            ),
        ),
        Array::float("length", 1, points.iter().map(|p| p.weight)),
        Array::float("normal", 3, points.iter().flat_map(|p| p.rotation[0])),
    ]);
    VtuGrid {
        points: points.iter().flat_map(|p| p.position).collect(),
        connectivity: lines.iter().flat_map(|&i| [i - 1, i]).collect(),
        offsets: (1..=lines.len() as i64).map(|i| 2 * i).collect(),
        types: vec![3; lines.len()],
        point_data,
        field_data: field_data(row),
        ..VtuGrid::default()
    }
}

/// The geometry of an interface, to look at: segments (`kind` 0) and grid cells (`kind` 1) as lines on C, with their parent
/// edges on both chains (−1 for grid cells) and the arc length at every point.
pub(super) fn midplane(interface: &InterfaceOperator) -> VtuGrid {
    let midplane = &interface.coupling.midplane;
    let segments = midplane.segments.iter().map(|g| (g.s, g.places, 0, g.facets.map(|facet| facet as i64)));
    let cells = midplane.cells.iter().map(|cell| (cell.s, cell.places, 1, [-1; 2]));
    let lines: Vec<_> = segments.chain(cells).collect();
    let ends: Vec<f64> = lines.iter().flat_map(|line| line.0).collect();
    let n = lines.len() as i64;
    VtuGrid {
        points: lines.iter().flat_map(|line| line.1).flatten().collect(),
        connectivity: (0..2 * n).collect(),
        offsets: (1..=n).map(|i| 2 * i).collect(),
        types: vec![3; lines.len()],
        point_data: vec![Array::float("arc_length", 1, ends)],
        cell_data: vec![
            Array::int("kind", lines.iter().map(|line| line.2)),
            Array::int("edge_a", lines.iter().map(|line| line.3[0])),
            Array::int("edge_b", lines.iter().map(|line| line.3[1])),
        ],
        ..VtuGrid::default()
    }
}
