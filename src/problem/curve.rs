//! An interface to be: the curves of its sides, and how they become an interface.

use std::collections::HashMap;

use super::groups;
use crate::assembly::{InterfaceOperator, Model};
use crate::coupling::{Coupling, Gap, JumpScheme, Points, Scheme, Side, Surroundings};
use crate::error::Result;
use crate::mesh::Facet;
use crate::scene::{CouplingKind, Grid, Interface, OneOrMany, Quadrature, Scene};

/// An interface to be.
pub(super) struct PlannedInterface<'a> {
    /// Its name in results and probes.
    pub name: String,
    /// Its key in the scene's `interfaces`.
    pub entry: &'a str,
    /// Its statement in the scene.
    pub stated: &'a Interface,
    /// Curves of sides A and B.
    pub sides: [Vec<Curve>; 2],
}

/// All that decides how an interface is joined, and all that `PlannedInterface::join` may read of what the scene states.
#[derive(Debug, Clone, Copy)]
pub struct Joining<'a> {
    pub(super) sides: [&'a Option<OneOrMany>; 2],
    pub(super) between: &'a Option<[String; 2]>,
    pub(super) within: &'a Option<OneOrMany>,
    coupling: CouplingKind,
    grid: Grid,
    quadrature: Quadrature,
    gap: Gap,
}

impl<'a> Joining<'a> {
    pub(super) fn of(stated: &'a Interface) -> Joining<'a> {
        // whoever adds a key decides here whether interfaces that differ in it are joined alike
        let Interface {
            side_a,
            side_b,
            between,
            within,
            coupling,
            grid,
            quadrature,
            initial_gap,
            law: _,
            law_tolerance: _,
            initial_traction: _,
            initial_damage: _,
        } = stated;
        let gap = if initial_gap.is_some() { Gap::Open } else { Gap::Closed };
        let (coupling, grid, quadrature) = (*coupling, *grid, *quadrature);
        Joining { sides: [side_a, side_b], between, within, coupling, grid, quadrature, gap }
    }
}

/// Joinings of the interfaces of a scene, by their keys: scenes that agree in it and in their `duties`, on the same meshes of the
/// same subdomains, have the same interfaces.
pub fn joinings(scene: &Scene) -> Vec<(&str, Joining<'_>)> {
    scene.interfaces.iter().map(|(entry, stated)| (entry.as_str(), Joining::of(stated))).collect()
}

/// A curve of a side.
pub(super) struct Curve {
    /// Number of its body.
    pub subdomain: usize,
    /// Its name in messages.
    pub name: String,
    /// Its edges.
    pub edges: Vec<Facet>,
}

/// The curves of a side; no two of them hold the same edge.
pub(super) fn side(
    scene: &Scene,
    model: &Model,
    entry: &str,
    key: &str,
    names: &OneOrMany,
) -> Result<Vec<Curve>> {
    let path = ["interfaces", entry, key];
    let mut curves = Vec::new();
    let mut groups = Vec::new();
    for name in names.names() {
        groups.extend(groups::matching(scene, model, &path, name, Some("curve"))?);
    }
    let mut owner: HashMap<(usize, usize, usize), &str> = HashMap::new();
    for group in &groups {
        let (subdomain, edges) = groups::curve(scene, model, &path, group)?;
        for edge in edges {
            if let Some(other) = owner.insert((subdomain, edge.nodes()[0], edge.nodes()[1]), group) {
                let [x, y, _] = model.subdomains[subdomain].mesh.points[edge.nodes()[0]];
                let what = format!("\"{other}\" and \"{group}\" hold the same edge, at ({x}, {y})");
                return Err(scene.source.error_at(&path, what, "name every edge of a side once"));
            }
        }
        curves.push(Curve { subdomain, name: group.clone(), edges: edges.to_vec() });
    }
    Ok(curves)
}

impl PlannedInterface<'_> {
    /// Builds the interface.
    pub(super) fn join(&self, model: &Model, around: Surroundings) -> Result<InterfaceOperator> {
        let sides: [Vec<Side>; 2] = [0, 1].map(|i| {
            let curves = self.sides[i].iter().map(|curve| {
                let (mesh, first) =
                    (&model.subdomains[curve.subdomain].mesh, model.subdomains[curve.subdomain].first_node);
                let (name, edges) = (curve.name.as_str(), curve.edges.as_slice());
                Side { name, points: &mesh.points, edges, corners: &mesh.corners, first }
            });
            curves.collect()
        });
        let quadrilaterals = || self.sides.iter().flatten().all(|curve| on_quadrilaterals(model, curve));
        let Joining { within, coupling, grid, quadrature, gap, .. } = Joining::of(self.stated);
        let kind = match (coupling, grid) {
            (CouplingKind::Pointwise, _) => JumpScheme::Pointwise,
            (_, Grid::Quadratic) => JumpScheme::Projected,
            (_, Grid::Auto) if within.is_some() || quadrilaterals() => JumpScheme::Projected,
            (_, Grid::Auto | Grid::Linear) => JumpScheme::ProjectedLinear,
        };
        let points = match quadrature {
            Quadrature::Gauss => Points::Gauss,
            Quadrature::Lobatto => Points::Lobatto,
        };
        let coupling =
            Coupling::build(&self.name, &sides[0], &sides[1], Scheme { kind, points, gap }, around)?;
        let subdomains = [0, 1].map(|i| self.sides[i][0].subdomain);
        // the coupling's nodes are those of the model
        Ok(InterfaceOperator::new(&self.name, coupling, subdomains, [0, 0], model.dofs(), model.thickness))
    }
}

/// True if all cells along a curve are quadrilaterals.
fn on_quadrilaterals(model: &Model, curve: &Curve) -> bool {
    let shapes = &model.subdomains[curve.subdomain].mesh.cells.shapes;
    curve.edges.iter().all(|edge| shapes[edge.cell].corners() == 4)
}
