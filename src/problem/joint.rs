//! Two sides by name become a joint.

use super::groups;
use crate::assembly::{Joint, Model};
use crate::coupling::{Coupling, Gap, Kind, Points, Scheme, Side};
use crate::error::Result;
use crate::law::Law;
use crate::mesh::Edge;
use crate::scene::{self, Scene};

/// Builds the joint of an interface.
pub(super) fn join(scene: &Scene, model: &Model, name: &str, interface: &scene::Interface) -> Result<Joint> {
    let (mut sides, mut bodies, mut quadrilaterals) = ([Vec::new(), Vec::new()], [0; 2], true);
    for (i, (key, side)) in
        [("side_a", &interface.side_a), ("side_b", &interface.side_b)].into_iter().enumerate()
    {
        for group in side.names().iter().rev() {
            let (body, edges) = groups::curve(scene, model, &["interfaces", name, key], group)?;
            quadrilaterals &= on_quadrilaterals(model, body, edges);
            bodies[i] = body; // the first of the list in the end
            let (mesh, first) = (&model.bodies[body].mesh, model.bodies[body].first_node);
            sides[i].push(Side { name: group, points: &mesh.points, edges, corners: &mesh.corners, first });
        }
        sides[i].reverse();
    }
    let kind = match (interface.coupling, interface.grid) {
        (scene::CouplingKind::Pointwise, _) => Kind::Pointwise,
        (_, scene::Grid::Quadratic) => Kind::Projected,
        (_, scene::Grid::Auto) if quadrilaterals => Kind::Projected,
        (_, scene::Grid::Auto | scene::Grid::Linear) => Kind::ProjectedLinear,
    };
    let points = match interface.quadrature {
        scene::Quadrature::Gauss => Points::Gauss,
        scene::Quadrature::Lobatto => Points::Lobatto,
    };
    let gap = if interface.initial_gap.is_some() { Gap::Open } else { Gap::Closed };
    let coupling = Coupling::build(name, &sides[0], &sides[1], Scheme { kind, points, gap })?;
    // the coupling's nodes are those of the model
    Ok(Joint::new(name, coupling, bodies, [0, 0], model.dofs(), model.thickness))
}

/// True if all cells along a side are quadrilaterals.
fn on_quadrilaterals(model: &Model, body: usize, edges: &[Edge]) -> bool {
    edges.iter().all(|edge| model.bodies[body].mesh.cells.shapes[edge.cell].corners() == 4)
}

/// K_N h/E of a joint: the larger of the two edges meeting, the smaller E, maximum along the joint.
pub fn stiffness_number(model: &Model, joint: &Joint, law: &Law) -> f64 {
    let c = &joint.coupling.midplane;
    let young = |node: usize| {
        let body = model.bodies.partition_point(|body| body.first_node <= node) - 1;
        model.bodies[body].elasticity.young
    };
    let numbers = c.segments.iter().map(|g| {
        let length = c.a.chord(g.edge_a).max(c.b.chord(g.edge_b));
        let [a, b] = [c.a.nodes[c.a.ends[g.edge_a][0]], c.b.nodes[c.b.ends[g.edge_b][0]]];
        length / young(a).min(young(b))
    });
    law.elastic_stiffness()[0] * numbers.fold(0.0, f64::max)
}
