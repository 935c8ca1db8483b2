//! `within`: interfaces along curves drawn inside a body, whose mesh is opened there.
//!
//! All curves of a body are opened together, so that networks of several entries cross. A branch of an entry is an interface:
//! it has the entry's name if it is the only one, else `NAME~1`, `NAME~2`, … in the order of their ends with smaller x, then y.
//! Side A lies on the right of the way from that end, so that n points to its left.

use super::curve::{Curve, Joining, PlannedInterface, side};
use crate::assembly::Model;
use crate::error::Result;
use crate::mesh::{Branch, Facet};
use crate::scene::{JOINED, Scene};

/// Opens the bodies of a model; returns the interfaces that this makes.
pub(super) fn open<'a>(scene: &'a Scene, model: &mut Model) -> Result<Vec<PlannedInterface<'a>>> {
    let mut curves: Vec<(&str, Curve)> = Vec::new();
    for (entry, stated) in &scene.interfaces {
        let Some(names) = Joining::of(stated).within else { continue };
        for curve in side(scene, model, entry, "within", names)? {
            if let Some(edge) = curve.edges.iter().find(|edge| edge.boundary) {
                let [x, y, _] = model.subdomains[curve.subdomain].mesh.points[edge.nodes()[0]];
                let what = format!("\"{}\" lies on the boundary of its body at ({x}, {y})", curve.name);
                let help = "name it as a side; \"within\" takes curves with cells of one body on both of their sides";
                return Err(scene.source.error_at(&["interfaces", entry, "within"], what, help));
            }
            let shared = curves.iter().find(|(_, other)| shares(other, &curve));
            if let Some((other_entry, other)) = shared {
                let what =
                    format!("\"{}\" of {other_entry} and \"{}\" hold the same edge", other.name, curve.name);
                let help = "name every edge once";
                return Err(scene.source.error_at(&["interfaces", entry, "within"], what, help));
            }
            curves.push((entry, curve));
        }
    }
    let mut plans = Vec::new();
    for body in 0..model.subdomains.len() {
        // curves of one entry are one network
        let own: Vec<&(&str, Curve)> = curves.iter().filter(|(_, curve)| curve.subdomain == body).collect();
        let mut entries: Vec<&str> = own.iter().map(|(entry, _)| *entry).collect();
        entries.dedup();
        let edges = |entry: &&str| -> Vec<Facet> {
            own.iter().filter(|(of, _)| of == entry).flat_map(|(_, curve)| curve.edges.clone()).collect()
        };
        if entries.is_empty() {
            continue;
        }
        let networks: Vec<Vec<Facet>> = entries.iter().map(edges).collect();
        for Branch { curve, faces } in model.subdomains[body].mesh.open(&networks) {
            let Some((entry, stated)) = scene.interfaces.get_key_value(entries[curve]) else { continue };
            if let [[a], [b]] = faces.each_ref().map(Vec::as_slice)
                && shares_ends(a, b)
            {
                let [x, y, _] = model.subdomains[body].mesh.points[a.nodes()[0]];
                let what = format!(
                    "a fracture at ({x}, {y}) is one edge long and ends inside its body: nothing opens"
                );
                let help = "mesh it finer, so that it has at least two edges";
                return Err(scene.source.error_at(&["interfaces", entry, "within"], what, help));
            }
            let label = stated.within.as_ref().map_or(String::new(), |names| names.names().join(", "));
            let [a, b] = faces.map(|edges| vec![Curve { subdomain: body, name: label.clone(), edges }]);
            plans.push(PlannedInterface { name: String::new(), entry, stated, sides: [a, b] });
        }
    }
    let mut first_node = 0;
    for subdomain in &mut model.subdomains {
        subdomain.first_node = first_node;
        first_node += subdomain.mesh.points.len();
    }
    for i in 0..plans.len() {
        let entry = plans[i].entry;
        let number = plans[..i].iter().filter(|plan| plan.entry == entry).count() + 1;
        let alone = number == 1 && !plans[i + 1..].iter().any(|plan| plan.entry == entry);
        plans[i].name = if alone { entry.to_string() } else { format!("{entry}{JOINED}{number}") };
    }
    Ok(plans)
}

/// True if two edges have both ends in common.
fn shares_ends(a: &Facet, b: &Facet) -> bool {
    a.nodes()[..2].iter().all(|node| b.nodes()[..2].contains(node))
}

/// True if two curves of one body hold the same edge.
fn shares(a: &Curve, b: &Curve) -> bool {
    let ends = |edge: &Facet| [edge.nodes()[0].min(edge.nodes()[1]), edge.nodes()[0].max(edge.nodes()[1])];
    a.subdomain == b.subdomain && {
        let all: std::collections::HashSet<[usize; 2]> = a.edges.iter().map(ends).collect();
        b.edges.iter().any(|edge| all.contains(&ends(edge)))
    }
}
