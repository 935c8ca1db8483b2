//! Every place of a side belongs to one interface: none is joined twice, and what is not joined is told.

use std::collections::BTreeMap;

use super::curve::PlannedInterface;
use crate::assembly::Model;
use crate::error::{Code, Result, Warning};
use crate::scene::Scene;

/// Two interfaces may reach this far into each other where they meet. Of the edge.
const MEETING: f64 = 1e-2;
/// A side of which less is missing is joined whole. Of its length.
const WHOLE: f64 = 1e-9;

/// An edge, from its smaller to its larger node of the model.
type EdgeKey = [usize; 2];

/// Part of an edge that an interface takes.
struct EdgeShare {
    interface: usize,
    from: f64,
    to: f64,
}

/// Refuses a place that two interfaces join at one of the times; warns of sides, named by the scene, that are joined in part.
pub(super) fn shares(
    scene: &Scene,
    model: &Model,
    plans: &[PlannedInterface],
    times: &[Vec<bool>],
) -> Result<Vec<Warning>> {
    let edges = taken(model);
    let together = |one: usize, two: usize| {
        let of = |interface: usize| model.interfaces[interface].subdomains;
        times.iter().any(|there| of(one).into_iter().chain(of(two)).all(|b| there[b]))
    };
    for (nodes, of_edge) in &edges {
        // where parts come and go others may lie between
        let back = if times.len() > 1 { of_edge.len() } else { 1 };
        let twice = (1..of_edge.len()).find_map(|k| {
            let two = &of_edge[k];
            let meets = |one: &&EdgeShare| {
                one.interface != two.interface
                    && two.from < one.to - MEETING
                    && together(one.interface, two.interface)
            };
            of_edge[k.saturating_sub(back)..k].iter().find(meets).map(|one| (one, two))
        });
        if let Some((one, two)) = twice {
            let (first, second) = (one.interface.min(two.interface), one.interface.max(two.interface));
            let subdomain = &model.subdomains
                [model.subdomains.partition_point(|subdomain| subdomain.first_node <= nodes[0]) - 1];
            let [x, y, _] = subdomain.mesh.points[nodes[0] - subdomain.first_node];
            let name = |interface: usize| &plans[interface].name;
            let what =
                format!("{} and {} both join {} at ({x}, {y})", name(first), name(second), subdomain.name);
            let help = "every place of a side belongs to one interface: name other curves or patterns";
            return Err(scene.source.error_at(&["interfaces", plans[second].entry], what, help));
        }
    }
    let mut warnings = Vec::new();
    for plan in plans.iter().filter(|plan| plan.stated.between.is_none()) {
        for (curves, label) in plan.sides.iter().zip(["A", "B"]) {
            let (mut whole, mut joined) = (0.0, 0.0);
            for (curve, edge) in
                curves.iter().flat_map(|curve| curve.edges.iter().map(move |edge| (curve, edge)))
            {
                let subdomain = &model.subdomains[curve.subdomain];
                let [p, q] = [0, 1].map(|i| subdomain.mesh.points[edge.nodes()[i]]);
                let length = (q[0] - p[0]).hypot(q[1] - p[1]);
                whole += length;
                let of_edge = edges.get(&ordered([0, 1].map(|i| subdomain.first_node + edge.nodes()[i])));
                joined +=
                    length * of_edge.into_iter().flatten().map(|taken| taken.to - taken.from).sum::<f64>();
            }
            if joined < whole * (1.0 - WHOLE) {
                let (name, share, length) = (&plan.name, 100.0 * joined / whole, joined);
                let what = format!(
                    "interface {name}: {share:.4} % of side {label} is joined (length {length:.6}), the rest faces nothing"
                );
                let help = "fine if it is meant; else move the sides or name the right curves";
                warnings.push(Warning::new(Code::PartlyJoined, what, help));
            }
        }
    }
    Ok(warnings)
}

/// Parts of every edge that interfaces take, in order along it.
fn taken(model: &Model) -> BTreeMap<EdgeKey, Vec<EdgeShare>> {
    let mut edges: BTreeMap<EdgeKey, Vec<EdgeShare>> = BTreeMap::new();
    for (interface, of_model) in model.interfaces.iter().enumerate() {
        for share in &of_model.coupling.midplane.segments {
            for side in 0..2 {
                let nodes = of_model.coupling.nodes(side, share.facets[side]);
                let [start, end] = share.projections[side];
                let (from, to) = if nodes[0] < nodes[1] { (start, end) } else { (1.0 - end, 1.0 - start) };
                edges.entry(ordered(nodes)).or_default().push(EdgeShare { interface, from, to });
            }
        }
    }
    edges.values_mut().for_each(|of_edge| of_edge.sort_by(|p, q| p.from.total_cmp(&q.from)));
    edges
}

fn ordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
