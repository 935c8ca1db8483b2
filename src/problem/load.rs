//! A load bound to what it acts on: nodal forces at any load factor.

use std::collections::HashMap;

use super::point_laws::place;
use super::quantity::Quantity;
use super::{along, groups};
use crate::assembly::Model;
use crate::continuum::{cell_coordinates, cell_field_force, cell_weights, edge_field_force, edge_force};
use crate::error::{Error, Result};
use crate::mesh::{Facet, Mesh};
use crate::scene::{FormulaPlace, Load, Pressure, Scene, Value, Variable};
use crate::shape::Ends;
use crate::shape::vector::{in_plane, plus};

/// A load in force.
#[derive(Debug, Clone)]
pub(super) struct BoundLoad {
    target: LoadTarget,
    /// Components x, y; a pressure is the first.
    values: [Quantity; 2],
}

/// Target of a load.
#[derive(Debug, Clone)]
enum LoadTarget {
    /// Edges of a body; s at the ends of every edge if a formula asks for it.
    Edges { subdomain: usize, edges: Vec<Facet>, s: Option<Vec<Ends>>, pressure: bool },
    /// Points of a body, and the share of the force that each takes: copies of a point on an opened curve divide it.
    Points { subdomain: usize, points: Vec<(usize, f64)> },
    /// Law points of an interface, between whose sides there is a pressure.
    Interface { interface: usize, subdomains: [usize; 2] },
    /// A whole body: force per volume times a factor.
    BoundSubdomain { subdomain: usize, factor: f64 },
}

impl BoundLoad {
    /// Binds a load on a group, under its name or a pattern.
    pub(super) fn on_group(
        scene: &Scene,
        model: &Model,
        step: &str,
        (key, name): (&str, &str),
        load: &Load,
    ) -> Result<BoundLoad> {
        let path = ["steps", step, "load", key];
        let quantity = |kind: &str, index: Option<&str>, value: &Value| {
            let path: Vec<&str> = path.into_iter().chain([kind]).chain(index).collect();
            Quantity::new(scene, &path, value)
        };
        let both =
            |kind: &str, [x, y]: &[Value; 2]| [quantity(kind, Some("0"), x), quantity(kind, Some("1"), y)];
        let (values, pressure) = match load {
            Load::Traction(values) => (both("traction", values), false),
            Load::Pressure(Pressure::Imposed(value)) => {
                ([quantity("pressure", None, value), Quantity::number(0.0)], true)
            }
            // the scene's door refuses flow along anything but interfaces
            Load::Pressure(Pressure::Flow(_)) => ([Quantity::number(0.0), Quantity::number(0.0)], true),
            Load::Force(values) => {
                let (subdomain, points) = groups::points(scene, model, &path, name)?;
                let mesh = &model.subdomains[subdomain].mesh;
                let target = LoadTarget::Points { subdomain, points: shares(mesh, points) };
                return Ok(BoundLoad { target, values: both("force", values) });
            }
        };
        let (subdomain, edges) = groups::curve(scene, model, &path, name)?;
        if pressure && values[0].constant() != Some(0.0) && edges.iter().any(|edge| !edge.boundary) {
            let what = format!("\"{name}\" runs inside its body");
            let help = "a pressure acts on the boundary; give a \"traction\"";
            return Err(scene.source.error_at(&path, what, help));
        }
        let s = match values.iter().find(|value| value.uses(Variable::S)) {
            Some(value) => {
                let points = &model.subdomains[subdomain].mesh.points;
                Some(along::fractions(points, edges).map_err(|why| value.error_at_s(&why))?)
            }
            None => None,
        };
        Ok(BoundLoad { target: LoadTarget::Edges { subdomain, edges: edges.to_vec(), s, pressure }, values })
    }

    /// Binds a force per volume (times a factor) on a body; `path` is the key of its two components.
    pub(super) fn on_subdomain(
        scene: &Scene,
        path: &[&str],
        subdomain: usize,
        factor: f64,
        values: &[Value; 2],
    ) -> Result<BoundLoad> {
        let [x, y] = values;
        let quantity = |index: &str, value| Quantity::new(scene, &[path, &[index]].concat(), value);
        let values = [quantity("0", x), quantity("1", y)];
        match values.iter().find(|value| value.uses(Variable::S)) {
            Some(value) => Err(value.error_at_s("a body has no such coordinate")),
            None => Ok(BoundLoad { target: LoadTarget::BoundSubdomain { subdomain, factor }, values }),
        }
    }

    /// A pressure between the sides of an interface that does not depend on its jumps.
    pub(super) fn in_interface(model: &Model, interface: usize, pressure: Quantity) -> BoundLoad {
        let subdomains = model.interfaces[interface].subdomains;
        let target = LoadTarget::Interface { interface, subdomains };
        BoundLoad { target, values: [pressure, Quantity::number(0.0)] }
    }

    /// Numbers of the subdomains that it acts on.
    pub(super) fn subdomains(&self) -> &[usize] {
        match &self.target {
            LoadTarget::Edges { subdomain, .. }
            | LoadTarget::Points { subdomain, .. }
            | LoadTarget::BoundSubdomain { subdomain, .. } => std::slice::from_ref(subdomain),
            LoadTarget::Interface { subdomains, .. } => subdomains,
        }
    }

    /// True if load_factor occurs in it, so that it does not ramp.
    pub(super) fn follows_load_factor(&self) -> bool {
        self.values.iter().any(|value| value.uses(Variable::LoadFactor))
    }

    /// True if it is affine in load_factor.
    pub(super) fn is_affine(&self) -> bool {
        self.values.iter().all(Quantity::is_affine)
    }

    /// True if it has no nodal force at any of the load factors of a step.
    pub(super) fn is_zero(&self, model: &Model, increments: usize) -> Result<bool> {
        let both = self.values.each_ref().map(Quantity::constant);
        if let LoadTarget::BoundSubdomain { factor: 0.0, .. } = self.target {
            return Ok(true);
        }
        if let [Some(x), Some(y)] = both {
            return Ok(x == 0.0 && y == 0.0);
        }
        let load_factors = if self.follows_load_factor() { 1..=increments } else { increments..=increments };
        for load_factor in load_factors {
            let mut force = vec![0.0; model.dofs()];
            self.add(model, load_factor as f64 / increments as f64, &mut force)?;
            if force.iter().any(|force| *force != 0.0) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Adds its nodal forces at a load factor.
    pub(super) fn add(&self, model: &Model, load_factor: f64, force: &mut [f64]) -> Result<()> {
        let [x, y] = &self.values;
        let constant = match (x.constant(), y.constant()) {
            (Some(x), Some(y)) => Some([x, y]),
            _ => None,
        };
        let at = |place: [f64; 2], s: f64| -> Result<[f64; 2]> {
            let place =
                FormulaPlace { x: place[0], y: place[1], z: 0.0, s, load_factor, ..FormulaPlace::default() };
            Ok([x.at(&place)?, y.at(&place)?])
        };
        let mut scatter = |node: usize, nodal: [f64; 2]| {
            for (d, nodal) in nodal.into_iter().enumerate() {
                force[model.components * node + d] += nodal;
            }
        };
        match &self.target {
            LoadTarget::Edges { subdomain, edges, s, pressure } => {
                let subdomain = &model.subdomains[*subdomain];
                let split = |v: [f64; 2]| if *pressure { ([0.0; 2], v[0]) } else { (v, 0.0) };
                for (e, edge) in edges.iter().enumerate() {
                    let x = groups::edge_coordinates(&subdomain.mesh.points, edge);
                    let nodal = if let Some(constant) = constant {
                        let (traction, pressure) = split(constant);
                        edge_force(&x, edge.shape, traction, pressure, model.thickness)
                    } else {
                        let origin = in_plane(subdomain.mesh.points[edge.nodes()[0]]);
                        edge_field_force(&x, edge.shape, model.thickness, |xi, place| {
                            let s = s.as_ref().map_or(0.0, |s| along::at(s[e], &x, edge.shape, xi));
                            Ok::<_, Error>(split(at(plus(origin, place), s)?))
                        })?
                    };
                    for (node, nodal) in edge.nodes().iter().copied().zip(nodal) {
                        scatter(subdomain.first_node + node, nodal);
                    }
                }
            }
            LoadTarget::Points { subdomain, points } => {
                let subdomain = &model.subdomains[*subdomain];
                for &(point, share) in points {
                    let force = at(in_plane(subdomain.mesh.points[point]), 0.0)?;
                    scatter(subdomain.first_node + point, force.map(|f| share * f));
                }
            }
            LoadTarget::Interface { interface, .. } => {
                let operator = &model.interfaces[*interface];
                let mut tractions = vec![0.0; model.components * operator.coupling.points.len()];
                for (p, traction) in tractions.iter_mut().step_by(model.components).enumerate() {
                    *traction = x.at(&FormulaPlace { load_factor, ..place(operator, p) })?;
                }
                operator.add_force(&tractions, force);
            }
            LoadTarget::BoundSubdomain { subdomain, factor } => {
                let (subdomain, mesh) = (&model.subdomains[*subdomain], &model.subdomains[*subdomain].mesh);
                let factor = factor * model.thickness;
                if constant == Some([0.0; 2]) || factor == 0.0 {
                    return Ok(());
                }
                for c in 0..mesh.cells.len() {
                    let (shape, nodes) = (mesh.cells.shapes[c], mesh.cells.nodes(c));
                    let x = cell_coordinates(mesh, c);
                    if let Some(density) = constant {
                        for (&node, weight) in nodes.iter().zip(cell_weights(shape, &x)) {
                            scatter(
                                subdomain.first_node + node,
                                density.map(|density| factor * weight * density),
                            );
                        }
                    } else {
                        let origin = in_plane(mesh.points[nodes[0]]);
                        let nodal = cell_field_force(shape, &x, |place| at(plus(origin, place), 0.0))?;
                        for (&node, nodal) in nodes.iter().zip(nodal) {
                            scatter(subdomain.first_node + node, nodal.map(|nodal| factor * nodal));
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

/// Points with one over the number of those at the same place.
fn shares(mesh: &Mesh, points: &[usize]) -> Vec<(usize, f64)> {
    let place = |point: usize| mesh.points[point].map(f64::to_bits);
    let mut copies: HashMap<[u64; 3], usize> = HashMap::new();
    points.iter().for_each(|&point| *copies.entry(place(point)).or_default() += 1);
    points.iter().map(|&point| (point, 1.0 / copies[&place(point)] as f64)).collect()
}
