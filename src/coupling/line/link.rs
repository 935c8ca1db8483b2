//! The edges of a side on their way into a chain: in the order of their start nodes, so that what follows what is found
//! by search.

use crate::error::{Error, Result};
use crate::mesh::Facet;
use crate::shape::LINE_NODES;

/// A curve of a side, as the mesh gives it: edges with their body on the left. A side is a list of such curves.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// Its name in messages, such as `lower.top`.
    pub name: &'a str,
    /// Coordinates of its mesh.
    pub points: &'a [[f64; 3]],
    /// The edges in any order.
    pub edges: &'a [Facet],
    /// Nodes that lie on points of the geometry, ascending: where a side may be kinked. Empty if the mesh does not know.
    pub corners: &'a [usize],
    /// Offset of the node numbers of the mesh: the first node of its body in the model.
    pub first: usize,
}

/// Knowledge about a node of a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::coupling) enum Corner {
    /// It lies on a point of the geometry.
    Yes,
    /// It does not.
    No,
    /// The mesh does not tell.
    Unknown,
}

/// An edge on its way into a chain.
pub(in crate::coupling) struct Link {
    /// Node of the model.
    pub start: usize,
    /// Node of the model.
    pub end: usize,
    /// Its facet, walked from start to end, with nodes of the model.
    pub facet: Facet,
    /// Its nodes from the origin.
    pub x: [[f64; 2]; LINE_NODES],
    /// Knowledge of the start.
    pub corner: Corner,
}

/// Which way a chain runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::coupling) enum Orientation {
    /// As the mesh gives it: the body on the left of the chain.
    Left,
    /// The other way: the body on the right.
    Right,
}

/// The edges of a side by start node; no two start or end at one.
pub(in crate::coupling) fn sorted(
    interface: &str,
    curves: &[Side],
    subdomain: Orientation,
    origin: [f64; 2],
) -> Result<Vec<Link>> {
    let names = names(curves);
    let error_at =
        |what: String, help: &str| Error::Interface { name: interface.into(), what, help: help.into() };
    let mut links = Vec::with_capacity(curves.iter().map(|curve| curve.edges.len()).sum());
    for curve in curves {
        for edge in curve.edges {
            let [x, y, _] = curve.points[edge.nodes()[0]];
            if !edge.boundary {
                let what = format!("{} has an edge inside its body, near ({x}, {y})", curve.name);
                return Err(error_at(what, "a side lies on the boundary of its subdomain"));
            }
            links.push(Link::new(curve, edge, subdomain, origin));
        }
    }
    links.sort_unstable_by_key(|link| (link.start, link.end));
    links.dedup_by_key(|link| (link.start, link.end)); // a curve that is listed twice
    let mut ends: Vec<(usize, [f64; 2])> = links.iter().map(|link| (link.end, link.x[1])).collect();
    ends.sort_unstable_by_key(|&(node, _)| node);
    let branch = links.windows(2).find(|pair| pair[0].start == pair[1].start).map(|pair| pair[0].x[0]);
    let merge = ends.windows(2).find(|pair| pair[0].0 == pair[1].0).map(|pair| pair[0].1);
    if let Some([x, y]) = branch.or(merge) {
        let what = format!("{names} branches at ({}, {})", x + origin[0], y + origin[1]);
        return Err(error_at(what, "no more than two edges of a side meet at a node"));
    }
    Ok(links)
}

/// The link that starts where link `i` ends, or their number if none does.
pub(in crate::coupling) fn next(links: &[Link], i: usize) -> usize {
    let end = links[i].end;
    let starts = |j: usize| links.get(j).is_some_and(|link| link.start == end);
    // nodes of a curve are mostly numbered in a row
    match i {
        _ if starts(i + 1) => i + 1,
        1.. if starts(i - 1) => i - 1,
        _ => links.binary_search_by_key(&end, |link| link.start).unwrap_or(links.len()),
    }
}

/// Names of the curves of a side, for messages.
pub(in crate::coupling) fn names(curves: &[Side]) -> String {
    curves.iter().map(|curve| curve.name).collect::<Vec<_>>().join(", ")
}

impl Link {
    fn new(curve: &Side, edge: &Facet, subdomain: Orientation, origin: [f64; 2]) -> Link {
        let facet = if subdomain == Orientation::Right { edge.turned() } else { *edge };
        let (start, end) = (facet.nodes()[0], facet.nodes()[1]);
        let corner = match curve.corners {
            [] => Corner::Unknown,
            corners if corners.binary_search(&start).is_ok() => Corner::Yes,
            _ => Corner::No,
        };
        let mut x = [[0.0; 2]; LINE_NODES];
        for (x, &node) in x.iter_mut().zip(facet.nodes()) {
            let p = curve.points[node];
            *x = [p[0] - origin[0], p[1] - origin[1]];
        }
        Link {
            start: curve.first + start,
            end: curve.first + end,
            facet: facet.renumbered(|node| curve.first + node),
            x,
            corner,
        }
    }
}
